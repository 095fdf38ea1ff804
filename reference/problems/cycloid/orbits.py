"""Harmonic orbits: of the linear pendulum, of arc lengths on a cycloid, and of angles there, whose sines are arcs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.namespaces import BALL
from reference.orbits import NOWHERE, Place

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from reference.problem import Problem

__all__ = ["CycloidAngles", "CycloidArcs", "Linear"]


class Linear:
    """x'' = -w^2 x with x the first of the state less ``centre``: amplitude sqrt(x^2 + (x'/w)^2)."""

    def __init__(self, problem: Problem) -> None:
        parameters = {name: BALL.number(value) for name, value in problem.parameters.items()}
        self.w, self.centre = self._constants(problem, parameters)
        self._start = self.place([BALL.number(value) for value in problem.start])

    def _constants(self, problem: Problem, parameters: dict[str, arb]) -> tuple[arb, arb]:
        """(w, centre)."""
        del problem
        return (parameters["g"] / parameters["length"]).sqrt(), arb(0)

    def truth(self, t: Fraction) -> Place:
        """The start's place, and w t/(2 pi) periods later."""
        phase = self._start.phase
        later = None if phase is None else phase + BALL.number(t) * self.w / (2 * arb.pi())
        return Place(later, self._start.amplitude)

    def place(self, y: Sequence[arb]) -> Place:
        """Phases count from the upward passage through the centre."""
        return self._polar(y[0] - self.centre, y[1] / self.w)

    @staticmethod
    def _polar(x: arb, rate: arb) -> Place:
        square = x * x + rate * rate
        return Place(arb.atan2(x, rate) / (2 * arb.pi()), square.sqrt()) if square > 0 else Place(None, square.sqrt())


class CycloidArcs(Linear):
    """The arc length: w^2 = g/(4 R); measured from the cusp, the centre is the bottom, 4 R from there."""

    def _constants(self, problem: Problem, parameters: dict[str, arb]) -> tuple[arb, arb]:
        form: Any = problem.closed_form(BALL)
        radius: arb = form.radius if hasattr(form, "radius") else parameters["radius"]
        return (parameters["g"] / radius).sqrt() / 2, 4 * radius if problem.name == "cycloid" else arb(0)


class CycloidAngles(CycloidArcs):
    """The angle theta, by its arc 4 R sin(theta/2): amplitudes are angles."""

    def place(self, y: Sequence[arb]) -> Place:
        """The place of a state that swings within the cusps."""
        sine, cosine = (y[0] / 2).sin_cos()
        phase, amplitude = self._polar(sine, cosine * y[1] / (2 * self.w))
        if amplitude is None or not amplitude < 1:
            return NOWHERE
        return Place(phase, 2 * amplitude.asin())
