"""Newton's method for the slopes of implicit methods, in any arithmetic: traced, it has no branch.

K_i = f(Y_i),  Y_i = y + h sum_j a_ij K_j  is solved from K_i = f(y) with a Jacobian at every stage in every iteration,
so that the error of an iteration is proportional to the square of the one before; the last iteration, which moves by
roundings alone, takes the Jacobians of the one before.  How many iterations are taken is decided before the march;
whether they were enough is read off the last change, after it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

from compare.methods.kinds.increment import part
from compare.methods.order.algebraic import Coefficient, Q

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.protocol import Equation, State

__all__ = ["Elimination", "Matrix", "evaluations", "iterations", "jacobians", "newton_matrix", "slopes"]

Matrix: TypeAlias = tuple[tuple[Coefficient, ...], ...]

LARGEST_SIZE = 0.85
"""Above it the estimate of the convergence says nothing; as many iterations are taken as there."""
SPARE_BITS = 5
"""By so many bits the last change is allowed to be above a rounding."""


def iterations(size: float, bits: int) -> int:
    """Iterations after which the last change is a rounding, where x = h |a| times the Lipschitz rate is ``size``.

    The slopes are first taken constant, which is wrong by about 2 x^2; an error e leaves x e^2/2 after an iteration,
    and so 2 x^(3 2^k - 1) after k.  The last change is the error before it.
    """
    bits_of_x = -math.log2(min(size, LARGEST_SIZE))
    count = 2
    while (3 * 2 ** (count - 1) - 1) * bits_of_x - 1 < bits - SPARE_BITS:
        count += 1
    return count


def _implicit(matrices: Sequence[Matrix]) -> list[int]:
    """The stages that depend on any slope; the others stand at y."""
    return [i for i in range(len(matrices[0])) if any(entry != 0 for matrix in matrices for entry in matrix[i])]


def evaluations(matrix: Matrix, iterations: int) -> int:
    """Evaluations of f in a step: at y, and at every implicit stage in every iteration."""
    return 1 + len(_implicit([matrix])) * iterations


def jacobians(matrix: Matrix, iterations: int) -> int:
    """Evaluations of the Jacobian in a step."""
    return len(_implicit([matrix])) * max(iterations - 1, 0)


def slopes(
    system: Equation, y: State, h: Any, matrices: Sequence[Matrix], iterations: int
) -> tuple[list[State], list[State]]:
    """The slopes K_i of the stages, and what the last iteration changed of them.

    Args:
        system: the equation in the arithmetic at hand.
        y: the state that the stages start from.
        h: the step size.
        matrices: a_ij for each component of the state; the same for all of them in a Runge-Kutta method.
        iterations: at least 2.
    """
    found = [system.derivative(y)] * len(matrices[0])
    zero = system.number(Q(0))
    changes: list[State] = [(zero,) * len(y)] * len(found)
    implicit = _implicit(matrices)
    for iteration in range(iterations):
        stages = [_stage(system, y, h, [matrix[i] for matrix in matrices], found) for i in implicit]
        right = [_minus(system.derivative(stage), found[i]) for stage, i in zip(stages, implicit, strict=True)]
        if iteration < iterations - 1:
            system_of_slopes = newton_matrix(
                system, h, matrices, implicit, [system.jacobian(stage) for stage in stages]
            )
            elimination = Elimination(system_of_slopes)
        moves = elimination.solve([residual[c] for c in range(len(y)) for residual in right])
        for place, i in enumerate(implicit):
            changes[i] = tuple(moves[place :: len(implicit)])
            found[i] = tuple(slope + change for slope, change in zip(found[i], changes[i], strict=True))
    return found, changes


def _minus(a: State, b: State) -> State:
    return tuple(first - second for first, second in zip(a, b, strict=True))


def _stage(system: Equation, y: State, h: Any, rows: Sequence[Sequence[Coefficient]], found: Sequence[State]) -> State:
    """Y = y + h sum_j a_j K_j, with weights for each component of their own."""
    moved = []
    for c, row in enumerate(rows):
        value = y[c]
        for weight, slope in zip(row, found, strict=True):
            if weight != 0:
                value = value + part(system, weight, h) * slope[c]
        moved.append(value)
    return tuple(moved)


def newton_matrix(
    system: Equation, h: Any, matrices: Sequence[Matrix], implicit: Sequence[int], jacobians: Sequence[Sequence[State]]
) -> list[list[Any]]:
    """I - h a J, component by component and stage by stage within: in a separable system it begins with the identity.

    An entry that is always zero is the integer 0, and no work is done on it.
    """
    components = range(len(matrices))
    rows = []
    for c in components:
        for i, jacobian in zip(implicit, jacobians, strict=True):
            row: list[Any] = []
            for e in components:
                for j in implicit:
                    weight, slope = matrices[e][i][j], jacobian[c][e]
                    entry = 0 if weight == 0 or _absent(slope) else -(part(system, weight, h) * slope)
                    row.append(1 + entry if (c, i) == (e, j) else entry)
            rows.append(row)
    return rows


def _absent(entry: Any) -> bool:
    """Whether an entry is the integer 0, and not a number or an expression that may happen to be zero."""
    return isinstance(entry, int) and entry == 0


class Elimination:
    """A matrix eliminated without exchange of rows, which cannot be traced, to solve for any number of right sides.

    The matrix is I - h a J: for moderate h near the identity, and its pivots are away from zero.
    """

    def __init__(self, matrix: Sequence[Sequence[Any]]) -> None:
        self._rows = [list(row) for row in matrix]
        rows, size = self._rows, range(len(matrix))
        for k in size:
            for r in size[k + 1 :]:
                if _absent(rows[r][k]):
                    continue
                rows[r][k] = rows[r][k] / rows[k][k]
                for c in size[k + 1 :]:
                    if not _absent(rows[k][c]):
                        rows[r][c] = rows[r][c] - rows[r][k] * rows[k][c]

    def solve(self, right: Sequence[Any]) -> list[Any]:
        """x with matrix x = right."""
        rows, x, size = self._rows, list(right), range(len(right))
        for k in size:
            for c in size[:k]:
                if not _absent(rows[k][c]):
                    x[k] = x[k] - rows[k][c] * x[c]
        for k in reversed(size):
            for c in size[k + 1 :]:
                if not _absent(rows[k][c]):
                    x[k] = x[k] - rows[k][c] * x[c]
            x[k] = x[k] / rows[k][k]
        return x
