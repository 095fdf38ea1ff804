"""No digit that rounding changed is printed unmarked: every score against the same steps in binary128."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from compare.march.march import march
from compare.march.precision import precision
from compare.measure.errors import score_courses
from compare.measure.growth import GROWTH_SAMPLES
from compare.measure.result import Run
from compare.measure.rounding import roundings_of
from compare.measure.scores import score
from compare.measure.truth import Course
from compare.methods import find
from compare.show.digits import DOUBT, ROUNDING, decided, scientific, starred
from reference import Pendulum, PolarBrachistochrone, Tunnel
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.polar.paths import PolarByZ

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reference.problem import Problem

FLOAT64, FLOAT128 = precision("float64"), precision("float128")
EXTRAS = ("phase", "period", "defects")
BOUNDS = {
    "error_vs_n": {
        "max_error": "rounding",
        "rms_error": "rounding",
        "end_error": "rounding",
        "max_velocity_error": "velocity_rounding",
        "rms_velocity_error": "velocity_rounding",
        "end_velocity_error": "velocity_rounding",
    },
    "energy_drift": {
        "max_drift_above_rest": "rounding",
        "max_drift_relative": "relative_rounding",
        "slope_per_period": "slope_rounding",
    },
    "phase": {"max_phase_error": "phase_rounding", "max_amplitude_error": "amplitude_rounding"},
    "period": {"relative_error": "rounding"},
    "defects": {"symplecticity": "symplecticity_rounding", "reversibility": "reversibility_rounding"},
}
FAST, FASTER = Pendulum("0.5", omega0=60, g=1), Pendulum("0.5", omega0=1000, g=1)


def scored(method: str, problem: Problem, counts: tuple[int, ...], fmt: Any, t_end: int = 16) -> Any:
    courses = [Course(problem, n, Fraction(t_end), fmt) for n in counts]
    with np.errstate(all="ignore"):
        return score(find(method), courses, fmt, EXTRAS)


def numbers(method: str, problem: Problem, counts: tuple[int, ...]) -> Iterator[tuple[str, float, float, float]]:
    """What is said of a number, the number, rounding's bound, and the number in binary128."""
    found, true = (scored(method, problem, counts, fmt) for fmt in (FLOAT64, FLOAT128))
    for table, bounds in BOUNDS.items():
        for one, other in zip(found[table], true[table], strict=True):
            for name, bound in bounds.items():
                value, exact = getattr(one, name), getattr(other, name)
                if math.isfinite(value) and math.isfinite(exact):
                    yield f"{method} {one.n} {name}", value, getattr(one, bound), exact


def is_wrong(value: float, bound: float, exact: float) -> bool:
    """Whether a number is printed without a mark, and off by more than one in its last digit."""
    text = starred(value, bound)
    if ROUNDING in text or DOUBT in text:
        return False
    mantissa, power = text.split("e")
    return abs(value - exact) > bound and abs(float(text) - exact) > 10.0 ** (
        int(power) - len(mantissa.partition(".")[2])
    )


@pytest.mark.parametrize(
    ("problem", "method", "counts"),
    [
        (FAST, "kahan_li8", (1024, 16384)),
        (FAST, "gauss6", (1024, 16384)),
        (FASTER, "kahan_li8", (1024, 16384)),
        (Pendulum(3.1415), "rk4", (256, 2048)),
        (PolarBrachistochrone(z0=0.95), "rk4", (512, 4096)),
        (Tunnel(z0=0.9), "rk4", (512, 4096)),
        (Pendulum(1.0, g=1000), "verlet", (16, 64, 256)),
        (Pendulum(1.0, g=1000), "dop853", (16, 64, 256)),
        (FASTER, "verlet", (16, 64, 256)),
    ],
)
def test_no_unmarked_digit_is_one_that_rounding_changed(problem: Problem, method: str, counts: tuple[int, ...]) -> None:
    found = list(numbers(method, problem, counts))
    assert [said for said, *of in found if is_wrong(*of)] == []
    assert len(found) > 10 * len(counts)


def test_the_phase_of_a_fast_rotation_is_rounding_where_its_whole_turns_are_rounded() -> None:
    (wide,) = scored("kahan_li8", FAST, (16384,), FLOAT128)["phase"]
    (found,) = scored("kahan_li8", FAST, (16384,), FLOAT64)["phase"]
    assert wide.max_phase_error == pytest.approx(2.35e-20, rel=0.01)
    assert 1e-12 < found.max_phase_error < 1e-10
    assert ROUNDING in starred(found.max_phase_error, found.phase_rounding)


def test_digits_of_a_phase_that_rounding_leaves_alone_are_printed() -> None:
    (found,) = scored("rk4", Pendulum(1.0), (4096,), FLOAT64)["phase"]
    assert len(starred(found.max_phase_error, found.phase_rounding)) == len("1.00e-09")
    assert found.phase_rounding < 1e-11


@pytest.mark.parametrize("problem", [CycloidCurve(1.0), PolarByZ(0.5), PolarByZ(0.2)])
@pytest.mark.parametrize("name", ["bdf2", "ab4", "am4"])
def test_rounding_is_within_its_bound_on_the_singular_curves_too(problem: Any, name: str) -> None:
    method, end = find(name), Fraction(1999, 1000) if isinstance(problem, CycloidCurve) else 1 - problem.z0
    courses = [Course(problem, n, end * Fraction(9999, 10000), FLOAT64) for n in (128, 1000, 4096)]
    wide = [Course(problem, one.n, one.n * one.h, FLOAT128) for one in courses]
    marches, true = (march(method, [one.lane for one in of], of[0].fmt) for of in (courses, wide))
    errors = [one.errors(result.states) for one, result in zip(courses, marches, strict=True)]
    exact = [one.errors(result.states) for one, result in zip(wide, true, strict=True)]
    bounds = roundings_of(method, courses, marches, errors, FLOAT64)
    shares = [
        float(np.max(one.position_error(a - b))) / bound.position
        for one, a, b, bound in zip(courses, errors, exact, bounds, strict=True)
    ]
    assert max(shares) <= 1
    assert max(shares) > 1e-3


def test_a_lost_march_of_few_steps_takes_no_digits_from_the_finer_ones() -> None:
    courses = [Course(Pendulum(1.0, g=1000), n, Fraction(16), FLOAT64) for n in (16, 64, 16384)]
    with np.errstate(all="ignore"):
        cells, _, bounds = score_courses(find("verlet"), courses, FLOAT64)
    assert cells[0].max_error > 1
    assert [cell.floor for cell in cells] == [False, False, False]
    assert DOUBT in scientific(cells[0].max_error, cells[0].rounding)
    assert bounds[2].position < 1e-6 * cells[2].max_error


def test_an_amplitude_is_rounding_also_where_the_computed_energy_did_not_change() -> None:
    (found,) = scored("discrete_gradient", Pendulum(1.0), (64,), FLOAT64)["phase"]
    assert found.amplitude_rounding > 0
    assert ROUNDING in starred(found.max_amplitude_error, found.amplitude_rounding)


def test_the_growth_of_an_energy_that_is_kept_to_rounding_is_that_of_rounding() -> None:
    course = Course(Pendulum(1.0), 16384, Fraction(256), FLOAT64, GROWTH_SAMPLES)
    found = {one.quantity: one for one in score(find("discrete_gradient"), [course], FLOAT64, ("growth",))["growth"]}
    assert (found["energy"].floor, found["energy"].starts) == (True, 16)
    assert (found["place"].floor, found["place"].starts) == (False, 1)
    assert found["place"].rounding < 0.01


def test_a_number_that_nothing_bounds_is_in_doubt() -> None:
    assert decided(3.14159, math.inf, (".2f", ".0f")) == f"{DOUBT}3"
    assert starred(3.14159, math.inf) == f"3e+00{ROUNDING}"


def test_an_energy_that_did_not_change_has_a_relative_bound_too() -> None:
    (found,) = scored("verlet", Pendulum(1.0), (1 << 12,), FLOAT64)["energy_drift"]
    assert found.relative_rounding == pytest.approx(
        found.rounding * found.max_drift_relative / found.max_drift_above_rest
    )


def test_the_bound_on_a_phase_is_that_of_the_angle_where_the_rotation_is_uniform() -> None:
    """With w0^2 >> g/l the phase is the angle: d(theta) = eps theta at the end, and t d(w) = eps w t before."""
    course = Course(FASTER, 1024, Fraction(16), FLOAT64)
    (cell,), (result,), (bound,) = score_courses(find("kahan_li8"), [course], FLOAT64)
    run = Run(find("kahan_li8"), course, result, cell, bound)
    turned = 16 * 1000 + 0.5
    assert run.phase_rounding / (bound.steps * FLOAT64.epsilon) == pytest.approx(turned + 16 * 1000, rel=0.05)
