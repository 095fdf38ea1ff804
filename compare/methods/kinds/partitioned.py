"""Partitioned Runge-Kutta methods: one matrix for the positions, another for the momenta."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from compare.methods.kinds import newton
from compare.methods.kinds.increment import advance, increment
from compare.methods.kinds.one_step import is_symmetric, is_symplectic
from compare.methods.kinds.protocol import OneStep, State, System
from compare.methods.order.algebraic import Coefficient, Q
from reference.once import cached_property

__all__ = ["Partitioned"]


@dataclass(frozen=True)
class Partitioned(OneStep):
    """Q_i = q + h sum_j a_ij f(Q_j, P_j),  P_i = p + h sum_j hat_ij g(Q_j, P_j),  both advanced with the weights b.

    Raises:
        ValueError: the shapes of ``matrix``, ``hat`` and ``b`` do not match, or the b do not sum to 1.
    """

    name: str
    order: int
    source: str
    matrix: tuple[tuple[Coefficient, ...], ...]
    hat: tuple[tuple[Coefficient, ...], ...]
    b: tuple[Coefficient, ...]
    family: str = "implicit"
    aliases: tuple[str, ...] = ()
    separable_only: bool = True
    second_order_only: ClassVar[bool] = False

    def __post_init__(self) -> None:
        for table in (self.matrix, self.hat):
            if len(table) != len(self.b) or any(len(row) != len(self.b) for row in table):
                raise ValueError(f"{self.name}: a matrix is not of {len(self.b)} rows and columns; such is accepted.")
        total: Any = sum(self.b, Q(0))
        if total != 1:
            raise ValueError(f"{self.name}: the weights b sum to {total}; a sum of 1 is accepted.")

    @property
    def stages(self) -> int:
        return len(self.b)

    @property
    def c(self) -> tuple[Coefficient, ...]:
        """The nodes of the positions, c_i = sum_j a_ij."""
        return tuple(sum(row, Q(0)) for row in self.matrix)

    @cached_property
    def symplectic(self) -> bool:
        """Whether b_i hat_ij + b_j a_ji = b_i b_j."""
        return is_symplectic(self.matrix, self.hat, self.b)

    @cached_property
    def symmetric(self) -> bool:
        """Whether a step back undoes a step."""
        return is_symmetric(self.matrix, self.b) and is_symmetric(self.hat, self.b)

    def iterations(self, size: float, bits: int) -> int:
        return newton.iterations_of((*self.matrix, *self.hat), size, bits)

    @cached_property
    def _either(self) -> tuple[tuple[Coefficient, ...], ...]:
        """A matrix with an entry wherever one of the two has one."""
        rows = zip(self.matrix, self.hat, strict=True)
        return tuple(tuple(a if a != 0 else other for a, other in zip(*row, strict=True)) for row in rows)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return newton.evaluations(self._either, iterations), 0

    def jacobians(self, iterations: int) -> int:
        return newton.jacobians(self._either, iterations)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        momenta = len(y) - system.positions
        matrices = (self.matrix,) * system.positions + (self.hat,) * momenta
        slopes, changes = newton.slopes(system, y, h, matrices, iterations)
        return advance(system, y, h, self.b, slopes), increment(system, h, self.b, changes)
