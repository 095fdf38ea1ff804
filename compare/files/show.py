"""Judged rows as a page, and as CSV while they are judged."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

from compare.files.limits import NONE
from compare.show.page import Lines, Page, Sentence, fields_of, in_lines
from compare.show.render import csv_text
from compare.show.text_table import Column, Grid, Table

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from compare.files.limits import Limits
    from compare.files.record import Score
    from compare.files.scales import Point

__all__ = ["ERRORS", "GOOD", "csv_header", "csv_rows", "marked", "named_ulps", "page", "parts_of", "summary_line"]

ERRORS = ("phase_error", "amplitude_error", "energy_error")
GOOD = "No error is larger than what the format must lose: the numbers are as good as it can hold them."
LARGE = 100
"""A number of ulps that is shown with an exponent."""
EXPONENT = re.compile(r"([^eEdDqQ]*)(.*)", re.DOTALL)
"""A mantissa, and what is behind it."""
NOTE = "[ ] holds the first wrong digit of a number; where there is none, every digit is right."


def parts_of(text: str, place: int | None) -> tuple[str, str, str]:
    """A number's right digits, its wrong ones, from that which has this place among its significant digits, from 1, and
    its exponent: joined they are the number.  No digit is wrong where that one is not written, or place is None.
    """
    mantissa, exponent = EXPONENT.fullmatch(text).groups()  # type: ignore[union-attr]
    digits = [i for i, letter in enumerate(mantissa) if letter.isdigit()]
    if place is None or "/" in text or not digits:
        return text, "", ""
    at = _leading(mantissa, digits) + place - 1
    if at >= len(digits):
        return mantissa, "", exponent
    return mantissa[: digits[at]], mantissa[digits[at] :], exponent


def _leading(mantissa: str, digits: Sequence[int]) -> int:
    """Which of the digits, at these places, is the first significant one."""
    return next((n for n, i in enumerate(digits) if mantissa[i] != "0"), len(digits) - 1)


def marked(text: str, place: int | None) -> str:
    """A number with the digit in brackets that has this place among its significant digits, from 1.

    A digit beyond those written is shown: it is the zero that was left out.
    """
    right, wrong, exponent = parts_of(text, place)
    if wrong:
        return f"{right}[{wrong[0]}]{wrong[1:]}{exponent}"
    if place is None or "/" in text:
        return text
    digits = [i for i, letter in enumerate(right) if letter.isdigit()]
    missing = _leading(right, digits) + place - len(digits)
    return f"{right}{'' if '.' in right else '.'}{'0' * (missing - 1)}[0]{exponent}"


def page(score: Score, limits: Limits = NONE) -> Page:
    """The rows that were kept, the summary, and whether limits hold, if there are any."""
    asked = limits != NONE
    told = [summary_line(score), *([limits.sentence(score)] if asked else [])]
    held = {"limits": vars(limits), "holds": limits.holds(score)} if asked else {}
    return Page("score", lambda _form, _width: (_table(score), *map(Sentence, told)), lambda: _data(score, held))


def _table(score: Score) -> Table:
    title = f"{score.problem}: times read {'as the doubles they spell' if score.times == 'binary64' else 'as written'}"
    wide = any(len(value) > 40 for point in score.points for value in point.values)
    columns = [Column("row"), Column("t"), *(Column(name, left=True) for name in score.names)]
    known = not math.isnan(score.max_conditioned_error)
    columns += [
        Column("digits"),
        Column("on scale"),
        Column("error"),
        *([Column("condition ulps")] if known else []),
        *(Column(name.removesuffix("_error"), "error of") for name in ERRORS),
    ]
    rows = tuple(_cells(point, known=known) for point in score.points)
    tables = _split(columns, rows, 2 + len(score.names)) if wide else (Grid(tuple(columns), rows),)
    shown = len(score.points)
    legend = NOTE if shown == score.rows else f"{NOTE} {shown} of {score.rows} rows are shown."
    good = [GOOD] if score.max_conditioned_error <= 1 else []
    return Table("score", title, tables, " ".join((legend, *good, *score.notes)))


def _split(columns: list[Column], rows: tuple[tuple[str, ...], ...], at: int) -> tuple[Grid, ...]:
    """Numbers too long for one line beside their errors: a table of each, by the number of the row."""
    return (
        Grid(tuple(columns[:at]), tuple(row[:at] for row in rows)),
        Grid((columns[0], *columns[at:]), tuple((row[0], *row[at:]) for row in rows)),
    )


def _cells(point: Point, *, known: bool) -> tuple[str, ...]:
    values = map(marked, point.values, point.first_wrong)
    errors = (_size(getattr(point, name)) for name in ERRORS)
    return (
        str(point.number),
        point.t,
        *values,
        f"{point.digits:.1f}",
        f"{point.scaled_digits:.1f}",
        _size(point.error),
        *([named_ulps(point.conditioned)] if known else []),
        *errors,
    )


def _size(error: float) -> str:
    return "-" if math.isnan(error) else f"{error:.1e}"


def named_ulps(error: float) -> str:
    """An error over what the format must lose, as it is shown."""
    return f"{error:.1e}" if error >= LARGE else f"{error:.2g}"


def summary_line(score: Score) -> str:
    """The summary in one line."""
    parts = [
        f"{score.rows} row{'s' if score.rows > 1 else ''}",
        f"worst {score.worst_digits:.1f} correct digits (row {score.worst_row})",
        f"{score.worst_scaled_digits:.1f} on scale (row {score.worst_scaled_row})",
        f"max error {score.max_error:.1e}",
    ]
    for what, value, units in (
        ("phase", score.max_phase_error, " rad"),
        ("amplitude", score.max_amplitude_error, f" {score.units[0]}".removesuffix(" 1")),
        ("energy", score.max_energy_error, ""),
    ):
        parts.append(f"{what} {_size(value)}{units}" if not math.isnan(value) else f"{what} -")
    if score.max_conditioned_row is not None:
        parts.append(f"{named_ulps(score.max_conditioned_error)} condition ulps (row {score.max_conditioned_row})")
    return ", ".join(parts)


def _data(score: Score, held: dict[str, Any]) -> Lines:
    """The fields of the score; "rows" is their number, "points" are those that were kept."""
    fields = fields_of(score, "names", "points")
    of_each = {name: dict(zip(score.names, fields[name], strict=True)) for name in ("units", "scales", "max_errors")}
    points = Lines([_point(point, score.names) for point in score.points])
    return Lines({**in_lines(fields | of_each | held).entries, "points": points})


def _point(point: Point, names: tuple[str, ...]) -> dict[str, Any]:
    return {
        "row": point.number,
        "t": point.t,
        **dict(zip(names, point.values, strict=True)),
        "digits": point.digits,
        "scaled_digits": point.scaled_digits,
        "error": point.error,
        "errors": dict(zip(names, point.errors, strict=True)),
        "first_wrong_digit": dict(zip(names, point.first_wrong, strict=True)),
        **{name: getattr(point, name) for name in ERRORS},
        "conditioned_error": point.conditioned,
    }


def csv_header(names: Iterable[str]) -> str:
    """The first line of the rows as CSV."""
    parts = [f"{name}{suffix}" for suffix in ("_error", "_first_wrong_digit") for name in names]
    return csv_text([["row", "t", *names, "digits", "error", *parts, *ERRORS, "conditioned_error"]])


def csv_rows(points: Iterable[Point]) -> str:
    """Rows as CSV; what is not a number, or a first wrong digit that there is not, is an empty field."""
    return csv_text(
        [
            point.number,
            point.t,
            *point.values,
            point.digits,
            point.error,
            *point.errors,
            *point.first_wrong,
            *(
                None if math.isnan(error) else error
                for error in (*(getattr(point, name) for name in ERRORS), point.conditioned)
            ),
        ]
        for point in points
    )
