"""A user's integrator behind one interface: one step of a state, or states at the times of a grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.methods.own.adapters import hold_times, solution_of
from compare.methods.own.hosting import MisuseError, calling, kind_of, real_numbers
from compare.methods.own.jitted import raised_within, settled
from compare.methods.own.rates import Forces, Gradients

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.methods.own.forms import Form
    from compare.methods.own.rates import Rates

__all__ = ["Integrator"]


@dataclass(frozen=True)
class Integrator:
    """A function and how it is called.

    Attributes:
        function: the user's.
        form: the roles of its arguments.
        name: what it is called.
    """

    function: Callable[..., Any]
    form: Form
    name: str

    def step(self, f: Rates, y: np.ndarray, h: Any, t: Any) -> Any:
        """One step from t: what the function returns, whatever it is, positions and momenta put together.

        Raises:
            MisuseError: the function raised something, which the sentence repeats.
        """
        y = y.copy()  # a step may work in place
        values: dict[str, Any] = {"f": f, "y": y, "h": h, "t": t}
        if self.form.separable:
            values |= {"q": y[: f.positions], "p": y[f.positions :], "force": Forces(f), "gradient": Gradients(f)}
        found = self.called(values)
        return self._joined(found, y) if self.form.separable else found

    def numbers(self, f: Rates, y: np.ndarray, h: float, t: Any) -> np.ndarray:
        """The state a step later, in doubles.

        Raises:
            MisuseError: the function raised something, or gave no such state.
        """
        return self.like(real_numbers(self.step(f, y, h, t), self.name), y)

    def like(self, found: np.ndarray, y: np.ndarray) -> np.ndarray:
        """What a step gave, of the shape of a state.

        Raises:
            MisuseError: it is of another.
        """
        if found.shape != y.shape:
            raise MisuseError(
                f"{self.name} returned an array of shape {found.shape} for a state of shape {y.shape}; the same shape "
                "is accepted."
            )
        return found

    def states(self, f: Rates, y: np.ndarray, grid: np.ndarray) -> np.ndarray:
        """A whole integrator's states [times, state] on a grid.

        Raises:
            MisuseError: the function raised something, or gave no such states.
        """
        found, times = solution_of(self.called({"f": f, "y": y.copy(), "grid": grid.copy()}))
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
        with calling(self.name), raised_within():
            return settled(self.function(*self.form.arguments(values)))

    def _joined(self, found: Any, y: np.ndarray) -> np.ndarray:
        """The new positions and momenta of a separable step as one state."""
        if not isinstance(found, (tuple, list, np.ndarray)) or len(found) != 2:
            raise MisuseError(
                f"{self.name} returned {kind_of(found)}; the new positions and momenta (q, p) are accepted."
            )
        if y.dtype == object:
            return np.concatenate([np.atleast_1d(np.asarray(part, dtype=object)) for part in found])
        parts = [real_numbers(part, self.name) for part in found]
        return np.concatenate([part.reshape(-1, *y.shape[1:]) for part in parts])
