"""compare.score: digits, errors, phase and amplitude of numbers from anywhere."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

import heyoka
import numpy as np
import pytest

import compare
from compare.files.conditioned import resolution
from compare.files.record import Running
from compare.files.show import marked
from reference import Pendulum
from reference.arithmetic.precision import mp
from reference.problem import SeparableProblem
from reference.problems.cycloid.problem import Cycloid
from reference.problems.cycloid.tautochrone import CycloidalPendulum, Tautochrone
from reference.problems.descent.problem import Descent
from reference.problems.pendulum.linear import LinearPendulum
from reference.problems.polar.problem import PolarBrachistochrone

P = Pendulum(1.0)
TIMES = [Fraction(j, 4) for j in range(41)]
Q = Fraction


def digits_of(problem: Pendulum, t: Fraction, count: int) -> list[str]:
    return [problem.certified("state", t, i).digits(count) for i in (0, 1)]


def exact_state(problem: Pendulum, t: Fraction, digits: int = 60) -> list[Fraction]:
    return [Q(text) for text in digits_of(problem, t, digits)]


def test_correctly_rounded_doubles_have_all_the_digits_of_a_double():
    t = np.arange(0, 200) / 16
    found = compare.score(P, t, P.state(t))
    assert found.rows == 200
    assert found.worst_digits == found.digits_held == pytest.approx(53 * math.log10(2))
    assert all(place is None for point in found.points for place in point.first_wrong)
    assert found.max_error < 4e-16
    assert found.max_phase_error < 4e-16


@pytest.mark.parametrize("digits", [6, 20, 48, 100])
def test_decimals_of_any_length_are_judged_to_their_last_digit(digits):
    found = compare.score(P, TIMES, [digits_of(P, t, digits) for t in TIMES])
    assert found.worst_digits == digits
    assert found.max_error < 2 * 10.0 ** (1 - digits)
    assert {place for point in found.points for place in point.first_wrong} == {None}


def test_a_wrong_digit_is_found_and_its_error_is_what_was_changed():
    rows = [digits_of(P, t, 48) for t in TIMES]
    theta = rows[17][0]
    place = theta.index(".") + 38
    other = str((int(theta[place]) + 1) % 10)
    rows[17][0] = theta[:place] + other + theta[place + 1 :]
    found = compare.score(P, TIMES, rows)
    change = abs(Q(rows[17][0]) - Q(theta))
    assert found.worst_row == 18
    assert found.max_error == pytest.approx(float(change), rel=1e-9, abs=0)
    assert found.worst_digits == pytest.approx(-math.log10(float(change / abs(Q(theta)))), abs=1e-6)
    assert found.points[17].first_wrong == (38, None) if theta.lstrip("-").startswith("0.") else (39, None)


FORMATS = {np.float32: 24, np.longdouble: np.finfo(np.longdouble).nmant + 1}
if hasattr(heyoka, "real128"):  # where the compiler has binary128
    FORMATS[heyoka.real128] = 113


@pytest.mark.parametrize("kind", FORMATS)
def test_other_formats_are_judged_to_what_they_hold(kind):
    t = np.arange(1, 20) / 8
    limbs = P.state(t, limbs=3)
    y = np.empty((len(t), 2), dtype=kind)
    for index in np.ndindex(y.shape):
        y[index] = sum((kind(limb) for limb in limbs[index][1:]), start=kind(limbs[index][0]))
    found = compare.score(P, t, y)
    assert found.digits_held == pytest.approx(FORMATS[kind] * math.log10(2))
    assert found.worst_digits > found.digits_held - 0.4


def test_decimals_fractions_and_mpmaths_numbers_are_the_same_numbers():
    t = Q(5, 4)
    texts = digits_of(P, t, 30)
    with mp.workdps(40):
        kinds = [
            texts,
            [Decimal(text) for text in texts],
            [Q(text) for text in texts],
            [mp.mpf(text) for text in texts],
        ]
        errors = [compare.score(P, [t], [row]).max_error for row in kinds]
    assert errors == pytest.approx([errors[0]] * 4, rel=1e-6, abs=0)


@pytest.mark.parametrize("size", ["1e-3", "1e-20", "1e-40"])
@pytest.mark.parametrize(
    "start", [{"theta0": 1}, {"theta0": "0.5", "omega0": -2}, {"theta0": 3, "omega0": 7}, {"theta0": -7, "omega0": 1}]
)
def test_numbers_of_a_later_time_are_ahead_in_phase_alone(start, size):
    """At t + s the state lies on the same orbit, 2 pi s/T further."""
    problem, shift = Pendulum(**start), Q(size)
    found = compare.score(problem, TIMES, [exact_state(problem, t + shift) for t in TIMES])
    expected = 2 * math.pi * float(shift) / float(problem.period())
    assert [point.phase_error for point in found.points] == pytest.approx([expected] * len(TIMES), rel=1e-9, abs=0)
    assert found.max_energy_error < 1e-50
    if problem.motion == "libration":
        assert found.max_amplitude_error < 1e-50
    else:
        assert math.isnan(found.max_amplitude_error)
        assert found.notes == ("A rotation has no amplitude.",)


@pytest.mark.parametrize(
    "problem", [Tautochrone(1.0), Cycloid(2, 1), CycloidalPendulum(-1.0), LinearPendulum(1.0, omega0=0.3)]
)
def test_harmonic_motions_have_phase_and_amplitude_too(problem):
    shift = Q(1, 10**20)
    times = [Q(j, 8) for j in range(1, 20)]
    found = compare.score(problem, times, [exact_state(problem, t + shift) for t in times])
    frequency = problem.rate() if isinstance(problem, SeparableProblem) else math.sqrt(9.81) / 2
    phases = [point.phase_error for point in found.points]
    assert phases == pytest.approx([1e-20 * frequency] * len(times), rel=1e-9, abs=0)
    assert found.max_amplitude_error < 1e-55


@pytest.mark.parametrize("problem", [Descent("parabola"), PolarBrachistochrone(0.5)])
def test_every_family_with_a_state_is_judged(problem):
    t = np.arange(0, 9) / 16
    y = problem.state(t)
    y[3] *= 1 + 1e-9
    found = compare.score(problem, t, y)
    assert (found.worst_row, found.names) == (4, problem.state_names)
    assert found.worst_digits == pytest.approx(9, abs=1e-6)
    unknown = f"Phase and amplitude are not defined for the problem {problem.name}."
    assert found.notes == ((unknown,) if problem.name == "descent" else ())


@pytest.mark.parametrize("size", ["1e-2", "-1e-15", "1e-40"])
def test_numbers_of_a_wider_swing_in_step_are_wrong_in_amplitude_alone(size):
    wide = Pendulum(1 + Q(size))
    with mp.workdps(80):
        stretch = mp.mpf(wide.period().digits(70)) / mp.mpf(P.period().digits(70))
        later = [Q(mp.nstr(stretch * t.numerator / t.denominator, 66)) for t in TIMES]
    found = compare.score(P, TIMES, [exact_state(wide, t) for t in later])
    assert [point.amplitude_error for point in found.points] == pytest.approx(
        [float(Q(size))] * len(TIMES), rel=1e-9, abs=0
    )
    assert found.max_phase_error < 1e-55
    energy = (math.cos(1) - math.cos(1 + float(Q(size)))) / (1 - math.cos(1))
    assert found.max_energy_error == pytest.approx(abs(energy), rel=0.2)


def test_the_phase_error_of_half_a_period_and_more_is_the_shorter_way_round():
    period = Q(P.period().digits(60))
    for part, expected in ((Q(1, 4), math.pi / 2), (Q(3, 4), -math.pi / 2), (Q(9, 8), math.pi / 4)):
        found = compare.score(P, [1], [exact_state(P, 1 + part * period)])
        assert found.points[0].phase_error == pytest.approx(expected)


def test_a_state_that_goes_over_the_top_has_no_place_in_a_swing():
    found = compare.score(P, [0, 1, 2], [[1, 0], [1, 9], [1, 0]])
    assert math.isnan(found.points[1].phase_error)
    assert math.isnan(found.max_phase_error)
    assert math.isnan(found.max_amplitude_error)
    assert math.isfinite(found.points[2].phase_error)
    assert "Row 2, t = 1, is the first whose state is on no orbit" in found.notes[0]


@pytest.mark.parametrize(
    ("start", "note"),
    [
        ({"theta0": 0, "omega0": 2, "g": 1}, "The separatrix has no period"),
        ({"theta0": 0, "omega0": 0}, "At rest there is no phase"),
    ],
)
def test_motions_without_phase_say_so(start, note):
    found = compare.score(Pendulum(**start), [1], [[0.5, 1.5]])
    assert found.notes[0].startswith(note)
    assert math.isnan(found.max_phase_error)
    assert math.isfinite(found.max_energy_error) == (start["omega0"] != 0 or found.max_energy_error > 0)


def test_the_energy_error_is_relative_to_the_energy_above_rest():
    found = compare.score(P, [0], [[1.1, 0.3]])
    energy = 0.3**2 / 2 + 9.81 * (1 - math.cos(1.1))
    assert found.max_energy_error == pytest.approx(energy / (9.81 * (1 - math.cos(1))) - 1, rel=1e-12)


def test_whole_turns_of_the_angle_change_the_error_and_not_the_phase():
    theta, omega = P.state(0.75)
    found = compare.score(P, [0.75], [[theta + 2 * math.pi, omega]])
    assert found.max_error == pytest.approx(2 * math.pi)
    assert found.max_phase_error < 1e-15


@pytest.mark.parametrize("start", [{"theta0": 0, "omega0": 8}, {"theta0": 7, "omega0": 1}])
def test_an_angle_that_is_wrapped_is_pointed_out(start):
    problem, t = Pendulum(**start), np.arange(0, 200) / 16
    y = problem.state(t)
    y[:, 0] = np.mod(y[:, 0] + math.pi, 2 * math.pi) - math.pi + 1e-3
    found = compare.score(problem, t, y)
    turned = np.flatnonzero(np.abs(problem.state(t)[:, 0]) > math.pi)
    assert found.notes[-1] == (
        f"theta is wrong by whole turns of 2 pi in {len(turned)} of 200 rows, from row {turned[0] + 1} on, as an angle "
        "that is wrapped would be; one that goes on from turn to turn is accepted, as numpy.unwrap makes it."
    )
    y[:, 0] = np.unwrap(y[:, 0]) + 2 * math.pi * round(start["theta0"] / 2 / math.pi)
    assert not any("whole turns" in note for note in compare.score(problem, t, y).notes)


def test_an_error_that_grows_past_whole_turns_is_not_taken_for_a_wrapped_angle():
    problem, t = Pendulum(0, omega0=8), np.arange(0, 200) / 16
    y = problem.state(t)
    y[:, 0] += np.linspace(0, 40, 200)
    assert not any("whole turns" in note for note in compare.score(problem, t, y).notes)


def test_a_zero_of_the_truth_has_a_first_wrong_digit_unless_it_is_met():
    assert compare.score(P, [0], [["1", "0.000"]]).points[0].first_wrong == (None, None)
    assert compare.score(P, [0], [[1.0, 1e-17]]).points[0].first_wrong == (None, 1)


@pytest.mark.parametrize(
    ("t", "y", "error", "says"),
    [
        ([0, 0], [[1, 0], [1, 0]], ValueError, "t = 0 in row 2 is repeated"),
        ([1, 0], [[1, 0], [1, 0]], ValueError, "t = 0 in row 2 comes after t = 1"),
        ([0], [[1, 0], [1, 0]], ValueError, "t has 1 times and y 2 rows"),
        ([0], [[1]], ValueError, "row 1 of y has 1 numbers; 2 are accepted: theta, omega"),
        ([0], [1], TypeError, "row 1 of y is of type int"),
        ([0], 3, TypeError, "y is of type int"),
        ([0], "10", TypeError, "y is of type str"),
        ([], [], ValueError, "there are no rows"),
        ([0], [[math.nan, 0]], ValueError, "theta in row 1 is nan"),
        ([0], [[1, math.inf]], ValueError, "omega in row 1 is inf"),
        ([math.nan], [[1, 0]], ValueError, "t is nan"),
        ([0], [[1, 1j]], TypeError, "omega in row 1 is 1j"),
        ([0], [["one", 0]], ValueError, "theta in row 1 is 'one', which is not a number"),
        ([0, 0.1], [[57.29, 0], [54.9, -46.8]], ValueError, "theta is 57.3 times the truth, as an angle in degrees"),
        ([0, 0.1], [[1, 0], [0.96, -46.8]], ValueError, "omega is 57.2 times the truth"),
        ([0], np.array(1.0), ValueError, "y is a single number"),
        ([0], {0: [1, 0]}, TypeError, "y is of type dict"),
    ],
)
def test_what_cannot_be_judged_is_one_sentence(t, y, error, says):
    with pytest.raises(error) as raised:
        compare.score(P, t, y)
    assert says in str(raised.value)
    assert str(raised.value).endswith(".")


def test_only_a_problem_is_judged_against():
    with pytest.raises(TypeError, match=r"a problem with a state in time, such as Pendulum\(1.0\), is accepted"):
        compare.score("pendulum", [0], [[1, 0]])


@pytest.mark.parametrize(
    ("text", "place", "shown"),
    [
        ("0.9989", 1, "0.[9]989"),
        ("-0.00123", 2, "-0.001[2]3"),
        ("12.5e-3", 3, "12.[5]e-3"),
        ("1.5D+00", 2, "1.[5]D+00"),
        ("0.5", 4, "0.500[0]"),
        ("7", 2, "7.[0]"),
        ("0.0", 1, "0.[0]"),
        ("1.25", None, "1.25"),
    ],
)
def test_the_first_wrong_digit_stands_in_brackets(text, place, shown):
    assert marked(text, place) == shown


def test_of_many_rows_an_even_choice_is_kept_with_the_worst_and_the_last():
    t = np.arange(1, 301) / 64
    y = P.state(t)
    y[200, 0] += 1e-3
    points = compare.score(P, t, y).points
    running = Running(("theta", "omega"), keep=16, start=(0.0, 0.0))
    for begin in range(0, 300, 7):
        running.add(points[begin : begin + 7])
    found = running.score("p", ("rad", "rad s-1"), 16.0, resolution(16.0, -16), "as written", ())
    numbers = [point.number for point in found.points]
    assert (found.rows, found.worst_row) == (300, 201)
    assert {1, 201, 300} <= set(numbers)
    assert len(numbers) <= 18
    assert set(numbers) - {201, 300} == set(range(1, 300, 32))
