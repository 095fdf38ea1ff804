"""No digit is printed that rounding, and so another machine, may change."""

from __future__ import annotations

import math

import numpy as np
import pytest
from made_study import made_case, made_cell

from compare.measure.order_fit import fit_order
from compare.methods import find
from compare.show.digits import DOUBT, decided, is_rounding, scientific, starred


@pytest.mark.parametrize(
    ("value", "rounding", "shown"),
    [
        (4.3912e-13, 0.0, "4.39e-13"),
        (4.3912e-13, 1e-16, "4.39e-13"),
        (4.3912e-13, 2e-15, "4.4e-13"),
        (4.3912e-13, 9e-15, "4e-13"),
        (4.3912e-13, 9e-14, "~4e-13"),
        (-4.3912e-13, 2e-15, "-4.4e-13"),
        (4.395e-13, 1e-17, "4.4e-13"),  # between two of three digits, whatever is done
        (0.0, 0.0, "0.00e+00"),
        (1.0, math.nan, "1.00e+00"),
        (math.inf, 1.0, "inf"),
        (math.nan, 0.0, "nan"),
    ],
)
def test_a_number_has_the_digits_that_rounding_leaves(value: float, rounding: float, shown: str) -> None:
    assert scientific(value, rounding) == shown


def test_what_is_printed_is_what_another_rounding_would_print() -> None:
    random = np.random.default_rng(7)
    for _ in range(2000):
        value = float(10 ** random.uniform(-14, 1))
        rounding = float(value * 10 ** random.uniform(-8, -1))
        other = value + rounding * float(random.uniform(-1, 1))
        text = scientific(value, rounding)
        if DOUBT not in text:
            assert format(other, f".{len(text.partition('e')[0].partition('.')[2])}e") == text


def test_a_number_of_rounding_is_marked() -> None:
    assert starred(1.9e-14, 1e-14) == "2e-14*"
    assert starred(-1.9e-14, 1e-14) == "-2e-14*"
    assert starred(5e-14, 1e-14) == "~5e-14"
    assert not is_rounding(0.0, 0.0)
    assert not is_rounding(1.0, math.nan)


def test_an_order_has_the_decimals_that_rounding_leaves() -> None:
    forms = (".4f", ".3f", ".2f")
    assert decided(3.98312, 1e-7, forms) == "3.9831"
    assert decided(3.98312, 1e-4, forms) == "3.983"
    assert decided(3.98312, 1.0, forms) == "~3.98"


def test_a_cell_of_which_rounding_is_a_part_weighs_less_in_the_fitted_order() -> None:
    method, case = find("rk4"), made_case(1.0)
    clean = [made_cell("rk4", 2**k, 10 / 2**k, case, 2.0 ** (-4 * k), 4.0, False, 4) for k in range(7, 12)]
    last = clean[-1]
    object.__setattr__(last, "max_error", last.max_error * 1.02)
    heavy = fit_order(method, clean).fitted_order
    object.__setattr__(last, "rounding", 0.02 * last.max_error)
    light = fit_order(method, clean)
    assert heavy is not None
    assert light.fitted_order is not None
    assert abs(light.fitted_order - 4) < abs(heavy - 4) / 2
    assert 0 < light.rounding < 0.02
