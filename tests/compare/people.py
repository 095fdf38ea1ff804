"""What people have: integrators as classes, generators, solvers over a span, and what they give beside states."""

import math
from itertools import accumulate, pairwise
from types import SimpleNamespace

import numpy as np


def rk4(f, y, h):
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def timed(f, t, y, h):
    k1 = f(t, y)
    k2 = f(t + h / 2, y + h / 2 * k1)
    k3 = f(t + h / 2, y + h / 2 * k2)
    k4 = f(t + h, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def verlet_of_a_potential(q, p, grad_V, h):  # noqa: N803
    p = p - h / 2 * grad_V(q)
    q = q + h * p
    return q, p - h / 2 * grad_V(q)


def with_its_own_equation(y, h):
    return rk4(lambda z: np.array([z[1], -9.81 * math.sin(float(z[0]))]), y, h)


class Stepper:
    def __init__(self, f, t0, y0, h):
        self.f, self.t, self.y, self.h = f, t0, y0, h

    def step(self):
        self.y = timed(self.f, self.t, self.y, self.h)
        self.t += self.h


class WithFrozenTime(Stepper):
    """Calls f at the time of the step's beginning."""

    def step(self):
        self.y = rk4(lambda y: self.f(self.t, y), self.y, self.h)
        self.t += self.h


class Formula:
    """Made with f alone; the state is handed on."""

    def __init__(self, f):
        self.f = f

    def step(self, t, y, h):
        return timed(self.f, t, y, h)


class Advancing:
    def __init__(self, rhs, u0, dt):
        self.rhs, self.state = rhs, np.array(u0)
        self.dt = dt

    def advance(self):
        self.state = self.state + self.dt * self.rhs(self.state + self.dt / 2 * self.rhs(self.state))


class Leapfrog:
    """Two steps at once, from the state before: even and odd numbers of steps err differently."""

    def __init__(self, f, t0, y0, h):
        self.f, self.t, self.y, self.h, self.before = f, t0, y0, h, None

    def step(self):
        slope = self.f(self.t, self.y)
        end = self.y + self.h * slope if self.before is None else self.before + 2 * self.h * slope
        self.before, self.y = self.y, end
        self.t += self.h


def for_second_order_alone(f, t, y, h):
    """Of Nystrom's kind, which asks whether its equation is of second order."""
    a = f(t, y)
    if a[0] != y[1]:
        raise AssertionError("this is no equation of second order")
    return timed(f, t, y, h)


def states_one_after_another(f, y0, h):
    y = y0
    while True:
        yield y
        y = rk4(f, y, h)


def times_and_states(f, t0, y0, h):
    t, y = t0, y0
    while True:
        y = timed(f, t, y, h)
        t += h
        yield t, y


def at_times_of_its_own(f, t_span, y0, h):
    """A right method with another step than h, which it tells."""
    t, y = t_span[0], y0
    while True:
        yield t, y
        t, y = t + 0.7 * h, timed(f, t, y, 0.7 * h)


def doubly(f, y0, t):
    """Twice the step that is asked for."""
    return np.array([*accumulate(np.diff(t), lambda y, h: midpoint(f, y, 2 * h), initial=y0)])


class Doubly:
    """The same."""

    def __init__(self, f, y0, h):
        self.f, self.y, self.h = f, y0, h

    def step(self):
        self.y = midpoint(self.f, self.y, 2 * self.h)


def midpoint(f, y, h):
    return y + h * f(y + h / 2 * f(y))


def over_a_span(fun, t_span, y0, t_eval=None):
    t, states = np.asarray(t_eval), [y0]
    for begun, ended in pairwise(t):
        states.append(timed(fun, begun, states[-1], ended - begun))
    return SimpleNamespace(t=t, y=np.array(states).T)


def in_so_many_steps(f, tspan, y0, n):
    t, states = np.linspace(*tspan, n + 1), [y0]
    for begun in t[:-1]:
        states.append(timed(f, begun, states[-1], t[1] - t[0]))
    return t, np.array(states)


def to_the_end(f, t_span, y0):
    return timed(f, t_span[0], y0, t_span[1] - t_span[0])


def hermite(f, y, h, theta):
    """The cubic through both states and slopes of a step."""
    end = rk4(f, y, h)
    return _cubic(y, end, h * f(y), h * f(end), theta)


def hermite_without_its_last_slope(f, y, h, theta):
    """As multirate methods of OrdinaryDiffEq.jl had it (issue 4139)."""
    end = rk4(f, y, h)
    return _cubic(y, end, h * f(y), 0 * y, theta)


def hermite_of_euler(f, y, h, theta):
    """Ends elsewhere than the step."""
    end = y + h * f(y)
    return _cubic(y, end, h * f(y), h * f(end), theta)


def _cubic(y, end, first, last, theta):
    s = 1 - theta
    return (1 + 2 * theta) * s * s * y + theta * s * s * first + theta**2 * (3 - 2 * theta) * end - theta**2 * s * last


def bogacki_shampine(f, y, h):
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + 3 * h / 4 * k2)
    end = y + h * (2 * k1 + 3 * k2 + 4 * k3) / 9
    return end, h * (-5 * k1 / 72 + k2 / 12 + k3 / 9 - f(end) / 8)


def norm_of_the_estimate(f, y, h):
    end, error = bogacki_shampine(f, y, h)
    return end, float(np.linalg.norm(error))


def estimate_without_h(f, y, h):
    end, error = bogacki_shampine(f, y, h)
    return end, error / h


def estimate_with_a_slip(f, y, h):
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + 3 * h / 4 * k2)
    end = y + h * (2 * k1 + 3 * k2 + 4 * k3) / 9
    return end, h * (-5 * k1 / 72 + k2 / 12 + k3 / 9 - f(end) / 9)


def euler_with_heun(f, y, h):
    k = f(y)
    return y + h * k, h / 2 * (f(y + h * k) - k)


def euler_with_twice_its_error(f, y, h):
    k = f(y)
    return y + h * k, h * (f(y + h * k) - k)


def estimate_between_orders(f, y, h):
    end, error = bogacki_shampine(f, y, h)
    return end, np.abs(h) ** 3.7 * np.sign(h) * f(y) + 0 * error


def not_with_long_steps(f, y, h):
    end, error = bogacki_shampine(f, y, h)
    return (end, error) if h < 0.3 else (np.nan * end, error)


def no_estimate(f, y, h):
    return rk4(f, y, h), 0 * y


def adaptive(fun, t_span, y0, t_eval=None, rtol=1e-3, atol=1e-6):
    from scipy.integrate import solve_ivp

    return solve_ivp(fun, t_span, y0, t_eval=t_eval, rtol=rtol, atol=atol)


def adaptive_to_the_end(fun, t_span, y0, rtol=1e-3):
    return adaptive(fun, t_span, y0, rtol=rtol, atol=rtol)


def deaf_to_rtol(fun, t_span, y0, t_eval=None, rtol=1e-3):
    return adaptive(fun, t_span, y0, t_eval)


def deaf_to_rtol_but_not_to_atol(fun, t_span, y0, t_eval=None, rtol=1e-3, atol=1e-6):
    return adaptive(fun, t_span, y0, t_eval, rtol=3e-14, atol=100 * atol)


def by_the_root_of_rtol(fun, t_span, y0, t_eval=None, rtol=1e-3):
    return adaptive(fun, t_span, y0, t_eval, math.sqrt(rtol), math.sqrt(rtol))


def with_a_loose_atol(fun, t_span, y0, t_eval=None, rtol=1e-3):
    return adaptive(fun, t_span, y0, t_eval, rtol, 1e-5)


def implicit(a, b, c):
    """A Runge-Kutta method whose stages are solved by Newton's, the slopes of f by differences."""
    a, b = np.array(a), np.array(b)

    def step(f, t, y, h):
        d, s = len(y), len(b)

        def residual(k):
            k = k.reshape(s, d)
            return np.concatenate([k[i] - f(t + c[i] * h, y + h * (a[i] @ k)) for i in range(s)])

        k = np.zeros(s * d)
        for _ in range(4):
            at, nudges = residual(k), 1e-7 * (1 + np.abs(k))
            slopes = [
                (residual(k + nudge * unit) - at) / nudge for nudge, unit in zip(nudges, np.eye(s * d), strict=True)
            ]
            k = k - np.linalg.solve(np.array(slopes).T, at)
        return y + h * (b @ k.reshape(s, d))

    return step


ROOT = math.sqrt(3)
GAUSS = implicit(
    [[1 / 4, 1 / 4 - ROOT / 6], [1 / 4 + ROOT / 6, 1 / 4]], [1 / 2, 1 / 2], [0.5 - ROOT / 6, 0.5 + ROOT / 6]
)
RADAU = implicit([[5 / 12, -1 / 12], [3 / 4, 1 / 4]], [3 / 4, 1 / 4], [1 / 3, 1])


def crossings(*, h, twice=False, one_way=False, with_start=False):
    """A finder that looks at the signs at the ends of steps, and draws a line between."""

    def find(f, event, t_span, y0):
        t, y = t_span[0], y0
        found = [t] if with_start else []
        while t < t_span[1]:
            end = rk4(f, y, h)
            before, after = event(t, y), event(t + h, end)
            if before * after <= 0 and not (one_way and after < before):
                found += [t + h * before / (before - after)] * (2 if twice else 1)
            t, y = t + h, end
        return found

    return find


def signs_at_the_ends_of_steps(fun, event, t_span, y0):
    """SciPy's way with its own tolerances: two crossings within a step are not seen (scipy issue 9228, CyRK's 98)."""
    from scipy.integrate import solve_ivp

    return solve_ivp(fun, t_span, y0, events=event)


def derivatives(y0, parameters, t):
    """By differences of SciPy's solution, of everything that a pendulum depends on."""
    from scipy.integrate import solve_ivp

    def end(change):
        start, g, length, t0 = y0 + change[:2], parameters["g"] + change[2], parameters["length"] + change[3], change[4]
        return solve_ivp(
            lambda _, y: [y[1], -g / length * np.sin(y[0])], (t0, t), start, "DOP853", rtol=1e-12, atol=1e-12
        ).y[:, -1]

    names = ("theta", "omega", "g", "length", "t0")
    return {name: (end(d) - end(-d)) / 2e-5 for name, d in zip(names, 1e-5 * np.eye(5), strict=True)}


def with_no_initial_time(y0, parameters, t):
    """As stan-dev/math had it (issue 1833)."""
    return {**derivatives(y0, parameters, t), "t0": np.zeros(2)}


def with_a_sign(y0, parameters, t):
    found = derivatives(y0, parameters, t)
    return {**found, "g": -found["g"]}


def twice_the_length(y0, parameters, t):
    found = derivatives(y0, parameters, t)
    return {**found, "length": 2 * found["length"]}


def exchanged(y0, parameters, t):
    found = derivatives(y0, parameters, t)
    return {**found, "g": found["length"], "length": found["g"]}


def transposed(y0, parameters, t):
    found = derivatives(y0, parameters, t)
    return np.array([found["theta"], found["omega"]])
