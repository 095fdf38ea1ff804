"""Every variable of the dataset computed again by formulas of its own, one element at a time, in mpmath's numbers.

``RECOMPUTED[path](inputs, argument)`` gives for a group a function of no arguments for each of its variables: inputs
are the exact inputs of the element and the group's parameters by name, the argument is the one along the variable's
second axis.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from independent import agm_period, condition_number, general_state, released_state
from independent_cycloid import Descent, swing
from independent_descent import arc_length, passage, place
from recomputed_central import CENTRAL

from reference.arithmetic.precision import mp
from reference.problems.descent.family import CURVE

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["RECOMPUTED"]

Values = dict[str, "Callable[[], Any]"]


def libration(given: dict[str, Any], argument: Any) -> Values:
    """The release from rest: derivatives by differences of the closed form in cd and sd."""
    a, g, length = (given[name] for name in ("amplitude", "g", "length"))
    state = partial(released_state, g=g, length=length, t=argument)
    period = partial(agm_period, g=g, length=length)
    return {
        "theta": lambda: state(a)[0],
        "omega": lambda: state(a)[1],
        "dtheta_damplitude": lambda: mp.diff(lambda x: state(x)[0], a),
        "domega_damplitude": lambda: mp.diff(lambda x: state(x)[1], a),
        "d2theta_damplitude2": lambda: mp.diff(lambda x: state(x)[0], a, 2),
        "d2omega_damplitude2": lambda: mp.diff(lambda x: state(x)[1], a, 2),
        "condition": lambda: condition_number(a, mp.mpf(0), g, length, argument),
        "period": lambda: period(a),
        "dperiod_damplitude": lambda: mp.diff(period, a),
        "d2period_damplitude2": lambda: mp.diff(period, a, 2),
        "energy": lambda: g / length * (2 * mp.sin(a / 2) ** 2 - 1),
        "modulus": lambda: mp.sqrt((1 - mp.cos(a)) / 2),
        "complementary_modulus": lambda: mp.sqrt((1 + mp.cos(a)) / 2),
        "zero_crossing": lambda: (2 * argument + 1) * period(a) / 4,
        "turning_point": lambda: (argument + 1) * period(a) / 2,
    }


def rotation(given: dict[str, Any], argument: Any) -> Values:
    """Over the top from the bottom: derivatives by differences of the closed form by the amplitude function."""
    omega0, g, length = (given[name] for name in ("initial_omega", "g", "length"))
    k = omega0 / 2 * mp.sqrt(length / g)
    period = 2 * mp.ellipk(1 / k**2) / (k * mp.sqrt(g / length))
    start = mp.mpf(0), omega0, g, length
    found: Values = {
        "theta": lambda: general_state(*start, argument)[0],
        "omega": lambda: general_state(*start, argument)[1],
        "condition": lambda: condition_number(*start, argument),
        "period": lambda: period,
        "energy": lambda: omega0**2 / 2 - g / length,
        "modulus": lambda: k,
        "zero_crossing": lambda: (argument + 1) * period,
    }
    for i, name in enumerate(("theta", "omega")):
        for place_, by in enumerate(("theta0", "omega0", "g", "length")):
            order = tuple(int(place_ == j) for j in range(4))
            found[f"d{name}_d{by}"] = partial(mp.diff, lambda *at, i=i: general_state(*at, argument)[i], start, order)
    return found


def separatrix(given: dict[str, Any], t: Any) -> Values:
    """theta = 4 atan(exp t) - pi in units of sqrt(g/l) = 1, and the two solutions of the linearised equation about it.

    They are sech t and (sinh t + t sech t)/2; g and l act by w = sqrt(g/l) alone, theta = Theta(w t, omega0/w).
    """
    assert (given["initial_omega"], given["g"], given["length"]) == (2, 1, 1)
    theta, omega = 4 * mp.atan(mp.exp(t)) - mp.pi, 2 * mp.sech(t)
    first, second = mp.sech(t), (mp.sinh(t) + t * mp.sech(t)) / 2
    first_rate = -mp.sech(t) * mp.tanh(t)
    second_rate = (mp.cosh(t) + mp.sech(t) - t * mp.sech(t) * mp.tanh(t)) / 2
    by_w = t * omega - 2 * second
    rate_by_w = omega - t * mp.sin(theta) - 2 * second_rate
    square = first**2 + second**2 + first_rate**2 + second_rate**2
    values = {
        "theta": theta,
        "omega": omega,
        "dtheta_dtheta0": first,
        "dtheta_domega0": second,
        "dtheta_dg": by_w / 2,
        "dtheta_dlength": -by_w / 2,
        "domega_dtheta0": first_rate,
        "domega_domega0": second_rate,
        "domega_dg": rate_by_w / 2,
        "domega_dlength": -rate_by_w / 2,
        "condition": mp.sqrt((square + mp.sqrt(square**2 - 4)) / 2),
    }
    return {name: partial(mp.mpf, value) for name, value in values.items()}


def linear(given: dict[str, Any], t: Any) -> Values:
    """a exp(i w t)."""
    a, w = given["amplitude"], mp.sqrt(given["g"] / given["length"])
    return {
        "theta": lambda: a * mp.expj(w * t).real,
        "omega": lambda: -a * w * mp.expj(w * t).imag,
        "period": lambda: 2 * mp.pi / w,
        "energy": lambda: (a * w) ** 2 / 2,
    }


def series(given: dict[str, Any], order: Any) -> Values:
    """Taylor coefficients by differences: of the period, and of Fourier's coefficients by the nome.

    theta = 8 sum_j (-1)^j q^(j + 1/2)/((2 j + 1)(1 + q^(2 j + 1))) cos((2 j + 1) w t).
    """
    a, g, length = (given[name] for name in ("amplitude", "g", "length"))
    n, period = int(order), agm_period(a, g, length)

    def taylor(function: Callable[[Any], Any], degree: int) -> Any:
        with mp.workprec(3 * mp.prec):
            return mp.fsum(c * a**i for i, c in enumerate(mp.taylor(function, 0, degree)))

    def wave(j: int) -> Callable[[Any], Any]:
        def coefficient(x: Any) -> Any:
            nome = mp.qfrom(m=mp.sin(x / 2) ** 2)
            root = mp.sign(x) * mp.sqrt(nome)
            return 8 * (-1) ** j * root ** (2 * j + 1) / ((2 * j + 1) * (1 + nome ** (2 * j + 1)))

        return coefficient

    def angle(t: Any) -> Any:
        square = taylor(lambda x: mp.agm(1, mp.cos(x / 2)) ** 2, 2 * n)
        frequency = mp.sqrt(square * g / length)
        return mp.fsum(taylor(wave(j), 2 * n + 1) * mp.cos((2 * j + 1) * frequency * t) for j in range(n + 1))

    def by_series() -> Any:
        return 2 * mp.pi * mp.sqrt(length / g) * taylor(lambda x: 1 / mp.agm(1, mp.cos(x / 2)), 2 * n)

    return {
        "period_series": by_series,
        "period_series_error": lambda: by_series() / period - 1,
        "lindstedt_error": lambda: angle(period) - a,
        "lindstedt_crossing_error": lambda: angle(period / 4),
    }


def brachistochrone(given: dict[str, Any], argument: Any) -> Values:
    """By the radius as the unknown."""
    found = Descent(given["end_x"], given["end_y"], given["g"])
    return {
        "x": lambda: found.point(argument)[0],
        "y": lambda: found.point(argument)[1],
        "radius": lambda: found.radius,
        "end_angle": lambda: found.angle,
        "descent_time": lambda: found.time,
        "arc_length": lambda: found.length,
        "chord_time": lambda: found.chord,
        "chord_gap": lambda: found.chord - found.time,
        "neighbour_gap": lambda: found.neighbour_time(argument) - found.time,
    }


def tautochrone(given: dict[str, Any], argument: Any) -> Values:
    """By the arc length alone."""
    angle, radius, g = (given[name] for name in ("start_angle", "radius", "g"))
    descent = mp.pi * mp.sqrt(radius / g)
    moving = partial(swing, angle, radius, g, argument)
    return {
        "angle": lambda: moving()["state"][0],
        "angular_velocity": lambda: moving()["state"][1],
        "x": lambda: moving()["position"][0],
        "y": lambda: moving()["position"][1],
        "descent_time": lambda: descent,
        "period": lambda: 4 * descent,
        "energy": lambda: g * radius * (1 - mp.cos(angle)),
    }


def race(given: dict[str, Any], argument: Any) -> Values:
    """Each curve by a formula of its own; the place at a time as a zero of the time at a place."""
    name, g = CURVE.meanings[int(given["curve"])], given["g"]

    def at_place(w: Any, i: int) -> Any:
        x, y = place(name, w)
        speed = mp.sqrt(2 * g * (2 - y))
        if i < 3 or speed == 0:
            return (x, y, speed)[min(i, 2)]
        slope = [mp.diff(lambda s, j=j: place(name, s)[j], w) for j in range(2)]
        return slope[i - 3] / mp.hypot(*slope) * speed

    def place_at(t: Any) -> Any:
        whole = passage(name, mp.mpf(1), g)
        with mp.workprec(60):
            near = mp.findroot(
                lambda s: passage(name, s * s, g) - t, (mp.mpf("0.01") * t / whole, mp.mpf(1)), solver="illinois"
            )
        return mp.findroot(lambda s: passage(name, s * s, g) - t, (near, near * (1 - mp.mpf(2) ** -50))) ** 2

    found: Values = {
        "descent_time": lambda: passage(name, mp.mpf(1), g),
        "arc_length": lambda: arc_length(name),
        "passage_time": lambda: passage(name, argument, g),
    }
    for i, quantity in enumerate(("x", "y", "speed", "velocity_x", "velocity_y")):
        found[quantity] = lambda i=i: at_place(place_at(argument), i)
        if quantity != "velocity_y":
            found[f"passage_{quantity}"] = lambda i=i: at_place(argument, i)
    return found


RECOMPUTED: dict[str, Callable[[dict[str, Any], Any], Values]] = {
    "pendulum/libration": libration,
    "pendulum/dimensionless": libration,
    "pendulum/long": libration,
    "pendulum/rotation": rotation,
    "pendulum/separatrix": separatrix,
    "pendulum/linear": linear,
    "pendulum/series": series,
    "cycloid/brachistochrone": brachistochrone,
    "cycloid/tautochrone": tautochrone,
    "descent/race": race,
    **CENTRAL,
}
