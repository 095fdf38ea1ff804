"""The thesis in the field of a point mass: sections 2.4 and 4.5."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from compare.sources.errata.evidence import THESIS, Erratum, along, near, precisely, proven, rounds_to
from compare.sources.errata.spelled import spelled
from reference.arithmetic.precision import mp
from reference.problems.polar.problem import PolarBrachistochrone

__all__ = ["FIELD"]

G, M, MASS, R0 = Fraction(2, 3), Fraction(5), Fraction(7), Fraction(3)
"""Any numbers: what is right holds for all."""
RADII = (Fraction(2), Fraction(5, 2))


def _is_squared_speed(units: str) -> bool:
    """Whether G M/r is a squared speed, G being in these units, whatever the units are themselves."""
    metre, kilogram, second = Fraction(100), Fraction(1000), Fraction(1, 60)
    values = metre, kilogram, second, kilogram * metre / second**2
    constants = [spelled(one, "m", "kg", "s", "N")(*values) for one in units.split(" = ")]
    return all(constant * kilogram / metre == (metre / second) ** 2 for constant in constants)


def _slope_squared(r: Fraction, c_squared: Fraction) -> Fraction:
    """(dphi/dr)^2: the reciprocal of (1.38), which follows from (1.36) and Beltrami's identity."""
    work = 2 * c_squared * G * M * (R0 - r)
    return work / (R0 * r**5 - work * r * r)


def _gives_139(equation: str) -> bool:
    """Whether (1.38) turns into (1.39) with this C^2, which the equation is linear in."""
    form = spelled(equation, "C²", "G", "m", "M")
    at_zero, at_one = (form(Fraction(c_squared), G, MASS, M) for c_squared in (0, 1))
    c_squared = at_zero / (at_zero - at_one)
    return all(_slope_squared(r, c_squared) == G * (R0 - r) / (R0 * r**5 - G * (R0 - r) * r * r) for r in RADII)


def _gives_140(constant: str) -> bool:
    """Whether (1.38) turns into (1.40) with this K."""
    c_squared = Fraction(1, 11)
    k = spelled(constant, "C²", "G", "m", "M")(c_squared, G, MASS, M)
    return all(_slope_squared(r, c_squared) == (1 - r / R0) / (k * r**3 - 1 + r / R0) / (r * r) for r in RADII)


@precisely
def _is_the_slope(bracket: str) -> bool:
    """Whether (1.42), with this bracket of z and z0, is dphi/dz at a proven state of the motion."""
    z0 = mp.mpf(1) / 4
    problem = PolarBrachistochrone("0.25")
    z = along(problem, "0.5")[0]
    rate, turn = _rates(z, z0)
    printed = z0 ** mp.mpf(1.5) / z * mp.sqrt((1 - z) / ((z - z0) * spelled(bracket, "z", "z0")(z, z0)))
    return near(rate, along(problem, "0.5")[1]) and near(printed, -turn / rate)


def _rates(z: Any, z0: Any) -> tuple[Any, Any]:
    """z' and phi' from the conservation of energy and Bouguer's law, z^2 phi' = sqrt(kappa) v^2."""
    speed_squared, bouguer = (1 - z) / z, mp.sqrt(z0**3 / (1 - z0))
    turn = bouguer * speed_squared / z**2
    return -mp.sqrt(speed_squared - (z * turn) ** 2), turn


def _half_angle(z0: str) -> Any:
    """The angle in degrees from the release to the lowest point, proven."""
    return mp.degrees(proven(PolarBrachistochrone(z0), "half_angle")[0])


@precisely
def _is_the_whole_angle(text: str) -> bool:
    return rounds_to(2 * _half_angle("0.2"), text)


@precisely
def _is_the_angle_between_the_ends(text: str) -> bool:
    return rounds_to(_half_angle("0.1"), text)


@precisely
def _is_width_over_depth(text: str) -> bool:
    """Of the whole curve Z = 0.9, its width along the circle of the release."""
    return rounds_to(2 * mp.radians(_half_angle("0.9")) / (1 - mp.mpf("0.9")), text)


def _is_how_many(count: int) -> bool:
    """Whether so many parameters, equally spaced from 0.1 to 0.9, have among them all that the thesis names.

    It names 0.1, 0.9 and, as one of figure 14's curves that figure 15 continues, 0.2.
    """
    first, last = Fraction("0.1"), Fraction("0.9")
    return Fraction("0.2") in {first + (last - first) * i / (count - 1) for i in range(count)}


COUNT = {10: "ten", 9: "nine"}

FIELD = (
    Erratum(
        THESIS, "section 2.4, G",
        f"6.6743·10⁻¹¹ {(lost := 'kg⁻² m⁻²')}",
        f"6.6743·10⁻¹¹ {(newtons := 'N m² kg⁻² = m³ kg⁻¹ s⁻²')}",
        "G M/r must be a squared speed whatever the metre, the kilogram and the second are: counted in centimetres, "
        "grams and minutes, in exact rationals.",
        "None: the curves do not depend on G.",
        (lost, newtons), ("m³ kg⁻² s⁻²", "N m² kg⁻¹"), _is_squared_speed,
    ),
    Erratum(
        THESIS, "before (1.39), after (1.42)",
        (small := "2 C² m = 1"), f"{(earth := '2 C² M = 1')}, with the mass of the Earth; (1.38) does not have m",
        "(1.38) and (1.39) are compared at two radii in exact rationals, with either constant.",
        "None: figures 14 and 15 rest on (1.42).",
        (small, earth), ("2 C² G M = 1", "C² M = 1"), _gives_139,
    ),
    Erratum(
        THESIS, "before (1.40)",
        f"K = {(product := '2 C² m')}", f"K = {(reciprocal := '1/(2 C² G M)')}; with it (1.40) and (1.41) are right",
        "(1.38) and (1.40) are compared at two radii in exact rationals, with either constant.",
        "None: (1.41) gives K by z0.",
        (product, reciprocal), ("1/(2 C² M)", "1/(2 C² G m)"), _gives_140,
    ),
    Erratum(
        THESIS, "(1.42)",
        (without_z := "(1 − z0) z² + z0 (1 − z0) + z0²"), (with_z := "(1 − z0) z² + z0 (1 − z0) z + z0²"),
        "Both are held against the proven motion for z0 = 1/4, by the conservation of energy and Bouguer's law.",
        "None that can be seen: as printed, Z = 0.2 would sweep 74.87° in figure 15, so that its program had the z.",
        (without_z, with_z), (with_z.replace("z0 (1 − z0) z", "z0 (1 + z0) z"), with_z.replace(") z +", ") z² +")),
        _is_the_slope,
    ),
    Erratum(
        THESIS, "list of figures, figure 14, and section 4.5",
        f"{COUNT[10]} parameters Z", f"{COUNT[9]}, from 0.1 to 0.9, as under the figure itself",
        "Of ten equally spaced from 0.1 to 0.9 none is the 0.2 that figure 15 continues; in exact rationals.",
        "None.", (10, 9), (8, 11), _is_how_many,
    ),
    Erratum(
        THESIS, "section 4.5, on figure 14, Z = 0.1",
        "its ends are “about on one straight line” through the origin, the curve is “rather straight”",
        f"they are {(between := '55')}° apart, 60° as Z falls to 0; “rather straight” is its beginning",
        "The proven angle from the release to the lowest point, rounded to a degree.",
        "The wording alone.",
        ("0", between), ("54", "56"), _is_the_angle_between_the_ends,
    ),
    Erratum(
        THESIS, "section 4.5, Z = 0.9",
        "the curve is a cycloid, as gravity is “approximately constant” there; a cycloid is π times as wide as it is "
        "deep",
        f"approximately one, as gravity is: {(width := '2.93')} times as wide, along the circle of the release",
        "The proven angle that the whole curve sweeps, over its depth.",
        "The wording alone: the cycloid is the limit as Z rises to 1, as the thesis says next.",
        ("3.14", width), ("2.92", "2.94"), _is_width_over_depth,
    ),
    Erratum(
        THESIS, "section 4.5, on figure 15, Z = 0.2",
        f"the end F is at {(read := '105')}°", f"it is at {(swept := '100.90')}°",
        "The proven angle that the whole curve sweeps.", "The 105° of the text.",
        (read, swept), ("100.89", "100.91"), _is_the_whole_angle,
    ),
)  # fmt: skip
