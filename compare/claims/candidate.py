"""A user's integrator behind one interface: one step of a state, or states at the times of a grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.field import Field, MisuseError
from reference.names import printable

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.forms import Form
    from compare.claims.frames import Scene

__all__ = ["Candidate"]

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
