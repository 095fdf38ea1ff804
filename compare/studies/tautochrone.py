"""Every method on Huygens' pendulum: by its angle, where it does not split, and by its arc length, where it does."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from compare.studies.common import SHORTER_N, distinct, forms_of, made, positive_end
from compare.study import some
from reference import Tautochrone
from reference.arithmetic.exact import as_number
from reference.problems.cycloid import CycloidalPendulum

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Study
    from reference.problem import Problem

__all__ = ["FORMS", "study"]

FORMS = {
    "angle": "theta'' = tan(theta/2) (theta'^2/2 - g/(2 R)), theta(0) = angle, theta'(0) = 0",
    "arc": "s'' = -(g/(4 R)) s, s(0) = arc, s'(0) = 0",
}


def study(
    angle: Sequence[Any] = (1.0,),
    radius: Any = 1.0,
    g: Any = 9.81,
    t_end: Any = 10.0,
    form: Sequence[str] = tuple(FORMS),
    n: Sequence[int] = SHORTER_N,
    *,
    traces: bool = False,
    **options: Any,
) -> Study:
    """Score methods on a bead released on an inverted cycloid, over 0 <= t <= t_end.

    Args:
        angle: angles of the start in rad, 0 < |angle| < pi.
        radius: radius of the rolling circle in m.
        g: acceleration of gravity in m/s^2.
        t_end: end of the march in s.
        form: "angle" and "arc", which starts at 4 R sin(angle/2) rounded to a double.
        n: numbers of steps, each a positive integer.
        traces: whether to keep trajectories for plots.
        options: of ``compare.study.score_all``.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    forms = forms_of(some(form, "form"), tuple(FORMS))
    swings = [Tautochrone(value, radius, g) for value in some(angle, "angle")]
    distinct([float(swing.angle) for swing in swings], "angle", "angle")
    problems: list[Problem] = [*swings] if "angle" in forms else []
    if "arc" in forms:
        arcs = [4 * float(swing.radius) * math.sin(float(swing.angle) / 2) for swing in swings]
        problems += [CycloidalPendulum(arc, radius, g) for arc in arcs]
    parameters = {
        "angle": [as_number(swing.angle) for swing in swings],
        "radius": as_number(swings[0].radius),
        "g": as_number(swings[0].g),
        "t_end": as_number(positive_end(t_end, "t_end")),
    }
    definition = {name: FORMS[name] for name in forms}
    return made("tautochrone", problems, definition, parameters, traces=traces, n=n, t_end=t_end, **options)
