"""A solve_ivp that prints when it is imported, wants arrays from the right-hand side, and returns events as objects."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np

print("Using a backend")


def solve_ivp(fun, t_span, y0, method, t_eval=None, rtol=None, atol=None, events=None, dense_output=False):
    if method == "RK108":
        return SimpleNamespace(success=False, message="Integration has not been run")
    times = np.linspace(*t_span, 2001) if t_eval is None else t_eval
    states, found = [np.array(y0)], []
    for before, after in pairwise(times):
        h, y = (after - before) / 8, states[-1]
        for i in range(8):
            k1 = fun(before + i * h, y)
            k2 = fun(before + i * h + h / 2, y + h / 2 * k1)
            k3 = fun(before + i * h + h / 2, y + h / 2 * k2)
            k4 = fun(before + i * h + h, y + h * k3)
            assert isinstance(k1, np.ndarray)
            y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if events is not None and events(before, states[-1]) * events(after, y) < 0:
            g0, g1 = events(before, states[-1]), events(after, y)
            found.append(SimpleNamespace(t=before + (after - before) * g0 / (g0 - g1)))
        states.append(y)
    system = SimpleNamespace(rtol=rtol)
    return SimpleNamespace(success=True, y=np.array(states).T, t_events=found, ode_system=system)
