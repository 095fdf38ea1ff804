"""How errors grow: made ones, those that theory knows, and Brouwer's law of rounding."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from compare.growth import growth_of
from compare.scoring import score_all
from reference import Pendulum

if TYPE_CHECKING:
    from compare.records import Growth

TIMES = np.linspace(0, 1000, 1025)[1:]


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("wave", [0.0, 1.0])
def test_a_power_law_is_found_under_an_oscillation(exponent: float, wave: float) -> None:
    errors = TIMES**exponent * (1.0 - wave + wave * np.sin(2.9 * TIMES))
    found, interval, windows = growth_of(TIMES, errors, 0.0)
    assert found == pytest.approx(exponent, abs=0.05)
    assert interval < 0.1
    assert 4 <= windows <= 8


def test_walks_grow_as_the_root_of_time_and_their_sums_as_its_cube() -> None:
    walks = np.cumsum(np.random.default_rng(3).normal(size=(64, 1024)), axis=1)
    walk, _, _ = growth_of(TIMES, np.sqrt(np.mean(walks**2, axis=0)), 0.0)
    summed, _, _ = growth_of(TIMES, np.sqrt(np.mean(np.cumsum(walks, axis=1) ** 2, axis=0)), 0.0)
    assert walk == pytest.approx(0.5, abs=0.1)
    assert summed == pytest.approx(1.5, abs=0.1)


def test_the_early_windows_are_left_out_where_the_law_is_another() -> None:
    """t + t^2/10 over a thousand: as t^2 in the end."""
    found, _, windows = growth_of(TIMES, TIMES + TIMES**2 / 10, 0.0)
    assert found == pytest.approx(1.98, abs=0.04)
    assert windows < 8


@pytest.mark.parametrize(
    ("errors", "shortest"),
    [(TIMES, 100.0), (np.full(1024, math.nan), 0.0), (np.zeros(1024), 0.0), (TIMES * math.inf, 0)],
)
def test_there_is_no_law_in_too_few_periods_or_without_errors(errors: np.ndarray, shortest: float) -> None:
    found, interval, windows = growth_of(TIMES, errors, shortest)
    assert math.isnan(found)
    assert math.isnan(interval)
    assert windows == 0


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


def test_brouwers_law_is_seen_in_single_precision_and_compensated_summation_ends_it() -> None:
    found = laws(("yoshida4",), n=[2**17], t_end=500, precision="float32", compensated="beside")
    plain, helped = found["yoshida4", "energy"], found["yoshida4_compensated", "energy"]
    assert plain.floor
    assert plain.starts == 16
    assert plain.exponent == pytest.approx(0.5, abs=0.15)
    assert found["yoshida4", "phase"].exponent == pytest.approx(1.5, abs=0.15)
    assert found["yoshida4_compensated", "phase"].law == "t"
    assert helped.exponent < 0.3


def test_the_same_in_double_precision() -> None:
    found = laws(("yoshida6",), n=[2**18], t_end=1000, compensated="beside")
    assert found["yoshida6", "energy"].exponent == pytest.approx(0.5, abs=0.25)
    assert found["yoshida6", "phase"].exponent > 1.2
    assert found["yoshida6_compensated", "phase"].law == "t"
    assert found["yoshida6_compensated", "energy"].exponent < 0.3


def test_a_short_march_has_no_law_and_says_so() -> None:
    found = laws(("verlet",), n=[1024])
    assert {growth.law for growth in found.values()} == {""}
    assert all(math.isnan(growth.exponent) for growth in found.values())
