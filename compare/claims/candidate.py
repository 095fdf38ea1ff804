"""A user's integrator behind one interface: one step of a state, or states at the times of a grid.

How a user's function is called: which of its arguments is the right-hand side, the state, the step, the time.

A user's function by name: MODULE:STEP, or FILE.py:STEP.
"""

from __future__ import annotations

import functools
import inspect
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.frames import Field, MisuseError
from reference.named import named
from reference.names import printable, unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.frames import Scene

__all__ = ["FORMS", "Candidate", "Form", "form_of", "loaded"]

NAMES = {
    "f": "f fn fun func function rhs field vector_field derivative derivatives deriv dydt ode g",
    "y": "y u z w state yn y_n y0 y_0 u0 z0 x0 x initial start",
    "h": "h dt step step_size stepsize delta_t tau eps",
    "t": "t tn t_n t0 time now",
    "grid": "t ts t_eval times time grid t_grid tspan t_span tgrid points",
    "q": "q x theta position positions pos r",
    "p": "p v omega velocity velocities vel momentum momenta",
    "force": "force forces f a acc accel acceleration accelerations grad gradient grad_v gradv grad_potential dv dvdq "
    "field",
}
"""What each argument is often called."""
FIRST = "y0 y_0 u0 z0 x0 initial start"
"""What the first state is called, which only a whole integrator knows."""


@dataclass(frozen=True)
class Form:
    """A way to call an integrator: the roles of its positional arguments, in its order.

    Roles are "f" the right-hand side, "y" the state, "h" the step, "t" the time of the step's beginning, "grid" the
    times at which a whole integrator gives the state, and for a separable step "q", "p" and "force".
    """

    name: str
    roles: tuple[str, ...]

    @property
    def whole(self) -> bool:
        """Whether it integrates over a grid of times by itself."""
        return "grid" in self.roles

    @property
    def separable(self) -> bool:
        """Whether it takes positions and momenta apart."""
        return "force" in self.roles

    @property
    def timed(self) -> bool:
        """Whether a step is told its time."""
        return "t" in self.roles

    def arguments(self, values: dict[str, Any]) -> list[Any]:
        """The values of the roles in the order of the arguments."""
        return [values[role] for role in self.roles]


FORMS = (
    Form("step", ("f", "y", "h")),
    Form("timed", ("f", "t", "y", "h")),
    Form("integrator", ("f", "y", "grid")),
    Form("separable", ("q", "p", "force", "h")),
)


def form_of(function: Callable[..., Any], name: str | None = None) -> Form:
    """The form of a function, by the names of its arguments or else by their number.

    Three arguments are ``step(f, y, h)``, or ``integrate(f, y0, t)`` where the third is called t, times or the like.
    Four are ``step(f, t, y, h)``, or ``step(q, p, force, h)`` where they are called so.  Arguments with a default are
    left to the function, but for a step size or a time by its name that makes a step of the others.  Where every
    argument has a name that is known, their order is free.

    Raises:
        TypeError: it cannot be called.
        ValueError: it takes another number of arguments, or ``name`` is no form.
    """
    if not callable(function):
        raise TypeError(f"the integrator is of type {type(function).__name__}; a function is accepted.")
    known = {form.name: form for form in FORMS}
    if name is not None and name not in known:
        raise ValueError(unknown("form", name, known))
    found = _arguments(function)
    if found is None:
        return known[name or "step"]
    arguments = _with_those_that_matter(*found)
    candidates = [known[name]] if name else [form for form in FORMS if len(form.roles) == len(arguments)]
    fits = [form for form in candidates if len(form.roles) == len(arguments)]
    if not fits:
        listed = ", ".join(arguments) or "none"
        raise ValueError(
            f"the integrator has the arguments {listed}; (f, y, h), (f, t, y, h), (q, p, force, h), or for a whole "
            "integrator (f, y0, t) are accepted."
        )
    for form in sorted(fits, key=lambda form: not form.separable):
        if (order := _order(form, arguments)) is not None:
            return Form(form.name, order)
    last_is_time = len(arguments) == 3 and _is(arguments[2], "grid")
    return known["integrator"] if last_is_time and name is None else fits[0]


def _arguments(function: Callable[..., Any]) -> tuple[list[str], list[str]] | None:
    """The names of the positional arguments without and with a default; None where they cannot be known."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (ValueError, TypeError):
        return None
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    named = [one.name for one in parameters if one.kind in positional and one.default is inspect.Parameter.empty]
    given = [one.name for one in parameters if one.kind in positional and one.default is not inspect.Parameter.empty]
    some = any(one.kind is inspect.Parameter.VAR_POSITIONAL for one in parameters)
    return None if some and len(named) < 3 else (named, given)


def _with_those_that_matter(named: list[str], given: list[str]) -> list[str]:
    """The arguments without a default, and a step size or a time with one that follows and makes a step of them.

    ``integrate(f, y0, t, h=0.1)`` stays a whole integrator, whose own step its last argument is.
    """
    steps = [form for form in FORMS if not form.whole]
    for more in (named + given[:2], named + given[:1]):
        extra = more[len(named) :]
        if not all(_is(one, "h") or _is(one, "t") for one in extra) or _whole(named):
            continue
        if any(_order(form, more) for form in steps):
            return more
    sizeless = len(named) in {2, 3} and not any(_is(one, "h") or _is(one, "grid") for one in named)
    return named + given[:1] if sizeless and given and _is(given[0], "h") else named


def _whole(named: list[str]) -> bool:
    """Whether these alone are a whole integrator: a grid of times at the end, or a state that is called the first."""
    last = len(named) == 3 and _is(named[-1], "grid")
    return last or (_order(FORMS[2], named) is not None and any(one.casefold() in FIRST.split() for one in named))


def _is(argument: str, role: str) -> bool:
    return argument.casefold() in NAMES[role].split()


def _order(form: Form, arguments: list[str]) -> tuple[str, ...] | None:
    """The roles in the order of the arguments, if each argument has a name that fits one of them and no other."""
    found: list[str] = []
    for argument in arguments:
        fits = [role for role in form.roles if role not in found and _is(argument, role)]
        if not fits:
            return None
        found.append(fits[0])
    return tuple(found) if len(found) == len(form.roles) else None


def loaded(name: str) -> Callable[..., Any]:
    """The function that ``name`` says: a module that can be imported from here or a file, and what is in it.

    Raises:
        ValueError: the name is not of this form, or there is no such function.
        FileNotFoundError: there is no such file.
        ImportError: the module cannot be imported; the sentence repeats why.
    """
    found = named(name, "function", "STEP", callable)
    return _named(name.rpartition(":")[2], found)


def _named(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function under the name by which it was asked for; its own may be that of a closure or a lambda."""

    def called(*arguments: Any) -> Any:
        return function(*arguments)

    functools.update_wrapper(called, function, assigned=(), updated=())  # the arguments are still those of the function
    called.__name__ = name
    return called


MAX_CALLS = 10_000
"""Calls of f that one step, or each time of a grid, may take."""
MOST_TOLD = 400
"""Characters of what a user's exception says that are repeated."""


@dataclass(frozen=True)
class Candidate:
    """A function and how it is called.

    Attributes:
        function: the user's.
        form: the roles of its arguments.
        name: what it is called.
    """

    function: Callable[..., Any]
    form: Form
    name: str

    def hold(self, scene: Scene) -> None:
        """Refuse a form that a problem has no place for.

        Raises:
            MisuseError: positions and momenta are taken apart, and the problem does not split so.
        """
        problem = scene.problem
        if not self.form.separable:
            return
        if not problem.positions:
            lack = f"{problem!r} does not split into kicks and drifts; (f, y, h) is accepted"
        elif not problem.autonomous:
            lack = f"the force of {problem!r} depends on the time, which is not given; (f, t, y, h) is accepted"
        elif not scene.follows_rates:
            lack = f"p is not the rate of q in {problem!r}; (f, y, h) is accepted"
        else:
            return
        raise MisuseError(f"{self.name} takes (q, p, force, h), but {lack}.")

    def field(self, scene: Scene, grid: int = 1) -> Field:
        """The right-hand side for one call of the function, which goes over so many times of a grid."""
        return Field(scene, MAX_CALLS * grid)

    def step(self, field: Field, y: Any, h: Any, t: Any) -> Any:
        """One step from t: what the function returns, whatever it is, positions and momenta put together.

        Raises:
            MisuseError: the function raised something, which the sentence repeats.
        """
        y = y.copy()  # a step may work in place
        values: dict[str, Any] = {"f": field, "y": y, "h": h, "t": t}
        if self.form.separable:
            positions = field.scene.problem.positions
            values |= {"q": y[:positions], "p": y[positions:], "force": _Forces(field)}
        found = self._called(values)
        return self._joined(found, y) if self.form.separable else found

    def states(self, field: Field, y: np.ndarray, grid: np.ndarray) -> np.ndarray:
        """A whole integrator's states [times, state] on a grid.

        Raises:
            MisuseError: the function raised something, or gave no such states.
        """
        found = self._called({"f": field, "y": y.copy(), "grid": grid.copy()})
        found = getattr(found, "y", found)
        array = self.numbers(found, f"{self.name} on {len(grid)} times")
        if array.shape == (len(y), len(grid)) and len(y) != len(grid):
            array = array.T
        if array.shape != (len(grid), len(y)):
            raise MisuseError(
                f"{self.name} returned an array of shape {array.shape} for {len(grid)} times; "
                f"({len(grid)}, {len(y)}) is accepted, a state for each time."
            )
        return array

    def numbers(self, found: Any, what: str) -> np.ndarray:
        """What a call returned, as an array of finite doubles.

        Raises:
            MisuseError: it is something else.
        """
        if found is None:
            raise MisuseError(f"{what} returned nothing; the new state is accepted.")
        try:
            array = np.asarray(found)
        except ValueError:
            raise MisuseError(f"{what} returned a ragged sequence; a state as it was given is accepted.") from None
        except MemoryError:
            raise MisuseError(f"{what} returned a sequence that no memory holds; a state is accepted.") from None
        if array.dtype.kind == "c":
            raise MisuseError(f"{what} returned complex numbers; real ones are accepted.")
        if array.dtype.kind not in "fiu":
            raise MisuseError(f"{what} returned {_kind(found)}; an array of real numbers is accepted.")
        return array.astype(np.float64)

    def _called(self, values: dict[str, Any]) -> Any:
        try:
            with np.errstate(all="ignore"):
                return self.function(*self.form.arguments(values))
        except MisuseError:
            raise
        except (Exception, SystemExit) as error:
            told = _told(error)
            raise MisuseError(f"{self.name} raised {type(error).__name__}{': ' * bool(told)}{told}.") from error

    def _joined(self, found: Any, y: Any) -> Any:
        """The new positions and momenta of a separable step as one state."""
        if not isinstance(found, (tuple, list, np.ndarray)) or len(found) != 2:
            raise MisuseError(
                f"{self.name} returned {_kind(found)}; the new positions and momenta (q, p) are accepted."
            )
        if y.dtype == object:
            return np.concatenate([np.atleast_1d(np.asarray(part, dtype=object)) for part in found])
        parts = [self.numbers(part, self.name) for part in found]
        return np.concatenate([part.reshape(-1, *y.shape[1:]) for part in parts])


class _Forces:
    """force(q): the rates of the momenta, of the shape of q."""

    def __init__(self, field: Field) -> None:
        self._field = field

    def __call__(self, q: Any) -> Any:
        positions = self._field.scene.problem.positions
        q = np.asarray(q)
        zeros = np.zeros((self._field.scene.dimension - positions, *q.shape[1:]))
        state = np.concatenate([q.reshape(positions, *q.shape[1:]), zeros.astype(q.dtype)])
        return self._field(state)[positions:]


def _told(error: BaseException) -> str:
    """What an exception says, in one line of no more than MOST_TOLD characters; nothing where it cannot say it."""
    try:
        told = printable(" ".join(str(error)[: MOST_TOLD + 1].split()))
    except (Exception, SystemExit):  # noqa: BLE001 - a user's own __str__ may raise anything
        return ""
    return f"{told[:MOST_TOLD]}..." if len(told) > MOST_TOLD else told


def _kind(found: Any) -> str:
    return f"an array of {found.dtype}" if isinstance(found, np.ndarray) else f"a {type(found).__name__}"
