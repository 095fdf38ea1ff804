"""Printed formulas that the project's systems rest on: held against what the errata are, and found right."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from mpmath import mp

from compare.errata import report_series as series
from compare.errata.erratum import REPORT, THESIS
from compare.errata.evidence import GRAVITY, along, exactly, near, precisely, proven, rates
from compare.errata.report_motion import is_slowness
from compare.errata.thesis_curves import are_rates, force
from reference.problems.descent import Descent
from reference.problems.pendulum import Pendulum
from reference.problems.polar import PolarBrachistochrone

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOUND", "Sound"]


@dataclass(frozen=True)
class Sound:
    """A printed formula that is right.

    Attributes:
        source, place: as of an erratum.
        printed: what stands there.
        how: how it was checked, in a sentence.
        forms: a form with one slip, which shows what the test can see, and the printed form.
        holds: the test of a form.
    """

    source: str
    place: str
    printed: str
    how: str
    forms: tuple[Any, Any]
    holds: Callable[[Any], bool]

    def confirmed(self) -> bool:
        """Whether the printed form passes the test and the one with a slip fails it."""
        slip, printed = self.forms
        return self.holds(printed) and not self.holds(slip)


DEEP = PolarBrachistochrone("0.25")
Z0 = Fraction(1, 4)


@precisely
def _is_elliptic(modulus: Callable[[Any], Any]) -> bool:
    """Whether the integral of (2.5) with k = modulus(phi0) gives the proven period."""
    k = modulus(mp.mpf(1))
    integral = mp.quad(lambda theta: 1 / mp.sqrt(1 - (k * mp.sin(theta)) ** 2), [0, mp.pi / 2])
    period = proven(Pendulum("1", g=GRAVITY, length=2), "period")[0]
    return near(4 * mp.sqrt(2 / exactly(str(GRAVITY))) * integral, period)


@precisely
def _expands(form: Callable[[Any, Any], Any]) -> bool:
    """Whether form(phi0, sin theta) is the integrand of (2.5) to the fifth power of phi0 = 1/1000."""
    phi0, sine = exactly("1/1000"), mp.sin(1)
    integrand = 1 / mp.sqrt(1 - (mp.sin(phi0 / 2) * sine) ** 2)
    return bool(abs(form(phi0, sine) - integrand) < phi0**6)


def _leaves_no_secular_term(alpha: Fraction) -> bool:
    return series.third_order_vanishes(series.PHI_B, alpha)


@precisely
def _is_diameter(form: Callable[[Any, Any], Any]) -> bool:
    """Whether form(g, C^2) is 2 R on a cycloid with R = 3 m, C being Beltrami's constant, by differentiation."""
    g, theta, radius = exactly(str(GRAVITY)), mp.mpf(1), 3
    y, slope = radius * (1 - mp.cos(theta)), mp.sin(theta) / (1 - mp.cos(theta))

    def lagrangian(p: Any) -> Any:
        return mp.sqrt((1 + p * p) / (2 * g * y))

    beltrami = lagrangian(slope) - slope * mp.diff(lagrangian, slope)
    return near(form(g, beltrami**2), 2 * radius)


@precisely
def _is_speed(form: Callable[[Any], Any]) -> bool:
    """Whether v^2, of r/r0 and in units of 2 G M/r0, is that of the proven motion."""
    (z, _, _), (z_rate, _, turn) = along(DEEP, "0.5"), rates(DEEP, "0.5")
    return near(z_rate**2 + (z * turn) ** 2, form(z))


@precisely
def _is_slope_of_beltrami(form: Callable[[Any, Any, Any], Any]) -> bool:
    """Whether form(r, r0, 2 C^2 G M) is r'^2, C being (1.37) for that r', differentiated numerically."""
    r, r0, slope, work = mp.mpf(2), mp.mpf(3), mp.mpf("0.7"), mp.mpf(5)

    def lagrangian(p: Any) -> Any:
        return mp.sqrt(r0 * r * (r * r + p * p) / (work * (r0 - r)))

    beltrami = lagrangian(slope) - slope * mp.diff(lagrangian, slope)
    return near(form(r, r0, beltrami**2 * work), slope**2)


@precisely
def _is_constant_of_140(form: Callable[[Any], Any]) -> bool:
    """Whether (1.40) with K r0^3 = form(z0) is dphi/dz of the proven motion."""
    (z, _, _), (z_rate, _, turn) = along(DEEP, "0.5"), rates(DEEP, "0.5")
    slope = mp.sqrt((1 - z) / (form(exactly(str(Z0))) * z**3 - 1 + z)) / z
    return near(slope, -turn / z_rate)


@precisely
def _is_abscissa(form: Callable[[Any], Any]) -> bool:
    """Whether form(y) is x of the cycloid, y being cos theta - 1 as in the listing."""
    theta = mp.mpf(1)
    return near(form(mp.cos(theta) - 1), theta - mp.sin(theta))


@precisely
def _is_the_ranking(curves: tuple[str, ...]) -> bool:
    """Whether each is slower than the one before, by proven times of descent."""
    times = [proven(Descent(curve, g=GRAVITY), "descent_time")[0] for curve in curves]
    return all(first < second for first, second in pairwise(times))


IN_THE_FIELD = "Held against a proven state of the motion for z0 = 1/4, and differences of proven states."

SOUND = (
    Sound(
        REPORT, "(2.2), (2.4)", "φ' = √(2g/l) √(cos φ − cos φ0)",
        "Held against the proven angular velocity of a pendulum of 2 m.",
        (lambda drop, factor: 1 / mp.sqrt(factor / 2 * drop), lambda drop, factor: 1 / mp.sqrt(factor * drop)),
        is_slowness,
    ),
    Sound(
        REPORT, "(2.5)", "T = 4 √(l/g) ∫ dθ/√(1 − k² sin² θ) from 0 to π/2, k = sin(φ0/2)",
        "The integral, done numerically, is held against the proven period.",
        (lambda phi0: phi0 / 2, lambda phi0: mp.sin(phi0 / 2)), _is_elliptic,
    ),
    Sound(
        REPORT, "(2.6)", "1 + φ0² sin² θ/8 + φ0⁴ (9 sin⁴ θ − 4 sin² θ)/384",
        "Held against the integrand at φ0 = 1/1000, to the fifth power of it.",
        (lambda a, s: 1 + a**2 * s**2 / 8 + a**4 * 9 * s**4 / 384,
         lambda a, s: 1 + a**2 * s**2 / 8 + a**4 * (9 * s**4 - 4 * s**2) / 384), _expands,
    ),
    Sound(
        REPORT, "(2.7)", "T = 2π √(l/g) (1 + φ0²/16 + 11 φ0⁴/3072)",
        series.PROVEN_PERIOD.replace("Both forms are held", "Held"),
        (lambda a: 1 + a**2 / 16 + 11 * a**4 / 3071, lambda a: 1 + a**2 / 16 + 11 * a**4 / 3072), series.is_period,
    ),
    Sound(
        REPORT, "α, before (4.12)", "α = −ω² φ_init²/8", series.EXACT_SERIES,
        (Fraction(1, 8), Fraction(-1, 8)), _leaves_no_secular_term,
    ),
    Sound(
        REPORT, "(4.12), cos 3ωt", "ω² φ_init⁵/384", series.EXACT_SERIES,
        ({3: Fraction(1, 192)}, {3: Fraction(1, 384)}), series.is_forcing,
    ),
    Sound(
        THESIS, "(1.24)", "y (1 + y'²) = 1/(2 g C²) = 2 R",
        "C is found on a cycloid with R = 3 m from (1.23), differentiated with 50 digits.",
        (lambda g, c_squared: 1 / (g * c_squared), lambda g, c_squared: 1 / (2 * g * c_squared)), _is_diameter,
    ),
    Sound(
        THESIS, "(1.33)", "v = √(2 G M (1/r − 1/r0))", IN_THE_FIELD,
        (lambda z: 2 * (1 / z - 1), lambda z: 1 / z - 1), _is_speed,
    ),
    Sound(
        THESIS, "(1.38)", "r'² = (r0 r⁵ − 2 C² G M (r0 − r) r²)/(2 C² G M (r0 − r))",
        "C is found from (1.36) by Beltrami's identity, differentiated with 50 digits.",
        (lambda r, r0, work: (r0 * r**5 + work * (r0 - r) * r * r) / (work * (r0 - r)),
         lambda r, r0, work: (r0 * r**5 - work * (r0 - r) * r * r) / (work * (r0 - r))), _is_slope_of_beltrami,
    ),
    Sound(
        THESIS, "(1.40), (1.41)", "dφ/dr = (1/r) √((1 − r/r0)/(K r³ − 1 + r/r0)), K = r0⁻³ (z0⁻³ − z0⁻²)",
        IN_THE_FIELD, (lambda z0: z0**-3 + z0**-2, lambda z0: z0**-3 - z0**-2), _is_constant_of_140,
    ),
    Sound(
        THESIS, "(1.48), (1.49)", "ω' = (½ sin θ ω² − (g/2a) sin θ)/(1 + cos θ), θ' = ω, where a is R",
        "Held against a proven state of the bead on a cycloid with R = 2 m, and its derivative.",
        (lambda theta, omega, pull: (-force(theta, omega, pull) / (1 + mp.cos(theta)), omega),
         lambda theta, omega, pull: (force(theta, omega, pull) / (1 + mp.cos(theta)), omega)), are_rates,
    ),
    Sound(
        THESIS, "section 3.1, listing", "x = acos(1 + y) − √(y (−2 − y))",
        "Held against x and y of the cycloid by its angle.",
        (lambda y: mp.acos(1 + y) + mp.sqrt(y * (-2 - y)), lambda y: mp.acos(1 + y) - mp.sqrt(y * (-2 - y))),
        _is_abscissa,
    ),
    Sound(
        THESIS, "section 4.1, on figure 8", "the cycloid is first, the polynomial of degree 4 second, the line last",
        "The proven times are 1.0030 s, 1.0156 s and 1.1890 s with y = 2 (x/π)⁴, as the thesis gives no coefficients; "
        "a quarter of an ellipse, in 1.0068 s, and a circular arc, in 1.0149 s, would be faster than that polynomial.",
        (("cycloid", "quartic", "quarter_ellipse"), ("cycloid", "quartic", "line")), _is_the_ranking,
    ),
)  # fmt: skip
