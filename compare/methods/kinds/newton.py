"""Newton's method for the slopes of implicit methods, in any arithmetic: traced, it has no branch.

K_i = f(Y_i),  Y_i = y + h sum_j a_ij K_j  is solved from K_i = f(y) with a Jacobian at every stage in every iteration,
so that the error of an iteration is proportional to the square of the one before; the last iteration, which moves by
roundings alone, takes the Jacobians of the one before.  How many iterations are taken is decided before the march;
whether they were enough is read off the last change, after it.

Stages that depend on one another are solved together, and such groups one after another: all stages of a Gauss method
at once, those of a diagonally implicit method each by itself.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

from compare.methods.kinds.increment import part, stage
from compare.methods.order.algebraic import Coefficient, Q, enclose

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.protocol import Equation, State

__all__ = [
    "Elimination",
    "Matrix",
    "evaluations",
    "iterations",
    "iterations_of",
    "jacobians",
    "newton_matrix",
    "slopes",
]

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


def iterations_of(matrix: Matrix, size: float, bits: int) -> int:
    """Iterations that a step with this matrix needs, where h times the Lipschitz rate is ``size``."""
    return iterations(size * max(sum(abs(float(enclose(entry))) for entry in row) for row in matrix), bits)


def _groups(matrices: Sequence[Matrix]) -> list[tuple[list[int], bool]]:
    """The stages that are solved together, in order, and whether they depend on themselves; those at y are left out."""
    stages = range(len(matrices[0]))
    needs = [[j for j in stages if any(matrix[i][j] != 0 for matrix in matrices)] for i in stages]
    groups: list[tuple[list[int], bool]] = []
    begin, last = 0, -1
    for i in stages:
        last = max([last, i, *needs[i]])
        if i == last:
            members = [k for k in range(begin, i + 1) if needs[k]]
            if members:
                groups.append((members, any(j >= begin for k in members for j in needs[k])))
            begin = i + 1
    return groups


def evaluations(matrix: Matrix, iterations: int) -> int:
    """Evaluations of f in a step: at y, at every explicit stage, and at every implicit one in every iteration."""
    return 1 + sum(len(members) * (iterations if implicit else 1) for members, implicit in _groups([matrix]))


def jacobians(matrix: Matrix, iterations: int) -> int:
    """Evaluations of the Jacobian in a step."""
    return sum(len(members) for members, implicit in _groups([matrix]) if implicit) * max(iterations - 1, 0)


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
    for members, implicit in _groups(matrices):
        if implicit:
            _solve(system, y, h, matrices, members, iterations, found, changes)
        else:
            (i,) = members
            found[i] = system.derivative(stage(system, y, h, [matrix[i] for matrix in matrices], found))
    return found, changes


def _solve(
    system: Equation,
    y: State,
    h: Any,
    matrices: Sequence[Matrix],
    members: Sequence[int],
    iterations: int,
    found: list[State],
    changes: list[State],
) -> None:
    """Find the slopes of stages that depend on one another, and what the last iteration changed of them."""
    for iteration in range(iterations):
        stages = [stage(system, y, h, [matrix[i] for matrix in matrices], found) for i in members]
        right = [_minus(system.derivative(state), found[i]) for state, i in zip(stages, members, strict=True)]
        if iteration < iterations - 1:
            slopes_of_f = [system.jacobian(state) for state in stages]
            elimination = Elimination(newton_matrix(system, h, matrices, members, slopes_of_f))
        moves = elimination.solve([residual[c] for c in range(len(y)) for residual in right])
        for place, i in enumerate(members):
            changes[i] = tuple(moves[place :: len(members)])
            found[i] = tuple(slope + change for slope, change in zip(found[i], changes[i], strict=True))


def _minus(a: State, b: State) -> State:
    return tuple(first - second for first, second in zip(a, b, strict=True))


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
