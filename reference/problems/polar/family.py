"""The groups of the polar brachistochrone and of the tunnel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reference.family import Coordinate, Group, Layout
from reference.problems.polar import PolarBrachistochrone
from reference.problems.tunnel import Tunnel

if TYPE_CHECKING:
    from reference.declaration import Row
    from reference.problem import Problem

__all__ = ["BOUNDARY", "FAMILY", "LAYOUTS", "MOTION", "TUNNEL_FAMILY", "TUNNEL_MOTION", "core", "full"]

Z0 = Coordinate("z0", "1", "height of the lowest point, r/r0")
PSI = Coordinate("psi", "rad", "parameter of the curve: 0 at the release, pi at the lowest point")
HEIGHT = Coordinate("height", "1", "fraction of the height between the lowest point and the release, on the way down")
TAU = Coordinate("tau", "1", "time since the release in units of sqrt(r0^3/(2 G M))")
TAU_INSIDE = Coordinate("tau", "1", "time since the release in units of sqrt(r0/g), g at the surface")
EPSILON = Coordinate("epsilon", "1", "size of the neighbouring curve's deviation")
END_Z = Coordinate("end_z", "1", "height of the end point, r/r0")
END_PHI = Coordinate("end_phi", "rad", "angle of the end point")
END = Coordinate("end", "1", "number of the end point", "0, 1, 2, ...", whole=True)
SOURCE = (
    "A. S. Parnovsky, Acta Physica Polonica A 93 (1998) Supplement, S-55; B. C. Carlson, Numer. Algorithms 10 (1995) 13"
)
LAW = "inverse-square field, z = r/r0"
EQUATION = (
    f"the least time from rest at z = 1 through the lowest point z0, {LAW}: "
    "z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3, kappa = z0^3/(1 - z0)"
)
BOUNDARY_PROBLEM = f"the least time from rest at (1, 0) to (end_z, end_phi), {LAW}"


def rows(problem: type[Problem], *names: str) -> tuple[Row, ...]:
    """The problem's rows of these names, in this order."""
    found = {row.name: row for row in problem.rows}
    return tuple(found[name] for name in names)


def to_end(end_z: float, end_phi: float) -> PolarBrachistochrone:
    """The brachistochrone to the end point (end_z, end_phi)."""
    return PolarBrachistochrone(end=(end_z, end_phi))


ONCE = ("kappa", "half_angle", "descent_time", "dhalf_angle_dz0", "ddescent_time_dz0", "chord_time", "chord_gap")
FAMILY = Layout(
    "/polar/family",
    "brachistochrones in an inverse-square field, by their lowest point",
    (Z0,),
    {"psi": PSI, "height": HEIGHT, "epsilon": EPSILON},
    (),
    rows(PolarBrachistochrone, "curve", "by_height", *ONCE, "neighbour_gap"),
    PolarBrachistochrone,
    SOURCE,
    EQUATION,
    "average; higher for z0 near 0, where the path turns sharply near the centre, and as an equation dphi/dz, singular "
    "at both ends",
)
MOTION = Layout(
    "/polar/motion",
    "motion in time on these brachistochrones, through the lowest point and back",
    (Z0,),
    {"tau": TAU},
    (),
    rows(PolarBrachistochrone, "state"),
    PolarBrachistochrone,
    SOURCE,
    EQUATION,
    "average; higher for z0 near 0, where the passage of the lowest point is short and violent",
)
BOUNDARY = Layout(
    "/polar/boundary",
    "brachistochrones in an inverse-square field, by their end point",
    (END_Z, END_PHI),
    {},
    (),
    rows(PolarBrachistochrone, "z0", "arrival_time", "chord_time", "chord_gap"),
    to_end,
    SOURCE,
    BOUNDARY_PROBLEM,
    "higher: a boundary-value problem, whose solutions end where the angle at z = 1 reaches 2 pi/3",
    END,
)
TUNNEL_SOURCE = "G. Venezian, Am. J. Phys. 34 (1966) 701"
TUNNEL_EQUATION = (
    "the least time from rest at the surface z = r/r0 = 1 through the lowest point z0, gravity proportional to r: "
    "z'' = -z + kappa (1 - z^4)/z^3, phi' = sqrt(kappa) (1 - z^2)/z^2, kappa = z0^2/(1 - z0^2)"
)
TUNNEL_DIFFICULTY = "average: a hypocycloid, with a cusp at either end"
TUNNEL_FAMILY = Layout(
    "/tunnel/family",
    "fastest tunnels through a planet of uniform density, by their lowest point",
    (Z0,),
    {"psi": PSI, "height": HEIGHT, "epsilon": EPSILON},
    (),
    rows(Tunnel, "curve", "by_height", *ONCE, "neighbour_gap"),
    Tunnel,
    TUNNEL_SOURCE,
    TUNNEL_EQUATION,
    TUNNEL_DIFFICULTY,
)
TUNNEL_MOTION = Layout(
    "/tunnel/motion",
    "motion in time through these tunnels, down and up again",
    (Z0,),
    {"tau": TAU_INSIDE},
    (),
    rows(Tunnel, "state"),
    Tunnel,
    TUNNEL_SOURCE,
    TUNNEL_EQUATION,
    TUNNEL_DIFFICULTY,
)
LAYOUTS = (FAMILY, MOTION, BOUNDARY, TUNNEL_FAMILY, TUNNEL_MOTION)

LOWEST = (0.01, *(k / 20 for k in range(1, 20)), 0.99)
ENDS = tuple((z, phi) for z in (1.0, 0.75, 0.5, 0.25) for phi in (0.25, 1.0, 1.5))


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    epsilon = np.array([1, 4, 8]) / 16  # a negative one gives the same
    return (
        Group(FAMILY, {}, {"z0": LOWEST, "psi": np.arange(202) / 64, "height": np.arange(33) / 32, "epsilon": epsilon}),
        Group(MOTION, {}, {"z0": LOWEST, "tau": np.arange(193) / 64}),
        Group(BOUNDARY, {}, {"end_z": [end[0] for end in ENDS], "end_phi": [end[1] for end in ENDS]}),
        Group(
            TUNNEL_FAMILY,
            {},
            {"z0": LOWEST[::4], "psi": np.arange(202) / 64, "height": np.arange(33) / 32, "epsilon": epsilon},
        ),
        Group(TUNNEL_MOTION, {}, {"z0": LOWEST[::4], "tau": np.arange(193) / 64}),
    )


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, as far as they are proven within hours on two cores."""
    lowest = np.unique(np.concatenate([LOWEST, np.arange(1, 64) / 64]))
    epsilon = np.arange(1, 17) / 16
    ends = [(z, phi) for z in np.arange(1, 17) / 16 for phi in np.arange(1, 17) / 8]
    return (
        Group(
            FAMILY,
            {},
            {"z0": lowest, "psi": np.arange(805) / 256, "height": np.arange(513) / 512, "epsilon": epsilon},
        ),
        Group(MOTION, {}, {"z0": lowest, "tau": np.arange(3073) / 1024}),
        Group(BOUNDARY, {}, {"end_z": [end[0] for end in ends], "end_phi": [end[1] for end in ends]}),
        Group(
            TUNNEL_FAMILY,
            {},
            {"z0": lowest, "psi": np.arange(805) / 256, "height": np.arange(513) / 512, "epsilon": epsilon},
        ),
        Group(TUNNEL_MOTION, {}, {"z0": lowest, "tau": np.arange(3073) / 1024}),
    )
