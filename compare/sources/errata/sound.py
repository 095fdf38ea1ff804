"""Printed formulas that the project's systems rest on: held against what the errata are, and found right."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from compare.sources.errata import report_series as series
from compare.sources.errata.evidence import GRAVITY, REPORT, THESIS, along, exactly, near, precisely, proven, rates
from compare.sources.errata.report_motion import SUBSTITUTED, is_velocity
from compare.sources.errata.spelled import spelled
from compare.sources.errata.thesis_curves import NUMERATOR, are_rates
from reference.arithmetic.precision import mp
from reference.problems.cycloid.tautochrone import Tautochrone
from reference.problems.descent.problem import Descent
from reference.problems.pendulum.problem import Pendulum
from reference.problems.polar.problem import PolarBrachistochrone

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
def _expands(text: str) -> bool:
    """Whether it is the integrand of (2.5) to the fifth power of phi0 = 1/1000."""
    phi0, theta = exactly("1/1000"), mp.mpf(1)
    integrand = 1 / mp.sqrt(1 - (mp.sin(phi0 / 2) * mp.sin(theta)) ** 2)
    return bool(abs(spelled(text, "φ0", "θ")(phi0, theta) - integrand) < phi0**6)


def _leaves_no_secular_term(text: str) -> bool:
    return series.third_order_vanishes(series.PHI_B, spelled(text, "ω", "φ_init")(Fraction(1), Fraction(1)))


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
def _is_abscissa(text: str) -> bool:
    """Whether it is x of the cycloid, y being cos theta - 1 as in the listing."""
    theta = mp.mpf(1)
    return near(spelled(text, "y")(mp.cos(theta) - 1), theta - mp.sin(theta))


@precisely
def _is_the_ranking(curves: tuple[str, ...]) -> bool:
    """Whether each is slower than the one before, by proven times of descent."""
    times = [proven(Descent(curve, g=GRAVITY), "descent_time")[0] for curve in curves]
    return all(first < second for first, second in pairwise(times))


@precisely
def _is_horizontal_speed(text: str) -> bool:
    """Whether it is |dx/dt| at this height on the cycloid of the race, R = 1 m, by the proven passage of its parts."""
    race = Descent("cycloid", g=GRAVITY)
    row = [quantity.name for quantity in race.row("passage").quantities]
    height, speed = row.index("passage_y"), row.index("passage_velocity_x")
    passages = [proven(race, "passage", Fraction(part)) for part in ("1/10", "1/2", "9/10")]
    form = spelled(text, "y", "g", "R")
    return all(near(form(one[height], exactly(str(GRAVITY)), 1), abs(one[speed])) for one in passages)


@precisely
def _is_the_time_of_every_descent(form: Callable[[Any], Any]) -> bool:
    """Whether, of the start's angle, it is the proven time to the bottom from each start of figure 13."""
    starts = ("3.13", "2.5", "2.0", "1.5")
    times = (proven(Tautochrone(start, radius=1, g=GRAVITY), "descent_time")[0] for start in starts)
    return all(near(form(exactly(start)), time) for start, time in zip(starts, times, strict=True))


def _quarter_period() -> Any:
    """pi sqrt(R/g)."""
    return mp.pi / mp.sqrt(exactly(str(GRAVITY)))


IN_THE_FIELD = "Held against a proven state of the motion for z0 = 1/4, and differences of proven states."

SOUND = (
    Sound(
        REPORT, "(2.2), (2.4)", f"φ' = {SUBSTITUTED}",
        "Held against the proven angular velocity of a pendulum of 2 m.",
        (SUBSTITUTED.replace("2g", "g"), SUBSTITUTED), is_velocity,
    ),
    Sound(
        REPORT, "(2.5)", "T = 4 √(l/g) ∫ dθ/√(1 − k² sin² θ) from 0 to π/2, k = sin(φ0/2)",
        "The integral, done numerically, is held against the proven period.",
        (lambda phi0: phi0 / 2, lambda phi0: mp.sin(phi0 / 2)), _is_elliptic,
    ),
    Sound(
        REPORT, "(2.6)", (expansion := "1 + φ0² sin² θ/8 + φ0⁴ (9 sin⁴ θ − 4 sin² θ)/384"),
        "Held against the integrand at φ0 = 1/1000, to the fifth power of it.",
        (expansion.replace("− 4", "− 3"), expansion), _expands,
    ),
    Sound(
        REPORT, "(2.7)", f"T = 2π √(l/g) ({(period := series.TO_THE_FOURTH.replace('y0', 'φ0'))})",
        series.PROVEN_PERIOD.replace("Both forms are held", "Held"),
        (period.replace("3072", "3071"), period), series.is_period,
    ),
    Sound(
        REPORT, "(4.11), right side", series.RIGHT_SIDE,
        "Held against φ_C'' + ω² φ_C of the right φ_C, differentiated with 50 digits.",
        (series.RIGHT_SIDE.replace("½", ""), series.RIGHT_SIDE), series.is_right_side,
    ),
    Sound(
        REPORT, "α, before (4.12)", f"α = {(alpha := '−ω² φ_init²/8')}", series.EXACT_SERIES,
        (alpha.replace("−", ""), alpha), _leaves_no_secular_term,
    ),
    Sound(
        REPORT, "(4.12), cos 3ωt", (third := "ω² φ_init⁵/384"), series.EXACT_SERIES,
        ((3, third.replace("384", "192")), (3, third)), series.is_forcing,
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
        THESIS, "(1.48), (1.49)", f"ω' = {(rate := f'({NUMERATOR})/(1 + cos θ)')}, θ' = ω, where a is R",
        "Held against a proven state of the bead on a cycloid with R = 2 m, and its derivative.",
        ((rate.replace("½", "−½"), "ω"), (rate, "ω")), are_rates,
    ),
    Sound(
        THESIS, "section 3.1, listing", f"x = {(abscissa := 'acos(1 + y) − √(y (−2 − y))')}",
        "Held against x and y of the cycloid by its angle.",
        (abscissa.replace(") −", ") +"), abscissa), _is_abscissa,
    ),
    Sound(
        THESIS, "section 4.1, on figure 8", "the cycloid is first, the polynomial of degree 4 second, the line last",
        "The proven times are 1.0030 s, 1.0156 s and 1.1890 s with y = 2 (x/π)⁴, as the thesis gives no coefficients; "
        "a quarter of an ellipse, in 1.0068 s, and a circular arc, in 1.0149 s, would be faster than that polynomial.",
        (("cycloid", "quartic", "quarter_ellipse"), ("cycloid", "quartic", "line")), _is_the_ranking,
    ),
    Sound(
        THESIS, "section 4.1, on figure 10",
        f"on the cycloid v_x depends linearly on the height y: {(linear := '√(g/R) (2R − y)')}",
        "The proven horizontal speed at three points of the way from (π, 2) m; the formula is ours.",
        (linear.replace("(2R − y)", "√(y (2R − y))"), linear), _is_horizontal_speed,
    ),
    Sound(
        THESIS, "section 4.3, on figures 11 to 13",
        "bodies from all starts are at the bottom at the same time, π √(R/g)",
        "The proven times from θ0 = 3.13, 2.5, 2.0 and 1.5 rad; those of a circular pendulum would grow with θ0.",
        (lambda theta0: _quarter_period() * (1 + theta0**2 / 16), lambda _: _quarter_period()),
        _is_the_time_of_every_descent,
    ),
)  # fmt: skip
