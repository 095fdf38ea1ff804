"""The one place that writes text, Markdown, CSV, LaTeX and JSON: a page of any command in any of them."""

from __future__ import annotations

import csv
import io
import json
import textwrap
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from compare.show import text_table
from compare.show.page import Head, Lines, Sentence, plain
from compare.show.text_table import markdown_text

if TYPE_CHECKING:
    from compare.show.page import Block, Page

__all__ = ["FORMATS", "csv_text", "files", "json_text", "render", "written"]

FORMATS = ("text", "markdown", "csv", "latex", "json")
_SUFFIX = {"text": "txt", "markdown": "md", "latex": "tex", "json": "json"}


def render(page: Page, form: str = "text", width: int = 100) -> str:
    """The page in one of FORMATS; `width` is the longest line of the text form.

    Raises:
        ValueError: the format is not one of FORMATS.
    """
    if form not in FORMATS:
        raise ValueError(f"the format {form!r} is not one of {', '.join(FORMATS)}")
    if form == "json":
        return json_text(page.data(), page.indent)
    if form == "csv":
        return "\n".join(map(csv_text, page.sheets().values()))
    width = page.widths.get(form, width)
    return page.between.get(form, "\n").join(written(block, form, width) for block in page.blocks(form, width))


def files(page: Page, form: str = "text", width: int = 100) -> dict[str, bytes]:
    """What `render` gives, by file name: one file, or for CSV one file a table."""
    if form == "csv":
        return {f"{page.name}-{name}.csv": csv_text(rows).encode() for name, rows in page.sheets().items()}
    return {f"{page.name}.{_SUFFIX[form]}": render(page, form, width).encode()}


def written(block: Block, form: str, width: int = 100) -> str:
    """A block as text, Markdown or LaTeX."""
    if isinstance(block, Sentence):
        return {"text": block.text, "markdown": markdown_text(block.text), "latex": f"% {block.text}"}[form] + "\n"
    if isinstance(block, Head):
        return (
            "\n".join({"text": _head_text, "markdown": _head_markdown, "latex": _head_latex}[form](block, width)) + "\n"
        )
    if isinstance(block, str):
        return block
    return {"text": text_table.text, "markdown": text_table.markdown, "latex": text_table.latex}[form](block)


def _head_text(head: Head, width: int) -> Iterable[str]:
    """Labels and facts as two columns, and sentences that hang by two."""
    indent = max((len(entry[0]) + 2 for entry in head.entries if isinstance(entry, tuple)), default=2)
    for entry in head.entries:
        label, fact = (entry[0].ljust(indent), entry[1]) if isinstance(entry, tuple) else ("", entry)
        yield textwrap.fill(fact, width, initial_indent=label, subsequent_indent=" " * indent)


def _head_markdown(head: Head, _: int) -> Iterable[str]:
    yield f"{'#' * head.level} {markdown_text(head.title)}\n"
    for entry in head.entries:
        yield (
            f"- **{entry[0]}**: {markdown_text(entry[1])}" if isinstance(entry, tuple) else f"- {markdown_text(entry)}"
        )


def _head_latex(head: Head, _: int) -> Iterable[str]:
    for entry in filter(None, (head.needs, *head.entries)):
        yield f"% {': '.join(entry)}" if isinstance(entry, tuple) else f"% {entry}"


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """Rows as CSV: RFC 4180 quoting, lines ended by a newline; what is not known is an empty field."""
    buffer = io.StringIO()
    fields = ([str(value).lower() if isinstance(value, bool) else value for value in row] for row in rows)
    csv.writer(buffer, lineterminator="\n").writerows(fields)
    return buffer.getvalue()


def json_text(value: Any, indent: int = 2) -> str:
    """The value as JSON, floats to the last bit; a number that is not finite is null: JSON has none."""
    return _json(value, "", " " * indent) + "\n"


def _json(value: Any, margin: str, step: str) -> str:
    """A value in a line of this margin; the entries of ``Lines`` have a step more."""
    spread = isinstance(value, Lines)
    entries, inner = (value.entries, margin + step) if spread else (value, margin)
    if not spread and not _has_lines(entries):
        return json.dumps(plain(value), ensure_ascii=False)
    if isinstance(entries, Mapping):
        brackets = "{}"
        items = [f"{_json(str(key), inner, step)}: {_json(item, inner, step)}" for key, item in entries.items()]
    else:
        brackets = "[]"
        items = [_json(item, inner, step) for item in entries]
    if spread and (items or value.opened):
        return "\n".join((brackets[0], ",\n".join(inner + item for item in items), margin + brackets[1]))
    return ", ".join(items).join(brackets)


def _has_lines(value: Any) -> bool:
    """Whether an entry of the value has lines of its own."""
    entries = value.values() if isinstance(value, Mapping) else value if isinstance(value, (list, tuple)) else ()
    return any(isinstance(entry, Lines) for entry in entries)
