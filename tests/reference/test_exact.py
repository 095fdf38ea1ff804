"""Inputs are exact real numbers."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.arithmetic.exact import MAX_DIGITS, as_number, exact, exact_array, expansion, positive, spelled

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


def test_a_float_is_its_binary64_value_and_a_string_its_decimal():
    assert exact(9.81) == Fraction("9.8100000000000004973799150320701301097869873046875")
    assert exact("9.81") == Fraction(981, 100)
    assert exact(9.81) != exact("9.81")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (3, Fraction(3)),
        (np.int8(-3), Fraction(-3)),
        (np.uint64(2**64 - 1), Fraction(2**64 - 1)),
        (np.float16(0.1), Fraction(819, 8192)),
        (np.float32(0.1), Fraction(13421773, 2**27)),
        (np.float64(0.1), Fraction(0.1)),
        (np.longdouble(1) + np.finfo(np.longdouble).eps, 1 + Fraction(float(np.finfo(np.longdouble).eps))),
        (np.array(0.5), Fraction(1, 2)),
        (np.array("1/3"), Fraction(1, 3)),
        (Decimal("0.1"), Fraction(1, 10)),
        (Decimal("1e400"), Fraction(10**400)),
        (Fraction(1, 3), Fraction(1, 3)),
        ("1/3", Fraction(1, 3)),
        ("-2.5e-3", Fraction(-1, 400)),
        (" 7 ", Fraction(7)),
        (5e-324, Fraction(1, 2**1074)),
    ],
)
def test_every_kind_of_real_number_is_taken_exactly(value, expected):
    found = exact(value)
    assert type(found) is Fraction
    assert found == expected


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, np.float32("nan"), np.longdouble("inf")])
def test_what_is_not_finite_is_refused(value):
    with pytest.raises(ValueError, match=r"^theta0 is -?(nan|inf), which is not finite; a finite number"):
        exact(value, "theta0")


@pytest.mark.parametrize("value", [Decimal("NaN"), Decimal("sNaN"), Decimal("-Infinity")])
def test_a_decimal_that_is_not_finite_is_refused(value):
    with pytest.raises(ValueError, match=r"which is not finite; a finite number"):
        exact(value)


@pytest.mark.parametrize("text", ["", "one", "nan", "inf", "1/0", "0x10", "1e", "1,5", "1 2", "1e²", "one" * 2000])
def test_a_string_that_spells_no_number_is_refused(text):
    with pytest.raises(ValueError, match=r"^g is '.*, which spells no number; a finite number") as error:
        exact(text, "g")
    assert len(str(error.value)) < 200


@pytest.mark.parametrize("text", ["1e4001", "1e-4001", "1e999999999", "-3.5E+123456789", "1e" + "9" * 5000])
def test_an_exponent_that_would_fill_the_memory_is_refused(text):
    with pytest.raises(ValueError, match=r"whose exponent is beyond the limit of 4000") as error:
        exact(text)
    assert len(str(error.value)) < 200


@pytest.mark.parametrize("text", ["9" * 5000, "-0." + "0" * 5000 + "1", "1/" + "3" * 4500, "9" * 4200])
def test_a_text_of_thousands_of_digits_is_told_to_be_too_long(text):
    with pytest.raises(ValueError, match=rf"^t has a numerator or denominator of more than {MAX_DIGITS} digits; fewer"):
        exact(text, "t")


@pytest.mark.parametrize("value", [Decimal("1e999999"), 10**4100, Fraction(1, 10**4100), np.longdouble("1e4900")])
def test_a_number_of_thousands_of_digits_is_refused(value):
    with pytest.raises(ValueError, match=rf"{MAX_DIGITS}"):
        exact(value)


@pytest.mark.parametrize(
    "value", [True, np.True_, 1j, np.complex64(1), None, [1.0], b"1", {}, object(), np.timedelta64(5, "s")]
)
def test_what_is_no_real_number_is_refused(value):
    with pytest.raises(TypeError, match=r"a finite number, a decimal string such as '9.81', or a Fraction is accepted"):
        exact(value)


@pytest.mark.parametrize(
    ("values", "shape"),
    [
        (1.5, ()),
        ("1/3", ()),
        (np.float32(1.5), ()),
        (np.array(1.5), ()),
        ([1, 2.5, "3"], (3,)),
        ((Fraction(1, 3),), (1,)),
        ([[1, 2], [3, 4]], (2, 2)),
        (np.zeros((2, 3, 4), dtype=np.float32), (2, 3, 4)),
        (range(5), (5,)),
        ((x / 4 for x in range(3)), (3,)),
        ([np.array([1.0, 2.0]), np.array([3.0, 4.0])], (2, 2)),
        (np.array([["1/3", "2"]]), (1, 2)),
    ],
)
def test_arrays_keep_their_shape(values, shape):
    found, found_shape = exact_array(values)
    assert found_shape == shape
    assert len(found) == math.prod(shape)
    assert all(type(value) is Fraction for value in found)


def test_elements_come_in_c_order_whatever_the_memory_layout():
    array = np.asfortranarray(np.arange(6.0).reshape(2, 3))
    assert exact_array(array)[0] == [0, 1, 2, 3, 4, 5]
    assert exact_array(array.T[::-1])[0] == [2, 5, 1, 4, 0, 3]


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.longdouble, object])
def test_no_array_type_rounds_its_elements(kind):
    third = kind(1) / kind(3) if kind is not object else Fraction(1, 3)
    found, _ = exact_array(np.array([third, kind(2) if kind is not object else "2"], dtype=kind))
    assert found == [exact(third), 2]
    if kind is np.longdouble:
        above_one = np.nextafter(np.longdouble(1), np.longdouble(2))
        assert exact_array(np.array([above_one]))[0][0] - 1 == Fraction(float(np.finfo(np.longdouble).eps))


def test_big_endian_and_strided_arrays_are_read_by_value():
    assert exact_array(np.array([1.5, 2.5], dtype=">f8")[::-1])[0] == [Fraction(5, 2), Fraction(3, 2)]


@pytest.mark.parametrize("values", [[], (), [[]], np.zeros((0, 3)), iter(())])
def test_an_empty_array_is_refused(values):
    with pytest.raises(ValueError, match=r"^t is empty; at least one number is accepted"):
        exact_array(values, "t")


@pytest.mark.parametrize("values", [[[1, 2], [3]], [1, [2]], [np.array([1.0, 2.0]), np.array([3.0])]])
def test_a_ragged_array_is_refused(values):
    with pytest.raises(ValueError, match=r"^t is ragged; an array with rows of one length is accepted"):
        exact_array(values, "t")


@pytest.mark.parametrize("values", [np.array([1.0, np.nan]), [1.0, math.inf], ["1", "x"]])
def test_one_bad_element_refuses_the_array(values):
    with pytest.raises(ValueError, match=r"^t is "):
        exact_array(values, "t")


@pytest.mark.parametrize("values", [np.array([True]), np.array([1j]), [None], None, np.array(["2020"], dtype="M8[Y]")])
def test_an_array_of_something_else_is_refused(values):
    with pytest.raises(TypeError, match=r"accepted"):
        exact_array(values, "t")


@pytest.mark.parametrize(
    "values",
    [
        b"1",
        bytearray(b"1"),
        memoryview(b"1"),
        np.array(b"1"),
        np.array([b"1"]),
        np.array([0, 1], dtype="M8[ns]"),
        np.array([0, 1], dtype="m8[s]"),
        np.array(5, dtype="m8[s]"),
        np.datetime64(0, "ns"),
        [np.timedelta64(5, "s")],
        np.zeros(2, dtype="f8,f8"),
        {1.0: 2.0},
        {1.0: 2.0}.keys(),
        {1.0, 2.0},
        frozenset({1.0}),
        [{1.0}],
        [[bytearray(b"1")]],
    ],
)
def test_bytes_dates_mappings_and_sets_are_no_numbers(values):
    with pytest.raises(TypeError, match=r"^t is .*; a finite number, .* is accepted\.$"):
        exact_array(values, "t")


@given(FLOATS)
def test_the_expansion_of_a_float_is_exact_and_its_decimal(x):
    assert Fraction(expansion(Fraction(x))) == Fraction(x)
    assert "/" not in expansion(Fraction(x))


@pytest.mark.parametrize("value", [3, np.int64(3), np.uint8(3)])
def test_a_count_is_any_integer(value):
    assert positive(value, "limbs") == 3
    assert type(positive(value, "limbs")) is int


@pytest.mark.parametrize("value", [0, -1, True, np.True_, 3.0, np.float64(3), "3", None])
def test_what_is_no_count_is_refused(value):
    with pytest.raises(ValueError, match=r"^limbs is .*; a positive integer is accepted\.$"):
        positive(value, "limbs")


@given(FLOATS)
def test_a_float_comes_back_as_itself(x):
    assert as_number(exact(x)) == x
    assert exact(repr(x)) == exact(as_number(exact(repr(x))))


@given(
    st.fractions() | st.decimals(allow_nan=False, allow_infinity=False, places=30).map(Fraction) | FLOATS.map(Fraction)
)
def test_the_spelling_of_an_input_reads_back_as_the_input(x):
    assert exact(as_number(x)) == x
    assert exact(spelled(x)) == x


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (Fraction(1, 2), 0.5),
        (Fraction(981, 100), "9.81"),
        (Fraction(-1, 3), "-1/3"),
        (Fraction(10) ** 400, "1" + "0" * 400),
        (Fraction(1, 10**4000), "1/1" + "0" * 4000),
        (Fraction(2 * 10**3999 + 1, 2**300), None),
    ],
)
def test_an_input_is_printed_as_a_float_a_decimal_or_a_fraction(value, expected):
    printed = as_number(value)
    assert expected is None or printed == expected
    assert exact(printed) == value
