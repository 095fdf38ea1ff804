"""The cycloid: the curve of quickest descent to any end point, and the tautochrone, Huygens' pendulum."""

from reference.problems.cycloid.arc import CycloidArc
from reference.problems.cycloid.problem import Cycloid
from reference.problems.cycloid.tautochrone import CycloidalPendulum, Tautochrone

__all__ = ["Cycloid", "CycloidArc", "CycloidalPendulum", "Tautochrone"]
