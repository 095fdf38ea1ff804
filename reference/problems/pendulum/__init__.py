"""The mathematical pendulum: theta'' = -(g/l) sin theta, released from rest or set going."""

from reference.problems.pendulum.events import Events
from reference.problems.pendulum.problem import Pendulum

__all__ = ["Events", "Pendulum"]
