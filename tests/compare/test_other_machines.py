"""What a table prints is what it would print elsewhere: where truncation dominates, to the last digit.

Other machines round otherwise: their vectors are of other lengths, products and sums are fused or not, sines differ in
their last bit.  Binary128 rounds otherwise by far, and makes the same truncation errors where h is the same number.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from compare import layout, march, trace
from compare.scoring import score_all
from reference import Pendulum

METHODS = ("euler", "symplectic_euler", "heun", "verlet", "ruth3", "rk4", "yoshida4", "gauss4", "ab3", "yoshida6")
COUNTS = tuple(2**k for k in range(7, 13))
START = Pendulum(1.0)
"""Ten seconds in powers of two: the step is the same number in every format."""


def same(value: float, rounding: float, other: float, forms: tuple[str, ...] = (".2e", ".1e", ".0e")) -> bool:
    """Whether another number reads as this one is printed, with as many digits, or a mark says that it may not."""
    text = layout.decided(value, rounding, forms)
    decimals = len(text.partition("e")[0].partition(".")[2])
    return text == format(other, f".{decimals}{forms[0][-1]}") or layout.DOUBT in text


@pytest.fixture(scope="module")
def found() -> Any:
    return score_all([START], METHODS, COUNTS)


@pytest.fixture(scope="module")
def wide() -> Any:
    return score_all([START], METHODS, COUNTS, precision="float128")


def test_the_step_is_the_same_number() -> None:
    assert all(Fraction(10, n).denominator & (Fraction(10, n).denominator - 1) == 0 for n in COUNTS)


def test_errors_and_orders_read_as_in_binary128(found: Any, wide: Any) -> None:
    compared = 0
    for cell, other in zip(found.cells, wide.cells, strict=True):
        if not cell.floor:
            assert same(cell.max_error, cell.rounding, other.max_error), (cell.method, cell.n)
            compared += layout.DOUBT not in layout.scientific(cell.max_error, cell.rounding)
            if cell.local_order is not None:
                forms = (".2f", ".1f", ".0f")
                assert same(cell.local_order, cell.order_rounding, other.local_order, forms), (cell.method, cell.n)
    assert compared > 0.8 * len(found.cells)


def test_drifts_read_as_in_binary128(found: Any, wide: Any) -> None:
    for drift, other in zip(found.drifts, wide.drifts, strict=True):
        if not layout.is_rounding(drift.max_drift_above_rest, drift.rounding):
            assert same(drift.max_drift_above_rest, drift.rounding, other.max_drift_above_rest), (drift.method, drift.n)
        if not layout.is_rounding(drift.slope_per_period, drift.slope_rounding):
            assert same(drift.slope_per_period, drift.slope_rounding, other.slope_per_period), (drift.method, drift.n)


def test_other_code_for_the_same_steps_prints_the_same(found: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A sine with other last bits, code optimized, lanes in vectors of another length."""
    compile_block = trace.compile_block

    def otherwise(*arguments: Any, inline_sine: bool = False, brief: bool = False, **options: Any) -> Any:
        return compile_block(*arguments, inline_sine=not inline_sine, brief=not brief, **options)

    march._compiled.cache_clear()
    monkeypatch.setattr("compare.march.compile_block", otherwise)
    others = score_all([START], METHODS, COUNTS)
    march._compiled.cache_clear()
    changed = 0
    for cell, other in zip(found.cells, others.cells, strict=True):
        changed += cell.max_error != other.max_error
        if not cell.floor:
            assert same(cell.max_error, cell.rounding, other.max_error), (cell.method, cell.n)
            assert cell.rounding == other.rounding
    assert changed > len(found.cells) / 2
