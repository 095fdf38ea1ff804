"""From a ball to the numbers that every one of its points rounds to."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from flint import arb
from hypothesis import assume, given
from hypothesis import strategies as st
from independent import correct_limbs, nearest_double

from reference.arithmetic.limbs import (
    WorkBoundError,
    decimal,
    exact_decimal,
    exact_limbs,
    interval,
    limbs,
    of_ball,
    rounded,
    ziv,
)
from reference.arithmetic.precision import ctx

MANTISSAS = st.integers(-(2**200), 2**200)
EXPONENTS = st.integers(-1300, 700)
LARGEST = Fraction(2**53 - 1) * Fraction(2) ** 971
OVERFLOW = LARGEST + Fraction(2) ** 970


def value_of(mantissa: int, exponent: int) -> Fraction:
    return Fraction(mantissa) * Fraction(2) ** exponent


@given(MANTISSAS, EXPONENTS)
def test_limbs_of_a_point_are_its_successive_nearest_doubles(mantissa, exponent):
    x = value_of(mantissa, exponent)
    expected = correct_limbs(x, 3)
    assert list(limbs((mantissa, mantissa, exponent), 3)) == expected
    assert list(exact_limbs(x, 3)) == expected


@given(st.integers(2**52, 2**53 - 1), st.integers(-1100, 900), st.sampled_from([-1, 1]), st.integers(-1, 1))
def test_ties_go_to_the_even_neighbour_and_only_ties(mantissa, exponent, sign, beside):
    scaled = (2 * mantissa + 1) * 2**60 + beside
    x = sign * value_of(scaled, exponent - 61)
    (value,) = limbs((sign * scaled, sign * scaled, exponent - 61), 1)
    assert value == nearest_double(x)
    if beside == 0 and exponent > -1074:
        assert int(abs(value) / math.ulp(value)) % 2 == 0


@given(MANTISSAS, st.integers(-1300, -1000))
def test_underflow_is_gradual(mantissa, exponent):
    x = value_of(mantissa, exponent)
    assert limbs((mantissa, mantissa, exponent), 1) == (nearest_double(x),)


@pytest.mark.parametrize("exponent", [-(10**6), -(10**15)])
def test_what_is_far_below_the_range_is_zero_at_once(exponent):
    for mantissa in (1, -1, 2**200 + 1):
        assert limbs((mantissa, mantissa, exponent), 2) == (0.0, 0.0)


@pytest.mark.parametrize("exponent", [-(10**12), 10**12])
def test_what_is_too_far_from_one_for_decimals_is_refused_at_once(exponent):
    with pytest.raises(OverflowError, match=rf"^the value is about 2\^{exponent + 2}, too far from 1 for decimals\.$"):
        decimal((3, 3, exponent), 5)
    assert decimal((-1, 3, exponent), 5) is None


def test_the_smallest_subnormal_and_half_of_it():
    assert limbs((1, 1, -1074), 2) == (5e-324, 0.0)
    assert limbs((1, 1, -1075), 1) == (0.0,)
    assert limbs((3, 3, -1075), 1) == (1e-323,)
    assert math.copysign(1, limbs((-1, -1, -1075), 1)[0]) == 1


@given(MANTISSAS, st.integers(0, 2**80), EXPONENTS)
def test_an_interval_is_decided_only_where_both_ends_agree(low, width, exponent):
    ends = [correct_limbs(value_of(end, exponent), 2) for end in (low, low + width)]
    found = limbs((low, low + width, exponent), 2)
    assert (found is None) == (ends[0] != ends[1])
    assert found is None or list(found) == ends[0]


def test_a_ball_across_a_tie_is_not_decided():
    tie = 2**53 + 1
    assert limbs((tie - 1, tie + 1, -53), 1) is None
    assert limbs((tie, tie, -53), 1) == (1.0,)


def test_the_largest_double_is_served_and_what_rounds_above_it_is_refused():
    below = OVERFLOW - 1
    for sign in (1, -1):
        assert limbs((sign * int(below), sign * int(below), 0), 1) == (float(sign * LARGEST),)
        with pytest.raises(OverflowError, match=r"^the value is beyond the range of a double.*for instead\.$"):
            limbs((sign * int(OVERFLOW), sign * int(OVERFLOW), 0), 1)
        with pytest.raises(OverflowError, match=r"beyond the range of a double"):
            exact_limbs(sign * OVERFLOW, 2)


def test_a_wide_ball_across_the_range_is_undecided_rather_than_refused():
    assert limbs((1, 2**1030, 0), 1) is None
    assert limbs((-(2**1030), 2**1030, 0), 1) is None


@given(MANTISSAS, EXPONENTS, st.integers(1, 120), st.none() | st.integers(-1100, 0))
def test_rounding_to_any_number_of_bits_is_to_the_nearest_multiple(mantissa, exponent, bits, lowest):
    found, found_exponent = rounded(mantissa, exponent, bits, lowest)
    x, result = value_of(mantissa, exponent), value_of(found, found_exponent)
    assert abs(found) <= max(2**bits, 1) or found_exponent == exponent
    if (found, found_exponent) != (mantissa, exponent):
        gap = Fraction(2) ** found_exponent
        assert abs(result - x) <= gap / 2
        assert abs(result - x) < gap / 2 or found % 2 == 0
        assert lowest is None or found_exponent >= lowest
        smallest = mantissa.bit_length() - bits + exponent
        assert found_exponent == (smallest if lowest is None else max(smallest, lowest))


@given(st.fractions(), st.integers(1, 60))
def test_a_decimal_is_the_nearest_of_its_length_and_even_in_a_tie(x, digits):
    text = exact_decimal(x, digits)
    if x == 0:
        assert text == "0"
        return
    found = Fraction(text)
    order = math.floor(math.log10(abs(x.numerator)) - math.log10(x.denominator))
    order += (abs(x) >= Fraction(10) ** (order + 1)) - (abs(x) < Fraction(10) ** order)
    unit = Fraction(10) ** (order - digits + 1)
    assert abs(found - x) <= unit / 2
    assert abs(found - x) < unit / 2 or (found / unit).numerator % 2 == 0
    assert len(text.partition("e")[0].lstrip("-0.").replace(".", "")) == digits


@pytest.mark.parametrize(
    ("x", "digits", "text"),
    [
        ("1", 5, "1.0000"),
        ("-1/3", 4, "-0.3333"),
        ("2.5", 1, "2"),
        ("3.5", 1, "4"),
        ("9.9995", 4, "10.00"),
        ("0.00012345", 3, "0.000123"),
        ("1e-30", 3, "1.00e-30"),
        ("123456", 3, "1.23e+5"),
        ("1/7", 20, "0.14285714285714285714"),
        ("183087349942942649625824178151", 31, "183087349942942649625824178151.0"),
        ("0.1000000000000000000000000000000000000003", 41, "0.10000000000000000000000000000000000000030"),
    ],
)
def test_decimals_read_as_people_write_them(x, digits, text):
    assert exact_decimal(Fraction(x), digits) == text


@given(MANTISSAS, st.integers(0, 2**60), st.integers(-200, 200), st.integers(1, 40))
def test_an_interval_has_a_decimal_only_where_its_ends_share_it(low, width, exponent, digits):
    ends = {exact_decimal(value_of(end, exponent), digits) for end in (low, low + width)}
    assert decimal((low, low + width, exponent), digits) == (ends.pop() if len(ends) == 1 else None)


@given(st.integers(-(2**90), 2**90), st.integers(0, 2**20), st.integers(-200, 200))
def test_the_interval_of_a_ball_contains_the_ball(mid, radius, exponent):
    with ctx.workprec(200):
        scale = arb(2) ** exponent
        found = interval(arb(mid, radius) * scale)
    low, high, power = found
    assert value_of(low, power) <= value_of(mid - radius, exponent)
    assert value_of(mid + radius, exponent) <= value_of(high, power)
    assert value_of(high - low, power) <= value_of(2 * radius, exponent) * Fraction(1 + 2**20, 2**20)


@given(MANTISSAS, st.integers(0, 2**60), EXPONENTS, st.integers(1, 4))
def test_a_ball_has_the_limbs_of_its_interval(mid, radius, exponent, count):
    with ctx.workprec(400):
        ball = arb(mid, radius) * arb(2) ** exponent
        expected = limbs(interval(ball), count)
        assert of_ball(ball, count) == expected
    with ctx.workprec(53):
        assert of_ball(ball, count) in (expected, None)


@given(
    st.integers(2**53, 2**54),
    st.integers(-1150, -900) | st.integers(-60, 60) | st.just(970),
    st.sampled_from([-1, 1]),
    st.sampled_from([0, 1, -1]),
    st.sampled_from([0, 1]),
)
def test_a_ball_beside_a_boundary_has_the_limbs_of_its_interval(mantissa, exponent, sign, beside, radius):
    """Halves of a last bit, powers of two and subnormal numbers, each with its neighbours at a distance of 2^-70."""
    for whole in (mantissa, 2**53, 2**54 - 1):
        with ctx.workprec(400):
            ball = arb(sign * (whole * 2**70 + beside), radius) * arb(2) ** (exponent - 70)
            for count in (1, 2, 3):
                assert outcome(of_ball, ball, count) == outcome(lambda x, n: limbs(interval(x), n), ball, count)


def outcome(question, ball, count):
    try:
        return question(ball, count)
    except OverflowError as error:
        return str(error)


def test_what_is_not_finite_has_no_interval_and_is_undecided():
    for ball in (arb("nan"), arb("inf"), arb(0, "inf")):
        assert interval(ball) is None
        assert of_ball(ball, 2) is None
    assert limbs(None, 1) is None
    assert decimal(None, 5) is None


def test_zivs_loop_asks_again_only_for_the_rows_that_are_undecided():
    asked = []

    def enclose(rows):
        asked.append((ctx.prec, list(rows)))
        return [[arb(1) / 3 if row == 0 else (arb(2).sqrt() ** 2)] for row in rows]

    def decide(ball):
        return "third" if ball.rel_accuracy_bits() < 290 and ball < 1 else ("two" if ctx.prec >= 400 else None)

    assert ziv(enclose, decide, 2, 100, "a test") == [["third"], ["two"]]
    assert asked == [(100, [0, 1]), (200, [1]), (400, [1])]


def test_zivs_loop_tells_how_accurate_the_least_of_the_undecided_balls_is():
    told = []

    def more(bits, least):
        told.append((bits, least))
        return 3 * bits

    def enclose(rows):
        return [[arb(1, 2.0**-20), arb(1, 2.0**-50) if ctx.prec < 300 else arb(1)] for _ in rows]

    assert ziv(
        enclose, lambda ball: "" if ball.rel_accuracy_bits() < 40 or ctx.prec > 99 else None, 1, 64, "", 999, more
    )
    assert [(bits, 48 <= least <= 52) for bits, least in told] == [(64, True), (192, False)]


def test_a_value_that_stays_undecided_is_an_error_that_names_it():
    with pytest.raises(WorkBoundError, match=r"^sqrt\(2\) squared could not be decided with 1000 bits"):
        ziv(
            lambda rows: [[arb(2).sqrt() ** 2 - 2] for _ in rows],
            lambda ball: limbs(interval(ball), 1),
            1,
            64,
            "sqrt(2) squared",
            max_bits=1000,
        )


@given(MANTISSAS, EXPONENTS)
def test_the_limbs_of_a_value_add_up_to_it_within_159_bits(mantissa, exponent):
    x = value_of(mantissa, exponent)
    assume(abs(x) > Fraction(2) ** -800)
    assert abs(sum(map(Fraction, limbs((mantissa, mantissa, exponent), 3))) - x) <= abs(x) / 2**159
