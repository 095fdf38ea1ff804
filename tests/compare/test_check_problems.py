"""compare.check on other problems than the pendulum: degrees of freedom, negative energies, forces in time, curves."""

# ruff: noqa: ARG002, ARG004 - equations take what they are given, and some make no use of it

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar

import numpy as np
import pytest
import slips

import compare
from compare.claims import show
from compare.claims.frames import NUMPY, Frame, Scene
from compare.show.render import render
from reference import CycloidArc, Descent, Pendulum, PolarBrachistochrone, Tautochrone
from reference.declaration import ClosedForm, Invariant, Quantity, Row, StateSpace, Trial
from reference.problem import Problem, SeparableProblem
from reference.row_domains import TIME


def states(space: StateSpace) -> tuple[Row, ...]:
    return (Row("state", tuple(Quantity(name, "1", name, "its equation") for name in space.components), TIME),)


def space_of(positions: str, rates: str, **declared: Any) -> StateSpace:
    odd = tuple(rates.split())
    given: dict[str, Any] = {"odd": odd, "along": None, "scale": "units", "independent": "", "angles": (), **declared}
    return StateSpace(positions=tuple(positions.split()), **given)


class Circle(ClosedForm):
    """x = r cos t, y = r sin t, z = 0 if there is a third coordinate."""

    def __init__(self, m: Any, r: Any, dimensions: int) -> None:
        self.m, self.r, self.dimensions = m, r, dimensions

    def state(self, t: Any) -> tuple[Any, ...]:
        c, s = self.r * self.m.cos(t), self.r * self.m.sin(t)
        zeros = (0 * t,) * (self.dimensions - 2)
        return c, s, *zeros, -s, c, *zeros


@dataclass(frozen=True, repr=False)
class Kepler(SeparableProblem):
    """A planet on a circle of radius r with r^3 for G M: its energy is negative, and its neighbour has another G M."""

    radius: Fraction = Fraction(1)

    name: ClassVar[str] = "circular kepler"
    space: ClassVar[StateSpace] = space_of("x y", "px py", momenta=("px", "py"))
    invariants: ClassVar[tuple[Invariant, ...]] = (Invariant("energy", ("Energy", "(E - E0)/|E0|"), "start"),)
    rows: ClassVar[tuple[Row, ...]] = states(space)
    trial: ClassVar[Trial] = Trial(states=((0.5, 1.0),) * 4, parameters={"gm": (0.5, 2.0)}, step=(0.001, 0.01))

    def __repr__(self) -> str:
        return f"Kepler({self.radius})"

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"gm": self.radius**3}

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"radius": (float(self.radius), "")}

    @property
    def start(self) -> tuple[Fraction, ...]:
        radius, size = self.radius, len(self.space.positions)
        zeros = (Fraction(0),) * (size - 2)
        return radius, Fraction(0), *zeros, Fraction(0), radius, *zeros

    @staticmethod
    def velocity(m: Any, momenta: Any, p: dict[str, Any]) -> tuple[Any, ...]:
        return tuple(momenta)

    @staticmethod
    def force(m: Any, t: Any, positions: Any, p: dict[str, Any]) -> tuple[Any, ...]:
        square = sum(q * q for q in positions)
        pull = -p["gm"] / (square * m.sqrt(square))
        return tuple(pull * q for q in positions)

    @staticmethod
    def invariant(m: Any, y: Any, p: dict[str, Any]) -> Any:
        half = len(y) // 2
        return sum(v * v for v in y[half:]) / 2 - p["gm"] / m.sqrt(sum(q * q for q in y[:half]))

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        if argument == 0:
            return self.start
        return None if len(self.start) == 4 else (None, None, Fraction(0), None, None, Fraction(0))

    def closed_form(self, m: Any) -> ClosedForm:
        return Circle(m, m.number(self.radius), len(self.space.positions))


@dataclass(frozen=True, repr=False)
class KeplerInSpace(Kepler):
    """The same with a third coordinate, which stays zero."""

    name: ClassVar[str] = "kepler in space"
    space: ClassVar[StateSpace] = space_of("x y z", "px py pz", momenta=("px", "py", "pz"))
    rows: ClassVar[tuple[Row, ...]] = states(space)
    trial: ClassVar[Trial] = Trial(states=((0.5, 1.0),) * 6, parameters={"gm": (0.5, 2.0)}, step=(0.001, 0.01))


@dataclass(frozen=True, repr=False)
class Forced(SeparableProblem):
    """x'' = -x + cos 2t from (x0, 0): x = (x0 + 1/3) cos t - cos(2t)/3."""

    x0: Fraction = Fraction(1)

    name: ClassVar[str] = "forced"
    autonomous: ClassVar[bool] = False
    space: ClassVar[StateSpace] = space_of("x", "v", velocities=("v",))
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    rows: ClassVar[tuple[Row, ...]] = states(space)
    trial: ClassVar[Trial] = Trial(states=((-1.0, 1.0),) * 2, parameters={}, step=(0.001, 0.01))

    def __repr__(self) -> str:
        return f"Forced({self.x0})"

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {}

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"x0": (float(self.x0), "")}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.x0, Fraction(0)

    @staticmethod
    def velocity(m: Any, momenta: Any, p: dict[str, Any]) -> tuple[Any, ...]:
        return tuple(momenta)

    @staticmethod
    def force(m: Any, t: Any, positions: Any, p: dict[str, Any]) -> tuple[Any, ...]:
        return (-positions[0] + m.cos(2 * t),)

    def closed_form(self, m: Any) -> ClosedForm:
        return TwoCosines(m, m.number(self.x0))


class TwoCosines(ClosedForm):
    def __init__(self, m: Any, x0: Any) -> None:
        self.m, self.own = m, x0 + m.number(Fraction(1, 3))

    def state(self, t: Any) -> tuple[Any, ...]:
        m, third = self.m, self.m.number(Fraction(1, 3))
        return self.own * m.cos(t) - third * m.cos(2 * t), -self.own * m.sin(t) + 2 * third * m.sin(2 * t)


@dataclass(frozen=True, repr=False)
class Decay(Problem):
    """y' = -y: of first order, without momenta, a way back, or anything that is conserved."""

    y0: Fraction = Fraction(1)

    name: ClassVar[str] = "decay"
    space: ClassVar[StateSpace] = space_of("y", "", odd=None)
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    rows: ClassVar[tuple[Row, ...]] = states(space)
    trial: ClassVar[Trial] = Trial(states=((0.5, 1.0),), parameters={}, step=(0.001, 0.01))

    def __repr__(self) -> str:
        return f"Decay({self.y0})"

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {}

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"y0": (float(self.y0), "")}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return (self.y0,)

    def derivative(self, m: Any, t: Any, y: Any, p: dict[str, Any]) -> tuple[Any, ...]:
        return (-y[0],)

    def closed_form(self, m: Any) -> ClosedForm:
        return Exponential(m, m.number(self.y0))


class Exponential(ClosedForm):
    def __init__(self, m: Any, y0: Any) -> None:
        self.m, self.y0 = m, y0

    def state(self, t: Any) -> tuple[Any, ...]:
        return (self.y0 * self.m.exp(-t),)


def verlet(q, p, force, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def verlet_one_by_one(q, p, force, h):
    """What cannot be traced, nor run on arrays."""
    q, p = verlet(np.array([float(x) for x in q]), np.array([float(x) for x in p]), force, float(h))
    return q, p


def verlet_in_time(f, t, y, h):
    half = len(y) // 2
    q, p = y[:half], y[half:]
    p = p + h / 2 * f(t, np.concatenate([q, p]))[half:]
    q = q + h * p
    return np.concatenate([q, p + h / 2 * f(t + h, np.concatenate([q, p]))[half:]])


def implicit_midpoint(f, y, h):
    new = y + h * f(y)
    for _ in range(60):
        new = y + h * f((y + new) / 2)
    return new


def idle(f, t, y, h):
    return y + 0 * h * f(t, y)


@pytest.mark.parametrize("problem", [Kepler(), KeplerInSpace()])
@pytest.mark.parametrize("step", [verlet, verlet_one_by_one])
def test_verlet_keeps_the_form_of_several_degrees_of_freedom_and_goes_back(problem, step):
    found = compare.check(step, order=2, symplectic=True, reversible=True, problem=problem)
    assert found.claims_hold, found.verdict
    assert found.symplecticity_defect < 1e-12
    assert found.reversibility_defect < 1e-12
    assert found.energy.behaviour in {"bounded", "rounding"}
    assert 0 <= found.energy.largest < 0.1


PROBLEMS = [
    Kepler(),
    KeplerInSpace(),
    Tautochrone(1.0),
    Descent("quartic"),
    Descent("circular_arc"),
    PolarBrachistochrone(z0="1/2"),
]


@pytest.mark.parametrize("problem", PROBLEMS, ids=repr)
def test_rk4_has_order_four_and_is_not_symplectic(problem):
    found = compare.check(slips.rk4, order=4, problem=problem)
    assert found.claims_hold, found.verdict
    assert found.measured_order == pytest.approx(4, abs=0.05)
    assert not found.symplecticity.none
    assert not found.reversibility.none
    assert "not symplectic" in found.verdict


@pytest.mark.parametrize("problem", PROBLEMS, ids=repr)
def test_a_slip_is_caught_on_any_problem(problem):
    assert compare.check(slips.full_step_for_half, order=4, problem=problem).claims_hold is False


def test_the_way_an_integrator_is_run_does_not_change_what_is_found():
    """Tautochrone's form in angle and velocity has a mass in it, the polar one a component beyond its pair."""
    for problem in (Tautochrone(1.0), PolarBrachistochrone(z0="1/2")):
        once = compare.check(slips.rk4, problem=problem)
        whole = compare.check(slips.rk4_over_a_grid, problem=problem)
        assert (once.engine, whole.engine) == ("compiled", "whole")
        assert whole.reversibility_defect == pytest.approx(once.reversibility_defect, rel=0.1)
        assert once.symplecticity_defect < whole.symplecticity_defect < 100 * once.symplecticity_defect


def test_volume_is_not_symplecticity():
    """A step that turns the planes of x, y and of px, py against each other keeps the volume of phase space."""

    def turned(f, y, h):
        q, p = verlet(y[:2], y[2:], lambda q: f(np.concatenate([q, 0 * q]))[2:], h)
        turn = h**3
        return np.array([q[0] + turn * q[1], q[1], p[0] + turn * p[1], p[1]])

    found = compare.check(turned, symplectic=True, problem=Kepler())
    assert found.claims_hold is False
    assert "claims to be symplectic, not symplectic" in found.verdict


def test_a_method_that_keeps_the_plain_form_does_not_keep_that_of_a_mass_that_varies():
    found = compare.check(implicit_midpoint, order=2, symplectic=True, problem=Tautochrone(1.0))
    assert found.order_holds
    assert found.claims_hold is False
    assert found.symplecticity_defect > 1e-4
    assert found.reversibility.none


def test_a_force_in_time_takes_a_step_that_gives_it():
    found = compare.check(verlet_in_time, order=2, symplectic=True, reversible=True, problem=Forced())
    assert found.claims_hold, found.verdict
    assert compare.check(slips.rk4_in_time, order=4, problem=Forced()).claims_hold
    assert compare.check(slips.stages_at_the_wrong_times, order=4, problem=Forced()).claims_hold is False


def test_what_a_problem_does_not_declare_is_named_and_no_claim_of_it_is_established():
    found = compare.check(slips.rk4, order=4, symplectic=True, reversible=True, problem=Decay())
    assert found.claims_hold is None
    for sentence in (
        "claims to be symplectic, not applicable: Decay(1) declares no momenta, nor an energy that tells them; ",
        "claims to be reversible, not applicable: Decay(1) declares no way back in time; ",
        "energy not applicable: Decay(1) conserves nothing that is declared",
    ):
        assert sentence in found.verdict
    told = json.loads(render(show.page(found), "json"))
    assert (told["symplectic"], told["symplecticity_defect"], told["reversible"]) == (None, None, None)
    assert set(told["not_applicable"]) == {"symplectic", "reversible", "energy"}
    assert told["not_applicable"]["energy"] == "Decay(1) conserves nothing that is declared"
    assert told["energy"]["behaviour"] == "none"
    assert compare.check(slips.rk4, order=4, problem=Decay()).claims_hold
    assert "not_applicable" not in json.loads(render(show.page(compare.check(slips.euler)), "json"))


REFUSED = {
    "a curve": (slips.rk4, CycloidArc(1), "a curve along y; a motion in time, such as Pendulum"),
    "no time": (slips.rk4, Forced(), "the step gives f no time, on which Forced(1) depends; f(t, y) is accepted"),
    "no split": (
        verlet,
        Tautochrone(1.0),
        "takes (q, p, force, h), but Tautochrone(angle=1.0, radius=1.0, g=9.81) does",
    ),
    "a force in time": (verlet, Forced(), "but the force of Forced(1) depends on the time, which is not given"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_a_problem_has_no_place_for_is_refused_in_one_sentence(case):
    step, problem, sentence = REFUSED[case]
    with pytest.raises(ValueError, match=r".*") as raised:
        compare.check(step, problem=problem)
    assert sentence in str(raised.value)
    assert str(raised.value).endswith(".")
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    "problem", [Pendulum(1.0), Kepler(), Forced(), PolarBrachistochrone(z0="1/2"), Decay()], ids=repr
)
def test_the_swinging_frame_has_the_motion_that_its_truth_says(problem):
    """By differences: the rates of the displaced truth are those of the displaced equation."""
    plain = Scene(problem)
    scene = Scene(problem, Frame(0.5, 2.0, plain.units))
    times = [Fraction(1) + Fraction(k, 2**12) for k in (-1, 0, 1)]
    before, here, after = (-scene.errors([t], np.zeros((1, scene.dimension)))[0] for t in times)
    rates = scene.rates(NUMPY, 1.0, here)
    assert ((after - before) * 2**11).tolist() == pytest.approx(list(rates), abs=1e-4)
    assert here[0] != -plain.errors([times[1]], np.zeros((1, scene.dimension)))[0, 0]


@pytest.mark.parametrize("name", ["line", "parabola", "cubic", "cycloid"])
def test_a_motion_that_ends_is_checked_before_its_end(name):
    found = compare.check(slips.rk4, order=4, problem=Descent(name))
    assert found.claims_hold, found.verdict
    assert found.energy.behaviour == ("rounding" if name == "line" else "short")


def test_a_step_that_does_not_move_is_told_so_on_any_problem():
    for problem in (Forced(), PolarBrachistochrone(z0="1/2"), Decay()):
        assert "it does not move" in compare.check(idle, order=1, problem=problem).verdict
