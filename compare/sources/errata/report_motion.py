"""The report's equations of motion, its energy, its methods: sections 2, 3 and 4.1."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.sources.errata.evidence import GRAVITY, REPORT, Erratum, along, exactly, near, precisely, proven
from compare.sources.errata.spelled import spelled
from reference.arithmetic.precision import mp
from reference.problems.pendulum.problem import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["MOTION", "SUBSTITUTED", "is_velocity"]

LENGTH = 2
"""In m; other than the report's 1 m, so that no power of it is hidden."""
LONGER = Pendulum("1", g=GRAVITY, length=LENGTH)
OF_THE_REPORT = Pendulum("1", g=GRAVITY, length=1)


@precisely
def is_velocity(text: str) -> bool:
    """Whether it is the size of the proven angular velocity."""
    angle, velocity = along(LONGER, "0.3")
    form = spelled(text, "φ", "φ0", "g", "l")
    return near(form(angle, mp.mpf(1), exactly(str(GRAVITY)), LENGTH), -velocity)


@precisely
def _is_time(text: str) -> bool:
    """Whether dt, for dφ = 1, is the reciprocal of the proven angular velocity."""
    angle, velocity = along(LONGER, "0.3")
    form = spelled(text, "dφ", "φ", "φ0", "g", "l")
    return near(form(1, angle, mp.mpf(1), exactly(str(GRAVITY)), LENGTH), -1 / velocity)


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
def _is_energy(text: str) -> bool:
    """Whether it is m v^2/2 + m g h, with the speed and the height of the bob, up to a constant."""
    angle, velocity = along(LONGER, "0.3")
    g, mass = exactly(str(GRAVITY)), 3
    along_x, along_y = LENGTH * mp.cos(angle) * velocity, LENGTH * mp.sin(angle) * velocity
    above_rest = mass * ((along_x**2 + along_y**2) / 2 + g * (LENGTH - LENGTH * mp.cos(angle)))
    form = spelled(text, "y", "y'", "g", "l", "m")
    found = form(angle, velocity, g, LENGTH, mass) - form(mp.mpf(0), mp.mpf(0), g, LENGTH, mass)
    return near(found, above_rest)


@precisely
def _is_exponential(text: str) -> bool:
    """Whether Kutta's stages for y' = y, and this for y_{n+1}, make exp(1/100) of 1 to the fourth power of the step."""
    h = Fraction(1, 100)
    k1 = Fraction(1)
    k2 = 1 + h * k1 / 2
    k3 = 1 + h * k2 / 2
    found = spelled(text, "y_n", "h", "K1", "K2", "K3", "K4")(1, h, k1, k2, k3, 1 + h * k3)
    return bool(abs(exactly(str(found)) - mp.exp(exactly(str(h)))) < exactly(str(h**5)))


@precisely
def _is_invariant(form: Callable[[Any, Any, Any], Any]) -> bool:
    """Whether it keeps its value along the proven motion, and changes off it, so that it can be projected on."""
    g = exactly(str(GRAVITY))
    (y, v), (later, then) = along(OF_THE_REPORT, "0.3"), along(OF_THE_REPORT, "0.9")
    return near(form(y, v, g), form(later, then, g)) and not near(form(y, v, g), form(y, 2 * v, g))


@precisely
def _is_acceleration(units: str) -> bool:
    """Whether the proven period stays what it is where centimetres and minutes are counted, g being in these units."""
    cm_a_metre, minutes_a_second = Fraction(100), Fraction(1, 60)
    g = GRAVITY * spelled(units, "m", "s")(cm_a_metre, minutes_a_second)
    minutes = proven(Pendulum("1", g=g, length=cm_a_metre), "period")[0]
    return near(minutes, proven(OF_THE_REPORT, "period")[0] * exactly(str(minutes_a_second)))


@precisely
def _tells_what_keeps_energy(verdict: Callable[[list[tuple[Any, Any]]], bool]) -> bool:
    """Whether, of states around one whole orbit, the verdict is yes for the pendulum and no for the linear solution.

    (1.3) runs around a closed curve as well, an ellipse, and its energy (3.4) is not one number.
    """
    period, omega = proven(OF_THE_REPORT, "period")[0], mp.sqrt(exactly(str(GRAVITY)))
    times = [Fraction(float(period)) * n / 8 for n in range(9)]
    swing = [proven(OF_THE_REPORT, "state", t) for t in times]
    turns = [2 * mp.pi * n / 8 for n in range(9)]
    return verdict(swing) and not verdict([(mp.cos(turn), -omega * mp.sin(turn)) for turn in turns])


def _closes(states: list[tuple[Any, Any]]) -> bool:
    """Whether the last state is the first, to the rounding of the period to a double."""
    return all(near(a, b, 1e-12) for a, b in zip(states[0], states[-1], strict=True))


def _keeps_energy(states: list[tuple[Any, Any]]) -> bool:
    """Whether (3.4) holds at every one."""
    energies = [v * v / 2 - exactly(str(GRAVITY)) * mp.cos(y) for y, v in states]
    return all(near(one, energies[0]) for one in energies)


SUBSTITUTED = "√(2g/l) √(cos φ − cos φ0)"
PER_SQUARE = "½ m y'² − (g/l) m cos y"
ENERGY = "½ m l² y'² − m g l cos y"


MOTION = (
    Erratum(
        REPORT, "(2.3)",
        f"dt = {(nested := 'dφ/√((2g/l) √(cos φ − cos φ0))')}, one root in the other",
        f"dt = {(apart := f'dφ/({SUBSTITUTED})')}, as in (2.2) and (2.4)",
        "Both are held against the proven angular velocity of a pendulum of 2 m.", "None: (2.4) is right.",
        (nested, apart), ("dφ/(√(g/l) √(cos φ − cos φ0))", "dφ/(√(2g/l) √(cos φ0 − cos φ))"), _is_time,
    ),
    Erratum(
        REPORT, "before (2.5)",
        "by the substitution cos φ = 1 − 2 sin² θ (θ = φ/2) “and further adjustments” one gets (2.5)",
        "the substitution that gives (2.5) is sin(φ/2) = k sin θ, k = sin(φ0/2); the further adjustments have to bring "
        "it in, as the θ of (2.5) is another one than φ/2",
        "Only a substitution that takes φ0 to π/2 and the proven angular velocity to the integrand of (2.5) gives it.",
        "None: (2.5) and its limits are right.",
        (lambda phi, _: phi / 2, lambda phi, phi0: mp.asin(mp.sin(phi / 2) / mp.sin(phi0 / 2))),
        (lambda phi, phi0: mp.asin(phi / phi0),), _leads_to_the_elliptic_integral,
    ),
    Erratum(
        REPORT, "section 3",
        f"{(late := '1')} s ≤ t ≤ 10 s", f"{(start := '0')} s ≤ t ≤ 10 s, as in listing 1 and table 8",
        "The proven angle is 1 rad and the velocity zero at the start of the interval.", "None.",
        (late, start), ("0.01",), _is_the_motions_start,
    ),
    Erratum(
        REPORT, "section 3.1, on phase portraits",
        "if the phase portrait is a closed curve, the numerical solution keeps the energy",
        "a closed curve tells that the energy comes back after a turn; that it is kept tells (3.4) at every t",
        "Whether a verdict on nine states around an orbit is yes for the proven motion, and no for the linear solution "
        "(1.3), whose orbit is closed too.",
        "The wording alone: the report draws (3.4) besides, and the energies in table 8 change on a curve that closes "
        "(SymplecticRungeKutta, by up to 1.3e-7).",
        (_closes, _keeps_energy), (lambda states: _keeps_energy(states[::4]),), _tells_what_keeps_energy,
    ),
    Erratum(
        REPORT, "(3.2), (3.3), (3.5)",
        f"E = {PER_SQUARE}",
        f"E = {ENERGY}; what is printed is E/l², conserved too, and the energy where l = 1 m",
        "Both are held against ½ m v² + m g h of the bob, at a proven state of a pendulum of 2 m.",
        "None: l = 1 m throughout, so table 8 and figures 4 and 7 stand.",
        (PER_SQUARE, ENERGY), ("½ m l y'² − m g l cos y", "½ m l² y'² − m g cos y"), _is_energy,
    ),
    Erratum(
        REPORT, "section 3.2, Runge–Kutta of order 4",
        f"y_{{n+1}} = {(without_h := 'y_n + (K1 + 2 K2 + 2 K3 + K4)/6')}",
        f"y_{{n+1}} = {(with_h := 'y_n + h (K1 + 2 K2 + 2 K3 + K4)/6')}",
        "A step for y' = y in exact rationals is held against the exponential function.",
        "None: the computations used Mathematica's methods.",
        (without_h, with_h), ("y_n + h (K1 + 3 K2 + 3 K3 + K4)/8", "y_n + h (K1 + 2 K2 + K3 + K4)/6"), _is_exponential,
    ),
    Erratum(
        REPORT, "section 3.2, listing of Projection",
        '"Invariants" -> -g/l*Cos[poc], a constant', '"Invariants" -> y\'[t]^2/2 - g/l*Cos[y[t]]',
        "An invariant to project on keeps its value along the proven motion and changes off it; a constant never does.",
        "Column Projection of table 8: a constant leaves nothing to project on.",
        (lambda _y, _v, g: -g * mp.cos(1), lambda y, v, g: v * v / 2 - g * mp.cos(y)),
        (lambda y, v, g: v * v / 2 + g * mp.cos(y), lambda y, v, g: v * v - g * mp.cos(y)), _is_invariant,
    ),
    Erratum(
        REPORT, "(4.17)",
        f"g = 9.81 {(turned := 'm² s⁻¹')}", f"g = 9.81 {(metres := 'm s⁻²')}",
        "√(l/g) must be a time: the proven period is the same in centimetres and minutes.", "None.",
        (turned, metres), ("m s⁻¹", "m² s⁻²"), _is_acceleration,
    ),
)  # fmt: skip
