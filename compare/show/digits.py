"""How tables of methods over numbers of steps are laid out: what fits a line, and how numbers are spelt."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any

from compare.measure.records import FLOOR_FACTOR
from compare.show import text_table
from compare.show.text_table import Column, Grid

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

__all__ = [
    "DOUBT",
    "NOTES",
    "ROUNDING",
    "by_steps",
    "decided",
    "digits",
    "is_rounding",
    "legend",
    "methods_of",
    "of_steps",
    "representative",
    "scientific",
    "split",
    "starred",
    "steps_of",
]

DOUBT = "~"
"""Before a digit that rounding may change."""
ROUNDING = "*"
"""Behind a number of which rounding may have made half or more."""
NOTES = {
    ROUNDING: f"{ROUNDING} means rounding, which may have made half of the number or more",
    DOUBT: f"{DOUBT} means that rounding may change the digit; others that it may are not printed",
}


def methods_of(records: Iterable[Any]) -> list[str]:
    """The methods in their order."""
    return list(dict.fromkeys(record.method for record in records))


def steps_of(records: Iterable[Any]) -> dict[int, float]:
    """The step size at each N, in increasing N."""
    return dict(sorted({record.n: record.h for record in records}.items()))


def by_steps(
    records: Sequence[Any],
    declared: dict[str, int],
    width: int,
    cells: Callable[[Any], Sequence[str]],
    labels: Sequence[Column] | None = None,
) -> tuple[Grid, ...]:
    """A row for each N; for each method a column, or a group of columns with the labels.

    ``cells`` gives what a record is shown as; methods are grouped by declared order so as to fit the width.
    """
    found = {(record.method, record.n): record for record in records}
    steps, unit = steps_of(records), records[0].case.step

    def build(methods: Sequence[str]) -> Grid:
        columns = [Column("N"), Column(f"h [{unit}]" if unit else "h")]
        rows = [[str(n), scientific(h)] for n, h in steps.items()]
        for method in methods:
            own = [Column(method)] if labels is None else [Column(one.label, method, one.left) for one in labels]
            columns += own
            for row, n in zip(rows, steps, strict=True):
                record = found.get((method, n))
                row.extend([""] * len(own) if record is None else cells(record))
        return Grid(tuple(columns), tuple(map(tuple, rows)))

    return split(build, methods_of(records), declared, width)


def of_steps(
    records: Sequence[Any],
    declared: dict[str, int],
    width: int,
    labels: Sequence[str],
    cells: Callable[[Any], Sequence[str]],
) -> Grid:
    """A row for each method; for a few values of N that tell the most a group of columns with the labels."""
    found = {(record.method, record.n): record for record in records}
    methods = sorted(methods_of(records), key=lambda method: declared.get(method, 0))

    def build(chosen: Sequence[int]) -> Grid:
        columns = [Column("method", left=True)]
        rows = [[method] for method in methods]
        for n in chosen:
            columns += [Column(label, f"N = {n}") for label in labels]
            for row, method in zip(rows, methods, strict=True):
                record = found.get((method, n))
                row.extend([""] * len(labels) if record is None else cells(record))
        return Grid(tuple(columns), tuple(map(tuple, rows)))

    return build(representative(list(steps_of(records)), lambda steps: text_table.text_width(build(steps)) <= width))


def split(
    build: Callable[[Sequence[str]], Grid], methods: Sequence[str], declared: dict[str, int], width: int
) -> tuple[Grid, ...]:
    """Grids no wider than the width; methods of one order stay together where they fit, and orders share a grid."""

    def fits(names: Sequence[str]) -> bool:
        return len(names) <= 1 or text_table.text_width(build(names)) <= width

    groups: list[list[str]] = []
    for order in sorted({declared.get(method, 0) for method in methods}):
        members = [method for method in methods if declared.get(method, 0) == order]
        if groups and fits([*groups[-1], *members]):
            groups[-1].extend(members)
            continue
        parts = next(parts for parts in range(1, len(members) + 1) if all(map(fits, _even(members, parts))))
        groups.extend(_even(members, parts))
    return tuple(map(build, groups))


def _even(names: Sequence[str], parts: int) -> list[list[str]]:
    """The names in consecutive parts whose lengths differ by one at most, longer ones first."""
    size, longer = divmod(len(names), parts)
    starts = [i * size + min(i, longer) for i in range(parts + 1)]
    return [list(names[start:stop]) for start, stop in itertools.pairwise(starts)]


def representative(steps: Sequence[int], fits: Callable[[Sequence[int]], bool]) -> Sequence[int]:
    """As many values of N, spread evenly over the inside of the range, as fit; at least one, at most three."""
    for count in (3, 2):
        places = [round((i + 1) * (len(steps) - 1) / (count + 1)) for i in range(count)]
        chosen = [steps[place] for place in dict.fromkeys(places)] if steps else []
        if len(chosen) == count and fits(chosen):
            return chosen
    return steps[len(steps) // 2 :][:1]


def scientific(value: float, rounding: float = 0.0) -> str:
    """Three digits and an exponent; fewer where rounding may change them."""
    return decided(value, rounding, (".2e", ".1e", ".0e"))


def decided(value: float, rounding: float, forms: Sequence[str]) -> str:
    """A number in the first of the forms in which nothing that rounding may have made of it reads otherwise.

    So a table reads the same wherever it is made.  In the last form, where that does too, it is marked with DOUBT.
    """
    if not math.isfinite(value):
        return str(value)
    if math.isinf(rounding):
        return DOUBT + format(value, forms[-1])
    off = 0.0 if math.isnan(rounding) else rounding
    same = (form for form in forms if format(value - off, form) == format(value + off, form))
    form = next(same, None)
    return DOUBT + format(value, forms[-1]) if form is None else format(value, form)


def starred(value: float, rounding: float) -> str:
    """``scientific``, with a mark where rounding decides."""
    return f"{value:.0e}{ROUNDING}" if is_rounding(value, rounding) else scientific(value, rounding)


def is_rounding(value: float, rounding: float) -> bool:
    """Whether rounding may have made half of a number or more; a zero that nothing bounds is a zero."""
    return bool(abs(value) <= FLOOR_FACTOR * rounding and rounding > 0)


def legend(grids: Iterable[Grid], *others: str) -> str:
    """What the marks in the cells mean, a line each, and other notes that are not empty."""
    cells = [cell for grid in grids for row in grid.rows for cell in row]
    return "\n".join(
        [*(note for mark, note in NOTES.items() if any(mark in cell for cell in cells)), *filter(None, others)]
    )


def digits(value: float, form: str) -> str:
    """A number in a form, or the word for one that is not finite."""
    return format(value, form) if math.isfinite(value) else str(value)
