"""Three equal masses that follow one another along a figure eight."""

from __future__ import annotations

from typing import ClassVar

from reference.flow_families import flow_family
from reference.problems.gravitation import Gravitation, axes_of, conserved, named

__all__ = ["FAMILY", "FigureEight"]


class FigureEight(Gravitation):
    """q_i'' = sum_j (q_j - q_i)/|q_j - q_i|^3 of three unit masses in a plane.

    A. Chenciner and R. Montgomery, Annals of Mathematics 152 (2000), 881, where the orbit is proven to exist, after C.
    Moore, Physical Review Letters 70 (1993), 3675; the start is C. Simo's, printed there to eight digits, with the
    period 6.32591398.  So many digits do not close the orbit: after this period it is 4e-8 off.
    """

    name = "figure-eight"
    bodies = ("1", "2", "3")
    space = axes_of(bodies, "xy")
    numbers: ClassVar[dict[str, str]] = {}
    begins = (
        *("0.97000436", "-0.97000436", "0"),
        *("-0.24308753", "0.24308753", "0"),
        *("0.93240737/2", "0.93240737/2", "-0.93240737"),
        *("0.86473146/2", "0.86473146/2", "-0.86473146"),
    )
    equation = "q_i'' = sum over j of (q_j - q_i)/|q_j - q_i|^3, i = 1, 2, 3"
    invariants = conserved("xy", "kinetic")
    t_end = 6.3
    source = "A. Chenciner and R. Montgomery, Annals of Mathematics 152 (2000), 881"
    difficulty = "lower: smooth, stable and almost periodic, without close encounters"
    meanings: ClassVar[dict[str, str]] = {
        **{name: f"position {name[0]} of body {name[1]}" for name in named(bodies, "xy")},
        **{name: f"velocity {name[1]} of body {name[2]}" for name in named(bodies, "xy", "v")},
    }


FAMILY = flow_family(FigureEight, "the figure-eight orbit of three bodies")
