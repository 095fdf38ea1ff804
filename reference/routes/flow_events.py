"""When a function of a proven flow crosses zero: each crossing proven, and none missed.

On a piece of the flow the function g(t, y(t)) and its rate g_t + dg/dy f are enclosed in balls over intervals.  The
pieces are cut into parts on each of which one of the two has no zero, so that a crossing lies in no part of the first
kind, and at most one in parts of the second kind that follow each other.  Newton's operator narrows each of them.
docs/flows.md proves it, as rule 16.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.balls import BALL
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.models import ModelArithmetic, Tape, Variable
from reference.arithmetic.precision import ctx
from reference.arithmetic.rational import RATIONAL, IrrationalError
from reference.routes.proven_flow import KEPT, HorizonError, proven, put_off

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.routes.proven_flow import Piece, ProvenFlow

    Function = Callable[[Any, Any, Sequence[Any], dict[str, Any]], Any]
    """g(m, t, y, p), in any arithmetic."""

__all__ = ["ProvenCrossings", "TangencyError", "crossing_times", "crossings"]

QUIET = 1 << 11
"""Pieces that are granted from one crossing to the next."""
GAIN = 0.75
"""An interval that Newton's operator leaves longer than that part of itself is as short as it gets."""


class TangencyError(HorizonError):
    """A function of a flow may touch zero without crossing it, or cross it twice within a distance that is not told."""

    def __init__(self, equation: Any, reached: Fraction, bits: int) -> None:
        WorkBoundError.__init__(
            self,
            f"the event of {equation!r} and its rate may both be zero at t = {float(reached):.10g}, and in {bits} bits "
            "neither is told from it: crossings are proven where they are simple.",
        )
        self.reached = reached


@dataclass(frozen=True)
class _Part:
    """An interval of a piece, low <= s <= high, on which g has a sign, or else its rate has one."""

    piece: Piece
    low: arb
    high: arb
    sign: int
    slope: int

    @property
    def time(self) -> arb:
        """A ball that holds its times."""
        return BALL.number(self.piece.t) + BALL.number(self.piece.h) * self.low.union(self.high)


def _sign(ball: arb) -> int:
    """1 or -1 where every point of the ball has that sign; 0 where not, and of what is not finite."""
    return 1 if ball > 0 else -1 if ball < 0 else 0


class ProvenCrossings:
    """The times t > 0 at which a function of a flow crosses zero, in order, in both directions.

    They are sought as far as is asked, and kept.

    Args:
        flow: the flow.
        function: g(m, t, y, p), in any arithmetic, and smooth.
        vanishes: whether it is known to be exactly zero at the start, which is no crossing then.

    Raises:
        ValueError: the function takes a branch, or is none of the state and the time.
    """

    def __init__(self, flow: ProvenFlow, function: Function, *, vanishes: bool = False) -> None:
        self.flow, self._function, self._vanishes = flow, function, vanishes
        self.times: list[arb] = []
        self.settled = Fraction(0)
        """Every crossing up to here is among the times."""
        self._sign = 0
        self._run: list[_Part] = []
        self._place = 0
        self._depth = flow.bits // 2
        with ctx.workprec(flow.bits):
            self._p = {name: BALL.number(value) for name, value in flow.equation.parameters.items()}
            self._require_smooth()

    def at(self, index: int) -> arb:
        """The time of a crossing, counted from 0.

        Raises:
            TangencyError: before it the function may touch zero without crossing it.
            WorkBoundError: the flow is not proven so far, or there is no crossing in QUIET pieces.
        """
        since = self._place
        while len(self.times) <= index:
            known = len(self.times)
            self._further()
            since = self._place if len(self.times) > known else since
            if self._place - since >= QUIET:
                raise WorkBoundError(
                    f"the event of {self.flow.equation!r} crosses zero {len(self.times)} times up to "
                    f"t = {float(self.settled):.6g}, and in {QUIET} steps no more, which are all that is granted."
                )
        return self.times[index]

    def count(self, until: Fraction) -> int | None:
        """How many crossings there are in (0, until]; None where one is too near to the end to be told.

        Raises:
            TangencyError: before it the function may touch zero without crossing it.
            WorkBoundError: the flow is not proven so far.
        """
        while self.settled <= until:
            self._further()
        with ctx.workprec(self.flow.bits):
            end = BALL.number(until)
            if any(time.overlaps(end) for time in self.times):
                return None
            return sum(bool(time < end) for time in self.times)

    def _require_smooth(self) -> None:
        """Read the function once in the arithmetic of steps, which has no branches."""
        tape, equation = Tape(), self.flow.equation
        t, *y = (Variable(tape, lambda _: arb(0)) for _ in range(1 + len(equation.state_names)))
        try:
            self._function(ModelArithmetic(tape), t, y, self._p)
        except (AttributeError, TypeError) as failure:
            raise ValueError(f"the event of {equation!r} is no smooth formula: {failure}") from failure

    def _further(self) -> None:
        """One more piece."""
        piece = self.flow.piece(self._place)
        with ctx.workprec(self.flow.bits):
            parts = self._parts(piece)
            if not self._place:
                self._sign = self._begun(parts[0])
            for part in parts:
                self._follow(part)
            if self._run and (sign := _sign(self._enclosed(piece, arb(1))[0])):
                self._close(sign)
            self.settled = self._run[0].piece.t if self._run else piece.t + piece.h
        self._place += 1

    def _begun(self, first: _Part) -> int:
        """The sign just after the start.

        Raises:
            TangencyError: it is not told.
        """
        if self._vanishes:
            return first.slope
        sign = first.sign or _sign(self._enclosed(first.piece, arb(0))[0])
        if not sign:
            raise TangencyError(self.flow.equation, Fraction(0), self.flow.bits)
        return sign

    def _enclosed(self, piece: Piece, s: arb) -> tuple[arb, arb]:
        """g and its rate on a ball of s."""
        equation = self.flow.equation
        time = BALL.number(piece.t) + BALL.number(piece.h) * s
        y = [one(s) + arb(0, error) for one, error in zip(piece.polynomials, piece.errors, strict=True)]
        rates = equation.derivative(BALL, time, y, self._p)
        duals: Any = DualArithmetic(BALL, 1)
        moving = [
            Dual(value, (BALL.number(rate) if isinstance(rate, Fraction) else arb(rate),))
            for value, rate in zip(y, rates, strict=True)
        ]
        found = self._function(duals, Dual(time, (arb(1),)), moving, self._p)
        return (found.value, found.slopes[0]) if isinstance(found, Dual) else (arb(found), arb(0))

    def _parts(self, piece: Piece) -> list[_Part]:
        """The piece in parts, in order.

        Raises:
            TangencyError: one of them is too short, and still neither g nor its rate has a sign.
        """
        found, left = list[_Part](), [(arb(0), arb(1), 0)]
        while left:
            low, high, depth = left.pop()
            sign, slope = self._signs(piece, low, high)
            if sign or slope:
                found.append(_Part(piece, low, high, sign, slope))
                continue
            if depth >= self._depth:
                raise TangencyError(self.flow.equation, piece.t + piece.h * _fraction(low), self.flow.bits)
            middle = ((low + high) / 2).mid()
            left += [(middle, high, depth + 1), (low, middle, depth + 1)]
        return found

    def _signs(self, piece: Piece, low: arb, high: arb) -> tuple[int, int]:
        """The sign of g on a part, or else of its rate; that of g also by its rate about the middle."""
        s = low.union(high)
        value, rate = self._enclosed(piece, s)
        if sign := _sign(value):
            return sign, 0
        if slope := _sign(rate):
            return 0, slope
        middle = s.mid()
        if not (low <= middle <= high and rate.is_finite()):
            return 0, 0
        value, _ = self._enclosed(piece, middle)
        return _sign(value + rate * BALL.number(piece.h) * (s - middle)), 0

    def _follow(self, part: _Part) -> None:
        """Take the next part: where g has a sign, what is monotone before it ends there."""
        if part.sign:
            self._close(part.sign)
        elif self._run and self._run[-1].slope != part.slope:
            raise ArithmeticError(f"the rate of the event of {self.flow.equation!r} has two signs at one time.")
        else:
            self._run.append(part)

    def _close(self, sign: int) -> None:
        """The sign after what is monotone: if it is another one than before, there is one crossing in it."""
        run, before = self._run, self._sign
        self._run, self._sign = [], sign
        if sign == before:
            return
        if not run or run[0].slope != sign:
            raise ArithmeticError(f"the event of {self.flow.equation!r} changes its sign against its rate.")
        times = [kept.time for part in run if (kept := self._narrowed(part)) is not None]
        if not times:
            raise ArithmeticError(f"the event of {self.flow.equation!r} changes its sign and has no zero.")
        whole = times[0]
        for time in times[1:]:
            whole = whole.union(time)
        self.times.append(whole)

    def _narrowed(self, part: _Part) -> _Part | None:
        """The zeros of a monotone part by Newton's operator; None where there is none."""
        low, high, piece = part.low, part.high, part.piece
        h = BALL.number(piece.h)
        while low < high:
            s = low.union(high)
            middle = s.mid() if low <= s.mid() <= high else low
            value, rate = self._enclosed(piece, middle)[0], self._enclosed(piece, s)[1]
            near = middle - value / (h * rate)
            begin, end = (near.lower(), near.upper()) if near.is_finite() else (low, high)
            if _sign(value) == part.slope:
                end = min(end, middle)
            elif _sign(value):
                begin = max(begin, middle)
            if begin > high or end < low:
                return None
            begin, end = max(begin, low), min(end, high)
            done = end - begin > GAIN * (high - low)
            low, high = begin, end
            if done:
                break
        return _Part(piece, low, high, 0, part.slope)


def _fraction(value: arb) -> Fraction:
    """An exact number."""
    mantissa, exponent = value.man_exp()
    return int(mantissa) * Fraction(2) ** int(exponent)


class _Unknown:
    """What stands for an irrational component of a start.

    Raises:
        IrrationalError: it is made use of.
    """

    def _used(self, *_others: Any) -> Any:
        raise IrrationalError("a component of the start is not known to be rational.")

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __pow__ = _used
    __neg__ = __ge__ = __gt__ = __le__ = __lt__ = _used


def _vanishes(problem: Any) -> bool:
    """Whether the event of a problem is exactly zero at its start, by rational arithmetic."""
    known = problem.exact_row("state", Fraction(0)) or [None] * len(problem.state_names)
    try:
        return bool(problem.event(RATIONAL, [_Unknown() if one is None else one for one in known]) == 0)
    except IrrationalError:
        return False


def crossings(problem: Any, bits: int) -> ProvenCrossings:
    """The crossings of a problem's event in at least so many bits, kept for a while."""
    return _kept(problem, proven(problem, bits).bits)


@lru_cache(maxsize=KEPT)
def _kept(problem: Any, bits: int) -> ProvenCrossings:
    def event(m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        del t, p
        return problem.event(m, y)

    return ProvenCrossings(proven(problem, bits), event, vanishes=_vanishes(problem))


def crossing_times(problem: Any, indices: Sequence[int]) -> list[tuple[arb, ...]]:
    """The times of the crossings of a problem's event, at the precision in force; not finite where more is needed.

    Raises:
        WorkBoundError: a crossing is not proven, and would not be with more precision.
    """
    found = crossings(problem, ctx.prec)
    try:
        return [(found.at(index),) for index in indices]
    except HorizonError as end:
        put_off((problem, "event"), end, found.flow.bits)
        return [(arb.nan(),)] * len(indices)
