"""Where a formula is real and finite: every part of it, also one that cancels, is proven to have a value."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb

from reference.arithmetic.balls import BALL
from reference.arithmetic.formula import Expression
from reference.arithmetic.precision import ctx
from reference.arithmetic.real_domains import OutsideDomainError, real

CERTAIN = {
    "x + acos(2)": "'acos(2)' is the arc cosine of 2",
    "asin(-3/2)*x": "'asin(-3/2)' is the arc sine of -1.5",
    "x + log(-1)": "'log(-1)' is the logarithm of -1",
    "log(0)": "'log(0)' is the logarithm of 0",
    "x + 1/sin(0)": "'1/sin(0)' is a division by 0",
    "3*x - sqrt(1-2)": "'sqrt(1-2)' is the square root of -1",
    "x + (acos(2) - acos(2))": "'acos(2)' is the arc cosine of 2",
    "0*log(-1)": "'log(-1)' is the logarithm of -1",
    "log(-1)**0": "'log(-1)' is the logarithm of -1",
    "x*sqrt(-1)*sqrt(-1)": "'sqrt(-1)' is the square root of -1",
    "(-8)**(1/3)": "'(-8)**(1/3)' is a fractional power of -8",
    "(-1)**(1/2)": "'(-1)**(1/2)' is a fractional power of -1",
    "(-2)**(-3/2)": "'(-2)**(-3/2)' is a negative fractional power of -2",
    "0**(-1/3)": "'0**(-1/3)' is a negative fractional power of 0",
    "(x - 1)**-2": "'(x - 1)**-2' is a division by 0",
    "log(x - 5)": "'log(x - 5)' is the logarithm of -4",
    "log(-exp(2000))": "'log(-exp(2000))' is the logarithm of -3.88118e+868",
}
DOUBTFUL = {
    "x + tan(pi/2)": "the tangent of a number that is not proven to be away from its poles",
    "acos(sin(pi/2))": "the arc cosine of a number that is not proven to be from -1 to 1",
    "sqrt(sin(pi))": "the square root of a number that is not proven to be zero or positive",
    "(pi - pi)**(1/3)": "a fractional power of a number that is not proven to be zero or positive",
    "log(pi - pi)": "the logarithm of a number that is not proven to be positive",
    "1/(pi - pi)": "a division by a number that is not proven to be other than zero",
    "exp(exp(exp(exp(exp(5)))))": "a number that is not proven to be finite",
}
REAL = {
    "acos(1) + asin(-1) + x": 1 - 1.5707963267948966,
    "sqrt(0) + sqrt(1 - x)": 0,
    "0**(1/3) + 0**(1/2)": 0,
    "tan(pi/2 - 1e-30)": 1e30,
    "log(1e-300)/log(10)": -300,
    "(-8)**3 + (-2)**-2": -511.75,
    "x**0 + 0**0": 2,
    "(1 + x)**(-1/3)": 2 ** (-1 / 3),
}


@pytest.mark.parametrize(("text", "why"), CERTAIN.items())
def test_a_part_without_a_value_is_named(text, why):
    with ctx.workprec(256), pytest.raises(OutsideDomainError) as failure:
        real(Expression.parse(text, "x"), arb(1))
    assert (str(failure.value), failure.value.certain) == (why, True)


@pytest.mark.parametrize(("text", "why"), DOUBTFUL.items())
def test_a_part_whose_value_cannot_be_proven_is_named_without_a_claim(text, why):
    with ctx.workprec(256), pytest.raises(OutsideDomainError) as failure:
        real(Expression.parse(text, "x"), arb(1))
    assert str(failure.value).endswith(f"' is {why}")
    assert (failure.value.certain, failure.value.constant) == (False, True)


@pytest.mark.parametrize(("text", "value"), REAL.items())
def test_what_is_real_has_its_value(text, value):
    with ctx.workprec(256):
        assert float(real(Expression.parse(text, "x"), arb(1))) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "inside", "outside"),
    [
        ("log(x)", "1/100", "-1/100"),
        ("sqrt(x)", "1/100", "-1/100"),
        ("x**(2/3)", "1/100", "-1/100"),
        ("acos(x)", "99/100", "101/100"),
        ("asin(x)", "-99/100", "-101/100"),
    ],
)
def test_on_a_ball_that_straddles_the_end_of_a_domain_nothing_is_claimed(text, inside, outside):
    formula = Expression.parse(text, "x")
    with ctx.workprec(100):
        here, there = (BALL.number(Fraction(value)) for value in (inside, outside))
        small = arb(0, 0.001)
        assert real(formula, here + small).is_finite()
        with pytest.raises(OutsideDomainError) as failure:
            real(formula, there + small)
        assert failure.value.certain
        with pytest.raises(OutsideDomainError) as failure:
            real(formula, here.union(there))
        assert not failure.value.certain
        assert not failure.value.constant
