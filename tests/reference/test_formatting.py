"""Certified numbers in format strings: laid out as floats are, with digits that are proven."""

from __future__ import annotations

import re
from decimal import ROUND_HALF_EVEN, Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest

from reference import Pendulum
from reference.arithmetic.limbs import fixed

START = Fraction(0)
NUMBERS = {
    "a period": Pendulum(1.0).period(),
    "a negative number": Pendulum(1.0).energy(),
    "a large number": Pendulum(1.0, g=1e-11).period(),
    "a small number": Pendulum(1e-7).certified("modulus"),
    "a tiny negative number": Pendulum(1e-30).certified("state", Fraction(1), 1),
    "zero": Pendulum(0.5).certified("state", START, 1),
    "an exact number": Pendulum(0.5).certified("state", START, 0),
}
LAYOUTS = ("", "+", " ", "-", "012", "<20", "*^25", "=+20", ",", "_", "x>+20,", "020,")


@pytest.mark.parametrize("number", NUMBERS.values(), ids=NUMBERS.keys())
def test_where_a_double_has_the_digits_the_text_is_the_one_of_the_double(number):
    for kind in "eEfFgG":
        for precision in (0, 1, 2, 5):
            for layout in LAYOUTS:
                spec = f"{layout}.{precision}{kind}"
                unsigned = re.sub(r"^((?:.?[<>=^])?[-+ ]?)", r"\1z", spec)
                assert format(number, spec) == format(float(number), unsigned), spec


@pytest.mark.parametrize("spec", ["", "10", "g", "e", ",", ".3%", "#.3g", ".4"])
def test_other_specifications_format_the_double(spec):
    period = NUMBERS["a period"]
    assert format(period, spec) == format(float(period), spec)


@pytest.mark.parametrize("spec", ["d", ".3x", "nonsense"])
def test_what_no_float_takes_is_refused(spec):
    with pytest.raises(ValueError, match=r"[Ff]ormat"):
        format(NUMBERS["a period"], spec)


@pytest.mark.parametrize("number", NUMBERS.values(), ids=NUMBERS.keys())
def test_digits_beyond_the_double_are_those_of_the_number(number):
    with localcontext(prec=200):
        truth = Decimal(number.digits(150))
        plain = truth.quantize(Decimal(1).scaleb(-60), ROUND_HALF_EVEN)
    assert f"{number:.60f}" == f"{plain:f}"
    assert Decimal(f"{number:.59e}") == Decimal(number.digits(60))
    assert Decimal(f"{number:.60g}") == Decimal(number.digits(60))


def test_rounding_to_places_is_to_even_and_keeps_the_sign_but_of_zero():
    assert [fixed(Fraction(n, 8), 2) for n in (1, 3, -1, -3)] == ["0.12", "0.38", "-0.12", "-0.38"]
    assert fixed(Fraction(-1, 1000), 2) == "0.00"
    assert [f"{NUMBERS['a tiny negative number']:{spec}}" for spec in (".2f", "+.0f", ".1%")] == ["0.00", "+0", "0.0%"]
    assert fixed(Fraction(5, 2), 0) == "2"
    assert len(fixed(Fraction(1, 3), 9000)) == 9002


@pytest.mark.parametrize("count", [np.int64(3), np.uint8(3)])
def test_counts_are_any_integers(count):
    problem = Pendulum(1.0)
    assert problem.period().digits(count) == "2.14"
    assert problem.period().limbs(count) == problem.period().limbs(3)
    assert problem.state(1.0, limbs=count).shape == (2, 3)


@pytest.mark.parametrize("count", [True, np.True_, 0, 2.0])
def test_limbs_must_be_a_positive_integer(count):
    for asked in (Pendulum(1.0).period().limbs, lambda limbs: Pendulum(1.0).state(1.0, limbs=limbs)):
        with pytest.raises(ValueError, match=r"^limbs is .*; a positive integer is accepted\.$"):
            asked(count)
