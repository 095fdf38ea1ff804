"""Reference values of classical mechanics, proven correctly rounded."""

from reference.certify import Certified
from reference.problems.pendulum import Pendulum

__all__ = ["Certified", "Pendulum"]
