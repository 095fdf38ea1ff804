"""Integrators of orbits: a state has an axis more, for several orbits, and of one orbit it is left out at the end."""

from types import SimpleNamespace

import numpy as np


class _Integrator:
    inner = 1

    def __init__(self, func, **options):
        self.func, self.options = func, options

    def __call__(self, w0, t):
        states = [np.array(w0)[:, None]]
        h = (t[1] - t[0]) / self.inner
        for time in t[:-1]:
            w = states[-1]
            for i in range(self.inner):
                w = self.step(time + i * h, w, h)
            states.append(w)
        return SimpleNamespace(w=lambda: np.stack(states, axis=1)[..., 0])


class DOPRI853Integrator(_Integrator):
    inner = 8

    def step(self, t, w, h):
        assert set(self.options) == {"rtol", "atol", "nsteps"}
        k1 = self.func(t, w)
        k2 = self.func(t + h / 2, w + h / 2 * k1)
        k3 = self.func(t + h / 2, w + h / 2 * k2)
        return w + h / 6 * (k1 + 2 * k2 + 2 * k3 + self.func(t + h, w + h * k3))


class LeapfrogIntegrator(_Integrator):
    def step(self, t, w, h):
        size = len(w) // 2
        q = w[:size] + h / 2 * w[size:]
        p = w[size:] + h * self.func(t + h / 2, np.concatenate([q, w[size:]]))[size:]
        return np.concatenate([q + h / 2 * p, p])
