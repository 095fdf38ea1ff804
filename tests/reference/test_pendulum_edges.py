"""The pendulum at its edges: upright, tiny, just over the top, very late; every row proven, or one clear error."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from independent import agm_period, condition_number, correct_limbs, fraction, general_state, released_state

from reference import Pendulum
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp

G, LATE = 9.81, 2.0**30
OVER = 2 * math.sqrt(G) * (1 + 1e-12)
TIMES = (0.4, 6.0, LATE)
RELEASES = {"upright": Pendulum(math.pi - 1e-12), "tiny": Pendulum("1e-150")}
ROTATIONS = {"over the top": Pendulum(0, omega0=OVER), "back over the top": Pendulum(0, omega0=-OVER)}
EVERYWHERE = {**RELEASES, **ROTATIONS}


def bits_of(problem):
    """A tiny amplitude loses some hundreds of digits in differences."""
    return 2600 if problem.theta0 == Fraction(10) ** -150 else 900


every_edge = pytest.mark.parametrize("problem", EVERYWHERE.values(), ids=list(EVERYWHERE))
every_release = pytest.mark.parametrize("problem", RELEASES.values(), ids=list(RELEASES))


def numbers(problem):
    return tuple(MPMATH.number(x) for x in (problem.theta0, problem.omega0, problem.g, problem.length))


def proven(problem, row, argument=None):
    count = len(problem.row(row).quantities)
    return [list(problem.certified(row, argument, i).limbs(3)) for i in range(count)]


def limbs_of(*values):
    return [correct_limbs(fraction(value), 3) for value in values]


@every_edge
@pytest.mark.parametrize("t", TIMES)
def test_states_are_those_of_another_formula(problem, t):
    with mp.workprec(bits_of(problem)):
        assert proven(problem, "state", Fraction(t)) == limbs_of(*general_state(*numbers(problem), mp.mpf(t)))


@every_edge
@pytest.mark.parametrize("t", TIMES)
def test_gradients_are_differences_of_another_formula(problem, t):
    found = proven(problem, "gradient", Fraction(t))
    with mp.workprec(bits_of(problem)):
        orders = [tuple(int(i == j) for i in range(4)) for j in range(4)]
        for i in range(2):
            slopes = [
                mp.diff(lambda *x, i=i: general_state(*x, mp.mpf(t))[i], numbers(problem), order) for order in orders
            ]
            assert found[4 * i : 4 * i + 4] == limbs_of(*slopes)


@every_edge
@pytest.mark.parametrize("t", TIMES)
def test_conditions_are_singular_values_of_differences(problem, t):
    with mp.workprec(2 * bits_of(problem)):
        assert proven(problem, "condition", Fraction(t)) == limbs_of(condition_number(*numbers(problem), mp.mpf(t)))


@every_release
@pytest.mark.parametrize("t", TIMES)
def test_slopes_by_the_amplitude_are_differences_of_another_formula(problem, t):
    with mp.workprec(bits_of(problem)):
        amplitude, _, *rest = numbers(problem)
        for order, row in ((1, "sensitivity"), (2, "curvature")):
            slopes = (
                mp.diff(lambda a, i=i: released_state(a, *rest, mp.mpf(t))[i], amplitude, order) for i in range(2)
            )
            assert proven(problem, row, Fraction(t)) == limbs_of(*slopes)


@every_release
def test_numbers_of_a_release_are_those_of_other_formulas(problem):
    with mp.workprec(bits_of(problem)):
        amplitude, _, *rest = numbers(problem)
        period = agm_period(amplitude, *rest)
        slopes = [mp.diff(lambda a: agm_period(a, *rest), amplitude, order) for order in (1, 2)]
        expected = {
            "period": period,
            "energy": -rest[0] * mp.cos(amplitude),
            "modulus": mp.sin(amplitude / 2),
            "complementary_modulus": mp.sin(mp.pi / 2 - amplitude / 2),
            "dperiod_damplitude": slopes[0],
            "d2period_damplitude2": slopes[1],
        }
        for row, value in expected.items():
            assert proven(problem, row) == limbs_of(value), row
        for j in (0, 10**6):
            assert proven(problem, "zero_crossing", j) == limbs_of((2 * j + 1) * period / 4)
            assert proven(problem, "turning_point", j) == limbs_of((j + 1) * period / 2)


@pytest.mark.parametrize("problem", ROTATIONS.values(), ids=list(ROTATIONS))
def test_numbers_of_a_rotation_are_those_of_other_formulas(problem):
    with mp.workprec(bits_of(problem)):
        _, omega0, g, _ = numbers(problem)
        k = abs(omega0) / (2 * mp.sqrt(g))
        turn = 2 * mp.ellipk(1 / k**2) / (k * mp.sqrt(g))
        assert proven(problem, "period") == limbs_of(turn)
        assert proven(problem, "modulus") == limbs_of(k)
        assert proven(problem, "energy") == limbs_of(omega0**2 / 2 - g)
        assert proven(problem, "zero_crossing", 10**6) == limbs_of((10**6 + 1) * turn)


def test_the_separatrix_is_served_while_its_slopes_are_doubles():
    problem = Pendulum(0, 9.81, 9.81 / 4, 4)
    assert problem.motion == "separatrix"
    for late in (LATE, 1e15, Fraction(10) ** 3000):
        assert problem.state(late).tolist() == [math.pi, 0.0]
    assert problem.along("condition", [300.0])[0, 0] > 1e200
    for row in ("gradient", "condition"):
        with pytest.raises(OverflowError, match=r"beyond the range of a double"):
            problem.along(row, [LATE])
    with pytest.raises(OverflowError, match=r"^the value is about 2\^-30981640\d\d, too far from 1 for decimals"):
        problem.certified("state", Fraction(LATE), 1).digits(5)


def test_what_takes_more_bits_than_the_bound_ends_in_one_clear_error():
    with pytest.raises(WorkBoundError, match=r"^state of Pendulum\(.* could not be decided with 131072 bits"):
        Pendulum(1.0).along("state", [Fraction(10) ** 3999], limbs=2500)
