"""Splittings by a flow and its adjoint, of which only Verlet is here."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np


@dataclass
class Parameters:
    step: float
    solver: str
    display: bool


class HamSys:
    def __init__(self, ndof, chi, chi_star):
        assert ndof == 1
        self.chi, self.chi_star = chi, chi_star

    def integrate(self, z0, t_eval, params):
        if params.solver != "Verlet":
            raise ValueError(f"Solver '{params.solver}' not recognized.")
        each = int(np.ceil((t_eval[1] - t_eval[0]) / params.step))
        h = (t_eval[1] - t_eval[0]) / each
        states = [z0.copy()]
        for t in t_eval[:-1]:
            y = states[-1]
            for _ in range(each):
                y = self.chi_star(h / 2, t, self.chi(h / 2, t, y))
            states.append(y)
        return SimpleNamespace(y=np.array(states).T, step=h)
