"""The Sun and the five outer planets, from Jupiter to Pluto."""

from __future__ import annotations

from typing import Any, ClassVar

from reference.flow_families import flow_family
from reference.problems.gravitation import Gravitation, axes_of, conserved, named

__all__ = ["FAMILY", "OuterPlanets"]

SUN = (("0", "0", "0"), ("0", "0", "0"))
PLANETS = (
    (("-3.5023653", "-3.8169847", "-1.5507963"), ("0.00565429", "-0.00412490", "-0.00190589")),
    (("9.0755314", "-3.0458353", "-1.6483708"), ("0.00168318", "0.00483525", "0.00192462")),
    (("8.3101420", "-16.2901086", "-7.2521278"), ("0.00354178", "0.00137102", "0.00055029")),
    (("11.4707666", "-25.7294829", "-10.8169456"), ("0.00288930", "0.00114527", "0.00039677")),
    (("-15.5387357", "-25.2225594", "-3.1902382"), ("0.00276725", "-0.00170702", "-0.00136504")),
)
"""Position and velocity of each, as printed, from Jupiter on."""


class OuterPlanets(Gravitation):
    """q_i'' = G sum_j m_j (q_j - q_i)/|q_j - q_i|^3 of the Sun and five planets, in astronomical units and days.

    E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, Springer 2006, section I.2.4, table 2.2, after
    Ahnerts Kalender fuer Sternfreunde 1994: the start is September 5, 1994, at 0h00, the Sun at rest.  The mass of the
    Sun, 1.00000597682, contains the inner planets; that of Pluto is 1/(1.3 10^8).  The book follows 200,000 days; the
    march ends after 5,000, little more than a year of Jupiter, which about a minute proves.
    """

    name = "outer-planets"
    bodies = ("_sun", "_jupiter", "_saturn", "_uranus", "_neptune", "_pluto")
    space = axes_of(bodies, "xyz", "d")
    numbers: ClassVar[dict[str, str]] = {
        "G": "2.95912208286e-4",
        "m_sun": "1.00000597682",
        "m_jupiter": "0.000954786104043",
        "m_saturn": "0.000285583733151",
        "m_uranus": "0.0000437273164546",
        "m_neptune": "0.0000517759138449",
        "m_pluto": "1/130000000",
    }
    begins = tuple(one[kind][axis] for kind in range(2) for axis in range(3) for one in (SUN, *PLANETS))
    equation = "q_i'' = G sum over j of m_j (q_j - q_i)/|q_j - q_i|^3, of the Sun, Jupiter, ..., Pluto"
    invariants = conserved("xyz", "start")
    t_end = 5000.0
    source = "E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2006, section I.2.4"
    difficulty = "higher: 36 components of very different masses, slow and fast revolutions"
    meanings: ClassVar[dict[str, str]] = {
        "G": "constant of gravitation, in au^3/(d^2 solar mass)",
        **{f"m{body}": f"mass of {body[1:].capitalize()}, in solar masses" for body in bodies},
        **{name: f"position {name[0]} of {name[2:].capitalize()}" for name in named(bodies, "xyz")},
        **{name: f"velocity {name[1]} of {name[3:].capitalize()}" for name in named(bodies, "xyz", "v")},
    }
    units: ClassVar[dict[str, str]] = {
        **dict.fromkeys(named(bodies, "xyz"), "au"),
        **dict.fromkeys(named(bodies, "xyz", "v"), "au/d"),
    }

    def masses(self, p: dict[str, Any]) -> list[Any]:
        return [p[f"m{body}"] for body in self.bodies]

    def constant(self, p: dict[str, Any]) -> Any:
        return p["G"]


FAMILY = flow_family(OuterPlanets, "the Sun and the outer planets", varied="m_jupiter")
