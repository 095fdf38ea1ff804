"""What can be asked of a brachistochrone in a central field: names, units and definitions."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from reference.declaration import Quantity, Row
from reference.row_domains import ONCE, TIME, Reals

__all__ = ["ROWS", "Definitions", "Z", "rows_of"]


@dataclass(frozen=True)
class Definitions:
    """The equations of one law of force, in a line each, and the words for what it is idealised to."""

    height: str
    phi: str
    tau: str
    rate: str
    kappa: str
    half_angle: str
    descent_time: str
    time_unit: str
    setting: str


ZERO, UNITY = Fraction(0), Fraction(1)
TAU, PSI = Reals("tau", "tau"), Reals("psi", "psi")
Z = Reals("z", "z", ZERO, UNITY)
"""Above the lowest point of each path."""
HEIGHT = Reals("height", "height", ZERO, UNITY)
EPSILON = Reals("epsilon", "epsilon", -UNITY, UNITY)
INTEGRAL_BITS = 1 << 11
"""Working precision at which a proof of what takes an integral in balls is given up."""
FORMULA = (("taylor", "a formula of the inputs, which no motion gives"),)
NO_MOTION = (("taylor", "the neighbours obey no equation of motion"),)
ROOT = (("taylor", "a root that is found by the other routes, whose motion is then integrated"),)


def rows_of(of: Definitions) -> tuple[Row, ...]:
    """The rows of one law of force."""
    z = Quantity("z", "1", "height r/r0", of.height)
    phi = Quantity("phi", "rad", "angle swept since the release", of.phi)
    tau = Quantity("tau", "1", f"time since the release in units of {of.time_unit}", of.tau)
    return (
        Row("state", (z, Quantity("z_rate", "1", "rate of the height", of.rate), phi), TAU),
        Row("curve", (z, phi, tau), PSI),
        Row("by_z", (_named(phi, "phi_by_z"), _named(tau, "tau_by_z")), Z),
        Row(
            "by_height",
            (
                Quantity("z_by_height", "1", "height r/r0", "z = z0 + (1 - z0) height"),
                _named(phi, "phi_by_height"),
                _named(tau, "tau_by_height"),
            ),
            HEIGHT,
        ),
        *_once(of),
        Row(
            "neighbour_gap",
            (
                Quantity(
                    "neighbour_gap",
                    "1",
                    "time that a neighbouring curve takes longer",
                    "tau to the end along phi + epsilon eta, eta = (1 - z0) sin^3(psi/2) sin((psi_end - psi)/2), "
                    "less arrival_time",
                ),
            ),
            EPSILON,
            NO_MOTION,
            INTEGRAL_BITS,
        ),
        *_in_seconds(of),
    )


def _named(quantity: Quantity, name: str) -> Quantity:
    return Quantity(name, quantity.units, f"{quantity.long_name}, on the way down", quantity.definition)


def _once(of: Definitions) -> tuple[Row, ...]:
    end, lowest = "to the end, (R, PHI) or where z = 1 again", "from the release to the lowest point"
    formulas = (
        Row("z0", (Quantity("z0", "1", "height of the lowest point", "phi(R; z0) = PHI at the end"),), ONCE, ROOT),
        Row("kappa", (Quantity("kappa", "1", "square of Bouguer's constant", of.kappa),), ONCE, FORMULA),
    )
    of_the_path = (
        Quantity("half_angle", "rad", f"angle {lowest}", of.half_angle),
        Quantity("descent_time", "1", f"time {lowest}", of.descent_time),
        Quantity("arrival_time", "1", f"time {end}", "tau at the end"),
        Quantity("dhalf_angle_dz0", "rad", "sensitivity of half_angle to z0", "d(half_angle)/d(z0)"),
        Quantity(
            "ddescent_time_dz0",
            "1",
            "sensitivity of descent_time to z0",
            "sqrt(kappa) d(half_angle)/d(z0)",
        ),
    )
    of_the_chord = (
        Quantity("chord_time", "1", f"time along the straight line {end}", "integral of ds/v from (1, 0)"),
        Quantity("chord_gap", "1", "time that the straight line takes longer", "chord_time - arrival_time"),
    )
    return (
        *formulas,
        *(Row(quantity.name, (quantity,), ONCE) for quantity in of_the_path),
        *(Row(quantity.name, (quantity,), ONCE, (), INTEGRAL_BITS) for quantity in of_the_chord),
    )


def _in_seconds(of: Definitions) -> tuple[Row, ...]:
    radius = Quantity("radius", "m", f"distance from the centre, {of.setting}", "r = r0 z")
    return (
        Row("time_unit", (Quantity("time_unit", "s", "unit of tau", of.time_unit),), ONCE, FORMULA),
        *(
            Row(name, (Quantity(name, "s", f"{words}, {of.setting}", f"{what} {of.time_unit}"),), ONCE)
            for name, what, words in (
                ("descent_seconds", "descent_time", "time from the release to the lowest point"),
                ("arrival_seconds", "arrival_time", "time to the end"),
            )
        ),
        Row(
            "si_curve",
            (radius, Quantity("seconds", "s", f"time since the release, {of.setting}", f"tau {of.time_unit}")),
            PSI,
        ),
        Row(
            "si_state",
            (
                radius,
                Quantity("radial_velocity", "m s-1", "rate of the distance from the centre", "dr/dt"),
                Quantity("angle", "rad", "angle swept since the release", of.phi),
            ),
            TIME,
        ),
    )


ROWS = rows_of(
    Definitions(
        height="z = (1 + z0)/2 + ((1 - z0)/2) cos(psi)",
        phi="dphi/dpsi = z0^(3/2) (1 - z)/(z sqrt(Q)), Q = (1 - z0) z^2 + z0 (1 - z0) z + z0^2",
        tau="dtau/dpsi = z^2 sqrt((1 - z0)/Q), Q = (1 - z0) z^2 + z0 (1 - z0) z + z0^2",
        rate="z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3",
        kappa="kappa = z0^3/(1 - z0)",
        half_angle="pi/3 - 2 z0 K(k)/(3 sqrt(s)), s = sqrt(3 - 2 z0), k^2 = 1/2 - (3 - z0^2)/(4 s)",
        descent_time="integral of dtau/dpsi over 0 <= psi <= pi, in units of sqrt(r0^3/(2 G M))",
        time_unit="sqrt(r0^3/(2 G M))",
        setting="all mass in a point at the centre",
    )
)
