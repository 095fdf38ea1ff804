"""A page of HTML that stands alone: no script, and nothing from elsewhere.

It is read in light and in dark; what colour tells is told without it too.
"""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["document", "element"]

STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --paper: #ffffff; --line: #c4c4c4; --head: #f1f1f1; --wrong: #a00000;
  --tint: #ffe3e0; --faint: #555555; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e8e8; --paper: #161616; --line: #484848; --head: #242424;
  --wrong: #ffb4ab; --tint: #4a1c18; --faint: #a8a8a8; } }
body { margin: 0 auto; padding: 1rem 1.5rem 3rem; max-width: 90rem; color: var(--ink); background: var(--paper);
  font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.4rem; } h2 { font-size: 1.1rem; margin-top: 2rem; }
p, li { max-width: 46rem; }
dl { display: grid; grid-template-columns: max-content auto; gap: 0.1rem 1.5rem; }
dt { color: var(--faint); } dd { margin: 0; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding-bottom: 0.5rem; }
th, td { padding: 0.15rem 0.6rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
thead th { background: var(--head); vertical-align: bottom; }
td.number { text-align: left; }
code { font-family: ui-monospace, monospace; font-size: 0.95em; }
mark { color: var(--wrong); background: var(--tint); font-weight: bold; text-decoration: underline; }
mark::before { content: "["; } mark::after { content: "]"; }
.exact { color: var(--faint); }
.unseen { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
"""


def element(name: str, content: str, **attributes: str) -> str:
    """An element around content that is HTML; a trailing underline of an attribute's name is left out."""
    told = "".join(f' {key.rstrip("_").replace("_", "-")}="{escape(value)}"' for key, value in attributes.items())
    return f"<{name}{told}>{content}</{name}>"


def document(title: str, parts: Iterable[str]) -> str:
    """The page of these parts, which are HTML; the title is text."""
    return "\n".join(
        [
            "<!DOCTYPE html>",
            '<html lang="en">',
            "<head>",
            '<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            element("title", escape(title)),
            element("style", STYLE),
            "</head>",
            "<body>",
            "<main>",
            element("h1", escape(title)),
            *parts,
            "</main>",
            "</body>",
            "</html>",
            "",
        ]
    )
