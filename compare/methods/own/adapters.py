"""What people have, as a step or as an integrator over a grid: classes, generators, and solvers over a span of time.

A class is made for each march, ``Solver(f, t0, y0, h)``, and its ``step()`` is called; a generator yields a state a
step, with its time or without; a solver is called as SciPy's ``solve_ivp``, ``solve(f, t_span, y0)``, with the times as
its ``t_eval`` if it takes them, else with its step or number of steps, else once for each step of the grid.
"""

from __future__ import annotations

import functools
import inspect
from itertools import islice, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.methods.own.forms import Form, form_of, role_of
from compare.methods.own.hosting import MisuseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

__all__ = ["adapted", "hold_times", "solution_of", "with_arguments"]

LEFT = ("h", "count", "grid", "end", "t")
"""Roles of arguments that have a default and are given nevertheless."""
MADE = ("f", "t", "y", "h", "end", "count", "span")
"""Roles of what a class or a generator is made with."""
SOLVED = ("f", "span", "y", "grid", "h", "count")
"""And of what a solver is called with."""
STEP = ("step", "advance", "do_step")
"""What the method is called that takes a step."""
STATE = ("y", "state", "u", "x")
SAME, SAME_TIME = 1e-9, 1e-6
"""Times that differ by so much of a step are the same, and the second where they are told."""


def adapted(function: Callable[..., Any], form: str | None = None) -> tuple[Callable[..., Any], Form]:
    """What a user has as a function that is called in one of FORMS, and how that is.

    Raises:
        TypeError: it cannot be called.
        ValueError: it has arguments of other kinds, or ``form`` is none.
    """
    whole = Form("integrator", ("f", "y", "grid"))
    generates = inspect.isgeneratorfunction(inspect.unwrap(function) if callable(function) else function)
    if form is not None and (generates or inspect.isclass(function)):
        kind = "generator" if generates else "class"
        raise ValueError(f"form is {form!r} for a {kind}, which is one by itself; none is accepted.")
    if inspect.isclass(function) and (steps := _steps_of(function)) is not None:
        return steps
    if inspect.isclass(function):
        return _Made(function).integrate, Form("class", whole.roles)
    if generates:
        return _generated(function), Form("generator", whole.roles)
    if form is None and callable(function) and _spanned(function):
        return _solved(function), Form("solver", whole.roles)
    return function, form_of(function, form)


def with_arguments(function: Callable[..., Any], given: Mapping[str, Any]) -> Callable[..., Any]:
    """The function, or the class, that has these of its arguments already."""
    signature = inspect.signature(function)
    left = signature.replace(parameters=[one for name, one in signature.parameters.items() if name not in given])
    if inspect.isclass(function):
        made = functools.partialmethod(function.__init__, **given)
        return type(function.__name__, (function,), {"__init__": made, "__signature__": left})
    bound = functools.partial(function, **given)
    bound.__signature__ = left  # type: ignore[attr-defined]
    bound.__name__ = str(getattr(function, "__name__", "integrator"))  # type: ignore[attr-defined]
    return bound


def _roles(function: Callable[..., Any], roles: Sequence[str]) -> dict[str, str]:
    """The name of each argument that is given, and its role.

    Raises:
        ValueError: an argument without a default has none of the roles, or the state is not among them.
    """
    found: dict[str, str] = {}
    listed = []
    for name, one in inspect.signature(function).parameters.items():
        if one.kind in {inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD}:
            continue
        listed.append(name)
        role = role_of(name, [role for role in roles if role not in found.values()])
        needed = one.default is inspect.Parameter.empty
        if needed and role is None:
            accepted = ", ".join(
                {"y": "y0", "span": "t_span", "grid": "t_eval", "count": "n"}.get(role, role) for role in roles
            )
            raise ValueError(f"it takes an argument {name}, which it is not given; {accepted} are accepted.")
        if role is not None and (needed or role in LEFT):
            found[name] = role
    if "y" not in found.values():
        raise ValueError(f"it has the arguments {', '.join(listed)}; one is the first state, y0.")
    return found


def _steps_of(made: type) -> tuple[Callable[..., Any], Form] | None:
    """Of a class made with f alone, whose method steps a state: that step and its form; None where it is no such."""
    name = next((name for name in STEP if callable(getattr(made, name, None))), None)
    roles = [role_of(one, ("f", "y")) for one in inspect.signature(made).parameters]
    if name is None or roles != ["f"]:
        return None
    left = list(inspect.signature(getattr(made, name)).parameters.values())[1:]
    f = inspect.Parameter("f", inspect.Parameter.POSITIONAL_ONLY)

    def step(f: Any, *arguments: Any) -> Any:
        return getattr(made(f), name)(*arguments)

    step.__signature__ = inspect.Signature([f, *left])  # type: ignore[attr-defined]
    step.__name__ = made.__name__
    return step, form_of(step)


def _called(function: Callable[..., Any], names: Mapping[str, str], values: Mapping[str, Any]) -> Any:
    """A function with its arguments by their roles."""
    kinds = inspect.signature(function).parameters
    given = [(name, values[role]) for name, role in names.items()]
    first = [value for name, value in given if kinds[name].kind is inspect.Parameter.POSITIONAL_ONLY]
    return function(
        *first, **{name: value for name, value in given if kinds[name].kind is not inspect.Parameter.POSITIONAL_ONLY}
    )


def _values(f: Any, y0: np.ndarray, grid: np.ndarray) -> dict[str, Any]:
    """What each role is on a grid."""
    h = float(grid[1] - grid[0])
    ends = float(grid[0]), float(grid[-1])
    return {"f": f, "t": ends[0], "y": y0, "h": h, "end": ends[1], "count": len(grid) - 1, "span": ends, "grid": grid}


class _Made:
    """A class whose objects carry a state along, and step."""

    def __init__(self, made: Callable[..., Any]) -> None:
        self._made, self.__name__ = made, str(getattr(made, "__name__", "class"))
        self._names = _roles(made, MADE)
        self._step = next((name for name in STEP if callable(getattr(made, name, None))), None)
        if self._step is None:
            raise ValueError(f"{self.__name__} is a class without a method {' or '.join(STEP)}; one is accepted.")

    def integrate(self, f: Any, y0: np.ndarray, grid: np.ndarray) -> np.ndarray:
        """The states on a grid."""
        values = _values(f, y0, grid)
        solver = _called(self._made, self._names, values)
        step = getattr(solver, str(self._step))
        asked = {name: role for name, role in _roles_of_a_step(step).items() if role in {"f", "t", "h"}}
        found = [y0]
        for t in grid[1:]:
            found.append(self._at(solver, float(t), values["h"], lambda: _called(step, asked, values)))
            values["t"] = float(t)
        return np.array(found)

    def _at(self, solver: Any, t: float, h: float, step: Callable[[], Any]) -> np.ndarray:
        """The state at a time: after a step, or after as many as the solver takes to be there."""
        told = isinstance(getattr(solver, "t", None), (float, int, np.floating))
        if not told or solver.t < t - SAME * h:
            step()
        while told and solver.t < t - SAME * h:
            if not callable(getattr(solver, "dense_output", None)):
                raise MisuseError(
                    f"{self.__name__} is at t = {solver.t:.6g} after the step that leads to {t:.6g}; steps of the h "
                    "that is given, or a dense_output() between them, are accepted."
                )
            step()
        if told and solver.t > t + SAME * h:
            found: np.ndarray = np.array(solver.dense_output()(t))
            return found
        return self._state(solver)

    def _state(self, solver: Any) -> np.ndarray:
        name = next((name for name in STATE if axes(getattr(solver, name, None)) == 1), None)
        if name is not None:
            return np.array(getattr(solver, name))
        if hasattr(solver, "q") and hasattr(solver, "p"):
            return np.concatenate([np.atleast_1d(solver.q), np.atleast_1d(solver.p)])
        raise MisuseError(f"{self.__name__} has no state; one of {', '.join(STATE)}, or q and p, is accepted.")


def _roles_of_a_step(step: Callable[..., Any]) -> dict[str, str]:
    found = {}
    for name, one in inspect.signature(step).parameters.items():
        if one.default is inspect.Parameter.empty and one.kind is not inspect.Parameter.VAR_POSITIONAL:
            found[name] = role_of(name, ("f", "t", "h")) or "h"
    return found


def _generated(function: Callable[..., Any]) -> Callable[..., Any]:
    names = _roles(function, MADE)

    def integrate(f: Any, y0: np.ndarray, grid: np.ndarray) -> np.ndarray:
        start = grid[0], y0
        items = _yielded(_called(function, names, _values(f, y0, grid)))
        first = next(items, start)
        begun = [first] if np.array_equal(first[1], y0) else [start, first]
        found = [*begun, *islice(items, len(grid) - len(begun))]
        if len(found) < len(grid):
            raise MisuseError(
                f"{integrate.__name__} yielded {len(found)} states where {len(grid)} were asked for; one a step is "
                "accepted."
            )
        times, states = zip(*found, strict=True)
        if None not in times:
            hold_times(np.array(times, dtype=float), grid, integrate.__name__)
        return np.array(states)

    integrate.__name__ = str(getattr(function, "__name__", "generator"))
    return integrate


def _yielded(items: Iterator[Any]) -> Iterator[tuple[Any, np.ndarray]]:
    """What is yielded: the time, None where it is not told, and the state."""
    for item in items:
        timed = isinstance(item, (tuple, list)) and len(item) == 2 and np.ndim(item[0]) == 0 and np.ndim(item[1]) == 1
        time, state = item if timed else (None, item)
        yield time, np.array(state, dtype=float)


def _spanned(function: Callable[..., Any]) -> bool:
    """Whether a function is called as ``solve_ivp``: with a span of time before the state."""
    try:
        names = list(inspect.signature(function).parameters)
    except (ValueError, TypeError):
        return False
    return len(names) >= 3 and role_of(names[1], ("span",)) is not None


def _solved(function: Callable[..., Any]) -> Callable[..., Any]:
    names = _roles(function, SOLVED)

    def integrate(f: Any, y0: np.ndarray, grid: np.ndarray) -> Any:
        if {"grid", "h", "count"} & set(names.values()):
            return _called(function, names, _values(f, y0, grid))
        found = [y0]
        for ends in pairwise(grid):
            solved = _called(function, names, {"f": f, "y": found[-1].copy(), "span": tuple(map(float, ends))})
            found.append(_last(solved, len(y0)))
        return np.array(found)

    integrate.__name__ = str(getattr(function, "__name__", "solver"))
    return integrate


def _last(solved: Any, dimension: int) -> np.ndarray:
    """The last state of a solution."""
    states = np.asarray(getattr(solved, "y", getattr(solved, "ys", solved)), dtype=float)
    if states.ndim == 2:
        states = states[:, -1] if states.shape[0] == dimension else states[-1]
    return states


STATES = "y ys u us x xs states state"
TIMES = "t ts times time"
"""What solutions call them."""


def axes(value: Any) -> int:
    """How many axes a value has; none is None's."""
    return -1 if value is None else int(np.ndim(value))


def solution_of(found: Any) -> tuple[Any, Any]:
    """The states of what a whole integrator returned, and its times, None where it gives none."""
    if isinstance(found, (tuple, list)) and len(found) == 2 and axes(found[0]) == 1 and axes(found[1]) == 2:
        return found[1], found[0]
    states = _attribute(found, STATES, 2)
    return (found, None) if states is None else (states, _attribute(found, TIMES, 1))


def _attribute(found: Any, names: str, count: int) -> Any:
    """The first attribute of these names that has so many axes, or None."""
    values = (getattr(found, name, None) for name in names.split())
    return next((value for value in values if axes(value) == count), None)


def hold_times(found: np.ndarray, grid: np.ndarray, name: str) -> None:
    """Hold the times of a solution against those that were asked for.

    Raises:
        MisuseError: they are others.
    """
    if found.shape != grid.shape or np.max(np.abs(found - grid)) > SAME_TIME * np.max(np.abs(np.diff(grid))):
        raise MisuseError(
            f"{name} gave the states at {found.size} times of its own, where {len(grid)} from {grid[0]:.4g} to "
            f"{grid[-1]:.4g} were asked for; the states at those are accepted."
        )
