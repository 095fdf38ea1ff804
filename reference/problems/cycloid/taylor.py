"""How the Taylor route reads the rows of the cycloid's problems: of flows of differential equations alone.

The brachistochrone and its curve are read of a bead's descent from the cusp in units of R and sqrt(R/g), whose time is
the angle: neither the radius nor the depth, in which the curve starts with a root, is in its equation.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.problems.cycloid.equations import arc_acceleration, depth, point_from_bottom, slowness
from reference.routes.flow import Flow, System
from reference.routes.taylor import Along, Reached

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.routes.taylor import Reading, TaylorRoute

__all__ = ["BRACHISTOCHRONE_BY_FLOW", "CURVE_BY_FLOW", "PENDULUM_BY_FLOW", "SWING_BY_FLOW"]

ONE, ZERO = Fraction(1), Fraction(0)


def bead(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
    """(s, s', x)' of a bead on the cycloid: s'' by its equation, and dx/dtheta = y with theta' = sqrt(g/R)."""
    del t
    arc, rate, _ = y
    radius, g = p["radius"], p["g"]
    return rate, arc_acceleration(arc - 4 * radius, radius, g), depth(arc, radius) * m.sqrt(g / radius)


def chord(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
    """(c, c')' of the fraction c of a straight chord."""
    del m, t
    return y[1], p["pull"]


def neighbour(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
    """The fraction of the angle, and the time on a neighbour over that fraction, in units of the cycloid's."""
    del t
    return m.number(ONE), slowness(m, y[0], p["half"], p["pi"], p["epsilon"])


BEAD = System(bead, ("arc", "rate", "x"), (ZERO, ZERO, ZERO), {"radius": ONE, "g": ONE})


def _bead(_route: TaylorRoute) -> System:
    return BEAD


def _chord(route: TaylorRoute) -> System:
    """c'' = g y_B/(x_B^2 + y_B^2)."""
    problem = route.problem
    pull = problem.g * problem.end_y / (problem.end_x**2 + problem.end_y**2)
    return System(chord, ("c", "rate"), (ZERO, ZERO), {"pull": pull})


def _beside_the_end(m: Any, y: Sequence[Any], problem: Any) -> Any:
    """x/y - x_B/y_B."""
    arc, _, x = y
    return x / depth(arc, 1) - m.number(problem.end_x / problem.end_y)


def _end(route: TaylorRoute, _argument: Any) -> Any:
    return route.value("end_angle")


def _turn(route: TaylorRoute, t: Fraction) -> Any:
    """The angle sqrt(g/R) t."""
    return route.m.number(t) * mp.sqrt(route.m.number(route.problem.g) / route.value("radius"))


def _folded(route: TaylorRoute, t: Fraction) -> Any:
    """From cusp to cusp and back, over and over: what is left of whole swings."""
    angle, swing = _turn(route, t), 4 * mp.pi
    return abs(angle - swing * mp.nint(angle / swing))


def _of_the_arc(route: TaylorRoute, fraction: Fraction) -> Any:
    sine = mp.sin(route.value("end_angle") / 4)
    return 4 * mp.asin(mp.sqrt(route.m.number(fraction)) * sine)


def _state(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    radius = route.value("radius")
    return radius * state[0], mp.sqrt(route.m.number(route.problem.g) * radius) * state[1]


def _point(radius: Any, state: Sequence[Any]) -> tuple[Any, ...]:
    arc, _, x = state
    return radius * x, radius * depth(arc, 1)


def _on_the_way(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    return _point(route.value("radius"), state)


def _neighbour_gap(route: TaylorRoute, _row: str, epsilons: Sequence[Fraction]) -> list[Any]:
    found, half, time = [], to_fraction(route.value("end_angle") / 2), route.value("descent_time")
    for epsilon in epsilons:
        parameters = {"half": half, "pi": to_fraction(+mp.pi), "epsilon": epsilon}
        ((_, mean),) = Flow(System(neighbour, ("fraction", "time"), (ZERO, ZERO), parameters), route.bits).at([ONE])
        found.append(time * (route.m.number(mean) - 1))
    return found


def _descent_time(route: TaylorRoute, _row: str, _arguments: Sequence[Any]) -> list[Any]:
    return [route.value("end_angle") * mp.sqrt(route.value("radius") / route.m.number(route.problem.g))]


def _chord_gap(route: TaylorRoute, _row: str, _arguments: Sequence[Any]) -> list[Any]:
    return [route.value("chord_time") - route.value("descent_time")]


BRACHISTOCHRONE_BY_FLOW: Mapping[str, Reading] = {
    "state": Along(_state, at=_turn, of=_bead),
    "position": Along(_on_the_way, at=_folded, of=_bead),
    "curve": Along(_on_the_way, at=lambda route, f: route.value("end_angle") * route.m.number(f), of=_bead),
    "arc": Along(_on_the_way, at=_of_the_arc, of=_bead),
    "radius": Along(lambda route, s: route.m.number(route.problem.end_y) / depth(s[0], 1), at=_end, of=_bead),
    "end_angle": Reached(_beside_the_end, of=_bead),
    "descent_time": _descent_time,
    "arc_length": Along(lambda route, state: route.value("radius") * state[0], at=_end, of=_bead),
    "chord_time": Reached(lambda _m, y, _problem: y[0], to=ONE, of=_chord),
    "chord_gap": _chord_gap,
    "neighbour_gap": _neighbour_gap,
}


def _of_the_depth(route: TaylorRoute, y: Fraction) -> Any:
    return 2 * mp.asin(mp.sqrt(route.m.number(y / (2 * route.problem.radius))))


def _on_the_curve(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    return _point(route.parameters["radius"], state)


CURVE_BY_FLOW: Mapping[str, Reading] = {
    "state": Along(_on_the_curve, at=_of_the_depth, of=_bead),
    "curve": Along(_on_the_curve, of=_bead),
}


def _from_the_bottom(_m: Any, y: Sequence[Any], _problem: Any) -> Any:
    return y[0]


def _period(route: TaylorRoute, _row: str, arguments: Sequence[Any]) -> list[Any]:
    """Twice the time from one passage through the bottom to the next; near the cusp heyoka's events take long."""
    (guess,) = route.guesses("descent_time", arguments)
    first, second = route.corrected(_from_the_bottom, [0, 0], [guess, 3 * guess])
    return [2 * (second - first)]


def _position(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    return point_from_bottom(route.m, state[0], route.parameters["radius"])


def _arc(route: TaylorRoute, state: Sequence[Any]) -> tuple[Any, ...]:
    (theta, omega), radius = state, route.parameters["radius"]
    return 4 * radius * mp.sin(theta / 2), 2 * radius * mp.cos(theta / 2) * omega


PENDULUM_BY_FLOW: Mapping[str, Reading] = {
    "state": Along(),
    "descent_time": Reached(_from_the_bottom),
    "period": _period,
    "energy": Along(
        lambda route, state: route.problem.invariant(route.m, state, route.parameters),
        at=lambda route, _: Fraction(float(route.problem.descent_time())) / 2,
    ),
}
SWING_BY_FLOW: Mapping[str, Reading] = {**PENDULUM_BY_FLOW, "position": Along(_position), "arc": Along(_arc)}
