"""The integrand of the time on a curve, in balls and in series of balls, without 0/0 at the start.

From rest at w0 the time is t = 1/sqrt(2 g) int sqrt(N/drop) dw.  With L = 1 - w0 and a place u in [0, 1], a slide of

    order 1 has w = w0 + L u^2 and drop ~ u^2, N > 0: the curve leaves downwards;
    order 2 has w = w0 + L u and drop ~ u^2, N ~ u^2: it leaves a cusp as the cycloid does.

In both sqrt(2 g) dt/du = L sqrt(N/q) dw/du/(L u) is analytic, with q = drop/u^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import acb, arb, arb_series

from reference.problems.descent.curves import Curve, FormulaCurve
from reference.problems.descent.equations import slowness

if TYPE_CHECKING:
    from fractions import Fraction

__all__ = ["Slide"]

NARROW = 8
"""A ball is narrow if its radius is less than this part of its distance from the start."""


@dataclass(frozen=True)
class Slide:
    """A curve from the place of release on, w0 = ``released``, where the drop is of an ``order``."""

    curve: Curve
    released: Fraction
    order: int

    def way(self, m: Any, u: Any) -> tuple[Any, Any]:
        """The fraction w of the way at the place u, and dw/du."""
        length = m.number(1 - self.released)
        if self.order == 1:
            return m.number(self.released) + length * u * u, 2 * length * u
        return m.number(self.released) + length * u, length

    def slowness(self, m: Any, u: Any) -> Any:
        """sqrt(2 g) dt/du, at a complex ball or a series."""
        return m.number((1 - self.released) * (3 - self.order)) * slowness(m, *self._quotients(m, u))

    def arc_rate(self, m: Any, u: Any) -> Any:
        """ds/du = sqrt(N) dw/du, at a complex ball or a series."""
        w, by_u = self.way(m, u)
        if self.order == 1:
            return m.sqrt(self.curve.profile(m, w)[2]) * by_u
        return m.sqrt(self._quotients(m, u)[0]) * u * by_u

    def _quotients(self, m: Any, u: Any) -> tuple[Any, Any]:
        """N for order 1 and N/u^2 for order 2, and q = drop/u^2, at a complex ball or a series."""
        if isinstance(u, arb_series):
            return self._of_series(m, u) if u.coeffs()[0].is_zero() else self._plain(m, u)
        narrow = not u.contains(0) and bool(_radius(u) * NARROW < u.abs_lower())
        return self._plain(m, u) if narrow else self._of_ball(m, u)

    def _plain(self, m: Any, u: Any) -> tuple[Any, Any]:
        """As they are written."""
        start = self.curve.height(m, m.number(self.released))
        height, _, arc_square = self.curve.profile(m, self.way(m, u)[0])
        square = u * u
        return arc_square if self.order == 1 else arc_square / square, (start - height) / square

    def _of_ball(self, m: Any, u: acb) -> tuple[acb, acb]:
        """In a ball that may hold 0, by the mean value theorem.

        f(w) - f(w0) = (w - w0) int_0^1 f'(w0 + r (w - w0)) dr lies in w - w0 times the convex hull of f' on the segment
        from w0 to w.
        """
        length, w = m.number(1 - self.released), self.way(m, u)[0]
        segment = acb(m.number(self.released)).union(w)
        if self.order == 1:
            return self.curve.profile(m, w)[2], -length * self.curve.profile(m, segment)[1]
        ddx, ddy = self._formulas.second_slopes(m, segment)
        return length**2 * (ddx**2 + ddy**2), -(length**2) * ddy / 2

    def _of_series(self, m: Any, u: arb_series) -> tuple[Any, arb_series]:
        """In a series in x about 0, u = unit x, by shifting coefficients: those that are left out are zero."""
        unit, w = u.coeffs()[1], self.way(m, u)[0]
        height, _, arc_square = self.curve.profile(m, w)
        if self.order == 2:
            dx, dy = (_shifted(slope, 1, unit) for slope in self.curve.slopes(m, w))
            arc_square = dx * dx + dy * dy
        return arc_square, -_shifted(height, 2, unit)

    @property
    def _formulas(self) -> FormulaCurve:
        """The curve, of those that can have a cusp."""
        if not isinstance(self.curve, FormulaCurve):
            raise TypeError(f"{self.curve.name} has no second slopes.")
        return self.curve


def _radius(u: acb) -> arb:
    return arb(u.real.rad()) + arb(u.imag.rad())


def _shifted(series: Any, places: int, unit: arb) -> arb_series:
    """The series divided by (unit x)^places, without the coefficients before that, and known that much less far."""
    if not isinstance(series, arb_series):
        return arb_series([])
    return arb_series([value / unit**places for value in series.coeffs()[places:]], series.prec - places)
