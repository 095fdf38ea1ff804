"""The brachistochrone of a point mass: in time, in z with its singular end, and in psi."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from compare import study as studies
from reference import PolarBrachistochrone

study = partial(studies.study, "polar")


def test_the_motion_has_an_invariant_and_two_places() -> None:
    found = study(
        n=(1024, 2048, 4096, 8192), form=("time",), methods=("midpoint", "implicit_midpoint", "gauss4"), tau_end=4
    )
    for fit in found.order:
        assert fit.fitted_order == pytest.approx(fit.declared_order, abs=0.08)
    named = {invariant.drift for drift in found.energy_drift for invariant in drift.case.invariants}
    assert named == {("Invariant", "(I - I0)/I0")}
    assert {drift.case.cycle for drift in found.energy_drift} == {"period"}
    assert all(0 < drift.max_drift_above_rest < 1e-3 for drift in found.energy_drift)


def test_the_error_is_the_larger_of_those_of_z_and_phi_each_over_its_size() -> None:
    (cell,) = study(n=(128,), form=("time",), methods=("rk4",), tau_end=4).error_vs_n
    truth = PolarBrachistochrone(z0=0.5).state([4 * i / 128 for i in range(1, 129)])
    y, largest = (1.0, 0.0, 0.0), 0.0
    sizes = np.max(np.abs(truth), axis=0)
    for exact in truth:
        y = step(*y, cell.h)
        largest = max(largest, abs(y[0] - exact[0]) / sizes[0], abs(y[2] - exact[2]) / sizes[2])
    assert cell.max_error == pytest.approx(largest, rel=1e-6)


def step(z: float, rate: float, phi: float, h: float) -> tuple[float, float, float]:
    """RK4 on z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3, kappa = 1/4."""

    def f(y: np.ndarray) -> np.ndarray:
        q = y[0]
        return np.array([y[1], -1 / (2 * q * q) + (2 * q**-5 - 3 * q**-4 + q**-3) / 4, (1 - q) / q**3 / 2])

    y = np.array([z, rate, phi])
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return tuple(y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4))


def test_the_singular_form_loses_the_order_that_the_smooth_one_has() -> None:
    found = study(n=(128, 256, 512), form=("z", "psi"), methods=("rk4",))
    orders = {
        form: [c.local_order for c in found.error_vs_n if c.form == form and c.local_order] for form in ("z", "psi")
    }
    assert all(1 < order < 2 for order in orders["z"])
    assert all(order == pytest.approx(4, abs=0.05) for order in orders["psi"])


def test_every_lowest_point_ends_before_its_own_singularity() -> None:
    found = study(z0=(0.5, 0.25), n=(128,), form=("z",), methods=("euler",))
    assert found.parameters["z_end"] == [0.50005, 0.250075]
    assert all(math.isfinite(cell.max_error) for cell in found.error_vs_n)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"z0": [1.0]}, "z0 is 1.0; a lowest point with 0 < z0 < 1"),
        ({"z0": ["1/10", 0.1]}, "z0 has one lowest point twice"),
        ({"z_end": 0.5}, "z_end is 0.5; a number with 0.5 < z_end < 1"),
        ({"tau_end": 0}, "tau_end is 0.0; a positive number"),
        ({"psi_end": -1}, "psi_end is -1.0; a positive number"),
        ({"form": ["t"]}, "form 't' is unknown"),
    ],
)
def test_a_wrong_argument_is_refused_in_one_sentence(arguments: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        study(**arguments)
