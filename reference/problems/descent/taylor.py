"""How the Taylor route reads the rows of a descent: of the flow of Lagrange's equation, and with it of the arc."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.problems.descent.curves import lagrange
from reference.routes.flow import System
from reference.routes.taylor import Along, Reached

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.problems.descent.curves import Curve
    from reference.routes.taylor import Reading, TaylorRoute

__all__ = ["BY_FLOW"]


@dataclass(frozen=True)
class WithArc:
    """Lagrange's equation along a curve, and the arc s' = sqrt(N) w' from the start on."""

    curve: Curve

    def __call__(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(w', w'', s')"""
        del t
        w, rate, _ = y
        return *lagrange(self.curve, m, w, rate, p["g"]), m.sqrt(self.curve.profile(m, w)[2]) * rate


def _with_arc(route: TaylorRoute) -> System:
    problem = route.problem
    return System(WithArc(problem.curve), ("place", "place_rate", "arc"), (*problem.start, ZERO), problem.parameters)


ZERO = Fraction(0)


def _body(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    """Where the body is, its speed and its velocity r_w w'."""
    (w, rate, _), m, curve = state, route.m, route.problem.curve
    dx, dy = curve.slopes(m, w)
    speed = m.sqrt(dx * dx + dy * dy) * rate
    return curve.horizontal(m, w), curve.height(m, w), speed, dx * rate, dy * rate


def _place(_m: Any, y: Sequence[Any], _problem: Any) -> Any:
    return y[0]


BY_FLOW: Mapping[str, Reading] = {
    "state": Along(lambda _route, state: state[:2], of=_with_arc),
    "motion": Along(_body, of=_with_arc),
    "passage": Reached(_place, of=_with_arc, read=lambda route, time, state: (time, *_body(route, state)[:4])),
    "descent_time": Reached(_place, to=Fraction(1), of=_with_arc),
    "arc_length": Along(lambda _route, state: state[2], at=lambda route, _: route.value("descent_time"), of=_with_arc),
}
