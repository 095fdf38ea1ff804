"""The brachistochrone as a motion and as the thesis' curve, singular at the bottom."""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise

import pytest

from compare import study as studies

study = partial(studies.study, "brachistochrone")


def test_the_motion_is_smooth_and_every_method_has_its_order() -> None:
    found = study(n=(256, 512, 1024, 2048), form=("motion",), t_end=5)
    assert len(found.order) == 12
    for fit in found.order:
        assert fit.fitted_order == pytest.approx(fit.declared_order, abs=0.06)


def test_the_curve_costs_rk4_its_order_until_steps_are_short_beside_the_singular_end() -> None:
    """In so many steps as the thesis takes, its figure 7 shows orders from 1.2 to 1.4."""
    found = study(n=[100, 200, 300, 400, 500, *(2**k for k in range(12, 18))], methods=("rk4",), form=("curve",))
    orders = [cell.local_order for cell in found.error_vs_n if cell.local_order is not None]
    assert all(1.2 < order < 1.45 for order in orders[:4])
    assert orders[-2] > 3.5
    assert found.energy_drift == ()


def test_rk4_along_a_curve_is_simpsons_rule() -> None:
    found = study(n=(64,), depth=1, methods=("rk4",), form=("curve",))
    (cell,) = found.error_vs_n

    def slope(y: float) -> float:
        return math.sqrt(y / (2 - y))

    x, errors, h = 0.0, [], 1 / 64
    for i in range(64):
        x += h / 6 * (slope(i * h) + 4 * slope((i + 0.5) * h) + slope((i + 1) * h))
        y = (i + 1) * h
        errors.append(abs(x - (math.acos(1 - y) - math.sqrt(y * (2 - y)))))
    assert cell.max_error == pytest.approx(max(errors) / (math.pi / 2 - 1), rel=1e-6)


def test_roundings_of_the_coordinate_are_known_for_what_they_are() -> None:
    options = {"n": [2**k for k in range(15, 19)], "methods": ("rk4",), "form": ("curve",)}
    found, exact = study(**options), study(**options, precision="float128")
    assert [cell.floor for cell in found.error_vs_n] == [False, False, False, True]
    for cell, other in zip(found.error_vs_n, exact.error_vs_n, strict=True):
        assert cell.rounding / 10 < abs(cell.max_error - other.max_error) < cell.rounding
    assert all(math.isnan(cell.max_velocity_error) for cell in found.error_vs_n)


def test_every_end_point_has_its_own_cycloid() -> None:
    found = study(end=((1, 2), (3, 2)), n=(128, 256), methods=("rk4",))
    assert len(found.cases) == 4
    radii = [cell.radius for cell in found.error_vs_n if cell.form == "curve" and cell.n == 128]
    assert radii == [pytest.approx(2.2 * 1.0, rel=0.5), pytest.approx(1.0013, rel=1e-4)]
    for coarse, fine in pairwise(cell for cell in found.error_vs_n if cell.form == "motion" and cell.end_x == 3.0):
        assert coarse.max_error > 10 * fine.max_error


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"end": [(-1, 2)]}, "end_x is -1.0; a positive number"),
        ({"end": [(1, 2), (1, 2)]}, "end has one point twice"),
        ({"end": []}, "end is empty"),
        ({"depth": 3}, "depth is 3.0; a positive depth up to that of the cycloid"),
        ({"depth": 0}, "depth is 0.0; a positive depth"),
        ({"t_end": -1}, "t_end is -1.0; a positive number"),
        ({"form": ["path"]}, "form 'path' is unknown"),
    ],
)
def test_a_wrong_argument_is_refused_in_one_sentence(arguments: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        study(**arguments)
