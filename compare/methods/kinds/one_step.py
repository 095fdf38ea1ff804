"""One-step methods: frozen tables, the step that follows from each in any arithmetic, and what else follows.

Whether a Runge-Kutta method is symplectic or symmetric is decided by its matrix and its weights: E. Hairer, C. Lubich
and G. Wanner, Geometric Numerical Integration (2006), sections V.2 and VI.4.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby, pairwise
from operator import sub
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from compare.methods.kinds import fixed_point, newton
from compare.methods.kinds.increment import advance, increment, part, turned
from compare.methods.kinds.protocol import AttemptWork, Method, OneStep, State, System
from compare.methods.order.algebraic import EXACT, PROOF_BITS, Coefficient, Q, provable, vanishes
from reference.arithmetic.precision import ctx
from reference.names import unknown
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "Embedded",
    "Method",
    "OneStep",
    "Processed",
    "Splitting",
    "State",
    "System",
    "Tableau",
    "around",
    "compose",
    "is_symmetric",
    "is_symplectic",
    "merged",
    "used_stages",
]

Matrix: TypeAlias = "Sequence[Sequence[Any]]"


def is_symplectic(matrix: Matrix, hat: Matrix, b: Sequence[Any]) -> bool:
    """Whether b_i hat_ij + b_j a_ji = b_i b_j for all i and j; ``hat`` is the matrix itself where there is one."""
    with ctx.workprec(PROOF_BITS):
        w, *rows = _provable_rows([b, *matrix, *hat])
        a, other, stages = rows[: len(b)], rows[len(b) :], range(len(b))
        return all(vanishes(w[i] * other[i][j] + w[j] * a[j][i] - w[i] * w[j]) for i in stages for j in stages)


def is_symmetric(matrix: Matrix, b: Sequence[Any]) -> bool:
    """Whether the method is its own adjoint: a_ij + a_(s+1-i)(s+1-j) = b_j for all i and j."""
    with ctx.workprec(PROOF_BITS):
        w, *a = _provable_rows([b, *matrix])
        last, stages = len(b) - 1, range(len(b))
        return all(vanishes(a[i][j] + a[last - i][last - j] - w[j]) for i in stages for j in stages)


def _provable_rows(rows: Matrix) -> list[list[Any]]:
    """Rows of one length, all exact or all in balls."""
    values, width = provable([entry for row in rows for entry in row]), len(rows[0])
    return [values[i : i + width] for i in range(0, len(values), width)]


def used_stages(matrix: Matrix, b: Sequence[Any]) -> tuple[int, ...]:
    """The stages on which the step depends: those with a weight, and those that such stages need."""
    used = {i for i, weight in enumerate(b) if weight != 0}
    while more := {j for i in used for j, a in enumerate(matrix[i]) if a != 0} - used:
        used |= more
    return tuple(sorted(used))


ITERATIONS = {"Newton's method": newton, "fixed-point iteration": fixed_point}
"""How the slopes of implicit stages are found."""


@dataclass(frozen=True)
class Embedded:
    """Other weights on the stages of a Runge-Kutta method: a result of another order, to estimate the error by."""

    order: int
    b: tuple[Coefficient, ...]


@dataclass(frozen=True)
class Tableau(OneStep):
    """A Runge-Kutta method: Y_i = y + h sum_j a_ij f(Y_j),  y+ = y + h sum_i b_i f(Y_i).

    ``a`` is given as printed: for an explicit method the strictly lower rows (the first empty).  ``c`` is derived from
    c_i = sum_j a_ij; ``nodes`` are the printed ones where they are others, to be shown: the equations hold no time.
    Implicit stages are ``solved_by`` "Newton's method" or by "fixed-point iteration", to rounding either way.

    Coefficients that are decimals as printed miss the order conditions by what was rounded off: gamma(t) sum_i b_i
    Phi_i(t) and its like with embedded weights differ from 1 by ``residual`` at most, which is 0 of exact ones.

    Raises:
        ValueError: the shapes of ``a``, ``b`` and the embedded weights do not match, weights do not sum to 1, or
            there is no such iteration.
    """

    name: str
    order: int
    source: str
    a: tuple[tuple[Coefficient, ...], ...]
    b: tuple[Coefficient, ...]
    family: str = "explicit one-step"
    aliases: tuple[str, ...] = ()
    separable_only: bool = False
    second_order_only: ClassVar[bool] = False
    embedded: tuple[Embedded, ...] = ()
    nodes: tuple[Coefficient, ...] = ()
    residual: Fraction = EXACT
    solved_by: str = "Newton's method"

    def __post_init__(self) -> None:
        if self.solved_by not in ITERATIONS:
            raise ValueError(f"{self.name}: {unknown('iteration', self.solved_by, list(ITERATIONS))}")
        if len(self.a) != len(self.b) or any(len(row) > len(self.b) for row in self.a):
            raise ValueError(
                f"{self.name}: a has {len(self.a)} rows and b {len(self.b)} weights; equally many are accepted."
            )
        for weights in (self.b, *(other.b for other in self.embedded)):
            if len(weights) != len(self.b):
                raise ValueError(f"{self.name}: {len(weights)} embedded weights; {len(self.b)} are accepted.")
            total = sum(weights[1:], weights[0])
            if total != 1 and not (isinstance(total, Fraction) and abs(total - 1) <= self.residual):
                raise ValueError(f"{self.name}: the weights b sum to {total}; a sum of 1 is accepted.")

    @property
    def stages(self) -> int:
        return len(self.b)

    @cached_property
    def matrix(self) -> tuple[tuple[Coefficient, ...], ...]:
        """``a`` as a full square matrix."""
        return tuple(row + (Q(0),) * (self.stages - len(row)) for row in self.a)

    @cached_property
    def c(self) -> tuple[Coefficient, ...]:
        """The nodes as printed, or c_i = sum_j a_ij."""
        return self.nodes or tuple(sum(row, Q(0)) for row in self.a)

    @cached_property
    def explicit(self) -> bool:
        """Whether every stage depends on earlier stages alone."""
        return all(self.matrix[i][j] == 0 for i in range(self.stages) for j in range(i, self.stages))

    @cached_property
    def used(self) -> tuple[int, ...]:
        """The stages that a step of fixed size needs: not one that serves an error estimate alone."""
        return used_stages(self.matrix, self.b)

    @cached_property
    def symplectic(self) -> bool:
        """Whether b_i a_ij + b_j a_ji = b_i b_j; not so of any explicit method, whose weights would all be 0."""
        return not self.explicit and is_symplectic(self.matrix, self.matrix, self.b)

    @cached_property
    def symmetric(self) -> bool:
        """Whether a step back undoes a step; not so of any explicit method."""
        return not self.explicit and is_symmetric(self.matrix, self.b)

    @cached_property
    def fsal(self) -> bool:
        """Whether the last stage is evaluated where the next step begins."""
        return self.stages > 1 and self.matrix[-1] == self.b and all(entry == 0 for entry in self.matrix[0])

    @property
    def _iteration(self) -> Any:
        return ITERATIONS[self.solved_by]

    def iterations(self, size: float, bits: int) -> int:
        return 0 if self.explicit else int(self._iteration.iterations_of(self.matrix, size, bits))

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return (len(self.used) if self.explicit else self._iteration.evaluations(self.matrix, iterations)), 0

    def jacobians(self, iterations: int) -> int:
        return int(self._iteration.jacobians(self.matrix, iterations))

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        if not self.explicit:
            solved, changes = self._iteration.slopes(system, y, h, (self.matrix,) * len(y), iterations)
            return advance(system, y, h, self.b, solved), increment(system, h, self.b, changes)
        return advance(system, y, h, self.b, self._slopes(system, y, h, self.used)), ()

    def _slopes(self, system: System, y: State, h: Any, used: tuple[int, ...]) -> list[State]:
        """The slopes of the stages of an explicit method, of those that are used."""
        slopes: list[State] = []
        for i, row in enumerate(self.matrix):
            slopes.append(system.derivative(advance(system, y, h, row, slopes)) if i in used else ())
        return slopes

    @cached_property
    def _compared(self) -> tuple[int, ...]:
        """The stages that a step needs whose error is estimated."""
        weights = self.b, *(other.b for other in self.embedded)
        return tuple(sorted({i for b in weights for i in used_stages(self.matrix, b)}))

    def attempt(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, tuple[State, ...], State]:
        changed: State = ()
        if self.explicit:
            slopes = self._slopes(system, y, h, self._compared)
        else:
            slopes, changes = self._iteration.slopes(system, y, h, (self.matrix,) * len(y), iterations)
            changed = increment(system, h, self.b, changes)
        own: Matrix = [self.b] * len(self.embedded)
        apart = (map(sub, b, other.b) for b, other in zip(own, self.embedded, strict=True))
        estimates = tuple(increment(system, h, tuple(weights), slopes) for weights in apart)
        return advance(system, y, h, self.b, slopes), estimates, changed

    def attempt_work(self, iterations: int) -> AttemptWork:
        """An explicit method's first stage stands at the state itself, and an iteration begins with the slope there."""
        if self.explicit:
            return AttemptWork(len(self._compared) - 1, 0 if self.fsal else 1)
        return AttemptWork(
            self._iteration.evaluations(self.matrix, iterations) - 1,
            1,
            self._iteration.jacobians(self.matrix, iterations),
        )


@dataclass(frozen=True)
class Splitting(OneStep):
    """A composition of the exact flows of the two halves of a separable system, in the order they are applied.

    ``flows`` is a sequence of ("kick", d), which adds d h F(q) to the momenta, F the force, and ("drift", c), which
    adds c h v(p) to the positions.  Symplectic for every separable Hamiltonian.  With ``nystrom`` it has its order
    where the velocity is linear in the momenta, and may have a lower one elsewhere.

    ("gradient", e) adds 2 e h^3 F'(q) v' F(q), which is e h^3 times the gradient of F^2 where masses are one: with A
    the drift and B the kick, the flow of e h^3 [B, [A, B]].  It needs a velocity that is linear in the momenta, v'
    constant, and the force's derivative along a vector.

    Attributes:
        generalised: orders where the kicks are small, of a part epsilon of the motion, as in the motion of planets:
            (8, 6, 4) leaves errors of epsilon h^8, epsilon^2 h^6, and epsilon^3 h^4; () where none are stated.

    Raises:
        ValueError: kicks or drifts do not sum to 1, neighbours are of one kind, or a gradient is not of Nystrom's kind.
    """

    name: str
    order: int
    source: str
    flows: tuple[tuple[str, Coefficient], ...]
    aliases: tuple[str, ...] = ()
    family: str = "symplectic, explicit"
    symplectic: bool = True
    separable_only: bool = True
    second_order_only: ClassVar[bool] = False
    nystrom: bool = False
    generalised: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        for kind in ("kick", "drift"):
            total: Any = sum((weight for flow, weight in self.flows if flow == kind), Q(0))
            if total != 1:
                raise ValueError(f"{self.name}: the {kind}s sum to {total}; a sum of 1 is accepted.")
        if any(first[0] == second[0] for first, second in pairwise(self.flows)):
            raise ValueError(
                f"{self.name}: two neighbouring flows are of one kind; kicks and drifts in turn are accepted."
            )
        if self.linear_velocities_only and not self.nystrom:
            raise ValueError(f"{self.name}: a gradient is of Nystrom's kind alone; nystrom=True is accepted.")

    @property
    def linear_velocities_only(self) -> bool:
        """Whether there are gradients, whose direction is a force as a velocity."""
        return any(kind == "gradient" for kind, _ in self.flows)

    @property
    def repeated(self) -> tuple[tuple[str, Coefficient], ...]:
        """The flows that each further step adds to the work of a march: all of them."""
        return self.flows

    @property
    def stages(self) -> int:
        """Where the force is evaluated: a kick and a gradient beside it share it."""
        return _stages(self.repeated)

    @cached_property
    def symmetric(self) -> bool:
        """Whether a step back undoes a step: the flows are a palindrome."""
        return self.flows == merged(self.flows[::-1])

    @property
    def fsal(self) -> bool:
        """Whether the last kick's force is the first kick's of the next step."""
        return "drift" not in {self.repeated[0][0], self.repeated[-1][0]}

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        """One fewer per step where the last kick's force is the first kick's of the next step."""
        return self.stages - self.fsal, int(self.fsal)

    def jacobians(self, iterations: int) -> int:  # noqa: ARG002
        """The derivatives of the force along itself that a step adds: the last may be the first of the next step."""
        kinds = [kind for kind, _ in self.repeated]
        return kinds.count("gradient") - (self.fsal and "gradient" in kinds[:2] and kinds[-1] == "gradient")

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        positions, momenta = y[: system.positions], y[system.positions :]
        force: State = ()
        for kind, weight in self.flows:
            dt = part(system, weight, h)
            if kind == "drift":
                positions = tuple(q + dt * v for q, v in zip(positions, system.velocity(momenta), strict=True))
                force = ()
                continue
            force = force or system.force(positions)
            pull = force if kind == "kick" else system.force_along(positions, turned(system, force))
            size = dt if kind == "kick" else dt * (h * h + h * h)
            momenta = tuple(p + size * f for p, f in zip(momenta, pull, strict=True))
        return positions + momenta, ()


@dataclass(frozen=True)
class Processed(Splitting):
    """A kernel between a processor and its inverse: what a step of the kernel lacks of its order, the processor gives.

    From step to step the inverse and the processor cancel: a march has the work of one kernel a step, and of both
    processors once.  Here they are applied at every step, because each of its states is looked at.
    """

    processor: tuple[tuple[str, Coefficient], ...] = ()
    kernel: tuple[tuple[str, Coefficient], ...] = ()

    @property
    def repeated(self) -> tuple[tuple[str, Coefficient], ...]:
        """The kernel."""
        return self.kernel

    def evaluations(self, iterations: int) -> tuple[int, int]:
        """Those of the kernel, and once besides those of the processor and of its inverse."""
        own, once = super().evaluations(iterations)
        return own, once + 2 * _stages(self.processor)


def around(kernel: Sequence[tuple[str, Any]], processor: Sequence[tuple[str, Any]]) -> tuple[tuple[str, Any], ...]:
    """The processor, the kernel and the inverse of the processor as flows of one step."""
    return merged([*processor, *kernel, *((kind, -weight) for kind, weight in reversed(processor))])


def _stages(flows: Sequence[tuple[str, Any]]) -> int:
    kinds = [kind for kind, _ in flows]
    return sum(kind != "drift" and before in {"drift", ""} for before, kind in pairwise(("", *kinds)))


def merged(flows: Sequence[tuple[str, Any]]) -> tuple[tuple[str, Any], ...]:
    """The same flows with neighbours of one kind as one, a gradient behind the kick that it commutes with."""
    groups = [tuple(group) for _, group in groupby(flows, key=lambda flow: flow[0] == "drift")]
    kinds = ((group, kind) for group in groups for kind in ("drift", "kick", "gradient"))
    weighed = ((kind, [weight for flow, weight in group if flow == kind]) for group, kind in kinds)
    return tuple((kind, sum(weights[1:], weights[0])) for kind, weights in weighed if weights)


def compose(
    base: Splitting, weights: Sequence[Coefficient], name: str, order: int, source: str, aliases: tuple[str, ...] = ()
) -> Splitting:
    """The splitting that applies ``base`` with steps ``weights`` h one after another, neighbours of one kind merged."""
    factors: Sequence[Any] = weights
    flows = merged([(kind, weight * coefficient) for weight in factors for kind, coefficient in base.flows])
    return Splitting(name, order, source, flows, aliases)
