"""Every method on the brachistochrone: the bead on it as a motion, and the curve itself as the thesis marches it.

The thesis is J. Šalinović, Problem brahistokrone u nehomogenom gravitacijskom polju, University of Split 2022; its
figure 7 integrates dx/dy to almost the lowest point, where dx/dy is infinite.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.studies.common import SHORTER_N, distinct, forms_of, made, positive_end
from compare.study import some
from reference import Cycloid
from reference.arithmetic.exact import as_number, exact
from reference.problems.paths import CycloidCurve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Study
    from reference.problem import Problem

__all__ = ["FORMS", "depth_of", "study"]

FORMS = {
    "motion": "s'' = g (1 - s/(4 R)), s the arc length from the cusp, at rest at s = 0",
    "curve": "dx/dy = sqrt(y/(2 R - y)), x(0) = 0, y the depth below the cusp",
}
NEAR_THE_BOTTOM = 0.99995
"""Part of the depth of the cycloid at which the curve ends, as in the thesis."""


def study(
    end: Sequence[tuple[Any, Any]] = ((math.pi, 2.0),),
    g: Any = 9.81,
    t_end: Any = 10.0,
    depth: Any = None,
    form: Sequence[str] = tuple(FORMS),
    n: Sequence[int] = SHORTER_N,
    *,
    traces: bool = False,
    **options: Any,
) -> Study:
    """Score methods on the brachistochrone to each end point.

    Args:
        end: end points (x, y) in m from the cusp, y downward.
        g: acceleration of gravity in m/s^2.
        t_end: end of the march of the motion in s, which goes on beyond the end point from cusp to cusp.
        depth: end of the march of the curve in m; NEAR_THE_BOTTOM of the cycloid's depth if None.
        form: "motion" and "curve", of which the radius is the cycloid's, rounded to a double.
        n: numbers of steps, each a positive integer.
        traces: whether to keep trajectories for plots.
        options: of ``compare.study.score_all``.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    forms = forms_of(some(form, "form"), tuple(FORMS))
    beads = [Cycloid(x, y, g) for x, y in some(end, "end")]
    distinct([(float(bead.end_x), float(bead.end_y)) for bead in beads], "end", "point")
    curves = [CycloidCurve(float(bead.radius())) for bead in beads] if "curve" in forms else []
    problems: list[Problem] = [*(beads if "motion" in forms else []), *curves]
    ends = [*([t_end] * (len(problems) - len(curves))), *(depth_of(curve, depth) for curve in curves)]
    parameters: dict[str, Any] = {
        "end": [(as_number(bead.end_x), as_number(bead.end_y)) for bead in beads],
        "g": as_number(beads[0].g),
    }
    if "motion" in forms:
        parameters["t_end"] = as_number(positive_end(t_end, "t_end"))
    if curves:
        parameters["depth"] = [as_number(value) for value in ends[-len(curves) :]]
    definition = {name: FORMS[name] for name in forms}
    return made("brachistochrone", problems, definition, parameters, traces=traces, n=n, t_end=ends, **options)


def depth_of(curve: CycloidCurve, depth: Any = None) -> Fraction:
    """Where the march of a curve ends: NEAR_THE_BOTTOM of its depth if it is not said.

    Raises:
        ValueError: it does not go down to there.
    """
    if depth is None:
        return Fraction(float(2 * curve.radius) * NEAR_THE_BOTTOM)
    if not 0 < (end := exact(depth, "depth")) <= 2 * curve.radius:
        lowest = as_number(2 * curve.radius)
        raise ValueError(
            f"depth is {as_number(end)}; a positive depth up to that of the cycloid, {lowest}, is accepted."
        )
    return end
