"""Exact coefficients."""

import pickle
from fractions import Fraction

import pytest
from flint import arb
from hypothesis import given
from hypothesis import strategies as st

from compare.methods.order.algebraic import Q, enclose, root, root_of
from reference.arithmetic.precision import ctx

CUBE_ROOT = root(2, 3)
fractions = st.fractions(min_value=-50, max_value=50, max_denominator=97)
elements = st.builds(lambda a, b, c: a + b * CUBE_ROOT + c * CUBE_ROOT * CUBE_ROOT, fractions, fractions, fractions)


def test_a_root_to_its_degree_is_its_radicand() -> None:
    assert CUBE_ROOT * CUBE_ROOT * CUBE_ROOT == 2
    assert CUBE_ROOT * CUBE_ROOT != 2


@given(elements, elements)
def test_arithmetic_agrees_with_balls(a: object, b: object) -> None:
    with ctx.workprec(300):
        for exact, ball in (
            (a + b, enclose(a) + enclose(b)),
            (a - b, enclose(a) - enclose(b)),
            (a * b, enclose(a) * enclose(b)),
        ):
            assert enclose(exact).overlaps(ball)


@given(elements.filter(lambda a: a != 0))
def test_a_number_times_its_inverse_is_exactly_one(a: object) -> None:
    assert a * (1 / a) == 1


@given(elements, fractions.filter(bool))
def test_rationals_mix_from_either_side(a: object, q: Fraction) -> None:
    assert (a + q) - a == q
    assert q - a == -(a - q)
    assert (q * a) / q == a


def test_the_triple_jump_weight_is_yoshidas() -> None:
    weight = 1 / (2 - CUBE_ROOT)
    with ctx.workprec(200):
        assert enclose(weight).overlaps(1 / (2 - arb(2).root(3)))
        assert abs(float(enclose(weight)) - 1.3512071919596578) < 1e-15


@given(elements)
def test_a_number_survives_pickling(a: object) -> None:
    assert pickle.loads(pickle.dumps(a)) == a  # noqa: S301 - our own bytes


def test_a_reducible_radical_is_refused() -> None:
    with pytest.raises(ValueError, match="reducible"):
        root(8, 3)


def test_numbers_of_two_fields_do_not_mix() -> None:
    with pytest.raises(ValueError, match="different fields"):
        _ = CUBE_ROOT + root(4, 3)


def test_a_number_prints_as_a_sum_of_roots() -> None:
    assert repr(Q(1, 3) - CUBE_ROOT) == "1/3 - 2^(1/3)"
    assert repr(CUBE_ROOT * CUBE_ROOT * Q(5, 12)) == "5*2^(2/3)/12"
    assert repr((4 + root(6)) / 10) == "2/5 + sqrt(6)/10"
    assert repr(CUBE_ROOT - CUBE_ROOT) == "0"


QUARTIC = root_of((-3, 16, -24, 0, 12), 0.9)


def test_a_root_of_a_polynomial_is_the_one_asked_for() -> None:
    assert 12 * QUARTIC * QUARTIC * QUARTIC * QUARTIC - 24 * QUARTIC * QUARTIC + 16 * QUARTIC == 3
    with ctx.workprec(200):
        r = enclose(QUARTIC)
        assert abs(float(r) - 0.9196615230173999) < 1e-15
        assert (12 * r**4 - 24 * r**2 + 16 * r - 3).contains(0)
        assert float(enclose(root_of((-3, 16, -24, 0, 12), -1.7))) < 0


def test_numbers_of_two_fields_are_equal_where_they_are_the_same_fraction() -> None:
    assert root(2) * root(2) == root(3) - root(3) + 2
    assert root(2) != root(3)
    assert hash(root(2) * root(2)) == hash(Q(2))
    assert (root(2) * root(2)).rational == 2
    assert root(2).rational is None
