"""What a table prints is what it would print elsewhere: to the last digit, but where a mark says that it may not.

Other machines round otherwise: their vectors are of other lengths, products and sums are fused or not, sines differ in
their last bit.  Binary128 rounds otherwise by far, and makes the same truncation errors where h is the same number.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import Any

import pytest

from compare.march import march, trace
from compare.scored import Scored, score_all
from compare.show import digits
from compare.show import study as table
from reference import Pendulum, PolarBrachistochrone, Tautochrone

METHODS = ("euler", "heun", "verlet", "ruth3", "rk4", "yoshida4", "gauss4", "ab4", "yoshida6", "kahan_li8")
COUNTS = tuple(2**k for k in range(7, 13))
PROBLEMS = (
    Pendulum(1.0),
    Pendulum(3.0),
    Pendulum(3.141),
    Pendulum(1.0, omega0=8.0),
    Tautochrone(2.0, 1),
    PolarBrachistochrone(z0=0.5),
)
"""Ten units of time in powers of two: the step is the same number in every format."""
ERRORS, ORDERS = (".2e", ".1e", ".0e"), (".2f", ".1f", ".0f")


@cache
def scored(precision: str) -> Scored:
    return score_all(PROBLEMS, METHODS, COUNTS, precision=precision)


@pytest.fixture(scope="module")
def elsewhere() -> Any:
    """The same by a sine with other last bits, and by code that is optimized otherwise."""
    compile_block = trace.compile_block

    def otherwise(*arguments: Any, inline_sine: bool = False, brief: bool = False, **options: Any) -> Any:
        return compile_block(*arguments, inline_sine=not inline_sine, brief=not brief, **options)

    with pytest.MonkeyPatch.context() as patch:
        march._compiled.cache_clear()
        patch.setattr("compare.march.march.compile_block", otherwise)
        found = score_all(PROBLEMS, METHODS, COUNTS)
    march._compiled.cache_clear()
    return found


def same(value: float, rounding: float, other: float, forms: tuple[str, ...] = ERRORS) -> bool:
    """Whether another number reads as this one is printed, with as many digits, or a mark says that it may not."""
    text = digits.decided(value, rounding, forms)
    decimals = len(text.partition("e")[0].partition(".")[2])
    return digits.DOUBT in text or text == format(other, f".{decimals}{forms[0][-1]}")


def test_the_step_is_the_same_number() -> None:
    assert all(Fraction(10, n).denominator & (Fraction(10, n).denominator - 1) == 0 for n in COUNTS)


def differing(found: Scored, others: Scored) -> list[tuple[str, int, str]]:
    """The cells without a mark that another run would print otherwise."""
    bad = []
    for cell, other in zip(found.cells, others.cells, strict=True):
        if cell.floor:
            continue
        fine = same(cell.max_error, cell.rounding, other.max_error)
        if cell.local_order is not None and other.local_order is not None:
            fine &= same(cell.local_order, cell.order_rounding, other.local_order, ORDERS)
        if not fine:
            bad.append((cell.method, cell.n, cell.case.label))
    for drift, twin in zip(found.drifts, others.drifts, strict=True):
        values = (drift.max_drift_above_rest, drift.rounding), (drift.slope_per_period, drift.slope_rounding)
        twins = twin.max_drift_above_rest, twin.slope_per_period
        for (value, rounding), its in zip(values, twins, strict=True):
            if not digits.is_rounding(value, rounding) and not same(value, rounding, its):
                bad.append((drift.method, drift.n, drift.case.label))
    return bad


def test_numbers_without_a_mark_read_as_in_binary128() -> None:
    found = scored("float64")
    assert differing(found, scored("float128")) == []
    told = [cell for cell in found.cells if not cell.floor]
    assert len(told) > 0.6 * len(found.cells)
    assert sum(digits.DOUBT not in digits.scientific(cell.max_error, cell.rounding) for cell in told) > 0.9 * len(told)


def test_numbers_without_a_mark_read_as_on_another_machine(elsewhere: Scored) -> None:
    found = scored("float64")
    assert differing(found, elsewhere) == []
    assert sum(a.max_error != b.max_error for a, b in zip(found.cells, elsewhere.cells, strict=True)) > 100


def test_marks_and_bounds_are_those_of_another_machine(elsewhere: Scored) -> None:
    for cell, other in zip(scored("float64").cells, elsewhere.cells, strict=True):
        name = cell.method, cell.n, cell.case.label
        if cell.max_error < 1:
            assert cell.rounding == other.rounding, name
        else:  # a march that is lost has its bound from a neighbour that was marched with it
            assert not abs(cell.max_error - other.max_error) > cell.rounding + other.rounding, name
        clear = cell.max_error > 4 * cell.rounding or cell.max_error < cell.rounding
        assert cell.floor == other.floor or not clear, name


def test_fitted_orders_read_as_on_another_machine(elsewhere: Scored) -> None:
    pairs = zip(scored("float64").orders, elsewhere.orders, strict=True)
    texts = [(table._fitted(fit), table._fitted(other), fit.method, fit.case.label) for fit, other in pairs]
    assert [pair for pair in texts if pair[0] != pair[1]] == []
