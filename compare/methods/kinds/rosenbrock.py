"""Rosenbrock methods: linearly implicit, one linear system a stage with the Jacobian at the beginning of the step.

The Jacobian is exact, by dual numbers.  Where the equation depends on the time, that stands in the state, and its
column of the Jacobian makes of the autonomous form the other one.  See E. Hairer and G. Wanner, Solving Ordinary
Differential Equations II (1996), section IV.7.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, ClassVar

from compare.methods.kinds.newton import Elimination, newton_matrix
from compare.methods.kinds.one_step import Embedded, used_stages
from compare.methods.kinds.protocol import OneStep
from compare.methods.order.algebraic import provable
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.protocol import State, System
    from compare.methods.order.algebraic import Coefficient

__all__ = ["Rosenbrock", "Slopes", "from_slopes"]

Rows = tuple[tuple["Coefficient", ...], ...]


@dataclass(frozen=True)
class Rosenbrock(OneStep):
    """(I/(gamma h) - J) u_i = f(y + sum_j a_ij u_j) + sum_j (c_ij/h) u_j,  y+ = y + sum_i m_i u_i,  J = f'(y).

    ``a`` and ``c`` are strictly lower triangular, their rows as long as there are stages before; of embedded weights
    m is meant too.

    Raises:
        ValueError: the shapes of ``a``, ``c``, ``m`` and the embedded weights do not match.
    """

    name: str
    order: int
    source: str
    gamma: Coefficient
    a: Rows
    c: Rows
    m: tuple[Coefficient, ...]
    family: str = "Rosenbrock"
    aliases: tuple[str, ...] = ()
    embedded: tuple[Embedded, ...] = ()
    symplectic: ClassVar[bool] = False
    separable_only: ClassVar[bool] = False
    second_order_only: ClassVar[bool] = False

    def __post_init__(self) -> None:
        for table in (self.a, self.c):
            if [len(row) for row in table] != list(range(len(self.m))):
                raise ValueError(
                    f"{self.name}: rows of {[*map(len, table)]} entries; 0 to {self.stages - 1} are accepted."
                )
        for other in self.embedded:
            if len(other.b) != self.stages:
                raise ValueError(f"{self.name}: {len(other.b)} embedded weights; {self.stages} are accepted.")

    @property
    def stages(self) -> int:
        return len(self.m)

    @property
    def formula(self) -> str:
        """What a step does, in words for those who have it shown."""
        return "(I/(gamma h) - J) u_i = f(y + sum_j a_ij u_j) + sum_j (c_ij/h) u_j, where J = f'(y); y + sum_i m_i u_i"

    @cached_property
    def used(self) -> tuple[int, ...]:
        """The stages that a step of fixed size needs: not one that serves an error estimate alone."""
        rows = zip(self.a, self.c, strict=True)
        return used_stages([[int(a != 0 or c != 0) for a, c in zip(*row, strict=True)] for row in rows], self.m)

    def slopes(self, *weights: Sequence[Coefficient]) -> tuple[Slopes, list[list[Any]]]:
        """The method in its slopes, and some weights in them: exact where all is, else at the precision in force."""
        size = self.stages
        numbers = iter(provable([self.gamma, *(value for row in (*self.a, *self.c, *weights) for value in row)]))
        gamma = next(numbers)
        a, c = ([[next(numbers) for _ in range(i)] for i in range(size)] for _ in range(2))
        found = Slopes(gamma, a, c)
        return found, [found.weights([next(numbers) for _ in row]) for row in weights]

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        """Stages at the same state are evaluated once."""
        return len({self._row(i) for i in self.used}), 0

    def jacobians(self, iterations: int) -> int:  # noqa: ARG002
        return 1

    def _row(self, i: int) -> tuple[Coefficient, ...]:
        """The entries of a row up to the last that is not zero."""
        row = list(self.a[i])
        while row and row[-1] == 0:
            row.pop()
        return tuple(row)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        """Each equation is taken gamma h times, so that nothing is divided by h."""
        single = (((self.gamma,),),) * len(y)
        elimination = Elimination(newton_matrix(system, h, single, [0], [system.jacobian(y)]))
        size = system.number(self.gamma) * h
        factor = system.number(self.gamma)
        moves: list[State] = [()] * self.stages
        slopes: dict[tuple[Coefficient, ...], State] = {}
        for i in self.used:
            row = self._row(i)
            if row not in slopes:
                slopes[row] = system.derivative(_moved(y, _combined(system, row, moves)))
            right = tuple(size * slope for slope in slopes[row])
            past = tuple(factor * value for value in _combined(system, self.c[i], moves))
            moves[i] = tuple(elimination.solve(_moved(right, past)))
        return _moved(y, _combined(system, self.m, moves)), ()


def _combined(system: System, weights: Sequence[Coefficient], moves: Sequence[State]) -> State:
    """sum_j weights_j u_j; nothing where every weight is zero."""
    parts = [
        move if weight == 1 else tuple(system.number(weight) * value for value in move)
        for weight, move in zip(weights, moves, strict=False)
        if weight != 0
    ]
    return tuple(reduce(add, values) for values in zip(*parts, strict=True))


def _moved(y: State, change: State) -> State:
    return tuple(map(add, y, change)) if change else y


class Slopes:
    """k_i = f(y + h sum_j alpha_ij k_j) + h J sum_j gamma_ij k_j,  where u_i = h sum_j gamma_ij k_j: in any arithmetic.

    Attributes:
        alpha: strictly lower triangular, its rows as long as there are stages before.
        beta: alpha + gamma, with the diagonal.
    """

    def __init__(self, gamma: Any, a: Sequence[Sequence[Any]], c: Sequence[Sequence[Any]]) -> None:
        self._gammas = _inverse([[*(0 - value for value in row), 1 / gamma] for row in c])
        self.alpha = [self.weights(row) for row in a]
        self.beta = [
            [*map(add, first, second), second[-1]] for first, second in zip(self.alpha, self._gammas, strict=True)
        ]

    def weights(self, m: Sequence[Any]) -> list[Any]:
        """Weights of the u_j as weights of the h k_j."""
        return _times(m, self._gammas)


def _inverse(rows: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """The inverse of a lower triangular matrix whose rows end with their diagonal entry, laid out as it is."""
    found: list[list[Any]] = []
    for i, row in enumerate(rows):
        sums = [reduce(add, (row[k] * found[k][j] for k in range(j, i))) for j in range(i)]
        found.append([*((0 - value) / row[-1] for value in sums), 1 / row[-1]])
    return found


def _times(row: Sequence[Any], matrix: Sequence[Sequence[Any]]) -> list[Any]:
    """A row times a lower triangular matrix, as long as the row."""
    return [reduce(add, (row[i] * matrix[i][j] for i in range(j, len(row)))) for j in range(len(row))]


def from_slopes(
    name: str,
    order: int,
    source: str,
    alpha: Rows,
    gammas: Rows,
    b: Sequence[Coefficient],
    embedded: Sequence[Embedded] = (),
    aliases: tuple[str, ...] = (),
) -> Rosenbrock:
    """The method that is printed in its slopes, k_i = f(y + h sum_j alpha_ij k_j) + h J sum_j gamma_ij k_j, with b.

    ``alpha`` is strictly lower triangular; ``gammas`` has the diagonal, the same number throughout.  With
    u_i = h sum_j gamma_ij k_j the products with J go away: a, c and m follow.

    Raises:
        ValueError: the diagonal has several numbers.
    """
    diagonal: Any = gammas[0][0]
    if any(row[-1] != diagonal for row in gammas):
        raise ValueError(f"{name}: the diagonal of gamma has several numbers; one is accepted.")
    inverse = _inverse(gammas)
    return Rosenbrock(
        name, order, source, diagonal,
        a=tuple(tuple(_times(row, inverse)) for row in alpha),
        c=tuple(tuple(0 - value for value in row[:-1]) for row in inverse),
        m=tuple(_times(b, inverse)),
        aliases=aliases,
        embedded=tuple(Embedded(other.order, tuple(_times(other.b, inverse))) for other in embedded),
    )  # fmt: skip
