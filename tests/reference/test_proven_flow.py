"""The proven flow: balls of few bits against many, members of wide starts, and sabotage that is noticed."""

# ruff: noqa: ARG001 - equations take what they are given, and some make no use of it

from __future__ import annotations

import itertools
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, arb_mat

from reference.arithmetic.limbs import WorkBoundError
from reference.problems.families import find_family
from reference.routes import proven_flow, variation
from reference.routes.proven_flow import ProvenFlow
from reference.routes.variation import Variation

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

STEPS = 4000
SHORT_STEPS = 3
"""Of sabotage: bounds of long steps have more to spare than what it takes away."""


@dataclass(frozen=True)
class System:
    """An equation from a box of starts."""

    name: str
    derivative: Callable[..., Any]
    start: tuple[str, ...]
    end: Fraction
    parameters: dict[str, Fraction] = field(default_factory=dict, compare=False)
    radius: Fraction = Fraction(0)
    corner: tuple[int, ...] = ()
    """Of a member: where in the box it starts."""

    def __repr__(self) -> str:
        return self.name

    @property
    def state_names(self) -> tuple[str, ...]:
        return tuple(f"y{i}" for i in range(len(self.start)))

    def start_in(self, m: Any) -> list[Any]:
        if self.corner:
            inside = self.radius * (1 - Fraction(1, 10**9))
            return [m.number(Fraction(one) + k * inside) for one, k in zip(self.start, self.corner, strict=True)]
        return [m.number(Fraction(one)) + arb(0, m.number(self.radius)) for one in self.start]


def henon_heiles(m: Any, t: Any, y: Any, p: Any) -> Any:
    return y[2], y[3], -y[0] - 2 * y[0] * y[1], -y[1] - y[0] * y[0] + y[1] * y[1]


def lorenz(m: Any, t: Any, y: Any, p: Any) -> Any:
    return 10 * (y[1] - y[0]), y[0] * (p["rho"] - y[2]) - y[1], y[0] * y[1] - p["beta"] * y[2]


def kepler(m: Any, t: Any, y: Any, p: Any) -> Any:
    square = y[0] * y[0] + y[1] * y[1]
    pull = 1 / (square * m.sqrt(square))
    return y[2], y[3], -y[0] * pull, -y[1] * pull


def van_der_pol(m: Any, t: Any, y: Any, p: Any) -> Any:
    return y[1], (1 - y[0] * y[0]) * y[1] - y[0]


def driven(m: Any, t: Any, y: Any, p: Any) -> Any:
    return y[1], m.cos(m.number(Fraction(2, 3)) * t) - y[1] / 4 - m.sin(y[0])


def growing(m: Any, t: Any, y: Any, p: Any) -> Any:
    return m.exp(-t) * y[0] - m.log(1 + y[0] * y[0]) * m.atan(y[1]), m.tanh(y[0]) - m.power(y[1], Fraction(4, 3)) / 8


def decay(m: Any, t: Any, y: Any, p: Any) -> Any:
    return (-5 * y[0] + m.sin(3 * t),)


SYSTEMS = (
    System("henon-heiles", henon_heiles, ("0", "0.1", "0.5", "0"), Fraction(12)),
    System("lorenz", lorenz, ("1", "1", "1"), Fraction(3), {"rho": Fraction(28), "beta": Fraction(8, 3)}),
    System("kepler", kepler, ("0.5", "0", "0", "1.75"), Fraction(7)),
    System("van der pol", van_der_pol, ("2", "0"), Fraction(9)),
    System("driven", driven, ("0.2", "0"), Fraction(8)),
    System("growing", growing, ("0.5", "1"), Fraction(4)),
    System("decay", decay, ("1",), Fraction(6)),
)


def times(end: Fraction, count: int = 9) -> list[Fraction]:
    return [end * k / count for k in range(1, count + 1)]


def riccati(m: Any, t: Any, y: Any, p: Any) -> Any:
    return (y[0] * y[0],)


def relaxing(m: Any, t: Any, y: Any, p: Any) -> Any:
    return (-50 * (y[0] - m.cos(t)),)


RICCATI = System("riccati", riccati, ("1",), Fraction(3))
RELAXING = System("relaxing", relaxing, ("1",), Fraction(1, 3))


@lru_cache
def values_of_many_bits(system: System, end: Fraction, count: int, bits: int) -> list[list[arb]]:
    flow = ProvenFlow(system, bits, STEPS)
    return [flow.at(t) for t in times(end, count)]


@pytest.mark.parametrize("sides", [0, 10])
@pytest.mark.parametrize("system", SYSTEMS, ids=repr)
def test_balls_of_few_bits_hold_the_values_of_many(system: System, sides: int, monkeypatch: pytest.MonkeyPatch) -> None:
    many = values_of_many_bits(system, system.end, 9, 230)
    monkeypatch.setattr(proven_flow, "SIDES", sides)
    few = ProvenFlow(system, 60, STEPS)
    for t, values in zip(times(system.end), many, strict=True):
        for ball, value in zip(few.at(t), values, strict=True):
            assert ball.contains(value.mid())
            assert value.rel_accuracy_bits() > 100


def outside(system: System, radius: Fraction, count: int = 5) -> int:
    """Members of a box of starts that are outside of what is proven of all of them."""
    wide = replace(system, end=system.end / 4, radius=radius)
    flow, found = ProvenFlow(wide, 60, STEPS), 0
    try:
        states = [flow.at(t) for t in times(wide.end, count)]
    except WorkBoundError:
        return 0
    for member, values in members(wide, count):
        del member
        for balls, exact in zip(states, values, strict=True):
            found += sum(not ball.contains(value.mid()) for ball, value in zip(balls, exact, strict=True))
    return found


@lru_cache
def members(wide: System, count: int) -> list[tuple[System, list[list[arb]]]]:
    """The corners of a box of starts, just inside, and their states; sabotage is none of these."""
    with pytest.MonkeyPatch.context() as honest:
        for where, name, true in TRUE:
            honest.setattr(where, name, true)
        honest.setattr(proven_flow, "SIDES", 10)
        corners = [replace(wide, corner=corner) for corner in itertools.product((-1, 1), repeat=len(wide.start))]
        return [(one, values_of_many_bits(one, wide.end, count, 120)) for one in corners]


@pytest.mark.parametrize("sides", [0, 10])
@pytest.mark.parametrize("system", [*SYSTEMS, RICCATI, RELAXING], ids=repr)
def test_the_corners_of_a_box_of_starts_stay_inside(
    system: System, sides: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(proven_flow, "SIDES", sides)
    assert outside(system, Fraction(1, 2**14)) == 0


def of_the_defect_alone(self: Any, sides: Sequence[arb]) -> list[arb]:
    return list(self._defects)


def of_the_start_alone(self: Any, sides: Sequence[arb]) -> list[arb]:
    self._defects = [arb(0)] * len(self._defects)
    return TRUE_END(self, sides)


def of_the_midpoint_alone(self: Any, growth: Any) -> Any:
    self._tape.close([arb(0)] * len(self._cut))
    return middles(TRUE_DERIVATIVE(self, growth))


def half_as_long(self: Any, growth: Any) -> Any:
    return TRUE_DERIVATIVE(self, growth) / 2


def middles(matrix: Any) -> Any:
    return arb_mat([[value.mid() for value in row] for row in matrix.tolist()])


def half_of_the_growth(matrix: Any) -> Any:
    return arb_mat([[value.mid() / 2 for value in row] for row in matrix.tolist()])


def without_room(self: Any, room: Sequence[arb]) -> Any:
    TRUE_CLOSE(self, [arb(0)] * len(room))


def without_the_defect(variable: Any, rate: Any, h: arb) -> arb:
    return arb(0)


def falsified(self: Any, t: Any, start: Sequence[arb], order: int) -> None:
    """A candidate of which one coefficient is wrong, by less than what makes a step too long."""
    TRUE_GROW(self, t, start, order)
    terms = self.variables[0].terms
    terms[3] = (terms[3] + self.variables[0].norm * arb(2) ** -45).mid()


TRUE_DERIVATIVE = Variation.derivative
TRUE_END = proven_flow._Tube.end
TRUE_CLOSE = Variation.close
TRUE_GROW = proven_flow._Reading.grow
TRUE = (
    (Variation, "derivative", TRUE_DERIVATIVE),
    (Variation, "close", TRUE_CLOSE),
    (proven_flow._Tube, "end", TRUE_END),
    (variation, "upper", variation.upper),
    (proven_flow, "_defect", proven_flow._defect),
    (proven_flow._Reading, "grow", TRUE_GROW),
)


@pytest.mark.parametrize("sides", [0, 10])
@pytest.mark.parametrize("system", [*SYSTEMS[3:], RICCATI, RELAXING], ids=repr)
def test_a_false_coefficient_is_paid_for(system: System, sides: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proven_flow._Reading, "grow", falsified)
    monkeypatch.setattr(proven_flow, "SIDES", sides)
    assert outside(system, Fraction(0)) == 0


@pytest.mark.parametrize(
    ("system", "radius", "sides", "where", "name", "wrong"),
    [
        (RICCATI, Fraction(1, 2**12), 0, proven_flow._Tube, "end", of_the_defect_alone),
        (SYSTEMS[-1], Fraction(0), 0, proven_flow._Tube, "end", of_the_start_alone),
        (RICCATI, Fraction(1, 2**12), 10, Variation, "derivative", half_as_long),
        (RICCATI, Fraction(1, 2**6), 10, Variation, "derivative", of_the_midpoint_alone),
        (RICCATI, Fraction(1, 2**12), 0, variation, "upper", half_of_the_growth),
        (RICCATI, Fraction(1, 2**6), 0, Variation, "close", without_room),
        (RELAXING, Fraction(0), 10, proven_flow, "_defect", without_the_defect),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_a_wrong_step_is_noticed(
    system: System, radius: Fraction, sides: int, where: Any, name: str, wrong: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(proven_flow, "SIDES", sides)
    monkeypatch.setattr(variation, "DECAY", SHORT_STEPS)
    if not radius:
        monkeypatch.setattr(proven_flow._Reading, "grow", falsified)
    assert outside(system, radius, 50) == 0
    monkeypatch.setattr(where, name, wrong)
    assert outside(system, radius, 50)


def test_what_is_lost_is_told_of_what_was_proven_and_by_components_of_what_is_small() -> None:
    problem = find_family("kepler").problem()
    for known in (proven_flow._flows, proven_flow._losses):
        known.cache_clear()
    assert proven_flow.lost(problem, Fraction(4)) == 0
    proven_flow.see(problem, Fraction(16), lambda: 96)
    assert 0 < proven_flow.lost(problem, Fraction(4)) <= proven_flow.lost(problem, Fraction(400)) < 4000
    near = Fraction(1, 2**20)  # y is about t there, and x about one

    def lacks(*components: int) -> int | None:
        return proven_flow.lost_in(problem, [near], lambda _time, state: [state[place] for place in components])

    assert lacks(1) == lacks(0, 1)
    assert lacks(1) > lacks(0) > 0
    assert proven_flow.lost_in(problem, [Fraction(10**6)], lambda _time, state: state) is None
