"""Problems of a user's that contradict themselves, or hide what shared mechanisms must see."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, ClassVar

import numpy as np
import pytest
from toys import KEPLER, Beats, Forced, Kepler

import compare
from compare.march.march import converged
from compare.march.precision import precision
from compare.measure.cases import case_of
from compare.scored import score_all
from compare.study import study
from reference import ClosedForm, HamiltonianProblem, Invariant, Problem, Quantity, Row, StateSpace, Trial, consistency
from reference.consistency import examine
from reference.family import Input
from reference.flow_problem import FlowProblem
from reference.problems.families import FAMILIES, find_family
from reference.routes.taylor import TaylorRoute
from reference.row_domains import TIME

STATE = Row("state", (Quantity("q", "1", "position", "q"), Quantity("p", "1", "momentum", "p")), TIME)


@dataclass(frozen=True)
class Spring(HamiltonianProblem):
    """H = p^2/(2 m) + k q^2/2 from rest at q = 1, with the stiffness in a field and not among the parameters."""

    k: Fraction
    mass: Fraction = Fraction(1, 4)

    name: ClassVar[str] = "spring"
    rows: ClassVar[tuple[Row, ...]] = (STATE,)
    space: ClassVar[StateSpace] = StateSpace(
        positions=("q",), momenta=("p",), angles=(), odd=("p",), along=None, scale="largest", independent="s"
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),)
    trial: ClassVar[Trial] = Trial(states=((-1, 1), (-1, 1)), parameters={"mass": (0.5, 1.0)}, step=(0.01, 0.1))
    parameters: ClassVar[Any] = property(lambda self: {"mass": self.mass})
    start: ClassVar[Any] = property(lambda self: (Fraction(1), Fraction(0)))
    inputs: ClassVar[Any] = property(lambda self: {"k": (float(self.k), "")})

    def hamiltonian(self, m: Any, t: Any, q: Any, p: Any, c: Any) -> Any:
        return p[0] * p[0] / (2 * c["mass"]) + m.number(self.k) * q[0] * q[0] / 2

    def closed_form(self, m: Any) -> ClosedForm:
        return Cosine(m, m.number(self.k), m.number(self.mass))


class Cosine(ClosedForm):
    def __init__(self, m: Any, k: Any, mass: Any) -> None:
        self.m, self.w, self.mass = m, m.sqrt(k / mass), mass

    def state(self, t: Any) -> tuple[Any, Any]:
        return self.m.cos(self.w * t), -self.mass * self.w * self.m.sin(self.w * t)


def test_problems_that_differ_in_what_is_no_parameter_are_not_taken_for_one_another() -> None:
    """Blocks of the march and flows of the Taylor route are shared by equations that are the same in symbols."""
    springs = [Spring(Fraction(1)), Spring(Fraction(4))]
    scored = score_all(springs, ["rk4", "verlet"], n=[512], t_end=5)
    assert max(cell.max_error for cell in scored.cells) < 1e-2
    for spring in springs:
        assert spring.certified("state", Fraction(1), 0).routes["taylor"] > 40
    assert replace(springs[0], mass=Fraction(1, 2)).structure == springs[0].structure != springs[1].structure


def test_a_mass_is_in_the_momentum() -> None:
    scored = score_all([Spring(Fraction(1))], ["verlet", "rk4"], n=[256], t_end=5, scores=["defects"])
    verlet, rk4 = scored.found["defects"]
    assert (verlet.symplecticity < 1e-14, rk4.symplecticity > 1e-12) == (True, True)
    assert not Spring(Fraction(1)).second_order
    assert scored.left_out == {"k = 1.0": ()}


class Coupled(Kepler):
    """Of which the slopes at the start alone would not tell that it does not split."""

    def hamiltonian(self, m: Any, t: Any, q: Any, p: Any, c: Any) -> Any:
        return super().hamiltonian(m, t, q, p, c) + p[0] * p[0] * q[1] * q[1]


def test_a_hamiltonian_that_does_not_split_is_seen_away_from_its_start() -> None:
    assert Kepler().positions == 2
    assert Coupled().positions == 0


class Wrong(Forced):
    """A solution of which the velocity is off by one part in 10^18."""

    def closed_form(self, m: Any) -> Any:
        return Off(m, *map(m.number, (self.angle, *self.parameters.values())))


class Off(Beats):
    def state(self, t: Any) -> Any:
        angle, rate = super().state(t)
        return angle, rate * self.m.number(1 + Fraction(1, 10**18))


class Drifting(Forced):
    """An energy that the force does not conserve."""

    invariants = (Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),)

    def invariant(self, m: Any, y: Any, p: Any) -> Any:
        return (y[0] * y[0] + y[1] * y[1]) / 2


class Shifted(Forced):
    """A start that is not that of the solution."""

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.angle, Fraction(1, 1000)


class Second(Kepler):
    """An energy after another invariant."""

    invariants = (Kepler.invariants[1], Kepler.invariants[0])


class Misspelt(Forced):
    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return y[1], m.cosine(t)


class Lacking(Forced):
    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return y[1], -p["stiffness"] * y[0]


class Renamed(Forced):
    space = replace(Forced.space, positions=("x",), angles=())


class Short(Forced):
    trial = Trial(states=((-3, 3),), parameters=Forced.trial.parameters, step=(0.01, 0.1))


class Mixed(Kepler):
    rows = (Row("state", (replace(Kepler.rows[0].quantities[0], units="m"), *Kepler.rows[0].quantities[1:]), TIME),)


@pytest.mark.parametrize(
    ("problem", "sentence"),
    [
        (Wrong(), "does not solve its equation"),
        (Drifting(), "is not conserved"),
        (Shifted(), "does not begin at its start"),
        (Short(), "trial has 1 intervals of states"),
        (Mixed(), "positions are in 1 and in m"),
        (Second(), "energy is not the first"),
        (Misspelt(), "asks for 'cosine'; no arithmetic has it"),
        (Lacking(), "asks for 'stiffness'; no parameter is called so"),
        (Renamed(), "the state row has angle, rate"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_contradicts_itself_is_refused_in_one_sentence(problem: Any, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        compare.error_vs_n(problem, ["rk4"], n=[64])
    with pytest.raises(ValueError, match=sentence):
        compare.score(problem, [1.0], [[0.0] * len(problem.state_names)])


def test_a_start_of_zeros_is_no_contradiction() -> None:
    assert compare.error_vs_n(Forced(angle=0), ["rk4"], n=[64], t_end=2)[0].max_error < 1e-4
    assert compare.error_vs_n(Logistic(Fraction(0)), ["rk4"], n=[64], t_end=2)[0].max_error == 0


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"scale": "unit"}, "scale is 'unit'"),
        ({"positions": "q"}, "positions is 'q'"),
        ({"odd": ("p", "p")}, "each name is accepted once"),
        ({"angles": ("p",)}, "the angle p is no position"),
        ({"independent": None}, "independent is None"),
        ({"velocities": ("p",)}, "one of them is accepted"),
    ],
)
def test_a_state_space_that_contradicts_itself_is_refused(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises((TypeError, ValueError), match=sentence):
        replace(Spring.space, **change)


@pytest.mark.parametrize(
    ("change", "sentence"), [({"values": ()}, "values of toy-kepler"), ({"largest": 64}, "128 or more")]
)
def test_a_family_of_which_a_command_can_make_nothing_is_refused(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises((TypeError, ValueError), match=sentence):
        replace(KEPLER, comparison=replace(KEPLER.comparison, **change))


def test_the_default_of_an_input_is_what_is_marched() -> None:
    inputs = (KEPLER.inputs[0], Input("r", "1", "distance of the pericentre", "0.375"), KEPLER.inputs[2])
    found = study(replace(KEPLER, inputs=inputs), n=[64], methods=["rk4"])
    assert found.parameters["r"] == 0.375
    assert "r=0.375" in found.cases[0].problem


@dataclass(frozen=True)
class Saddle(HamiltonianProblem):
    """H = p^2/2 - q^2/2: from (1, 1) the energy is zero, and every rounding grows as exp(t)."""

    momentum: Fraction = Fraction(1)

    name: ClassVar[str] = "saddle"
    rows: ClassVar[tuple[Row, ...]] = (STATE,)
    space: ClassVar[StateSpace] = Spring.space
    invariants: ClassVar[tuple[Invariant, ...]] = Spring.invariants
    trial: ClassVar[Trial] = Trial(states=((-1, 1), (-1, 1)), parameters={}, step=(0.01, 0.1))
    parameters: ClassVar[Any] = property(lambda self: {})
    start: ClassVar[Any] = property(lambda self: (Fraction(1), self.momentum))
    inputs: ClassVar[Any] = property(lambda self: {"momentum": (float(self.momentum), "")})

    def hamiltonian(self, m: Any, t: Any, q: Any, p: Any, c: Any) -> Any:
        return (p[0] * p[0] - q[0] * q[0]) / 2

    def closed_form(self, m: Any) -> ClosedForm:
        return Growing(m, m.number(self.momentum))


class Growing(ClosedForm):
    def __init__(self, m: Any, momentum: Any) -> None:
        self.m, self.momentum = m, momentum

    def state(self, t: Any) -> tuple[Any, Any]:
        growing = (1 + self.momentum) * self.m.exp(t) / 2
        falling = (1 - self.momentum) * self.m.exp(-t) / 2
        return growing + falling, growing - falling


def test_an_energy_that_is_zero_is_said_to_be_no_scale() -> None:
    assert "nothing but zero" in dict(case_of(Saddle()).lacks)["drift"]
    assert "drift" not in dict(case_of(Saddle(Fraction(1, 2))).lacks)


def test_an_exactly_reversible_step_is_so_on_an_unstable_motion() -> None:
    def leapfrog(q: Any, p: Any, force: Any, h: float) -> tuple[Any, Any]:
        half = p + h / 2 * force(q)
        moved = q + h * half
        return moved, half + h / 2 * force(moved)

    def euler(f: Any, y: Any, h: float) -> Any:
        return y + h * f(y)

    assert compare.check(leapfrog, order=2, reversible=True, problem=Saddle(Fraction(1, 2))).claims_hold
    assert not compare.check(euler, order=1, reversible=True, problem=Saddle(Fraction(1, 2))).claims_hold


def test_the_changes_of_an_implicit_march_are_held_against_its_start_too() -> None:
    change, samples, start = 1e-6, np.array([1e-3]), np.array([1e10])
    assert converged(change, samples, start, precision("float64"))
    assert not converged(change, samples, samples, precision("float64"))


class Turned(Saddle):
    space: ClassVar[StateSpace] = replace(Spring.space, odd=("q", "p"))


def test_a_reversor_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="does not turn back where q, p changes sign"):
        compare.error_vs_n(Turned(Fraction(1, 2)), ["rk4"], n=[64], t_end=1)


def test_a_fast_motion_is_looked_at_in_its_own_time() -> None:
    fast = Spring(Fraction(10**8))
    assert fast.rate() == pytest.approx(2e4, rel=1e-9)
    assert np.isfinite(compare.error_vs_n(fast, ["rk4"], n=[256], t_end=1e-3)[0].max_error)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_problems_of_the_package_do_not_contradict_themselves(family: Any, monkeypatch: Any) -> None:
    """A flow that is proven solves its equation; its invariants and its reversor are tested beside it."""
    if isinstance(family.problem, type) and issubclass(family.problem, FlowProblem):
        monkeypatch.setattr(consistency, "_motion", lambda problem: None)
    for reported in family.reported:
        for amplitude in reported.amplitudes:
            examine(reported.problem(amplitude))


def test_of_problems_the_one_that_is_none_is_named() -> None:
    with pytest.raises(TypeError, match="problems holds a int"):
        score_all([Forced(), 1], ["rk4"], n=[64])  # type: ignore[list-item]


@dataclass(frozen=True)
class Logistic(Problem):
    """y' = y (1 - y) from 1/8: one component, of first order, nothing conserved; y = 1/(1 + 7 exp(-t))."""

    y0: Fraction = Fraction(1, 8)

    name: ClassVar[str] = "logistic"
    rows: ClassVar[tuple[Row, ...]] = (Row("state", (Quantity("y", "1", "population", "y"),), TIME),)
    space: ClassVar[StateSpace] = StateSpace(
        positions=("y",), angles=(), odd=None, along=None, scale="units", independent=""
    )
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    trial: ClassVar[Trial] = Trial(states=((0.1, 0.9),), parameters={}, step=(0.01, 0.1))
    parameters: ClassVar[Any] = property(lambda self: {})
    start: ClassVar[Any] = property(lambda self: (self.y0,))
    inputs: ClassVar[Any] = property(lambda self: {"y0": (float(self.y0), "")})

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> tuple[Any, ...]:
        return (y[0] * (1 - y[0]),)

    def closed_form(self, m: Any) -> ClosedForm:
        return Saturating(m, m.number(self.y0))


class Saturating(ClosedForm):
    def __init__(self, m: Any, y0: Any) -> None:
        self.m, self.y0 = m, y0

    def state(self, t: Any) -> tuple[Any]:
        return (self.y0 / (self.y0 + (1 - self.y0) * self.m.exp(-t)),)


class Clock(Logistic):
    """y' = 1, and a solution with that slope that falls now and then."""

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> tuple[Any, ...]:
        return (m.number(Fraction(1)),)

    def closed_form(self, m: Any) -> ClosedForm:
        return Falling(m, m.number(self.y0))


class Falling(Saturating):
    def state(self, t: Any) -> tuple[Any]:
        return (self.y0 + self.m.atan2(self.m.sin(t), self.m.cos(t)),)


def test_a_solution_that_leaps_is_refused() -> None:
    with pytest.raises(ValueError, match="leaps: y is 3"):
        compare.error_vs_n(Clock(), ["rk4"], n=[64], t_end=1)


def test_a_state_of_one_component_is_marched_scored_and_proven() -> None:
    (proven,) = Logistic().state(2)
    assert proven == 1 / (1 + 7 * np.exp(-2.0))
    ((flow,),) = TaylorRoute(Logistic(), 128).rows("state", [Fraction(2)])
    assert float(flow) == pytest.approx(float(proven), rel=1e-15)
    scored = score_all([Logistic()], ["rk4", "gauss4", "bdf2"], n=[64, 128, 256], t_end=4)
    assert [round(fit.fitted_order or 0) for fit in scored.orders] == [4, 4, 2]
    assert {"drift", "defects", "phase"} <= set(dict(case_of(Logistic()).lacks))


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("detest-d1", "error of y1 or y2"),
        ("detest-c4", "error of y1, y2, ... or y51"),
        ("brusselator", "error of u or v relative to its largest value"),
    ],
)
def test_the_title_of_a_table_names_few_positions(name: str, error: str) -> None:
    assert case_of(find_family(name).problem()).error == error
