"""The expansions as proven numbers: their values and their errors, against coefficients found in another way."""

from __future__ import annotations

import pickle
from fractions import Fraction
from itertools import pairwise

import pytest
from independent import agm_period, correct_limbs, fraction, released_state

from reference import Pendulum
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.problems.pendulum import contour, series
from reference.problems.pendulum.approximations import LindstedtMotion, PendulumSeries
from reference.routes.agreement import agreement

ORDERS = (0, 1, 2, 5, 8)
AMPLITUDES = (0.001, 0.301, 1.0, 2.5)
ROWS = ("period_series", "period_series_error", "lindstedt_error", "lindstedt_crossing_error")


def test_cauchys_integrals_find_the_exact_coefficients():
    with mp.workprec(300):
        for found, exact in zip(contour.period_series(12), series.period_series(12), strict=True):
            assert abs(found / exact - 1) < Fraction(1, 2**290)
        found, exact = contour.lindstedt(12), series.lindstedt(12)
        for ours, theirs in zip(exact.frequency_squared, found.frequency_squared, strict=True):
            assert abs(ours - theirs) < Fraction(1, 2**300)
        for ours, theirs in zip(exact.harmonics, found.harmonics, strict=True):
            assert set(ours) <= set(theirs)
            assert all(abs(ours.get(m, 0) - value) < Fraction(1, 2**300) for m, value in theirs.items())


def test_lindstedt_and_poincare_reach_high_orders():
    """w^2 T^2 = w0^2 T0^2, which ties the last coefficients of the two expansions."""
    order = 60
    w, t = series.lindstedt(order).frequency_squared, series.period_series(order)
    square = [sum(t[i] * t[n - i] for i in range(n + 1)) for n in range(order + 1)]
    assert sum(w[i] * square[order - i] for i in range(order + 1)) == 0


def expected(amplitude, order, bits):
    """The four rows by coefficients from Cauchy's integrals and the period by the arithmetic-geometric mean."""
    with mp.workprec(bits):
        a, g = mp.mpf(amplitude), mp.mpf(9.81)
        period, first = agm_period(a, g, mp.mpf(1)), 2 * mp.pi / mp.sqrt(g)
        by_series = first * sum(MPMATH.number(c) * a ** (2 * j) for j, c in enumerate(contour.period_series(order)))
        solution = contour.lindstedt(order)
        angles = [solution.angle(MPMATH, a, g, mp.mpf(1), t) for t in (period, period / 4)]
        return [fraction(x) for x in (by_series, by_series / period - 1, angles[0] - a, angles[1])]


@pytest.mark.parametrize("amplitude", AMPLITUDES)
def test_every_limb_of_a_series_is_that_of_other_coefficients(amplitude):
    problem = PendulumSeries(amplitude)
    for order in ORDERS:
        exact = expected(amplitude, order, 3 * 159 + 2 * problem.working_bits([order]))
        for row, value in zip(ROWS, exact, strict=True):
            assert list(problem.certified(row, order).limbs(3)) == correct_limbs(value, 3), (row, order)


@pytest.mark.parametrize("order", [0, 3])
def test_every_limb_of_lindstedts_angle_and_its_error_is_that_of_other_coefficients(order):
    problem, times = LindstedtMotion(1.2, order=order), [0.3, 2.0, 77.7]
    with mp.workprec(700):
        solution, numbers = contour.lindstedt(order), [mp.mpf(x) for x in (1.2, 9.81, 1)]
        for t in times:
            angle = solution.angle(MPMATH, *numbers, mp.mpf(t))
            error = angle - released_state(*numbers, mp.mpf(t))[0]
            for row, value in (("lindstedt_angle", angle), ("lindstedt_angle_error", error)):
                assert list(problem.certified(row, Fraction(t)).limbs(3)) == correct_limbs(fraction(value), 3)


@pytest.mark.parametrize("route", ["taylor", "quadrature"])
@pytest.mark.parametrize("order", [0, 4])
def test_every_row_agrees_with_the_routes_it_has(route, order):
    series_of, motion = PendulumSeries(1.0), LindstedtMotion(1.0, order=order)
    times = [Fraction(1, 3), Fraction(7)]
    asked = [(series_of, row.name, [order]) for row in series_of.rows]
    asked += [(motion, row.name, times) for row in motion.rows]
    for problem, row, arguments in asked:
        found = agreement(problem, row, arguments, route)
        assert (found is None) == (route in dict(problem.row(row).lacks))
        assert found is None or found[0].digits >= 55


def test_small_errors_of_high_orders_agree_by_their_own_size():
    problem = PendulumSeries(0.01)
    assert abs(float(problem.certified("lindstedt_error", 8))) < 1e-70
    for row in ("period_series_error", "lindstedt_error"):
        assert agreement(problem, row, [0, 8], "quadrature")[0].digits >= 55


def test_a_pendulum_gives_its_expansions():
    pendulum = Pendulum(1.0)
    period, motion = pendulum.period_series(2), pendulum.lindstedt(2)
    assert period.coefficients == (1, Fraction(1, 16), Fraction(11, 3072))
    assert motion.frequency_squared == (1, Fraction(-1, 8), Fraction(7, 1536))
    assert motion.harmonics[1] == {1: Fraction(1, 192), 3: Fraction(-1, 192)}
    assert float(period.period) == pytest.approx(float(pendulum.period()), rel=1e-3)
    assert float(period.error) == pytest.approx(float(period.period) / float(pendulum.period()) - 1, rel=1e-9)
    theta = pendulum.state("0.7")[0]
    assert float(motion.angle("0.7")) - theta == pytest.approx(float(motion.error("0.7")), rel=1e-9)
    assert abs(float(motion.error_after_a_period)) < abs(float(motion.error_at_the_crossing))
    assert pickle.loads(pickle.dumps(motion)).error(1).digits(20) == motion.error(1).digits(20)  # noqa: S301 - our own


def test_errors_fall_with_the_order_and_have_the_sign_of_what_is_left_out():
    """All terms of T/T0 are positive: every partial sum is too small."""
    for amplitude in (0.1, 1.0):
        errors = [float(Pendulum(amplitude).period_series(order).error) for order in range(6)]
        assert all(error < 0 for error in errors)
        assert all(abs(later) < abs(earlier) * amplitude**2 / 8 for earlier, later in pairwise(errors))


def test_at_the_start_the_solution_is_exact():
    motion = Pendulum("1/3").lindstedt(4)
    assert list(motion.angle(0).limbs(2)) == correct_limbs(Fraction(1, 3), 2)
    assert motion.error(0).limbs(2) == (0.0, 0.0)


def test_only_a_release_has_expansions_in_its_amplitude():
    for pendulum in (Pendulum(1.0, omega0=2), Pendulum(-1, omega0=0), Pendulum(0, omega0=9)):
        for method in (pendulum.period_series, pendulum.lindstedt):
            with pytest.raises(ValueError, match=r"^Pendulum\(.*is not released from rest at 0 < theta0 < pi"):
                method(2)
    with pytest.raises(ValueError, match=r"^theta0 is 4.0; an amplitude"):
        PendulumSeries(4.0)


def test_an_order_that_does_not_move_is_refused():
    with pytest.raises(ValueError, match=r"^order is 1; at theta0 = 3.0 the frequency's expansion .* is not positive"):
        Pendulum(3.0).lindstedt(1).error(1).limbs(1)
    with pytest.raises(ValueError, match=r"^order is 101; an integer from 0 to 100 is accepted"):
        PendulumSeries(1.0).certified("period_series", 101).limbs(1)


def test_problems_of_expansions_read_back_from_their_repr():
    names = {"PendulumSeries": PendulumSeries, "LindstedtMotion": LindstedtMotion}
    for problem in (PendulumSeries("1/3", 1), LindstedtMotion(0.5, order=7)):
        assert eval(repr(problem), names) == problem  # noqa: S307 - our own text
    assert LindstedtMotion(0.5, order=7) != LindstedtMotion(0.5, order=6)
    assert PendulumSeries(0.5) != LindstedtMotion(0.5)
