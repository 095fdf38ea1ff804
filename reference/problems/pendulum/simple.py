"""The simple pendulum from any start: exact parameters, the kind of its motion, equation, closed form and routes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.limbs import BINARY64_BITS, ziv
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import ctx, mp
from reference.declaration import ENERGY_ABOVE_REST
from reference.once import cached_property
from reference.problem import SeparableProblem
from reference.problems.pendulum.chart import MANY, Chart, chart
from reference.problems.pendulum.equations import (
    ABOUT_REST,
    SWING,
    angular_acceleration,
    energy_above_rest,
    of_the_start,
)
from reference.problems.pendulum.motions import BY_QUADRATURE, CLOSED_FORMS, Motion
from reference.problems.pendulum.quantities import ROWS, SERVED
from reference.problems.pendulum.rational import rational
from reference.problems.pendulum.taylor import BY_FLOW, TAYLOR_RADIANS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from flint import arb

    from reference.arithmetic.protocols import Arithmetic, EllipticArithmetic
    from reference.certified import Certified
    from reference.declaration import Invariant, Row, StateSpace, Trial
    from reference.routes.taylor import Reading

__all__ = ["DECISION_BITS", "SimplePendulum"]

DECISION_BITS = 128
"""Precision at which a question of yes or no, or of a whole number, is first asked."""
SOON = 1e-12
"""Part of a period before which the Taylor route is not asked for events."""


@dataclass(frozen=True, repr=False)
class SimplePendulum(SeparableProblem):
    """theta'' = -(g/length) sin theta from theta(0) = theta0, theta'(0) = omega0, as ``Pendulum`` says of each."""

    theta0: Fraction
    g: Fraction
    length: Fraction
    omega0: Fraction

    name: ClassVar[str] = "pendulum"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    space: ClassVar[StateSpace] = replace(SWING, axes=("angle θ [rad]", "angular velocity ω [rad/s]"))
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = ABOUT_REST
    by_flow: ClassVar[Mapping[str, Reading]] = BY_FLOW

    def __init__(self, theta0: Any, g: Any = 9.81, length: Any = 1.0, omega0: Any = None) -> None:
        going = 0 if omega0 is None else omega0
        for name, value in (("theta0", theta0), ("g", g), ("length", length), ("omega0", going)):
            object.__setattr__(self, name, exact(value, name))
        if omega0 is None and not self._is_amplitude:
            raise ValueError(f"theta0 is {as_number(self.theta0)}; an amplitude with 0 < theta0 < pi is accepted.")
        for name in ("g", "length"):
            if getattr(self, name) <= 0:
                raise ValueError(f"{name} is {as_number(getattr(self, name))}; a positive number is accepted.")

    def __repr__(self) -> str:
        going = "" if self.omega0 == 0 and self._is_amplitude else f", omega0={as_number(self.omega0)!r}"
        fixed = f"g={as_number(self.g)!r}, length={as_number(self.length)!r}"
        return f"Pendulum(theta0={as_number(self.theta0)!r}, {fixed}{going})"

    @property
    def _is_amplitude(self) -> bool:
        """Whether theta0 is one that a release from rest takes: 0 < theta0 < pi."""
        return self.theta0 > 0 and self.turns == 0

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"g": self.g, "length": self.length}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.theta0, self.omega0

    @cached_property
    def turns(self) -> int:
        """Whole turns in theta0: the integer nearest to theta0/(2 pi)."""
        if abs(self.theta0) < 3:
            return 0
        half, what = Fraction(1, 2), f"the whole turns in theta0 = {as_number(self.theta0)}"
        whole = _decide(lambda: BALL.floor(BALL.number(self.theta0) / (2 * BALL.pi()) + BALL.number(half)), what)
        return int(whole.unique_fmpz())

    @cached_property
    def motion(self) -> str:
        """One of "libration", "rotation", "separatrix" and "rest", decided exactly by the sign of k^2 - 1.

        k^2 - 1 = (omega0/2)^2 l/g - cos^2(theta0/2).  The cosine of a rational other than 0 is transcendental, so that
        the separatrix is met at theta0 = 0, omega0^2 = 4 g/l alone, and rest at theta0 = omega0 = 0.
        """
        quarter = self.omega0**2 * self.length / (4 * self.g)
        if self.theta0 == 0:
            return (
                "rest" if not quarter else "separatrix" if quarter == 1 else "rotation" if quarter > 1 else "libration"
            )
        what = f"the motion of {self!r}"
        excess = _decide(lambda: BALL.number(quarter) - BALL.cos(BALL.number(self.theta0) / 2) ** 2, what)
        return "rotation" if excess > 0 else "libration"

    def serves(self, row: str) -> bool:
        """Whether this motion has the row."""
        return row in SERVED[self.kind]

    def row(self, name: str) -> Row:
        """The row of this name.

        Raises:
            KeyError: there is none.
            ValueError: this motion has no such thing.
        """
        if not self.serves(name) and any(row.name == name for row in self.rows):
            raise ValueError(f"{name} is not of {self!r}, which is {self.kind}; it has {', '.join(SERVED[self.kind])}.")
        return super().row(name)

    @property
    def kind(self) -> str:
        """The motion, where "release" is the libration that starts from rest."""
        return "release" if self.motion == "libration" and self.omega0 == 0 else self.motion

    @property
    def equation(self) -> str:
        """theta'' = -(g/length) sin(theta), and its start."""
        return "theta'' = -(g/length) sin(theta), theta(0) = theta0, theta'(0) = " + ("omega0" if self.omega0 else "0")

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return of_the_start(self.theta0, self.omega0)

    def time_units(self) -> dict[str, float]:
        """Its period, and sqrt(length/g), in which its equation is without numbers."""
        return {**super().time_units(), "units of sqrt(length/g)": math.sqrt(self.length / self.g)}

    @staticmethod
    def velocity(m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """theta' = omega."""
        return (momenta[0],)

    @staticmethod
    def force(m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """omega' = -(g/l) sin theta."""
        return (angular_acceleration(m, positions[0], p["g"], p["length"]),)

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy above rest, per m l^2, in 1/s^2."""
        return energy_above_rest(m, y[0], y[1], p["g"], p["length"])

    def rate(self) -> float:
        """sqrt(g/l): |d(omega')/d(theta)| <= g/l."""
        with mp.workprec(BINARY64_BITS):
            return float(mp.sqrt(MPMATH.number(self.g / self.length)))

    def closed_form(self, m: EllipticArithmetic) -> Motion:
        """The closed form of this motion in balls or in mpmath."""
        return self._closed_form(CLOSED_FORMS, m)

    def _closed_form(self, forms: dict[str, type[Motion]], m: EllipticArithmetic) -> Motion:
        theta0, omega0, g, length = (m.number(value) for value in (self.theta0, self.omega0, self.g, self.length))
        return forms[self.motion](m, theta0, omega0, g, length, self.turns)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The start, rest, and what a start at the bottom makes rational."""
        return rational(self.start, self.parameters, row, argument)

    def working_bits(self, arguments: Sequence[Any]) -> int:
        sizes = [_size(t) for t in arguments if isinstance(t, Fraction)]
        turns = max(sizes, default=0) + _size(1 + self.g / self.length + abs(self.omega0))
        return max(0, turns, _size(self.theta0)) + 2 * self._edge_bits

    @cached_property
    def _edge_bits(self) -> int:
        """About -log2 of the smaller of k and kc, the distances to rest and to the separatrix, where digits cancel."""
        if self.motion in {"rest", "separatrix"}:
            return 0
        quarter = self.omega0**2 * self.length / (4 * self.g)
        with ctx.workprec(4096 + max(0, _size(self.theta0))):
            cosine = BALL.cos(BALL.number(self.theta0) / 2) ** 2
            squares = (
                abs(BALL.number(quarter) - cosine),
                BALL.number(quarter) + BALL.sin(BALL.number(self.theta0) / 2) ** 2,
            )
            exponents = [int(man).bit_length() + int(exp) for man, exp in (ball.mid().man_exp() for ball in squares)]
        return max(0, -min(exponents) // 2)

    def chart(self, row: str, count: int, bits: int) -> Chart | None:
        """States of libration or rotation from nodes around one period, at MANY times and more."""
        if row != "state" or self.motion not in {"libration", "rotation"} or count < MANY:
            return None
        return chart(self.closed_form(BALL), count, bits)  # type: ignore[arg-type]

    def quadrature_form(self) -> Motion:
        """The same with the periods from their integrals, in mpmath."""
        return self._closed_form(BY_QUADRATURE, MPMATH)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether every argument lies in 0 <= sqrt(g/l) t <= TAYLOR_RADIANS, the last event included.

        An event almost at the start, but not there, is not found by an integration.
        """
        if self.row(row).over == "index":
            period = float(self.period())
            if float(self.certified(row, 0)) < SOON * period:
                return False
            arguments = [Fraction(period) * (index + 1) for index in arguments]
        times = [t for t in arguments if isinstance(t, Fraction)]
        return all(t >= 0 and t * t * self.g / self.length <= TAYLOR_RADIANS**2 for t in times)

    def period(self) -> Certified:
        """T in s: 4 K(k) sqrt(l/g) in libration, the time of one turn in rotation.

        Raises:
            ValueError: the separatrix and rest have none.
        """
        return self.certified("period")

    def energy(self) -> Certified:
        """E = omega0^2/2 - (g/l) cos theta0, the energy per m l^2 in 1/s^2."""
        return self.certified("energy")


def _size(value: Fraction) -> int:
    """About log2 of its absolute value."""
    return value.numerator.bit_length() - value.denominator.bit_length() + 1


def _decide(enclose: Callable[[], arb], what: str) -> arb:
    """A finite ball that is a point or does not contain zero, around the number that is called ``what``."""

    def certain(ball: arb) -> arb | None:
        return ball if (ball.is_exact() and ball.is_finite()) or not ball.contains(0) else None

    return ziv(lambda _: [[enclose()]], certain, 1, DECISION_BITS, what)[0][0]
