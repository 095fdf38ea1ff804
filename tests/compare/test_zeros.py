"""Published decimals: the zero of the order conditions beside them is proven, and is what is printed."""

from __future__ import annotations

import pickle
from fractions import Fraction
from math import ceil
from typing import Any

import pytest
from flint import arb
from printed import (
    DOP853_ERROR5,
    DOP853_MATRIX,
    DOP853_WEIGHTS,
    DOP853_WEIGHTS3,
    FLOWS,
    MIDDLE_WEIGHTS,
    TSITOURAS_C5,
    TSITOURAS_DERIVED,
)

from compare.march.precision import precision
from compare.methods import METHODS, find
from compare.methods.embedded import DOP853, TSITOURAS54
from compare.methods.kinds.one_step import Method, Splitting, Tableau
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.order.algebraic import Coefficient, Q, enclose
from compare.methods.order.certified_roots import Coordinates, Linear, Zero, ZeroError, unit
from compare.methods.order.refined import proven_composition
from compare.methods.symplectic import POSITION_VERLET
from reference.arithmetic.precision import ctx

BITS = 320


def coefficients(method: Method) -> list[Coefficient]:
    if isinstance(method, Splitting):
        return [weight for _, weight in method.flows]
    rows: list[tuple[Coefficient, ...]] = []
    if isinstance(method, Tableau):
        rows = [*method.matrix, method.b, *(other.b for other in method.embedded)]
    if isinstance(method, Rosenbrock):
        rows = [*method.a, *method.c, method.m, *(other.b for other in method.embedded)]
    return [entry for row in rows for entry in row]


KNOWN = {value.zero for method in METHODS for value in coefficients(method) if isinstance(value, Linear)}
ZEROS = {zero for zero in KNOWN if isinstance(zero, Zero)}
by_zero = pytest.mark.parametrize("zero", sorted(ZEROS, key=lambda zero: zero.name), ids=lambda zero: zero.name)


def units_away(value: Coefficient, text: str) -> float:
    """The distance between a number and a decimal, in units of the decimal's last place."""
    with ctx.workprec(BITS):
        return float(abs(enclose(value) - enclose(Fraction(text))) / enclose(unit(text)))


@by_zero
def test_every_printed_decimal_is_as_near_to_the_zero_as_its_table_says_and_no_nearer(zero: Zero) -> None:
    distances = [units_away(value, text) for value, text in zip(zero.coordinates, zero.printed, strict=True)]
    assert ceil(max(distances)) == zero.slack


@pytest.mark.parametrize("zero", sorted(KNOWN, key=lambda zero: zero.name), ids=lambda zero: zero.name)
def test_a_zero_is_enclosed_as_narrowly_as_is_asked(zero: Coordinates) -> None:
    for bits in (64, 400):
        with ctx.workprec(bits):
            assert all(ball.rad() < arb(2) ** (8 - bits) for ball in zero.enclosures())


FURTHER = {"blanes_moan4": 2.5, "sabac2": 2, "omelyan4_gp3": 2, "omelyan4_gv4": 5, "processed764": 3, "processed6": 129}
"""Units of the last place by which flows are further from other tables than these would be by rounding alone."""


@pytest.mark.parametrize("name", FLOWS)
def test_the_flows_are_those_of_other_tables(name: str) -> None:
    for (_, weight), text in zip(find(name).flows, FLOWS[name], strict=False):
        assert units_away(weight, text) < FURTHER.get(name, 1.1)


@pytest.mark.parametrize("name", MIDDLE_WEIGHTS)
def test_the_middle_weight_that_is_derived_is_the_printed_one(name: str) -> None:
    middle = [weight for kind, weight in find(name).flows if kind == "drift"]
    assert units_away(middle[len(middle) // 2], MIDDLE_WEIGHTS[name]) < 1


def test_every_digit_of_dop853_is_that_of_its_exact_table() -> None:
    printed = [(DOP853.matrix[i][j], text) for (i, j), text in DOP853_MATRIX.items()]
    printed += [(DOP853.b[j], text) for j, text in DOP853_WEIGHTS.items()]
    printed += [(DOP853.embedded[1].b[j], text) for j, text in DOP853_WEIGHTS3.items()]
    printed += [(DOP853.b[j] - DOP853.embedded[0].b[j], text) for j, text in DOP853_ERROR5.items()]
    assert max(units_away(value, text) for value, text in printed) <= 1
    nonzero = {(i, j) for i, row in enumerate(DOP853.matrix) for j, entry in enumerate(row) if entry != 0}
    assert nonzero == set(DOP853_MATRIX)
    assert {j for j, weight in enumerate(DOP853.b) if weight != 0} == set(DOP853_WEIGHTS)


def test_what_tsitouras_prints_besides_follows_from_his_table() -> None:
    derived: dict[str, Any] = {f"a{i}1": TSITOURAS54.matrix[i - 1][0] for i in (3, 4, 5, 6)}
    derived |= {"b1": TSITOURAS54.b[0], "e1": TSITOURAS54.b[0] - TSITOURAS54.embedded[0].b[0]}
    assert max(units_away(derived[name], text) for name, text in TSITOURAS_DERIVED.items()) < 1.1
    assert units_away(TSITOURAS54.c[4], TSITOURAS_C5) < 1
    assert TSITOURAS54.embedded[0].b[6] == Q(1, 66)


def test_a_wrong_digit_is_found() -> None:
    slipped = ("0.784513610477560", "0.235573213359357", "-1.17767998417987")
    method = proven_composition(POSITION_VERLET, "slipped", 6, "none", slipped, slack=3)
    with pytest.raises(ZeroError, match=r"slipped: -1.17767998417987 is printed, and the zero is at -1.1776799841788"):
        enclose(method.flows[0][1])


def test_decimals_far_from_any_zero_are_refused() -> None:
    zero = Zero("circle", lambda x: [x[0] * x[0] + x[1] * x[1] - 1, x[0] - x[1] - 5], ("0.9", "0.1"))
    with pytest.raises(ZeroError, match="circle: "):
        zero.enclosures()


def test_dependent_equations_are_refused() -> None:
    zero = Zero("line", lambda x: [x[0] - x[1], 2 * x[0] - 2 * x[1]], ("0.5", "0.5"))
    with pytest.raises(ZeroError, match="line: the equations are dependent"):
        zero.enclosures()


def test_as_many_equations_as_unknowns_are_needed() -> None:
    zero = Zero("short", lambda x: [x[0] + x[1] - 1], ("0.5", "0.5"))
    with pytest.raises(ValueError, match="short: 2 unknowns for 1 equations; equally many are accepted"):
        zero.enclosures()


def circle() -> tuple[Linear, ...]:
    return Zero("circle", on_the_diagonal, ("0.707", "0.707")).coordinates


def on_the_diagonal(x: Any) -> list[Any]:
    return [x[0] * x[0] + x[1] * x[1] - 1, x[0] - x[1]]


def test_combinations_of_coordinates_are_exact() -> None:
    x, y = circle()
    assert x + y - x == y
    assert 2 * x - x - x == 0
    assert (x + 1) / 2 + (1 - x) / 2 == 1
    assert Q(1, 3) - x == -(x - Q(1, 3))
    assert x != y
    assert x != Q(707, 1000)
    assert hash(x - x + 3) == hash(Q(3))
    with ctx.workprec(200):
        assert (x.ball() - 1 / arb(2).sqrt()).contains(0)
    assert repr(x).startswith("0.70710678118654752440084")


def test_numbers_of_two_zeros_do_not_mix() -> None:
    x, _ = circle()
    other = Zero("other", on_the_diagonal, ("0.707", "0.707")).coordinates[0]
    with pytest.raises(ValueError, match="circle and other are two zeros"):
        _ = x + other


def test_a_refined_method_survives_pickling_and_rounds_the_same() -> None:
    method = find("kahan_li6")
    again = pickle.loads(pickle.dumps(method))  # noqa: S301 - our own bytes
    assert again == method
    fmt = precision("float128")
    for (_, weight), (_, other) in zip(method.flows, again.flows, strict=True):
        assert fmt.parts(weight) == fmt.parts(other)
