"""Every method on the pendulum, released or set going: error against N, order, energy drift."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.studies.common import distinct, made, positive_end
from compare.study import DEFAULT_N, some
from reference import Pendulum
from reference.arithmetic.exact import as_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Study

__all__ = ["DEFAULT_N", "study"]

DEFINITION = "theta'' = -(g/length) sin(theta), theta(0) = theta0, theta'(0) = "


def study(
    theta0: Sequence[Any] = (1.0,),
    g: Any = 9.81,
    length: Any = 1.0,
    t_end: Any = 10.0,
    omega0: Any = None,
    n: Sequence[int] = DEFAULT_N,
    *,
    traces: bool = False,
    **options: Any,
) -> Study:
    """Score methods on the pendulum from each angle, over 0 <= t <= t_end in each number of steps.

    Args:
        theta0: angles of the start in rad; without ``omega0`` amplitudes, each in (0, pi).
        g: acceleration of gravity in m/s^2.
        length: length in m.
        t_end: end of the march in s.
        omega0: angular velocity of the start in rad/s; released from rest if None.
        n: numbers of steps, each a positive integer.
        traces: whether to keep trajectories for plots.
        options: of ``compare.study.score_all``.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    problems = [Pendulum(angle, g, length, omega0) for angle in some(theta0, "theta0")]
    distinct([float(problem.theta0) for problem in problems], "theta0", "amplitude" if omega0 is None else "angle")
    going = {} if omega0 is None else {"omega0": as_number(problems[0].omega0)}
    parameters = {
        "theta0": [as_number(problem.theta0) for problem in problems],
        **going,
        "g": as_number(problems[0].g),
        "length": as_number(problems[0].length),
        "t_end": as_number(positive_end(t_end, "t_end")),
    }
    definition = DEFINITION + ("omega0" if going else "0")
    return made("pendulum", problems, definition, parameters, traces=traces, n=n, t_end=t_end, **options)
