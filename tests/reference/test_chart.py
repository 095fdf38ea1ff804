"""Many states at once: the chart of an orbit against the closed form, bit by bit."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from independent import correct_limbs, landen_states

from reference import Pendulum
from reference.arithmetic.limbs import of_ball, to_limbs
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.problems.pendulum.chart import MANY, Chart
from reference.routes import enclosure

JUST_OVER = 2 * math.sqrt(9.81) * (1 + 1e-9)
PENDULUMS = {
    "small": Pendulum(0.001),
    "tiny": Pendulum("1e-150"),
    "released": Pendulum(1.0),
    "wide": Pendulum(3.0, g=1.62, length=0.7),
    "nearly upright": Pendulum(math.pi - 1e-9),
    "set going": Pendulum(-1, omega0=3),
    "set going some turns on": Pendulum(10, omega0=1),
    "rotation": Pendulum(0.3, omega0=7),
    "backward rotation some turns on": Pendulum(-100, omega0=-8.5),
    "fast rotation": Pendulum(2, omega0=300),
    "rotation just over the top": Pendulum(0, omega0=JUST_OVER),
}
SPANS = (10.0, 1e6, 2.0**30)
every_pendulum = pytest.mark.parametrize("problem", PENDULUMS.values(), ids=list(PENDULUMS))


def random_times(count: int) -> list[Fraction]:
    rng = random.Random(1851)
    return [Fraction(rng.uniform(-1, 1) * SPANS[i % len(SPANS)]) for i in range(count)]


def by_closed_form(problem: Pendulum, times: list[Fraction], limbs: int) -> np.ndarray:
    return np.array(enclosure.decide(problem, "state", times, *to_limbs(limbs), 53 * limbs))


def chart_of(problem: Pendulum, count: int, bits: int) -> Chart:
    return problem.chart("state", count, bits)


@every_pendulum
@pytest.mark.parametrize("limbs", [1, 3])
def test_many_states_are_those_of_the_closed_form_bit_by_bit(problem, limbs):
    times = random_times(1200)
    found = problem.state(times, limbs=limbs).reshape(len(times), 2, limbs)
    assert (found == by_closed_form(problem, times, limbs)).all()


@every_pendulum
def test_a_chart_decides_nearly_every_state(problem):
    """Else the test above would compare the closed form with itself."""
    times = random_times(2400)
    with ctx.workprec(240 + problem.working_bits(times)):
        states = chart_of(problem, len(times), 179).rows("state", times)
    with ctx.workprec(191):
        undecided = sum(of_ball(ball, 3) is None for state in states for ball in state)
    assert undecided < len(times) / 100


@every_pendulum
@pytest.mark.parametrize("bits", [12, 40, 100])
def test_the_balls_of_a_chart_hold_the_truth(problem, bits):
    """With few bits the rest of the series is what the balls are wide for."""
    times = random_times(2400)
    with ctx.workprec(240 + problem.working_bits(times)):
        chart = chart_of(problem, len(times), bits)
        for t, state in zip(times[:300], chart.rows("state", times[:300]), strict=True):
            for ball, truth in zip(state, problem.closed_form(BALL).state(BALL.number(t)), strict=True):
                assert ball.overlaps(truth)
                assert ball.rad() > 100 * truth.rad()


def test_every_limb_of_many_states_is_the_correct_rounding_of_another_computation():
    rng = random.Random(1673)
    times = [rng.uniform(0, 1e6) for _ in range(400)]
    for theta0 in (0.3, 2.9):
        found = Pendulum(theta0).state(times, limbs=3)
        expected = landen_states(theta0, 9.81, 1.0, times, 640)
        assert found.tolist() == [[correct_limbs(x, 3) for x in state] for state in expected]


def test_a_proof_does_without_a_chart(monkeypatch):
    """What a dataset's verification asks is the closed form."""
    times = random_times(MANY)
    expected = Pendulum(1.0).state(times, limbs=3)
    monkeypatch.setattr(Pendulum, "chart", lambda *_: pytest.fail("the chart was asked"))
    assert (by_closed_form(Pendulum(1.0), times, 3) == expected).all()


def test_exact_and_very_late_times_are_served_among_many():
    times = [Fraction(0), Fraction(10) ** 40, Fraction(1, 3), *random_times(MANY)]
    problem = Pendulum(1.0)
    found = problem.state(times, limbs=3)
    assert found[0].tolist() == [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    for i in (1, 2, 5):
        assert (found[i] == problem.state(times[i], limbs=3)).all()


def test_a_chart_is_of_states_only_and_of_many():
    problem = Pendulum(1.0)
    assert isinstance(chart_of(problem, MANY, 100), Chart)
    assert chart_of(problem, MANY - 1, 100) is None
    assert problem.chart("sensitivity", 10_000, 100) is None
    assert chart_of(Pendulum(0, 1, 1, 2), 10_000, 100) is None
    assert chart_of(Pendulum(math.pi - 1e-9), 4 * MANY, 100) is None


def test_a_time_beyond_the_count_of_nodes_is_left_undecided():
    with ctx.workprec(600):
        chart = chart_of(Pendulum(1.0), 1000, 179)
        late, soon = chart.rows("state", [Fraction(10) ** 30, Fraction(1)])
    assert not any(ball.is_finite() for ball in late)
    assert all(ball.is_finite() for ball in soon)


def test_working_precision_and_series_length_are_left_as_they_were():
    before = ctx.prec, ctx.cap
    Pendulum(1.0).state(random_times(MANY), limbs=2)
    assert (ctx.prec, ctx.cap) == before
