"""Curves as functions of a coordinate: their slopes are those of the proven curves."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest

from compare import error_vs_n
from compare.methods import find
from compare.methods.multistep import MULTISTEP
from reference import Cycloid, PolarBrachistochrone
from reference.arithmetic.namespaces import MPMATH, NUMPY
from reference.arithmetic.precision import mp
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.polar.paths import PolarByPsi, PolarByZ

if TYPE_CHECKING:
    from reference.problem import Problem

CURVES = [
    (CycloidCurve("3/2"), ["1/8", "1", "2.5", "2.999"]),
    (PolarByZ("1/2"), ["1/64", "1/4", "0.4999"]),
    (PolarByPsi("1/4"), ["1/8", "2", "3.14", "6.25"]),
]
curves = pytest.mark.parametrize(("curve", "places"), CURVES, ids=lambda value: repr(value)[:20])


@curves
def test_the_derivative_is_the_slope_of_the_proven_state(curve: Problem, places: list[str]) -> None:
    """A difference of order two in 144 bits, with the truth to 48 digits."""
    step = Fraction(1, 10**12)
    for place in map(Fraction, places):
        before, here, after = curve.state([place - step, place, place + step], limbs=3)
        with mp.workdps(50):
            gaps = [sum(map(mp.mpf, late)) - sum(map(mp.mpf, early)) for early, late in zip(before, after, strict=True)]
            parameters = {name: MPMATH.number(value) for name, value in curve.parameters.items()}
            slopes = curve.derivative(MPMATH, 0, [sum(map(mp.mpf, value)) for value in here], parameters)
            for gap, slope in zip(gaps, slopes, strict=True):
                assert abs(gap / (2 * step.numerator / mp.mpf(step.denominator)) / slope - 1) < mp.mpf("1e-12")


@curves
def test_a_curve_begins_at_zero_and_carries_its_coordinate(curve: Problem, places: list[str]) -> None:
    states = curve.state([0, *places])
    np.testing.assert_array_equal(states[0], np.zeros(len(curve.state_names)))
    np.testing.assert_array_equal(states[1:, -1], [float(Fraction(place)) for place in places])
    assert not curve.invariants
    assert curve.rate() == 0


@curves
def test_the_equation_does_not_depend_on_what_it_sums(curve: Problem, places: list[str]) -> None:
    parameters = {name: float(value) for name, value in curve.parameters.items()}
    here = list(curve.state(places[0]))
    moved = [value + 1 for value in here[:-1]] + here[-1:]
    assert curve.derivative(NUMPY, 0, here, parameters) == curve.derivative(NUMPY, 0, moved, parameters)


@curves
def test_a_curve_reads_back_and_its_neighbour_is_another(curve: Problem, places: list[str]) -> None:
    del places
    assert eval(repr(curve)) == curve  # noqa: S307 - made here
    near = curve.neighbour(lambda value: value, Fraction(1, 1 << 52))
    assert type(near) is type(curve)
    assert near != curve


def test_the_cycloid_is_the_brachistochrones() -> None:
    bead = Cycloid("3/2", 2)
    curve = CycloidCurve(float(bead.radius()))
    x, y = bead.curve("1/2")
    np.testing.assert_allclose(curve.state(float(y)), [x, y], rtol=1e-14)


def test_both_forms_of_the_polar_curve_meet() -> None:
    """At psi = 2 the height is z0 sin^2(1) + cos^2(1)."""
    z, phi, tau = PolarBrachistochrone(z0=0.5).along("curve", 2.0)
    np.testing.assert_array_equal(PolarByPsi(0.5).state(2.0), [phi, tau, 2.0])
    assert PolarByZ(0.5).state(1 - Fraction(float(z)))[0] == pytest.approx(phi, rel=1e-15)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: PolarByZ(1.5), "z0 is 1.5; a lowest point with 0 < z0 < 1"),
        (lambda: PolarByPsi("half"), "z0 is 'half', which spells no number"),
        (lambda: PolarByZ(0.5).state(0.75), "depth is 0.75; a number with 0 <= depth <= 0.5"),
        (lambda: CycloidCurve(1.0).state(3), "height is 3.0; a number with 0 <= height <= 2"),
        (lambda: CycloidCurve(-1.0), "radius is -1.0; a positive number"),
    ],
)
def test_what_lies_beyond_the_curve_is_refused(make, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        make()


@pytest.mark.parametrize("name", ["float64", "float128", "mp:160"])
@pytest.mark.parametrize("method", [method.name for method in MULTISTEP if not method.separable_only])
def test_methods_that_remember_slopes_march_a_curve_too(method: str, name: str) -> None:
    """A curve's coordinate has the slope one at every step, which is a number and no expression."""
    coarse, fine = error_vs_n(PolarByPsi("1/2"), [method], n=[512, 1024], t_end=6, precision=name)
    assert math.log2(coarse.max_error / fine.max_error) == pytest.approx(find(method).order, abs=0.2)
