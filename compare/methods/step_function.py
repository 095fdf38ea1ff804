"""A method from a step function of the user's own: ``step(f, y, h)`` gives the state a step later."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from compare.methods.kinds.protocol import OneStep

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.methods.kinds.protocol import State, System

__all__ = ["StepFunction", "method"]


@dataclass(frozen=True)
class StepFunction(OneStep):
    """A one-step method that a function takes: ``function(f, y, h)``, y an array along whose first axis the state goes.

    It is marched as the methods of the tables are: traced with symbols and compiled, and held against its plain
    evaluation, which a function with an ``if`` on its values does not pass.  In doubles alone, for its constants are
    Python's floats.

    Attributes:
        function: the step; ``f(y)`` is an array of y's shape.
        order: the order that it is declared to have.
        name: what tables call it.
        symplectic: whether it is declared to be symplectic.
        calls: of f in a step.
    """

    function: Callable[[Callable[[Any], Any], Any, Any], Any]
    order: int
    name: str
    symplectic: bool
    calls: int
    source: str = "a step function of the user's own"
    aliases: tuple[str, ...] = ()
    family: ClassVar[str] = "own"
    separable_only: ClassVar[bool] = False
    second_order_only: ClassVar[bool] = False

    @property
    def stages(self) -> int:
        return self.calls

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        return self.calls, 0

    def __call__(self, f: Callable[[Any], Any], y: Any, h: Any) -> Any:
        """The function itself."""
        return self.function(f, y, h)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        """A step of the function on the state's numbers, symbols or arrays of lanes.

        Raises:
            ValueError: it fails on them, or gives no state of the same shape.
        """

        def rates(state: Any) -> Any:
            slopes = system.derivative(tuple(state))
            return np.array(np.broadcast_arrays(*slopes), dtype=np.asarray(state).dtype)

        now = np.array(y)
        try:
            found = np.asarray(self.function(rates, now, h))
        except (TypeError, ValueError, AttributeError, ArithmeticError) as error:
            raise ValueError(
                f"{self.name} raised {type(error).__name__} on an array of {now.dtype}: {error}; a step that is made "
                "of arithmetic on y alone is accepted, for it is traced with symbols."
            ) from error
        if found.shape != now.shape:
            raise ValueError(
                f"{self.name} returned an array of shape {found.shape} for a state of shape {now.shape}; the same "
                "shape is accepted."
            )
        return tuple(found), ()


def method(
    *, order: int, name: str | None = None, symplectic: bool = False
) -> Callable[[Callable[[Callable[[Any], Any], Any, Any], Any]], StepFunction]:
    """Make a method of a step function: ``@compare.method(order=4)`` before ``def my_step(f, y, h)``.

    Args:
        order: the order that it is declared to have, which tables hold the observed one against.
        name: what tables call it; the function's name if None.
        symplectic: whether it is declared to be symplectic.

    Raises:
        ValueError: the order is no positive integer, or the step does not work on an equation of two components.
        TypeError: the function cannot be called.
    """
    if isinstance(order, bool) or not isinstance(order, int) or order < 1:
        raise ValueError(f"order is {order!r}; a positive integer is accepted.")

    def made(function: Callable[[Callable[[Any], Any], Any, Any], Any]) -> StepFunction:
        if not callable(function):
            raise TypeError(f"{function!r} is no function; a step (f, y, h) is accepted.")
        called = name or str(getattr(function, "__name__", type(function).__name__))
        return StepFunction(function, order, called, symplectic, _calls(function, called))

    return made


def _calls(function: Callable[[Callable[[Any], Any], Any, Any], Any], name: str) -> int:
    """How often a step calls f, tried on y' = (y2, -y1).

    Raises:
        ValueError: it gives no finite state of two components, or does not call f.
    """
    calls = 0

    def turning(y: Any) -> Any:
        nonlocal calls
        calls += 1
        return np.array([y[1], -y[0]])

    found = np.asarray(function(turning, np.array([1.0, 0.5]), 0.125))
    if found.shape != (2,) or not np.all(np.isfinite(found.astype(float))):
        raise ValueError(f"{name} returned {found.tolist()} for a state of two numbers; two finite ones are accepted.")
    if not calls:
        raise ValueError(f"{name} does not call f; a step (f, y, h) is accepted.")
    return calls
