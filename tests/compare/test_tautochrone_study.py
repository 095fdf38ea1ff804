"""Huygens' pendulum by its angle and by its arc: errors in their own units, held to closed forms."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from compare import study as studies

study = partial(studies.study, "tautochrone")

N = (256, 512, 1024, 2048)


def test_both_forms_are_scored_and_what_cannot_split_the_angle_is_left_out() -> None:
    found = study(n=(256, 512), methods=("rk4", "verlet"))
    assert {(cell.method, cell.form) for cell in found.error_vs_n} == {
        ("rk4", "angle"),
        ("rk4", "arc"),
        ("verlet", "arc"),
    }
    assert found.engine["left out"].endswith("verlet (by the angle, angle = 1.0 rad)")
    assert [case.inputs for case in found.cases] == [
        (("form", "angle"), ("angle", 1.0)),
        (("form", "arc"), ("arc", 4 * math.sin(0.5))),
    ]


def test_every_method_has_its_order_in_both_forms() -> None:
    found = study(n=N, t_end=4)
    assert len({fit.method for fit in found.order}) == 12
    for fit in found.order:
        assert fit.fitted_order == pytest.approx(fit.declared_order, abs=0.06)


def test_the_error_of_verlet_is_that_of_its_closed_form_over_the_largest_arc() -> None:
    """s_n = s_0 cos(n phi) with cos(phi) = 1 - (w h)^2/2, in a hundred steps; s_0 cos(w t) is exact."""
    found = study(angle=(2.0,), n=(100,), methods=("verlet",), form=("arc",))
    (cell,) = found.error_vs_n
    w, h, steps = math.sqrt(9.81 / 4), cell.h, np.arange(1, 101)
    exact = np.cos(w * h * steps)
    errors = np.abs(np.cos(math.acos(1 - (w * h) ** 2 / 2) * steps) - exact) / np.max(np.abs(exact))
    assert cell.max_error == pytest.approx(np.max(errors), rel=1e-9)
    assert cell.rms_error == pytest.approx(math.sqrt(np.mean(errors**2)), rel=1e-9)
    assert cell.end_error == pytest.approx(errors[-1], rel=1e-9)
    assert cell.digits == pytest.approx(-math.log10(np.max(errors)), rel=1e-9)


def test_errors_do_not_depend_on_the_unit_of_length() -> None:
    """Lengths and gravity a thousand times as large are the same motion."""
    options = {"n": (256,), "methods": ("rk4",), "form": ("arc",)}
    (small,), (large,) = (study(radius=r, g=g, **options).error_vs_n for r, g in ((1, 8), (1024, 8192)))
    assert small.max_error == pytest.approx(large.max_error, rel=1e-6)
    assert small.max_velocity_error == pytest.approx(large.max_velocity_error, rel=1e-6)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"angle": [4.0]}, "angle is 4.0; an angle with 0 < |angle| < pi"),
        ({"angle": [1.0, 1.0]}, "angle has one angle twice"),
        ({"form": ["angel"]}, "form 'angel' is unknown, perhaps angle"),
        ({"form": []}, "form is empty"),
        ({"t_end": 0}, "t_end is 0.0; a positive number"),
        ({"form": ["angle"], "methods": ["verlet"]}, "none of verlet fits Tautochrone"),
        ({"scores": ["speed"]}, "score 'speed' is unknown"),
    ],
)
def test_a_wrong_argument_is_refused_in_one_sentence(arguments: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence.replace("|", r"\|")):
        study(**arguments)
