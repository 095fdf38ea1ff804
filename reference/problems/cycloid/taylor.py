"""The cycloid's problems by heyoka's Taylor method, on differential equations alone."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.once import cached_property
from reference.problems.cycloid.equations import arc_acceleration, depth, point_from_bottom, slowness
from reference.routes.taylor import Flow

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.problems.cycloid.arc import CycloidArc
    from reference.problems.cycloid.problem import Cycloid
    from reference.problems.cycloid.tautochrone import Swinging

__all__ = ["TaylorArc", "TaylorBrachistochrone", "TaylorSwing"]

ONE, ZERO = Fraction(1), Fraction(0)
Rows = list[tuple[Fraction, ...]]


@dataclass(frozen=True)
class System:
    """An equation, its start and its parameters: what a flow is of."""

    state_names: tuple[str, ...]
    start: tuple[Fraction, ...]
    parameters: dict[str, Fraction]
    derivative: Callable[[Any, Any, Sequence[Any], dict[str, Any]], tuple[Any, ...]]


def bead(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
    """(s, s', x)' of a bead on the cycloid: s'' by its equation, and dx/dtheta = y with theta' = sqrt(g/R)."""
    arc, rate, _ = y
    radius, g = p["radius"], p["g"]
    return rate, arc_acceleration(arc - 4 * radius, radius, g), depth(arc, radius) * m.sqrt(g / radius)


BEAD = System(("arc", "rate", "x"), (ZERO, ZERO, ZERO), {"radius": ONE, "g": ONE}, bead)
"""From the cusp, in units of R and sqrt(R/g): time is the angle."""


def chord(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
    """(c, c')' of the fraction c of a straight chord."""
    del m, t
    return y[1], p["pull"]


def neighbours(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
    """The fraction of the angle, and the time on each neighbour over that fraction, in units of the cycloid's."""
    half, pi, *epsilons = p.values()
    return m.number(ONE), *(slowness(m, y[0], half, pi, epsilon) for epsilon in epsilons)


class TaylorBrachistochrone:
    """By the flow of the bead in units of the radius, the end point by one shot, corrected."""

    def __init__(self, problem: Cycloid, bits: int) -> None:
        self._problem, self._bits = problem, bits
        self._flow = self._flow_of(BEAD)
        self._end_x, self._end_y, self._g = (MPMATH.number(v) for v in (problem.end_x, problem.end_y, problem.g))

    def rows(self, row: str, arguments: Sequence[Any]) -> Rows:
        by_row: dict[str, Callable[[Sequence[Any]], list[tuple[Any, ...]]]] = {
            "state": self._states,
            "position": self._positions,
            "curve": lambda fractions: self._points([self._angle * MPMATH.number(f) for f in fractions]),
            "arc": self._by_arc,
            "radius": lambda _: [(self._radius,)],
            "end_angle": lambda _: [(self._angle,)],
            "descent_time": lambda _: [(self._descent_time,)],
            "arc_length": lambda _: [(self._radius * self._end[0],)],
            "chord_time": lambda _: [(self._chord_time(),)],
            "chord_gap": lambda _: [(self._chord_time() - self._descent_time,)],
            "neighbour_gap": self._gaps,
        }
        return [tuple(to_fraction(value) for value in values) for values in by_row[row](arguments)]

    def _at(self, angles: Sequence[Any]) -> list[tuple[Any, ...]]:
        """(s, s', x) in units of the radius."""
        states = self._flow.at([to_fraction(angle) for angle in angles])
        return [tuple(MPMATH.number(value) for value in state) for state in states]

    @cached_property
    def _angle(self) -> Any:
        """x - y x_B/y_B is zero there: the angle good to half of the digits, and Newton's step by the flow."""
        with mp.workprec(self._bits // 2):
            near = +self._problem.quadrature_form().end_angle
        ((arc, rate, x),) = self._at([near])
        ratio, y = self._end_x / self._end_y, depth(arc, 1)
        return near - (x - ratio * y) / (y - ratio * rate * (1 - arc / 4))

    @cached_property
    def _end(self) -> tuple[Any, ...]:
        return self._at([self._angle])[0]

    @cached_property
    def _radius(self) -> Any:
        return self._end_y / depth(self._end[0], 1)

    @cached_property
    def _descent_time(self) -> Any:
        return self._angle * mp.sqrt(self._radius / self._g)

    def _points(self, angles: Sequence[Any]) -> list[tuple[Any, ...]]:
        return [(self._radius * x, self._radius * depth(arc, 1)) for arc, _, x in self._at(angles)]

    def _by_arc(self, fractions: Sequence[Fraction]) -> list[tuple[Any, ...]]:
        sine = mp.sin(self._angle / 4)
        return self._points([4 * mp.asin(mp.sqrt(MPMATH.number(f)) * sine) for f in fractions])

    def _angles(self, times: Sequence[Fraction]) -> list[Any]:
        return [MPMATH.number(t) * mp.sqrt(self._g / self._radius) for t in times]

    def _states(self, times: Sequence[Fraction]) -> list[tuple[Any, ...]]:
        speed = mp.sqrt(self._g * self._radius)
        return [(self._radius * arc, speed * rate) for arc, rate, _ in self._at(self._angles(times))]

    def _positions(self, times: Sequence[Fraction]) -> list[tuple[Any, ...]]:
        """From cusp to cusp and back, over and over: what is left of whole swings."""
        swing = 4 * mp.pi
        return self._points([abs(angle - swing * mp.nint(angle / swing)) for angle in self._angles(times)])

    def _chord_time(self) -> Any:
        """When the fraction c of the chord is 1: c'' = g y_B/(x_B^2 + y_B^2), by one shot, corrected."""
        problem = self._problem
        pull = problem.g * problem.end_y / (problem.end_x**2 + problem.end_y**2)
        with mp.workprec(self._bits // 2):
            near = mp.sqrt(2 / MPMATH.number(pull))
        flow = self._flow_of(System(("c", "rate"), (ZERO, ZERO), {"pull": pull}, chord))
        ((c, rate),) = flow.at([to_fraction(near)])
        return near - (MPMATH.number(c) - 1) / MPMATH.number(rate)

    def _gaps(self, epsilons: Sequence[Fraction]) -> list[tuple[Any, ...]]:
        """All neighbours side by side, over the fraction of the angle."""
        names = tuple(f"epsilon_{i}" for i in range(len(epsilons)))
        parameters = {"half": to_fraction(self._angle / 2), "pi": to_fraction(+mp.pi)}
        parameters |= dict(zip(names, epsilons, strict=True))
        flow = self._flow_of(System(("fraction", *names), (ZERO,) * (len(names) + 1), parameters, neighbours))
        ((_, *means),) = flow.at([ONE])
        return [(self._descent_time * (MPMATH.number(mean) - 1),) for mean in means]

    def _flow_of(self, system: System) -> Flow:
        return Flow(system, self._bits)


class TaylorArc:
    """The curve itself by the same flow."""

    def __init__(self, problem: CycloidArc, bits: int) -> None:
        self._radius = MPMATH.number(problem.radius)
        self._flow = Flow(BEAD, bits)

    def rows(self, row: str, arguments: Sequence[Fraction]) -> Rows:
        numbers = [MPMATH.number(argument) for argument in arguments]
        if row == "state":
            numbers = [2 * mp.asin(mp.sqrt(y / (2 * self._radius))) for y in numbers]
        states = self._flow.at([to_fraction(angle) for angle in numbers])
        points = ((self._radius * MPMATH.number(x), self._radius * depth(MPMATH.number(s), 1)) for s, _, x in states)
        return [(to_fraction(x), to_fraction(y)) for x, y in points]


@lru_cache(maxsize=4)
def swung(problem: Swinging, bits: int, times: tuple[Fraction, ...]) -> Rows:
    """The states at these times, kept: more than one row is of the same states."""
    return Flow(problem, bits).at(times)


class TaylorSwing:
    """The pendulum by its own equation of motion, in the angle or in the arc length."""

    def __init__(self, problem: Swinging, bits: int) -> None:
        self._problem, self._bits = problem, bits
        self._radius = MPMATH.number(problem.radius)

    def rows(self, row: str, arguments: Sequence[Any]) -> Rows:
        by_row: dict[str, Callable[[Sequence[Any]], list[tuple[Any, ...]]]] = {
            "state": self._states,
            "position": lambda times: [point_from_bottom(MPMATH, s[0], self._radius) for s in self._states(times)],
            "arc": lambda times: [self._arc(*state) for state in self._states(times)],
            "descent_time": lambda _: [(self._passages(1)[0],)],
            "period": lambda _: [(self._period(),)],
            "energy": lambda _: [(self._energy(),)],
        }
        return [tuple(to_fraction(value) for value in values) for values in by_row[row](arguments)]

    def _states(self, times: Sequence[Any]) -> list[tuple[Any, ...]]:
        states = swung(self._problem, self._bits, tuple(times))
        return [tuple(MPMATH.number(value) for value in state) for state in states]

    def _arc(self, theta: Any, omega: Any) -> tuple[Any, ...]:
        return 4 * self._radius * mp.sin(theta / 2), 2 * self._radius * mp.cos(theta / 2) * omega

    def _passages(self, count: int) -> list[Any]:
        """The first times at the bottom: good to half of the digits, and Newton's step by the flow."""
        with mp.workprec(self._bits // 2):
            first = self._problem.quadrature_form().descent_time
            near = [(2 * i + 1) * first for i in range(count)]
        states = self._states([to_fraction(time) for time in near])
        return [time - place / rate for time, (place, rate) in zip(near, states, strict=True)]

    def _period(self) -> Any:
        """Twice the time from one passage through the bottom to the next."""
        first, second = self._passages(2)
        return 2 * (second - first)

    def _energy(self) -> Any:
        """Of the state somewhere on the way."""
        (state,) = self._states([Fraction(float(self._problem.descent_time())) / 2])
        parameters = {name: MPMATH.number(value) for name, value in self._problem.parameters.items()}
        return self._problem.invariant(MPMATH, state, parameters)
