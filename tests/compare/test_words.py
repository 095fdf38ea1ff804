"""Words and Lyndon words: as many as there are independent order conditions."""

from __future__ import annotations

from fractions import Fraction

import pytest

from compare.methods.order.lyndon_words import DRIFT, KICK, coefficient, lyndon_words, nystrom_words, odd_words


def test_lyndon_words_are_as_many_as_the_free_lie_algebra_has_dimensions() -> None:
    assert [len(lyndon_words(degree)) for degree in range(1, 10)] == [2, 1, 2, 3, 6, 9, 18, 30, 56]


def test_fewer_conditions_remain_where_velocities_are_linear() -> None:
    assert [len(nystrom_words(degree)) for degree in range(1, 8)] == [2, 1, 2, 2, 4, 5, 10]


def test_symmetric_compositions_have_the_conditions_that_are_known() -> None:
    assert [len(odd_words(degree)) for degree in (1, 3, 5, 7, 9)] == [1, 1, 2, 4, 8]


@pytest.mark.parametrize("word", [(DRIFT, KICK, DRIFT), (KICK, KICK, DRIFT, DRIFT), (DRIFT,)])
def test_a_word_of_an_exponential_has_the_reciprocal_of_a_factorial(word: tuple[str, ...]) -> None:
    factorial = {1: 1, 3: 6, 4: 24}[len(word)]
    halves = [{(DRIFT,): Fraction(1, 2), (KICK,): Fraction(1, 2)}] * 2
    assert coefficient(word, halves) == Fraction(1, factorial)


def test_a_word_in_the_wrong_order_of_flows_has_no_coefficient() -> None:
    flows = [{(KICK,): Fraction(2)}, {(DRIFT,): Fraction(3)}]
    assert coefficient((KICK, DRIFT), flows) == 6
    assert coefficient((DRIFT, KICK), flows) == 0
    assert coefficient((KICK, KICK, DRIFT), flows) == 6
