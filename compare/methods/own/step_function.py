"""A method from a function of the user's own: a step, or a whole integrator, of one of the forms of ``forms``."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from compare.methods.kinds.protocol import OneStep
from compare.methods.own.adapters import adapted
from compare.methods.own.hosting import MAX_CALLS, Exhausted, MisuseError, hosted, repeatable
from compare.methods.own.integrator import Integrator
from compare.methods.own.jitted import is_traced, told_jax
from compare.methods.own.rates import Rates
from reference.arithmetic.namespaces import JAX
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
        clock, symbolic = self.clock(system), np.array(y).dtype == object
        time, own = _apart(y, clock)
        time = system.time if clock is None else time
        user, rates = self.user, _Rates(self, system)
        if not symbolic:  # a march is hosted as a whole
            new = user.numbers(rates, own, float(h), time)
        else:
            with hosted(self.name):
                new = user.like(np.asarray(user.step(rates, own, h, time), dtype=object), own)
        return (tuple(new) if clock is None else (*new[:clock], time + h, *new[clock:])), ()

    def states(self, system: System, y: State, grid: np.ndarray) -> np.ndarray:
        """A whole integrator's states [times, state] on a grid.

        Raises:
            MisuseError: it fails on it, or gives no such states.
        """
        clock = self.clock(system)
        found = self.user.states(_Rates(self, system), _apart(y, clock)[1], grid)
        return found if clock is None else np.insert(found, clock, grid, axis=1)

    @property
    def user(self) -> Integrator:
        """The function, as it is called."""
        return Integrator(self.function, self.form, self.name)

    def clock(self, system: System) -> int | None:
        """Where the time stands in the state, for a function that takes it apart."""
        return system.clock if self.form.timed or self.form.whole else None


def _apart(y: State, clock: int | None) -> tuple[Any, np.ndarray]:
    """The time that stands in a state, and the state without it."""
    state = np.array(y)
    return (None, state) if clock is None else (y[clock], np.delete(state, clock))


class _Rates(Rates):
    """Those of a system.

    What JAX compiles asks the latest for its parameters at each call, which is counted: so it is compiled once.
    """

    latest: ClassVar[Any]

    def __init__(self, own: StepFunction, system: Any) -> None:
        self._own, self._system, self._clock = own, system, own.clock(system)
        self.dimension, self.positions = system.dimension - (self._clock is not None), system.positions
        _Rates.latest = system

    @property
    def key(self) -> Any:
        """The method and the equation, whatever its parameters."""
        return self._own, self._system.equation

    def of(self, t: Any, y: Any) -> Any:
        if y.ndim != 1:
            raise MisuseError(
                f"{self._own.name} called f with a state of shape {y.shape}; a state of {self.dimension} components "
                "is accepted."
            )
        if self._system.clock is not None and (t is None) != (self._clock is None):
            told = "no time" if t is None else "the time, which stands in its state"
            raise MisuseError(f"{self._own.name} gives f {told}; f{'(t, y)' if t is None else '(y)'} is accepted.")
        full = tuple(y) if self._clock is None else (*y[: self._clock], t, *y[self._clock :])
        if is_traced(y):
            values = told_jax(_asked_of_the_latest, len(self._system.values))
            slopes = list(self._system.with_parameters(JAX, full, values))
        else:
            slopes = list(self._system.derivative(full))
        if self._clock is not None:
            del slopes[self._clock]
        return slopes


def _asked_of_the_latest() -> np.ndarray:
    """The parameters of the system on which the step is that runs now, for one evaluation."""
    found: np.ndarray = _Rates.latest.asked()
    return found


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


class _Trial:
    """y1' = y2, y2' = -y1 - y1^3: what a function is tried on before anything else."""

    dimension, positions, clock, time = 2, 1, None, 0.0
    equation = "y'' = -y - y^3"
    values = (1.0,)

    def __init__(self) -> None:
        self.calls = 0

    def asked(self) -> np.ndarray:
        """The parameters, for one evaluation."""
        self.calls += 1
        if self.calls > MAX_CALLS:
            raise Exhausted(f"called f more than {MAX_CALLS} times")
        return np.array(self.values)

    def with_parameters(self, _: Any, y: State, values: Any) -> State:
        return y[1], -values[0] * (y[0] + y[0] ** 3)

    def derivative(self, y: State) -> State:
        return self.with_parameters(None, y, self.asked())


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
