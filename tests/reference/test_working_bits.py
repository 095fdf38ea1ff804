"""What a flow loses, told beforehand: the same values after as few flows as can be, whatever is asked."""

# ruff: noqa: ARG001, ARG002 - equations take what they are given, and some make no use of it

from __future__ import annotations

from fractions import Fraction

import pytest

from reference import StateSpace
from reference.arithmetic.limbs import WorkBoundError
from reference.declaration import Invariant
from reference.flow_problem import FlowProblem
from reference.problems.families import find_family
from reference.routes import proven_flow
from reference.routes.agreement import agreement


def of(positions, velocities=()):
    return StateSpace(
        positions=positions, velocities=velocities, angles=(), odd=None, along=None, scale="units", independent=""
    )


class Toy(FlowProblem):
    numbers, invariants, t_end, source, difficulty = {"a": "1"}, (), 4, "made up", "lower: it is a test"


class Free(Toy):
    name, space, begins, equation = "free", of(("x", "v")), ("0", "1"), "x' = v, v' = 0"

    def derivative(self, m, t, y, p):
        return y[1], Fraction(0)


class Decays(Toy):
    name, space, begins, equation = "decays", of(("x", "y")), ("1", "1"), "x' = -x - y, y' = -y"

    def derivative(self, m, t, y, p):
        return -y[0] - y[1], -y[1]


class InThePlane(Toy):
    name, space, equation = "in-the-plane", of(("x", "y", "z"), ("u", "v", "w")), "q'' = -q/|q|^3, with z = 0"
    begins = ("1", "0", "0", "0", "1.1", "0")

    def derivative(self, m, t, y, p):
        square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2]
        cube = square * m.sqrt(square)
        return (*y[3:], *(-one / cube for one in y[:3]))


class Rational(Toy):
    name, space, begins, equation = "rational", of(("y",)), ("1",), "y' = -y^2, so that y = 1/(1 + t)"
    max_bits = 2000

    def derivative(self, m, t, y, p):
        return (-y[0] * y[0],)


class Grows(Toy):
    name, space, begins, equation = "grows", of(("x",), ("v",)), ("1", "-1/3"), "x'' = x"
    invariants, t_end = (Invariant("energy", ("energy", "(E - E0)/E0"), "start", "energy"),), 18

    def derivative(self, m, t, y, p):
        return y[1], y[0]

    def energy(self, m, y, p):
        return y[1] * y[1] - y[0] * y[0]


class HidesItsGrowth(Toy):
    name, space, begins, equation = "hides", of(("x", "v")), ("1", "-1/3"), "v' = 2 x/3 + 5 v/3; x = exp(-t/3)"
    t_end = 45

    def derivative(self, m, t, y, p):
        return y[1], 2 * y[0] / 3 + 5 * y[1] / 3


@pytest.fixture
def begun(monkeypatch):
    """The bits of each flow that is begun."""
    bits, begin = [], proven_flow.ProvenFlow.__init__

    def counting(self, equation, working, steps):
        bits.append(working)
        begin(self, equation, working, steps)

    for known in (proven_flow._flows, proven_flow._losses, proven_flow._horizons):
        known.cache_clear()
    monkeypatch.setattr(proven_flow.ProvenFlow, "__init__", counting)
    return bits


def test_balls_that_are_points_take_no_more_bits(begun):
    assert [Free().state(time).tolist() for time in (1, Fraction(1, 2))] == [[1, 1], [0.5, 1]]
    assert len(begun) == 1


@pytest.mark.parametrize(("problem", "component"), [(Decays(), 1), (InThePlane(), 0)])
def test_what_is_asked_again_is_there_whatever_stands_beside_it(problem, component, begun):
    """At t = 1 Decays is at x = 0, and InThePlane has always z = 0."""
    said = {problem.certified("state", 1, component).digits(20) for _ in range(4)}
    assert len(said) == 1
    assert len(begun) == 1


def test_bits_grow_by_half_where_none_are_missing(begun):
    """1/2 is half way between two whole numbers, and nothing says that it is rational."""
    with pytest.raises(WorkBoundError, match=r"could not be decided with 2000 bits"):
        Rational().certified("state", 1).fixed(0)
    assert len(begun) <= 9
    assert begun == sorted(begun)


@pytest.mark.parametrize(("name", "time"), [("duffing", 10**6), ("kepler", 150_000), ("kepler", "1e400")])
def test_a_time_that_takes_too_many_steps_is_refused_after_some(name, time, begun):
    refused = r"is proven to t = [\d.]+ in 64 steps, and would take more than the 32768 that are granted"
    with pytest.raises(WorkBoundError, match=refused):
        find_family(name).problem().state(time)
    assert len(begun) == 1


@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_an_invariant_that_is_a_difference_of_large_terms_agrees(route):
    (found,) = agreement(Grows(), "conserved", [0], route)
    assert found.digits == 50


def test_ends_are_foreseen_as_other_times_are(begun):
    first, again = (HidesItsGrowth().certified("end", 1).routes for _ in range(2))
    assert first == again
    assert first["taylor"] == 50


def test_a_time_before_the_start_is_foreseen_there(begun):
    problem = find_family("kepler").problem()
    problem.state(-40, 3)
    assert set(proven_flow._losses(problem)) == {-1}
    problem.state([-3, 3])
    assert set(proven_flow._losses(problem)) == {-1, 1}


def test_what_is_refused_by_the_route_is_not_proven_for_it(begun):
    assert find_family("detest-a2").problem().by_route("taylor", "state", [-1], 50) is None
    assert begun == []


def test_no_flow_is_proven_for_a_row_that_its_start_proves(begun):
    mu, x, v = 0.012277471, 0.994, 2.00158510637908252240537862224
    jacobi = x**2 + 2 * (1 - mu) / (x + mu) + 2 * mu / abs(x - 1 + mu) - v**2
    found = find_family("arenstorf").problem().certified("conserved", 0).digits(12)
    assert float(found) == pytest.approx(jacobi, rel=1e-10)
    assert begun == []
