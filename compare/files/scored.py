"""``compare.score``: numbers from any code, judged."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.files.chunk import Row
from compare.files.judge import CHUNK, Judge
from compare.files.written import of_value
from reference.arithmetic.exact import NO_SEQUENCES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.files.record import Score
    from compare.files.written import Written
    from reference.problem import Problem

__all__ = ["score"]


def score(problem: Problem, t: Any, y: Any) -> Score:
    """Judge a trajectory against the proven state at exactly its times.

    Args:
        problem: a problem with a state in time, such as ``Pendulum(1.0)``.
        t: the times in s, increasing, of shape [rows]: floats at their exact values, decimal strings, Fractions.
        y: the states, of shape [rows, state]: floating-point numbers of any width, decimal strings, Decimals, Fractions
            or mpmath's numbers.  A decimal of 48 digits is judged to 48 digits.

    Raises:
        ValueError: times do not increase, shapes do not match, a number is not finite, or angles are in degrees.
        TypeError: ``problem`` is no problem, something is no real number, or an array is masked.
    """
    judge = Judge(problem)
    times = [of_value(value, "t") for value in _listed(t, "t")]
    states = [_state(row, number, problem.state_names) for number, row in enumerate(_listed(y, "y"), start=1)]
    if len(times) != len(states):
        raise ValueError(f"t has {len(times)} times and y {len(states)} rows; equally many are accepted.")
    judge.expect(number.digits for state in states for number in state)
    running = judge.running(None)
    rows = [
        Row(when, state, f"row {number}")
        for number, (when, state) in enumerate(zip(times, states, strict=True), start=1)
    ]
    for first in range(0, len(rows), CHUNK):
        points = judge.points(rows[first : first + CHUNK])
        judge.turns.add(np.array([point.errors for point in points]))
        running.add(points)
    return judge.score(running, "as written")


def _state(row: Any, number: int, names: Sequence[str]) -> tuple[Written, ...]:
    values = _listed(row, f"row {number} of y")
    if len(values) != len(names):
        wanted = ", ".join(names)
        raise ValueError(f"row {number} of y has {len(values)} numbers; {len(names)} are accepted: {wanted}.")
    return tuple(of_value(value, f"{name} in row {number}") for name, value in zip(names, values, strict=True))


def _listed(values: Any, name: str) -> list[Any]:
    """A sequence or the first axis of an array as a list, whose numbers keep their types."""
    if isinstance(values, (str, *NO_SEQUENCES)):
        raise TypeError(f"{name} is of type {type(values).__name__}; a sequence or an array is accepted.")
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array, whose elements need not be numbers; an array is accepted.")
    if hasattr(values, "__array__"):
        array = np.asarray(values)
        if array.ndim == 0:
            raise ValueError(f"{name} is a single number; a sequence or an array is accepted.")
        return array.tolist() if array.dtype == np.float64 else list(array)
    if not isinstance(values, Iterable):
        raise TypeError(f"{name} is of type {type(values).__name__}; a sequence or an array is accepted.")
    return list(values)
