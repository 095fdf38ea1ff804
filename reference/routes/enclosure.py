"""The enclosure: closed forms in Arb's balls, doubled in precision until every ball is decided."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from flint import arb, ctx

from reference.arithmetic import BALL
from reference.limbs import ziv

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

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
    answers: dict[int, list[Answer]] = {}
    for i, argument in enumerate(arguments):
        exact = problem.exact_row(row, argument)
        if exact is not None:
            answers[i] = [of_exact(value) for value in exact]
    open_rows = [i for i in range(len(arguments)) if i not in answers]

    def enclose(rows: Sequence[int]) -> Sequence[Sequence[arb]]:
        return problem.closed_form(BALL).rows(row, [arguments[open_rows[i]] for i in rows])

    start = bits + GUARD_BITS + problem.working_bits([arguments[i] for i in open_rows])
    what = f"{row} of {problem!r}"
    decided = ziv(enclose, of_ball, len(open_rows), start, what) if open_rows else []
    answers.update(zip(open_rows, decided, strict=True))
    return [answers[i] for i in range(len(arguments))]


def balls(problem: Problem, row: str, arguments: Sequence[Any], bits: int) -> list[tuple[arb, ...]]:
    """Return the balls of a row at ``bits`` bits of relative accuracy; an exact value is a point."""

    def accurate(ball: arb) -> arb | None:
        return ball if ball.rel_accuracy_bits() >= bits else None

    def point(value: Fraction) -> arb:
        with ctx.workprec(bits + GUARD_BITS):
            return BALL.number(value)

    return [tuple(found) for found in decide(problem, row, arguments, accurate, point, bits)]
