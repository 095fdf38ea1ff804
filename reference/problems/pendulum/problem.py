"""The pendulum released from rest, as a problem: exact parameters, proven answers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from flint import arb, ctx
from mpmath import mp

from reference.arithmetic import BALL, MPMATH, Arithmetic, EllipticArithmetic
from reference.exact import as_number, exact
from reference.limbs import ziv
from reference.problem import Row, SeparableProblem
from reference.problems.pendulum.equations import angular_acceleration, energy_above_rest
from reference.problems.pendulum.libration import Libration, QuadratureLibration, TaylorLibration
from reference.problems.pendulum.quantities import ROWS
from reference.routes import quadrature

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.certify import Certified

__all__ = ["MAX_EVENTS", "Events", "Pendulum"]

NOT_BY_TAYLOR = ("modulus", "complementary_modulus")
TAYLOR_RADIANS = 4000
"""The Taylor route serves times up to omega0 t = TAYLOR_RADIANS: beyond, its work would grow without bound."""
TAYLOR_BITS = 1024
"""The Taylor route serves amplitudes that need at most this working precision."""
ROUTE_BITS = 8192
"""No route but the enclosure serves what needs more working precision than this."""
MAX_EVENTS = 100_000


@dataclass(frozen=True)
class Events:
    """Proven times in s: where theta = 0, and where theta' = 0 after the start."""

    zero_crossings: tuple[Certified, ...]
    turning_points: tuple[Certified, ...]


@dataclass(frozen=True, repr=False)
class Pendulum(SeparableProblem):
    """The pendulum released from rest at ``theta0``: theta'' = -(g/length) sin theta.

    Args:
        theta0: amplitude in rad, 0 < theta0 < pi.
        g: acceleration of gravity in m/s^2, positive.
        length: length in m, positive.

    Each is exact: a float at its binary64 value, a string or Fraction as the rational it spells.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    theta0: Fraction
    g: Fraction
    length: Fraction

    name: ClassVar[str] = "pendulum"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    state_names: ClassVar[tuple[str, ...]] = ("theta", "omega")
    positions: ClassVar[int] = 1

    def __init__(self, theta0: Any, g: Any = 9.81, length: Any = 1.0) -> None:
        for name, value in (("theta0", theta0), ("g", g), ("length", length)):
            object.__setattr__(self, name, exact(value, name))
        if not 0 < self.theta0 < 4 or not _below_pi(self.theta0):
            raise ValueError(f"theta0 is {as_number(self.theta0)}; an amplitude with 0 < theta0 < pi is accepted.")
        for name in ("g", "length"):
            if getattr(self, name) <= 0:
                raise ValueError(f"{name} is {as_number(getattr(self, name))}; a positive number is accepted.")

    def __repr__(self) -> str:
        return (
            f"Pendulum(theta0={as_number(self.theta0)!r}, g={as_number(self.g)!r}, length={as_number(self.length)!r})"
        )

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"g": self.g, "length": self.length}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.theta0, Fraction(0)

    @staticmethod
    def velocity(m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:  # noqa: ARG004
        """theta' = omega."""
        return (momenta[0],)

    @staticmethod
    def force(m: Arithmetic, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """omega' = -(g/l) sin theta."""
        return (angular_acceleration(m, positions[0], p["g"], p["length"]),)

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy above rest, per m l^2, in 1/s^2."""
        return energy_above_rest(m, y[0], y[1], p["g"], p["length"])

    def rate(self) -> float:
        """omega0: |d(omega')/d(theta)| <= omega0^2."""
        return float(mp.sqrt(MPMATH.number(self.g / self.length)))

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Pendulum:
        """The pendulum from theta0 less 2^-20 of its distance to the nearer of 0 and pi, or less 16 roundings."""
        edge = min(self.theta0, Fraction(math.pi) - self.theta0)
        return Pendulum(rounding(self.theta0 - max(edge / (1 << 20), 16 * epsilon * self.theta0)), self.g, self.length)

    def closed_form(self, m: EllipticArithmetic) -> Libration:
        """The closed form in balls or in mpmath."""
        return Libration(m, m.number(self.theta0), m.number(self.g), m.number(self.length))

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction, ...] | None:
        if argument != 0 or isinstance(argument, int):
            return None
        at_start = {"state": self.start, "sensitivity": (Fraction(1), Fraction(0))}
        return at_start.get(row)

    def working_bits(self, arguments: Sequence[Any]) -> int:
        times = [abs(t) for t in arguments if isinstance(t, Fraction)]
        turns = max(times, default=Fraction(0)) * (1 + self.g / self.length)
        return int(turns).bit_length() + 2 * self._edge_bits

    @property
    def _edge_bits(self) -> int:
        """About -log2 of the distance from theta0 to the nearer of 0 and pi, where digits cancel."""
        with ctx.workprec(4096):
            edge = min(BALL.number(self.theta0), arb.pi() - BALL.number(self.theta0)).mid().man_exp()
        return max(0, -(int(edge[0]).bit_length() + int(edge[1])))

    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None:
        bits = int(digits * 3.33) + 2 * self.working_bits(arguments) + 30
        if bits > ROUTE_BITS:
            return None
        if route == "quadrature":
            return quadrature.rows(lambda: QuadratureLibration(MPMATH, *self._numbers()), row, arguments, bits)
        if row in NOT_BY_TAYLOR or bits > TAYLOR_BITS or not self._within_taylor(row, arguments):
            return None
        with mp.workprec(bits):
            return TaylorLibration(self, bits).rows(row, arguments)

    def _within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether every argument lies in 0 <= omega0 t <= TAYLOR_RADIANS, the last event included."""
        if self.row(row).over == "index":
            arguments = [Fraction(float(self.period())) * (index + 1) for index in arguments]
        times = [t for t in arguments if isinstance(t, Fraction)]
        return all(t >= 0 and t * t * self.g / self.length <= TAYLOR_RADIANS**2 for t in times)

    def _numbers(self) -> tuple[Any, ...]:
        return MPMATH.number(self.theta0), MPMATH.number(self.g), MPMATH.number(self.length)

    def period(self) -> Certified:
        """T = 4 K(sin(theta0/2)) sqrt(l/g), in s."""
        return self.certified("period")

    def energy(self) -> Certified:
        """E = -(g/l) cos theta0, the energy per m l^2 in 1/s^2."""
        return self.certified("energy")

    def events(self, until: Any) -> Events:
        """The zero crossings (2j + 1) T/4 and turning points j T/2, j = 1, 2, ..., in (0, until].

        Raises:
            ValueError: ``until`` is negative or not finite, or the events before it are more than MAX_EVENTS.
        """
        end = exact(until, "until")
        if end < 0:
            raise ValueError(f"until is {as_number(end)}; a time that is not negative is accepted.")
        count = self._quarters(end)
        if count > MAX_EVENTS:
            raise ValueError(
                f"until is {as_number(end)}, with {count} events before it; at most {MAX_EVENTS} are accepted."
            )
        return Events(
            tuple(self.certified("zero_crossing", j) for j in range((count + 1) // 2)),
            tuple(self.certified("turning_point", j) for j in range(count // 2)),
        )

    def _quarters(self, end: Fraction) -> int:
        """floor(4 end/T), decided in balls."""
        if end == 0:
            return 0

        def floors(_rows: Sequence[int]) -> Sequence[Sequence[arb]]:
            return [[4 * BALL.number(end) / self.closed_form(BALL).period]]

        def whole(quarters: arb) -> int | None:
            floor = quarters.floor().unique_fmpz()
            return None if floor is None else int(floor)

        return ziv(floors, whole, 1, 128 + self.working_bits([end]), f"the number of events of {self!r}")[0][0]


def _below_pi(value: Fraction) -> bool:
    """Decide value < pi; a rational is never equal to it."""
    bits = 128
    while True:
        with ctx.workprec(bits):
            gap = arb.pi() - BALL.number(value)
            if not gap.contains(0):
                return bool(gap > 0)
        bits *= 2
