"""How errors grow: made ones, those that theory knows, and Brouwer's law of rounding."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from compare.measure.growth import exponent_of
from compare.scored import score_all
from reference import Pendulum

if TYPE_CHECKING:
    from compare.measure.records import Growth

TIMES = np.linspace(0, 1000, 1025)[1:]


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("wave", [0.0, 1.0])
def test_a_power_law_is_found_under_an_oscillation(exponent: float, wave: float) -> None:
    errors = TIMES**exponent * (1.0 - wave + wave * np.sin(2.9 * TIMES))
    found, interval, windows = exponent_of(TIMES, errors, 0.0)[:3]
    assert found == pytest.approx(exponent, abs=0.05)
    assert interval < 0.1
    assert 4 <= windows <= 8


def test_walks_grow_as_the_root_of_time_and_their_sums_as_its_cube() -> None:
    walks = np.cumsum(np.random.default_rng(3).normal(size=(64, 1024)), axis=1)
    walk, summed = exponent_of(TIMES, walks, 0.0), exponent_of(TIMES, np.cumsum(walks, axis=1), 0.0)
    assert walk.value == pytest.approx(0.5, abs=0.1)
    assert summed.value == pytest.approx(1.5, abs=0.1)
    assert (walk.law, summed.law) == ("sqrt t", "t^3/2")


def test_the_interval_of_a_mean_of_walks_covers_the_exponent_about_as_often_as_it_says() -> None:
    random = np.random.default_rng(5)
    covered = 0
    for _ in range(60):
        found = exponent_of(TIMES, np.cumsum(random.normal(size=(16, 1024)), axis=1), 0.0)
        covered += abs(found.value - 0.5) <= found.interval
    assert covered >= 45


def test_the_early_windows_are_left_out_where_the_law_is_another() -> None:
    """t + t^2/10 over a thousand: as t^2 in the end."""
    found, _, windows = exponent_of(TIMES, TIMES + TIMES**2 / 10, 0.0)[:3]
    assert found == pytest.approx(1.98, abs=0.04)
    assert windows < 8


@pytest.mark.parametrize(
    ("errors", "shortest"),
    [(TIMES, 100.0), (np.full(1024, math.nan), 0.0), (np.zeros(1024), 0.0), (TIMES * math.inf, 0)],
)
def test_there_is_no_law_in_too_few_periods_or_without_errors(errors: np.ndarray, shortest: float) -> None:
    found, interval, windows = exponent_of(TIMES, errors, shortest)[:3]
    assert math.isnan(found)
    assert math.isnan(interval)
    assert windows == 0


def test_what_rounding_makes_of_an_exponent_is_bounded() -> None:
    """An error t with a rounding of r sqrt(t): less of the last errors than of the first."""
    exact, r = exponent_of(TIMES, TIMES, 0.0), 0.01
    off = exponent_of(TIMES, TIMES + r * np.sqrt(1000 * TIMES), 0.0, r * 1000)
    assert exact.rounding == 0
    assert abs(off.value - exact.value) <= off.rounding < 0.2


def laws(methods: tuple[str, ...], **options) -> dict[tuple[str, str], Growth]:
    found = score_all([Pendulum(1.0)], methods, scores=("growth",), **options).asked("growth")
    return {(growth.method, growth.quantity): growth for growth in found or ()}


def test_the_laws_of_truncation_are_those_of_theory() -> None:
    """A symplectic method keeps its energy and falls behind as t; RK4 loses energy as t, and so phase as t^2."""
    found = laws(("verlet", "yoshida4", "implicit_midpoint"), n=[2**16], t_end=1000)
    for method in ("verlet", "yoshida4", "implicit_midpoint"):
        assert found[method, "phase"].law == "t"
        assert found[method, "place"].law == "t"
        assert found[method, "energy"].law == "bounded"
    rk4 = laws(("rk4",), n=[2**17], t_end=8000)
    assert rk4["rk4", "energy"].law == "t"
    assert rk4["rk4", "phase"].law == "t^2"


@pytest.mark.parametrize(
    ("method", "precision", "n", "gain"), [("yoshida4", "float32", 2**17, 5), ("yoshida6", "float64", 2**18, 3)]
)
def test_brouwers_law_is_seen_where_roundings_rule_and_compensated_summation_ends_it(
    method: str, precision: str, n: int, gain: int
) -> None:
    options = {"n": [n], "t_end": 500, "precision": precision, "compensated": "beside"}
    found = laws((method,), **options)
    energy, phase = found[method, "energy"], found[method, "phase"]
    assert energy.floor
    assert energy.starts == 16
    assert abs(energy.exponent - 0.5) < max(energy.interval, 0.2)
    assert abs(phase.exponent - 1.5) < max(phase.interval, 0.3)
    assert found[f"{method}_compensated", "phase"].law == "t"
    plain, helped = score_all([Pendulum(1.0)], (method,), **options).cells
    assert plain.max_error > gain * helped.max_error


def test_a_short_march_has_no_law_and_says_so() -> None:
    found = laws(("verlet",), n=[1024])
    assert {growth.law for growth in found.values()} == {""}
    assert all(math.isnan(growth.exponent) for growth in found.values())
