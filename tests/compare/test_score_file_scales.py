"""compare.score: digits where the truth is zero, or near a zero, are those on the scale of the number."""

from __future__ import annotations

import csv
import io
import json
import math
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest
from test_score_file_sift import BACK, NARROW, SWING, TURNING, WIDE, chunked, spoiled

import compare
from compare.__main__ import main
from compare.files.crew import Crew
from compare.files.fast_path import Sift
from compare.files.judge import Judge
from compare.files.scales import Point, Scales
from reference import Pendulum
from reference.problems.polar.problem import PolarBrachistochrone

if TYPE_CHECKING:
    from compare.files.record import Running

HELD = 53 * math.log10(2)
TIMES = np.arange(0, 41) / 4


def rounded(size: float) -> float:
    return float(f"{size:.5e}")


def test_a_rounding_at_an_exact_zero_is_no_lost_digit():
    y = SWING.state(TIMES)
    y[0, 1] = 6.1e-17
    found = compare.score(SWING, TIMES, y)
    scale = rounded(np.abs(y[:, 1]).max())
    assert found.worst_digits == found.worst_scaled_digits == pytest.approx(HELD)
    assert found.scales == (1.0, scale)
    y[0, 1] = 1e-5
    found = compare.score(SWING, TIMES, y)
    assert (found.worst_row, found.worst_scaled_row) == (1, 1)
    assert found.worst_digits == found.worst_scaled_digits == pytest.approx(5 + math.log10(scale), abs=1e-9)
    assert found.notes == (
        f"In row 1, the worst, omega is exactly zero: its digits are those on its scale, {scale:.3g}.",
    )


def test_where_all_truths_are_zero_digits_are_those_of_the_number_itself():
    assert compare.score(SWING, [0], [[1.0, 1e-17]]).worst_digits == pytest.approx(HELD)
    found = compare.score(SWING, [0], [["1.000000000000", "0.0001"]])
    assert (found.worst_digits, found.scales) == (pytest.approx(4), (1.0, 1.0))
    rest = compare.score(Pendulum(0, omega0=0), [0, 1, 2], [[0, 0], [1e-7, 1e-3], [1e-2, 0]])
    assert (rest.worst_row, rest.worst_digits) == (3, pytest.approx(2))
    assert (rest.worst_scaled_row, rest.worst_scaled_digits) == (3, pytest.approx(2))


def test_a_number_near_its_zero_has_few_digits_of_its_own_and_all_on_its_scale():
    t = [Fraction(j, 2) * Fraction(float(SWING.period())) for j in range(1, 9)]
    y = np.array([SWING.state(float(when)) for when in t])
    y[:, 1] += 1e-16
    y = np.vstack([y[:1], [SWING.state(1.5)], y[1:]])
    found = compare.score(SWING, [float(t[0]), 1.5, *map(float, t[1:])], y)
    assert found.worst_digits < 2
    assert found.worst_scaled_digits > 15.9
    assert f"In row {found.worst_row}, the worst, omega is near zero, of size " in found.notes[0]
    assert "15.95" not in found.notes[0]
    assert found.notes[0].endswith("digits are correct, and 16.0 on its scale, 2.85.")


def test_a_table_of_fixed_places_has_its_places_on_the_scale():
    exact = SWING.state(TIMES)
    y = [[f"{theta:.6f}", f"{omega:.6f}"] for theta, omega in exact.tolist()]
    found = compare.score(SWING, [str(when) for when in TIMES], y)
    assert found.worst_scaled_digits > 6
    assert found.worst_scaled_digits >= found.worst_digits


@pytest.mark.parametrize("problem", [SWING, PolarBrachistochrone(0.5), Pendulum("0.3", omega0="-1")])
def test_digits_on_the_scale_are_the_error_over_the_largest_truth(problem):
    t = np.arange(0, 60) / 8
    truth = problem.state(t)
    y = truth + np.random.default_rng(5).standard_normal(truth.shape) * 1e-6
    found = compare.score(problem, t, y)
    scales = [rounded(size) for size in np.abs(truth).max(axis=0)]
    errors = np.array([point.errors for point in found.points])
    digits = np.minimum(-np.log10(np.abs(errors) / scales), HELD).clip(0)
    assert list(found.scales) == pytest.approx(scales, rel=1e-12)
    assert [point.scaled_digits for point in found.points] == pytest.approx(digits.min(axis=1), abs=1e-9)
    assert found.worst_scaled_digits == pytest.approx(digits.min(), abs=1e-9)
    assert found.worst_scaled_row == digits.min(axis=1).argmin() + 1
    own = -np.log10(np.abs(errors) / np.where(truth == 0, scales, np.abs(truth)))
    assert [point.digits for point in found.points] == pytest.approx(own.clip(0).min(axis=1), abs=1e-7)


def test_errors_smaller_than_any_double_are_counted():
    t = Fraction(5, 4)
    texts = [SWING.certified("state", t, i).digits(420) for i in (0, 1)]
    wrong = [text[:-20] + str((int(text[-20]) + 1) % 10) + text[-19:] for text in texts]
    found = compare.score(SWING, [t], [wrong])
    assert 395 < found.worst_scaled_digits < 405
    tiny = Pendulum("1e-400", omega0=0)
    assert compare.score(tiny, [0], [["1.001e-400", "0"]]).worst_scaled_digits == pytest.approx(3)


def sifted(problem: Pendulum, table: np.ndarray) -> tuple[Running, list[Point], Judge]:
    judge, seen = Judge(problem), []
    running = judge.running(7)
    points = Sift(judge, running, Crew(judge, others=0)).points
    for part in chunked(table):
        found = points(part)()
        running.add(found)
        seen += found
    return running, seen, judge


@pytest.mark.parametrize("problem", [SWING, TURNING, NARROW, WIDE, BACK])
@pytest.mark.parametrize("begin", [0, -1500])
def test_the_worst_rows_of_a_long_file_are_the_worst_of_all_its_rows(problem, begin):
    """The exact zero of omega or theta stands at the beginning, or in the middle."""
    t = np.arange(begin, begin + 3000) / 16
    y = problem.state(t)
    size = np.abs(y).max(axis=0)
    y += np.random.default_rng(begin + 2000).standard_normal(y.shape) * 1e-12 * size
    y[-begin, 1] += 1e-7 * size[1]
    table = np.column_stack([t, y])
    running, seen, judge = sifted(problem, table)
    short, every = judge.score(running, "as written"), compare.score(problem, t, y)
    worst = ("worst_digits", "worst_row", "worst_scaled_digits", "worst_scaled_row")
    for name in (*worst, "scales", "max_errors", "max_conditioned_error", "max_conditioned_row"):
        assert getattr(short, name) == getattr(every, name)
    rows = {point.number: point for point in every.points}
    assert all(rows[point.number] == point for point in short.points)
    assert {short.worst_row, short.worst_scaled_row} <= {point.number for point in short.points}
    digits = [point.digits for point in every.points]
    scaled = [point.scaled_digits for point in every.points]
    conditioned = [point.conditioned for point in every.points]
    assert (every.max_conditioned_error, every.max_conditioned_row) == (
        max(conditioned),
        conditioned.index(max(conditioned)) + 1,
    )
    assert (every.worst_digits, every.worst_row) == (min(digits), digits.index(min(digits)) + 1)
    assert (every.worst_scaled_digits, every.worst_scaled_row) == (min(scaled), scaled.index(min(scaled)) + 1)
    assert len(seen) < 1500


def point(*truths: float) -> Point:
    zeros = (0.0,) * len(truths)
    return Point(1, "0", ("0",) * len(truths), 0, 0, zeros, (1,), 0, 0, 0, 0, Fraction(0), 0, zeros, zeros, truths)


@pytest.mark.parametrize("size", [1.0, 0.999999, 3.06843, 9.999999, 1e-12, 1.00000499, 5e-320, 1.7e308])
def test_a_truth_within_the_limit_changes_no_scale_and_one_beyond_does(size):
    scales = Scales([-math.inf]).raised([point(math.log10(size))])
    (limit,) = scales.limits
    assert scales.values[0] == pytest.approx(size, rel=1e-5)
    if 1e-300 < size < 1e300:
        for factor, same in ((1 - 1e-11, True), (1 + 1e-11, False)):
            later = scales.raised([point(math.log10(limit * factor))])
            assert (later.values == scales.values) is same


def test_every_format_tells_both_kinds_of_digits(tmp_path, capsys):
    table = spoiled(SWING, 1e-6)[:40]
    table = np.vstack([[0.0, 1.0, 1e-8], table])
    np.save(tmp_path / "a.npy", table)
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["scales"] == {"theta": 1.0, "omega": pytest.approx(3.0, rel=0.01)}
    assert found["points"][0]["scaled_digits"] == pytest.approx(8 + math.log10(found["scales"]["omega"]))
    assert found["points"][0]["digits"] == found["points"][0]["scaled_digits"]
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert f"{found['worst_scaled_digits']:.1f} on scale (row {found['worst_scaled_row']})" in last
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1", "--format", "csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert float(rows[0]["digits"]) == found["points"][0]["digits"]


def test_the_constant_behind_a_body_is_shown_with_its_source(tmp_path, capsys):
    path = tmp_path / "fall.csv"
    path.write_text("tau,z,z_rate,phi\n0,1,0,0\n")
    options = ["score", str(path), "--problem", "polar", "--z0", "0.5", "--r0", "6.371e6", "--body", "earth"]
    assert main(options) == 0
    assert "gm = 398600400000000 m3 s-2 (nominal terrestrial mass parameter, IAU 2015" in capsys.readouterr().out
    assert main([*options, "--format", "json"]) == 0
    assert "IAU 2015 Resolution B3" in json.loads(capsys.readouterr().out)["notes"][0]
