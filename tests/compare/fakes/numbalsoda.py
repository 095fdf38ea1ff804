"""Solvers that fill arrays through functions (t, u, du, data), and say of a failure no more than that it was one."""

import ctypes
import sys
from itertools import pairwise
from types import SimpleNamespace

import numpy as np

lsoda_sig = "signature"


def _step(function, t, u, h, data):
    slopes = [np.zeros(len(u)) for _ in range(4)]
    for i, part in enumerate((0.0, 0.5, 0.5, 1.0)):
        function(t, u + part * h * slopes[i - 1] if i else u, slopes[i], data)
    return u + h / 6 * (slopes[0] + 2 * slopes[1] + 2 * slopes[2] + slopes[3])


def lsoda(function, u0, t_eval, data, rtol, atol, mxstep):
    if rtol < 1e-12:
        print("lsoda -- too much accuracy requested", file=sys.stderr)
        return np.zeros((len(t_eval), len(u0))), False
    u, found = u0, [u0]
    for before, after in pairwise(t_eval):
        for i in range(8):
            h = (after - before) / 8
            u = _step(function, before + i * h, u, h, data)
        found.append(u)
    return np.array(found), True


dop853 = lsoda


def solve_ivp(function, t_span, u0, n_events, event_fcn, data, rtol, atol):
    assert n_events == 1
    data = np.ctypeslib.as_array((ctypes.c_double * 3).from_address(data))
    t, u, h = 0.0, u0, 1e-3
    out = np.zeros(1)
    while t < t_span[1]:
        event_fcn(t, u, out, data)
        g0 = out[0]
        u = _step(function, t, u, h, data)
        event_fcn(t + h, u, out, data)
        if g0 * out[0] < 0:
            return SimpleNamespace(success=True, event_found=True, t_event=t + h * g0 / (g0 - out[0]))
        t += h
    return SimpleNamespace(success=True, event_found=False, t_event=0.0)
