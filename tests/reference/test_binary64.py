"""Binary64 numbers by their bits."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest

from reference.arithmetic.arrays import in_order, unsigned_zeros, with_subnormals
from reference.arithmetic.binary64 import (
    bits_of,
    exact_value,
    hexadecimal,
    nearest,
    number_of,
    parts,
    pattern,
    shortest,
)

SPECIAL = [5e-324, 1e-310, 2.0**-1022, 2.0**-1022 - 5e-324, 1.7976931348623157e308, 1.0, 0.1, 3.0, 2.0**52 + 1]
SOURCE = random.Random(64)
NUMBERS = [
    *SPECIAL,
    *(-value for value in SPECIAL),
    *filter(math.isfinite, (number_of(SOURCE.getrandbits(64)) for _ in range(2000))),
    *(number_of(SOURCE.getrandbits(52)) for _ in range(500)),
]


def test_a_number_is_taken_apart_and_put_together_as_python_does():
    for value in NUMBERS:
        mantissa, exponent = parts(bits_of(value))
        assert mantissa * Fraction(2) ** exponent == exact_value(value) == Fraction(value)
        assert number_of(pattern(mantissa, exponent)) == value
        assert nearest(Fraction(value)) == value


def test_a_number_is_spelt_as_python_spells_it():
    assert [shortest(value) for value in NUMBERS] == [repr(value) for value in NUMBERS]
    assert [hexadecimal(value) for value in NUMBERS] == [value.hex() for value in NUMBERS]


@pytest.mark.parametrize("shift", [-1080, -1074, -1060, -1030, -1022, -500, 0, 900])
def test_a_quotient_is_rounded_as_python_rounds_it(shift):
    source = random.Random(shift)
    for _ in range(300):
        top, bottom = source.getrandbits(source.randrange(1, 120)) + 1, source.getrandbits(source.randrange(1, 60)) + 1
        value = Fraction(top, bottom) * Fraction(2) ** shift * source.choice([1, -1])
        assert nearest(value) == float(value)


def test_a_tie_goes_to_the_even_neighbour_and_zero_is_positive():
    least = Fraction(1, 1 << 1074)
    assert [nearest(least * k / 2) for k in (1, 3, -3, 5)] == [0.0, 1e-323, -1e-323, 1e-323]
    assert bits_of(nearest(-least / 2)) == bits_of(nearest(-least / 3)) == bits_of(nearest(Fraction(0))) == 0
    assert nearest(Fraction(2) ** 1024 - Fraction(2) ** 970) == math.inf
    assert nearest(-(Fraction(2) ** 1024)) == -math.inf


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.longdouble])
def test_numbers_of_numpy_are_taken_at_their_exact_values(kind):
    info = np.finfo(kind)
    for value in (info.tiny, info.max, -info.eps, kind(1) / kind(3), info.smallest_subnormal, kind(-0.0)):
        assert exact_value(value) == Fraction(*map(int, value.as_integer_ratio()))


@pytest.mark.parametrize("kind", ["<f2", ">f4", "<f8", ">f8"])
def test_an_array_tells_whether_it_holds_subnormal_numbers(kind):
    info = np.finfo(np.dtype(kind).newbyteorder("="))
    assert not with_subnormals(np.array([0.0, -0.0, 1.5, info.tiny, -info.max], dtype=kind))
    assert with_subnormals(np.array([1.0, -info.smallest_subnormal], dtype=kind))


def test_numbers_are_ordered_and_zeros_lose_their_sign_by_their_bits():
    numbers = np.array([-math.inf, -1e300, -1.0, -5e-324, -0.0, 0.0, 5e-324, 1e-310, 2.0, math.inf])
    keys = in_order(numbers)
    assert np.array_equal(keys[1:] > keys[:-1], numbers[1:] > numbers[:-1])
    assert (keys[4], keys[5]) == (0, 0)
    unsigned = unsigned_zeros(numbers)
    assert not np.signbit(unsigned[unsigned == 0]).any()
    assert np.array_equal(np.delete(unsigned, 4).view(np.int64), np.delete(numbers, 4).view(np.int64))
    labels = np.arange(3, dtype=np.int32)
    assert in_order(labels) is labels
