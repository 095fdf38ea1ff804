"""Number formats round exact numbers correctly."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from flint import arb
from hypothesis import given
from hypothesis import strategies as st

from compare.march.march import march
from compare.march.precision import FORMATS, Precision, _long, precision
from compare.measure.truth import Course
from compare.methods import find
from compare.methods.order.algebraic import root
from reference import Pendulum
from reference.arithmetic.compiler import hy

every_format = pytest.mark.parametrize("fmt", [*FORMATS, precision("mp:200")], ids=lambda fmt: fmt.name)
rationals = st.fractions(min_value=-1000, max_value=1000, max_denominator=10**9)


@every_format
@given(rationals)
def test_rounding_is_to_the_nearest(fmt: Precision, value: Fraction) -> None:
    rounded = fmt.round(value)
    if value:
        exponent = math.frexp(float(value))[1]
        assert abs(rounded - value) <= Fraction(2) ** (exponent + 1 - fmt.bits) / 2
    mantissa = rounded.numerator.bit_length() - (rounded.numerator & -rounded.numerator).bit_length() + 1
    assert mantissa <= fmt.bits or value == 0


@given(rationals)
def test_float64_and_float32_agree_with_python_and_numpy(value: Fraction) -> None:
    assert precision("float64").number(value) == float(value)
    assert precision("float32").number(value) == np.float32(precision("longdouble").number(value))


@every_format
def test_a_number_of_a_format_is_the_rational_it_says(fmt: Precision) -> None:
    third = fmt.number(Fraction(1, 3))
    exact = fmt.round(Fraction(1, 3))
    assert third * fmt.number(Fraction(3)) - fmt.number(Fraction(1)) < fmt.epsilon
    assert abs(float(third) - float(exact)) < 1e-7
    assert fmt.number(exact) == third


@every_format
def test_an_algebraic_coefficient_is_rounded_once(fmt: Precision) -> None:
    found = fmt.round(root(2, 3))
    assert abs(found**3 - 2) < 8 * fmt.epsilon
    assert found**3 != 2


class AboutOne:
    """A number that balls enclose and never tell from a power of two, such as cos^2 + sin^2."""

    def ball(self) -> arb:
        return (arb(11) / 10).cos() ** 2 + (arb(11) / 10).sin() ** 2


@pytest.mark.parametrize("fmt", FORMATS, ids=lambda fmt: fmt.name)
def test_a_power_of_two_is_rounded_though_its_balls_reach_to_both_sides_of_it(fmt: Precision) -> None:
    assert fmt.round(AboutOne()) == 1


@every_format
def test_differences_keep_what_the_format_holds(fmt: Precision) -> None:
    value = fmt.round(Fraction(1, 3))
    limbs = np.array([[float(value), float(value - Fraction(float(value))), 0.0]])
    tail = Fraction(float(value)) + Fraction(float(value - Fraction(float(value))))
    assert fmt.difference(fmt.array([value]), limbs)[0] == float(value - tail)


@every_format
def test_zeros_have_the_full_precision(fmt: Precision) -> None:
    zeros = fmt.zeros((2, 3))
    assert zeros.shape == (2, 3)
    assert np.all(zeros == 0)
    assert (zeros + fmt.array([1, 2, 3]))[1, 2] == fmt.number(Fraction(3))


@pytest.mark.parametrize("name", ["float16", "mp:", "mp:23", "mp:5000", "mp:1e3", "double"])
def test_an_unknown_format_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match=f"precision '{name}' is unknown"):
        precision(name)


def test_a_long_double_is_made_of_pieces_without_loss() -> None:
    whole = (1 << 63) + 12345678901
    for value in (whole, -whole, 3, -3, 0, (1 << 32) - 1, 1 << 32):
        assert int(_long(value)) == value


def test_binary128_without_a_compiler_that_has_it_is_the_same_to_rounding() -> None:
    """Not every processor's compiler has binary128; MPFR rounds to as many bits."""
    native, instead = precision("float128"), Precision("float128", 113, hy.real, 1)
    found = []
    for fmt in (native, instead):
        course = Course(Pendulum(1.0), 64, Fraction(2), fmt)
        (result,) = march(find("rk4"), [course.lane], fmt)
        found.append(course.errors(result.states))
    assert np.max(np.abs(found[0] - found[1])) < 64 * native.epsilon
