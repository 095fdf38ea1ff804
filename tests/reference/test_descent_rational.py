"""What is exactly rational about a descent, and the numbers among which that is decided."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from reference.arithmetic.exact import rational_root
from reference.arithmetic.formula import Expression
from reference.arithmetic.precision import mp
from reference.arithmetic.surds import COSINES, PI, UNKNOWN, NotExactError, Surd, exactly, surd
from reference.problems.descent.curves import RACE
from reference.problems.descent.problem import Descent

ALONG_THE_PASSAGE = {
    ("line", 1): {"1/3": (None, None, Fraction(4, 3), None, None), "1": (None, 0, 0, 2, None)},
    ("parabola", "9/4"): {"1/3": (None, None, Fraction(8, 9), None, None), "1": (None, 0, 0, 3, -3)},
    ("cubic", 1): {"1/2": (None, None, Fraction(1, 4), None, None), "1": (None, 0, 0, 2, -2)},
    ("quartic", 2): {"1/3": (None, None, Fraction(32, 81), None, None)},
    ("circular_arc", 4): {"1/3": None, "1": (None, 0, 0, 4, -4)},
    ("quarter_ellipse", 1): {"1/3": (None, None, 1, None, None), "1": (None, 0, 0, 2, -2)},
    ("cycloid", 4): {
        "1/2": (None, None, Fraction(1, 2), None, -3),
        "0.3": (None, None, Fraction(49, 50), None, Fraction(-51, 25)),
        "1": (None, 0, 0, 4, -4),
    },
}


@pytest.mark.parametrize(("curve", "g"), ALONG_THE_PASSAGE)
def test_what_is_rational_about_a_passage_is_known(curve, g):
    problem = Descent(curve, g)
    assert problem.exact_row("passage", Fraction(0)) == (0, None, 2, 0, 0)
    for place, values in ALONG_THE_PASSAGE[curve, g].items():
        assert problem.exact_row("passage", Fraction(place)) == values


@pytest.mark.parametrize("curve", RACE, ids=lambda curve: curve.name)
def test_at_the_start_the_body_is_at_rest_at_the_height_of_two(curve):
    problem = Descent(curve)
    assert problem.exact_row("state", Fraction(0)) == (0, 0)
    assert problem.exact_row("motion", Fraction(0)) == (None, 2, 0, 0, 0)
    assert problem.along("motion", 0).tolist() == [math.pi, 2, 0, 0, 0]


def test_only_the_cycloid_has_a_rational_length():
    lengths = {curve.name: Descent(curve).exact_row("arc_length", None) for curve in RACE}
    assert {name: length for name, length in lengths.items() if length} == {"cycloid": (4,)}
    assert Descent("cycloid", released="1/4").arc_length().digits(5) == "3.0000"


INCLINES = {
    "forty-five degrees": Descent("x", "9.8", 2, 0),
    "thirty degrees": Descent("tan(pi/6)*x", "9.8", "sqrt(3)", 0),
    "three, four, five": Descent("y = 3/4*x - 1", 10, -4, -8),
    "forwards": Descent("-4/3*x", 10, 1, 7),
    "by squares": Descent("x = 3*p**2; y = 5 - 4*p**2", 10, 0, 1),
    "free fall": Descent("x = 1/3; y = 1 - p", 2, 0, 1),
    "free fall by another parameter": Descent("x = 1/3; y = exp(-p)", 2, 0, 1),
    "an identity": Descent("(x + 1)**2 - x**2", 10, 2, "1/2"),
    "pi times a line": Descent("x = pi*p; y = pi*p", 10, 1, 0),
    "released late": Descent("x", "9.8", 4, 0, released="1/2"),
}


@pytest.mark.parametrize("name", INCLINES)
def test_on_an_incline_what_is_rational_is_what_galileo_says(name):
    """x, y and the velocity are those of the acceleration g sin(a)^2 downwards, g sin(a) cos(a) along."""
    problem, t = INCLINES[name], Fraction(1, 4)
    start, body = problem.along("motion", 0), problem.along("motion", t)
    end = problem.along("passage", 1)
    dx, dy = end[1] - start[0], end[2] - start[1]
    sine, cosine = -dy / math.hypot(dx, dy), dx / math.hypot(dx, dy)
    g = float(problem.g)
    expected = (
        start[0] + g * sine * cosine / 32,
        start[1] - g * sine**2 / 32,
        g * sine / 4,
        g * sine * cosine / 4,
        -g * sine**2 / 4,
    )
    assert body.tolist() == pytest.approx(expected, rel=1e-14)
    exact = problem.exact_row("motion", t)
    known = [value is not None for value in exact]
    assert [float(value) for value in exact if value is not None] == pytest.approx(body[known], rel=1e-14)
    assert exact[4] is not None
    rational_sine = name in {"thirty degrees", "three, four, five", "forwards", "by squares"} or "fall" in name
    assert known[2] == rational_sine
    assert known[3] == (name != "thirty degrees")
    assert known[0] == (name not in {"thirty degrees", "pi times a line"})


def test_the_values_of_an_incline_are_exact():
    problem = INCLINES["three, four, five"]
    assert problem.exact_row("descent_time", None) is None
    assert problem.exact_row("arc_length", None) == (5,)
    assert problem.exact_row("motion", Fraction(1, 2)) == (
        Fraction(-23, 5),
        Fraction(-89, 20),
        3,
        Fraction(-12, 5),
        Fraction(-9, 5),
    )
    assert problem.exact_row("state", Fraction(1, 2)) == (Fraction(3, 20), Fraction(3, 5))
    assert problem.exact_row("passage", Fraction(3, 20)) == (
        Fraction(1, 2),
        Fraction(-23, 5),
        Fraction(-89, 20),
        3,
        Fraction(-12, 5),
    )
    assert INCLINES["by squares"].exact_row("state", Fraction(1, 2)) is None
    assert INCLINES["forty-five degrees"].exact_row("arc_length", None) is None
    late = INCLINES["released late"].exact_row("state", Fraction(1, 2))
    assert late == (Fraction("0.653125"), Fraction("0.6125"))


def test_a_descent_time_that_is_rational_is_itself_a_time():
    problem = Descent("x = 0; y = 9 - p", 2, 0, 9)
    assert problem.exact_row("descent_time", None) == (3,)
    assert problem.descent_time().digits(5) == "3.0000"
    assert problem.along("motion", 3).tolist() == [0, 0, 6, 0, -6]
    with pytest.raises(ValueError, match="a time from 0 to the descent time"):
        problem.state(Fraction(3) + Fraction(1, 10**100))


def test_a_cusp_is_left_with_a_rate_that_is_not_known_exactly():
    problem = Descent("x = pi - p + sin(p); y = 1 + cos(p)", start=0, end="pi")
    assert problem.exact_row("state", Fraction(0)) == (0, None)
    assert problem.state(0).tolist() == [0, pytest.approx(math.sqrt(9.81) / math.pi, rel=1e-15)]
    assert problem.exact_row("passage", Fraction(1, 3)) == (None, None, Fraction(3, 2), None, None)


EXACT = {
    "2*(pi/2/pi)**4": Fraction(1, 8),
    "tan(pi/6)**2": Fraction(1, 3),
    "sqrt(8)*sqrt(2)": 4,
    "sqrt(1/2)*sqrt(2)": 1,
    "(pi**2 + 4)/2*(2/pi)**2/(1 + (2/pi)**2)": 2,
    "cos(pi/5)*cos(2*pi/5)": Fraction(1, 4),
    "cos(pi/12)*cos(5*pi/12)": Fraction(1, 4),
    "sin(7*pi/6)": Fraction(-1, 2),
    "sin(-5*pi/2)": -1,
    "cos(100*pi)": 1,
    "8**(2/3)": 4,
    "(4/9)**(-1/2)": Fraction(3, 2),
    "0**(1/3)": 0,
    "sqrt(0)": 0,
    "acos(-sqrt(3)/2)/pi": Fraction(5, 6),
    "asin(1/2)/pi": Fraction(1, 6),
    "atan(1)/pi": Fraction(1, 4),
    "sqrt(pi**2)/pi": 1,
    "sqrt(4/pi**4)*pi**2": 2,
    "1/(1 + sqrt(2)) - sqrt(2)": -1,
    "exp(0) + log(1) + cosh(0) + sinh(0) + tanh(0)": 2,
}


@pytest.mark.parametrize(("text", "value"), EXACT.items())
def test_a_formula_has_its_exact_value(text, value):
    assert exactly(Expression.parse(text), 0).rational == value


@pytest.mark.parametrize("text", ["pi", "sqrt(2)", "sqrt(2) + sqrt(3)", "pi**2/(pi + 1)", "cos(pi/4)", "pi - 22/7"])
def test_what_is_irrational_has_no_rational_value(text):
    found = exactly(Expression.parse(text), 0)
    assert found is not None
    assert found.rational is None
    assert not found.is_zero


@pytest.mark.parametrize(
    "text",
    [
        *("exp(1)", "log(2)", "sin(1)", "sin(pi/7)", "atan(2/pi)", "tan(pi/2)"),
        *("sqrt(-1)", "sqrt(pi)", "2**(1/3)", "1/(pi - pi)", "sqrt(2**100*2**100*2**100 + 1)"),
        "pi**90*(1 + sqrt(2) + sqrt(3) + sqrt(5) + sqrt(7) + sqrt(11) + pi)**20",
    ],
)
def test_what_is_beyond_these_numbers_is_not_claimed_to_be_known(text):
    assert exactly(Expression.parse(text), 0) is None


def test_the_known_cosines_are_cosines():
    for turns, cosine in COSINES.items():
        value = sum(float(q) * math.sqrt(d) for (*_, d), q in cosine.top.items())
        assert value / sum(float(q) for q in cosine.bottom.values()) == pytest.approx(
            math.cos(math.pi * turns), abs=1e-15
        )


def test_equality_is_decided_among_unknowns():
    assert (UNKNOWN + PI) ** 2 == UNKNOWN**2 + 2 * PI * UNKNOWN + PI * PI
    assert (UNKNOWN + 1) / (UNKNOWN + 1) == 1
    assert UNKNOWN != PI
    assert (1 - UNKNOWN) - (1 - UNKNOWN) == 0
    with pytest.raises(NotExactError):
        surd("2")
    with pytest.raises(NotExactError):
        Surd({}, {})


def test_a_root_of_a_rational_is_exact_or_none():
    assert rational_root(Fraction(9, 4)) == Fraction(3, 2)
    assert rational_root(Fraction(0)) == 0
    assert rational_root(Fraction(2)) is None
    assert rational_root(Fraction(-4)) is None


BY_ANGLE = {
    "from the cusp": (Descent("x = p - sin(p); y = cos(p)", 1, 0, "pi"), None, 4),
    "part of the way": (Descent("x = p - sin(p); y = cos(p)", 4, 0, 1), Fraction(1, 2), None),
    "of radius three": (Descent("x = 3*(p - sin(p)); y = -3*(1 - cos(p))", 3, 0, 3), 3, None),
    "from its side": (Descent("x = p + sin(p); y = 1 - cos(p)", 1, "-pi/3", 0), None, 2),
    "a circle": (Descent("x = 3*cos(p); y = 3*sin(p)", 1, 1, 0), None, 3),
    "a cardioid": (Descent("x = 2*cos(p) - cos(2*p); y = sin(2*p) - 2*sin(p)", 1, "pi/3", "2*pi/3"), None, None),
    "squares": (Descent("x = 0; y = -p**2", 2, 0, 3), 3, 9),
}


@pytest.mark.parametrize("name", BY_ANGLE)
def test_a_time_or_a_length_by_an_angle_may_be_rational(name):
    problem, time, length = BY_ANGLE[name]
    assert problem.exact_row("descent_time", None) == (None if time is None else (time,))
    assert problem.exact_row("arc_length", None) == (None if length is None else (length,))
    for row in ("descent_time", "arc_length"):
        with mp.workprec(53):
            form = getattr(problem.quadrature_form(), row)
        assert float(form) == pytest.approx(float(problem.certified(row)), rel=1e-14)


def test_on_a_cycloid_the_angle_goes_as_the_time():
    problem = BY_ANGLE["part of the way"][0]
    assert problem.exact_row("state", Fraction(1, 8)) == (Fraction(1, 4), 2)
    assert problem.exact_row("passage", Fraction(1, 4))[0] == Fraction(1, 8)
    assert problem.state(Fraction(1, 8)).tolist() == [0.25, 2]
    assert BY_ANGLE["squares"][0].exact_row("state", Fraction(3, 2)) == (Fraction(1, 2), Fraction(1, 3))


@pytest.mark.parametrize(("text", "at"), [("cos(x)", 1.1), ("sin(3*x)", 0.7), ("cos(-5*x/2)", 2.0), ("tan(x/2)", 0.4)])
def test_a_sine_of_the_unknown_is_a_quotient_in_the_tangent_of_its_quarter(text, at):
    found = exactly(Expression.parse(text, "x"), UNKNOWN)
    tangent = math.tan(at / 4)
    top, bottom = (
        sum(float(q) * tangent**k * math.sqrt(d) for (_, k, _, d), q in part.items())
        for part in (found.top, found.bottom)
    )
    assert top / bottom == pytest.approx(
        {"c": math.cos, "s": math.sin, "t": math.tan}[text[0]](
            at * {"cos(x)": 1, "sin(3*x)": 3, "cos(-5*x/2)": -2.5, "tan(x/2)": 0.5}[text]
        )
    )
    assert exactly(Expression.parse("sin(x)**2 + cos(x)**2", "x"), UNKNOWN) == 1
    assert exactly(Expression.parse("sin(x/3)", "x"), UNKNOWN) is None


def test_what_is_rational_at_one_end_is_known_whatever_the_other_end_is():
    """No ball decides that a coordinate is zero."""
    chain = Descent("cosh(x)", start="log(2)", end=0)
    assert chain.exact_row("passage", Fraction(1))[1:3] == (0, 1)
    assert chain.along("passage", 1, limbs=3)[1:3].tolist() == [[0, 0, 0], [1, 0, 0]]
    assert Descent("log(x)", start="exp(1)", end=1).exact_row("passage", Fraction(1))[1:3] == (1, 0)
    fall = Descent("-x", start=0, end="exp(1)", g=2)
    assert fall.exact_row("motion", Fraction(0))[:2] == (0, 0)
    assert fall.exact_row("passage", Fraction(1)) is None
