"""How many working bits a row of a problem takes, and what to take after too few.

A closed form tells beforehand.  A flow loses what it loses: a part of its way tells about how much, or a flow of few
bits, and what a value lacks after all is taken more.  Only speed depends on any of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.routes.proven_flow import LEAST_BITS, lost, prove, see, told

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["FlowReading", "OfClosedForm", "OfFlow", "latest"]

SPARED, KNOWN = 30, 38
"""Bits that a flow may lose of those that guard every decision, and where what it loses is known; the more decisions,
the fewer.
"""
LEAST_LOST = 16
"""Bits that any flow loses, about."""
LEAST_MORE = 32
"""So many more are taken at least where those of a flow were not enough."""
SURELY = 12
"""So many more for a flow that is to serve many rows."""
PART_SEEN = 8
"""This part of the way of a flow tells, about, what the whole loses."""
SEEN_BITS = 60
"""So many more bits than it is held to does a flow take that tells what another route takes."""
ROUTE_BITS = 30
"""So many more bits than it is held to takes a route that proves nothing, at least."""


class OfClosedForm:
    """Those of a problem with a closed form, which tells them; after too few, twice as many."""

    def __init__(self, problem: Any) -> None:
        self._problem = problem

    def bits(self, row: str, arguments: Sequence[Any]) -> int:
        del row
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
        return bits + 2 * self.bits(row, arguments) + ROUTE_BITS


@dataclass(frozen=True)
class FlowReading:
    """Where a row is read of a flow.

    Attributes:
        equation: the one whose flow it is.
        times: each with the components of its state of which the values are wanted, by their places.
        beside: bits that are lost beside those that the state loses.
    """

    equation: Any
    times: Sequence[tuple[Fraction, tuple[int, ...]]]
    beside: int = 0

    @property
    def ends(self) -> set[Fraction]:
        """The last time on each side of the start."""
        times = [time for time, _ in self.times]
        return {max(times, default=Fraction(0)), min(times, default=Fraction(0))} - {Fraction(0)}

    @property
    def lost(self) -> int:
        """Bits that are lost in it, as far as is known, beyond those that it may."""
        known = [told(self.equation, *time) for time in self.times]
        if known and None not in known:
            return self.beside + max(one for one in known if one is not None) - KNOWN
        return self.beside + max([LEAST_LOST, *(lost(self.equation, time) for time, _ in self.times)]) - SPARED


class OfFlow:
    """Those of a problem that is proven by its flow: its ``flow_reading(row, arguments)`` tells where that is read."""

    def __init__(self, problem: Any) -> None:
        self._problem = problem

    def bits(self, row: str, arguments: Sequence[Any]) -> int:
        decided = len(arguments) * len(self._problem.row(row).quantities)
        return self._reading(row, arguments).lost + decided.bit_length()

    def more(self, missing: int, bits: int) -> int:
        return bits + max(LEAST_MORE, min(missing, bits // 2))

    def foresee(self, row: str, arguments: Sequence[Any], bits: int) -> None:
        """By a part of its way."""
        last = latest(arguments)
        if last:
            see(self._reading(row, arguments).equation, last / PART_SEEN, bits + self.bits(row, arguments))

    def prepare(self, asked: Sequence[tuple[str, Sequence[Any]]], bits: int) -> None:
        """By a flow of few bits; then one proves what the rows of an equation are read of."""
        shared: dict[Any, list[tuple[str, Sequence[Any]]]] = {}
        for row, arguments in asked:
            shared.setdefault(self._reading(row, arguments).equation, []).append((row, arguments))
        for equation, rows in shared.items():
            ends = set().union(*(self._reading(*row).ends for row in rows))
            for end in ends:
                see(equation, end, LEAST_BITS)
            most = bits + SURELY + max(self.bits(*row) for row in rows)
            for end in ends:
                prove(equation, end, most)

    def of_route(self, row: str, arguments: Sequence[Any], bits: int) -> int:
        """By a flow, where none is there."""
        see(self._reading(row, arguments).equation, latest(arguments), bits + SEEN_BITS)
        return bits + max(ROUTE_BITS, self._reading(row, arguments).lost + KNOWN + 20)

    def _reading(self, row: str, arguments: Sequence[Any]) -> FlowReading:
        found: FlowReading = self._problem.flow_reading(row, arguments)
        return found


def latest(arguments: Sequence[Any]) -> Fraction:
    """The time among them that is farthest from the start."""
    return max((abs(t) for t in arguments if isinstance(t, Fraction)), default=Fraction(0))
