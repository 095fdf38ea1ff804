"""A method from a function of the user's own: a step, or a whole integrator, of one of the forms of ``forms``."""

from __future__ import annotations

import sys
from contextlib import nullcontext, redirect_stdout
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from compare.methods.kinds.protocol import OneStep
from compare.methods.own.adapters import adapted, hold_times, solution_of
from compare.methods.own.hosting import (
    MAX_CALLS,
    Exhausted,
    MisuseError,
    hosted,
    kind_of,
    real_numbers,
    repeatable,
    told,
)
from reference.named import named

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.methods.kinds.protocol import State, System
    from compare.methods.own.forms import Form

__all__ = ["MOST_ORDER", "StepFunction", "method", "method_at"]

MOST_ORDER = 40
"""An order beyond this one shows in no march."""


@dataclass(frozen=True)
class StepFunction(OneStep):
    """A method that a function takes: a step of a state, or of its positions and momenta, or a whole grid of times.

    It is marched as the methods of the tables are where it can be: traced with symbols and compiled.  Else it is
    marched state by state.  In doubles alone, for its constants are Python's floats.

    Attributes:
        function: the user's.
        order: the order that it is declared to have.
        name: what tables call it.
        symplectic: whether it is declared to be symplectic.
        calls: of f in a step, as far as that is known before a march: there they are counted.
        form: how it is called.
        home: MODULE:NAME or FILE.py:NAME, by which another process finds it; "" where it is known here alone.
    """

    function: Callable[..., Any]
    order: int
    name: str
    symplectic: bool
    calls: int
    form: Form
    home: str = ""
    source: str = "a step function of the user's own"
    aliases: tuple[str, ...] = ()
    family: ClassVar[str] = "own"
    second_order_only: ClassVar[bool] = False
    opaque: ClassVar[bool] = True

    def __reduce__(self) -> Any:
        """By where it is found: what stands there may be a closure, or what ``method`` has made of the function."""
        return (method_at, (self.home, self.order, self.name)) if self.home else super().__reduce__()

    @property
    def separable_only(self) -> bool:
        """Whether it takes positions and momenta apart."""
        return self.form.separable

    @property
    def whole(self) -> bool:
        """Whether it goes over a grid of times by itself."""
        return self.form.whole

    @property
    def stages(self) -> int:
        return self.calls

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        return self.calls, 0

    def __call__(self, *arguments: Any) -> Any:
        """The function itself."""
        return self.function(*arguments)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        """A step of the function, on a state of doubles, of symbols or of sums.

        Raises:
            MisuseError: it fails on them, or gives no state of the same shape.
        """
        state, clock = np.array(y), self.clock(system)
        symbolic = state.dtype == object
        time = system.time if clock is None else y[clock]
        own = state if clock is None else np.delete(state, clock)
        values: dict[str, Any] = {"f": _Rates(self, system), "y": own, "h": h if symbolic else float(h), "t": time}
        if self.form.separable:
            values |= {"q": own[: system.positions], "p": own[system.positions :]}
            values |= {"force": _Forces(self, system), "gradient": _Gradients(self, system)}
        with hosted(self.name) if symbolic else nullcontext():  # a march is hosted as a whole
            found = self._called(values)
        if self.form.separable:
            found = self._joined(found, own)
        new = np.asarray(found, dtype=object) if symbolic and found is not None else real_numbers(found, self.name)
        if new.shape != own.shape:
            raise MisuseError(
                f"{self.name} returned an array of shape {new.shape} for a state of shape {own.shape}; the same shape "
                "is accepted."
            )
        return (tuple(new) if clock is None else (*new[:clock], time + h, *new[clock:])), ()

    def states(self, system: System, y: State, grid: np.ndarray) -> np.ndarray:
        """A whole integrator's states [times, state] on a grid.

        Raises:
            MisuseError: it fails on it, or gives no such states.
        """
        state, clock = np.array(y), self.clock(system)
        own = state if clock is None else np.delete(state, clock)
        found, times = solution_of(self._called({"f": _Rates(self, system), "y": own.copy(), "grid": grid.copy()}))
        if times is not None:
            hold_times(real_numbers(times, self.name), grid, self.name)
        array = real_numbers(found, f"{self.name} on {len(grid)} times")
        if array.shape == (len(own), len(grid)) and len(own) != len(grid):
            array = array.T
        if array.shape != (len(grid), len(own)):
            raise MisuseError(
                f"{self.name} returned an array of shape {array.shape} for {len(grid)} times; "
                f"({len(grid)}, {len(own)}) is accepted, a state for each time."
            )
        return array if clock is None else np.insert(array, clock, grid, axis=1)

    def clock(self, system: System) -> int | None:
        """Where the time stands in the state, for a function that takes it apart."""
        return system.clock if self.form.timed or self.form.whole else None

    def _called(self, values: dict[str, Any]) -> Any:
        try:
            return self.function(*self.form.arguments(values))
        except MisuseError:
            raise
        except (Exception, SystemExit) as error:
            raise MisuseError(f"{self.name} raised {told(error)}.") from error

    def _joined(self, found: Any, state: np.ndarray) -> np.ndarray:
        """The new positions and momenta of a separable step as one state."""
        if not isinstance(found, (tuple, list, np.ndarray)) or len(found) != 2:
            raise MisuseError(
                f"{self.name} returned {kind_of(found)}; the new positions and momenta (q, p) are accepted."
            )
        if state.dtype == object:
            return np.concatenate([np.atleast_1d(np.asarray(part, dtype=object)) for part in found])
        return np.concatenate([real_numbers(part, self.name).ravel() for part in found])


class _Rates:
    """f(y), or f(t, y) with the time in either place: an array or a sequence gives an array of the same shape."""

    def __init__(self, own: StepFunction, system: System) -> None:
        self._own, self._system, self._clock = own, system, own.clock(system)
        self._dimension = system.dimension - (self._clock is not None)

    def __call__(self, *arguments: Any) -> np.ndarray:
        if len(arguments) == 1:
            return self._of(self._system.time, np.asarray(arguments[0]), timed=False)
        parts = [np.asarray(argument) for argument in arguments]
        if len(parts) != 2 or parts[0].ndim == parts[1].ndim:
            shapes = ", ".join(str(part.shape) for part in parts) or "none"
            raise MisuseError(f"f was called with arguments of the shapes {shapes}; f(y) or f(t, y) is accepted.")
        time, y = sorted(parts, key=lambda part: part.ndim)
        return self._of(time[()], y, timed=True)

    def _of(self, time: Any, y: np.ndarray, *, timed: bool) -> np.ndarray:
        if y.shape != (self._dimension,):
            raise MisuseError(
                f"{self._own.name} called f with a state of shape {y.shape}; a state of {self._dimension} components "
                "is accepted."
            )
        if self._system.clock is not None and timed != (self._clock is not None):
            told = "the time, which stands in its state" if timed else "no time"
            raise MisuseError(f"{self._own.name} gives f {told}; f{'(y)' if timed else '(t, y)'} is accepted.")
        dtype: Any = object if y.dtype == object else np.float64
        full = tuple(y) if self._clock is None else (*y[: self._clock], time, *y[self._clock :])
        slopes = list(self._system.derivative(full))
        if self._clock is not None:
            del slopes[self._clock]
        return np.array(slopes, dtype=dtype)


class _Forces:
    """force(q): the rates of the momenta, of the shape of q."""

    def __init__(self, own: StepFunction, system: System) -> None:
        self._own, self._system = own, system

    def __call__(self, q: Any) -> np.ndarray:
        positions = np.asarray(q)
        if positions.size != self._system.positions:
            raise MisuseError(
                f"{self._own.name} called force with an array of shape {positions.shape}; {self._system.positions} "
                "positions are accepted."
            )
        dtype: Any = object if positions.dtype == object else np.float64
        return np.array(self._system.force(tuple(positions.ravel())), dtype=dtype).reshape(positions.shape)


class _Gradients(_Forces):
    """grad_V(q): the slopes of the potential, of the shape of q."""

    def __call__(self, q: Any) -> np.ndarray:
        return -super().__call__(q)


def method(
    *, order: int, name: str | None = None, symplectic: bool = False, form: str | None = None
) -> Callable[[Callable[..., Any]], StepFunction]:
    """Make a method of a function: ``@compare.method(order=4)`` before ``def my_step(f, y, h)``.

    Args:
        order: the order that it is declared to have, which tables hold the observed one against.
        name: what tables call it; the function's name if None.
        symplectic: whether it is declared to be symplectic.
        form: "step" (f, y, h), "timed" (f, t, y, h), "separable" (q, p, force, h), "gradient" (q, p, grad_V, h) or
            "integrator" (f, y0, t), where the arguments' names do not say it; classes, generators and solvers over a
            span of time are known by themselves.

    Raises:
        ValueError: the order is no positive integer up to MOST_ORDER, the form is unknown, or the function does not
            work on an equation of two components.
        TypeError: the function cannot be called.
    """
    if isinstance(order, bool) or not isinstance(order, int) or not 0 < order <= MOST_ORDER:
        raise ValueError(f"order is {order!r}; a positive integer up to {MOST_ORDER} is accepted.")

    def made(function: Callable[..., Any]) -> StepFunction:
        if not callable(function):
            raise TypeError(f"{function!r} is no function; a step (f, y, h) is accepted.")
        called = name or str(getattr(function, "__name__", type(function).__name__))
        adapted_function, known = adapted(function, form)
        if known.own:
            raise ValueError(f"{called} has an equation of its own; a function that is given f is accepted.")
        found = StepFunction(adapted_function, order, called, symplectic, 0, known)
        return replace(found, calls=_calls(found))

    return made


@cache
def method_at(home: str, order: int | None, name: str) -> StepFunction:
    """The method of a function in a module or file of the user's own, the same each time that it is asked for.

    Args:
        home: MODULE:NAME or FILE.py:NAME.
        order: that it is to have; None where ``method`` has declared one.
        name: what tables call it.

    Raises:
        ValueError: there is no such function, or it is no step, or without an order.
        FileNotFoundError, ImportError: the module cannot be imported.
    """
    with redirect_stdout(sys.stderr):
        found = named(home, "function", "STEP", callable)
    if not isinstance(found, StepFunction):
        if order is None:
            raise ValueError(
                f"{home} declares no order; a function under @compare.method(order=P), or --claims P beside --method, "
                "is accepted."
            )
        found = method(order=order, name=name)(found)
    aliases = (found.name,) if found.name != name else ()
    own: StepFunction = replace(found, order=order or found.order, name=name, home=home, aliases=aliases)
    return own


@dataclass
class _Trial:
    """y1' = y2, y2' = -y1 - y1^3: what a function is tried on before anything else."""

    dimension: int = 2
    positions: int = 1
    clock: None = None
    time: float = 0.0
    calls: int = field(default=0)

    def derivative(self, y: State) -> State:
        return (y[1], *self.force(y[:1]))

    def force(self, positions: State) -> State:
        self.calls += 1
        if self.calls > MAX_CALLS:
            raise Exhausted(f"called f more than {MAX_CALLS} times")
        return (-positions[0] - positions[0] ** 3,)


START, STEP, GRID = (1.0, 0.5), 0.125, 8


def _calls(own: StepFunction) -> int:
    """How often a step calls f, tried on an equation of two components.

    Raises:
        MisuseError: it gives no finite state, or another one for the same state and step, or does not call f.
    """
    answers = []
    for _ in range(2):
        trial: Any = _Trial()
        with hosted(own.name):
            if own.whole:
                answers.append(own.states(trial, START, STEP * np.arange(GRID + 1)).ravel())
            else:
                answers.append(np.array(own.step(trial, START, STEP)[0]))
    repeatable(own.name, *answers)
    if not np.all(np.isfinite(answers[0])):
        raise MisuseError(f"{own.name} returned {answers[0].tolist()}; finite numbers are accepted.")
    if not trial.calls:
        raise MisuseError(f"{own.name} does not call f; a step (f, y, h) is accepted.")
    return max(trial.calls // GRID, 1) if own.whole else int(trial.calls)
