"""Prothero and Robinson's equation, whose stiffness takes implicit methods down to the order of their stages."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import exact
from reference.declaration import ClosedForm, Quantity, Row, StateSpace, Trial
from reference.family import Comparison, Family, Input, Reported
from reference.problem import Problem
from reference.routes.taylor import Along
from reference.row_domains import TIME

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.declaration import Invariant

__all__ = ["FAMILY", "ProtheroRobinson"]

SOURCE = "A. Prothero and A. Robinson, Mathematics of Computation 28 (1974), 145, equation (1.3)"
EQUATION = "y' = lam (y - cos t) - sin t, y(0) = y0"
STATE = Row("state", (Quantity("y", "1", "solution", "y = cos t + (y0 - 1) e^(lam t)"),), TIME)


@dataclass(frozen=True)
class ProtheroRobinson(Problem):
    """y' = lam (y - phi(t)) + phi'(t) with phi = cos t: y = cos t + (y0 - 1) e^(lam t), lam < 0.

    A. Prothero and A. Robinson, Mathematics of Computation 28 (1974), 145; E. Hairer and G. Wanner, Solving Ordinary
    Differential Equations II, Springer 1996, section IV.15, where phi is any smooth function.

    Raises:
        ValueError: lam is not negative.
    """

    lam: Fraction
    y0: Fraction = Fraction(1)

    name: ClassVar[str] = "prothero-robinson"
    rows: ClassVar[tuple[Row, ...]] = (STATE,)
    space: ClassVar[StateSpace] = StateSpace(
        positions=("y",), angles=(), odd=None, along=None, scale="largest", independent=""
    )
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    trial: ClassVar[Trial] = Trial(states=((-2, 2),), parameters={"lam": (-10, -1)}, step=(0.01, 0.1))
    by_flow: ClassVar[dict[str, Any]] = {"state": Along()}
    autonomous: ClassVar[bool] = False

    def __post_init__(self) -> None:
        for name in ("lam", "y0"):
            object.__setattr__(self, name, exact(getattr(self, name), name))
        if self.lam >= 0:
            raise ValueError(f"lam is {float(self.lam):g}; a negative number is accepted.")

    def __repr__(self) -> str:
        return f"ProtheroRobinson(lam={float(self.lam)!r}, y0={float(self.y0)!r})"

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"lam": (float(self.lam), ""), "y0": (float(self.y0), "")}

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"lam": self.lam}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return (self.y0,)

    @property
    def equation(self) -> str:
        return EQUATION

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return (p["lam"] * (y[0] - m.cos(t)) - m.sin(t),)

    def closed_form(self, m: Any) -> ClosedForm:
        return Approach(m, m.number(self.lam), m.number(self.y0 - 1), smooth=self.y0 == 1)


class Approach(ClosedForm):
    """The solution in an arithmetic; on the smooth one no exponential is asked for, whose time may be far."""

    def __init__(self, m: Any, lam: Any, beside: Any, *, smooth: bool) -> None:
        self.m, self.lam, self.beside, self.smooth = m, lam, beside, smooth

    def state(self, t: Any) -> tuple[Any]:
        m = self.m
        return (m.cos(t) if self.smooth else m.cos(t) + self.beside * m.exp(self.lam * t),)


FAMILY = Family(
    name="prothero-robinson",
    help="Prothero and Robinson's stiff equation with a known solution",
    problem=ProtheroRobinson,
    inputs=(
        Input("lam", "1", "rate of the approach to cos t, negative", default="-10"),
        Input("y0", "1", "solution at t = 0", default="1"),
        Input("t", "1", "time", over="time"),
    ),
    rows=("state",),
    comparison=Comparison(
        "prothero-robinson",
        "score integrators on Prothero and Robinson's equation",
        "lam",
        (-10.0,),
        "rate",
        inputs=("y0",),
    ),
    reported=(Reported("prothero-robinson", "lam", "", "", (-10.0,), ProtheroRobinson),),
    layouts=(),
)
