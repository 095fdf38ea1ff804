"""A simulation of particles under additional forces, by leapfrog steps, or of an equation, by Runge and Kutta's."""

import math
from types import SimpleNamespace


class Simulation:
    def __init__(self):
        self._integrator = SimpleNamespace(epsilon=1e-9, adaptive_mode="prs23", eps_rel=1e-8, eps_abs=1e-8)
        self._ode = None
        self.particles, self.t, self.stopped = [], 0.0, False
        self.gravity, self.additional_forces = "basic", None

    @property
    def integrator(self):
        return self._integrator

    @integrator.setter
    def integrator(self, name):
        assert name in {"ias15", "bs"}

    def add(self, m, **place):
        axes = {f"a{axis}": 0.0 for axis in place if not axis.startswith("v")}
        self.particles.append(SimpleNamespace(m=m, **place, **axes))

    def stop(self):
        self.stopped = True

    def create_ode(self, length, needs_nbody):
        assert not needs_nbody
        self._ode = SimpleNamespace(y=[0.0] * length, derivatives=None)
        return self._ode

    def _rates(self, t, y):
        rates = [0.0] * len(y)
        self._ode.derivatives(self._ode, rates, y, t)
        return rates

    def _march(self, time):
        steps = 16 if time > self.t else 0
        for i in range(steps):
            h = (time - self.t) / steps
            t, y, k = self.t + i * h, self._ode.y, [0.0] * len(self._ode.y)
            slopes = []
            for part in (0.0, 0.5, 0.5, 1.0):
                k = self._rates(t + part * h, [one + part * h * slope for one, slope in zip(y, k, strict=True)])
                slopes.append(k)
            self._ode.y = [one + h / 6 * (a + 2 * b + 2 * c + d) for one, a, b, c, d in zip(y, *slopes, strict=True)]
        self.t = time

    def integrate(self, time):
        if self._ode is not None:
            self._march(time)
            return
        assert self.gravity == "none"
        fine = 2 if self._integrator.adaptive_mode == "global" else 1
        steps = max(1, fine * math.ceil((time - self.t) / math.sqrt(self._integrator.epsilon)))
        h = (time - self.t) / steps
        for _ in range(steps):
            if self.stopped:
                return
            self._drift(h / 2)
            self.additional_forces(SimpleNamespace(contents=self))
            for one in self.particles:
                for name in [name for name in vars(one) if name.startswith("a")]:
                    setattr(one, f"v{name[1:]}", getattr(one, f"v{name[1:]}") + h * getattr(one, name))
            self._drift(h / 2)
        self.t = time

    def _drift(self, h):
        for one in self.particles:
            for name in [name for name in vars(one) if name.startswith("v")]:
                setattr(one, name[1:], getattr(one, name[1:]) + h * getattr(one, name))
