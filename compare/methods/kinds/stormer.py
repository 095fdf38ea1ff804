"""Stoermer's and Cowell's multistep methods for q'' = F(q): frozen tables, and the step that follows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from compare.methods.kinds import newton
from compare.methods.kinds.increment import increment
from compare.methods.kinds.multistep import Linear, Past, moved, total, without_zeros
from compare.methods.order.algebraic import Q
from compare.methods.order.multistep import is_zero_stable, multistep_order, velocity_weights
from reference.once import cached_property

if TYPE_CHECKING:
    from fractions import Fraction

    from compare.methods.kinds.protocol import Method, State, System

__all__ = ["StormerCowell"]


@dataclass(frozen=True)
class StormerCowell(Linear):
    """q_{n+k} - 2 q_{n+k-1} + q_{n+k-2} = h^2 sum_j beta_j F_{n+j},  j = 0 ... k; explicit where beta_k = 0.

    The velocity p_n = (q_n - q_{n-1})/h + h sum_j w_j F_{n-j} interpolates F through the last ``velocity`` values.  In
    it the step is written by increments of position and velocity, without the small differences of large positions:

        q_{n+1} = q_n + h (p_n + h sum_j (beta_{k-1-j} - w_j) F_{n-j} + h beta_k F_{n+1}),
        p_{n+1} = p_n + h (sum_j (beta_{k-1-j} - w_j) F_{n-j} + beta_k F_{n+1} + sum_j w_j F_{n+1-j}).

    Raises:
        ValueError: the beta do not sum to 1.
    """

    name: str
    order: int
    source: str
    beta: tuple[Fraction, ...]
    velocity: int
    starter: Method
    aliases: tuple[str, ...] = ()
    separable_only: ClassVar[bool] = True
    second_order_only: ClassVar[bool] = True
    powers: ClassVar[int] = 2

    def __post_init__(self) -> None:
        if sum(self.beta) != 1:
            raise ValueError(f"{self.name}: the weights beta sum to {sum(self.beta)}; a sum of 1 is accepted.")

    @property
    def alpha(self) -> tuple[Fraction, ...]:
        """The weights of the positions."""
        return (Q(0),) * (len(self.beta) - 3) + (Q(1), Q(-2), Q(1))

    @property
    def zero_stable(self) -> bool:
        """Whether past errors grow no faster than those of free motion."""
        return is_zero_stable(self.alpha, 2)

    def proven_order(self) -> int:
        return multistep_order(self.alpha, self.beta, 2)

    @cached_property
    def of_velocity(self) -> tuple[Fraction, ...]:
        """w_j: the weights of F_n, F_{n-1}, ... in the velocity."""
        return velocity_weights(self.velocity)

    @cached_property
    def of_forces(self) -> tuple[Fraction, ...]:
        """beta_{k-1-j} - w_j: the weights of F_n, F_{n-1}, ... in both increments."""
        known, velocity = without_zeros(self.beta[-2::-1]), self.of_velocity
        size = max(len(known), len(velocity))
        padded = (weights + (Q(0),) * (size - len(weights)) for weights in (known, velocity))
        return tuple(a - b for a, b in zip(*padded, strict=True))

    @cached_property
    def past(self) -> Past:
        """What is remembered from step to step: forces."""
        return Past(0, len(self.of_forces), self.starter)

    def start(self, system: System, y: State, h: Any) -> tuple[tuple[State, ...], State]:
        """The starting procedure.

        Raises:
            ValueError: the equation is not q'' = F(q): its velocity is not the momentum.
        """
        momenta = y[system.positions :]
        if any(np.any(a != b) for a, b in zip(system.velocity(momenta), momenta, strict=True)):
            raise ValueError(f"{self.name} marches q'' = F(q), and here the velocity is not the momentum.")
        return self.past.start(system, y, h, lambda state: system.force(state[: system.positions]))

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        state, _, forces = self.past.split(y, system.dimension)
        q, p = state[: system.positions], state[system.positions :]
        kick = increment(system, h, self.of_forces, forces)
        drift = tuple(h * rate for rate in total(system.velocity(p), kick))
        changes: State = ()
        if not self.explicit:
            equation = _Positions(system, p)
            (force,), (change,) = newton.slopes(equation, moved(q, drift), h * h, (self.matrix,) * len(q), iterations)
            last = increment(system, h, self.beta[-1:], [force])
            kick, drift = total(kick, last), total(drift, tuple(h * rate for rate in last))
            changes = tuple(h * rate for rate in increment(system, h, self.beta[-1:], [change]))
        q = moved(q, drift)
        forces = [system.force(q) if self.explicit else force, *forces]
        p = moved(p, total(kick, increment(system, h, self.of_velocity, forces)))
        return self.past.join(q + p, (), forces), changes


class _Positions:
    """The equation of the positions alone, whose slopes are forces."""

    def __init__(self, system: System, momenta: State) -> None:
        self._system, self._momenta = system, momenta
        self.number = system.number
        self.derivative = system.force

    def jacobian(self, positions: State) -> tuple[State, ...]:
        rows = self._system.jacobian(positions + self._momenta)
        return tuple(row[: len(positions)] for row in rows[len(positions) :])
