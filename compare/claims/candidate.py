"""A user's integrator behind one interface: one step of a state, or states at the times of a grid."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.frames import Field, MisuseError, is_traced
from compare.methods.own.adapters import hold_times, solution_of
from compare.methods.own.hosting import MAX_CALLS, calling, kind_of, real_numbers
from compare.methods.own.jitted import is_jitted, jitted

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.frames import Scene
    from compare.methods.own.forms import Form

__all__ = ["Candidate"]


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
        found = self.called(values)
        return self._joined(found, y) if self.form.separable else found

    def states(self, field: Field, y: np.ndarray, grid: np.ndarray) -> np.ndarray:
        """A whole integrator's states [times, state] on a grid.

        Raises:
            MisuseError: the function raised something, or gave no such states.
        """
        found, times = solution_of(self.called({"f": field, "y": y.copy(), "grid": grid.copy()}))
        array = real_numbers(found, f"{self.name} on {len(grid)} times")
        if times is not None:
            hold_times(real_numbers(times, f"{self.name} on {len(grid)} times"), grid, self.name)
        if array.shape == (len(y), len(grid)) and len(y) != len(grid):
            array = array.T
        if array.shape != (len(grid), len(y)):
            raise MisuseError(
                f"{self.name} returned an array of shape {array.shape} for {len(grid)} times; "
                f"({len(grid)}, {len(y)}) is accepted, a state for each time."
            )
        return array

    def called(self, values: dict[str, Any]) -> Any:
        """What the function returns, given the values of its roles.

        Raises:
            MisuseError: it raised something, which the sentence repeats.
        """
        if "f" in values and is_jitted(self.function):
            values = {**values, "f": jitted(values["f"])}
        with calling(self.name):
            return self.function(*self.form.arguments(values))

    def _joined(self, found: Any, y: Any) -> Any:
        """The new positions and momenta of a separable step as one state."""
        if not isinstance(found, (tuple, list, np.ndarray)) or len(found) != 2:
            raise MisuseError(
                f"{self.name} returned {kind_of(found)}; the new positions and momenta (q, p) are accepted."
            )
        if y.dtype == object:
            return np.concatenate([np.atleast_1d(np.asarray(part, dtype=object)) for part in found])
        parts = [real_numbers(part, self.name) for part in found]
        return np.concatenate([part.reshape(-1, *y.shape[1:]) for part in parts])


@dataclass(frozen=True)
class _Forces:
    """force(q): the rates of the momenta, of the shape of q; equal where the field is, as JAX asks."""

    field: Field

    def __call__(self, q: Any) -> Any:
        numbers: Any = import_module("jax.numpy") if is_traced(q) else np
        positions = self.field.scene.problem.positions
        q = numbers.asarray(q)
        zeros = numbers.zeros((self.field.scene.dimension - positions, *q.shape[1:]))
        state = numbers.concatenate([q.reshape(positions, *q.shape[1:]), zeros.astype(q.dtype)])
        return self.field(state)[positions:]


class _Gradients(_Forces):
    """grad_V(q): the slopes of the potential, of the shape of q."""

    def __call__(self, q: Any) -> Any:
        return -super().__call__(q)
