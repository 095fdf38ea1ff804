"""A simulation of one particle under additional forces, by leapfrog steps."""

import math
from types import SimpleNamespace


class Simulation:
    def __init__(self):
        self._integrator = SimpleNamespace(epsilon=1e-9, adaptive_mode="prs23")
        self.particles, self.t, self.stopped = [], 0.0, False
        self.gravity, self.additional_forces = "basic", None

    @property
    def integrator(self):
        return self._integrator

    @integrator.setter
    def integrator(self, name):
        assert name == "ias15"

    def add(self, m, x, vx):
        self.particles.append(SimpleNamespace(m=m, x=x, vx=vx, ax=0.0))

    def stop(self):
        self.stopped = True

    def integrate(self, time):
        assert self.gravity == "none"
        (one,) = self.particles
        fine = 2 if self._integrator.adaptive_mode == "global" else 1
        steps = max(1, fine * math.ceil((time - self.t) / math.sqrt(self._integrator.epsilon)))
        h = (time - self.t) / steps
        for _ in range(steps):
            if self.stopped:
                return
            one.x += h / 2 * one.vx
            self.additional_forces(SimpleNamespace(contents=self))
            one.vx += h * one.ax
            one.x += h / 2 * one.vx
        self.t = time
