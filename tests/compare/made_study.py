"""A study made by hand, of the shape and size of a real one, for the tests of what shows it."""

from __future__ import annotations

import math

import numpy as np

from compare.measure.records import Case, Cell, Drift, FittedOrder, Study, Trace

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


def made_case(theta0: float) -> Case:
    """The pendulum released at an amplitude, in words."""
    return Case(f"Pendulum(theta0={theta0!r})", (("theta0", theta0),), f"theta0 = {theta0!r} rad")


def made_study(
    theta0: tuple[float, ...] = (1.0,),
    n: tuple[int, ...] = tuple(2**k for k in range(7, 21)),
    methods: tuple[str, ...] = tuple(METHODS),
) -> Study:
    """Errors of C h^p, down to a floor, with Euler not finite at the first N."""
    cases = tuple(map(made_case, theta0))
    where = [(method, case) for case in cases for method in methods]
    return Study(
        problem="pendulum",
        parameters={"theta0": list(theta0), "g": 9.81, "length": 1.0, "t_end": 10.0, "n": list(n)},
        reference={"routes": "balls, mpmath, heyoka", "version": "0.1.0"},
        engine={"precision": "float64", "compiler": "heyoka 7.13.2"},
        cases=cases,
        error_vs_n=tuple(cell for pair in where for cell in _cells(*pair, n)),
        order=tuple(_fit(*pair) for pair in where),
        energy_drift=tuple(drift for pair in where for drift in _drifts(*pair, n)),
        units={"theta0": "rad", "g": "m s-2", "length": "m", "t_end": "s"},
        traces=tuple(_trace(*pair) for pair in where),
        exact=tuple(map(_exact, cases)),
    )


def _cells(method: str, case: Case, n: tuple[int, ...]) -> list[Cell]:
    (_, theta0), *_ = case.inputs
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
        cells.append(made_cell(method, count, h, case, error, slope, floor, stages * count))
    return cells


def made_cell(
    method: str, n: int, h: float, case: Case, error: float, slope: float | None, floor: bool, evaluations: int
) -> Cell:
    """A cell whose other errors are in a fixed ratio to the largest."""
    digits = min(15.95, -math.log10(error)) if error > 0 else math.nan
    others = error / 2, 3 * error, error, 1.5 * error, digits, 0
    return Cell(method, n, h, case, error, error / 3, slope, floor, evaluations, *others)


def _fit(method: str, case: Case) -> FittedOrder:
    order = METHODS[method][0]
    if method == "suzuki4":
        return FittedOrder(method, case, order, None, None, 2, None)
    return FittedOrder(method, case, order, order - 0.0013, 0.0021, 7, (256, 16384))


def _drifts(method: str, case: Case, n: tuple[int, ...]) -> list[Drift]:
    order, _, constant = METHODS[method]
    drifts = []
    for count in n:
        h = 10.0 / count
        size = math.inf if method == "euler" and count == n[0] else constant * h**order
        drifts.append(Drift(method, count, h, case, "energy", size, size / 2, -size / 10, size / 100))
    return drifts


def _orbit(case: Case) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    (_, theta0), *_ = case.inputs
    time = np.linspace(0.0, 10.0, 401)
    rate = math.sqrt(9.81) * (1 - theta0**2 / 16)
    return time, theta0 * np.cos(rate * time), -theta0 * rate * np.sin(rate * time)


def _trace(method: str, case: Case) -> Trace:
    time, theta, omega = _orbit(case)
    order, _, constant = METHODS[method]
    size = constant * 0.01**order
    grows = np.exp(size * time) if method == "euler" else np.ones_like(time)
    drift = grows**2 - 1 if method == "euler" else size * np.sin(3 * time) ** 2
    return Trace(method, 1024, case, time, np.stack([theta * grows, omega * grows], axis=1), drift[None])


def _exact(case: Case) -> Trace:
    time, theta, omega = _orbit(case)
    return Trace("exact", 0, case, time, np.stack([theta, omega], axis=1), np.zeros((1, len(time))))
