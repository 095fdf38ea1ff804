"""Judged rows as a page of HTML: each number as it was handed in, its wrong digits marked, and the exact one beside."""

from __future__ import annotations

import math
from html import escape
from typing import TYPE_CHECKING

from compare.files.limits import NONE, Limits
from compare.files.show import ERRORS, GOOD, named_ulps, parts_of, summary_line
from compare.show.html import document, element
from reference.arithmetic.limbs import decimal, exact_decimal, interval
from reference.names import printable
from reference.routes import enclosure

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.files.record import Score
    from compare.files.scales import Point
    from reference.problem import Problem

__all__ = ["exact_states", "page"]

MORE = 3
"""Digits that the exact numbers have beyond those that the input holds."""
LEAST = 6
"""Digits that they have at least."""
LEGEND = (
    "A marked digit, in brackets and underlined, is wrong, as are those behind it: half a unit of it is less than the "
    "error.  Where none is marked, every digit is right.  The exact number is proven, and rounded correctly to the "
    "digits that are shown."
)
ULPS = (
    "An error in condition ulps is over what the format must lose: a roundoff of the number, and of time, start and "
    "parameters as far as they lead it.  Up to about 1 the number is as good as its format can hold it."
)


def exact_states(problem: Problem, score: Score) -> list[list[str]]:
    """The proven decimals of the states at the times of the rows that are shown."""
    count = max(math.ceil(score.digits_held) + MORE, LEAST)
    return enclosure.decide(
        problem,
        "state",
        [point.instant for point in score.points],
        lambda ball: decimal(interval(ball), count),
        lambda value: exact_decimal(value, count),
        math.ceil(count * math.log2(10)),
    )


def page(score: Score, exact: Sequence[Sequence[str]], file: str, asked: Limits = NONE) -> str:
    """The page; ``exact`` has the numbers of ``exact_states``."""
    title = f"{'Standard input' if file == '-' else printable(file)} against the proven truth"
    return document(title, _parts(score, exact, asked))


def _parts(score: Score, exact: Sequence[Sequence[str]], asked: Limits) -> Iterator[str]:
    yield element("p", element("code", escape(score.problem)) + f", times read {_times(score)}.")
    yield element("h2", "Summary")
    yield element("p", escape(summary_line(score)) + ".")
    if asked != NONE:
        yield element("p", escape(asked.sentence(score)))
    notes = [*([GOOD] if score.max_conditioned_error <= 1 else []), *score.notes]
    if notes:
        yield element("h2", "Notes")
        yield element("ul", "\n".join(element("li", escape(note)) for note in notes))
    yield element("h2", "Rows")
    yield element("p", escape(LEGEND))
    if _known(score):
        yield element("p", escape(ULPS))
    yield element("div", _table(score, exact), class_="wide", role="region", aria_labelledby="rows", tabindex="0")
    yield element("h2", "Scales and largest errors")
    yield element("dl", "\n".join(_limits(score)))


def _times(score: Score) -> str:
    return "as the doubles they spell" if score.times == "binary64" else "as written"


def _known(score: Score) -> bool:
    return score.max_conditioned_row is not None


def _table(score: Score, exact: Sequence[Sequence[str]]) -> str:
    shown = len(score.points)
    which = (
        "All rows" if shown == score.rows else f"{shown} of {score.rows} rows: an even choice, the worst and the last"
    )
    head = ["row", "t", *(part for name in score.names for part in (name, f"{name}, exact")), "digits", "on scale"]
    head += ["error", *(["condition ulps"] if _known(score) else [])]
    head += [f"error of {name.removesuffix('_error')}" for name in ERRORS]
    cells = "".join(element("th", escape(label), scope="col") for label in head)
    rows = "\n".join(
        _row(point, numbers, known=_known(score)) for point, numbers in zip(score.points, exact, strict=True)
    )
    return "\n".join(
        [
            "<table>",
            element("caption", f"{which}.", id="rows"),
            element("thead", element("tr", cells)),
            element("tbody", f"\n{rows}\n"),
            "</table>",
        ]
    )


def _row(point: Point, exact: Sequence[str], *, known: bool) -> str:
    cells = [element("th", str(point.number), scope="row"), element("td", element("code", escape(point.t)))]
    for text, place, true in zip(point.values, point.first_wrong, exact, strict=True):
        cells.append(element("td", _number(text, place), class_="number"))
        cells.append(element("td", element("code", escape(true)), class_="number exact"))
    sizes = [f"{point.digits:.1f}", f"{point.scaled_digits:.1f}", f"{point.error:.1e}"]
    sizes += [named_ulps(point.conditioned)] if known else []
    errors = [getattr(point, name) for name in ERRORS]
    sizes += ["-" if math.isnan(error) else f"{error:.1e}" for error in errors]
    return element("tr", "".join([*cells, *(element("td", escape(size)) for size in sizes)]))


def _number(text: str, place: int | None) -> str:
    """A number as it was handed in, its wrong digits marked, and for who does not see the mark, in words."""
    right, wrong, rest = parts_of(text, place)
    marked = element("mark", escape(wrong)) if wrong else ""
    told = element("code", escape(right) + marked + escape(rest))
    if place is None:
        return told
    unwritten = "" if wrong else "not written, "
    words = element("span", f" (wrong from its digit {place} on)", class_="unseen")
    return told + (words if wrong else f" <small>(digit {place}, {unwritten}is wrong)</small>")


def _limits(score: Score) -> Iterator[str]:
    facts = [("digits that the input can hold", f"{score.digits_held:.1f}")]
    for name, unit, scale, error in zip(score.names, score.units, score.scales, score.max_errors, strict=True):
        units = "" if unit == "1" else f" {unit}"
        facts.append((f"scale of {name}", f"{scale:.6g}{units}"))
        facts.append((f"largest error of {name}", f"{error:.2e}{units}"))
    for fact, value in facts:
        yield element("dt", escape(fact)) + element("dd", escape(value))
