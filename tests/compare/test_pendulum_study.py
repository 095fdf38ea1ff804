"""The pendulum study as a whole."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from compare import study as studies
from compare.methods import DEFAULT
from reference import Pendulum

study = partial(studies.study, "pendulum")


def test_a_study_has_a_cell_a_drift_and_an_order_for_everything_asked() -> None:
    found = study(theta0=(1.0, 0.5), n=(256, 128), methods=("rk4", "verlet", "velocity_verlet"))
    keys = {(cell.method, cell.theta0, cell.n) for cell in found.error_vs_n}
    assert keys == {(name, theta0, n) for name in ("rk4", "verlet") for theta0 in (1.0, 0.5) for n in (128, 256)}
    assert keys == {(drift.method, drift.theta0, drift.n) for drift in found.energy_drift}
    assert [(order.method, order.theta0) for order in found.order] == [
        ("rk4", 1.0), ("rk4", 0.5), ("verlet", 1.0), ("verlet", 0.5),
    ]  # fmt: skip
    assert found.parameters["theta0"] == [1.0, 0.5]


def test_the_default_methods_fit_their_declared_orders() -> None:
    found = study(n=[2**k for k in range(9, 15)])
    assert [order.method for order in found.order] == [method.name for method in DEFAULT]
    for order in found.order:
        assert order.fitted_order == pytest.approx(order.declared_order, abs=0.08)


def test_traces_start_at_the_start_and_the_exact_one_is_exact() -> None:
    found = study(theta0=(1.0,), n=(128,), methods=("euler", "verlet"), traces=True)
    assert [trace.method for trace in found.traces] == ["euler", "verlet"]
    (exact,) = found.exact
    for trace in (*found.traces, exact):
        assert len(trace.time) == len(trace.states) == trace.drifts.shape[1] == 128 + 1
        assert (trace.time[0], *trace.states[0], trace.drifts[0][0]) == (0, 1, 0, 0)
    np.testing.assert_array_equal(exact.states, Pendulum(1.0).state(exact.time))
    assert np.max(np.abs(exact.drifts)) < 1e-14
    assert found.traces[0].drifts[0][-1] > 0.5


def test_progress_is_told_each_method_once() -> None:
    told: list[str] = []
    study(n=(128,), methods=("rk4", "euler"), progress=told.append)
    assert sorted(told) == ["euler", "rk4"]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"n": [0]}, "n is 0; a positive integer"),
        ({"n": [-128]}, "n is -128; a positive integer"),
        ({"n": [1.5]}, "n is 1.5; a positive integer"),
        ({"n": [True]}, "n is True; a positive integer"),
        ({"n": []}, "n is empty"),
        ({"theta0": []}, "theta0 is empty"),
        ({"theta0": ["0.1", 0.1]}, "theta0 has one amplitude twice"),
        ({"theta0": [0.0]}, "theta0 is 0.0; an amplitude"),
        ({"theta0": [math.nan]}, "theta0 is nan, which is not finite"),
        ({"t_end": 0}, "t_end is 0.0; a positive number"),
        ({"t_end": math.inf}, "t_end is inf, which is not finite"),
        ({"g": -9.81}, "g is -9.81; a positive number"),
        ({"length": 0}, "length is 0.0; a positive number"),
        ({"methods": []}, "methods is empty"),
        ({"methods": ["rk5"]}, "method 'rk5' is unknown, perhaps rk45"),
        ({"precision": "float16"}, "precision 'float16' is unknown"),
    ],
)
def test_a_wrong_argument_is_refused_in_one_sentence(arguments: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        study(**arguments)
