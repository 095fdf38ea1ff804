"""What a user asks of a score: so many correct digits on scale at least, and no larger error than so much."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from compare.files.record import Score

__all__ = ["ERROR_FACTOR", "NONE", "Limits"]

ERROR_FACTOR = 3.0
"""By which an error may be larger than an earlier one: half a digit; what last bits change is mostly less."""


@dataclass(frozen=True)
class Limits:
    """Limits of a score; None where there is none.

    The digits are those on scale: relative ones are few wherever a row happens to be close to a zero.

    Attributes:
        min_digits: the fewest correct digits on scale of a row.
        max_error: the largest error of a row.

    Raises:
        ValueError: one is no positive number.
    """

    min_digits: float | None = None
    max_error: float | None = None

    def __post_init__(self) -> None:
        for name, limit in vars(self).items():
            if limit is not None and not _is_positive(limit):
                raise ValueError(f"{name} is {limit!r}; a positive number is accepted.")

    def holds(self, score: Score) -> bool:
        """Whether nothing is missed.

        Raises:
            ValueError: more digits are asked for than the input can hold.
        """
        return not self._missed(score)

    def sentence(self, score: Score) -> str:
        """Which limits hold, or which do not.

        Raises:
            ValueError: more digits are asked for than the input can hold.
        """
        missed = self._missed(score)
        if missed:
            return f"The limits do not hold: {', and '.join(missed)}."
        asked = [] if self.min_digits is None else [f"at least {self.min_digits:g} correct digits on scale"]
        asked += [] if self.max_error is None else [f"no error above {self.max_error:g}"]
        return f"The limits hold: {', and '.join(asked)}."

    def _missed(self, score: Score) -> list[str]:
        found = []
        digits, error = self.min_digits, self.max_error
        if digits is not None:
            if digits > score.digits_held:
                held = _apart(score.digits_held, digits)
                raise ValueError(
                    f"{digits:g} correct digits are asked for, and the numbers hold {held}; at most those are accepted."
                )
            if score.worst_scaled_digits < digits:
                worst = _apart(score.worst_scaled_digits, digits)
                found.append(f"{worst} correct digits on scale in row {score.worst_scaled_row}, fewer than {digits:g}")
        if error is not None and score.max_error > error:
            found.append(f"an error of {_apart(score.max_error, error)}, above {error:g}")
        return found


NONE = Limits()


def _is_positive(limit: Any) -> bool:
    return type(limit) is not bool and isinstance(limit, Real) and 0 < float(limit) < math.inf


def _apart(value: float, limit: float) -> str:
    """The value with as many digits, three at least, as tell it from the limit."""
    texts = [f"{value:.{places}g}" for places in range(3, 18)]
    return next(text for text in texts if float(text) != limit and (float(text) < limit) == (value < limit))
