"""The brachistochrone of a point mass: what is asked, stored and compared of it."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import as_number, exact
from reference.family import Comparison, End, Family, Input, Marched, Reported
from reference.layout import Coordinate, Group, Layout, parts
from reference.problems.polar.bodies import BODIES
from reference.problems.polar.paths import PolarByPsi, PolarByZ
from reference.problems.polar.problem import PolarBrachistochrone

if TYPE_CHECKING:
    from reference.declaration import Row
    from reference.problem import Problem

__all__ = [
    "BOUNDARY",
    "EXTREMALS",
    "FAMILY",
    "IN_A_FIELD",
    "LAYOUTS",
    "MOTION",
    "core",
    "depth_above",
    "full",
    "in_a_field",
]

Z0 = Coordinate("z0", "1", "height of the lowest point, r/r0")
PSI = Coordinate("psi", "rad", "parameter of the curve: 0 at the release, pi at the lowest point")
HEIGHT = Coordinate("height", "1", "fraction of the height between the lowest point and the release, on the way down")
TAU = Coordinate("tau", "1", "time since the release in units of sqrt(r0^3/(2 G M))")
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
EXTREMALS = Layout(
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
LAYOUTS = (EXTREMALS, MOTION, BOUNDARY)

LOWEST = (0.01, *(k / 20 for k in range(1, 20)), 0.99)
ENDS = tuple((z, phi) for z in (1.0, 0.75, 0.5, 0.25) for phi in (0.25, 1.0, 1.5))


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    epsilon = parts([1, 4, 8], 16)  # a negative one gives the same
    return (
        Group(
            EXTREMALS,
            {},
            {"z0": LOWEST, "psi": parts(range(202), 64), "height": parts(range(33), 32), "epsilon": epsilon},
        ),
        Group(MOTION, {}, {"z0": LOWEST, "tau": parts(range(193), 64)}),
        Group(BOUNDARY, {}, {"end_z": [end[0] for end in ENDS], "end_phi": [end[1] for end in ENDS]}),
    )


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, as far as they are proven within hours on two cores."""
    lowest = sorted({*LOWEST, *parts(range(1, 64), 64)})
    epsilon = parts(range(1, 17), 16)
    ends = [(z, phi) for z in parts(range(1, 17), 16) for phi in parts(range(1, 17), 8)]
    return (
        Group(
            EXTREMALS,
            {},
            {"z0": lowest, "psi": parts(range(805), 256), "height": parts(range(513), 512), "epsilon": epsilon},
        ),
        Group(MOTION, {}, {"z0": lowest, "tau": parts(range(3073), 1024)}),
        Group(BOUNDARY, {}, {"end_z": [end[0] for end in ends], "end_phi": [end[1] for end in ends]}),
    )


PSI_END_DEFAULT = 6.25
"""Where a march along the curve in psi ends, in rad: almost at rest again."""
ABOVE_THE_LOWEST = Fraction(1, 10_000)
"""Part of the way down at which a march along the curve in z ends before its lowest point."""


def depth_above(curve: PolarByZ, z_end: Any, name: str) -> Fraction:
    """How far below the release the curve in z ends: ABOVE_THE_LOWEST of the way before its end if it is not said.

    Raises:
        ValueError: it is not above the lowest point and below the release.
    """
    lowest = curve.z0
    if z_end is None:
        return 1 - exact(float(lowest + (1 - lowest) * ABOVE_THE_LOWEST), name)
    if not lowest < (end := exact(z_end, name)) < 1:
        raise ValueError(f"{name} is {as_number(end)}; a number with {as_number(lowest)} < {name} < 1 is accepted.")
    return 1 - end


TAU_END = End("tau_end", "end of the motion's march in units of sqrt(r0^3/(2 G M)) (default 10)", 10.0)
Z_END = End(
    "z_end",
    "end of the curve's march in z (default 1e-4 of the way above the lowest point)",
    None,
    depth_above,
    lambda _curve, depth: 1 - depth,
)
PSI_END = End("psi_end", "end of the curve's march in psi in rad (default 6.25)", PSI_END_DEFAULT)
TO_REST = End("psi_end", "almost at rest again", None, lambda _curve, _end, _name: Fraction(PSI_END_DEFAULT))


def in_a_field(strength: Input, unit: str) -> tuple[Input, ...]:
    """What a brachistochrone in a central field asks for, its strength and its unit of time given."""
    return (
        Input("z0", "1", "height of the lowest point, or else --end", optional=True),
        Input("end", "", "end point R,PHI: its radius over r0 and its angle in rad", optional=True, kind="pair"),
        Input("r0", "m", "radius of the release", optional=True),
        strength,
        Input("body", "", f"instead of {strength.name} a body: {' or '.join(BODIES)}", optional=True, kind="text"),
        Input("tau", "1", f"time in units of {unit}", optional=True, over="tau"),
        Input("psi", "rad", "parameter of the curve, pi at the lowest point", optional=True, over="psi"),
        Input("z", "1", "height on the way down", optional=True, over="z"),
        Input("t", "s", "time, where r0 is given", optional=True, over="time"),
        Input("epsilon", "1", "size of a neighbouring curve's deviation", optional=True, over="epsilon"),
    )


IN_A_FIELD = (
    "state",
    "curve",
    "by_z",
    "z0",
    "kappa",
    "half_angle",
    "descent_time",
    "arrival_time",
    "chord_time",
    "chord_gap",
    "time_unit",
    "descent_seconds",
    "arrival_seconds",
    "si_state",
    "si_curve",
    "neighbour_gap",
)
FAMILY = Family(
    name="polar",
    help="the brachistochrone in the field of a point mass, z = r/r0, from rest; inside a real body an idealisation",
    problem=PolarBrachistochrone,
    inputs=in_a_field(
        Input("gm", "m3 s-2", "gravitational constant times mass, with r0", optional=True), "sqrt(r0^3/(2 G M))"
    ),
    rows=IN_A_FIELD,
    comparison=Comparison(
        "polar",
        "score them on the brachistochrone of a point mass: in time, in z and in psi",
        varied="z0",
        values=(0.5,),
        what="lowest point",
        forms=(
            ("time", Marched(TAU_END)),
            ("z", Marched(Z_END, lambda motion: PolarByZ(motion.z0))),
            ("psi", Marched(PSI_END, lambda motion: PolarByPsi(motion.z0))),
        ),
    ),
    reported=(
        Reported("polar", "z0", "", "", (0.5, 0.1), PolarBrachistochrone, TAU_END),
        Reported("polar-z", "z0", "", "rad", (0.5, 0.1), PolarByZ, Z_END),
        Reported("polar-psi", "z0", "", "", (0.5, 0.1), PolarByPsi, TO_REST),
    ),
    layouts=LAYOUTS,
    core=core,
    full=full,
)
