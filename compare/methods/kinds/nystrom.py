"""Explicit Runge-Kutta-Nystrom methods: tables for q'' = F(q), which evaluate the force alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from compare.methods.kinds.increment import increment, part, turned
from compare.methods.kinds.one_step import used_stages
from compare.methods.kinds.protocol import OneStep
from compare.methods.order.algebraic import Coefficient, Q
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.protocol import State, System

__all__ = ["EmbeddedNystrom", "RungeKuttaNystrom"]


@dataclass(frozen=True)
class EmbeddedNystrom:
    """Other weights on the stages: a result of another order, to estimate the error by."""

    order: int
    b_bar: tuple[Coefficient, ...]
    b: tuple[Coefficient, ...]


@dataclass(frozen=True)
class RungeKuttaNystrom(OneStep):
    """Q_i = q + c_i h v + h^2 sum_j a_ij F_j,  q+ = q + h v + h^2 sum_i b_bar_i F_i,  p+ = p + h sum_i b_i F_i.

    F_i = F(Q_i) is the force and v the velocity.  A velocity that is linear in the momenta turns the forces in the
    positions; the time, where it is among these, is t + c_i h.  ``a`` is given as printed, the strictly lower rows.

    Raises:
        ValueError: the shapes of the table do not match, or weights do not sum to 1/2 and 1.
    """

    name: str
    order: int
    source: str
    c: tuple[Coefficient, ...]
    a: tuple[tuple[Coefficient, ...], ...]
    b_bar: tuple[Coefficient, ...]
    b: tuple[Coefficient, ...]
    embedded: tuple[EmbeddedNystrom, ...] = ()
    aliases: tuple[str, ...] = ()
    family: str = "Runge-Kutta-Nystrom"
    symplectic: ClassVar[bool] = False
    separable_only: ClassVar[bool] = True
    second_order_only: ClassVar[bool] = False
    linear_velocities_only: ClassVar[bool] = True

    def __post_init__(self) -> None:
        size = len(self.c)
        if len(self.a) != size or any(len(row) > i for i, row in enumerate(self.a)):
            raise ValueError(f"{self.name}: a is not strictly lower of {size} rows; such is accepted.")
        for b_bar, b in ((self.b_bar, self.b), *((other.b_bar, other.b) for other in self.embedded)):
            if {len(b_bar), len(b)} != {size}:
                raise ValueError(f"{self.name}: {len(b_bar)} and {len(b)} weights; {size} of each are accepted.")
            positions, momenta = _sum(b_bar), _sum(b)
            if (positions, momenta) != (Q(1, 2), 1):
                raise ValueError(f"{self.name}: the weights sum to {positions} and {momenta}; 1/2 and 1 are accepted.")

    @property
    def stages(self) -> int:
        return len(self.b)

    @cached_property
    def matrix(self) -> tuple[tuple[Coefficient, ...], ...]:
        """``a`` as a full square matrix."""
        return tuple(row + (Q(0),) * (self.stages - len(row)) for row in self.a)

    @cached_property
    def used(self) -> tuple[int, ...]:
        """The stages that a step of fixed size needs: not one that serves an error estimate alone."""
        weighted = [int(bar != 0 or b != 0) for bar, b in zip(self.b_bar, self.b, strict=True)]
        return used_stages(self.matrix, weighted)

    @cached_property
    def fsal(self) -> bool:
        """Whether the last stage is evaluated where the next step begins."""
        return self.stages > 1 and self.c[-1] == 1 and self.matrix[-1] == self.b_bar

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        """One fewer per step where the last stage is the first of the next step."""
        shared = int(self.fsal and self.stages - 1 in self.used)
        return len(self.used) - shared, shared

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        q, p = y[: system.positions], y[system.positions :]
        v = system.velocity(p)
        forces: list[State] = []
        rates: list[State] = []
        for i, (node, row) in enumerate(zip(self.c, self.a, strict=True)):
            if i not in self.used:
                forces.append(())
                rates.append(())
                continue
            force = system.force(_moved(q, part(system, node, h), v, h, increment(system, h, row, rates)))
            forces.append(force)
            rates.append(turned(system, force))
        q = _moved(q, h, v, h, increment(system, h, self.b_bar, rates))
        kick = increment(system, h, self.b, forces)
        return q + tuple(momentum + change for momentum, change in zip(p, kick, strict=True)), ()


def _sum(weights: Sequence[Any]) -> Any:
    return sum(weights[1:], weights[0])


def _moved(q: State, dt: Any, v: State, h: Any, kick: State) -> State:
    """q + dt v + h kick."""
    if not kick:
        return tuple(place + dt * rate for place, rate in zip(q, v, strict=True))
    return tuple(place + (dt * rate + h * change) for place, rate, change in zip(q, v, kick, strict=True))
