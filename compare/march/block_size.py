"""The shape of a compiled block that suits a march: how many steps and lanes it takes, and how it is compiled.

Compiling takes longer than many a march; what it costs is balanced against what it saves.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.march.lanes import Lane
    from compare.march.precision import Precision
    from compare.march.trace import Record
    from compare.methods.kinds.protocol import Method

__all__ = ["INLINE_SINE", "Shape"]

SHORT_BLOCK, SHORTEST_BLOCK = 8, 4
BLOCK_SIZE, WIDE_BLOCK_SIZE = 256, 32
"""Evaluations in a compiled block at most, about, and twice as many in the longest marches; few in wide formats, where
a call costs no more than an operation."""
CALL_SECONDS, COMPILE_SECONDS = 6e-6, 6e-5
"""Of one call of a block, and of compiling an evaluation for one lane of a batch: a longer block saves the one and
costs the other."""
JACOBIAN_SIZE, JACOBIAN_BATCH = 3, 16
"""A Jacobian and what is solved with it is code for so many evaluations, and fills the registers of so many lanes."""
INLINE_SINE = 10**9
"""Evaluations from which the sine is compiled into the march: the seconds that it takes are then won back."""
OPTIMIZED = 5 * 10**8
"""Evaluations from which the compiler's optimization is won back, a tenth of the march for half of compiling."""


@dataclass(frozen=True)
class Shape:
    """What a compiled block is for: how many steps and lanes it takes at once, what it gives, how it solves."""

    steps: int
    batch: int
    record: Record
    iterations: int
    inline_sine: bool
    brief: bool

    @classmethod
    def of(cls, method: Method, lanes: Sequence[Lane], fmt: Precision, grain: int, iterations: int) -> Shape:
        """The shape that suits lanes in order of falling N."""
        evaluations, jacobians = method.evaluations(iterations)[0], method.jacobians(iterations)
        work = sum(lane.n for lane in lanes) * evaluations
        inline = fmt.type is float and work >= INLINE_SINE
        size = evaluations * (4 if inline else 1) + jacobians * JACOBIAN_SIZE
        lasting = sum(2 * lane.n > lanes[0].n for lane in lanes)  # through the half of the march that all others miss
        batch = min(fmt.lanes, 1 << (max(lasting, 8) - 1).bit_length(), JACOBIAN_BATCH if jacobians else fmt.lanes)
        balance = math.sqrt(2 * lanes[0].n * CALL_SECONDS / (COMPILE_SECONDS * batch * size))
        most = BLOCK_SIZE * (2 if inline else 1) if fmt.lanes > 1 else WIDE_BLOCK_SIZE
        room = min(most / size, max(balance, SHORTEST_BLOCK))
        steps = SHORT_BLOCK if grain == 1 else grain
        while steps > room and steps // 2 >= max(method.starting_steps, 1):
            steps //= 2
        brief = fmt.lanes > 1 and work < OPTIMIZED
        return cls(steps, batch, "every" if grain == 1 else "last", iterations, inline, brief)
