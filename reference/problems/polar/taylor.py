"""How the Taylor route reads a brachistochrone in a central field: of its motion in tau, and of its curve in psi.

Where the motion is at rest its curve is regular in psi, z = 1 - (1 - z0) sin^2(psi/2) by definition of psi for a point
mass; z0, and psi where an argument is neither tau nor psi, are those of the solution by quadrature.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.problems.polar.optimality import chord_geometry
from reference.routes.flow import System
from reference.routes.taylor import Along

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.problems.polar.equations import Field
    from reference.routes.taylor import Reading, TaylorRoute

__all__ = ["BY_FLOW"]

ZERO, ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True)
class Motion:
    """(z, z', phi)' in tau."""

    field: Field

    def __call__(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t
        acceleration, turn = self.field.motion(m, y[0], p["kappa"])
        return y[1], acceleration, turn


@dataclass(frozen=True)
class Curve:
    """(psi, phi, tau)' in psi."""

    field: Field

    def __call__(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t
        cosine2 = m.cos(y[0] / 2) * m.cos(y[0] / 2)
        return m.number(ONE), *self.field.rates(m, p["z0"], 1 - cosine2, cosine2)


@dataclass(frozen=True)
class Bead:
    """(s, s')' in tau on a straight line at the angle beta with the radius, z^2 = 1 - 2 s cos(beta) + s^2."""

    field: Field

    def __call__(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t
        cosine = p["cosine"]
        return y[1], (cosine - y[0]) * self.field.pull(m.sqrt(1 - y[0] * (2 * cosine - y[0])))


def _motion(route: TaylorRoute) -> System:
    problem = route.problem
    kappa = to_fraction(route.quadrature.kappa) if problem.z0 is None else problem.parameters["kappa"]
    return System(Motion(problem.field), ("z", "z_rate", "phi"), (ONE, ZERO, ZERO), {"kappa": kappa})


def _curve(route: TaylorRoute) -> System:
    z0 = to_fraction(route.quadrature.z0)
    return System(Curve(route.problem.field), ("psi", "phi", "tau"), (ZERO, ZERO, ZERO), {"z0": z0})


def _chord(route: TaylorRoute) -> System:
    _, _, cosine = chord_geometry(route.m, *route.quadrature.chord)
    return System(Bead(route.problem.field), ("way", "speed"), (ZERO, ZERO), {"cosine": to_fraction(cosine)})


def _chord_time(route: TaylorRoute, row: str, arguments: Sequence[Any]) -> list[Any]:
    """When the bead is at the end of the line, or halfway where it would come to rest there: twice as long."""
    length, *_ = chord_geometry(route.m, *route.quadrature.chord)
    folded = 1 if route.quadrature.last[0] else 2
    (guess,) = route.guesses(row, arguments)
    (time,) = route.corrected(lambda _m, y, _problem: y[0], [length / folded], [guess / folded], _chord)
    return [time * folded]


def _at_height(route: TaylorRoute, height: Fraction) -> Any:
    return route.quadrature.psi_of_height(route.m.number(height))


def _at_z(route: TaylorRoute, z: Fraction) -> Any:
    z0 = route.quadrature.z0
    return route.quadrature.psi_of_height((route.m.number(z) - z0) / (1 - z0))


def _point(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    psi, phi, tau = state
    return route.quadrature.height(psi), phi, tau


def _of_the_end(component: int, scaled: Callable[[TaylorRoute], Any] = lambda _route: 1) -> Along:
    """phi or tau at the end of the path."""
    return Along(
        lambda route, state: state[component] * scaled(route), at=lambda route, _: route.quadrature.psi_end, of=_curve
    )


def _of_the_lowest(component: int, scaled: Callable[[TaylorRoute], Any] = lambda _route: 1) -> Along:
    """psi, phi, tau or one of their derivatives by z0 at the lowest point, psi = pi."""
    return Along(
        lambda route, state: state[component] * scaled(route), at=lambda _route, _: +mp.pi, of=_curve, by=("z0",)
    )


def _seconds(route: TaylorRoute) -> Any:
    return route.quadrature.time_unit


def _si_curve(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    z, _, tau = _point(route, state)
    return z * route.quadrature.length, tau * _seconds(route)


def _si_state(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    (z, rate, phi), length = state, route.quadrature.length
    return z * length, rate * length / _seconds(route), phi


BY_FLOW: Mapping[str, Reading] = {
    "state": Along(lambda _route, state: state, of=_motion),
    "curve": Along(_point, of=_curve),
    "by_height": Along(_point, at=_at_height, of=_curve),
    "by_z": Along(lambda _route, state: state[1:], at=_at_z, of=_curve),
    "half_angle": _of_the_lowest(1),
    "descent_time": _of_the_lowest(2),
    "dhalf_angle_dz0": _of_the_lowest(4),
    "ddescent_time_dz0": _of_the_lowest(5),
    "descent_seconds": _of_the_lowest(2, _seconds),
    "arrival_time": _of_the_end(2),
    "arrival_seconds": _of_the_end(2, _seconds),
    "chord_time": _chord_time,
    "chord_gap": lambda route, _row, _: [route.value("chord_time") - route.value("arrival_time")],
    "si_curve": Along(_si_curve, of=_curve),
    "si_state": Along(_si_state, at=lambda route, t: route.m.number(t) / _seconds(route), of=_motion),
}
