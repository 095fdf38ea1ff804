"""The mathematical pendulum: theta'' = -(g/l) sin theta, released from rest or set going; linearised; in series."""

from reference.problems.pendulum.approximations import LindstedtMotion, LindstedtSolution, PendulumSeries, PeriodSeries
from reference.problems.pendulum.events import Events
from reference.problems.pendulum.linear import LinearPendulum
from reference.problems.pendulum.problem import Pendulum

__all__ = [
    "Events",
    "LindstedtMotion",
    "LindstedtSolution",
    "LinearPendulum",
    "Pendulum",
    "PendulumSeries",
    "PeriodSeries",
]
