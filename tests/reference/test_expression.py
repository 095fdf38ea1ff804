"""Formulas of the user's own: read exactly, evaluated in any arithmetic, and refused in one sentence."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from reference.arithmetic.compiler import hy
from reference.arithmetic.dual import with_slope
from reference.arithmetic.formula import FUNCTIONS, MAX_DEPTH, MAX_LENGTH, Expression
from reference.arithmetic.namespaces import BALL, MPMATH, NUMPY, ComplexBall, Heyoka
from reference.arithmetic.precision import ctx, mp
from reference.arithmetic.real_domains import real

FORMULAS = {
    "2*(x/pi)**4": lambda x: 2 * (x / math.pi) ** 4,
    "-x**2 + +3*x - 1/3": lambda x: -(x**2) + 3 * x - 1 / 3,
    "1/(1 + x**2)**3": lambda x: (1 + x * x) ** -3,
    "x**-2": lambda x: x**-2,
    "x**(3/2) + x**0.5": lambda x: x**1.5 + x**0.5,
    "x**(-1/3)": lambda x: x ** (-1 / 3),
    "sin(x)*cos(2*x) + tan(x/2)": lambda x: math.sin(x) * math.cos(2 * x) + math.tan(x / 2),
    "exp(-x)*log(1 + x)": lambda x: math.exp(-x) * math.log(1 + x),
    "asin(x/2) + acos(x/3) - atan(x)": lambda x: math.asin(x / 2) + math.acos(x / 3) - math.atan(x),
    "sinh(x) + cosh(x) - tanh(x) + sqrt(2)": lambda x: math.sinh(x) + math.cosh(x) - math.tanh(x) + math.sqrt(2),
    "x**0 + x**1": lambda x: 1 + x,
}
every_formula = pytest.mark.parametrize("text", FORMULAS)


@every_formula
def test_a_formula_is_the_same_in_every_arithmetic(text):
    formula, expected = Expression.parse(text, "x"), FORMULAS[text](0.75)
    x = Fraction(3, 4)
    assert formula(NUMPY, 0.75) == pytest.approx(expected, rel=1e-14)
    with ctx.workprec(200), mp.workprec(200):
        ball, value = formula(BALL, BALL.number(x)), formula(MPMATH, MPMATH.number(x))
        assert ball.rel_accuracy_bits() > 180
        assert abs(mp.mpf(ball.mid().str(70, radius=False)) - value) < mp.mpf(2) ** -180
        assert formula(ComplexBall(analytic=True), BALL.number(x)).real.overlaps(ball)
    assert float(value) == pytest.approx(expected, rel=1e-14)
    variable = hy.expression("x")
    compiled = hy.cfunc([formula(Heyoka(), variable) + 0.0 * variable], [variable])
    assert compiled(np.array([0.75]))[0] == pytest.approx(expected, rel=1e-14)


@every_formula
def test_a_formula_has_its_slope(text):
    formula = Expression.parse(text, "x")
    with mp.workprec(200):
        value, slope = with_slope(MPMATH, formula, mp.mpf(3) / 4)
        assert value == formula(MPMATH, mp.mpf(3) / 4)
        with mp.workprec(500):
            expected = mp.diff(lambda x: formula(MPMATH, x), mp.mpf(3) / 4)
        assert abs(slope - expected) < mp.mpf(2) ** -180 * (1 + abs(expected))


def test_numbers_are_taken_as_they_are_written():
    with ctx.workprec(200):
        assert Expression.parse("0.1*x", "x")(BALL, BALL.number(Fraction(10))).contains(1)
        assert Expression.parse("1e-3 + 2/3")(BALL).contains(BALL.number(Fraction(2003, 3000)))
    with mp.workprec(200):
        assert Expression.parse("1/3")(MPMATH) == mp.mpf(1) / 3


def test_a_power_of_a_ball_around_zero_is_a_ball_around_zero():
    with ctx.workprec(100):
        near = BALL.number(Fraction(1, 3)) - BALL.number(Fraction(1, 3))
        assert not near.is_exact()
        assert Expression.parse("x**3", "x")(BALL, near).contains(0)


@pytest.mark.parametrize(
    ("value", "shown", "number"),
    [
        (0.1, "0.1", 0.1),
        ("0.1", "'0.1'", 0.1),
        (Fraction(1, 3), "'1/3'", 1 / 3),
        ("pi/2", "'pi/2'", math.pi / 2),
        ("-2", "-2.0", -2),
        (3, "3.0", 3),
        ("sqrt(2)", "'sqrt(2)'", math.sqrt(2)),
    ],
)
def test_a_constant_reads_back_from_its_repr(value, shown, number):
    constant = Expression.constant(value)
    assert repr(constant) == shown
    assert Expression.constant(eval(repr(constant))) == constant  # noqa: S307 - our own text
    assert constant(NUMPY) == pytest.approx(number)


def test_formulas_are_equal_by_what_they_say():
    assert Expression.parse("2 * x", "x") == Expression.parse(" 2*x ", "x")
    assert Expression.parse("2*x", "x") != Expression.parse("x*2", "x")
    assert Expression.constant(0.5) == Expression.constant("1/2")


REFUSED = {
    "": "has a mistake in its syntax",
    "x +": "has a mistake in its syntax",
    "2x": "has a mistake in its syntax",
    "1if x else 2": "has a mistake in its syntax",
    "(" * 150: "has a mistake in its syntax",
    "(" * 300 + "x" + ")" * 300: f"is nested more than {MAX_DEPTH} deep",
    "sin(" * 150 + "x" + ")" * 150: f"is nested more than {MAX_DEPTH} deep",
    "x" + "/(1 + x" * 120 + ")" * 120: f"is nested more than {MAX_DEPTH} deep",
    "x\x00": "has a mistake in its syntax",
    "x = 2": "has a mistake in its syntax",
    "x^2": "holds 'x^2', which has no place in a formula; a power is written **",
    "x // 2": "holds 'x // 2', which has no place",
    "x % 2": "has no place",
    "x.real": "holds 'x.real', which has no place",
    "x if x else 1": "has no place",
    "lambda: 1": "has no place",
    "[x]": "has no place",
    "x[0]": "has no place",
    "x < 1": "has no place",
    "not x": "has no place",
    "~x": "has no place",
    "(x := 2)": "has no place",
    "'a'": "has no place",
    "True": "has no place",
    "1j": "has no place",
    "sin": "the name 'sin' is unknown, perhaps sin",
    "sin(x, 2)": "holds 'sin(x, 2)', which has no place",
    "sin(*x)": "has no place",
    "sin(x=1)": "has no place",
    "x(2)": "the function 'x' is unknown",
    "abs(x)": "the function 'abs' is unknown",
    "__import__('os')": "has no place",
    "y + 1": "the name 'y' is unknown; accepted are x, pi",
    "π*x": "the name 'π' is unknown",
    "x**x": "has a power that is not a rational number",
    "x**sqrt(2)": "has a power that is not a rational number",
    "x**1000": "has the power 1000, of more than 100",
    "x**(1/1000)": "has the power 1/1000, of more than 100 or in finer parts",
    "2**100**100": "of more than 100",
    "(99**99)**99": "holds a number of more than 20000 bits",
    "((1e999*1e999)*1e4000)*1e4000": "holds a number of more than 20000 bits",
    "x/0": "divides by zero",
    "x/(1 - 1)": "divides by zero",
    "0**-1": "divides by zero",
    "-" * 200 + "x": f"is nested more than {MAX_DEPTH} deep",
    "(" * 50_000 + "x" + ")" * 50_000: f"has 100001 characters; at most {MAX_LENGTH} are accepted",
    "x" + "+x" * 50_000: f"has 100001 characters; at most {MAX_LENGTH} are accepted",
    "1" * 1_000_000: f"has 1000000 characters; at most {MAX_LENGTH} are accepted",
    "x**10**9": "has the power 1000000000, of more than 100",
    "9**9**9": "has the power 387420489, of more than 100",
    "x" * (MAX_LENGTH + 1): f"has {MAX_LENGTH + 1} characters; at most {MAX_LENGTH} are accepted",
    "1e99999*x": "whose exponent is beyond the limit",
    "0x10*x": "spells no number",
}


@pytest.mark.parametrize(("text", "why"), REFUSED.items(), ids=lambda text: text[:20])
def test_what_is_no_formula_is_refused_in_one_sentence(text, why):
    with pytest.raises(ValueError, match=r"\.$") as refusal:
        Expression.parse(text, "x", "curve")
    message = str(refusal.value)
    assert message.startswith(("curve '", "a number of curve"))
    assert why in message
    assert len(message) < 300


def test_a_constant_has_no_variable():
    with pytest.raises(ValueError, match=r"^start 'x': the name 'x' is unknown.*accepted are pi\.$"):
        Expression.constant("x", "start")
    with pytest.raises(TypeError, match="start is of type NoneType"):
        Expression.constant(None, "start")
    with pytest.raises(ValueError, match="start is nan, which is not finite"):
        Expression.constant(math.nan, "start")


def test_every_function_can_be_written():
    for name in FUNCTIONS:
        assert Expression.parse(f"{name}(x)", "x")(NUMPY, 0.5) == getattr(NUMPY, name)(0.5)


@pytest.mark.parametrize("sign", ["+", "-", "*", "/"])
def test_a_long_sum_or_product_is_not_deep(sign):
    """As many terms as fit, which no other arithmetic finds too deep either."""
    text = sign.join(["x"] * (MAX_LENGTH // 2))
    formula = Expression.parse(text, "x")
    expected = {"+": 500.0, "-": -498.0, "*": 1.0, "/": 1.0}[sign]
    assert formula(NUMPY, 1.0) == expected
    assert with_slope(NUMPY, formula, 1.0) == (expected, {"*": 500.0, "/": -498.0}.get(sign, expected))
    assert formula == Expression.parse(f" {text} ", "x")
    assert hash(formula) == hash(Expression.parse(text, "x"))
    with ctx.workprec(100):
        assert real(formula, BALL.number(Fraction(1))) == int(expected)


def test_a_text_beyond_the_limit_is_not_even_read(monkeypatch):
    monkeypatch.setattr("ast.parse", None)
    for text in ("x" + "+x" * 50_000, "-" * 100_000 + "x", "x**" * 30_000 + "x"):
        with pytest.raises(ValueError, match=f"characters; at most {MAX_LENGTH} are accepted"):
            Expression.parse(text, "x")


def test_the_power_zero_is_one_of_what_is_a_number():
    for text in ("x**0", "(x - x)**0", "0**0", "pi**0"):
        assert Expression.parse(text, "x")(NUMPY, 2.0) == 1


def test_a_comment_is_no_part_of_a_formula():
    for text in ("x # + x**2", "x#", "#x", "(x # y\n)"):
        with pytest.raises(ValueError, match=r"^formula '.*' holds '#', which has no place in a formula\.$"):
            Expression.parse(text, "x")
