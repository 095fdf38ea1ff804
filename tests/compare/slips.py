"""Integrators as people write them: right ones, and the classic slips."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp

CUBE_ROOT = 2 ** (1 / 3)
W1, W0 = 1 / (2 - CUBE_ROOT), -CUBE_ROOT / (2 - CUBE_ROOT)


def rk4(f, y, h):
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def euler(f, y, h):
    return y + h * f(y)


def phi(f, y, h):
    """Symplectic Euler: kick, then drift."""
    y[1] += h * f(y)[1]
    y[0] += h * f(y)[0]
    return y


def phi_star(f, y, h):
    """Its adjoint: drift, then kick."""
    y[0] += h * f(y)[0]
    y[1] += h * f(y)[1]
    return y


def verlet(f, y, h):
    return phi_star(f, phi(f, y, h / 2), h / 2)


def yoshida4(f, y, h):
    for weight in (W1, W0, W1):
        y = verlet(f, y, weight * h)
    return y


def suzuki(base, order):
    """Five steps of a symmetric method make one of two orders more."""
    root = 4 ** (1 / (order + 1))
    weights = [1 / (4 - root)] * 5
    weights[2] = 1 - 4 / (4 - root)

    def step(f, y, h):
        for weight in weights:
            y = base(f, y, weight * h)
        return y

    return step


suzuki6 = suzuki(suzuki(verlet, 2), 4)


def separable_verlet(q, p, force, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def implicit_midpoint(f, y, h):
    new = y + h * f(y)
    for _ in range(100):
        before, new = new, y + h * f((y + new) / 2)
        if np.max(np.abs(new - before)) < 1e-13:
            break
    return new


def loosely_implicit_midpoint(f, y, h):
    """Solved to 1e-9: a plateau of that height, and defects of it."""
    new = y + h * f(y)
    while True:
        before, new = new, y + h * f((y + new) / 2)
        if np.max(np.abs(new - before)) < 1e-9:
            return new


def rk4_in_time(f, t, y, h):
    k1 = f(t, y)
    k2 = f(t + h / 2, y + h / 2 * k1)
    k3 = f(t + h / 2, y + h / 2 * k2)
    k4 = f(t + h, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def rk4_over_a_grid(f, y0, t):
    states = [y0]
    for here, there in pairwise(t):
        states.append(rk4_in_time(f, here, states[-1], there - here))
    return np.array(states)


def adaptive(f, y0, t, tolerance=1e-6):
    """Bogacki and Shampine's pair with its own steps, landing on every time of the grid."""
    states, y, now, h = [y0], y0, t[0], 0.01
    for then in t[1:]:
        while now < then:
            size = min(h, then - now)
            k1 = f(now, y)
            k2 = f(now + size / 2, y + size / 2 * k1)
            k3 = f(now + 3 * size / 4, y + 3 * size / 4 * k2)
            new = y + size * (2 / 9 * k1 + 1 / 3 * k2 + 4 / 9 * k3)
            k4 = f(now + size, new)
            error = np.max(np.abs(size * (-5 / 72 * k1 + 1 / 12 * k2 + 1 / 9 * k3 - 1 / 8 * k4)))
            if error <= tolerance:
                now, y = (then if size == then - now else now + size), new
            h = size * min(5.0, max(0.2, 0.9 * (tolerance / max(error, 1e-300)) ** (1 / 3)))
        states.append(y)
    return np.array(states)


def dense(f, y0, t):
    """Steps of its own, and cubic interpolation in between: states [state, times], as SciPy gives them."""
    fine = np.linspace(t[0], t[-1], 200)
    states = rk4_over_a_grid(f, y0, fine)
    rates = np.array([f(now, y) for now, y in zip(fine, states, strict=True)])
    place = np.clip(np.searchsorted(fine, t, side="right") - 1, 0, len(fine) - 2)
    h = fine[1] - fine[0]
    s = ((t - fine[place]) / h)[:, None]
    a, b = states[place], states[place + 1]
    found = (1 + 2 * s) * (1 - s) ** 2 * a + s * (1 - s) ** 2 * h * rates[place]
    return (found + s**2 * (3 - 2 * s) * b + s**2 * (s - 1) * h * rates[place + 1]).T


def euler_called_symplectic(f, y, h):
    """Slip: the drift uses the old velocity."""
    return y + h * f(y)


def full_step_for_half(f, y, h):
    """Slip: k1 h for k1 h/2."""
    k1 = f(y)
    k2 = f(y + h * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def sign_slip(f, y, h):
    """Slip: the middle weight of Yoshida's composition without its minus sign."""
    for weight in (W1, -W0, W1):
        y = verlet(f, y, weight * h)
    return y


def sign_slip_in_kutta(f, y, h):
    """Slip: Kutta's third order with +k1 for -k1 in the last stage."""
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h * k1 + 2 * h * k2)
    return y + h / 6 * (k1 + 4 * k2 + k3)


def same_half_twice(f, y, h):
    """Slip: phi for phi* in the second half of Verlet."""
    return phi(f, phi(f, y, h / 2), h / 2)


def swapped_in_a_composition(f, y, h):
    """Slip: phi and phi* swapped in the second of the three factors of a fourth-order composition."""
    y = phi_star(f, phi(f, y, W1 * h / 2), W1 * h / 2)
    y = phi(f, phi_star(f, y, W0 * h / 2), W0 * h / 2)
    return phi_star(f, phi(f, y, W1 * h / 2), W1 * h / 2)


def forest_ruth_of_order_two(f, y, h):
    """Slip: Forest and Ruth's coefficients with the square root of two for the cube root."""
    theta = 1 / (2 - 2 ** (1 / 2))
    for weight in (theta, 1 - 2 * theta, theta):
        y = verlet(f, y, weight * h)
    return y


def stages_at_the_wrong_times(f, t, y, h):
    """Slip: every stage at the beginning of the step."""
    k1 = f(t, y)
    k2 = f(t, y + h / 2 * k1)
    k3 = f(t, y + h / 2 * k2)
    k4 = f(t, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def one_stage_at_the_wrong_time(f, t, y, h):
    """Slip: the last stage at the middle of the step."""
    k1 = f(t, y)
    k2 = f(t + h / 2, y + h / 2 * k1)
    k3 = f(t + h / 2, y + h / 2 * k2)
    k4 = f(t + h / 2, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def weights_that_miss_one(f, y, h):
    """Slip: weights that sum to 7/6."""
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 3 * k3 + k4)


def shrunk_verlet(f, y, h):
    """Slip: a millionth of the state is lost with each step."""
    return (1 - 1e-6) * verlet(f, y, h)


def shrunk_verlet_with_a_branch(f, y, h):
    """The same where it cannot be compiled."""
    return shrunk_verlet(f, y, h) if y[0] < 100 else y


def shrunk_implicit_midpoint(f, y, h):
    """The same after an inner iteration."""
    return (1 - 1e-6) * implicit_midpoint(f, y, h)


def bogacki_shampine_each_step(f, y, h):
    """Slip: a step of an adaptive method to a tolerance, called symplectic."""
    return adaptive(lambda _, state: f(state), y, np.array([0.0, h]), tolerance=1e-9)[-1]


def runge_kutta_45_each_step(f, y, h):
    """Slip: the same with SciPy's, whose absolute tolerance is its default."""
    return solve_ivp(lambda _, state: f(state), (0, h), y, rtol=1e-7).y[:, -1]


def wavering_verlet(f, y, h):
    """A fault that goes both ways, in a step that does not iterate: it could be a tolerance, or not."""
    if y[0] > 100:
        return y
    new = verlet(f, y, h)
    return new + 1e-8 * np.sin(3 * new)


def rk4_of_seven_digits(f, y, h):
    """Slip: weights 1/6 and 1/3 of seven digits."""
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h * (0.1666667 * k1 + 0.3333333 * k2 + 0.3333333 * k3 + 0.1666666 * k4)


def rk4_a_little_long(f, y, h):
    """Slip: increments too long by 1e-9."""
    return y + (1 + 1e-9) * (rk4(f, y, h) - y)


def rk4_a_little_long_with_a_branch(f, y, h):
    """The same where it cannot be compiled."""
    return rk4_a_little_long(f, y, h) if y[0] < 100 else y


def rk4_over_a_grid_a_little_long(f, y0, t):
    """Slip: the same in a whole integrator, where it cannot be told from a tolerance."""
    return rk4_over_a_grid(lambda now, y: (1 + 1e-8) * f(now, y), y0, t)


def separable_verlet_a_little_long(q, p, force, h):
    """Slip: the drift is too long by 1e-8."""
    p = p + h / 2 * force(q)
    q = q + (1 + 1e-8) * h * p
    return q, p + h / 2 * force(q)


def verlet_without_the_slope_of_positions(f, y, h):
    """Right: the drift takes the momentum itself for its slope."""
    p = y[1] + h / 2 * f(y)[1]
    q = y[0] + h * p
    return np.array([q, p + h / 2 * f(np.array([q, p]))[1]])
