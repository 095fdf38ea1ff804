"""How a user's function is called: which of its arguments is the right-hand side, the state, the step, the time."""

from __future__ import annotations

import functools
import inspect
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.methods.own.library import SUFFIXES, of_library
from reference.named import named
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["FORMS", "Form", "form_of", "loaded", "role_of"]

NAMES = {
    "f": "f fn fun func function rhs field vector_field derivative derivatives deriv dydt ode g",
    "y": "y u z w state yn y_n y0 y_0 u0 z0 x0 x initial start",
    "h": "h dt step step_size stepsize delta_t tau eps",
    "t": "t tn t_n t0 time now",
    "grid": "t ts t_eval times time grid t_grid tspan t_span tgrid points",
    "q": "q x theta position positions pos r q0 x0 r0",
    "p": "p v omega velocity velocities vel momentum momenta p0 v0",
    "force": "force forces f a acc accel acceleration accelerations field",
    "gradient": "grad gradient grad_v gradv grad_u gradu grad_potential dv dvdq dv_dq du dudq du_dq",
    "span": "t_span tspan span interval t_interval t_bounds",
    "end": "t_bound t_end tend t_final tf t_stop tstop t_max tmax",
    "count": "n n_steps nsteps num_steps steps number_of_steps",
    "rtol": "rtol reltol rel_tol tol tolerance",
    "atol": "atol abstol abs_tol",
}
"""What each argument is often called."""
FIRST = "y0 y_0 u0 z0 x0 initial start"
"""What the first state is called, which only a whole integrator knows."""


@dataclass(frozen=True)
class Form:
    """A way to call an integrator: the roles of its positional arguments, in its order.

    Roles are "f" the right-hand side, "y" the state, "h" the step, "t" the time of the step's beginning, "grid" the
    times at which a whole integrator gives the state, and for a separable step "q", "p" and "force", or "gradient".
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
        return "q" in self.roles

    @property
    def own(self) -> bool:
        """Whether it has an equation built in: it is given none."""
        return not {"f", "force", "gradient"} & set(self.roles)

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
    Form("gradient", ("q", "p", "gradient", "h")),
    Form("own", ("y", "h")),
    Form("own-timed", ("t", "y", "h")),
    Form("own-separable", ("q", "p", "h")),
)


def form_of(function: Callable[..., Any], name: str | None = None) -> Form:
    """The form of a function, by the names of its arguments or else by their number.

    Three arguments are ``step(f, y, h)``, or ``integrate(f, y0, t)`` where the third is called t, times or the like.
    Four are ``step(f, t, y, h)``, or ``step(q, p, force, h)`` and ``step(q, p, grad_V, h)`` where they are called so.
    Two are ``step(y, h)`` of an equation of its own, as are ``step(t, y, h)`` and ``step(q, p, h)`` by their names.
    Arguments with a default are left to the function, but for a step size or a time by its name that makes a step of
    the others.  Where every argument has a name that is known, their order is free.

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
    _hold_positional(function)
    arguments = _with_those_that_matter(*found)
    candidates = [known[name]] if name else [form for form in FORMS if len(form.roles) == len(arguments)]
    fits = [form for form in candidates if len(form.roles) == len(arguments)]
    if not fits:
        listed = ", ".join(arguments) or "none"
        raise ValueError(
            f"the integrator has the arguments {listed}; (f, y, h), (f, t, y, h), (q, p, force, h), of an equation of "
            "its own (y, h), or for a whole integrator (f, y0, t) are accepted."
        )
    for form in sorted(fits, key=lambda form: (not form.separable, form.own)):
        if (order := _order(form, arguments)) is not None:
            return Form(form.name, order)
    if fits[0].own and name is None and _is(arguments[0], "f"):
        raise ValueError(
            f"the integrator has the arguments {', '.join(arguments)}, and no step; (f, y, h) is accepted."
        )
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


def _hold_positional(function: Callable[..., Any]) -> None:
    """Refuse an argument without a default that is given by its name alone.

    Raises:
        ValueError: there is one.
    """
    for one in inspect.signature(function).parameters.values():
        if one.kind is one.KEYWORD_ONLY and one.default is one.empty:
            raise ValueError(
                f"the integrator takes {one.name} by its name alone; arguments by their places are accepted."
            )


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


def role_of(argument: str, roles: Sequence[str]) -> str | None:
    """The first of the roles that an argument's name fits."""
    return next((role for role in roles if _is(argument, role)), None)


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

    A library's is a step by the convention of ``compare.methods.own.library``.

    Raises:
        ValueError: the name is not of this form, or there is no such function.
        FileNotFoundError: there is no such file.
        ImportError: the module cannot be imported; the sentence repeats why.
    """
    file, _, function = name.rpartition(":")
    if file.endswith(SUFFIXES):
        return of_library(file, function)
    found = named(name, "function", "STEP", callable)
    return found if inspect.isclass(found) else _named(name.rpartition(":")[2], found)


def _named(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function under the name by which it was asked for; its own may be that of a closure or a lambda."""

    def called(*arguments: Any, **others: Any) -> Any:
        return function(*arguments, **others)

    functools.update_wrapper(called, function, assigned=(), updated=())  # the arguments are still those of the function
    called.__name__ = name
    return called
