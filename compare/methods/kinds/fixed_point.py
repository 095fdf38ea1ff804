"""Fixed-point iteration for the slopes of implicit methods: no Jacobian, and many evaluations.

K_i = f(y + h sum_j a_ij K_j)  is taken anew for all stages at once, from K_i = f(y): Picard's iteration.  How many
sweeps are taken is decided before the march; whether they were enough is read off the last change, after it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.methods.kinds.increment import stage
from compare.methods.order.algebraic import Q, enclose

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.newton import Matrix
    from compare.methods.kinds.protocol import Equation, State

__all__ = ["evaluations", "iterations_of", "jacobians", "slopes"]

LARGEST_RATE = 0.5
"""Above it the convergence is too slow to be waited for; as many sweeps are taken as there."""
SPARE_SWEEPS = 2


def iterations_of(matrix: Matrix, size: float, bits: int) -> int:
    """Sweeps that a step with this matrix needs, where h times the Lipschitz rate is ``size``.

    A sweep multiplies the error by h a J, whose largest eigenvalue is what each gains in the end; the first gain more.
    """
    a = np.array([[float(enclose(entry)) for entry in row] for row in matrix])
    rate = min(size * float(np.max(np.abs(np.linalg.eigvals(a)))), LARGEST_RATE)
    return SPARE_SWEEPS + math.ceil(bits / -math.log2(rate))


def _iterated(matrix: Matrix) -> list[int]:
    """The stages that depend on any slope; the others stand at y."""
    return [i for i, row in enumerate(matrix) if any(entry != 0 for entry in row)]


def evaluations(matrix: Matrix, iterations: int) -> int:
    """Evaluations of f in a step: at y, and at every other stage in every sweep."""
    return 1 + len(_iterated(matrix)) * iterations


def jacobians(matrix: Matrix, iterations: int) -> int:  # noqa: ARG001
    """None."""
    return 0


def slopes(
    system: Equation, y: State, h: Any, matrices: Sequence[Matrix], iterations: int
) -> tuple[list[State], list[State]]:
    """The slopes K_i of the stages, and what the last sweep changed of them.

    Args:
        system: the equation in the arithmetic at hand.
        y: the state that the stages start from.
        h: the step size.
        matrices: a_ij for each component of the state, the same for all of them.
        iterations: at least 1.
    """
    found = [system.derivative(y)] * len(matrices[0])
    changes: list[State] = [(system.number(Q(0)),) * len(y)] * len(found)
    iterated = _iterated(matrices[0])
    for _ in range(iterations):
        stages = [stage(system, y, h, [matrix[i] for matrix in matrices], found) for i in iterated]
        for i, state in zip(iterated, stages, strict=True):
            slope = system.derivative(state)
            changes[i] = tuple(new - old for new, old in zip(slope, found[i], strict=True))
            found[i] = slope
    return found, changes
