"""The descent by heyoka's Taylor method, on Lagrange's equation along the curve alone."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.problems.descent.chebyshev import chebyshev_clock
from reference.problems.descent.curves import Curve, lagrange
from reference.routes.taylor import Flow

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problems.descent.problem import Descent

__all__ = ["TaylorDescent"]

GUARD_BITS = 16


@dataclass(frozen=True)
class Equation:
    """Lagrange's equation along a curve, and with it the arc s' = sqrt(N) w' from the start on."""

    curve: Curve

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(w', w'', s')"""
        w, rate, _ = y
        return *lagrange(self.curve, m, w, rate, p["g"]), m.sqrt(self.curve.profile(m, w)[2]) * rate


class System:
    """One descent as a flow takes it."""

    state_names = ("place", "place_rate", "arc")

    def __init__(self, problem: Descent) -> None:
        self.derivative = _derivative(problem.curve)
        self.parameters = problem.parameters
        self.start = (*problem.start, Fraction(0))


@lru_cache(maxsize=64)
def _derivative(curve: Curve) -> Any:
    """The same function for the same curve, so that it is compiled once."""
    return Equation(curve).derivative


class TaylorDescent:
    """The rows that the flow of the equation of motion gives by itself."""

    def __init__(self, problem: Descent, bits: int) -> None:
        self._problem, self._bits = problem, bits
        system: Any = System(problem)
        self._flow = Flow(system, bits)

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Fraction, ...]]:
        by_row: dict[str, Callable[[Sequence[Any]], list[tuple[Fraction, ...]]]] = {
            "state": lambda times: [state[:2] for state in self._flow.at(times)],
            "motion": lambda times: [self._body(*state) for state in self._flow.at(times)],
            "passage": self._passages,
            "descent_time": lambda _: [(self._times([Fraction(1)])[0],)],
            "arc_length": lambda _: [(self._arc(),)],
        }
        return by_row[row](arguments)

    def _body(self, w: Fraction, rate: Fraction, _arc: Fraction) -> tuple[Fraction, ...]:
        """Where the body is and its velocity r_w w', from the state."""
        place, by_time, curve = MPMATH.number(w), MPMATH.number(rate), self._problem.curve
        dx, dy = curve.slopes(MPMATH, place)
        found = (
            curve.horizontal(MPMATH, place),
            curve.height(MPMATH, place),
            mp.hypot(dx, dy) * by_time,
            dx * by_time,
            dy * by_time,
        )
        return tuple(to_fraction(value) for value in found)

    def _passages(self, fractions: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        times = self._times(fractions)
        states = self._flow.at(times)
        return [(t, *self._body(*state)[:4]) for t, state in zip(times, states, strict=True)]

    def _times(self, fractions: Sequence[Fraction]) -> list[Fraction]:
        """When the flow passes the fractions: t + d/w' - w'' d^2/(2 w'^3), d the way that is missing at a guess t.

        The correction leaves the third power of the guess's error, of which a third of the bits is therefore asked.
        """
        times = self._guessed(fractions, self._bits // 3 + GUARD_BITS)
        states = self._flow.at(times)
        return [self._corrected(w, t, state) for w, t, state in zip(fractions, times, states, strict=True)]

    def _corrected(self, sought: Fraction, t: Fraction, state: Sequence[Fraction]) -> Fraction:
        if sought == self._problem.released:
            return Fraction(0)
        w, by_time, _ = (MPMATH.number(value) for value in state)
        missing = MPMATH.number(sought) - w
        _, bend = lagrange(self._problem.curve, MPMATH, w, by_time, MPMATH.number(self._problem.g))
        return to_fraction(MPMATH.number(t) + missing / by_time - bend * missing**2 / (2 * by_time**3))

    def _guessed(self, fractions: Sequence[Fraction], bits: int) -> list[Fraction]:
        with mp.workprec(bits + self._problem.working_bits(fractions)):
            clock, scale = chebyshev_clock(self._problem.slide), mp.sqrt(2 * MPMATH.number(self._problem.g))
            found = [to_fraction(clock.time(MPMATH.number(w))[0] / scale) for w in fractions]
        return [t if w > self._problem.released else Fraction(0) for w, t in zip(fractions, found, strict=True)]

    def _arc(self) -> Fraction:
        (end,) = self._times([Fraction(1)])
        ((_, _, arc),) = self._flow.at([end])
        return arc
