"""The mathematical pendulum, released from rest.

theta'' = -(g/l) sin theta,     theta(0) = theta0 in (0, pi),  theta'(0) = 0
"""

from reference.problems.pendulum.problem import Events, Pendulum

__all__ = ["Events", "Pendulum"]
