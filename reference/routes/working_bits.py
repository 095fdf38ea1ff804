"""How many working bits a row of a problem takes, and what to take after too few.

A closed form tells beforehand.  What a flow loses is told by a part of its way, or by a flow of few bits; and what a
value lacks after all is taken more.  Only speed depends on any of it.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.limbs import WorkBoundError
from reference.routes.proven_flow import LEAST_BITS, lost, lost_in, prove, see

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from flint import arb

__all__ = ["FlowReading", "OfClosedForm", "OfFlow"]

GUESSED, SEEN = 30, 38
"""Of the bits that guard every decision so many are no more needed where the loss is guessed, and where it was seen."""
LEAST_LOST = 16
"""Bits that any flow loses, about."""
LEAST_MORE = 32
"""So many more are taken at least where those of a flow were not enough."""
OF_ALL_ROWS = 12
"""So many more for a flow that is to serve many rows: another flow was seen to lose what it will lose."""
PART_SEEN = 8
"""This part of the way of a flow tells, about, what the whole loses."""
LOOKED_AT = 64
"""Of many times so many are looked at, where none but these are asked for."""
OTHER_ROUTE = 30
"""So many more bits than it is held to takes a route that proves nothing, at least."""
ROUNDINGS = 28
"""And so many more than what is lost, for roundings of its own."""


class OfClosedForm:
    """Those of a problem with a closed form, which tells them; after too few, twice as many."""

    def __init__(self, problem: Any) -> None:
        self._problem = problem

    def bits(self, row: str, arguments: Sequence[Any], component: int | None = None) -> int:
        del row, component
        found: int = self._problem.working_bits(arguments)
        return found

    def more(self, missing: int, bits: int) -> int:
        del missing
        return 2 * bits

    def foresee(self, row: str, arguments: Sequence[Any], bits: int) -> None:
        """Nothing is to be learned."""

    def prepare(self, asked: Sequence[tuple[str, Sequence[Any]]], bits: int) -> None:
        """Nothing is shared."""

    def of_route(self, row: str, arguments: Sequence[Any], bits: int) -> int:
        return bits + 2 * self.bits(row, arguments) + OTHER_ROUTE


@dataclass(frozen=True)
class FlowReading:
    """Where a row is read of a flow.

    Attributes:
        equation: the one whose flow it is.
        times: when.
        values: (time, state) -> the balls that are read then; None where what they lack is no matter of the state.
        beside: bits that are lost beside those that the state loses.
        until: up to when the flow goes, where no times tell.
        proves: whether it is read so by the proof, and not by other routes alone.
    """

    equation: Any
    times: Sequence[Fraction]
    values: Callable[[Fraction, list[arb]], Sequence[arb]] | None = None
    beside: int = 0
    until: Fraction = Fraction(0)
    proves: bool = True

    @property
    def ends(self) -> set[Fraction]:
        """The last time on each side of the start."""
        return {max(self.times, default=Fraction(0)), min(self.times, default=Fraction(0))} - {Fraction(0)}

    def guessed(self) -> int:
        """Bits that are lost, by what the flow lost so far."""
        ends = self.ends or {self.until}
        return self.beside + max([LEAST_LOST, *(lost(self.equation, end) for end in ends)])

    def seen(self, most: int) -> int | None:
        """Bits that the values lack in a flow that is there, looked at so many times at most; None where none is."""
        if self.values is None or not self.times:
            return None
        apart = -(-len(self.times) // most)
        return lost_in(self.equation, self.times[::apart], self.values)


class OfFlow:
    """Those of a problem that is proven by its flow: its ``flow_reading(row, arguments)`` tells where that is read."""

    def __init__(self, problem: Any) -> None:
        self._problem = problem

    def bits(self, row: str, arguments: Sequence[Any], component: int | None = None) -> int:
        """Of what other routes alone read of a flow hardly any."""
        if not self._reading(row, arguments).proves:
            return LEAST_LOST - GUESSED
        return self._bits(row, arguments, component, LOOKED_AT)

    def more(self, missing: int, bits: int) -> int:
        """So many more as are missing; half as many more where nothing is, or all of it."""
        return bits + (max(LEAST_MORE, min(missing, bits // 2)) if missing > 0 else bits // 2)

    def foresee(self, row: str, arguments: Sequence[Any], bits: int) -> None:
        """By a part of its way.

        Raises:
            WorkBoundError: the whole way takes more steps than are granted.
        """
        reading = self._reading(row, arguments)
        for end in reading.ends if reading.proves else ():
            see(reading.equation, end / PART_SEEN, lambda: bits + self.bits(row, arguments), end)

    def prepare(self, asked: Sequence[tuple[str, Sequence[Any]]], bits: int) -> None:
        """By a flow of few bits; then one proves what the rows of an equation are read of."""
        shared: dict[Any, list[tuple[str, Sequence[Any]]]] = {}
        for row, arguments in asked:
            shared.setdefault(self._reading(row, arguments).equation, []).append((row, arguments))
        for equation, rows in shared.items():
            ends = sorted(set().union(*(self._reading(*row).ends for row in rows)))
            for end in ends:
                with suppress(WorkBoundError):
                    see(equation, end, lambda: LEAST_BITS)
            most = bits + OF_ALL_ROWS + max(self._bits(*row, None, max(1, len(row[1]))) for row in rows)
            for end in ends:
                with suppress(WorkBoundError):
                    prove(equation, end, most)

    def of_route(self, row: str, arguments: Sequence[Any], bits: int) -> int:
        """By a flow, where none is there."""
        reading = self._reading(row, arguments)
        for end in reading.ends:
            with suppress(WorkBoundError):
                see(reading.equation, end, lambda: bits + 2 * OTHER_ROUTE)
        seen = reading.seen(LOOKED_AT)
        return bits + max(OTHER_ROUTE, (reading.guessed() if seen is None else seen) + ROUNDINGS)

    def _bits(self, row: str, arguments: Sequence[Any], component: int | None, most: int) -> int:
        """Beyond those that the guard of every decision has to spare."""
        decided = len(arguments) * (len(self._problem.row(row).quantities) if component is None else 1)
        reading = self._reading(row, arguments, component)
        seen = reading.seen(most)
        return decided.bit_length() + (reading.guessed() - GUESSED if seen is None else seen - SEEN)

    def _reading(self, row: str, arguments: Sequence[Any], component: int | None = None) -> FlowReading:
        found: FlowReading = self._problem.flow_reading(row, arguments, component)
        return found
