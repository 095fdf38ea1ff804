"""How the Taylor route reads the pendulum's rows of the flow of its equation of motion."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.problems.pendulum.equations import condition, energy, through_the_bottom
from reference.routes.taylor import Along, Crossings, Period

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.routes.taylor import Reading, TaylorRoute

__all__ = ["BY_FLOW", "TAYLOR_RADIANS", "a_radian", "per_period"]

TAYLOR_RADIANS = 4000
"""The Taylor route serves times up to sqrt(g/l) t = TAYLOR_RADIANS: beyond, its work would grow without bound."""


def per_period(problem: Any) -> int:
    """How often in a period the pendulum hangs at the bottom, or turns back."""
    return 1 if problem.motion == "rotation" else 2


def at_rest(m: Arithmetic, y: Sequence[Any]) -> Any:
    """Zero where the pendulum turns back."""
    del m
    return y[1]


def a_radian(route: TaylorRoute, _argument: Any) -> Fraction:
    """A time somewhere on the way, 1/w."""
    return Fraction(1 / route.problem.rate())


def _condition(route: TaylorRoute, state: Sequence[Any]) -> Any:
    w = route.m.sqrt(route.m.number(route.problem.g / route.problem.length))
    return condition(route.m, w, *state[2:])


def _energy(route: TaylorRoute, state: Sequence[Any]) -> Any:
    return energy(route.m, *state, **route.parameters)


def _quarter(route: TaylorRoute, _argument: Any) -> Any:
    (first,) = Crossings(through_the_bottom, per_period)(route, "zero_crossing", [0])
    return first


def _period_slope(route: TaylorRoute, state: Sequence[Any]) -> Any:
    """dT/da, a = |theta0|: with q = T/4 and subscripts for derivatives by theta0, theta_a + omega q_a = 0."""
    _, omega, theta_a, *_ = state
    return -4 * theta_a / omega * (1 if route.problem.theta0 > 0 else -1)


def _period_curvature(_route: TaylorRoute, state: Sequence[Any]) -> Any:
    """d^2T/da^2: theta'' is zero at the bottom, hence theta_aa + 2 omega_a q_a + omega q_aa = 0."""
    _, omega, theta_a, omega_a, theta_aa, _ = state
    return -4 * (theta_aa - 2 * omega_a * theta_a / omega) / omega


BY_FLOW: Mapping[str, Reading] = {
    "state": Along(),
    "sensitivity": Along(by=("theta",)),
    "curvature": Along(by=("theta",), order=2),
    "gradient": Along(by=("theta", "omega", "g", "length")),
    "condition": Along(_condition, by=("theta", "omega")),
    "energy": Along(_energy, at=a_radian),
    "zero_crossing": Crossings(through_the_bottom, per_period),
    "turning_point": Crossings(at_rest, per_period),
    "period": Period(through_the_bottom, per_period),
    "dperiod_damplitude": Along(_period_slope, at=_quarter, by=("theta",), order=2),
    "d2period_damplitude2": Along(_period_curvature, at=_quarter, by=("theta",), order=2),
}
