"""Steps whose verdicts are easily got wrong: right ones that look wrong, and wrong ones that look right."""

from __future__ import annotations

import numpy as np

from compare.methods import find
from compare.methods.order.algebraic import enclose

W1 = 1 / (2 - 2 ** (1 / 3))
W0 = 1 - 2 * W1
G = 9.81


def yoshida_of_the_size_of_h(q, p, force, h):
    """Right for h > 0 alone: every march backwards in time goes forwards."""
    h = abs(h)
    for weight in (W1, W0, W1):
        p = p + weight * h / 2 * force(q)
        q = q + weight * h * p
        p = p + weight * h / 2 * force(q)
    return q, p


def euler_of_the_size_of_h(f, y, h):
    return y + np.abs(h) * f(y)


def rk4_with_a_stage_of_the_size_of_h(f, y, h):
    """Goes along f both ways, but with order one alone on the way back."""
    k1 = f(y)
    k2 = f(y + np.abs(h) / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def verlet_that_refuses_to_go_back(q, p, force, h):
    """Right, and says so where it is asked for what it does not do."""
    if np.any(np.asarray(h) < 0):
        raise ValueError("a positive h is accepted")
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def still(f, y, h):  # noqa: ARG001 - it does nothing with them
    """Area-preserving, reversible, and no integrator."""
    return y


def still_over_a_grid(f, y0, t):
    f(t[0], y0)
    return np.tile(y0, (len(t), 1))


def newton_slopes(f, y, a, h):
    """k = f(y + a h k), by Newton's method with a Jacobian by differences."""
    k, d = f(y), 1e-6
    for _ in range(8):
        z = y + a * h * k
        columns = [(f(z + d * e) - f(z - d * e)) / (2 * d) for e in np.eye(2)]
        k = k - np.linalg.solve(np.eye(2) - a * h * np.stack(columns, 1), k - f(z))
    return k


def diagonally_implicit_of_order_one(f, y, h):
    """Stages at 1/2 and 3/2 with weights -1/2 and 3/2 (Kraaijevanger and Spijker): order one, which shows late."""
    k1 = newton_slopes(f, y, 0.5, h)
    k2 = newton_slopes(f, y - h / 2 * k1, 2.0, h)
    return y + h * (-k1 / 2 + 3 * k2 / 2)


def hard_wired(f, y, h):  # noqa: ARG001 - that is its fault
    """RK4 with the pendulum inside."""

    def g(z):
        return np.array([z[1], -G * np.sin(z[0])])

    k1 = g(y)
    k2 = g(y + h / 2 * k1)
    k3 = g(y + h / 2 * k2)
    k4 = g(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def midpoint_that_keeps_the_energy_of_the_pendulum(f, y, h):
    """Right, for this pendulum alone: the step of midpoint, projected on its energy along the gradient."""
    new = y + h * f(y + h / 2 * f(y))
    for _ in range(6):
        gradient = np.array([G * np.sin(new[0]), new[1]])
        lost = (new[1] ** 2 - y[1] ** 2) / 2 - G * (np.cos(new[0]) - np.cos(y[0]))
        new = new - lost / (gradient[0] ** 2 + gradient[1] ** 2) * gradient
    return new


def the_same_on_doubles(f, y, h):
    return midpoint_that_keeps_the_energy_of_the_pendulum(f, np.asarray(y, dtype=np.float64), float(h))


def midpoint_with_a_default(f, y, h=0.01):
    return y + h * f(y + h / 2 * f(y))


def verlet_of_a_gradient(q, p, force, h):
    """Verlet for the gradient of a potential, given a force."""
    p = p - h / 2 * force(q)
    q = q + h * p
    return q, p - h / 2 * force(q)


def against_the_slope(f, y, h):
    return y - h * f(y - h / 2 * f(y))


def leapfrog_without_its_half_step(q, p, force, h):
    """Leapfrog started with the velocity of the position's time: symplectic Euler's method."""
    p = p + h * force(q)
    return q + h * p, p


def leapfrog_the_other_way(q, p, force, h):
    q = q + h * p
    return q, p + h * force(q)


def rk4_with_a_node_of_ten_digits(f, y, h):
    """Its order hangs on the digits of one coefficient."""
    k1 = f(y)
    k2 = f(y + 0.50000000003 * h * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def with_coefficients_of(name, slip=None):
    """An explicit tableau of the catalogue as a step that takes the time; ``slip`` is the place of an a 0.1 % off."""
    method = find(name)
    matrix, b, c = (
        [[float(enclose(a)) for a in row] for row in method.a],
        [float(enclose(w)) for w in method.b],
        [float(enclose(node)) for node in method.c],
    )
    if slip is not None:
        matrix[slip[0]][slip[1]] *= 1.001

    def step(f, t, y, h):
        slopes = []
        for row, node in zip(matrix, c, strict=True):
            z = y
            for a, k in zip(row, slopes, strict=True):
                if a:
                    z = z + h * a * k
            slopes.append(f(t + node * h, z))
        for weight, k in zip(b, slopes, strict=True):
            if weight:
                y = y + h * weight * k
        return y

    return step


def splitting_of(name):
    """A splitting of the catalogue as (q, p, force, h)."""
    flows = [(kind, float(enclose(weight))) for kind, weight in find(name).flows]

    def step(q, p, force, h):
        for kind, weight in flows:
            if kind == "kick":
                p = p + weight * h * force(q)
            else:
                q = q + weight * h * p
        return q, p

    return step


dop853 = with_coefficients_of("dop853")


def dop853_on_doubles(f, t, y, h):
    """The same where nothing but doubles can go through."""
    return dop853(f, float(t), np.asarray(y, dtype=np.float64), float(h))


def dop853_of_no_time(f, y, h):
    return dop853(lambda _, z: f(z), 0.0, y, h)
