"""The events of a pendulum: when it hangs at the bottom, and when it turns back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.limbs import ziv
from reference.arithmetic.namespaces import BALL
from reference.problems.pendulum.simple import DECISION_BITS
from reference.problems.pendulum.taylor import per_period

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from flint import arb

    from reference.certified import Certified
    from reference.problems.pendulum.simple import SimplePendulum

__all__ = ["MAX_EVENTS", "Events", "events"]

MAX_EVENTS = 100_000


@dataclass(frozen=True)
class Events:
    """Proven times in s: where the pendulum hangs at the bottom, and where it turns back, after the start."""

    zero_crossings: tuple[Certified, ...]
    turning_points: tuple[Certified, ...]


def events(problem: SimplePendulum, until: Any) -> Events:
    """The passages through the bottom and the turning points in (0, until].

    Raises:
        ValueError: ``until`` is negative or not finite, or the events before it are more than MAX_EVENTS.
    """
    end = exact(until, "until")
    if end < 0:
        raise ValueError(f"until is {as_number(end)}; a time that is not negative is accepted.")
    return Events(*(_of_row(problem, row, end) for row in ("zero_crossing", "turning_point")))


def _of_row(problem: SimplePendulum, row: str, end: Fraction) -> tuple[Certified, ...]:
    if end == 0 or not problem.serves(row):
        return ()
    count = _count(problem, row, end)
    if count > MAX_EVENTS:
        raise ValueError(
            f"until is {as_number(end)}, with {count} events before it; at most {MAX_EVENTS} are accepted."
        )
    return tuple(problem.certified(row, j) for j in range(count))


def _count(problem: SimplePendulum, row: str, end: Fraction) -> int:
    """Events of one kind up to a time, decided in balls: they are a period apart, in libration half of one."""
    apart = per_period(problem)

    def after_the_first(_rows: Sequence[int]) -> list[list[arb]]:
        form: Any = problem.closed_form(BALL)
        return [[BALL.floor((BALL.number(end) - getattr(form, row)(0)) * apart / form.period)]]

    def certain(ball: arb) -> arb | None:
        return ball if ball.is_finite() else None

    bits = DECISION_BITS + problem.working_bits([end])
    found = ziv(after_the_first, certain, 1, bits, f"the number of events of {problem!r}")
    return max(0, 1 + int(found[0][0].unique_fmpz()))
