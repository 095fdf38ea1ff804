"""The bodies that have a name: G M of each, and where it is from.

The nominal values of Resolution B3 of the IAU (2015) are exact by definition: G M of the Earth, and its equatorial
radius, 6.3781e6 m.  No radius is taken from here: the release is where the user says.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from reference.constants import Constant
from reference.names import said

__all__ = ["BODIES", "body_of"]

BODIES = {
    "earth": Constant(
        "gm",
        Fraction("3.986004e14"),
        "m3 s-2",
        "nominal terrestrial mass parameter, IAU 2015 Resolution B3, doi:10.3847/0004-6256/152/2/41",
    ),
    "thesis-earth": Constant(
        "gm",
        Fraction("6.6743e-11") * Fraction("5.9722e24"),
        "m3 s-2",
        "G M with G = 6.6743e-11 m3 kg-1 s-2 and M = 5.9722e24 kg, as in J. Salinovic's thesis, University of Split "
        "2022; 5.4e-6 above the nominal value",
    ),
}


def body_of(name: Any, given: Any, instead: str) -> Constant | None:
    """G M of the body of this name; None where there is no name.

    Raises:
        ValueError: there is no such body, or what it stands ``instead`` of is given too.
    """
    if name is None:
        return None
    if given is not None or not isinstance(name, str) or name not in BODIES:
        raise ValueError(f"body is {said(name)}; one of {', '.join(BODIES)} is accepted, instead of {instead}.")
    return BODIES[name]
