"""Taylor's method with a fixed order and a fixed step: the Taylor polynomial of the solution, at every step anew."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from compare.methods.kinds.protocol import OneStep

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import State, System

__all__ = ["Taylor"]


@dataclass(frozen=True)
class Taylor(OneStep):
    """y+ = y + h y[1] + h^2 y[2] + ... + h^p y[p], with the normalized derivatives y[k] = y^(k)/k! by recurrence.

    (k+1) y[k+1] = [f(y)][k], the coefficient of t^k in f along the series itself, by automatic differentiation; where a
    step begins the equation must be analytic.  A jet of order p counts as p evaluations, one for each derivative of the
    solution, as solvers of this kind are counted; the operations for the k-th grow in proportion to k.
    """

    name: str
    order: int
    source: str
    aliases: tuple[str, ...] = ()
    family: str = "Taylor"
    symplectic: bool = False
    separable_only: bool = False
    second_order_only: ClassVar[bool] = False

    @property
    def stages(self) -> int:
        """All derivatives are those at the beginning of the step."""
        return 1

    @property
    def formula(self) -> str:
        """What a step does, in words for those who have it shown."""
        return (
            f"y + h (y[1] + h (y[2] + ... + h y[{self.order}])), where (k+1) y[k+1] = [f(y)][k] is the coefficient of "
            "t^k in f of the series y + y[1] t + ... + y[k] t^k"
        )

    def proven_order(self) -> int:
        """By Butcher's trees: the step is taken on the equations that they stand for."""
        from compare.methods.order.conditions import order_by_steps

        return order_by_steps(self)

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        return self.order, 0

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        *lower, slope = system.jet(y, self.order)
        for derivative in reversed(lower):
            slope = tuple(own + h * rest for own, rest in zip(derivative, slope, strict=True))
        return tuple(value + h * rate for value, rate in zip(y, slope, strict=True)), ()
