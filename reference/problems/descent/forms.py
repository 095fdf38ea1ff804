"""The motion on a curve in closed form but for its clock: the time as a function of the place, and back.

In balls the clock is a Taylor series with a proven rest, in mpmath a Chebyshev series in another place (clock.py,
chebyshev.py); on the cycloid the balls take the closed form.  From the place everything else is a formula.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.balls import BALL
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import ctx, mp
from reference.declaration import ClosedForm
from reference.problems.descent.chebyshev import chebyshev_clock
from reference.problems.descent.clock import arc, clock
from reference.problems.descent.equations import speed

if TYPE_CHECKING:
    from reference.problems.descent.slide import Slide

__all__ = ["BallDescent", "CycloidDescent", "QuadratureDescent", "Sliding"]


class Sliding(ClosedForm):
    """What both clocks share: w and w' at a time, t and w' at a fraction; then the body's place and velocity."""

    def __init__(self, m: Any, slide: Slide, g: Fraction) -> None:
        self.m, self.curve = m, slide.curve
        self.slide, self.g = slide, m.number(g)
        self.released = m.number(slide.released)

    def state(self, t: Any) -> tuple[Any, Any]:
        """W and w' at the time t."""
        raise NotImplementedError

    def passing(self, w: Any) -> tuple[Any, Any]:
        """The time at which the body passes w, and w' there."""
        raise NotImplementedError

    @property
    def descent_time(self) -> Any:
        return self.passing(self.m.number(Fraction(1)))[0]

    @property
    def arc_length(self) -> Any:
        raise NotImplementedError

    def velocity(self, w: Any, rate: Any) -> tuple[Any, Any, Any]:
        """Speed and velocity where w' = rate: sqrt(N) w' and (x_w, y_w) w', which cancel nothing at a small drop."""
        dx, dy = self.curve.slopes(self.m, w)
        _, _, arc_square = self.curve.profile(self.m, w)
        return self.m.sqrt(arc_square) * rate, dx * rate, dy * rate

    def motion(self, t: Any) -> tuple[Any, ...]:
        w, rate = self.state(t)
        return self.curve.horizontal(self.m, w), self.curve.height(self.m, w), *self.velocity(w, rate)

    def passage(self, w: Any) -> tuple[Any, ...]:
        t, rate = self.passing(w)
        return t, self.curve.horizontal(self.m, w), self.curve.height(self.m, w), *self.velocity(w, rate)[:2]


class BallDescent(Sliding):
    """By the clock of Taylor series."""

    def __init__(self, slide: Slide, g: Fraction) -> None:
        super().__init__(BALL, slide, g)
        self._clock = clock(slide, ctx.prec)
        self._scale = BALL.sqrt(2 * self.g)

    def state(self, t: Any) -> tuple[Any, Any]:
        u, slowness = self._clock.place(t * self._scale)
        w, by_u = self.slide.way(BALL, u)
        return w, by_u / slowness * self._scale

    def passing(self, w: Any) -> tuple[Any, Any]:
        left = (w - self.released) / BALL.number(1 - self.slide.released)
        u = BALL.sqrt(left) if self.slide.order == 1 else left
        time, slowness = self._clock.at(u)
        return time / self._scale, self.slide.way(BALL, u)[1] / slowness * self._scale

    @property
    def arc_length(self) -> Any:
        return arc(self.slide)


class CycloidDescent(Sliding):
    """On the cycloid: s'' = (g/4) (4 - s) for the arc s = 4 w, so that 1 - w = (1 - w0) cos(k t) with 2 k = sqrt(g)."""

    def __init__(self, slide: Slide, g: Fraction) -> None:
        super().__init__(BALL, slide, g)
        self._k = BALL.sqrt(self.g) / 2
        self._left = BALL.number(1 - slide.released)

    def state(self, t: Any) -> tuple[Any, Any]:
        half = BALL.sin(self._k * t / 2)
        return self.released + 2 * self._left * half * half, self._left * self._k * BALL.sin(self._k * t)

    def passing(self, w: Any) -> tuple[Any, Any]:
        half = BALL.asin(BALL.sqrt((w - self.released) / (2 * self._left)))
        return 2 * half / self._k, self._left * self._k * BALL.sin(2 * half)

    @property
    def descent_time(self) -> Any:
        """A quarter of the period, from wherever it is released."""
        return BALL.pi() / (2 * self._k)

    @property
    def arc_length(self) -> Any:
        return 4 * self._left


class QuadratureDescent(Sliding):
    """By the clock of Chebyshev series in mpmath, and the speed from the drop."""

    def __init__(self, slide: Slide, g: Fraction) -> None:
        super().__init__(MPMATH, slide, g)
        self._clock = chebyshev_clock(slide)
        self._scale = mp.sqrt(2 * self.g)
        self._start = self.curve.height(MPMATH, self.released)

    def state(self, t: Any) -> tuple[Any, Any]:
        w, rate = self._clock.place(t * self._scale)
        return w, rate * self._scale

    def passing(self, w: Any) -> tuple[Any, Any]:
        time, rate = self._clock.time(w)
        return time / self._scale, rate * self._scale

    def velocity(self, w: Any, rate: Any) -> tuple[Any, Any, Any]:
        """By the drop and the tangent."""
        if w == self.released:
            return (0 * rate,) * 3
        dx, dy = self.curve.slopes(MPMATH, w)
        height, _, arc_square = self.curve.profile(MPMATH, w)
        found = speed(MPMATH, self._start - height, self.g)
        return found, found * dx / mp.sqrt(arc_square), found * dy / mp.sqrt(arc_square)

    @property
    def arc_length(self) -> Any:
        def rate(m: Any, w: Any) -> Any:
            return m.sqrt(self.curve.profile(m, w)[2])

        return MPMATH.integral(rate, self.released, mp.mpf(1))
