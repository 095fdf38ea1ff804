"""Whatever is claimed of a function, tried: by what the options of a check say."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.claims.checking import check
from compare.claims.events import check_events
from compare.claims.gradients import check_gradients

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.verdicts import Judged

__all__ = ["tried"]


def tried(function: Callable[..., Any], options: dict[str, Any]) -> Judged:
    """Verdicts on events, on derivatives, or on a step.

    Raises:
        TypeError, ValueError: as ``check``, ``check_events`` and ``check_gradients``.
    """
    given = {name: value for name, value in options.items() if value is not None}
    if "events" in given:
        return check_events(function, given.pop("events"), **given)
    if "gradients" in given:
        return check_gradients(function, given.pop("gradients"), **given)
    return check(function, **given)
