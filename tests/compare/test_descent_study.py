"""The descent along a curve: by the fraction of the way, which does not split."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from compare import study as studies

study = partial(studies.study, "descent")


def test_the_curves_of_the_race_are_marched_to_their_orders() -> None:
    found = study(curve=("parabola", "cycloid"), n=(128, 256, 512, 1024))
    assert {fit.method for fit in found.order} == {"euler", "midpoint", "heun", "rk4", "implicit_midpoint"}
    assert {fit.curve for fit in found.order} == {"parabola", "cycloid"}
    for fit in found.order:
        assert fit.fitted_order == pytest.approx(fit.declared_order, abs=0.08)


def test_a_line_is_met_exactly_by_methods_of_order_two() -> None:
    """w'' is constant, so that all but Euler's method are exact but for rounding."""
    found = study(curve=("line",), n=(512,))
    for cell in found.error_vs_n:
        assert cell.floor == (cell.method != "euler")


def test_a_formula_is_a_curve_like_any_other() -> None:
    named, spelled = (
        study(curve=[curve], n=(256,), methods=("rk4",), t_end="3/4", **ends)
        for curve, ends in (("quartic", {}), ("2*(x/pi)**4", {"start": "pi", "end": "0"}))
    )
    assert named.error_vs_n[0].max_error == pytest.approx(spelled.error_vs_n[0].max_error, rel=1e-6)
    assert spelled.error_vs_n[0].curve == "2*(x/pi)**4"


def test_wide_formats_know_the_constants_of_a_formula() -> None:
    wide, double = (
        study(curve=("quartic",), n=(128,), methods=("rk4",), precision=name) for name in ("float128", "float64")
    )
    assert wide.error_vs_n[0].max_error == pytest.approx(double.error_vs_n[0].max_error, rel=1e-5)
    np.testing.assert_allclose(
        wide.energy_drift[0].max_drift_above_rest, double.energy_drift[0].max_drift_above_rest, rtol=1e-4
    )


def test_what_keeps_the_energy_keeps_it_on_a_curve() -> None:
    (drift,) = study(curve=("quartic",), n=(128,), methods=("projected_rk4",)).energy_drift
    assert drift.max_drift_above_rest < 1e-13
    assert drift.case.cycle == "s"


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"curve": ["spline"]}, "curve 'spline' is unknown"),
        ({"curve": ["x+acos(2)"], "start": 1, "end": 0}, r"is not real and finite: 'acos\(2\)' is the arc cosine of 2"),
        ({"curve": ["x"], "start": "log(-1)", "end": 0}, r"does not start at a finite real number: 'log\(-1\)' is"),
        ({"curve": []}, "curve is empty"),
        ({"curve": ["line", "line"]}, "curve has one curve twice; each is accepted once"),
        ({"t_end": 2}, "a time from 0 to the descent time"),
        ({"t_end": 0}, "t_end is 0.0; a positive number"),
        (
            {"curve": ["x = p - sin(p); y = cos(p)"], "start": "0", "end": "pi"},
            "starts at a cusp, where its equation of motion has no start",
        ),
        ({"methods": ["verlet"]}, "none of verlet fits Descent"),
    ],
)
def test_a_wrong_argument_is_refused_in_one_sentence(arguments: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        study(**arguments)
