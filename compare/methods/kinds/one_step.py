"""One-step methods: frozen tables, the step that follows from each in any arithmetic, and what else follows.

Whether a Runge-Kutta method is symplectic, symmetric, A-stable or L-stable is decided by its matrix and its weights:
E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), sections V.2 and VI.4, and E. Hairer and
G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.3.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby, pairwise
from math import lcm
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from flint import fmpz_poly

from compare.methods.kinds import newton
from compare.methods.kinds.increment import advance, increment, part, turned
from compare.methods.kinds.protocol import Method, OneStep, State, System
from compare.methods.order.algebraic import Algebraic, Coefficient, Q, enclose
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "Embedded",
    "Method",
    "OneStep",
    "Processed",
    "Splitting",
    "Stability",
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
Polynomial: TypeAlias = list[Fraction]
"""Coefficients, the constant first."""


def is_symplectic(matrix: Matrix, hat: Matrix, b: Sequence[Any]) -> bool:
    """Whether b_i hat_ij + b_j a_ji = b_i b_j for all i and j; ``hat`` is the matrix itself where there is one."""
    stages = range(len(b))
    return all(b[i] * hat[i][j] + b[j] * matrix[j][i] == b[i] * b[j] for i in stages for j in stages)


def is_symmetric(matrix: Matrix, b: Sequence[Any]) -> bool:
    """Whether the method is its own adjoint: a_ij + a_(s+1-i)(s+1-j) = b_j for all i and j."""
    last = len(b) - 1
    stages = range(len(b))
    return all(matrix[i][j] + matrix[last - i][last - j] == b[j] for i in stages for j in stages)


def used_stages(matrix: Matrix, b: Sequence[Any]) -> tuple[int, ...]:
    """The stages on which the step depends: those with a weight, and those that such stages need."""
    used = {i for i, weight in enumerate(b) if weight != 0}
    while more := {j for i in used for j, a in enumerate(matrix[i]) if a != 0} - used:
        used |= more
    return tuple(sorted(used))


class Stability:
    """The stability function R(z) = det(I - z a + z 1 b^T)/det(I - z a) of a method.

    Attributes:
        numerator, denominator: integer polynomials without a common factor.
    """

    def __init__(self, matrix: Matrix, b: Sequence[Any]) -> None:
        shifted = [[entry - weight for entry, weight in zip(row, b, strict=True)] for row in matrix]
        above, below = _determinant(shifted), _determinant(matrix)
        scale = lcm(*(value.denominator for value in [*above, *below]))
        first, second = (fmpz_poly([int(value * scale) for value in p]) for p in (above, below))
        common = first.gcd(second)
        self.numerator, self.denominator = first // common, second // common

    @property
    def a_stable(self) -> bool:
        """Whether |R(z)| <= 1 where Re z <= 0: so on the imaginary axis, and no pole to its left or on it."""
        if any(not value.real > 0 for value, _ in self.denominator.complex_roots()):
            return False
        excess = _on_the_axis(self.denominator) - _on_the_axis(self.numerator)
        return excess == 0 or (excess[excess.degree()] > 0 and not _changes_sign(excess))

    @property
    def l_stable(self) -> bool:
        """Whether it is A-stable, and R(z) vanishes at infinity."""
        return self.a_stable and self.numerator.degree() < self.denominator.degree()


def _determinant(matrix: Matrix) -> Polynomial:
    """det(I - z a) in powers of z, by Faddeev and LeVerrier; rational, as it is for every method of this package."""
    size = range(len(matrix))
    coefficients: list[Any] = [Fraction(1)]
    product: list[list[Any]] = [[Fraction(0)] * len(matrix) for _ in size]
    for k in range(1, len(matrix) + 1):
        inner = [[product[i][j] + (coefficients[-1] if i == j else 0) for j in size] for i in size]
        product = [[sum((matrix[i][m] * inner[m][j] for m in size), Fraction(0)) for j in size] for i in size]
        coefficients.append(-sum((product[i][i] for i in size), Fraction(0)) / k)
    return [_rational(value) for value in coefficients]


def _rational(value: Fraction | Algebraic) -> Fraction:
    fraction = value.rational if isinstance(value, Algebraic) else value
    if fraction is None:
        raise ArithmeticError(f"the stability function has the coefficient {value}, which is not rational.")
    return fraction


def _on_the_axis(polynomial: fmpz_poly) -> fmpz_poly:
    """|p(iy)|^2 as a polynomial in x = y^2."""
    mirrored = fmpz_poly([int(c) * (-1) ** i for i, c in enumerate(polynomial.coeffs())])
    product = polynomial * mirrored
    return fmpz_poly([int(c) * (-1) ** i for i, c in enumerate(product.coeffs()[::2])])


def _changes_sign(polynomial: fmpz_poly) -> bool:
    """Whether a polynomial has a root of odd multiplicity on the positive axis."""
    odd = (factor for factor, times in polynomial.factor()[1] if times % 2)
    roots = [value for factor in odd if factor.degree() > 0 for value, _ in factor.complex_roots()]
    return any(value.imag == 0 and value.real > 0 for value in roots)


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

    Raises:
        ValueError: the shapes of ``a``, ``b`` and the embedded weights do not match, or weights do not sum to 1.
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

    def __post_init__(self) -> None:
        if len(self.a) != len(self.b) or any(len(row) > len(self.b) for row in self.a):
            raise ValueError(
                f"{self.name}: a has {len(self.a)} rows and b {len(self.b)} weights; equally many are accepted."
            )
        for weights in (self.b, *(other.b for other in self.embedded)):
            if len(weights) != len(self.b):
                raise ValueError(f"{self.name}: {len(weights)} embedded weights; {len(self.b)} are accepted.")
            total = sum(weights[1:], weights[0])
            if total != 1:
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

    def iterations(self, size: float, bits: int) -> int:
        if self.explicit:
            return 0
        norm = max(sum(abs(float(enclose(entry))) for entry in row) for row in self.matrix)
        return newton.iterations(size * norm, bits)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return (len(self.used) if self.explicit else newton.evaluations(self.matrix, iterations)), 0

    def jacobians(self, iterations: int) -> int:
        return newton.jacobians(self.matrix, iterations)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        if not self.explicit:
            solved, changes = newton.slopes(system, y, h, (self.matrix,) * len(y), iterations)
            return advance(system, y, h, self.b, solved), increment(system, h, self.b, changes)
        slopes: list[State] = []
        for i, row in enumerate(self.matrix):
            slopes.append(system.derivative(advance(system, y, h, row, slopes)) if i in self.used else ())
        return advance(system, y, h, self.b, slopes), ()


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
