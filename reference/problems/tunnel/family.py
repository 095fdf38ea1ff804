"""The fastest tunnel through a uniform planet: what is asked, stored and compared of it."""

from __future__ import annotations

from reference.family import Comparison, End, Family, Input, Marched, Reported
from reference.layout import Coordinate, Group, Layout, parts
from reference.problems.polar.family import EPSILON, HEIGHT, IN_A_FIELD, LOWEST, ONCE, PSI, Z0, in_a_field, rows
from reference.problems.tunnel.problem import Tunnel

__all__ = ["FAMILY", "HYPOCYCLOIDS", "LAYOUTS", "MOTION", "core", "full"]

TAU = Coordinate("tau", "1", "time since the release in units of sqrt(r0/g), g at the surface")
SOURCE = "G. Venezian, Am. J. Phys. 34 (1966) 701"
EQUATION = (
    "the least time from rest at the surface z = r/r0 = 1 through the lowest point z0, gravity proportional to r: "
    "z'' = -z + kappa (1 - z^4)/z^3, phi' = sqrt(kappa) (1 - z^2)/z^2, kappa = z0^2/(1 - z0^2)"
)
DIFFICULTY = "average: a hypocycloid, with a cusp at either end"
HYPOCYCLOIDS = Layout(
    "/tunnel/family",
    "fastest tunnels through a planet of uniform density, by their lowest point",
    (Z0,),
    {"psi": PSI, "height": HEIGHT, "epsilon": EPSILON},
    (),
    rows(Tunnel, "curve", "by_height", *ONCE, "neighbour_gap"),
    Tunnel,
    SOURCE,
    EQUATION,
    DIFFICULTY,
)
MOTION = Layout(
    "/tunnel/motion",
    "motion in time through these tunnels, down and up again",
    (Z0,),
    {"tau": TAU},
    (),
    rows(Tunnel, "state"),
    Tunnel,
    SOURCE,
    EQUATION,
    DIFFICULTY,
)
LAYOUTS = (HYPOCYCLOIDS, MOTION)


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    epsilon = parts([1, 4, 8], 16)  # a negative one gives the same
    return (
        Group(
            HYPOCYCLOIDS,
            {},
            {"z0": LOWEST[::4], "psi": parts(range(202), 64), "height": parts(range(33), 32), "epsilon": epsilon},
        ),
        Group(MOTION, {}, {"z0": LOWEST[::4], "tau": parts(range(193), 64)}),
    )


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, as far as they are proven within hours on two cores."""
    lowest = sorted({*LOWEST, *parts(range(1, 64), 64)})
    epsilon = parts(range(1, 17), 16)
    return (
        Group(
            HYPOCYCLOIDS,
            {},
            {"z0": lowest, "psi": parts(range(805), 256), "height": parts(range(513), 512), "epsilon": epsilon},
        ),
        Group(MOTION, {}, {"z0": lowest, "tau": parts(range(3073), 1024)}),
    )


TAU_END = End("tau_end", "end of the march in units of sqrt(r0/g) (default 10)", 10.0)

FAMILY = Family(
    name="tunnel",
    help="the fastest tunnel through a planet of uniform density, z = r/r0, from rest at its surface",
    problem=Tunnel,
    inputs=in_a_field(Input("g", "m s-2", "gravity at the surface, with r0", optional=True), "sqrt(r0/g)"),
    rows=IN_A_FIELD,
    comparison=Comparison(
        "tunnel",
        "score them on the fastest tunnel through a uniform planet, down and up again",
        varied="z0",
        values=(0.5,),
        what="lowest point",
        forms=(("", Marched(TAU_END)),),
    ),
    reported=(Reported("tunnel", "z0", "", "", (0.5,), Tunnel, TAU_END),),
    layouts=LAYOUTS,
    core=core,
    full=full,
)
