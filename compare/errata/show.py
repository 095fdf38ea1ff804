"""The errata as text, Markdown, CSV, LaTeX or JSON; the page docs/errata.md is the Markdown form."""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any

from compare import grid
from compare.errata.erratum import Erratum
from compare.grid import Column, Section, folded
from compare.published.source import sources

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from compare.errata.sound import Sound

__all__ = ["FIELDS", "records", "render"]

FIELDS = ("kind", "source", "place", "printed", "right", "check", "touches", "confirmed")
_KINDS = {"erratum": "Errata", "right": "Held and found right"}
_COLUMNS = (Column("", left=True), Column("entry", left=True))
_SHOWN = ("printed", "right", "check", "touches")
_LATEX_WIDTH = 72

_HEADER = """\
# Errata of the two sources

The project grew from two documents, and whoever works from them may meet these slips.
Most are slips of the pen that no result rests on, as the last line of each entry says.
Formulas that this project rests on and that are right as printed follow the errata of each source.
An entry's check was run when this page was made: it is one test that the right form passes and the printed form fails.
Of a formula that is right, the test fails for the same formula with a slip made on purpose.
The same tests run with the test-suite, so that an entry which were none would not stay.
The sources were read as text taken from their PDF files.
The page is what this command prints with `--format markdown`:

```
python -m compare errata
```
"""


def records(entries: Iterable[Erratum | Sound]) -> list[dict[str, Any]]:
    """Each entry by FIELDS, its check run now; of a formula found right, ``right`` and ``touches`` are empty."""
    return [
        {
            "kind": "erratum" if isinstance(one, Erratum) else "right",
            "source": one.source,
            "place": one.place,
            "printed": one.printed,
            "right": one.right if isinstance(one, Erratum) else "",
            "check": one.how,
            "touches": one.touches if isinstance(one, Erratum) else "",
            "confirmed": one.confirmed(),
        }
        for one in entries
    ]


def render(found: list[dict[str, Any]], form: str = "text", width: int = 100) -> str:
    """The records in one of the table formats; JSON is an object whose ``entries`` have FIELDS."""
    if form == "json":
        lines = ",\n  ".join(json.dumps(record, ensure_ascii=False) for record in found)
        return f'{{"entries": [\n  {lines}\n]}}\n'
    if form == "csv":
        buffer = io.StringIO()
        writer = csv.DictWriter(buffer, FIELDS, lineterminator="\n")
        writer.writeheader()
        writer.writerows({**record, "confirmed": "yes" if record["confirmed"] else "no"} for record in found)
        return buffer.getvalue()
    if form == "markdown":
        return "\n".join([_HEADER, *_markdown(found)])
    lay_out = {"text": grid.text, "latex": grid.latex}[form]
    return "\n".join(map(lay_out, _sections(found, _LATEX_WIDTH if form == "latex" else width)))


def _of(found: list[dict[str, Any]]) -> Iterator[tuple[str, str, str, list[dict[str, Any]]]]:
    """Each source and kind: the short name of the source, its citation, the kind, the records."""
    for name, citation in sources().items():
        for kind in _KINDS:
            yield name, citation, kind, [one for one in found if (one["source"], one["kind"]) == (name, kind)]


def _count(own: list[dict[str, Any]]) -> str:
    return f"{sum(record['confirmed'] for record in own)} of {len(own)} entries are confirmed"


def _markdown(found: list[dict[str, Any]]) -> Iterator[str]:
    for name, citation, kind, own in _of(found):
        if kind == "erratum":
            yield f"## The {name}\n\n{grid.markdown_text(citation)}: {_count(own)}.\n"
        else:
            yield f"## The {name}: held and found right\n\n{_count(own)}.\n"
        for record in own:
            lines = "\n".join(f"- {field}: {grid.markdown_text(words)}" for field, words in _rows(record))
            yield f"### {record['place']}\n\n{lines}\n"


def _sections(found: list[dict[str, Any]], width: int) -> Iterator[Section]:
    for name, citation, kind, own in _of(found):
        rows = [row for record in own for row in (("where", record["place"]), *_rows(record), ("", ""))][:-1]
        title = f"{_KINDS[kind]}: {citation}"
        yield Section(f"{kind}-{name}", title, (folded(_COLUMNS, rows, width),), _count(own) + ".")


def _rows(record: dict[str, Any]) -> Iterator[tuple[str, str]]:
    return ((field, record[field]) for field in _SHOWN if record[field])
