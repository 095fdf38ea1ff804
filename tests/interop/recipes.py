"""Every example of docs/interop.md, run as it is printed; ``make interop`` names this file, for pytest finds it not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "interop.md").read_text(encoding="utf-8")
EXAMPLES = [
    (match.start(), f"{re.findall(r'^## (.*)$', PAGE[: match.start()], re.MULTILINE)[-1]}", match[1])
    for match in re.finditer(r"```python\n(.*?)```", PAGE, re.DOTALL)
]


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize(("code", "heading"), [(code, heading) for _, heading, code in EXAMPLES])
def test_an_example_holds_its_claims(code: str, heading: str) -> None:
    exec(compile(code, f"docs/interop.md, {heading}", "exec"), {"__name__": heading})  # noqa: S102 - it is ours
