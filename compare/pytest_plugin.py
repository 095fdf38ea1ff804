"""The pytest plugin: a fixture that judges integrators in one's own tests, and a section with all of its verdicts.

    def test_my_method(horologium):
        horologium.check(my_package.rk4, order=4)

    @pytest.mark.horologium(problem=reference.Pendulum(2), seconds=20)
    def test_it_elsewhere(horologium):
        horologium.check(my_package.verlet, order=2, symplectic=True)

A claim that fails or is not established fails the test.  The marker gives what each check of a test, of a class or of a
module takes beside: any argument of ``compare.check`` but the step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.record import Check

__all__ = ["Judge", "horologium", "pytest_configure", "pytest_terminal_summary"]

NAME = "horologium"
PROPERTY = "horologium"
"""Under this name they travel with a report, also from another process."""


class Judge:
    """Checks of one test."""

    def __init__(self, how: dict[str, Any], record: Callable[[str, object], None]) -> None:
        self._how, self._record = how, record

    def check(self, step: Callable[..., Any], **claims: Any) -> Check:
        """Return ``compare.check`` of a step, with what the marker gives; its verdicts are told at the end of the run.

        Raises:
            AssertionError: a claim fails or is not established.
            TypeError, ValueError: as ``compare.check``; nothing is claimed.
        """
        from compare.claims.checking import check

        found = check(step, **{**self._how, **claims})
        for one in found.verdicts:
            self._record(PROPERTY, f"{one.standing}  {found.name}: {one.words}, {one.measured}")
        found.assert_holds()
        return found


@pytest.fixture
def horologium(request: pytest.FixtureRequest, record_property: Callable[[str, object], None]) -> Judge:
    """The judge of integrators, with what the markers ``horologium`` give, the nearest first."""
    how: dict[str, Any] = {}
    for marker in request.node.iter_markers(NAME):
        how = {**marker.kwargs, **how}
    return Judge(how, record_property)


def pytest_configure(config: pytest.Config) -> None:
    """Declare the marker."""
    config.addinivalue_line("markers", f"{NAME}(**how): what each check of the fixture takes beside its claims")


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """All verdicts, those first that are no PASS."""
    reports = [report for several in terminalreporter.stats.values() for report in several]
    told = [
        (str(value), report.nodeid)
        for report in reports
        if getattr(report, "when", None) == "call"
        for name, value in report.user_properties
        if name == PROPERTY
    ]
    if not told:
        return
    terminalreporter.section(NAME)
    for line, where in sorted(told, key=lambda one: one[0].startswith("PASS")):
        terminalreporter.line(f"{line}  [{where}]")
