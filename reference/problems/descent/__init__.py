"""Descent on a curve: a body released at rest slides down without friction in uniform gravity."""

from reference.problems.descent.curves import RACE
from reference.problems.descent.problem import Descent

__all__ = ["RACE", "Descent"]
