"""Seven stars in a plane that pass close to each other: the Pleiades of the Bari test set."""

from __future__ import annotations

from typing import Any, ClassVar

from reference.flow_families import flow_family
from reference.problems.gravitation import Gravitation, axes_of, conserved, named

__all__ = ["FAMILY", "Pleiades"]


class Pleiades(Gravitation):
    """q_i'' = sum_j m_j (q_j - q_i)/|q_j - q_i|^3 of seven stars in a plane, with the masses m_i = i.

    E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, Springer 1993, section II.10,
    equation (10.3); the problem "pleiades" of the Test Set for IVP Solvers (F. Mazzia and C. Magherini, Bari 2008),
    which ends at t = 3 and prints its reference solution there to 16 digits.  Bodies pass close to each other before
    that.
    """

    name = "pleiades"
    bodies = tuple(map(str, range(1, 8)))
    space = axes_of(bodies, "xy")
    numbers: ClassVar[dict[str, str]] = {f"m{k}": str(k) for k in range(1, 8)}
    begins = (
        *("3", "3", "-1", "-3", "2", "-2", "2"),
        *("3", "-3", "2", "0", "0", "-4", "4"),
        *("0", "0", "0", "0", "0", "1.75", "-1.5"),
        *("0", "0", "0", "-1.25", "1", "0", "0"),
    )
    equation = "q_i'' = sum over j of m_j (q_j - q_i)/|q_j - q_i|^3, m_i = i, i = 1, ..., 7"
    invariants = conserved("xy", "start")
    t_end = 3.0
    source = "E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 1993, section II.10"
    difficulty = "higher: 28 components, whose close encounters multiply errors"
    meanings: ClassVar[dict[str, str]] = {
        **{f"m{k}": f"mass of star {k}" for k in range(1, 8)},
        **{name: f"position {name[0]} of star {name[1]}" for name in named(bodies, "xy")},
        **{name: f"velocity {name[1]} of star {name[2]}" for name in named(bodies, "xy", "v")},
    }

    def masses(self, p: dict[str, Any]) -> list[Any]:
        return [p[f"m{body}"] for body in self.bodies]


FAMILY = flow_family(Pleiades, "the seven stars of the Pleiades", varied="vx6")
