"""The table of results, at the end of the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from _pytest.terminal import TerminalReporter


def pytest_terminal_summary(terminalreporter: TerminalReporter) -> None:
    """A Markdown table of what was claimed and measured."""
    reports: list[Any] = [*terminalreporter.stats.get("passed", []), *terminalreporter.stats.get("failed", [])]
    rows = [row for report in reports for name, row in report.user_properties if name == "row"]
    if rows:
        terminalreporter.section("claims of other packages")
        for row in sorted(map(tuple, rows)):
            terminalreporter.write_line(f"| {' | '.join(row)} |")
