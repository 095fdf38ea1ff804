"""The thesis in a uniform field: the cycloid as a curve and as a motion, sections 1.1, 2.1 to 2.3, 2.5, 3.1 and 4.3."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from compare.methods.explicit import RK4, RK4_MISPRINTED
from compare.methods.order.algebraic import Q
from compare.methods.order.conditions import order_of_tableau
from compare.sources.errata.evidence import (
    GRAVITY,
    THESIS,
    Erratum,
    along,
    exactly,
    near,
    precisely,
    proven,
    rates,
    rounds_to,
)
from compare.sources.errata.spelled import spelled
from compare.sources.published.curve import listed_error
from compare.sources.published.source import tables
from reference.arithmetic.precision import mp
from reference.problems.cycloid.tautochrone import Tautochrone

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.methods.kinds.one_step import Tableau

__all__ = ["CURVES", "NUMERATOR", "are_rates"]

RADIUS = 2
"""Of the rolling circle in m; other than 1, so that no power of it is hidden."""
BEAD = Tautochrone("2.5", radius=RADIUS, g=GRAVITY)
WHEN = "0.7"


def _falls(equation: str) -> bool:
    """Whether it holds in a free fall from y0 = 1 m at v0 = 2 m/s, y downwards, after 1/2 s."""
    mass, y0, v0, t = Fraction(3), Fraction(1), Fraction(2), Fraction(1, 2)
    y, v = y0 + v0 * t + GRAVITY * t * t / 2, v0 + GRAVITY * t
    return bool(spelled(equation, "m", "g", "y0", "v0", "y", "v")(mass, GRAVITY, y0, v0, y, v) == 0)


@precisely
def _refracts(index: Callable[[Any], Any]) -> bool:
    """Whether n(y) sin(alpha) is one number along the cycloid, alpha being the angle from the vertical."""
    bent = []
    for theta in (mp.mpf(1), mp.mpf(2)):
        across, down = 1 - mp.cos(theta), mp.sin(theta)
        bent.append(index(across) * across / mp.hypot(across, down))
    return near(bent[0], bent[1])


@precisely
def _multiplies_euler_and_lagrange(left: Callable[[Any, Any, Any], Any]) -> bool:
    """Whether left, of dL/dy, dL/dy' and y', is d(dL/dy')/dx y' on the cycloid, L = sqrt((1 + y'^2)/y)."""

    def slope(theta: Any) -> Any:
        return mp.sin(theta) / (1 - mp.cos(theta))

    def by_slope(theta: Any) -> Any:
        return slope(theta) / mp.sqrt((1 + slope(theta) ** 2) * (1 - mp.cos(theta)))

    theta = mp.mpf(1)
    y, p = 1 - mp.cos(theta), slope(theta)
    by_y = -mp.sqrt((1 + p * p) / y) / (2 * y)
    return near(left(by_y, by_slope(theta), p), mp.diff(by_slope, theta) / y * p)


@precisely
def _is_the_integral(equation: str) -> bool:
    """Whether x, or dx, of the cycloid is what stands right; a differential equals no integral between limits.

    So both sides must have as many d's as integral signs take away; then their values are compared.
    """
    left, right = equation.split(" = ")
    integrand, _, _ = right.removeprefix("∫ ").partition(" dy")
    integrated = right.startswith("∫")
    if left.startswith("d") == integrated:
        return False
    theta, radius = mp.mpf(1), 3
    slope = spelled(integrand, "R", "y")
    y = radius * (1 - mp.cos(theta))
    if not integrated:
        return near(slope(radius, y), mp.tan(theta / 2))
    # y = s^2 makes the integrand analytic where the curve is vertical
    found = mp.quad(lambda s: 2 * s * slope(radius, s * s), [0, mp.sqrt(y)])
    return near(found, radius * (theta - mp.sin(theta)))


@precisely
def _has_the_kinetic_energy(position: tuple[str, str]) -> bool:
    """Whether a point there, as theta changes by 1 rad/s, has the energy (1.43) for 1 kg."""
    theta = mp.mpf(1)
    x, y = (mp.diff(partial(spelled(text, "R", "θ"), RADIUS), theta) for text in position)
    energy = exactly("1/2") * RADIUS**2 * ((1 + mp.cos(theta)) ** 2 + mp.sin(theta) ** 2)
    return near((x**2 + y**2) / 2, energy)


@precisely
def _vanishes_along_the_motion(equation: str) -> bool:
    """Whether it holds at a proven state of the bead; d/dt[...] is differentiated by the product rule."""
    theta, omega = along(BEAD, WHEN)
    acceleration = rates(BEAD, WHEN)[1]
    momentum_rate = (1 + mp.cos(theta)) * acceleration - mp.sin(theta) * omega**2
    by_rate = equation.replace("d/dt[", "(").replace("(1 + cos θ) θ'", "P") if "d/dt" in equation else equation
    names = "P", "θ''", "θ'", "θ", "g", "m", "R", "a"
    values = momentum_rate, acceleration, omega, theta, exactly(str(GRAVITY)), 3, RADIUS, RADIUS
    return near(spelled(by_rate, *names)(*values), mp.mpf(0))


@precisely
def are_rates(column: tuple[str, str]) -> bool:
    """Whether they are (omega', theta') at a proven state of the bead."""
    theta, omega = along(BEAD, WHEN)
    values = theta, omega, exactly(str(GRAVITY)), RADIUS, RADIUS
    found = [spelled(text, "θ", "ω", "g", "R", "a")(*values) for text in column]
    return all(near(a, b) for a, b in zip(found, reversed(rates(BEAD, WHEN)), strict=True))


def _is_of_order_4(method: Tableau) -> bool:
    return order_of_tableau(method) == 4


@precisely
def _is_where_they_meet(text: str) -> bool:
    """Whether x = R (theta + sin theta) rounds to it, R = 1 m, a quarter of a period after the release."""
    bead = Tautochrone("2.5", radius=1, g=GRAVITY)
    theta = proven(bead, "state", Fraction(float(proven(bead, "descent_time")[0])))[0]
    return rounds_to(theta + mp.sin(theta), text)


@precisely
def _is_how_the_error_goes(sign: int) -> bool:
    """Whether the error of the thesis' listing changes so from each number of steps of figure 7 to the next."""
    table = next(one for one in tables() if one.name == "figure7")
    angle, depth = (float(table.parameters[name]) for name in ("angle", "depth"))
    errors = [listed_error(angle, depth, int(n)) for n in table.rows]
    return all(mp.sign(after - before) == sign for before, after in pairwise(errors))


HALF_MISPRINTED = replace(RK4_MISPRINTED, name="rk4 with k2 h", a=((), (Q(1, 2),), (Q(0), Q(1)), (Q(0), Q(0), Q(1))))
"""As if one step of the two were right."""
AT_A_STATE = "Both are held against a proven state of the bead on a cycloid with R = 2 m, and its derivative."
RIGHT_SIGNS = "None: (1.48) and the listing have the right signs."
NUMERATOR = "½ sin θ ω² − (g/2a) sin θ"
RATE = "(½ sin θ ω² − (g/2R) sin θ)/(1 + cos θ)"

CURVES = (
    Erratum(
        THESIS, "section 1.1",
        "light in layers of a medium whose density grows linearly",
        "its index falls like 1/√y, as the speed √(2gy) of (1.2) grows",
        "Snell's n sin α must be one number along the cycloid; sin α grows like √y, so no growing index makes it so.",
        "None.", (lambda y: 1 + y, lambda y: 1 / mp.sqrt(y)), (lambda y: 1 / y, mp.sqrt), _refracts,
    ),
    Erratum(
        THESIS, "(1.1)",
        (upwards := "m g y0 + ½ m v0² = m g (−y) + ½ m v²"),
        f"{(downwards := 'm g (−y0) + ½ m v0² = m g (−y) + ½ m v²')}, with y downwards",
        "Both are held against a free fall from y0 = 1 m at 2 m/s, in exact rationals.",
        "None: (1.2) and all that follows have y0 = 0.",
        (upwards, downwards),
        ("m g (−y0) + ½ m v0² = m g (−y) + m v²", "m g y0 + ½ m v0² = m g y + ½ m v²"), _falls,
    ),
    Erratum(
        THESIS, "(1.20)",
        "(∂L/∂y') y' = (d/dx)(∂L/∂y') y'", "(∂L/∂y) y' = (d/dx)(∂L/∂y') y'",
        "Both left sides are held against the right one on the cycloid, differentiated with 50 digits.",
        "None: (1.21) follows from the right form.",
        (lambda _, by_slope, slope: by_slope * slope, lambda by_y, _, slope: by_y * slope),
        (lambda by_y, *_: by_y, lambda by_y, _, slope: -by_y * slope), _multiplies_euler_and_lagrange,
    ),
    Erratum(
        THESIS, "(1.26)",
        f"{(differential := 'dx = ∫ √(y/(2R − y)) dy')} from 0 to y",
        f"{(whole := 'x = ∫ √(y/(2R − y)) dy')} from 0 to y",
        "A differential equals no integral between limits; then the integral, done numerically, is held against x of "
        "the cycloid with R = 3 m.",
        "None: (1.28) has x.",
        (differential, whole), ("x = ∫ √(y/(R − y)) dy", "x = √(y/(2R − y)) dy", "dx = √(y/(R − y)) dy"),
        _is_the_integral,
    ),
    Erratum(
        THESIS, "before (1.43)",
        "x(θ) = θ + sin θ, y(θ) = 1 − cos θ", "x(θ) = R (θ + sin θ), y(θ) = R (1 − cos θ)",
        "The kinetic energy of a point there is held against (1.43), which is right, with R = 2 m.",
        "None: the listing has R = 1 m.",
        (("θ + sin θ", "1 − cos θ"), ("R (θ + sin θ)", "R (1 − cos θ)")),
        (("R (θ + sin θ)", "1 − cos θ"), ("R (θ − sin θ)", "R (1 − cos θ)")), _has_the_kinetic_energy,
    ),
    Erratum(
        THESIS, "(1.46)",
        (minus := "d/dt[2 m R² (1 + cos θ) θ'] − [m R² sin θ θ'² + m g R sin θ] = 0"),
        (both := "d/dt[2 m R² (1 + cos θ) θ'] + [m R² sin θ θ'² + m g R sin θ] = 0"),
        AT_A_STATE, RIGHT_SIGNS,
        (minus, both), (both.replace("² + m g", "² − m g"), both.replace("2 m R²", "m R²")),
        _vanishes_along_the_motion,
    ),
    Erratum(
        THESIS, "(1.47)",
        (divided := "d/dt[(1 + cos θ) θ'] − ½ sin θ θ'² − (g/2a) sin θ = 0"),
        f"{(divided_right := divided.replace('−', '+').replace('2a', '2R'))}; the a of (1.47) to (1.50) is R",
        AT_A_STATE, RIGHT_SIGNS,
        (divided, divided_right), (divided_right.replace("+ (g", "− (g"), divided_right.replace("½ ", "")),
        _vanishes_along_the_motion,
    ),
    Erratum(
        THESIS, "after (1.47)",
        (expanded := "(1 + cos θ) θ'' + ½ sin θ θ'² − (g/2a) sin θ = 0"),
        (expanded_right := "(1 + cos θ) θ'' − ½ sin θ θ'² + (g/2R) sin θ = 0"),
        AT_A_STATE, RIGHT_SIGNS,
        (expanded, expanded_right), (expanded.replace("− (g", "+ (g"), expanded_right.replace("½ ", "")),
        _vanishes_along_the_motion,
    ),
    Erratum(
        THESIS, "(1.50)",
        f"the column {NUMERATOR} over 1 + cos θ, without a fraction and without the row for θ'",
        f"the column of {RATE} and ω",
        AT_A_STATE, "None: the listing computes both rows.",
        ((NUMERATOR, "1 + cos θ"), (RATE, "ω")), ((NUMERATOR, "ω"), (RATE, "1 + cos θ")), are_rates,
    ),
    Erratum(
        THESIS, "section 3.1, on the deviation",
        "the small deviation that is always there “accumulates with the increase of the number of steps N”",
        "it adds up over the steps that are done; with more steps over the same piece it falls, as figure 7 shows and "
        "the text beside it says (“the error is larger for smaller N”)",
        "The errors of the listing at the five N of figure 7, from each to the next.",
        "The wording alone, if N steps that are done are meant.",
        (+1, -1), (0,), _is_how_the_error_goes,
    ),
    Erratum(
        THESIS, "section 3.1, steps 2 and 3",
        "y0 + k1 h and y0 + k2 h", "y0 + k1 h/2 and y0 + k2 h/2",
        "The order conditions of both tables, by rooted trees in exact rationals: order 1 as printed, 4 as meant.",
        "None: both listings have h/2; as printed, their method would be of first order.",
        (RK4_MISPRINTED, RK4), (HALF_MISPRINTED,), _is_of_order_4,
    ),
    Erratum(
        THESIS, "list of figures, figure 11",
        f"three particles arrive at x = {(cusp := '3.14')} at once",
        f"at x = {(bottom := '0.00').rstrip('.0') or '0'}, as under the figure itself",
        "The proven angle of a bead a quarter of a period after its release gives x.",
        "None: x = π is the cusp, above the start of every bead.",
        (cusp, bottom), ("0.01", "-0.01"), _is_where_they_meet,
    ),
)  # fmt: skip
