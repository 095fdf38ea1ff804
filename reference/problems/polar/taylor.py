"""The brachistochrone in a central field by heyoka's Taylor method: the motion in time, and the curve in psi."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.once import cached_property
from reference.problems.polar.optimality import chord_geometry
from reference.routes.taylor import Flow

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.problems.polar.equations import Field
    from reference.problems.polar.numerical import Numerical

__all__ = ["Equations", "System", "TaylorExtremal"]

ZERO, ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True)
class System:
    """An equation, its start and its parameter: what a flow is of."""

    derivative: Callable[[Any, Any, Sequence[Any], dict[str, Any]], tuple[Any, ...]]
    state_names: tuple[str, ...]
    start: tuple[Fraction, ...]
    parameters: dict[str, Fraction]


class Equations:
    """The differential equations of one law of force; what is compiled of them serves every extremal."""

    def __init__(self, field: Field) -> None:
        self._field = field

    def motion(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(z, z', phi)' in tau."""
        acceleration, turn = self._field.motion(m, y[0], p["kappa"])
        return y[1], acceleration, turn

    def curve(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(psi, phi, tau)' in psi."""
        cosine2 = m.cos(y[0] / 2) * m.cos(y[0] / 2)
        return m.number(ONE), *self._field.rates(m, p["z0"], 1 - cosine2, cosine2)

    def bead(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(s, s')' in tau on a straight line at the angle beta with the radius, z^2 = 1 - 2 s cos(beta) + s^2."""
        cosine = p["cosine"]
        return y[1], (cosine - y[0]) * self._field.pull(m.sqrt(1 - y[0] * (2 * cosine - y[0])))


@lru_cache
def equations_of(field: Field) -> Equations:
    """One object for a law of force, by which compiled equations are known."""
    return Equations(field)


class TaylorExtremal:
    """The rows that integrating gives; ``form`` is asked for z0, and for psi where an argument is none of either's."""

    def __init__(self, form: Numerical, kappa: Fraction | None, bits: int) -> None:
        self._form, self._equations, self._bits = form, equations_of(form.field), bits
        kappa, z0 = kappa or to_fraction(form.kappa), to_fraction(form.z0)
        equations = self._equations
        self._motion = self._flow(equations.motion, ("z", "z_rate", "phi"), (ONE, ZERO, ZERO), kappa=kappa)
        self._curve = self._flow(equations.curve, ("psi", "phi", "tau"), (ZERO, ZERO, ZERO), z0=z0)

    def _flow(self, derivative: Any, names: tuple[str, ...], start: tuple[Fraction, ...], **of: Fraction) -> Flow:
        return Flow(System(derivative, names, start, of), self._bits)

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Fraction, ...]]:
        once: dict[str, Callable[[], Fraction]] = {
            "half_angle": lambda: self._lowest[1],
            "descent_time": lambda: self._lowest[2],
            "dhalf_angle_dz0": lambda: self._lowest[4],
            "ddescent_time_dz0": lambda: self._lowest[5],
            "arrival_time": lambda: self._arrival,
            "chord_time": lambda: self._chord,
            "chord_gap": lambda: self._chord - self._arrival,
            "descent_seconds": lambda: self._lowest[2] * self._second,
            "arrival_seconds": lambda: self._arrival * self._second,
        }
        if row in once:
            return [(once[row](),)]
        along: dict[str, Callable[[Sequence[Fraction]], list[tuple[Fraction, ...]]]] = {
            "state": self._motion.at,
            "curve": self._at_psis,
            "by_height": self._by_height,
            "by_z": self._by_z,
            "si_curve": self._si_curve,
            "si_state": self._si_state,
        }
        return along[row](arguments)

    @cached_property
    def _ends(self) -> list[tuple[Fraction, ...]]:
        """psi, phi, tau and their derivatives by z0, at the lowest point and at the end."""
        return self._curve.at([to_fraction(psi) for psi in (+mp.pi, self._form.psi_end)], ("z0",))

    @property
    def _lowest(self) -> tuple[Fraction, ...]:
        return self._ends[0]

    @property
    def _arrival(self) -> Fraction:
        return self._ends[1][2]

    @cached_property
    def _chord(self) -> Fraction:
        """When the bead is at the end of the line, or halfway where it would come to rest there: twice as long.

        Newton's method by the flow, from a time in double precision.
        """
        length, _, cosine = chord_geometry(MPMATH, *self._form.chord)
        folded = 1 if self._form.last[0] else 2
        bead = self._flow(self._equations.bead, ("way", "speed"), (ZERO, ZERO), cosine=to_fraction(cosine))
        time, end = Fraction(float(self._form.chord_time)) / folded, to_fraction(length) / folded
        for _ in range(round(math.log2(self._bits / 53)) + 1):
            ((way, speed),) = bead.at([time])
            time += (end - way) / speed
        return time * folded

    @cached_property
    def _second(self) -> Fraction:
        return to_fraction(self._form.time_unit)

    def _at_psis(self, psis: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        """z by its definition, phi and tau by the flow."""
        heights = [to_fraction(self._form.height(MPMATH.number(psi))) for psi in psis]
        return [(z, *state[1:]) for z, state in zip(heights, self._curve.at(psis), strict=True)]

    def _by_height(self, heights: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        psis = [self._form.psi_of_height(MPMATH.number(height)) for height in heights]
        return self._at_psis([to_fraction(psi) for psi in psis])

    def _by_z(self, values: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        psis = [self._form.psi_of_height((MPMATH.number(z) - self._form.z0) / (1 - self._form.z0)) for z in values]
        return [state[1:] for state in self._at_psis([to_fraction(psi) for psi in psis])]

    def _si_curve(self, psis: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        length = to_fraction(self._form.length)
        return [(z * length, tau * self._second) for z, _, tau in self._at_psis(psis)]

    def _si_state(self, times: Sequence[Fraction]) -> list[tuple[Fraction, ...]]:
        length = to_fraction(self._form.length)
        states = self._motion.at([time / self._second for time in times])
        return [(z * length, rate * length / self._second, phi) for z, rate, phi in states]
