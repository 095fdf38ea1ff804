"""Whether the error of an integrator that chooses its own steps goes with the tolerance that it is given.

With the error of a step held at the tolerance and the higher order of a pair carried on, the global error is in
proportion to the tolerance; with the lower order q carried on it goes with its power q/(q + 1) (L. F. Shampine,
Numerical Solution of Ordinary Differential Equations, Chapman & Hall 1994, chapter 5).
"""

from __future__ import annotations

import inspect
import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.findings import WIDEST
from compare.claims.frames import MisuseError, nonzero
from compare.claims.verdicts import Verdict
from compare.measure.order_fit import slope_with_interval
from compare.methods.own.forms import role_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.frames import Scene
    from compare.claims.verdicts import Standing

__all__ = ["RTOLS", "judged", "with_tolerance"]

RTOLS = tuple(10.0**-k for k in range(3, 11))
SAMPLES = 4
"""Times of comparison: few, for some solvers take no longer step than from one to the next."""
ROUNDING = 1e-12
"""Errors from here down are rounding."""
LEAST = 4
"""Tolerances, at least, from which a power is told."""
MARGIN = 0.15
"""A power may be so much less than the one that is claimed: errors go with tolerances in steps and leaps."""


def with_tolerance(function: Callable[..., Any], rtol: float, atol: float) -> dict[str, float]:
    """The arguments by name that give an integrator a relative tolerance, and an absolute one if it takes one.

    Raises:
        MisuseError: it takes none.
    """
    parameters = inspect.signature(function).parameters.values()
    roles = {role_of(one.name, ("rtol", "atol")): one.name for one in parameters if one.kind is not one.VAR_KEYWORD}
    if any(one.kind is one.VAR_KEYWORD for one in parameters) and "rtol" not in roles:
        roles |= {"rtol": "rtol", "atol": "atol"}
    if "rtol" not in roles:
        raise MisuseError(
            f"a tolerance is claimed of {getattr(function, '__name__', 'it')}, which takes none; an argument rtol is "
            "accepted."
        )
    given = {"rtol": rtol, "atol": atol}
    return {roles[role]: given[role] for role in ("rtol", "atol") if role in roles}


def judged(with_one: Callable[[float, float], Candidate], scene: Scene, power: float) -> Verdict:
    """On the claim that the error falls with this power of the tolerance, of what ``with_one(rtol, atol)`` gives.

    Both tolerances fall together; that it is the relative one that is used is seen with the absolute one left small.

    Raises:
        MisuseError: one fails.
    """
    words = f"an error that goes with rtol^{power:g}" if power != 1 else "an error in proportion to rtol"
    marches = [_states(with_one(rtol, rtol), scene) for rtol in RTOLS]
    errors = [_error(scene, states) for states in marches]
    told = ", ".join(f"{error:.0e}" for error in errors)
    if all(np.array_equal(states, marches[0]) for states in marches):
        return Verdict.of("tolerance", words, "fails", f"error {errors[0]:.0e} with every rtol", ("it is not used",))
    loose, tight = (_states(with_one(rtol, RTOLS[-1]), scene) for rtol in (RTOLS[0], RTOLS[-1]))
    if np.array_equal(loose, tight):
        told = f"error {_error(scene, loose):.0e} with every rtol where atol = {RTOLS[-1]:g}"
        return Verdict.of("tolerance", words, "fails", told, ("it uses atol alone",))
    bound = next(k for k, states in enumerate(marches) if not np.array_equal(states, marches[0]))
    free = list(zip(RTOLS, errors, strict=True))[bound if bound > 1 else 0 :]
    usable = [(rtol, error) for rtol, error in free if ROUNDING < error < 1]
    if len(usable) < LEAST:
        return Verdict.of("tolerance", words, "open", f"errors {told}: too few between coarse and rounding")
    x, y = (np.log(column) for column in zip(*usable, strict=True))
    value, half = slope_with_interval(x, y)
    largest = max(error / rtol for rtol, error in usable)
    measured = f"measured rtol^({value:.2f} ± {half:.2f}), {largest:.2g} rtol at most"
    return Verdict.of("tolerance", words, _standing(value, half, power), measured, _causes(usable, value))


def _standing(value: float, half: float, power: float) -> Standing:
    if half <= WIDEST and value + max(MARGIN, half) >= power:
        return "holds"
    return "fails" if power - value - half > MARGIN else "open"


def _causes(usable: Sequence[tuple[float, float]], value: float) -> tuple[str, ...]:
    """What explains errors that do not go with the tolerance."""
    last = [error for _, error in usable[-3:]]
    if max(last) < 2 * min(last):
        return (f"its errors stop falling at {min(last):.0e}, as at a limit of steps or another tolerance",)
    return () if math.isfinite(value) else ("they do not fall",)


def _states(candidate: Candidate, scene: Scene) -> np.ndarray:
    grid = np.linspace(0, scene.span, SAMPLES + 1)
    return candidate.states(candidate.field(scene, len(grid)), scene.start, grid)[1:]


def _error(scene: Scene, states: np.ndarray) -> float:
    times = [Fraction(float(t)) for t in np.linspace(0, scene.span, SAMPLES + 1)[1:]]
    errors = scene.errors(times, states)
    with np.errstate(all="ignore"):
        found = float(np.max(np.abs(errors) / nonzero(np.max(np.abs(states - errors), axis=0))))
    return found if math.isfinite(found) else math.inf
