"""The errata as a page; docs/errata.md is its Markdown form."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.show.page import Head, Lines, Page, word
from compare.show.text_table import Column, Table, folded, markdown_text
from compare.sources.errata.entries import NOTICED
from compare.sources.errata.evidence import Erratum
from compare.sources.published.source import sources

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from compare.show.page import Block
    from compare.sources.errata.sound import Sound

__all__ = ["FIELDS", "page", "records"]

FIELDS = ("kind", "source", "place", "printed", "right", "check", "touches", "confirmed")
_KINDS = {
    "erratum": "Errata",
    "right": "Held and found right",
    "noticed": "Noticed in the text, without a check",
}
_COLUMNS = (Column("", left=True), Column("entry", left=True))
_SHOWN = ("printed", "right", "check", "touches")
_LATEX_ENTRIES = 6
"""In one table: a page takes no more."""
_LATEX_NEEDS = r"""% needs \usepackage{booktabs}, and \usepackage{fontspec} with \setmainfont{DejaVu Serif}
% compile it with XeLaTeX or LuaLaTeX: φ, √, ∂, ∫ and raised digits stand as they are, and that font has all of them
"""

_HEADER = """\
# Errata of the two sources

The project grew from two documents, and whoever works from them may meet these slips.
Most are slips of the pen that no result rests on, as the last line of each entry says.
Formulas that this project rests on and that are right as printed follow the errata of each source.
An entry's check was run when this page was made: it is one test that the right form passes and the printed form fails.
Near misses, such as a coefficient that is off by one, fail it too, so that it is known to see as much.
Of a formula that is right, the test fails for the same formula with a slip made on purpose.
Most formulas are checked by the very text that is shown, which a program reads.
Slips of words, in which no check could decide anything, are listed last, without one.
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


def page(found: list[dict[str, Any]]) -> Page:
    """The records, then what was noticed; the ``entries`` of the JSON have FIELDS."""
    noticed = _noticed()
    everything = [*found, *noticed]

    def blocks(form: str, width: int) -> Iterator[Block]:
        if form == "markdown":
            yield _HEADER
            yield from _markdown(everything)
        elif form == "latex":
            yield _LATEX_NEEDS
            yield from _tables(everything, width, _LATEX_ENTRIES)
        else:
            yield from _tables(everything, width, len(everything))

    return Page(
        name="errata",
        blocks=blocks,
        data=lambda: {"entries": Lines(found), "noticed": Lines(noticed)},
        sheets=lambda: {"errata": [FIELDS, *([word(one.get(name, "")) for name in FIELDS] for one in everything)]},
    )


def _noticed() -> list[dict[str, Any]]:
    """The remarks, with those of FIELDS that they have."""
    return [
        {"kind": "noticed", "source": one.source, "place": one.place, "printed": one.printed, "right": one.right}
        for one in NOTICED
    ]


def _of(found: list[dict[str, Any]]) -> Iterator[tuple[str, str, str, list[dict[str, Any]]]]:
    """Each source and kind that there is: the short name of the source, its citation, the kind, the records."""
    for name, citation in sources().items():
        for kind in _KINDS:
            if own := [one for one in found if (one["source"], one["kind"]) == (name, kind)]:
                yield name, citation, kind, own


def _count(own: list[dict[str, Any]]) -> str:
    checked = [record["confirmed"] for record in own if "confirmed" in record]
    return f"{sum(checked)} of {len(checked)} entries are confirmed" if checked else f"{len(own)} remarks"


def _markdown(found: list[dict[str, Any]]) -> Iterator[Block]:
    for name, citation, kind, own in _of(found):
        if kind == "erratum":
            yield f"## The {name}\n\n{markdown_text(citation)}: {_count(own)}.\n"
        else:
            yield f"## The {name}: {_KINDS[kind].lower()}\n\n{_count(own)}.\n"
        for record in own:
            yield Head(tuple(f"{field}: {words}" for field, words in _rows(record)), record["place"], level=3)


def _tables(found: list[dict[str, Any]], width: int, size: int) -> Iterator[Table]:
    """A table for each source and kind, or where it has more entries than the size, several."""
    for name, citation, kind, own in _of(found):
        parts = [own[i : i + size] for i in range(0, len(own), size)]
        for number, part in enumerate(parts, start=1):
            rows = [row for record in part for row in (("where", record["place"]), *_rows(record), ("", ""))][:-1]
            which, suffix = (f" ({number} of {len(parts)})", f"-{number}") if len(parts) > 1 else ("", "")
            title = f"{_KINDS[kind]}{which}: {citation}"
            yield Table(f"{kind}-{name}{suffix}", title, (folded(_COLUMNS, rows, width),), _count(own) + ".")


def _rows(record: dict[str, Any]) -> Iterator[tuple[str, str]]:
    return ((field, record[field]) for field in _SHOWN if record.get(field))
