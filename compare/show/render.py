"""A study of any kind as text, Markdown, CSV, LaTeX or JSON: its header, then its tables.

The readable forms (text, Markdown, LaTeX) take finished sections; CSV and JSON are written by `compare.show.machine`.
"""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.show import machine
from compare.show import text_table as grid

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from compare.show.machine import Columns
    from compare.show.text_table import Section

__all__ = ["FORMATS", "Tables", "files", "header", "render"]

FORMATS = ("text", "markdown", "csv", "latex", "json")

_SUFFIX = {"text": "txt", "markdown": "md", "latex": "tex", "json": "json"}
_PAGE_WIDTH = {"markdown": 100, "latex": 72}
_UNITS = {
    "theta0": "rad",
    "omega0": "rad/s",
    "angle": "rad",
    "end": "m",
    "radius": "m",
    "g": "m/s^2",
    "length": "m",
    "t_end": "s",
    "depth": "m",
    "psi_end": "rad",
}


@dataclass(frozen=True)
class Tables:
    """How a kind of study is shown.

    Attributes:
        sections: from a study and the width of a line to its readable tables.
        columns: the fields of its tables for programs.
        prefix: what its files' names have before the problem's.
    """

    sections: Callable[[Any, int], Iterable[Section]]
    columns: Columns
    prefix: str = ""


def render(study: Any, tables: Tables, form: str = "text", width: int = 100) -> str:
    """The study's tables in one of FORMATS; `width` is the longest line of the text form.

    Raises:
        ValueError: the format is not one of FORMATS.
    """
    if form == "json":
        return machine.json_text(study, tables.columns)
    if form == "csv":
        return "\n".join(machine.csv_text(study, tables.columns).values())
    if form not in FORMATS:
        raise ValueError(f"the format {form!r} is not one of {', '.join(FORMATS)}")
    parts = tables.sections(study, _PAGE_WIDTH.get(form, width))
    if form == "markdown":
        bullets = "\n".join(f"- **{name}**: {grid.markdown_text(fact)}" for name, fact in header(study))
        return "\n".join([f"## {study.problem}\n\n{bullets}\n", *map(grid.markdown, parts)])
    if form == "latex":
        facts = (f"{name}: {fact}" for name, fact in header(study))
        comment = "\n".join(f"% {line}" for line in ("needs \\usepackage{booktabs}", *facts))
        return "\n".join([comment + "\n", *map(grid.latex, parts)])
    return "\n\n".join([_header_text(study, width) + "\n", *map(grid.text, parts)])


def files(study: Any, tables: Tables, form: str = "text", width: int = 100) -> dict[str, bytes]:
    """What `render` gives, by file name: one file, or for CSV one file a table."""
    stem = tables.prefix + study.problem
    if form == "csv":
        written = machine.csv_text(study, tables.columns)
        return {f"{stem}-{name}.csv": table.encode() for name, table in written.items()}
    return {f"{stem}.{_SUFFIX[form]}": render(study, tables, form, width).encode()}


def header(study: Any) -> Iterator[tuple[str, str]]:
    """What was computed, against what and by what: names and their facts."""
    values = (f"{name} = {_value(value)} {_UNITS.get(name, '')}".rstrip() for name, value in study.parameters.items())
    yield study.problem, ", ".join(values)
    for name, fact in (*study.reference.items(), *study.engine.items()):
        yield name, _value(fact)


def _header_text(study: Any, width: int) -> str:
    """The header as two columns."""
    facts = list(header(study))
    indent = max(len(name) for name, _ in facts) + 2
    return "\n".join(
        textwrap.fill(fact, width, initial_indent=name.ljust(indent), subsequent_indent=" " * indent)
        for name, fact in facts
    )


def _value(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(f"({_value(item)})" if isinstance(item, (list, tuple)) else _value(item) for item in value)
    if isinstance(value, dict):
        return "; ".join(f"{key}: {_value(item)}" for key, item in value.items())
    return value if isinstance(value, str) else repr(value)
