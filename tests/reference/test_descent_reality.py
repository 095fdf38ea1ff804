"""A curve is admitted if it is proven to be real and finite on all of its way, whatever its derivatives leave out."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import TYPE_CHECKING

import pytest

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.problems.descent.clock import MAX_DISCS, pieces
from reference.problems.descent.curves import spelled_curve
from reference.problems.descent.problem import Descent
from reference.problems.descent.reality import unreal

if TYPE_CHECKING:
    from reference.arithmetic.formula import Expression

UNREAL = {
    "x+acos(2)": "is not real and finite: 'acos(2)' is the arc cosine of 2;",
    "x+log(-1)": "is not real and finite: 'log(-1)' is the logarithm of -1;",
    "x+tan(pi/2)": "could not be proven to be real and finite: 'tan(pi/2)' is the tangent of a number that is",
    "x+1/sin(0)": "is not real and finite: '1/sin(0)' is a division by 0;",
    "3*x-sqrt(1-2)": "is not real and finite: 'sqrt(1-2)' is the square root of -1;",
    "x + (acos(2) - acos(2))": "'acos(2)' is the arc cosine of 2;",
    "x + 0*log(-1)": "'log(-1)' is the logarithm of -1;",
    "x + acos(2)**0": "'acos(2)' is the arc cosine of 2;",
    "x + (-8)**(1/3)": "'(-8)**(1/3)' is a fractional power of -8;",
    "3*x + log(x - 5)": "is not real and finite at x = 1: 'log(x - 5)' is the logarithm of -4;",
    "x + log(x - 1/2)**0": "'log(x - 1/2)' is the logarithm of",
    "x = p + acos(2); y = p": "'acos(2)' is the arc cosine of 2;",
    "x = p; y = p + log(-1)": "'log(-1)' is the logarithm of -1;",
    "x + exp(exp(exp(exp(exp(5)))))": "'exp(exp(exp(exp(5))))' is a number that is not proven to be finite;",
}


@pytest.mark.parametrize("text", UNREAL)
def test_a_curve_that_is_not_real_is_refused_with_the_part_that_is_not(text):
    with pytest.raises(
        ValueError, match=r"^curve '.*; a curve that is real and finite on all of its way is accepted\.$"
    ) as no:
        Descent(text, start=1, end=0)
    assert UNREAL[text] in str(no.value)
    assert str(no.value).count(". ") == 0


LEGAL = {
    "x + acos(1)": "x",
    "x + asin(1)**2 + sqrt(0)": "x",
    "x*asin(1)": "x*pi/2",
    "x**3 + x + acos(1)": "x**3 + x",
    "x + log(exp(x))**0": "x",
    "(x+1)**2-x**2-x": "x + 1",
    "sin(x)**2 + cos(x)**2 + x": "x",
}


@pytest.mark.parametrize("text", LEGAL)
def test_a_curve_that_is_real_is_admitted_however_it_is_written(text):
    descents = [Descent(formula, start=5, end=0) for formula in (text, LEGAL[text])]
    one, other = (problem.descent_time().limbs(3) for problem in descents)
    assert one == other


@pytest.mark.parametrize("end", [10, 1000, 100_000])
def test_a_line_is_one_piece_however_long_its_way_and_its_formula(end):
    problem = Descent("(x+1)**2-x**2-x", 10, start=end, end=0)
    assert len(pieces(problem.slide, "slowness")) == 1
    assert problem.descent_time().limbs(3) == Descent("x", 10, start=end, end=0).descent_time().limbs(3)


def test_a_curve_that_falls_by_little_of_its_height_is_served():
    """Its drop is lost in the first precision of the chart."""
    problem = Descent("1 + 1e-30*(x + x**2)", "2e-30", start=1, end=0)
    with mp.workdps(30):
        expected = mp.quad(lambda u: 2 / mp.sqrt(4 * (3 - u * u)), [0, 1]) / mp.mpf("1e-30")
    assert float(problem.descent_time()) == pytest.approx(float(expected), rel=1e-14)
    with pytest.raises(
        ValueError, match="is not proven with 256 bits to end lower; an end below the start is accepted"
    ):
        Descent("1 + 1e-90*x", start=1, end=0)


def test_a_start_that_is_almost_level_is_served():
    """The time down y = -x^2 - s x is the integral of sqrt((1 + (2 x + s)^2)/(2 g x (x + s)))."""
    problem = Descent("-x**2-1e-12*x", 1, start=0, end=1)
    with mp.workdps(40):
        s = mp.mpf("1e-12")

        def rate(z):
            """By x = s sinh(z)^2."""
            return mp.sqrt(2 * (1 + (2 * s * mp.sinh(z) ** 2 + s) ** 2))

        end = mp.asinh(1 / mp.sqrt(s))
        expected = mp.quad(rate, [end * mp.mpf(k) / 16 for k in range(17)])
    assert float(problem.descent_time()) == float(expected)


def test_a_comb_is_served():
    """By x = u^2, and by the mean sin(1000 x)/(1000 x) of the slope up to x."""
    problem = Descent("-x+sin(1000*x)/2000", "1/2", start=0, end="1/32")
    with mp.workdps(30):

        def rate(u):
            x = u * u
            return 2 * mp.sqrt((1 + (1 - mp.cos(1000 * x) / 2) ** 2) / (1 - mp.sinc(1000 * x) / 2))

        end = mp.sqrt(mp.mpf(1) / 32)
        expected = mp.quad(rate, [end * mp.mpf(k) / 16 for k in range(17)])
    assert float(problem.descent_time()) == float(expected)


def test_a_refusal_for_the_work_says_what_the_bounds_are_and_how_far_they_reached(monkeypatch):
    for module in ("clock", "admission"):
        monkeypatch.setattr(f"reference.problems.descent.{module}.MAX_OPERATIONS", 2000)
    sentence = (
        rf"^curve '.*' could not be proven to be smooth from x = 0\.\d+ on within the bounds on the work, "
        rf"{MAX_DISCS} pieces tried and 2000 operations; a shorter way, fewer bends or a shorter formula is accepted\.$"
    )
    with pytest.raises(ValueError, match=sentence):
        Descent("-x + sin(100*x)/200", start=0, end=1)


SEED = 1743
FUNCTIONS = {"sqrt": 0.2, "log": 0.3, "acos": 0.4, "asin": -0.3, "tan": 0.5, "exp": 0.1}


def random_curve(rng: random.Random) -> str:
    """A falling curve with a function of a random argument, which may leave its domain, somewhere in it."""
    name = rng.choice([*FUNCTIONS])
    inner = rng.choice(
        ["x", "x/2 - {a}", "{a} - x", "{a}", "sin({b}*x) + {a}", "x**2 - {a}", "1/(x - {a})", "cos(pi*{a})"]
    )
    inner = inner.format(a=Fraction(rng.randint(-20, 20), 10), b=rng.randint(1, 5))
    part = f"{name}({inner})"
    return rng.choice(
        [f"-x + {part}/100", f"-x - 0*{part}", f"-2*x + ({part} - {part})", f"-x + {part}**0", f"{part} - 3*x"]
    )


def real_at(formula: Expression, x: Fraction) -> bool:
    """Whether mpmath finds real numbers for every part: complex, infinite or no numbers show in one of them."""
    values = []
    for term in formula.terms:
        count = len(values) - term.arity
        try:
            value = term.of(MPMATH, MPMATH.number(x), *values[count:])
        except (ZeroDivisionError, ValueError):
            return False
        if isinstance(value, mp.mpc) or not mp.isfinite(value):
            return False
        values[count:] = [value]
    return True


def test_the_proof_of_reality_agrees_with_mpmath_on_random_curves():
    rng = random.Random(SEED)
    counts = {"real": 0, "not real": 0, "undecided": 0}
    for _ in range(300):
        text = random_curve(rng)
        curve = spelled_curve(text, 0, 1)
        found = unreal(curve, [Fraction(k, 16) for k in range(17)], Fraction(0))
        sampled = [Fraction(k, 64) for k in range(65)] if found is None else [found.w]
        with mp.workprec(200):
            everywhere = all(real_at(curve.y, x) for x in sampled)
        if found is None:
            assert everywhere, text
            counts["real"] += 1
        elif found.certain:
            assert not everywhere, (text, found.why)
            counts["not real"] += 1
        else:
            counts["undecided"] += 1
    assert counts["real"] > 80
    assert counts["not real"] > 80
    assert counts["undecided"] < 60
