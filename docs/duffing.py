"""The undamped Duffing oscillator x'' = -x - x^3, from its equation to a scored table: see own-problem.md.

Released from rest at x = a it is x = a cn(w t, k), w^2 = 1 + a^2, k^2 = a^2/(2 w^2), with the period 4 K(k)/w
(I. Kovacic and M. J. Brennan, The Duffing Equation, Wiley 2011, section 2.3).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar

from reference import (
    ENERGY_ABOVE_REST,
    ONCE,
    TIME,
    Along,
    ClosedForm,
    Comparison,
    Coordinate,
    Family,
    Group,
    HamiltonianProblem,
    Input,
    Invariant,
    Layout,
    Period,
    Quantity,
    Reported,
    Row,
    StateSpace,
    Trial,
    exact,
)

STATE = Row(
    "state",
    (
        Quantity("x", "1", "displacement", "x'' = -x - x^3, x(0) = a, x'(0) = 0"),
        Quantity("p", "1", "momentum", "p = dx/dt"),
    ),
    TIME,
)
PERIOD = Row("period", (Quantity("period", "1", "period", "4 K(k)/w, w^2 = 1 + a^2, k^2 = a^2/(2 w^2)"),), ONCE)


@dataclass(frozen=True)
class Duffing(HamiltonianProblem):
    """H = p^2/2 + x^2/2 + x^4/4, released from rest at x = a."""

    a: Fraction

    name: ClassVar[str] = "duffing"
    rows: ClassVar[tuple[Row, ...]] = (STATE, PERIOD)
    space: ClassVar[StateSpace] = StateSpace(
        positions=("x",), momenta=("p",), angles=(), odd=("p",), along=None, scale="largest", independent=""
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = Trial(states=((-2, 2), (-2, 2)), parameters={}, step=(0.01, 0.1))
    by_flow: ClassVar[dict[str, Any]] = {"state": Along(), "period": Period(lambda _m, y: y[0], per_period=2)}

    def __post_init__(self) -> None:
        object.__setattr__(self, "a", exact(self.a, "a"))
        if self.a <= 0:
            raise ValueError(f"a is {self.a}; a positive number is accepted.")

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"a": (float(self.a), "")}

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.a, Fraction(0)

    @property
    def equation(self) -> str:
        return "x'' = -x - x^3, x(0) = a, x'(0) = 0"

    def hamiltonian(self, m: Any, t: Any, q: Any, p: Any, c: Any) -> Any:
        square = q[0] * q[0]
        return p[0] * p[0] / 2 + square / 2 + square * square / 4

    def closed_form(self, m: Any) -> ClosedForm:
        return Swing(m, m.number(self.a))


class Swing(ClosedForm):
    """The rows of the oscillator in an arithmetic m: balls, which prove them, or mpmath, which checks them."""

    def __init__(self, m: Any, a: Any) -> None:
        self.m, self.a, self.w = m, a, m.sqrt(1 + a * a)
        self.functions = m.elliptic(a / (m.sqrt(2 * (1 + a * a))), m.sqrt((2 + a * a) / (2 * (1 + a * a))))

    @property
    def period(self) -> Any:
        return 4 * self.functions.first / self.w

    def state(self, t: Any) -> tuple[Any, Any]:
        sn, cn, dn = self.functions.functions(self.w * t)
        return self.a * cn, -self.a * self.w * sn * dn


SWINGS = Layout(
    path="/duffing/undamped",
    long_name="oscillations from rest",
    instances=(Coordinate("a", "1", "displacement at the release"),),
    over={"time": Coordinate("time", "1", "time since the release")},
    parameters=(),
    rows=(STATE, PERIOD),
    problem=Duffing,
    reference="I. Kovacic and M. J. Brennan, The Duffing Equation, Wiley 2011, section 2.3",
    statement="x'' = -x - x^3, from rest at x = a",
    difficulty="lower: smooth, one degree of freedom",
)


def groups() -> tuple[Group, ...]:
    """The groups of a dataset: a few amplitudes and times."""
    return (Group(SWINGS, {}, {"a": (0.5, 1.0, 2.0), "time": (0.5, 1.0, 7.25)}),)


FAMILY = Family(
    name="duffing",
    help="the undamped Duffing oscillator, released from rest",
    problem=Duffing,
    inputs=(Input("a", "1", "displacement at the release"), Input("t", "1", "time", over="time")),
    rows=("state", "period"),
    comparison=Comparison("duffing", "score integrators on the Duffing oscillator", "a", (1.0,), "displacement"),
    reported=(Reported("duffing", "a", "", "", (1.0,), Duffing),),
    layouts=(SWINGS,),
    core=groups,
)
