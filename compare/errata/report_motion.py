"""The report's equations of motion, its energy, its methods: sections 2, 3 and 4.1."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from mpmath import mp

from compare.errata.erratum import REPORT, Erratum
from compare.errata.evidence import GRAVITY, along, exactly, near, precisely
from reference.problems.pendulum import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["MOTION", "is_slowness"]

LENGTH = 2
"""In m; other than the report's 1 m, so that no power of it is hidden."""
LONGER = Pendulum("1", g=GRAVITY, length=LENGTH)
OF_THE_REPORT = Pendulum("1", g=GRAVITY, length=1)


@precisely
def is_slowness(form: Callable[[Any, Any], Any]) -> bool:
    """Whether dt/dphi, of cos phi - cos phi0 and 2 g/l, is the reciprocal of the proven angular velocity."""
    angle, velocity = along(LONGER, "0.3")
    return near(form(mp.cos(angle) - mp.cos(1), 2 * exactly(str(GRAVITY)) / LENGTH), -1 / velocity)


@precisely
def _leads_to_the_elliptic_integral(theta: Callable[[Any, Any], Any]) -> bool:
    """Whether theta(phi, phi0) is pi/2 at phi0, and turns dt into sqrt(l/g) dtheta/sqrt(1 - k^2 sin^2 theta)."""
    phi0 = mp.mpf(1)
    angle, velocity = along(LONGER, "0.3")
    slope = mp.diff(lambda phi: theta(phi, phi0), angle)
    root = mp.sqrt(1 - (mp.sin(phi0 / 2) * mp.sin(theta(angle, phi0))) ** 2)
    slowness = mp.sqrt(LENGTH / exactly(str(GRAVITY))) * slope / root
    return near(theta(phi0, phi0), mp.pi / 2) and near(slowness, -1 / velocity)


@precisely
def _is_the_motions_start(t: str) -> bool:
    return along(OF_THE_REPORT, t) == (1, 0)


@precisely
def _is_energy(form: Callable[[Any, Any, Any], Any]) -> bool:
    """Whether it is m v^2/2 + m g h for 1 kg, with the speed and the height of the bob, up to a constant."""
    angle, velocity = along(LONGER, "0.3")
    g = exactly(str(GRAVITY))
    along_x, along_y = LENGTH * mp.cos(angle) * velocity, LENGTH * mp.sin(angle) * velocity
    above_rest = (along_x**2 + along_y**2) / 2 + g * (LENGTH - LENGTH * mp.cos(angle))
    return near(form(angle, velocity, g) - form(mp.mpf(0), mp.mpf(0), g), above_rest)


def _stages(increment: Callable[[Fraction], Fraction]) -> Callable[[Fraction], Fraction]:
    """One step of Kutta's method for y' = y from y = 1; ``increment`` is what the sum of slopes is multiplied by."""

    def step(h: Fraction) -> Fraction:
        k1 = Fraction(1)
        k2 = 1 + h * k1 / 2
        k3 = 1 + h * k2 / 2
        k4 = 1 + h * k3
        return 1 + increment(h) * (k1 + 2 * k2 + 2 * k3 + k4)

    return step


@precisely
def _is_exponential(step: Callable[[Fraction], Fraction]) -> bool:
    """Whether a step of 1/100 is exp(1/100) to its fourth power."""
    h = Fraction(1, 100)
    return bool(abs(exactly(str(step(h))) - mp.exp(exactly(str(h)))) < exactly(str(h**5)))


@precisely
def _is_invariant(form: Callable[[Any, Any, Any], Any]) -> bool:
    """Whether it keeps its value along the proven motion, and changes off it, so that it can be projected on."""
    g = exactly(str(GRAVITY))
    (y, v), (later, then) = along(OF_THE_REPORT, "0.3"), along(OF_THE_REPORT, "0.9")
    return near(form(y, v, g), form(later, then, g)) and not near(form(y, v, g), form(y, 2 * v, g))


def _is_acceleration(units: tuple[int, int]) -> bool:
    """Whether sqrt(l/g) is in seconds, where g is in these powers of metre and second."""
    metres, seconds = units
    return (1 - metres, -seconds) == (0, 2)


def _per_square_of_length(y: Any, v: Any, g: Any) -> Any:
    return v * v / 2 - g / LENGTH * mp.cos(y)


MOTION = (
    Erratum(
        REPORT, "(2.3)",
        "dt = dφ/√((2g/l) √(cos φ − cos φ0)), one root in the other",
        "dt = dφ/(√(2g/l) √(cos φ − cos φ0)), as in (2.2) and (2.4)",
        "Both are held against the proven angular velocity of a pendulum of 2 m.", "None: (2.4) is right.",
        (lambda drop, factor: 1 / mp.sqrt(factor * mp.sqrt(drop)),
         lambda drop, factor: 1 / (mp.sqrt(factor) * mp.sqrt(drop))), is_slowness,
    ),
    Erratum(
        REPORT, "before (2.5)",
        "the substitution θ = φ/2", "the substitution sin(φ/2) = k sin θ, k = sin(φ0/2)",
        "Only a substitution that takes φ0 to π/2 and the proven angular velocity to the integrand of (2.5) is right.",
        "None: (2.5) and its limits are right.",
        (lambda phi, _: phi / 2, lambda phi, phi0: mp.asin(mp.sin(phi / 2) / mp.sin(phi0 / 2))),
        _leads_to_the_elliptic_integral,
    ),
    Erratum(
        REPORT, "section 3",
        "1 s ≤ t ≤ 10 s", "0 s ≤ t ≤ 10 s, as in listing 1 and table 8",
        "The proven angle is 1 rad and the velocity zero at the start of the interval.", "None.",
        ("1", "0"), _is_the_motions_start,
    ),
    Erratum(
        REPORT, "(3.2), (3.3), (3.5)",
        "E = ½ m y'² − (g/l) m cos y",
        "E = ½ m l² y'² − m g l cos y; what is printed is E/l², conserved too, and the energy where l = 1 m",
        "Both are held against ½ m v² + m g h of the bob, at a proven state of a pendulum of 2 m.",
        "None: l = 1 m throughout, so table 8 and figures 4 and 7 stand.",
        (_per_square_of_length, lambda y, v, g: LENGTH**2 * _per_square_of_length(y, v, g)), _is_energy,
    ),
    Erratum(
        REPORT, "section 3.2, Runge–Kutta of order 4",
        "y_{n+1} = y_n + (K1 + 2 K2 + 2 K3 + K4)/6", "y_{n+1} = y_n + h (K1 + 2 K2 + 2 K3 + K4)/6",
        "A step for y' = y in exact rationals is held against the exponential function.",
        "None: the computations used Mathematica's methods.",
        (_stages(lambda _: Fraction(1, 6)), _stages(lambda h: h / 6)), _is_exponential,
    ),
    Erratum(
        REPORT, "section 3.2, listing of Projection",
        '"Invariants" -> -g/l*Cos[poc], a constant', '"Invariants" -> y\'[t]^2/2 - g/l*Cos[y[t]]',
        "An invariant to project on keeps its value along the proven motion and changes off it; a constant never does.",
        "Column Projection of table 8: a constant leaves nothing to project on.",
        (lambda _y, _v, g: -g * mp.cos(1), lambda y, v, g: v * v / 2 - g * mp.cos(y)), _is_invariant,
    ),
    Erratum(
        REPORT, "(4.17)",
        "g = 9.81 m² s⁻¹", "g = 9.81 m s⁻²",
        "√(l/g) must be a time.", "None.", ((2, -1), (1, -2)), _is_acceleration,
    ),
)  # fmt: skip
