"""A user's integrator behind one interface: one step of a state, or states at the times of a grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.frames import Field, MisuseError, is_traced
from compare.claims.jitted import is_jitted, jitted
from reference.names import printable

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.forms import Form
    from compare.claims.frames import Scene

__all__ = ["Candidate", "axes"]

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
        if self.form.own and not scene.problem.autonomous and not self.form.timed:
            raise MisuseError(f"{self.name} takes no time, on which {problem!r} depends; (t, y, h) is accepted.")
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
        raise MisuseError(f"{self.name} takes ({', '.join(self.form.roles)}), but {lack}.")

    def field(self, scene: Scene, grid: int = 1) -> Field:
        """The right-hand side for one call of the function, which goes over so many times of a grid."""
        return Field(scene, MAX_CALLS * grid, self)

    def step(self, field: Field, y: Any, h: Any, t: Any) -> Any:
        """One step from t: what the function returns, whatever it is, positions and momenta put together.

        Raises:
            MisuseError: the function raised something, which the sentence repeats.
        """
        y = y.copy()  # a step may work in place
        values: dict[str, Any] = {"f": field, "y": y, "h": h, "t": t}
        if self.form.separable:
            positions = field.scene.problem.positions
            values |= {"q": y[:positions], "p": y[positions:]}
            values |= {"force": _Forces(field), "gradient": _Gradients(field)}
        found = self._called(values)
        return self._joined(found, y) if self.form.separable else found

    def states(self, field: Field, y: np.ndarray, grid: np.ndarray) -> np.ndarray:
        """A whole integrator's states [times, state] on a grid.

        Raises:
            MisuseError: the function raised something, or gave no such states.
        """
        found, times = _solution(self._called({"f": field, "y": y.copy(), "grid": grid.copy()}))
        array = self.numbers(found, f"{self.name} on {len(grid)} times")
        if times is not None:
            own = self.numbers(times, f"{self.name} on {len(grid)} times")
            if own.shape != grid.shape or np.max(np.abs(own - grid)) > SAME_TIME * np.max(np.abs(np.diff(grid))):
                raise MisuseError(
                    f"{self.name} gave the states at {own.size} times of its own, where {len(grid)} from "
                    f"{grid[0]:.4g} to {grid[-1]:.4g} were asked for; the states at those are accepted."
                )
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
        if "f" in values and is_jitted(self.function):
            values = {**values, "f": jitted(values["f"])}
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


SAME_TIME = 1e-6
"""A time within so much of a step is the same."""
STATES = "y ys u us x xs states state"
TIMES = "t ts times time"
"""What solutions call them."""


def axes(value: Any) -> int:
    """How many axes a value has; none is None's."""
    return -1 if value is None else int(np.ndim(value))


def _solution(found: Any) -> tuple[Any, Any]:
    """The states of what a whole integrator returned, and its times, None where it gives none."""
    if isinstance(found, (tuple, list)) and len(found) == 2 and axes(found[0]) == 1 and axes(found[1]) == 2:
        return found[1], found[0]
    states = _attribute(found, STATES, 2)
    return (found, None) if states is None else (states, _attribute(found, TIMES, 1))


def _attribute(found: Any, names: str, count: int) -> Any:
    """The first attribute of these names that has so many axes, or None."""
    values = (getattr(found, name, None) for name in names.split())
    return next((value for value in values if axes(value) == count), None)


@dataclass(frozen=True)
class _Forces:
    """force(q): the rates of the momenta, of the shape of q; equal where the field is, as JAX asks."""

    field: Field

    def __call__(self, q: Any) -> Any:
        numbers: Any = np
        if is_traced(q):
            import jax.numpy as numbers
        positions = self.field.scene.problem.positions
        q = numbers.asarray(q)
        zeros = numbers.zeros((self.field.scene.dimension - positions, *q.shape[1:]))
        state = numbers.concatenate([q.reshape(positions, *q.shape[1:]), zeros.astype(q.dtype)])
        return self.field(state)[positions:]


class _Gradients(_Forces):
    """grad_V(q): the slopes of the potential, of the shape of q."""

    def __call__(self, q: Any) -> Any:
        return -super().__call__(q)


def _told(error: BaseException) -> str:
    """What an exception says, in one line of no more than MOST_TOLD characters; nothing where it cannot say it."""
    try:
        told = printable(" ".join(str(error)[: MOST_TOLD + 1].split()))
    except (Exception, SystemExit):  # noqa: BLE001 - a user's own __str__ may raise anything
        return ""
    return f"{told[:MOST_TOLD]}..." if len(told) > MOST_TOLD else told


def _kind(found: Any) -> str:
    return f"an array of {found.dtype}" if isinstance(found, np.ndarray) else f"a {type(found).__name__}"
