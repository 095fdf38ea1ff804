"""The pendulum from any start: which motion it is, and every motion against independent computations."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from independent import correct_limbs, fraction, general_state

from reference import Pendulum
from reference.arithmetic.precision import mp
from reference.problems.pendulum.quantities import SERVED
from reference.routes.agreement import agreement

STARTS = {
    "release": [(1.0, None), (-1.0, 0), (3.0, 0)],
    "libration": [(0.5, 2), (-1, 3), (1, -2), (-1, -2), (0, 3), (0, -3), (10, 1)],
    "rotation": [(2, -5), (0.3, 7), (-2.5, -8), (0, 6.3), (-100, 8.5)],
    "separatrix": [(0, 2), (0, -2)],
    "rest": [(0, 0)],
}
ALL = [(kind, theta0, omega0) for kind, starts in STARTS.items() for theta0, omega0 in starts]
every_start = pytest.mark.parametrize(("kind", "theta0", "omega0"), ALL)
INTEGRATED = [
    ("release", 3.0, 0),
    ("release", -1.0, 0),
    ("libration", -1, -2),
    ("libration", 0, 3),
    ("libration", 10, 1),
    ("rotation", -100, 8.5),
    ("rotation", 2, -5),
    ("separatrix", 0, -2),
    ("rest", 0, 0),
]
TIMES = [Fraction(0), Fraction(7, 10), Fraction(31, 10), Fraction(19, 2)]


def pendulum(kind: str, theta0: float, omega0: float | None) -> Pendulum:
    return Pendulum(theta0, 1 if kind == "separatrix" else 9.81, 1, omega0)


@every_start
def test_a_motion_is_recognised(kind: str, theta0: float, omega0: float | None) -> None:
    assert pendulum(kind, theta0, omega0).kind == kind


def least_digits(problem: Pendulum, route: str) -> float:
    """Over all rows that the route serves."""
    arguments = {"time": TIMES, "once": [None], "index": [0, 1, 2]}
    least = 60.0
    for name in SERVED[problem.kind]:
        found = agreement(problem, name, arguments[problem.row(name).over], route)
        assert (found is None) == (route in dict(problem.row(name).lacks))
        least = min([least, *(each.digits for each in found or ())])
    return least


@every_start
def test_every_row_of_every_motion_agrees_with_quadrature(kind: str, theta0: float, omega0: float | None) -> None:
    assert least_digits(pendulum(kind, theta0, omega0), "quadrature") >= 55


@pytest.mark.parametrize(("kind", "theta0", "omega0"), INTEGRATED)
def test_every_row_of_every_motion_agrees_with_an_integration(kind: str, theta0: float, omega0: float | None) -> None:
    assert least_digits(pendulum(kind, theta0, omega0), "taylor") >= 55


def phase_states(
    theta0: float, omega0: float, g: float, times: list[float], bits: int
) -> list[tuple[Fraction, Fraction]]:
    """By the amplitude function with the phase of the start, which the closed form under test spares itself."""
    with mp.workprec(bits):
        numbers = mp.mpf(theta0), mp.mpf(omega0), mp.mpf(g), mp.mpf(1)
        states = (general_state(*numbers, mp.mpf(t)) for t in times)
        return [(fraction(theta), fraction(omega)) for theta, omega in states]


def test_every_limb_from_random_starts_is_correctly_rounded() -> None:
    rng = random.Random(1672)
    for _ in range(40):
        theta0, omega0 = rng.uniform(-3.1, 3.1), rng.uniform(-12, 12)
        times = [rng.uniform(0, 1e3) for _ in range(5)]
        found = Pendulum(theta0, omega0=omega0).state(times, limbs=3)
        expected = phase_states(theta0, omega0, 9.81, times, 700)
        assert found.tolist() == [[correct_limbs(x, 3) for x in state] for state in expected]


@pytest.mark.parametrize("side", [-1, 1])
def test_beside_the_separatrix_nothing_is_lost(side: int) -> None:
    """Relative 1e-12 beside the velocity that just reaches the top."""
    omega0 = 2 * math.sqrt(9.81) * (1 + side * 1e-12)
    problem = Pendulum(0, omega0=omega0)
    assert problem.motion == ("rotation" if side > 0 else "libration")
    times = [0.5, 5.0, 9.0, 40.0, 1000.0]
    expected = phase_states(0, omega0, 9.81, times, 900)
    assert problem.state(times, limbs=3).tolist() == [[correct_limbs(x, 3) for x in state] for state in expected]


def test_the_separatrix_climbs_towards_the_top_and_does_not_reach_it() -> None:
    problem = Pendulum(0, 1, 1, 2)
    theta = problem.state([1.0, 5.0, 30.0])[:, 0]
    np.testing.assert_allclose(theta, 4 * np.arctan(np.exp([1.0, 5.0, 30.0])) - np.pi, rtol=1e-15)
    assert float(np.pi - theta[2]) < 1e-12
    assert problem.state(100.0, limbs=2)[0].tolist() == [math.pi, 1.2246467991473532e-16]


@pytest.mark.parametrize("omega0", [1e-3, 1e-9, 1e-30, -1e-9])
@pytest.mark.parametrize("row", ["zero_crossing", "turning_point", "period"])
def test_events_of_a_small_swing_from_the_bottom_agree(omega0: float, row: str) -> None:
    """heyoka takes steps of more than half a period there, and overlooks the zero after one at the start."""
    problem = Pendulum(0, omega0=omega0)
    found = agreement(problem, row, [None] if row == "period" else [0, 1, 2], "taylor")
    assert min(each.digits for each in found) >= 55


def test_an_event_almost_at_the_start_is_served_without_the_route_that_cannot_find_it() -> None:
    problem = Pendulum("-1e-150", omega0=3)
    assert problem.certified("zero_crossing", 0).digits(20) == "3.3333333333333333333e-151"
    assert agreement(problem, "zero_crossing", [0, 1], "taylor") is None
    assert agreement(problem, "zero_crossing", [0, 1], "quadrature")[0].digits >= 55


def test_the_motion_is_decided_exactly() -> None:
    assert Pendulum(0, "9.81", 1, "6.2641839053463297").motion == "libration"
    assert Pendulum(0, 4, 1, 4).motion == "separatrix"
    assert Pendulum(0, 4, 1, Fraction(4) + Fraction(1, 10**60)).motion == "rotation"
    assert Pendulum(0, 4, 1, Fraction(4) - Fraction(1, 10**60)).motion == "libration"
    assert Pendulum(Fraction(1, 10**40), 4, 1, 4).motion == "rotation"


def test_a_start_some_turns_on_is_the_same_motion_some_turns_on() -> None:
    with mp.workprec(200):
        turned = Pendulum(str(1 + 6 * mp.pi), omega0=2)
    np.testing.assert_allclose(
        turned.state([0.5, 3.0]) - [6 * np.pi, 0], Pendulum(1, omega0=2).state([0.5, 3.0]), atol=1e-13
    )


def test_rotation_advances_one_turn_a_period() -> None:
    problem = Pendulum(0.3, omega0=7)
    period = Fraction(float(problem.period()))
    theta = problem.state([1, 1 + period, 1 + 5 * period])[:, 0]
    np.testing.assert_allclose(np.diff(theta) / (2 * np.pi), [1, 4], atol=1e-14)


@every_start
def test_a_pendulum_reads_back_from_its_repr(kind: str, theta0: float, omega0: float | None) -> None:
    problem = pendulum(kind, theta0, omega0)
    assert eval(repr(problem), {"Pendulum": Pendulum}) == problem  # noqa: S307 - our own text


@pytest.mark.parametrize("name", ["theta0", "g", "length"])
def test_nothing_but_the_velocity_may_be_left_unsaid(name: str) -> None:
    with pytest.raises(TypeError, match=f"{name} is of type NoneType"):
        Pendulum(**{"theta0": 1.0, name: None})


def test_time_runs_backwards_too() -> None:
    forward = Pendulum(0.5, omega0=7).state([0.3, 2.0])
    backward = Pendulum(-0.5, omega0=7).state([-0.3, -2.0])
    np.testing.assert_array_equal(backward, forward * [-1, 1])


@every_start
def test_events_are_where_the_state_says(kind: str, theta0: float, omega0: float | None) -> None:
    problem = pendulum(kind, theta0, omega0)
    events = problem.events(5)
    crossings, turns = ([float(e) for e in found] for found in (events.zero_crossings, events.turning_points))
    if crossings:
        assert np.max(np.abs(np.sin(problem.state(crossings)[:, 0] / 2))) < 1e-13
    if turns:
        assert np.max(np.abs(problem.state(turns)[:, 1])) < 1e-12
    dense = np.linspace(1e-9, 5, 4001)
    theta, omega = problem.state(dense).T
    assert len(crossings) == np.count_nonzero(np.diff(np.sign(np.sin(theta / 2)))) * (kind != "rest")
    assert len(turns) == np.count_nonzero(np.diff(np.sign(omega))) * (kind != "rest")


def test_what_a_motion_does_not_have_is_said() -> None:
    with pytest.raises(ValueError, match=r"period is not of .* which is separatrix; it has state"):
        Pendulum(0, 1, 1, 2).period()
    with pytest.raises(ValueError, match=r"turning_point is not of .* which is rotation"):
        Pendulum(0, omega0=10).certified("turning_point", 0).limbs(1)


def test_the_separatrix_is_served_at_any_time() -> None:
    assert Pendulum(0, 1, 1, 2).state("1e9").tolist() == [math.pi, 0.0]
