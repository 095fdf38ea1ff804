"""The thesis in a uniform field: the cycloid as a curve and as a motion, sections 1.1, 2.1 to 2.3, 2.5, 3.1 and 4.3."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from mpmath import mp

from compare.errata.erratum import THESIS, Erratum
from compare.errata.evidence import GRAVITY, along, exactly, near, precisely, proven, rates, rounds_to
from compare.methods.explicit import RK4, RK4_MISPRINTED
from compare.order import order_of_tableau
from reference.problems.cycloid import Tautochrone

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.method import Tableau

__all__ = ["CURVES", "are_rates", "force"]

RADIUS = 2
"""Of the rolling circle in m; other than 1, so that no power of it is hidden."""
BEAD = Tautochrone("2.5", radius=RADIUS, g=GRAVITY)
WHEN = "0.7"


def _falls(speed_squared: Callable[[Fraction, Fraction, Fraction], Fraction]) -> bool:
    """Whether v^2, of v0^2, y0 and y (downwards), is that of a free fall from y0 = 1 m at v0 = 2 m/s, after 1/2 s."""
    y0, v0, t = Fraction(1), Fraction(2), Fraction(1, 2)
    y, v = y0 + v0 * t + GRAVITY * t * t / 2, v0 + GRAVITY * t
    return speed_squared(v0 * v0, y0, y) == v * v


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
def _is_the_integral(left: Callable[[Any], Any]) -> bool:
    """Whether left, of theta, is the integral of (1.26) to y(theta), of sqrt(y/(2R - y)) with R = 1."""
    theta = mp.mpf(1)
    # y = s^2 makes the integrand analytic where the curve is vertical
    integral = mp.quad(lambda s: 2 * s * s / mp.sqrt(2 - s * s), [0, mp.sqrt(1 - mp.cos(theta))])
    return near(left(theta), integral)


@precisely
def _has_the_kinetic_energy(position: Callable[[Any], tuple[Any, Any]]) -> bool:
    """Whether a point there, as theta changes by 1 rad/s, has the energy (1.43) for 1 kg."""
    theta = mp.mpf(1)
    along_x, along_y = (mp.diff(lambda angle, axis=axis: position(angle)[axis], theta) for axis in (0, 1))
    energy = exactly("1/2") * RADIUS**2 * ((1 + mp.cos(theta)) ** 2 + mp.sin(theta) ** 2)
    return near((along_x**2 + along_y**2) / 2, energy)


@precisely
def _vanishes_along_the_motion(left: Callable[..., Any]) -> bool:
    """Whether left(theta, omega, omega', g/R) is zero at a proven state of the bead."""
    theta, omega = along(BEAD, WHEN)
    return near(left(theta, omega, rates(BEAD, WHEN)[1], exactly(str(GRAVITY / RADIUS))), mp.mpf(0))


def _momentum_rate(theta: Any, omega: Any, acceleration: Any) -> Any:
    """d((1 + cos theta) theta')/dt."""
    return (1 + mp.cos(theta)) * acceleration - mp.sin(theta) * omega**2


def _with_signs(sign: int) -> Callable[..., Any]:
    """(1.47), with one sign before both terms of force; (1.46) is it, multiplied by 2 m R^2."""
    return lambda theta, omega, acceleration, pull: (
        _momentum_rate(theta, omega, acceleration) + sign * (mp.sin(theta) * omega**2 / 2 + pull / 2 * mp.sin(theta))
    )


def _expanded(sign: int) -> Callable[..., Any]:
    """The line after (1.47)."""
    return lambda theta, omega, acceleration, pull: (
        (1 + mp.cos(theta)) * acceleration + sign * (mp.sin(theta) * omega**2 / 2 - pull / 2 * mp.sin(theta))
    )


@precisely
def are_rates(form: Callable[[Any, Any, Any], tuple[Any, Any]]) -> bool:
    """Whether form(theta, omega, g/R) is (omega', theta') at a proven state of the bead."""
    theta, omega = along(BEAD, WHEN)
    found = form(theta, omega, exactly(str(GRAVITY / RADIUS)))
    return all(near(a, b) for a, b in zip(found, reversed(rates(BEAD, WHEN)), strict=True))


def force(theta: Any, omega: Any, pull: Any) -> Any:
    """The numerator of (1.48)."""
    return mp.sin(theta) * omega**2 / 2 - pull / 2 * mp.sin(theta)


def _is_of_order_4(method: Tableau) -> bool:
    return order_of_tableau(method) == 4


@precisely
def _is_where_they_meet(text: str) -> bool:
    """Whether x = R (theta + sin theta) rounds to it, R = 1 m, a quarter of a period after the release."""
    bead = Tautochrone("2.5", radius=1, g=GRAVITY)
    theta = proven(bead, "state", Fraction(float(proven(bead, "descent_time")[0])))[0]
    return rounds_to(theta + mp.sin(theta), text)


AT_A_STATE = "Both are held against a proven state of the bead on a cycloid with R = 2 m, and its derivative."

CURVES = (
    Erratum(
        THESIS, "section 1.1",
        "light in layers of a medium whose density grows linearly",
        "its index falls like 1/√y, as the speed √(2gy) of (1.2) grows",
        "Snell's n sin α must be one number along the cycloid; sin α grows like √y, so no growing index makes it so.",
        "None.", (lambda y: 1 + y, lambda y: 1 / mp.sqrt(y)), _refracts,
    ),
    Erratum(
        THESIS, "(1.1)",
        "m g y0 + ½ m v0² = m g (−y) + ½ m v²", "m g (−y0) + ½ m v0² = m g (−y) + ½ m v², with y downwards",
        "Both are held against a free fall from y0 = 1 m at 2 m/s, in exact rationals.",
        "None: (1.2) and all that follows have y0 = 0.",
        (lambda v0v0, y0, y: v0v0 + 2 * GRAVITY * (y + y0), lambda v0v0, y0, y: v0v0 + 2 * GRAVITY * (y - y0)), _falls,
    ),
    Erratum(
        THESIS, "(1.20)",
        "(∂L/∂y') y' = (d/dx)(∂L/∂y') y'", "(∂L/∂y) y' = (d/dx)(∂L/∂y') y'",
        "Both left sides are held against the right one on the cycloid, differentiated with 50 digits.",
        "None: (1.21) follows from the right form.",
        (lambda _, by_slope, slope: by_slope * slope, lambda by_y, _, slope: by_y * slope),
        _multiplies_euler_and_lagrange,
    ),
    Erratum(
        THESIS, "(1.26)",
        "dx = ∫ √(y/(2R − y)) dy from 0 to y", "x = ∫ √(y/(2R − y)) dy from 0 to y",
        "The integral, done numerically, is held against x of the cycloid, and against a small difference of it.",
        "None.",
        (lambda theta: (1 - mp.cos(theta)) * exactly("1e-6"), lambda theta: theta - mp.sin(theta)), _is_the_integral,
    ),
    Erratum(
        THESIS, "before (1.43)",
        "x(θ) = θ + sin θ, y(θ) = 1 − cos θ", "x(θ) = R (θ + sin θ), y(θ) = R (1 − cos θ)",
        "The kinetic energy of a point there is held against (1.43), which is right, with R = 2 m.",
        "None: the listing has R = 1 m.",
        (lambda theta: (theta + mp.sin(theta), 1 - mp.cos(theta)),
         lambda theta: (RADIUS * (theta + mp.sin(theta)), RADIUS * (1 - mp.cos(theta)))), _has_the_kinetic_energy,
    ),
    Erratum(
        THESIS, "(1.46)",
        "d/dt[2 m R² (1 + cos θ) θ'] − [m R² sin θ θ'² + m g R sin θ] = 0",
        "d/dt[2 m R² (1 + cos θ) θ'] + [m R² sin θ θ'² + m g R sin θ] = 0",
        AT_A_STATE, "None: (1.48) and the listing have the right signs.",
        (_with_signs(-1), _with_signs(+1)), _vanishes_along_the_motion,
    ),
    Erratum(
        THESIS, "(1.47)",
        "d/dt[(1 + cos θ) θ'] − ½ sin θ θ'² − (g/2a) sin θ = 0",
        "d/dt[(1 + cos θ) θ'] + ½ sin θ θ'² + (g/2R) sin θ = 0; the a of (1.47) to (1.50) is R",
        AT_A_STATE, "None: (1.48) and the listing have the right signs.",
        (_with_signs(-1), _with_signs(+1)), _vanishes_along_the_motion,
    ),
    Erratum(
        THESIS, "after (1.47)",
        "(1 + cos θ) θ'' + ½ sin θ θ'² − (g/2a) sin θ = 0", "(1 + cos θ) θ'' − ½ sin θ θ'² + (g/2R) sin θ = 0",
        AT_A_STATE, "None: (1.48) and the listing have the right signs.",
        (_expanded(+1), _expanded(-1)), _vanishes_along_the_motion,
    ),
    Erratum(
        THESIS, "(1.50)",
        "the column ½ sin θ ω² − (g/2a) sin θ over 1 + cos θ, without a fraction and without the row for θ'",
        "the column of (½ sin θ ω² − (g/2R) sin θ)/(1 + cos θ) and ω",
        AT_A_STATE, "None: the listing computes both rows.",
        (lambda theta, omega, pull: (force(theta, omega, pull), 1 + mp.cos(theta)),
         lambda theta, omega, pull: (force(theta, omega, pull) / (1 + mp.cos(theta)), omega)), are_rates,
    ),
    Erratum(
        THESIS, "section 3.1, steps 2 and 3",
        "y0 + k1 h and y0 + k2 h", "y0 + k1 h/2 and y0 + k2 h/2",
        "The order conditions of both tables, by rooted trees in exact rationals: order 1 as printed, 4 as meant.",
        "None: both listings have h/2; as printed, their method would be of first order.",
        (RK4_MISPRINTED, RK4), _is_of_order_4,
    ),
    Erratum(
        THESIS, "list of figures, figure 11",
        "three particles arrive at x = 3.14 at once", "at x = 0, as under the figure itself",
        "The proven angle of a bead a quarter of a period after its release gives x.",
        "None: x = π is the cusp, above the start of every bead.",
        ("3.14", "0.00"), _is_where_they_meet,
    ),
)  # fmt: skip
