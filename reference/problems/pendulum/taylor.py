"""The pendulum by heyoka's Taylor method, on the equation of motion alone."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic import quadrature
from reference.arithmetic.namespaces import MPMATH
from reference.problems.pendulum.equations import condition, energy
from reference.routes.taylor import Flow

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.problems.pendulum.problem import Pendulum

__all__ = ["TAYLOR_RADIANS", "TaylorMotion", "hanging"]

TAYLOR_RADIANS = 4000
"""The Taylor route serves times up to sqrt(g/l) t = TAYLOR_RADIANS: beyond, its work would grow without bound."""


class TaylorMotion:
    """The rows that the flow of the equation of motion gives by itself."""

    def __init__(self, problem: Pendulum, bits: int) -> None:
        self._problem, self._flow = problem, Flow(problem, bits)
        self._bottom = hanging if problem.motion == "libration" and not problem.turns else through_the_bottom

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Fraction, ...]]:
        by_row: dict[str, Callable[[Sequence[Any]], list[tuple[Fraction, ...]]]] = {
            "state": self._flow.at,
            "sensitivity": lambda times: [state[2:] for state in self._flow.at(times, ("theta",))],
            "curvature": lambda times: [state[4:] for state in self._flow.at(times, ("theta",), 2)],
            "condition": self._conditions,
            "gradient": lambda times: [state[2:] for state in self._flow.at(times, EVERYTHING)],
            "zero_crossing": lambda indices: self._at_zeros(self._bottom, indices),
            "turning_point": lambda indices: self._at_zeros(at_rest, indices),
            "period": lambda _: [(self._period(),)],
            "dperiod_damplitude": lambda _: [(self._period_by_amplitude()[0],)],
            "d2period_damplitude2": lambda _: [(self._period_by_amplitude()[1],)],
            "energy": lambda _: [(self._energy(),)],
        }
        return by_row[row](arguments)

    def _at_zeros(self, event: Any, indices: Sequence[int]) -> list[tuple[Fraction, ...]]:
        until = float(self._problem.period()) * (max(indices) + 1.01)
        times = self._flow.zeros(event, until)
        return [(times[index],) for index in indices]

    def _period(self) -> Fraction:
        """From one passage through the bottom to the next, which in libration is half a period."""
        (first,), (second,) = self._at_zeros(self._bottom, (0, 1))
        return (second - first) * (1 if self._problem.motion == "rotation" else 2)

    def _period_by_amplitude(self) -> tuple[Fraction, Fraction]:
        """dT/da and d^2T/da^2, a = |theta0|, from theta(T/4) = 0 for every amplitude; theta'' = 0 there.

        With q = T/4 and subscripts for derivatives by theta0: theta_a + omega q_a = 0 and
        theta_aa + 2 omega_a q_a + omega q_aa = 0.
        """
        ((quarter,),) = self._at_zeros(self._bottom, (0,))
        ((_, omega, theta_a, omega_a, theta_aa, _),) = self._flow.at([quarter], ("theta",), 2)
        slope = -theta_a / omega
        return 4 * slope * (1 if self._problem.theta0 > 0 else -1), -4 * (theta_aa + 2 * omega_a * slope) / omega

    def _conditions(self, times: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        w = MPMATH.sqrt(MPMATH.number(self._problem.g / self._problem.length))
        slopes = ([MPMATH.number(value) for value in state[2:]] for state in self._flow.at(times, ("theta", "omega")))
        return [(quadrature.to_fraction(condition(MPMATH, w, *four)),) for four in slopes]

    def _energy(self) -> Fraction:
        """Of the state somewhere on the way."""
        ((theta, omega),) = self._flow.at([Fraction(1 / self._problem.rate())])
        numbers = [MPMATH.number(value) for value in (theta, omega, self._problem.g, self._problem.length)]
        return quadrature.to_fraction(energy(MPMATH, *numbers))


EVERYTHING = ("theta", "omega", "g", "length")


def hanging(m: Arithmetic, y: Sequence[Any]) -> Any:
    """Zero where theta is: the same as below, and cheaper, where there are no whole turns."""
    del m
    return y[0]


def through_the_bottom(m: Arithmetic, y: Sequence[Any]) -> Any:
    """Zero where the pendulum hangs at the bottom, after any whole turns."""
    return m.sin(y[0] / 2)


def at_rest(m: Arithmetic, y: Sequence[Any]) -> Any:
    """Zero where the pendulum turns back."""
    del m
    return y[1]
