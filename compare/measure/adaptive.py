"""Embedded pairs with a controlled step, over problems, controllers and tolerances: their errors and their work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.adaptive import AdaptiveLane, march_adaptive
from compare.measure.errors import Sizes
from compare.measure.records import AdaptiveCell
from compare.measure.rounding import rounding_of_steps

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.march.adaptive import AdaptiveMarch
    from compare.march.controllers import Controller
    from compare.march.precision import Precision
    from compare.measure.truth import Course
    from compare.methods.kinds.protocol import Pair

__all__ = ["Controlled", "Tolerated", "score_adaptive"]


@dataclass(frozen=True)
class Tolerated:
    """What a march with a controlled step is asked for.

    Attributes:
        controller: of the step size.
        rtol, atol: the relative and the absolute tolerance.
    """

    controller: Controller
    rtol: Fraction
    atol: Fraction


@dataclass(frozen=True)
class Controlled:
    """Which embedded pairs march with a controlled step, what is asked of each, and how many attempts a march has."""

    pairs: tuple[Pair, ...]
    asked: tuple[Tolerated, ...]
    most: int

    @property
    def parameters(self) -> dict[str, Any]:
        """What the header of a study says of it."""
        both = dict.fromkeys((float(one.rtol), float(one.atol)) for one in self.asked)
        same = all(rtol == atol for rtol, atol in both)
        return {
            "adaptive": [pair.name for pair in self.pairs],
            "controllers": list(dict.fromkeys(one.controller.name for one in self.asked)),
            "rtol": [rtol for rtol, _ in both],
            "atol": "rtol" if same else [atol for _, atol in both],
        }


def score_adaptive(
    pair: Pair,
    courses: Sequence[Course],
    asked: Sequence[Tolerated],
    fmt: Precision,
    most: int,
    *,
    relative: bool = True,
) -> list[AdaptiveCell]:
    """March a pair over every course as is asked, and score it: a cell each, course by course.

    A course gives the problem, and the times at which the states are compared: those of its steps.  Errors are in each
    case's unit, or where they are not ``relative`` in the units of the state itself.
    """
    wanted = [(course, one) for course in courses for one in asked]
    lanes = [
        AdaptiveLane(course.lane, one.controller, fmt.round(one.rtol), fmt.round(one.atol)) for course, one in wanted
    ]
    marches = march_adaptive(pair, lanes, fmt, most)
    return [_cell(pair, *what, found, relative=relative) for what, found in zip(wanted, marches, strict=True)]


def _cell(pair: Pair, course: Course, asked: Tolerated, found: AdaptiveMarch, *, relative: bool) -> AdaptiveCell:
    with np.errstate(over="ignore", invalid="ignore"):
        errors = course.errors(found.states)
        attempts = max(found.accepted + found.rejected, 1)
        rounding = rounding_of_steps(course, found.accepted, found.evaluations // attempts + 1, errors)
        sizes = Sizes(course, errors, rounding, relative=relative)
    return AdaptiveCell(
        method=pair.name,
        controller=asked.controller.name,
        rtol=float(asked.rtol),
        atol=float(asked.atol),
        case=course.case,
        max_error=sizes.place.largest,
        end_error=sizes.place.last,
        rms_error=sizes.place.mean_square,
        max_velocity_error=sizes.velocity.largest,
        digits=sizes.digits,
        evaluations=found.evaluations,
        jacobians=found.jacobians,
        accepted=found.accepted,
        rejected=found.rejected,
        floor=rounding.floor,
        failure=found.failure,
        seconds=found.seconds,
        rounding=sizes.rounding,
    )
