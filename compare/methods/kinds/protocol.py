"""What a march asks of a method, and a method of an equation.

A step is written once, on a ``System`` (the equation in the arithmetic at hand) and a tuple of numbers.  The same lines
run on floats, on NumPy arrays of any type, and on heyoka's symbols, which compiles them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, runtime_checkable

if TYPE_CHECKING:
    from compare.methods.order.algebraic import Coefficient, Enclosed

__all__ = ["AttemptWork", "EmbeddedResult", "Equation", "Method", "OneStep", "Pair", "State", "System"]

State = tuple[Any, ...]
"""The numbers that a lane carries from step to step: the problem's state, then what the method remembers."""


class Equation(Protocol):
    """y' = f(y) in one arithmetic."""

    def number(self, value: Coefficient | Enclosed) -> Any:
        """An exact coefficient, or one known by its enclosures, as a number of the arithmetic."""

    def derivative(self, y: State) -> State:
        """f(y)."""

    def jacobian(self, y: State) -> tuple[State, ...]:
        """The rows df_i/dy_j of f at y; an entry that is always zero is the integer 0."""


class System(Equation, Protocol):
    """An equation of motion y' = f(y) in one arithmetic; positions first where it is separable."""

    dimension: int
    """How many components the problem's state has."""
    positions: int
    """How many of the components are positions, 0 where the equation is not separable."""
    clock: int | None
    """Where the time stands in the state of an equation that depends on it; None where it does not."""
    tiny: Any
    """A number that is nothing beside any other but zero."""

    @property
    def time(self) -> Any:
        """The time at which a step begins, where it does not stand in the state."""

    @property
    def initial_invariant(self) -> Any:
        """The first invariant at the start of the march, which a conservative method keeps."""

    def velocity(self, momenta: State) -> State:
        """The rates of the positions, which depend on the momenta alone."""

    def force(self, positions: State) -> State:
        """The rates of the momenta, which depend on the positions alone."""

    def force_along(self, positions: State, direction: State) -> State:
        """The derivative of the force along a direction in the space of the positions, exact but for rounding."""

    def jet(self, y: State, order: int) -> list[State]:
        """y^(k)/k! for k = 1, ..., order, of the solution through y; what is always zero is the integer 0."""

    def invariant(self, y: State) -> Any:
        """The first of the problem's invariants."""

    def gradient(self, y: State) -> State:
        """The slopes of the first invariant."""


class Method(Protocol):
    """A method with a fixed step, as a march takes it."""

    def __hash__(self) -> int: ...

    @property
    def name(self) -> str: ...
    @property
    def order(self) -> int: ...
    @property
    def source(self) -> str: ...
    @property
    def family(self) -> str: ...
    @property
    def aliases(self) -> tuple[str, ...]: ...
    @property
    def stages(self) -> int: ...
    @property
    def symplectic(self) -> bool: ...
    @property
    def separable_only(self) -> bool: ...
    @property
    def second_order_only(self) -> bool: ...
    @property
    def linear_velocities_only(self) -> bool:
        """Whether a step turns forces into velocities, which it can where these are linear in the momenta."""

    @property
    def opaque(self) -> bool:
        """Whether a step is a function of somebody else's, of which nothing is known but what it gives.

        Its evaluations are counted, and where it cannot be traced it is marched state by state.
        """

    @property
    def starting_steps(self) -> int:
        """How many steps ``start`` takes: those that a method with a memory cannot take itself."""

    def memory(self, dimension: int, positions: int) -> int:
        """How many numbers are carried from step to step behind a state of this dimension."""

    def iterations(self, size: float, bits: int) -> int:
        """Iterations that solve a step's equations to ``bits`` bits, where h times the Lipschitz rate is ``size``."""

    def evaluations(self, iterations: int) -> tuple[int, int]:
        """Evaluations of the right-hand side in a step, and once besides, the start's among them."""

    def jacobians(self, iterations: int) -> int:
        """Evaluations of the Jacobian, or of the invariant's gradient, in a step."""

    def start(self, system: System, y: State, h: Any) -> tuple[tuple[State, ...], State]:
        """The states after each starting step, and the last of them (or y) with the memory behind it."""

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        """The state and memory after a step, and what the last iteration changed (nothing in an explicit method)."""


class EmbeddedResult(Protocol):
    """Another result on the stages of a method, to estimate its error by."""

    @property
    def order(self) -> int: ...


@dataclass(frozen=True)
class AttemptWork:
    """What an attempt at a step costs, whether it is accepted or not, and what each new state costs besides.

    Attributes:
        evaluations: of the right-hand side in an attempt, without what is known of the state that it starts from.
        at_state: evaluations at that state, which serve every attempt from there; 0 where the step before gave them.
        jacobians: of its Jacobian in an attempt.
        jacobians_at_state: of its Jacobian at that state.
    """

    evaluations: int
    at_state: int
    jacobians: int = 0
    jacobians_at_state: int = 0


@runtime_checkable
class Pair(Method, Protocol):
    """A method that can estimate the error of its step, where any results are ``embedded`` in it."""

    @property
    def embedded(self) -> tuple[EmbeddedResult, ...]: ...

    def attempt(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, tuple[State, ...], State]:
        """The state after a step, what it is apart from each embedded result, and what the last iteration changed."""

    def attempt_work(self, iterations: int) -> AttemptWork:
        """What an attempt at a step costs."""


class OneStep:
    """What the explicit methods without a memory have in common."""

    starting_steps: ClassVar[int] = 0
    opaque: ClassVar[bool] = False

    @property
    def linear_velocities_only(self) -> bool:
        """Whether forces are turned into velocities; not so of most."""
        return False

    def memory(self, dimension: int, positions: int) -> int:  # noqa: ARG002
        return 0

    def iterations(self, size: float, bits: int) -> int:  # noqa: ARG002
        return 0

    def jacobians(self, iterations: int) -> int:  # noqa: ARG002
        return 0

    def start(self, system: System, y: State, h: Any) -> tuple[tuple[State, ...], State]:  # noqa: ARG002
        return (), y
