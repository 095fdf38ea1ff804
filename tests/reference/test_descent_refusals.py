"""Curves that a body at rest does not slide down, and inputs that are none: one clear sentence for each."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from reference.__main__ import main
from reference.command.terminal import run
from reference.problems.descent.problem import Descent

VERTICAL = "a curve that is vertical there is accepted by a parameter, 'x = ...; y = ...'."
REFUSED = {
    "a horizontal start": ("1 - x**2", 0, 1, "starts horizontally, where a body at rest stays"),
    "a start that rises": ("sin(x)", 1, 5.5, "rises from its start"),
    "an end as high as the start": ("x**2", -1, 1, "ends no lower than it starts"),
    "an end above the start": ("x", 0, 1, "ends no lower than it starts"),
    "a point": ("x = 1; y = 2", 0, 1, "ends no lower than it starts"),
    "a hill above the start": ("cos(x)", 0.1, 7, "rises above its start at x = 6.1914"),
    "a touch of the start's level": ("-x*(x - 1)**2", 0, 2, "comes up to the level of its start near x = 1,"),
    "a hill that no sample meets": (
        "0.01*exp(-1e10*(x - 1/pi)**2) - x/1000",
        0,
        1,
        "near x = 0.318",
    ),
    "a vertical start": ("1 - sqrt(x)", 0, 1, f"with a finite slope at its start; {VERTICAL}"),
    "a vertical end": ("sqrt(x)", 1, 0, f"near x = 3.18323e-12; {VERTICAL}"),
    "a root that ends on the way": (
        "sqrt(1 - x) - x",
        0,
        2,
        "is not real and finite at x = 1.00781: 'sqrt(1 - x)' is the square root of -0.0078125; a curve that is real",
    ),
    "a root that ends at the end": ("sqrt(1 - x) - x", 0, 1, f"near x = 1; {VERTICAL}"),
    "a pole": ("-1/(x - 3/2)**2 - 10*x", 1, 2, "at x = 1.5: '-1/(x - 3/2)**2' is a division by 0;"),
    "a pole between samples": (
        "-1e-9/(x - 1/pi)**2 - x",
        0,
        1,
        "near x = 0.31831: '-1e-9/(x - 1/pi)**2' is a division by a number that is not proven to be other than zero;",
    ),
    "a pole behind which it would be higher": (
        "-x - tan(x)",
        0,
        3,
        "near x = 1.5708: 'tan(x)' is the tangent of a number that is not proven to be away from its poles;",
    ),
    "a gap that is filled": ("sin(x)/x - x", 0, 1, "at x = 0: 'sin(x)/x' is a division by 0;"),
    "a turn that is too sharp": (
        "-x - 1e-21/((x - 1/3)**2 + 1e-20)",
        0,
        1,
        "has a pole near x = 0.333333 or bends there within less than 2^-40 of its way;",
    ),
    "a logarithm to its end": ("log(x)", 1, 0, "is not real and finite at x = 0: 'log(x)' is the logarithm of 0;"),
    "a start that bends at once": (
        "-x**2 - 1e-26*x",
        0,
        1,
        "bends at its start within less than 2^-80 of its way, so small is its slope beside its curvature there;",
    ),
    "an arc sine from its end": ("asin(x)", 1, 0, "with a finite slope at its start"),
    "a cusp of another kind": ("x = p**2; y = 1 - p**3", 0, 1, "otherwise than in a cusp as the cycloid's"),
    "a cusp that is no cusp": ("x = p**3; y = 1 - p**3", 0, 1, "otherwise than in a cusp as the cycloid's"),
    "a cusp that is not known to be exact": (
        "x = 1 - cos(p - exp(1)); y = cos(p - exp(1))",
        "exp(1)",
        4,
        "otherwise than in a cusp as the cycloid's",
    ),
    "a pole at the start that cancels": (
        "x + tan(pi/2 + x*0)",
        1,
        0,
        "'tan(pi/2 + x*0)' is the tangent of a number that is not proven to be away from its poles;",
    ),
    "an end too near to the start's level": (
        "x + 1e-9/(x + 1e-9)",
        1,
        0,
        "comes to rest, or too near to it to be told apart.",
    ),
    "a cusp on the way": ("x = (p - 1/2)**2; y = -(p - 1/2)**3", 0, 1, "(x' = y' = 0) near p = 0.5"),
    "a cusp at the end": ("x = cos(p)**3; y = sin(p)**3", "1.5", 0, "(x' = y' = 0) near p ="),
    "no way at all": ("x", 1, "2/2", "has the same start and end"),
    "a way too short to be seen": ("x", "pi", "pi - 1e-300", "has ends that are not proven with 256 bits to differ;"),
    "an end that is not real": ("x", "sqrt(-1)", 0, "does not start at a finite real number: 'sqrt(-1)' is the square"),
    "an end that is not finite": ("x", 0, "log(0)", "does not end at a finite real number: 'log(0)' is the logarithm"),
    "an end that cancels": ("x", "1 + acos(2) - acos(2)", 0, "does not start at a finite real number: 'acos(2)' is"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_curve_that_no_body_at_rest_slides_down_is_refused_in_one_sentence(name):
    formula, start, end, why = REFUSED[name]
    with pytest.raises(ValueError, match=r"^curve '.*\.$") as refusal:
        Descent(formula, start=start, end=end)
    assert why in str(refusal.value)
    assert str(refusal.value).count(". ") == 0


INPUTS = {
    "an unknown name": ({"curve": "quartik"}, ValueError, "perhaps quartic or quarter_ellipse; accepted are line,"),
    "no text": ({"curve": 3}, TypeError, "curve is of type int"),
    "no start": ({"curve": "x", "end": 0}, ValueError, "a formula; it needs the start of its x"),
    "no end": ({"curve": "x = p; y = p", "start": 1}, ValueError, "a formula; it needs the end of its p"),
    "ends of a known curve": ({"curve": "line", "end": 0}, ValueError, "whose ends are known"),
    "a strange name": ({"curve": "z = p", "start": 1, "end": 0}, ValueError, "curve is 'z = p'; a height such as"),
    "x twice": ({"curve": "x = p; y = p; x = p", "start": 1, "end": 0}, ValueError, "a height such as"),
    "two signs": ({"curve": "y = x = 1", "start": 1, "end": 0}, ValueError, "a height such as"),
    "no y": ({"curve": "x = p", "start": 1, "end": 0}, ValueError, "without a formula of y"),
    "x of x": (
        {"curve": "x = x; y = p", "start": 1, "end": 0},
        ValueError,
        "the name 'x' is unknown, perhaps exp; accepted are p",
    ),
    "p of a height": ({"curve": "2*p", "start": 1, "end": 0}, ValueError, "accepted are x, pi."),
    "a variable end": ({"curve": "x", "start": "2*x", "end": 0}, ValueError, "start '2*x': the name 'x' is unknown"),
    "no gravity": ({"curve": "line", "g": 0}, ValueError, "g is 0.0; a positive number"),
    "no number": ({"curve": "line", "g": math.nan}, ValueError, "g is nan, which is not finite"),
    "released at the end": ({"curve": "line", "released": 1}, ValueError, "released is 1.0; a fraction of the way"),
    "released before": ({"curve": "line", "released": -0.5}, ValueError, "released is -0.5; a fraction of the way"),
    "released on a level": (
        {"curve": "-x - 2*sin(x)", "start": 0, "end": 6, "released": 0.5},
        ValueError,
        "rises from its start",
    ),
    "another end": ({"curve": "line", "to": (0, 1)}, ValueError, r"to is (0, 1), but curve 'line' ends at (0, 0)."),
    "no end point": ({"curve": "line", "to": 3}, ValueError, "to is 3; a point (x, y) is accepted"),
}


@pytest.mark.parametrize("name", INPUTS)
def test_an_input_that_is_none_is_refused_in_one_sentence(name):
    given, error, why = INPUTS[name]
    with pytest.raises(error, match=r"\.$") as refusal:
        Descent(**given)
    assert why in str(refusal.value)


def test_the_end_asked_for_may_be_written_in_binary64():
    assert Descent("2*x/pi - 2", start=0, end="-pi", to=(-math.pi, -4)) == Descent("2*x/pi - 2", start=0, end="-pi")
    assert Descent("quartic", to=("0", Fraction(0)))


@pytest.mark.parametrize("row", ["state", "motion"])
def test_a_time_outside_of_the_descent_is_refused_with_the_descent_time(row):
    problem = Descent("quartic")
    for t in (-1, 1.0157, 2, "1e300"):
        sentence = rf"^t is .*; a time from 0 to the descent time of {'Descent'}\('quartic', g=9\.81\), 1\.0156 s, is"
        with pytest.raises(ValueError, match=sentence):
            problem.along(row, [0.5, t])
        with pytest.raises(ValueError, match=sentence):
            problem.by_route("quadrature", row, [Fraction(t)], 50)
    last = Fraction(problem.descent_time().digits(100)) - Fraction(1, 10**60)
    assert problem.along("motion", last)[1] == pytest.approx(0, abs=1e-200)
    with pytest.raises(ValueError, match="a time from 0 to the descent time"):
        problem.state(last + Fraction(2, 10**60))


def test_a_place_outside_of_the_way_is_refused():
    with pytest.raises(ValueError, match=r"^fraction is 1\.5; a fraction of the way from 0\.0 to 1 is accepted\.$"):
        Descent("line").along("passage", 1.5)
    with pytest.raises(ValueError, match=r"a fraction of the way from 0\.5 to 1 is accepted\.$"):
        Descent("line", released=0.5).along("passage", 0.25)


@pytest.mark.parametrize("formula", ["-x**2", "-x", "-pi*x", "-(x)"])
def test_a_formula_that_begins_with_a_minus_is_taken_after_an_equals_sign(formula, capsys):
    """As an option's own word it is refused with the way to write it; -2*x begins as a number, and is taken."""
    ends = ["--start", "1", "--end", "2", "--digits", "5"]
    assert run(main, ["at", "descent", "--curve", formula, *ends]) == 2
    assert capsys.readouterr().err.endswith("; a value that begins with a minus is written --OPTION=VALUE.\n")
    assert run(main, ["at", "descent", f"--curve={formula}", *ends]) == 0
    assert f"curve = {formula}\n" in capsys.readouterr().out
    assert run(main, ["at", "descent", "--curve", "-2*x", *ends]) == 0


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--curve", "x+acos(2)", "--start", "1", "--end", "0"], "is not real and finite: 'acos(2)' is the arc cosine"),
        (["--curve", "x", "--start", "acos(2)", "--end", "0"], "does not start at a finite real number: 'acos(2)' is"),
        (["--curve", "x" + "+x" * 50_000, "--start", "1", "--end", "0"], "has 100001 characters; at most 1000 are"),
    ],
)
def test_what_is_refused_is_refused_at_the_command_line_in_one_sentence(words, why, capsys):
    assert run(main, ["at", "descent", *words]) == 2
    printed = capsys.readouterr()
    assert why in printed.err
    assert printed.err.count("\n") == 1
    assert not printed.out
