"""The groups of the central fields computed again: see ``recomputed``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from independent import fraction
from independent_polar import Amplitude, ball, rolled

from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CENTRAL"]

Values = dict[str, "Callable[[], Any]"]


def passed(z0: Any, tangent: Any) -> tuple[Any, Any]:
    """(phi, tau) about a point mass where tan(psi/2) is given, before the lowest point."""
    with ctx.workprec(mp.prec + 60):
        found = Amplitude(ball(fraction(z0))).passed(ball(fraction(mp.mpf(tangent))))
        return tuple(mp.mpf(part.mid().str(mp.dps + 20, radius=False)) for part in found)  # type: ignore[return-value]


def whole(z0: Any) -> tuple[Any, Any]:
    """Half angle and descent time about a point mass, smooth in z0."""
    kappa, third = z0**3 / (1 - z0), mp.mpf(1) / 3
    argument = -27 / (4 * kappa)
    angle = mp.pi / 3 * (1 - mp.hyp2f1(third, 2 * third, 1, argument))
    return angle, mp.pi / mp.sqrt(kappa) * mp.hyper([third * 3 / 2, 4 * third, 5 * third], [third * 9 / 2, 2], argument)


def chord(radius: Any, angle: Any) -> Any:
    """The time on the straight line from (1, 0): s = length sin^2(x), which takes both roots out of the speed."""
    square = (radius * mp.cos(angle) - 1) ** 2 + (radius * mp.sin(angle)) ** 2

    def rate(x: Any) -> Any:
        left = (1 - radius) * (1 + radius) + square * mp.cos(x) ** 2
        z = mp.sqrt(1 - mp.sin(x) ** 2 * left)
        return 2 * mp.cos(x) * mp.sqrt(z * (1 + z) * square / left)

    return mp.quad(rate, mp.linspace(0, mp.pi / 2, 5))


def neighbour(z0: Any, epsilon: Any, curve: Callable[[Any], tuple[Any, Any, Any, Any]]) -> Any:
    """The time along phi + epsilon eta from z = 1 through z0 and back; ``curve(psi)`` is z, dz, dphi and the speed."""

    def rate(psi: Any) -> Any:
        sine, cosine = mp.sin(psi / 2), mp.cos(psi / 2)
        bend = (1 - z0) * (1.5 * sine**2 * cosine * sine - 0.5 * sine**3 * -cosine)
        z, dz, dphi, speed = curve(psi)
        return mp.hypot(dz, z * (dphi + epsilon * bend)) / speed

    return mp.quad(rate, mp.linspace(0, 2 * mp.pi, 9))


def point_mass(z0: Any) -> Callable[[Any], tuple[Any, Any, Any, Any]]:
    """z, dz/dpsi, dphi/dpsi and the speed by psi."""

    def at(psi: Any) -> tuple[Any, Any, Any, Any]:
        fallen = (1 - z0) * mp.sin(psi / 2) ** 2
        z = 1 - fallen
        q = (1 - z0) * z * z + z0 * (1 - z0) * z + z0 * z0
        dphi = z0 * mp.sqrt(z0) * fallen / (z * mp.sqrt(q))
        return z, -(1 - z0) / 2 * mp.sin(psi), dphi, mp.sqrt(fallen / z)

    return at


def uniform_ball(z0: Any) -> Callable[[Any], tuple[Any, Any, Any, Any]]:
    """The same through a uniform ball."""

    def at(psi: Any) -> tuple[Any, Any, Any, Any]:
        square = (1 - z0 * z0) * mp.sin(psi / 2) ** 2
        z = mp.sqrt(1 - square)
        return z, -(1 - z0 * z0) * mp.sin(psi) / (4 * z), z0 * square / (2 * z * z), mp.sqrt(square)

    return at


def polar_family(given: dict[str, Any], argument: Any) -> Values:
    """By integrals over Jacobi's amplitude, hypergeometric series, and differences of these."""
    z0 = given["z0"]

    def down(i: int) -> Any:
        return passed(z0, mp.sqrt((1 - argument) / argument))[i] if argument else whole(z0)[i]

    return {
        "z": lambda: 1 - (1 - z0) * mp.sin(argument / 2) ** 2,
        "phi": lambda: passed(z0, mp.tan(argument / 2))[0],
        "tau": lambda: passed(z0, mp.tan(argument / 2))[1],
        "z_by_height": lambda: z0 + (1 - z0) * argument,
        "phi_by_height": lambda: down(0),
        "tau_by_height": lambda: down(1),
        "kappa": lambda: z0**3 / (1 - z0),
        "half_angle": lambda: whole(z0)[0],
        "descent_time": lambda: whole(z0)[1],
        "dhalf_angle_dz0": lambda: mp.diff(lambda x: whole(x)[0], z0),
        "ddescent_time_dz0": lambda: mp.diff(lambda x: whole(x)[1], z0),
        "chord_time": lambda: chord(mp.mpf(1), 2 * whole(z0)[0]),
        "chord_gap": lambda: chord(mp.mpf(1), 2 * whole(z0)[0]) - 2 * whole(z0)[1],
        "neighbour_gap": lambda: neighbour(z0, argument, point_mass(z0)) - 2 * whole(z0)[1],
    }


def polar_motion(given: dict[str, Any], tau: Any) -> Values:
    """By Newton's method on those integrals; beyond the lowest point by symmetry."""
    z0 = given["z0"]
    angle, time = whole(z0)
    returns = mp.floor(tau / (2 * time))
    rest = tau - 2 * time * returns
    rising = rest > time

    def state() -> tuple[Any, Any, Any]:
        with ctx.workprec(mp.prec + 60):
            low = Amplitude(ball(fraction(z0)))
            psi = low.psi_at(ball(fraction(2 * time - rest if rising else rest)))
            psi = mp.mpf(psi.str(mp.dps + 20, radius=False))
        fallen = (1 - z0) * mp.sin(psi / 2) ** 2
        z = 1 - fallen
        kappa = z0**3 / (1 - z0)
        rate = mp.sqrt(fallen / z - kappa * fallen**2 / z**4)
        phi = passed(z0, mp.tan(psi / 2))[0]
        phi = 2 * angle - phi if rising else phi
        return z, rate if rising else -rate, phi + 2 * angle * returns

    return {name: lambda i=i: state()[i] for i, name in enumerate(("z", "z_rate", "phi"))}


def polar_boundary(given: dict[str, Any], _: Any) -> Values:
    """The lowest point as a zero of the angle at the end, before or after it."""
    radius, angle = given["end_z"], given["end_phi"]
    after = radius == 1 or angle > whole(radius)[0]

    def end(z0: Any) -> tuple[Any, Any]:
        there = passed(z0, mp.sqrt((1 - radius) / (radius - z0))) if radius < 1 else (0, 0)
        return tuple(2 * a - b for a, b in zip(whole(z0), there, strict=True)) if after else there  # type: ignore[return-value]

    def lowest() -> Any:
        with mp.workprec(80):
            near = mp.findroot(
                lambda x: end(radius * x)[0] - angle, (mp.mpf("1e-6"), 1 - mp.mpf("1e-12")), solver="illinois"
            )
        return radius * mp.findroot(lambda x: end(radius * x)[0] - angle, (near, near * (1 - mp.mpf(2) ** -60)))

    return {
        "z0": lowest,
        "arrival_time": lambda: end(lowest())[1],
        "chord_time": lambda: chord(radius, angle),
        "chord_gap": lambda: chord(radius, angle) - end(lowest())[1],
    }


def tunnel_family(given: dict[str, Any], argument: Any) -> Values:
    """By the rolling circle; the chord takes pi, whatever its length."""
    z0 = given["z0"]
    time = mp.pi * mp.sqrt(1 - z0 * z0)
    found: Values = {
        "kappa": lambda: z0**2 / (1 - z0**2),
        "half_angle": lambda: mp.pi / 2 * (1 - z0),
        "descent_time": lambda: time / 2,
        "dhalf_angle_dz0": lambda: -mp.pi / 2,
        "ddescent_time_dz0": lambda: -mp.pi / 2 * z0 / mp.sqrt(1 - z0 * z0),
        "chord_time": lambda: mp.pi,
        "chord_gap": lambda: mp.pi - time,
        "neighbour_gap": lambda: neighbour(z0, argument, uniform_ball(z0)) - time,
    }

    def down(i: int) -> Any:
        z = z0 + (1 - z0) * argument
        psi = 2 * mp.asin(mp.sqrt((1 - argument) * (1 + z) / (1 + z0)))
        return rolled(fraction(z0), fraction(psi))[i]

    for i, name in enumerate(("z_by_height", "phi_by_height", "tau_by_height")):
        found[name] = lambda i=i: down(i)
    for i, name in enumerate(("z", "phi", "tau")):
        found[name] = lambda i=i: rolled(fraction(z0), fraction(argument))[i]
    return found


def tunnel_motion(given: dict[str, Any], tau: Any) -> Values:
    """By the rolling circle, which turns evenly."""
    z0 = given["z0"]
    psi = 2 * tau / mp.sqrt(1 - z0 * z0)
    returns = mp.floor(psi / (2 * mp.pi))
    rest = psi - 2 * mp.pi * returns

    def rolling() -> tuple[Any, Any, Any]:
        return rolled(fraction(z0), fraction(rest))

    return {
        "z": lambda: rolling()[0],
        "z_rate": lambda: -mp.sqrt(1 - z0 * z0) * mp.sin(psi) / (2 * rolling()[0]),
        "phi": lambda: rolling()[1] + mp.pi * (1 - z0) * returns,
    }


CENTRAL: dict[str, Callable[[dict[str, Any], Any], Values]] = {
    "polar/family": polar_family,
    "polar/motion": polar_motion,
    "polar/boundary": polar_boundary,
    "tunnel/family": tunnel_family,
    "tunnel/motion": tunnel_motion,
}
