"""What a method is: a frozen table, and the step that follows from it in any arithmetic.

A step is written once, on a ``System`` (the equation in the arithmetic at hand) and a tuple of numbers.  The same lines
run on floats, on NumPy arrays of any type, and on heyoka's symbols, which compiles them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import pairwise
from operator import add
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from compare.algebraic import Coefficient, Q, enclose

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Method", "Splitting", "State", "System", "Tableau", "compose"]

State = tuple[Any, ...]


class System(Protocol):
    """An equation of motion y' = f(y) in one arithmetic; positions first where it is separable."""

    positions: int
    """How many of the components are positions, 0 where the equation is not separable."""

    def number(self, value: Coefficient) -> Any:
        """An exact coefficient as a number of the arithmetic."""

    def derivative(self, y: State) -> State:
        """f(y)."""

    def velocity(self, momenta: State) -> State:
        """The rates of the positions, which depend on the momenta alone."""

    def force(self, positions: State) -> State:
        """The rates of the momenta, which depend on the positions alone."""


@dataclass(frozen=True)
class Tableau:
    """A Runge-Kutta method: Y_i = y + h sum_j a_ij f(Y_j),  y+ = y + h sum_i b_i f(Y_i).

    ``a`` is given as printed: for an explicit method the strictly lower rows (the first empty).  ``c`` is derived from
    c_i = sum_j a_ij.

    Raises:
        ValueError: the shapes of ``a`` and ``b`` do not match, or the b do not sum to 1.
    """

    name: str
    order: int
    source: str
    a: tuple[tuple[Coefficient, ...], ...]
    b: tuple[Coefficient, ...]
    family: str = "explicit one-step"
    aliases: tuple[str, ...] = ()
    symplectic: bool = False
    separable_only: bool = False

    def __post_init__(self) -> None:
        if len(self.a) != len(self.b) or any(len(row) > len(self.b) for row in self.a):
            raise ValueError(
                f"{self.name}: a has {len(self.a)} rows and b {len(self.b)} weights; equally many are accepted."
            )
        if sum(self.b) != 1:
            raise ValueError(f"{self.name}: the weights b sum to {sum(self.b)}; a sum of 1 is accepted.")

    @property
    def stages(self) -> int:
        return len(self.b)

    @cached_property
    def matrix(self) -> tuple[tuple[Coefficient, ...], ...]:
        """``a`` as a full square matrix."""
        return tuple(row + (Q(0),) * (self.stages - len(row)) for row in self.a)

    @cached_property
    def c(self) -> tuple[Coefficient, ...]:
        """The nodes, c_i = sum_j a_ij."""
        return tuple(sum(row, Q(0)) for row in self.a)

    @cached_property
    def explicit(self) -> bool:
        """Whether every stage depends on earlier stages alone."""
        return all(self.matrix[i][j] == 0 for i in range(self.stages) for j in range(i, self.stages))

    def contraction(self, rate: float) -> float:
        if self.explicit:
            return 0.0
        norms = [sum(abs(float(enclose(entry))) for entry in row) for row in self.matrix]
        return rate * max(norms)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return (self.stages if self.explicit else self.stages * (iterations + 1)), 0

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        if self.explicit:
            slopes: list[State] = []
            for row in self.matrix:
                slopes.append(system.derivative(_advance(system, y, h, row, slopes)))
            return _advance(system, y, h, self.b, slopes), ()
        return self._implicit_step(system, y, h, iterations)

    def _implicit_step(self, system: System, y: State, h: Any, iterations: int) -> tuple[State, State]:
        """Fixed-point iteration on the slopes from f(y), the last change of the step reported."""
        slopes = [system.derivative(y)] * self.stages
        before = slopes
        for _ in range(iterations):
            before = slopes
            slopes = [system.derivative(_advance(system, y, h, row, before)) for row in self.matrix]
        new = _advance(system, y, h, self.b, slopes)
        old = _advance(system, y, h, self.b, before)
        return new, tuple(after - earlier for after, earlier in zip(new, old, strict=True))


def _advance(system: System, y: State, h: Any, weights: Sequence[Coefficient], slopes: Sequence[State]) -> State:
    """y + sum_j (h weights_j) slopes_j."""
    sizes = [(_part(system, weight, h), slope) for weight, slope in zip(weights, slopes, strict=False) if weight != 0]
    if not sizes:
        return y
    return tuple(component + reduce(add, (size * slope[i] for size, slope in sizes)) for i, component in enumerate(y))


def _part(system: System, weight: Coefficient, h: Any) -> Any:
    """weight h: the same in every step, so that the compiler takes it out of them all."""
    return h if weight == 1 else system.number(weight) * h


@dataclass(frozen=True)
class Splitting:
    """A composition of the exact flows of the two halves of a separable system, in the order they are applied.

    ``flows`` is a sequence of ("kick", d), which adds d h force(q) to the momenta, and ("drift", c), which adds
    c h velocity(p) to the positions.  Symplectic for every separable Hamiltonian.

    Raises:
        ValueError: kicks or drifts do not sum to 1, or neighbours are of one kind.
    """

    name: str
    order: int
    source: str
    flows: tuple[tuple[str, Coefficient], ...]
    aliases: tuple[str, ...] = ()
    family: str = "symplectic, explicit"
    symplectic: bool = True
    separable_only: bool = True

    def __post_init__(self) -> None:
        for kind in ("kick", "drift"):
            total = sum((weight for flow, weight in self.flows if flow == kind), Q(0))
            if total != 1:
                raise ValueError(f"{self.name}: the {kind}s sum to {total}; a sum of 1 is accepted.")
        if any(first[0] == second[0] for first, second in pairwise(self.flows)):
            raise ValueError(
                f"{self.name}: two neighbouring flows are of one kind; kicks and drifts in turn are accepted."
            )

    @property
    def stages(self) -> int:
        return sum(kind == "kick" for kind, _ in self.flows)

    def contraction(self, rate: float) -> float:  # noqa: ARG002 - explicit: there is nothing to iterate
        return 0.0

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        """One fewer per step where the last kick's force is the first kick's of the next step."""
        shared = self.flows[0][0] == self.flows[-1][0] == "kick"
        return self.stages - shared, int(shared)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        positions, momenta = y[: system.positions], y[system.positions :]
        for kind, weight in self.flows:
            dt = _part(system, weight, h)
            if kind == "kick":
                momenta = tuple(p + dt * f for p, f in zip(momenta, system.force(positions), strict=True))
            else:
                positions = tuple(q + dt * v for q, v in zip(positions, system.velocity(momenta), strict=True))
        return positions + momenta, ()


def compose(
    base: Splitting, weights: Sequence[Coefficient], name: str, order: int, source: str, aliases: tuple[str, ...] = ()
) -> Splitting:
    """The splitting that applies ``base`` with steps ``weights`` h one after another, neighbours of one kind merged."""
    flows: list[tuple[str, Coefficient]] = []
    for weight in weights:
        for kind, coefficient in base.flows:
            scaled = weight * coefficient
            if flows and flows[-1][0] == kind:
                scaled = flows.pop()[1] + scaled
            flows.append((kind, scaled))
    return Splitting(name, order, source, tuple(flows), aliases)


Method: TypeAlias = Tableau | Splitting
"""A one-step method with a fixed step.

Either answers ``name, order, source, family, aliases, stages, symplectic, separable_only``;
``contraction(rate)``, the factor by which one fixed-point iteration reduces the error of the stages where h times the
Lipschitz rate is ``rate``; ``evaluations(iterations)``, the evaluations of the right-hand side as (per step, once);
and ``step(system, y, h, iterations)``, the new state and what the last iteration changed (empty for explicit methods).
"""
