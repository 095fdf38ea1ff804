"""The enclosure: closed forms in Arb's balls, or proven flows, doubled in precision until every ball is decided."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from flint import arb

from reference.arithmetic.limbs import ziv
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

    from reference.declaration import Declared, Solution

__all__ = ["GUARD_BITS", "balls", "decide"]

GUARD_BITS = 40
CHART_BITS = 20
"""The same for a chart: one value in a million may stay undecided."""
Answer = TypeVar("Answer")


def decide(
    problem: Declared,
    row: str,
    arguments: Sequence[Any],
    of_ball: Callable[[arb], Answer | None],
    of_exact: Callable[[Fraction], Answer],
    bits: int,
    *,
    charted: bool = False,
    component: int | None = None,
) -> list[list[Answer]]:
    """Return for each argument the answers of the row's quantities: ``of_exact`` where rational, else ``of_ball``.

    With a ``component`` only the answer of that quantity: the others need not be decided.

    Where it is ``charted``, the problem's chart is asked first, if it has one for so many arguments; it is proven too,
    so that only the time depends on it.

    Raises:
        ValueError: an argument is outside of the row's domain.
        WorkBoundError: a ball is undecided at the bound on the working precision.
    """
    arguments = problem.arguments(row, arguments)
    exactly = [problem.exact_row(row, argument) for argument in arguments]
    rational = [None if known is None else _wanted(known, component) for known in exactly]
    pending = [i for i, known in enumerate(rational) if known is None or None in known]
    wanted, guarded = [arguments[i] for i in pending], bits + GUARD_BITS
    problem.working.foresee(row, wanted, guarded)
    start = guarded + problem.working.bits(row, wanted, component)
    bound = min(problem.max_bits, problem.row(row).max_bits)

    def answer(value: Any) -> Answer | None:
        return of_ball(value) if isinstance(value, arb) else of_exact(value)

    def more(tried: int, least: int) -> int:
        return problem.working.more(guarded - least, tried)

    def by(form: Solution, indices: Sequence[int]) -> list[Sequence[Any]]:
        found = form.rows(row, [arguments[i] for i in indices])
        return [_known(rational[i], _wanted(balls, component)) for i, balls in zip(indices, found, strict=True)]

    def enclose(rows: Sequence[int]) -> Sequence[Sequence[Any]]:
        return by(problem.enclosure_form(), [rest[i] for i in rows])

    answers: dict[int, list[Any]] = {}
    with ctx.workprec(start):
        bounded = charted and start <= bound
        chart = problem.chart(row, len(pending), bits + CHART_BITS) if bounded else None
        for i, values in zip(pending, by(chart, pending), strict=True) if chart else ():
            found = [answer(value) for value in values]
            if None not in found:
                answers[i] = found
    rest = [i for i in pending if i not in answers]
    name = row if component is None else problem.row(row).quantities[component].name
    what = f"{name} of {problem!r}"
    proven = ziv(enclose, answer, len(rest), start, what, bound, more) if rest else []
    answers.update(zip(rest, proven, strict=True))
    return [
        answers[i] if known is None or i in answers else [of_exact(value) for value in known if value is not None]
        for i, known in enumerate(rational)
    ]


def _wanted(values: Sequence[Any], component: int | None) -> Sequence[Any]:
    """The values of one row, or the one that is asked for."""
    return values if component is None else [values[component]]


def _known(rational: Sequence[Fraction | None] | None, balls: Sequence[arb]) -> Sequence[Any]:
    """The balls of one row, with what is exactly rational in its place."""
    if rational is None:
        return balls
    return [ball if value is None else value for value, ball in zip(rational, balls, strict=True)]


def balls(problem: Declared, row: str, arguments: Sequence[Any], bits: int) -> list[tuple[arb, ...]]:
    """Return the balls of a row at ``bits`` bits of relative accuracy; an exact value is a point."""

    def accurate(ball: arb) -> arb | None:
        return ball if ball.rel_accuracy_bits() >= bits else None

    def point(value: Fraction) -> arb:
        with ctx.workprec(bits + GUARD_BITS):
            return BALL.number(value)

    return [tuple(found) for found in decide(problem, row, arguments, accurate, point, bits)]
