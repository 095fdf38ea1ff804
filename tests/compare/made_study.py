"""A study made by hand, of the shape and size of a real one, for the tests of what shows it."""

from __future__ import annotations

import math

import numpy as np

from compare.records import Cell, Drift, FittedOrder, Study, Trace

METHODS = {
    "euler": (1, 1, 3.0),
    "symplectic_euler": (1, 1, 0.1),
    "symplectic_euler_adjoint": (1, 1, 0.12),
    "midpoint": (2, 2, 9.0),
    "heun": (2, 2, 11.0),
    "verlet": (2, 1, 1.4),
    "position_verlet": (2, 1, 0.7),
    "implicit_midpoint": (2, 6, 2.8),
    "ruth3": (3, 3, 0.5),
    "rk4": (4, 4, 1.0),
    "yoshida4": (4, 3, 8.0),
    "suzuki4": (4, 5, 0.3),
}
FLOOR = 2e-14


def made_study(
    theta0: tuple[float, ...] = (1.0,),
    n: tuple[int, ...] = tuple(2**k for k in range(7, 21)),
    methods: tuple[str, ...] = tuple(METHODS),
) -> Study:
    """Errors of C h^p, down to a floor, with Euler not finite at the first N."""
    where = [(method, amplitude) for amplitude in theta0 for method in methods]
    return Study(
        problem="pendulum",
        parameters={"theta0": list(theta0), "g": 9.81, "length": 1.0, "t_end": 10.0, "n": list(n)},
        reference={"routes": "balls, mpmath, heyoka", "version": "0.1.0"},
        engine={"precision": "float64", "compiler": "heyoka 7.13.2"},
        error_vs_n=tuple(cell for pair in where for cell in _cells(*pair, n)),
        order=tuple(_fit(*pair) for pair in where),
        energy_drift=tuple(drift for pair in where for drift in _drifts(*pair, n)),
        traces=tuple(_trace(*pair) for pair in where),
        exact=tuple(_exact(amplitude) for amplitude in theta0),
    )


def _cells(method: str, theta0: float, n: tuple[int, ...]) -> list[Cell]:
    order, stages, constant = METHODS[method]
    cells: list[Cell] = []
    for count in n:
        h = 10.0 / count
        error = constant * h**order * theta0
        error = max(error, FLOOR * math.sqrt(count / 128))
        if method == "euler" and count == n[0]:
            error = math.nan
        slope = math.log2(cells[-1].max_error / error) if cells and math.isfinite(cells[-1].max_error) else None
        floor = error < 10 * FLOOR * math.sqrt(count / 128)
        cells.append(Cell(method, count, h, theta0, error, error / 3, slope, floor, stages * count))
    return cells


def _fit(method: str, theta0: float) -> FittedOrder:
    order = METHODS[method][0]
    if method == "suzuki4":
        return FittedOrder(method, theta0, order, None, None, 2, None)
    return FittedOrder(method, theta0, order, order - 0.0013, 0.0021, 7, (256, 16384))


def _drifts(method: str, theta0: float, n: tuple[int, ...]) -> list[Drift]:
    order, _, constant = METHODS[method]
    drifts = []
    for count in n:
        h = 10.0 / count
        size = math.inf if method == "euler" and count == n[0] else constant * h**order
        drifts.append(Drift(method, count, h, theta0, size, size / 2, -size / 10, size / 100))
    return drifts


def _orbit(theta0: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    time = np.linspace(0.0, 10.0, 401)
    rate = math.sqrt(9.81) * (1 - theta0**2 / 16)
    return time, theta0 * np.cos(rate * time), -theta0 * rate * np.sin(rate * time)


def _trace(method: str, theta0: float) -> Trace:
    time, theta, omega = _orbit(theta0)
    order, _, constant = METHODS[method]
    size = constant * 0.01**order
    grows = np.exp(size * time) if method == "euler" else np.ones_like(time)
    drift = grows**2 - 1 if method == "euler" else size * np.sin(3 * time) ** 2
    return Trace(method, 1024, theta0, time, theta * grows, omega * grows, drift)


def _exact(theta0: float) -> Trace:
    time, theta, omega = _orbit(theta0)
    return Trace("exact", 0, theta0, time, theta, omega, np.zeros_like(time))
