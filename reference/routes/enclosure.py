"""The enclosure: closed forms in Arb's balls, doubled in precision until every ball is decided."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeVar

from flint import arb, ctx

from reference.arithmetic import BALL
from reference.limbs import ziv

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = ["balls", "decide"]

GUARD_BITS = 40
Answer = TypeVar("Answer")


def decide(
    problem: Problem,
    row: str,
    arguments: Sequence[Any],
    of_ball: Callable[[arb], Answer | None],
    of_exact: Callable[[Fraction], Answer],
    bits: int,
) -> list[list[Answer]]:
    """Return for each argument the answers of the row's quantities: ``of_exact`` where rational, else ``of_ball``.

    Raises:
        WorkBoundError: a ball is undecided at the bound on the working precision.
    """
    rational = [problem.exact_row(row, argument) for argument in arguments]
    open_rows = [i for i, known in enumerate(rational) if known is None or None in known]

    def enclose(rows: Sequence[int]) -> Sequence[Sequence[Any]]:
        indices = [open_rows[i] for i in rows]
        balls = problem.closed_form(BALL).rows(row, [arguments[i] for i in indices])
        return [_known(rational[i], found) for i, found in zip(indices, balls, strict=True)]

    def answer(value: Any) -> Answer | None:
        return of_exact(value) if isinstance(value, Fraction) else of_ball(value)

    start = bits + GUARD_BITS + problem.working_bits([arguments[i] for i in open_rows])
    what = f"{row} of {problem!r}"
    decided = ziv(enclose, answer, len(open_rows), start, what, problem.max_bits) if open_rows else []
    answers = dict(zip(open_rows, decided, strict=True))
    return [
        answers[i] if known is None or i in answers else [of_exact(value) for value in known if value is not None]
        for i, known in enumerate(rational)
    ]


def _known(rational: Sequence[Fraction | None] | None, balls: Sequence[arb]) -> Sequence[Any]:
    """The balls of one row, with what is exactly rational in its place."""
    if rational is None:
        return balls
    return [ball if value is None else value for value, ball in zip(rational, balls, strict=True)]


def balls(problem: Problem, row: str, arguments: Sequence[Any], bits: int) -> list[tuple[arb, ...]]:
    """Return the balls of a row at ``bits`` bits of relative accuracy; an exact value is a point."""

    def accurate(ball: arb) -> arb | None:
        return ball if ball.rel_accuracy_bits() >= bits else None

    def point(value: Fraction) -> arb:
        with ctx.workprec(bits + GUARD_BITS):
            return BALL.number(value)

    return [tuple(found) for found in decide(problem, row, arguments, accurate, point, bits)]
