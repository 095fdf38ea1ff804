"""A family as a user writes one, in a file of his own: the harmonic oscillator x'' = -w^2 x, released from rest."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact
from reference.declaration import ENERGY_ABOVE_REST, ClosedForm, Quantity, Row, StateSpace, Trial
from reference.family import Comparison, Family, Input, Reported
from reference.layout import Coordinate, Group, Layout
from reference.problem import APART, SeparableProblem
from reference.routes.taylor import Flow
from reference.row_domains import INDEX, ONCE, TIME

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.declaration import Invariant

NO_TAYLOR = (("taylor", "the crossings are not followed"),)
ROWS = (
    Row(
        "state",
        (
            Quantity("x", "m", "displacement", "x'' = -w^2 x, x(0) = x0, v(0) = 0"),
            Quantity("v", "m s-1", "velocity", "v = x'"),
        ),
        TIME,
    ),
    Row("period", (Quantity("period", "s", "period", "T = 2 pi/w"),), ONCE, NO_TAYLOR),
    Row("energy", (Quantity("energy", "m2 s-2", "energy per mass", "E = (v^2 + w^2 x^2)/2"),), ONCE, NO_TAYLOR),
    Row(
        "crossing",
        (Quantity("crossing", "s", "times at which x = 0", "t[j] = (2 j + 1) T/4, j = 0, 1, ..."),),
        INDEX,
        NO_TAYLOR,
    ),
)


@dataclass(frozen=True, repr=False)
class Oscillator(SeparableProblem):
    """x'' = -w^2 x from x(0) = x0, x'(0) = 0; x0 in m, w in rad/s."""

    x0: Fraction
    w: Fraction

    name: ClassVar[str] = "oscillator"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    space: ClassVar[StateSpace] = StateSpace(
        positions=("x",), velocities=("v",), angles=(), odd=("v",), along=None, scale="units", independent="s"
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = Trial(states=((-1.0, 1.0), (-1.0, 1.0)), parameters={"w": (0.5, 2.0)}, step=(0.01, 0.1))

    def __init__(self, x0: Any, w: Any = 1) -> None:
        object.__setattr__(self, "x0", exact(x0, "x0"))
        object.__setattr__(self, "w", exact(w, "w"))
        if self.w <= 0:
            raise ValueError(f"w is {as_number(self.w)}; a positive number is accepted.")

    def __repr__(self) -> str:
        return f"Oscillator(x0={as_number(self.x0)!r}, w={as_number(self.w)!r})"

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"w": self.w}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.x0, Fraction(0)

    @property
    def equation(self) -> str:
        return "x'' = -w^2 x, x(0) = x0, x'(0) = 0"

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"x0": (as_number(self.x0), "m")}

    @staticmethod
    def velocity(m: Any, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:  # noqa: ARG004
        return (momenta[0],)

    @staticmethod
    def force(m: Any, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:  # noqa: ARG004
        return (-(p["w"] * p["w"]) * positions[0],)

    @staticmethod
    def invariant(m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:  # noqa: ARG004
        return (y[1] * y[1] + p["w"] * p["w"] * y[0] * y[0]) / 2

    def rate(self) -> float:
        return float(self.w)

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Oscillator:
        return Oscillator(rounding(self.x0 * (1 - max(APART, 16 * epsilon))), self.w)

    def closed_form(self, m: Any) -> Cosine:
        return Cosine(m, self)

    def taylor_form(self, bits: int) -> ByFlow:
        return ByFlow(self, bits)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        return row == "state" and all(0 <= t * self.w <= 100 for t in arguments)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction, ...] | None:
        if row == "energy":
            return (self.w**2 * self.x0**2 / 2,)
        return self.start if row == "state" and (argument == 0 or self.x0 == 0) else None

    def working_bits(self, arguments: Sequence[Any]) -> int:
        latest = max((abs(t) for t in arguments if isinstance(t, Fraction)), default=Fraction(0))
        return int(latest * (1 + self.w)).bit_length()


class Cosine(ClosedForm):
    """x = x0 cos(w t)."""

    def __init__(self, m: Any, problem: Oscillator) -> None:
        self.m, self._x0, self._w = m, m.number(problem.x0), m.number(problem.w)

    def state(self, t: Any) -> tuple[Any, Any]:
        return self._x0 * self.m.cos(self._w * t), -self._x0 * self._w * self.m.sin(self._w * t)

    @property
    def period(self) -> Any:
        return 2 * self.m.pi() / self._w

    @property
    def energy(self) -> Any:
        return self._w * self._w * self._x0 * self._x0 / 2

    def crossing(self, j: int) -> Any:
        return (2 * j + 1) * self.m.pi() / (2 * self._w)


class ByFlow:
    """The state by the flow of the equation."""

    def __init__(self, problem: Oscillator, bits: int) -> None:
        self._flow = Flow(problem, bits)

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Fraction, ...]]:
        assert row == "state"
        return self._flow.at(arguments)


FREE = Layout(
    "/oscillator/free",
    "harmonic oscillator released from rest",
    (Coordinate("x0", "m", "displacement at the start"),),
    {"time": Coordinate("time", "s", "time since the release"), "index": Coordinate("event", "1", "event", whole=True)},
    (Coordinate("w", "rad s-1", "angular frequency"),),
    ROWS,
    Oscillator,
    "any textbook of mechanics",
    "x'' = -w^2 x, x(0) = x0, x'(0) = 0",
    "lower: harmonic",
)


def core() -> tuple[Group, ...]:
    """Two amplitudes at five times."""
    return (Group(FREE, {"w": 1.5}, {"x0": [0.5, 2.0], "time": [0.0, 0.25, 1.0, 3.0, 10.0], "event": [0, 1, 2]}),)


OSCILLATOR = Family(
    name="oscillator",
    help="the harmonic oscillator, released from rest",
    problem=Oscillator,
    inputs=(
        Input("x0", "m", "displacement at the start"),
        Input("w", "rad s-1", "angular frequency", "1"),
        Input("t", "s", "time", over="time"),
    ),
    rows=("state", "period", "energy"),
    comparison=Comparison(
        "oscillator",
        "score them on the harmonic oscillator",
        varied="x0",
        values=(1.0,),
        what="amplitude",
        inputs=("w",),
        largest=1 << 10,
    ),
    reported=(Reported("oscillator", "x0", "m", "m", (1.0,), Oscillator),),
    layouts=(FREE,),
    core=core,
)
