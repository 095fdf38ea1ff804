"""The nonstiff DETEST: the proven end values against closed forms and another integrator, and what is conserved."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from functools import lru_cache

import pytest

from reference.__main__ import main
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.namespaces import MPMATH, NUMPY
from reference.arithmetic.precision import mp
from reference.flow_problem import is_known
from reference.problem import NO_TIME
from reference.problems.detest.a import DetestA1, DetestA2
from reference.problems.detest.c import DetestC5
from reference.problems.detest.e import DetestE5
from reference.problems.detest.family import DETEST, FAMILIES
from reference.routes.proven_flow import STEPS, ProvenFlow

END = 20
KINDS = {kind.name.removeprefix("detest-"): kind for kind in DETEST}
EARLIER = {
    **dict.fromkeys(("b1", "b4", "c4", "c5", "e2", "e3"), 7),
    **dict.fromkeys(("d1", "d2", "d3", "d4"), 3),
    "d5": 7,
}
"""Until then the slowest proofs are held here, for the sake of speed; the others to the end."""
BITS = {"c4": 208}
"""More bits have a higher order, which takes so few steps of many components that it is faster."""


def until(name):
    return EARLIER.get(name, END)


@lru_cache(maxsize=32)
def proven(name):
    """The state as midpoints and radii, of a proof in few bits."""
    flow = ProvenFlow(KINDS[name](), BITS.get(name, 112), STEPS)
    return [
        (mp.mpf(one.mid().str(60, radius=False)), mp.mpf(float(one.rad()))) for one in flow.at(Fraction(until(name)))
    ]


def assert_held(name, expected):
    """The balls hold what is expected, and are small."""
    size = max(abs(value) for value in expected)
    for (middle, radius), value in zip(proven(name), expected, strict=True):
        assert radius < 1e-18 * size
        assert abs(middle - value) <= radius + abs(value) * mp.mpf("1e-34")


KNOWN = [name for name, kind in KINDS.items() if is_known(kind)]


def test_the_set_is_whole_and_each_family_is_named_after_its_problem():
    assert list(KINDS) == [f"{group}{i}" for group in "abcde" for i in range(1, 6)]
    assert [family.name for family in FAMILIES] == [kind.name for kind in DETEST]
    assert all(kind.t_end == END for kind in DETEST)
    assert all(kind.space.components == tuple(f"y{i + 1}" for i in range(len(kind.begins))) for kind in DETEST)
    assert {kind.difficulty.partition(":")[0] for kind in DETEST} == {"lower", "average", "higher"}


@pytest.mark.parametrize("name", KNOWN)
def test_the_end_is_that_of_the_closed_form(name):
    with mp.workdps(60):
        assert_held(name, KINDS[name]().known_state(mp.mpf(until(name))))


def test_all_but_four_have_a_closed_form():
    assert [name for name in KINDS if name not in KNOWN] == ["b1", "c5", "e2", "e3"]


@pytest.mark.parametrize("name", KNOWN)
def test_the_closed_form_solves_the_equation_from_the_start(name):
    """By differences of it, at another time than the end."""
    problem = KINDS[name]()
    with mp.workdps(60):
        p, t, h = problem.parameters_in(MPMATH), mp.mpf(3) / 4, mp.mpf("1e-20")
        for value, expected in zip(problem.known_state(mp.mpf(0)), problem.start_in(MPMATH), strict=True):
            assert abs(value - expected) < mp.mpf("1e-50")
        before, at, after = (problem.known_state(time) for time in (t - h, t, t + h))
        rates = problem.derivative(MPMATH, t, at, p)
        for low, high, rate in zip(before, after, rates, strict=True):
            assert abs((high - low) / (2 * h) - rate) < mp.mpf("1e-30")


@pytest.mark.parametrize("name", [name for name in KINDS if name not in KNOWN])
def test_an_end_without_a_closed_form_is_that_of_another_integrator(name):
    (expected,) = KINDS[name]().by_route("taylor", "state", [until(name)], 36)
    with mp.workdps(60):
        assert_held(name, [mp.mpf(one.numerator) / one.denominator for one in expected])


def gradients(problem, y):
    """The rates, and each invariant's slope along them."""
    duals = DualArithmetic(MPMATH, len(y))
    state = [duals.variable(value, i) for i, value in enumerate(y)]
    p = problem.parameters_in(MPMATH)
    rates = [mp.mpf(one) for one in problem.derivative(MPMATH, NO_TIME, y, p)]
    for invariant in problem.invariants:
        found = getattr(problem, invariant.value)(duals, state, p)
        assert isinstance(found, Dual)
        terms = [slope * rate for slope, rate in zip(found.slopes, rates, strict=True)]
        yield invariant.name, mp.fsum(terms), mp.fsum(map(abs, terms))


@pytest.mark.parametrize("name", [name for name, kind in KINDS.items() if kind.invariants])
def test_what_is_conserved_does_not_change_along_the_equation_wherever_it_is(name):
    problem, near = KINDS[name](), random.Random(name)
    with mp.workdps(40):
        start = problem.start_in(MPMATH)
        y = [value + mp.mpf(near.uniform(0.05, 0.2)) for value in start]
        for invariant, along, size in gradients(problem, y):
            assert size > 0, invariant
            assert abs(along) < mp.mpf("1e-36") * size, invariant


@pytest.mark.parametrize("name", [name for name, kind in KINDS.items() if kind.invariants])
def test_what_is_conserved_is_later_what_it_was(name):
    problem = KINDS[name]()
    with mp.workdps(40):
        p, end = problem.parameters_in(MPMATH), [middle for middle, _ in proven(name)]
        for one in problem.invariants:
            begun, now = (getattr(problem, one.value)(MPMATH, y, p) for y in (problem.start_in(MPMATH), end))
            assert abs(now - begun) < 1e-14 * abs(begun), one.name


def test_the_planets_keep_the_centre_of_mass_with_the_sun():
    """The sun, to which positions count, is pulled by them as much as they are."""
    problem = DetestC5()
    p = problem.parameters_in(NUMPY)
    y = problem.start_in(NUMPY)
    rates = problem.derivative(NUMPY, NO_TIME, y, p)
    masses = [p[f"m{i}"] for i in range(1, 6)]
    for k in range(3):
        cubes = [sum(y[3 * i + j] ** 2 for j in range(3)) ** 1.5 for i in range(5)]
        sun = p["k2"] * sum(masses[i] * y[3 * i + k] / cubes[i] for i in range(5))
        total = p["m0"] * sun + sum(masses[i] * (rates[15 + 3 * i + k] + sun) for i in range(5))
        assert abs(total) < 1e-15 * abs(sun)


def test_values_that_are_rational_are_given_exactly():
    assert DetestE5().exact_row("state", Fraction(20)) == (None, Fraction(12, 5))
    assert DetestE5().certified("state", 20, 1).digits(40) == "2.4" + "0" * 38
    assert DetestE5(y2="3/4").exact_row("state", Fraction(5)) == (None, Fraction(21, 20))
    assert DetestE5(y2=1).exact_row("state", Fraction(20)) is None
    assert DetestA2().certified("state", 3).digits(30) == "0.5" + "0" * 29
    assert DetestA2().exact_row("state", Fraction(20)) is None
    assert DetestA2().exact_row("state", Fraction(-1)) is None


def test_another_start_of_the_pursuit_is_proven_about_its_rational_velocity():
    begun = DetestE5(y2="3/4")
    exact = begun.exact_row("state", Fraction(5))[1]
    with mp.workdps(40):
        (found,) = begun.by_route("taylor", "state", [5], 20)
        assert abs(found[1] - exact) < Fraction(1, 10**19)


def test_a_family_answers_at_the_command_line(capsys):
    assert main(["at", "detest-a1", "--t", "20", "--digits", "36", "--exact", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    with mp.workdps(60):
        assert found["y1"] == mp.nstr(mp.exp(-20), 36, min_fixed=0, max_fixed=0)
    assert DetestA1().certified("state", 20).digits(36) == found["y1"]


def test_a_step_too_long_for_the_derivative_of_its_map_is_made_shorter():
    """In so many bits the first step is so long that the derivative is known to no digit."""
    flow = ProvenFlow(KINDS["b2"](), 1036, STEPS)
    assert all(one.rel_accuracy_bits() > 900 for one in flow.at(Fraction(1)))
