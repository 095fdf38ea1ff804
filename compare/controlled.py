"""What is asked of embedded pairs with a controlled step: pairs and controllers by name, and tolerances."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from compare.march import controllers as step_controllers
from compare.march.adaptive import MOST_ATTEMPTS, is_pair
from compare.measure.adaptive import Controlled, Tolerated
from compare.methods import METHODS
from compare.scored import ALL, named, score_all, some
from reference.arithmetic.exact import as_number, exact, positive

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.measure.records import AdaptiveCell
    from compare.methods.kinds.protocol import Method
    from reference.problem import Problem

__all__ = ["DEFAULT_RTOL", "OPTIONS", "controlled", "error_vs_rtol", "tolerances"]

DEFAULT_RTOL = tuple(float(f"1e-{k}") for k in range(3, 12))
OPTIONS = ("adaptive", "controllers", "rtol", "atol", "max_attempts")
"""The arguments of ``controlled``, which a study takes by these names."""
TINY = sys.float_info.min


def error_vs_rtol(
    problem: Problem,
    pairs: Sequence[str | Method],
    controllers: Sequence[str] = step_controllers.DEFAULT,
    rtol: Sequence[float] = DEFAULT_RTOL,
    atol: Sequence[float] | float | None = None,
    *,
    max_attempts: int = MOST_ATTEMPTS,
    **options: Any,
) -> tuple[AdaptiveCell, ...]:
    """Return the error and the work of embedded pairs with a controlled step at each tolerance.

    The arguments are those of ``controlled``, and options of ``compare.scored.score_all``.

    Raises:
        ValueError, TypeError: as these two.
    """
    asked = controlled(pairs, controllers, rtol, atol, max_attempts)
    return score_all([problem], (), **options, controlled=asked).adaptive or ()


def controlled(
    adaptive: Sequence[str | Method],
    controllers: Sequence[str] = step_controllers.DEFAULT,
    rtol: Sequence[float] = DEFAULT_RTOL,
    atol: Sequence[float] | float | None = None,
    max_attempts: int = MOST_ATTEMPTS,
) -> Controlled:
    """What is asked of pairs with a controlled step.

    Args:
        adaptive: embedded pairs by name, or "all" for every one, or the methods themselves.
        controllers: names of ``compare.march.controllers.CONTROLLERS``.
        rtol: relative tolerances, each in (0, 1).
        atol: one absolute tolerance for all, or one for each of the relative ones in their order; the same if None.
        max_attempts: at a step; a march that takes more is lost.

    Raises:
        ValueError: a name is unknown, a method has no embedded result, or a tolerance is outside its range.
        TypeError: an argument is of the wrong kind.
    """
    listed = some(adaptive, "adaptive")
    every = any(isinstance(one, str) and one.strip().lower() == ALL for one in listed)
    pairs: list[Any] = []
    for method in named(listed):
        if is_pair(method):
            pairs.append(method)
        elif not every:
            known = next(one.name for one in METHODS if is_pair(one))
            raise ValueError(f"{method.name} has no embedded result to estimate an error by; {known} has one.")
    chosen = step_controllers.controllers(some(controllers, "controllers"))
    both = _with_absolute(rtol, atol)
    asked = tuple(Tolerated(one, *tolerance) for one in chosen for tolerance in both)
    return Controlled(tuple(pairs), asked, positive(max_attempts, "max_attempts"))


def _with_absolute(rtol: Sequence[float], atol: Sequence[float] | float | None) -> list[tuple[Fraction, Fraction]]:
    """The relative tolerances, each once, the loosest first, with the absolute one of each."""
    tolerances(rtol)
    relative = [exact(value, "rtol") for value in rtol]
    listed = list(atol) if isinstance(atol, (list, tuple)) else [atol] * len(relative)
    if len(listed) not in {1, len(relative)}:
        raise ValueError(f"atol has {len(listed)} numbers for {len(relative)} of rtol; one, or as many, is accepted.")
    listed *= len(relative) if len(listed) == 1 else 1
    absolute = [of if value is None else exact(value, "atol") for value, of in zip(listed, relative, strict=True)]
    for value in absolute:
        if value < TINY:
            raise ValueError(f"atol is {as_number(value)}; a positive number is accepted.")
    return sorted(dict(zip(relative, absolute, strict=True)).items(), reverse=True)


def tolerances(rtol: Sequence[float]) -> list[float]:
    """The tolerances, each once, from the loosest to the tightest.

    Raises:
        ValueError: one is not in (0, 1), or there is none.
        TypeError: ``rtol`` is no sequence.
    """
    asked = {exact(value, "rtol") for value in some(rtol, "rtol")}
    for tolerance in asked:
        if not TINY <= tolerance < 1:
            raise ValueError(f"rtol is {as_number(tolerance)}; a number with 0 < rtol < 1 is accepted.")
    return sorted(map(float, asked), reverse=True)
