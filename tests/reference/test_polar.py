"""The brachistochrone about a point mass: every row by every route, every returned bit, and what is known of it."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import heyoka as hy
import numpy as np
import pytest
from flint import arb
from independent import correct_limbs, fraction
from independent_polar import BITS, Amplitude, ball, complete

from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import BALL, MPMATH, NUMPY, Heyoka
from reference.arithmetic.precision import ctx, mp
from reference.problems.polar.equations import POINT_MASS
from reference.problems.polar.paths import PolarByPsi, PolarByZ
from reference.problems.polar.problem import PolarBrachistochrone
from reference.problems.polar.series import surface_coefficients
from reference.routes.agreement import agreement

ARGUMENTS = {
    "once": [None],
    "psi": [Fraction(0), Fraction(1, 7), Fraction(3), Fraction(6), Fraction(9)],
    "height": [Fraction(0), Fraction(1, 3), Fraction(1)],
    "z": [Fraction(9, 10), Fraction(1)],
    "epsilon": [Fraction(-1), Fraction(0), Fraction(1, 10)],
}
LOWEST = (1e-6, 0.01, 0.2, 0.5, 0.75, 0.95, 1 - 1e-9)


def times(problem: PolarBrachistochrone) -> list[Fraction]:
    descent = Fraction(float(problem.certified("descent_time")))
    return [Fraction(0), descent / 7, descent, 3 * descent / 2, 5 * descent / 2]


@pytest.mark.parametrize(
    "problem",
    [
        PolarBrachistochrone(z0="1/5"),
        PolarBrachistochrone(z0=0.75, r0=7e6, body="earth"),
        PolarBrachistochrone(end=(0.5, "0.3"), r0=7, gm=2),
        PolarBrachistochrone(end=("0.9", 1.8)),
        PolarBrachistochrone(end=(1, 1)),
    ],
    ids=repr,
)
@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_every_row_agrees_with_both_routes(problem, route):
    arguments = ARGUMENTS | {"tau": times(problem), "time": [Fraction(0), Fraction(1)]}
    for row in problem.rows:
        if problem.serves(row.name):
            found = agreement(problem, row.name, arguments[row.over], route)
            assert (found is None) == (route in dict(row.lacks))
            assert found is None or min(each.digits for each in found) >= 55, row.name


@pytest.mark.parametrize("curve", [PolarByPsi(z0="1/5"), PolarByZ(z0="1/5")], ids=repr)
@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_a_path_as_a_curve_agrees_with_both_routes_where_its_slope_is_vertical_too(curve, route):
    found = agreement(curve, "state", [Fraction(0), Fraction(1, 3), Fraction(4, 5)], route)
    assert min(each.digits for each in found) >= 55


@pytest.mark.parametrize("z0", [1e-6, 1e-12, 1 - 1e-9, 1 - 1e-12])
def test_at_the_edges_the_routes_agree(z0):
    problem = PolarBrachistochrone(z0=z0)
    asked = {"state": times(problem)[:-2], "curve": ARGUMENTS["psi"][:-2]}
    for row, arguments in asked.items():
        for route in ("taylor", "quadrature") if z0 != 1e-12 else ("quadrature",):
            found = agreement(problem, row, arguments, route)
            assert found is not None
            assert min(each.digits for each in found) >= 55


def test_every_limb_of_the_curve_is_correctly_rounded():
    rng = random.Random(1697)
    lowest = [*LOWEST, *(rng.uniform(0.001, 0.999) for _ in range(12))]
    for z0 in lowest:
        psis = [rng.uniform(0.01, 3.14) for _ in range(3)]
        found = PolarBrachistochrone(z0=z0).along("curve", psis, limbs=3)
        with ctx.workprec(BITS + 100):
            path = Amplitude(ball(Fraction(z0)))
            for psi, limbs in zip(psis, found.tolist(), strict=True):
                half = ball(Fraction(psi)) / 2
                z = path.z0 * half.sin() ** 2 + half.cos() ** 2
                expected = [z, *path.passed(half.tan())]
                assert all(value.rel_accuracy_bits() > BITS for value in expected)
                assert limbs == [correct_limbs(fraction(value), 3) for value in expected]


def test_every_limb_of_the_motion_is_correctly_rounded():
    rng = random.Random(1696)
    for z0 in (0.01, 0.2, rng.uniform(0.1, 0.9), 0.95):
        problem = PolarBrachistochrone(z0=z0)
        descent = float(problem.certified("descent_time"))
        taus = [rng.uniform(0.05, 0.97) * descent for _ in range(2)]
        found = problem.state(taus, limbs=3)
        with ctx.workprec(BITS + 100):
            path = Amplitude(ball(Fraction(z0)))
            kappa = path.z0**3 / (1 - path.z0)
            for tau, limbs in zip(taus, found.tolist(), strict=True):
                half = path.psi_at(ball(Fraction(tau))) / 2
                z = path.z0 * half.sin() ** 2 + half.cos() ** 2
                rate = -((1 - z) / z - kappa * ((1 - z) / z**2) ** 2).sqrt()
                expected = z, rate, path.passed(half.tan())[0]
                assert limbs == [correct_limbs(fraction(value), 3) for value in expected]


@pytest.mark.parametrize("z0", [*LOWEST, 1e-12, 1 - 1e-12])
def test_half_angle_and_descent_time_are_hypergeometric(z0):
    problem = PolarBrachistochrone(z0=z0)
    with mp.workprec(BITS + 200):
        expected = complete(Fraction(z0))
    for row, value in zip(("half_angle", "descent_time"), expected, strict=True):
        assert list(problem.certified(row).limbs(3)) == correct_limbs(fraction(value), 3)


def test_published_facts():
    """The thesis' figure 15 says 105 degrees for Z = 0.2; the limits are those of the radial fall."""
    assert f"{math.degrees(2 * float(PolarBrachistochrone(z0='0.2').certified('half_angle'))):.2f}" == "100.90"
    fallen = PolarBrachistochrone(z0="1e-30")
    assert float(fallen.certified("half_angle")) == pytest.approx(math.pi / 3, rel=1e-15)
    assert float(fallen.certified("descent_time")) == math.pi / 2
    free_fall = PolarBrachistochrone(z0="1e-30", r0=6371e3, body="earth")
    seconds = math.pi / 2 * math.sqrt(6371e3**3 / (2 * 3.986004e14))
    assert float(free_fall.certified("descent_seconds")) == pytest.approx(seconds, rel=1e-14)


def test_near_the_surface_it_is_the_cycloid():
    """R = (1 - z0)/2 and g = 1/2: half a turn in pi sqrt(R/g), over pi R."""
    problem = PolarBrachistochrone(z0=1 - Fraction(1, 10**20))
    assert float(problem.certified("descent_time")) == pytest.approx(math.pi * 1e-10, rel=1e-14)
    assert float(problem.certified("half_angle")) == pytest.approx(math.pi / 2 * 1e-20, rel=1e-14)
    _, phi, tau = problem.along("curve", 1)
    assert phi == pytest.approx((1 - math.sin(1)) / 2 * 1e-20, rel=1e-14)
    assert tau == pytest.approx(1e-10, rel=1e-14)


@pytest.mark.parametrize("z0", ["0.001", "0.3", "0.88", "0.9", "0.999"])
@pytest.mark.parametrize("order", [1, 4, 30])
def test_the_series_of_both_limits_err_by_less_than_they_say(z0, order):
    problem = PolarBrachistochrone(z0=z0)
    with ctx.workprec(2000):
        exact, found = problem.closed_form(BALL), problem.limit(order)
        assert abs(found.half_angle - exact.half_angle) < found.half_angle_error
        assert abs(found.descent_time - exact.descent_time) < found.descent_time_error
        assert found.half_angle_error < 1 / arb(order)
    with mp.workprec(200):
        near = mp.mpf(found.half_angle.str(60, radius=False))
        assert abs(problem.limit(order, MPMATH).half_angle - near) < mp.mpf(10) ** -55


def test_the_series_begin_with_the_cycloid_and_refuse_no_order():
    assert surface_coefficients(3) == (Fraction(3, 2), Fraction(-45, 8), Fraction(105, 4))
    for order in (0, 1001, True, 2.0):
        with pytest.raises(ValueError, match=r"order is .*; an integer from 1 to 1000 is accepted"):
            PolarBrachistochrone(z0=0.5).limit(order)


@pytest.mark.parametrize("z0", [0.01, 0.3, 0.9])
def test_the_envelope_law(z0):
    """d(descent_time) = sqrt(kappa) d(half_angle): by the derivatives of two integrals, and by differences."""
    problem, step = PolarBrachistochrone(z0=z0), Fraction(1, 2**40)
    with mp.workprec(300):
        form = problem.closed_form(MPMATH)
        assert mp.almosteq(form.ddescent_time_dz0, mp.sqrt(form.kappa) * form.dhalf_angle_dz0, 1e-80)
    for row in ("half_angle", "descent_time"):
        low, high = (
            Fraction(PolarBrachistochrone(z0=problem.z0 + sign * step).certified(row).digits(60)) for sign in (-1, 1)
        )
        slope = float((high - low) / (2 * step))
        assert slope == pytest.approx(float(problem.certified(f"d{row}_dz0")), rel=1e-14)


def test_the_equation_of_motion_follows_from_the_energy():
    z, rate, kappa = hy.make_vars("z", "rate", "kappa")
    m = Heyoka()
    acceleration, turn = POINT_MASS.motion(m, z, kappa)
    energy = POINT_MASS.energy(z, rate, kappa)
    along = hy.diff(energy, z) * rate + hy.diff(energy, rate) * acceleration
    # v^2 = z'^2 + z^2 phi'^2, less (1 - z)/z: what the energy says
    speed = rate * rate + (z * turn) ** 2 - POINT_MASS.speed_squared(z) - (energy - 1.0)
    compiled = hy.cfunc([along, speed], [z, rate, kappa])
    points = np.random.default_rng(5).uniform(0.2, 0.9, (3, 100))
    assert np.abs(compiled(points)).max() < 1e-9
    assert np.abs(hy.cfunc([acceleration], [z, kappa])(points[:2])).min() > 1e-6


def test_the_denominator_of_the_angle_has_the_factor_that_the_thesis_lost():
    for z0, z in ((Fraction(1, 5), Fraction(1, 2)), (Fraction(2, 3), Fraction(7, 9))):
        cubic = z**3 - POINT_MASS.kappa(z0) * (1 - z)
        assert cubic == (z - z0) * POINT_MASS.quadratic(z0, z) / (1 - z0)
        assert cubic != (z - z0) * ((1 - z0) * z**2 + z0 * (1 - z0) + z0**2) / (1 - z0)


@pytest.mark.parametrize("z0", [0.05, 0.5, 0.99])
def test_the_motion_obeys_its_equation_and_keeps_its_energy(z0):
    problem, step = PolarBrachistochrone(z0=z0), Fraction(1, 10**12)
    kappa = float(problem.parameters["kappa"])
    for tau in times(problem)[1:]:
        low, here, high = (
            [Fraction(problem.certified("state", tau + i * step, j).digits(60)) for j in range(3)] for i in (-1, 0, 1)
        )
        slopes = [float((b - a) / (2 * step)) for a, b in zip(low, high, strict=True)]
        rates = problem.derivative(NUMPY, 0, [float(x) for x in here], {"kappa": kappa})
        np.testing.assert_allclose(slopes, rates, rtol=1e-10, atol=1e-10)
        with mp.workprec(200):
            exact = {"kappa": MPMATH.number(problem.parameters["kappa"])}
            energy = problem.invariant(MPMATH, [MPMATH.number(x) for x in here], exact)
            assert abs(energy - 1) < mp.mpf(10) ** -48


def test_it_falls_and_turns_forward_at_first():
    z, rate, phi = PolarBrachistochrone(z0=0.5).state("1e-3")
    assert z < 1
    assert rate < 0 < phi


def test_the_way_up_mirrors_the_way_down_and_the_equation_goes_on():
    problem = PolarBrachistochrone(z0=0.3)
    descent = Fraction(problem.certified("descent_time").digits(60))
    full = 2 * float(problem.certified("half_angle"))
    down, up, again = problem.state([descent / 3, 5 * descent / 3, 7 * descent / 3])
    np.testing.assert_allclose(up, [down[0], -down[1], full - down[2]], rtol=1e-15)
    np.testing.assert_allclose(again, [*down[:2], down[2] + full], rtol=1e-15)
    np.testing.assert_array_equal(problem.state(-descent / 3), down * [1, -1, -1])
    np.testing.assert_array_equal(problem.along("curve", -2), problem.along("curve", 2) * [1, -1, -1])
    bottom = problem.state(descent)
    assert bottom[0] == 0.3
    assert abs(bottom[1]) < 1e-14


def test_very_near_to_the_lowest_point_of_a_very_deep_path_the_motion_is_proven():
    problem = PolarBrachistochrone(z0="1e-12")
    descent = Fraction(problem.certified("descent_time").digits(60))
    before, after = problem.state([descent - Fraction(1, 10**17), descent + Fraction(1, 10**17)])
    assert before[0] == pytest.approx(after[0], rel=1e-12)
    assert before[1] < 0 < after[1]


def test_the_curve_by_z_and_by_height_is_the_curve():
    problem = PolarBrachistochrone(z0="0.2")
    _, phi, tau = problem.along("curve", 2, limbs=1)
    z = Fraction(problem.certified("curve", Fraction(2)).digits(60))
    np.testing.assert_allclose(problem.along("by_z", z), [phi, tau], rtol=1e-15)
    np.testing.assert_allclose(
        problem.along("by_height", (z - Fraction(1, 5)) * 5 / 4), [float(z), phi, tau], rtol=1e-15
    )
    lowest = [float(problem.certified(row)) for row in ("half_angle", "descent_time")]
    assert problem.along("by_z", "0.2").tolist() == lowest
    assert problem.along("by_height", 0).tolist() == [0.2, *lowest]


def test_what_is_rational_is_exact():
    problem = PolarBrachistochrone(z0="1/3", r0=8, gm=1)
    assert problem.state(0, limbs=3).tolist() == [[1, 0, 0], [0, 0, 0], [0, 0, 0]]
    assert problem.along("curve", 0).tolist() == [1, 0, 0]
    assert problem.along("by_z", 1).tolist() == [0, 0]
    assert problem.along("by_height", [0, 1])[:, 0].tolist() == [1 / 3, 1]
    assert problem.along("si_curve", 0).tolist() == [8, 0]
    assert problem.certified("kappa").digits(60) == "0.0555555555555555555555555555555555555555555555555555555555556"
    assert problem.certified("time_unit").limbs(3) == (16, 0, 0)
    assert problem.along("neighbour_gap", 0).tolist() == [0]
    assert PolarBrachistochrone(end=(1, "0.75")).certified("half_angle").limbs(3) == (0.375, 0, 0)


def test_seconds_and_metres_are_the_dimensionless_rows_times_their_units():
    problem = PolarBrachistochrone(z0=0.4, r0=6.371e6, body="earth")
    second = math.sqrt(6.371e6**3 / (2 * 3.986004e14))
    assert float(problem.certified("time_unit")) == pytest.approx(second, rel=1e-15)
    z, rate, phi = problem.state(Fraction(1000) / Fraction(problem.certified("time_unit").digits(60)))
    np.testing.assert_allclose(problem.along("si_state", 1000), [6.371e6 * z, 6.371e6 * rate / second, phi], rtol=1e-14)
    z, _, tau = problem.along("curve", 2)
    np.testing.assert_allclose(problem.along("si_curve", 2), [6.371e6 * z, tau * second], rtol=1e-14)
    for row in ("descent", "arrival"):
        expected = float(problem.certified(f"{row}_time")) * second
        assert float(problem.certified(f"{row}_seconds")) == pytest.approx(expected, rel=1e-14)
    with pytest.raises(ValueError, match=r"si_curve is not of .*: its dimensions in SI units are not given"):
        PolarBrachistochrone(z0=0.4).along("si_curve", 1)


@pytest.mark.parametrize(
    "problem",
    [
        PolarBrachistochrone(z0=0.1),
        PolarBrachistochrone(z0="1/3", r0="1/7", gm=3),
        PolarBrachistochrone(end=("0.3", 1), r0=1.5, body="earth"),
    ],
)
def test_a_problem_reads_back_from_its_repr(problem):
    assert eval(repr(problem)) == problem  # noqa: S307 - our own text


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({}, "either z0, the lowest point, or end"),
        ({"z0": 0.5, "end": (1, 1)}, "either z0, the lowest point, or end"),
        ({"z0": 0}, r"z0 is 0\.0; a lowest point with 0 < z0 < 1"),
        ({"z0": 1}, "z0 is 1"),
        ({"z0": math.nan}, "z0 is nan, which is not finite"),
        ({"end": 1}, r"end is 1; a pair \(R, PHI\)"),
        ({"end": "1,1"}, "end is '1,1'; a pair"),
        ({"end": (1, 2, 3)}, "a pair"),
        ({"z0": 0.5, "r0": 1}, "both or neither"),
        ({"z0": 0.5, "gm": 1}, "both or neither"),
        ({"z0": 0.5, "r0": -1, "gm": 1}, r"r0 is -1\.0; a positive number"),
        ({"z0": 0.5, "r0": 1, "body": "vulcan"}, "body is 'vulcan'; one of earth, thesis-earth is accepted"),
        ({"z0": 0.5, "r0": 1, "gm": 1, "body": "earth"}, "instead of gm"),
    ],
)
def test_what_is_no_path_is_refused(arguments, told):
    with pytest.raises(ValueError, match=told):
        PolarBrachistochrone(**arguments)


def test_arguments_outside_of_the_path_are_refused():
    problem = PolarBrachistochrone(z0=0.5)
    for row, argument, told in (
        ("by_z", 0.4, r"z is 0\.4; a number with 0\.5 <= z <= 1"),
        ("by_height", 1.5, "height is 1.5; a number with 0 <= height <= 1"),
        ("neighbour_gap", 2, r"epsilon is 2\.0; a number with -1 <= epsilon <= 1"),
    ):
        with pytest.raises(ValueError, match=told):
            problem.along(row, argument)
        with pytest.raises(ValueError, match=told):
            problem.certified(row, Fraction(argument))
    with pytest.raises(ValueError, match=r"z0 is not of .*: z0 is given"):
        problem.certified("z0")


def test_a_march_has_its_start_its_neighbour_and_its_rate():
    problem = PolarBrachistochrone(z0=0.5, r0=1, gm=1)
    assert problem.start == (1, 0, 0)
    near = problem.neighbour(lambda x: Fraction(float(x)), Fraction(1, 2**52))
    assert 0 < near.z0 - problem.z0 < 1e-6
    z = np.linspace(0.5, 1, 1000)
    kappa = float(problem.parameters["kappa"])
    slopes = np.gradient(problem.derivative(NUMPY, 0, (z, 0 * z, 0 * z), {"kappa": kappa})[1], z)
    assert np.abs(slopes).max() <= problem.rate() ** 2
    for ask in ("parameters", "rate"):
        with pytest.raises(ValueError, match="has an irrational lowest point; z0 is accepted"):
            _ = getattr(PolarBrachistochrone(end=(1, 1)), ask)()


def test_the_work_is_bounded():
    with pytest.raises(WorkBoundError, match=r"chord_gap of .* could not be decided with 2048 bits"):
        PolarBrachistochrone(z0=0.5).certified("chord_gap").digits(1000)
    assert PolarBrachistochrone(z0="1e-200").certified("half_angle").routes == {"enclosure": math.inf}
