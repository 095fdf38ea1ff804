"""What a step gives beside the new state: states between, and an estimate of its error.

From an exact state an interpolant of order q errs by O(h^(q+1)) anywhere in a step; with a method of order p its states
between are of order min(p, q) then (E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I,
Springer 1993, section II.6).  An embedded method of order q differs from one of higher order by C h^(q+1) + O(h^(q+2)),
which is its local error (the same, section II.4).
"""

from __future__ import annotations

import inspect
import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.candidate import Candidate
from compare.claims.engine import Lanes
from compare.claims.findings import ORDER_MARGIN, WIDEST, reaches
from compare.claims.frames import MisuseError
from compare.claims.order import Cell, Order, fitted
from compare.claims.points import Points
from compare.claims.verdicts import Verdict
from compare.methods.own.forms import form_of
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.frames import Scene
    from compare.claims.verdicts import Standing

__all__ = ["dense", "estimate", "new_state"]

LONGEST = 8
"""The longest step over h, where the motion does not end before."""
COUNTS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
"""Parts of it that are tried."""
EPSILON = 2.0**-52
ROUNDED, FALLS = 1e-11, 0.8
"""From an error below the first with a slope below so much of the steepest before, all is rounding: of coefficients,
or of states."""
PLACES = (0.21, 0.47, 0.83)
"""Parts of a step at which it is tried: no zeros of usual error polynomials."""
PLACE = "theta s sigma part fraction place c"
"""What the part of a step is often called; the last of them is, where a state is called so too."""
MET, NEAR_END = 1e-10, 1e-4
"""An end is met to so much; a slope is taken over so much of a step."""
VANISHING = 1e-2
"""A slope of so much of f is none."""
SAME = 0.2
"""An estimate that differs by no more of itself from the error is the error."""


def dense(candidate: Candidate, scene: Scene, h: float, interpolant: Callable[..., Any], claim: float) -> Verdict:
    """On the claim that an interpolant (f, y, h, theta) of a step is of an order.

    Raises:
        MisuseError: it fails, or gives no finite state.
        ValueError: its arguments are not those of a step and theta.
    """
    between = _Between(interpolant)
    points = Points(candidate, scene, h)
    made = {place: Lanes(between.at(place), scene) for place in (0.0, *PLACES, 1 - NEAR_END, 1.0)}
    span = min(LONGEST * h, scene.end / 4)

    def error(step: float) -> float:
        return max(points.error(points.after(step, made[place]), place * step) for place in PLACES)

    found = _local_order(error, span)
    standing, measured = _at_least(found, claim)
    causes = []
    if _gap(points, points.after(h, made[1.0]), points.after(h)) > MET:
        causes.append("at the end of a step it is not the new state")
    if _gap(points, points.after(h, made[0.0]), points.y) > MET:
        causes.append("at the beginning of a step it is not the old state")
    last, end = points.after(h, made[1 - NEAR_END]), points.after(h, made[1.0])
    f = np.array([scene.rates(NUMPY, t + h, tuple(one)) for t, one in zip(points.times, end, strict=True)])
    if np.max(np.abs((end - last) / (NEAR_END * h))) <= VANISHING * np.max(np.abs(f)):
        causes.append("its slope at the end of a step is zero, as where f was not evaluated there")
    if causes and standing == "holds":
        standing = "fails"
    return Verdict.of("dense", f"dense output of order {claim:g}", standing, measured, tuple(causes))


def _gap(points: Points, one: np.ndarray, other: np.ndarray) -> float:
    return float(np.max(np.abs(one - other) / points.sizes))


class _Between:
    """An interpolant, as a step for each part of one."""

    def __init__(self, function: Callable[..., Any]) -> None:
        if not callable(function):
            raise TypeError(f"the interpolant is of type {type(function).__name__}; a function is accepted.")
        self._function = function
        names = list(inspect.signature(function).parameters)
        if len(names) < 4:
            raise ValueError(
                f"the interpolant has the arguments {', '.join(names) or 'none'}; (f, y, h, theta) or "
                "(f, t, y, h, theta) is accepted."
            )
        called_so = [i for i, name in enumerate(names) if name.casefold() in PLACE.split()]
        self._place = called_so[-1] if called_so else len(names) - 1
        self._name = str(getattr(function, "__name__", type(function).__name__))

    def at(self, place: float) -> Candidate:
        """The step that gives the state at this part of one."""

        def step(*arguments: Any) -> Any:
            return self._function(*arguments[: self._place], place, *arguments[self._place :])

        signature = inspect.signature(self._function)
        kept = [one for i, one in enumerate(signature.parameters.values()) if i != self._place]
        step.__signature__ = signature.replace(parameters=kept)  # type: ignore[attr-defined]
        return Candidate(step, form_of(step), self._name)


def new_state(step: Callable[..., Any]) -> Callable[..., Any]:
    """A step that gives the first of what this one gives: without its error estimate."""
    return _part(step, 0)


def _part(step: Callable[..., Any], index: int) -> Callable[..., Any]:
    def part(*arguments: Any) -> Any:
        found = step(*arguments)
        if not isinstance(found, (tuple, list)) or len(found) < 2:
            raise MisuseError(
                f"{part.__name__} gives no error estimate; the new state and the estimate, as a tuple, are accepted."
            )
        return found[index]

    part.__signature__ = inspect.signature(step)  # type: ignore[attr-defined]
    part.__name__ = str(getattr(step, "__name__", type(step).__name__))
    return part


def estimate(step: Callable[..., Any], candidate: Candidate, scene: Scene, h: float, claim: float) -> Verdict:
    """On the claim that the second of what a step gives estimates the error of an embedded method of an order.

    Raises:
        MisuseError: it gives no estimate, or none of the shape of a state or of a single number.
    """
    points = Points(candidate, scene, h)
    second = replace(candidate, function=_spread(_part(step, 1)))
    plain = Lanes(second, scene)
    span = min(LONGEST * h, scene.end / 4)

    def size(length: float) -> float:
        return float(np.max(np.abs(points.after(length, plain)) / points.sizes))

    found = _local_order(size, span)
    if all(cell.error == 0 for cell in found.cells):
        return Verdict.of("estimate", _estimate_words(claim), "fails", "it is zero")
    standing, measured = _at_least(found, claim)
    causes = []
    value = None if found.value is None else found.value - 1
    if value is not None and standing != "open" and value - max(found.half_width, ORDER_MARGIN) > claim:
        settled = abs(value - round(value)) <= ORDER_MARGIN
        standing = "fails" if settled and round(value) > claim else "open"
        smaller = "it is smaller than the error of a method of that order"
        causes.append(f"{smaller}: a factor h is too many" if standing == "fails" else f"{smaller} with these steps")
    elif value is not None and standing == "fails" and abs(value + 1 - claim) <= WIDEST:
        causes.append("it is larger than the error of a method of that order: a factor h is missing")
    if standing == "holds":
        actual = _local_order(lambda length: points.error(points.after(length), length), span)
        if actual.value is not None and actual.half_width <= WIDEST and actual.value - 1 < claim + 0.5:
            standing, more = _of_the_step(points, plain, actual, claim, found)
            causes += more
    return Verdict.of("estimate", _estimate_words(claim), standing, measured, tuple(causes))


def _estimate_words(claim: float) -> str:
    return f"an error estimate of order {claim:g}"


def _of_the_step(points: Points, plain: Lanes, actual: Order, claim: float, found: Order) -> tuple[Standing, list[str]]:
    """Where the step itself is of no higher order, the estimate is that of its own error."""
    if actual.value is None or actual.value - 1 < claim - 0.5:
        return "fails", [f"the step itself is of order {round((actual.value or 1) - 1)}, and errs by more"]
    h = min(cell.h for cell in found.cells if cell.used)
    error, told = points.error(points.after(h), h), np.max(np.abs(points.after(h, plain)) / points.sizes)
    ratio = float(told) / error
    if abs(ratio - 1) <= SAME:
        return "holds", []
    return "fails", [f"the step is of that order too, and its error is {1 / ratio:.2g} times the estimate"]


def _spread(step: Callable[..., Any]) -> Callable[..., Any]:
    """A single number, such as a norm, as a state of it."""

    def spread(*arguments: Any) -> Any:
        found = step(*arguments)
        shape = next(np.shape(one) for one in arguments if np.ndim(one) == 1)
        return np.full(shape, found) if np.ndim(found) == 0 else found

    return spread


def _local_order(error: Callable[[float], float], span: float) -> Order:
    """The slope of an error of a single step; one too long to be taken, as by an inner iteration, is left out."""
    cells: list[Cell] = []
    for n in COUNTS:
        h = span / n
        try:
            size = error(h)
        except MisuseError:
            if cells or n >= LONGEST:
                raise
            continue
        slope = None
        if cells and size > 0 and cells[-1].error > 0:
            slope = math.log(cells[-1].error / size) / math.log(n / cells[-1].n)
            if size < ROUNDED and slope < FALLS * max(cell.slope or 0.0 for cell in cells):
                break
        cells.append(Cell(n, h, size, EPSILON, slope))
    return fitted(cells)


def _at_least(found: Order, claim: float) -> tuple[Standing, str]:
    """Whether the local error falls with h^(claim + 1) at least, and with what it does."""
    if found.value is None or found.kind != "slope":
        if found.kind == "floor":
            return "holds", "error at rounding with every step"
        return ("fails", "it does not fall with h") if found.kind == "flat" else ("open", "no order is to be seen")
    order = replace(found, value=found.value - 1)
    return reaches(order, claim), f"{order.words}, since in a step it goes with h^{found.value:.2f}"
