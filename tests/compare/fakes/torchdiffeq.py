"""An odeint of tensors, and one that ends at the first event."""

from itertools import pairwise

import torch


def _step(func, t, y, h):
    k1 = func(t, y)
    k2 = func(t + h / 2, y + h / 2 * k1)
    k3 = func(t + h / 2, y + h / 2 * k2)
    k4 = func(t + h, y + h * k3)
    assert isinstance(k1, torch.Tensor)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def odeint(func, y0, t, *, method, rtol, atol):
    assert method in {"dopri5", "dopri8"}
    states = [y0]
    for before, after in pairwise(t):
        h, y = (after - before) / 8, states[-1]
        for i in range(8):
            y = _step(func, before + i * h, y, h)
        states.append(y)
    return torch.stack(states, dim=0)


def odeint_event(func, y0, t0, *, event_fn, method, rtol, atol):
    t, y, h = t0, y0, 1e-3
    while True:
        after = _step(func, t, y, h)
        g0, g1 = event_fn(t, y), event_fn(t + h, after)
        if g0 * g1 < 0:
            return t + h * g0 / (g0 - g1), after
        t, y = t + h, after
