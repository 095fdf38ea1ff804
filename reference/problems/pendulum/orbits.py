"""The pendulum's action–angle variables: of librations, of rotations, and about rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import acb, arb

from reference.arithmetic.namespaces import BALL
from reference.orbits import NOWHERE, Place

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from reference.problem import Problem

__all__ = ["Librations", "PendulumOrbits", "Rotations", "Small"]


class PendulumOrbits:
    """With s, c = sin, cos(theta/2), w = sqrt(g/l), p = theta'/(2 w): the modulus k has k^2 = s^2 + p^2."""

    def __init__(self, problem: Problem) -> None:
        parameters = problem.parameters
        self.w = (BALL.number(parameters["g"]) / BALL.number(parameters["length"])).sqrt()
        self._start = self.place([BALL.number(value) for value in problem.start])
        periodic = problem.serves("period")
        self._frequency = 1 / problem.closed_form(BALL).rows("period", [None])[0][0] if periodic else arb(0)

    def truth(self, t: Fraction) -> Place:
        """The start's phase, t/T later."""
        phase = self._start.phase
        return Place(None if phase is None else phase + BALL.number(t) * self._frequency, self._start.amplitude)

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of a state (theta, theta')."""
        raise NotImplementedError

    def _half(self, y: Sequence[arb]) -> tuple[arb, arb, arb]:
        """(s, c, p), less the whole turns, so that c > 0."""
        s, c = (y[0] / 2).sin_cos()
        return (s, c, y[1] / (2 * self.w)) if c > 0 else (-s, -c, y[1] / (2 * self.w))


class Librations(PendulumOrbits):
    """sn u = s/k, cn u = p/k: phase u/(4 K) since the last upward passage through the bottom, amplitude 2 asin k."""

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of a state with less energy than the separatrix."""
        s, c, p = self._half(y)
        squares = s * s, p * p
        square, rest = squares[0] + squares[1], (c - p) * (c + p)
        if not (square > 0 and rest > 0):
            return NOWHERE
        k, kc = square.sqrt(), rest.sqrt()
        rising = s * _first_kind(squares[1], squares[1] + rest * squares[0], square)
        quarters = rising / _complete(kc)
        return Place((quarters if p >= 0 else 2 - quarters) / 4, 2 * arb.atan2(k, kc))


class Rotations(PendulumOrbits):
    """Phase in turns: whole ones, and F(theta/2, 1/k)/(2 K(1/k)) since the bottom; a rotation has no amplitude."""

    def __init__(self, problem: Problem) -> None:
        self._direction = 1 if problem.start[1] > 0 else -1
        super().__init__(problem)

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of a state that goes over the top in the motion's direction."""
        s, c, p = self._half(y)
        if not (p * self._direction > 0 and abs(p) > c):
            return NOWHERE
        square = s * s + p * p
        k = square.sqrt()
        since = s * _first_kind(c * c, p * p / square, arb(1))
        turn = 2 * _complete(((p - c) * (p + c)).sqrt() / k)
        return Place(self._direction * since / turn, None)


class Small(Librations):
    """About rest: the exact motion has amplitude zero, and no phase."""

    def truth(self, t: Fraction) -> Place:
        """At the bottom."""
        del t
        return Place(None, arb(0))


def _first_kind(x: arb, y: arb, z: arb) -> arb:
    """Carlson's R_F (DLMF 19.16.1): F(phi, k) = sin(phi) R_F(cos^2 phi, 1 - k^2 sin^2 phi, 1), without cancellation."""
    return acb.elliptic_rf(x, y, z).real


def _complete(kc: arb) -> arb:
    """K by the arithmetic-geometric mean (DLMF 19.8.5)."""
    return arb.pi() / (2 * arb(1).agm(kc))
