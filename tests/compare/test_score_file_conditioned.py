"""Errors over what the format must lose: the condition of the state times the unit roundoff."""

from __future__ import annotations

import csv
import io
import json
import math
from fractions import Fraction

import numpy as np
import pytest

import compare
from compare.__main__ import main
from compare.files.conditioned import resolution
from compare.files.written import BINARY64_DIGITS
from reference import LinearPendulum, Pendulum, Tautochrone

P = Pendulum(1.0)
T = np.arange(0, 601) / 16
Y = P.state(T)
GOOD = "No error is larger than what the format must lose"


def decimals(digits: int) -> list[list[str]]:
    return [[P.certified("state", t, i).digits(digits) for i in (0, 1)] for t in T[1:40].tolist()]


@pytest.mark.parametrize(
    "y",
    [Y[1:40], Y[1:40].astype(np.float32), decimals(5), decimals(17), decimals(30), np.char.mod("%.6f", Y[1:40])],
    ids=["binary64", "binary32", "5 digits", "17 digits", "30 digits", "6 places"],
)
def test_what_is_correctly_rounded_is_as_good_as_its_format(y):
    found = compare.score(P, T[1:40], y)
    assert 0.01 < found.max_conditioned_error <= 1
    worst = next(point for point in found.points if point.number == found.max_conditioned_row)
    assert worst.conditioned == found.max_conditioned_error


def test_the_error_is_over_what_roundings_of_each_input_change():
    """By proven states of inputs that are a little other."""
    t, off = Fraction(5, 4), 1e-9
    near = Fraction(1, 1 << 40)
    given = {"theta0": Fraction(1), "g": Fraction(9.81), "length": Fraction(1)}

    def change(name: str) -> np.ndarray:
        states = []
        for sign in (1, -1):
            other = {key: value * (1 + sign * near * (key == name)) for key, value in given.items()}
            when = t * (1 + sign * near * (name == "t"))
            states.append(Pendulum(**other).state(when, limbs=3))
        return np.abs((states[0] - states[1]).sum(axis=1)) / float(2 * near)

    led, size = sum(map(change, ["t", *given])), np.abs(P.state(t))
    found = compare.score(P, [t], [P.state(t) + np.array([off, 0.0])])
    assert found.max_conditioned_error == pytest.approx(off / (2.0**-53 * (size + led)[0]), rel=1e-6)


def test_the_roundoff_is_that_of_the_format():
    assert resolution(BINARY64_DIGITS, -math.inf) == (pytest.approx(2.0**-53), pytest.approx(2.0**-53), 0)
    assert resolution(17, -20) == (2.0**-53, 2.0**-53, 5e-21)
    assert resolution(7, -6) == (pytest.approx(5e-7), 2.0**-53, pytest.approx(5e-7))
    assert resolution(30, -30) == (pytest.approx(5e-30), pytest.approx(5e-30), pytest.approx(5e-31))


def test_a_number_that_is_exactly_zero_has_a_roundoff_on_its_scale():
    found = compare.score(P, [0, 1], [[1.0, 1e-8], P.state(1).tolist()])
    assert (found.max_conditioned_row, found.max_conditioned_error) == (1, pytest.approx(1e-8 / (2.0**-53 * 0.571804)))
    assert compare.score(P, [0, 1], [[1.0, 0.0], P.state(1).tolist()]).max_conditioned_error < 1


@pytest.mark.parametrize("zero", ["0.100000000000000e-104", "1e-300", "0.0", "-0"])
def test_a_tiny_number_in_the_place_of_a_zero_is_as_good_however_it_is_written(zero):
    rows = [["1.0", zero], *([repr(number) for number in row] for row in Y[1:9].tolist())]
    assert compare.score(P, T[:9], rows).max_conditioned_error <= 1


@pytest.mark.parametrize("problem", [Pendulum(0, g=1, length=1, omega0=2), Pendulum(2, omega0=7), LinearPendulum(1.0)])
def test_other_motions_have_it_too(problem):
    t = np.arange(1, 40) / 8
    assert compare.score(problem, t, problem.state(t)).max_conditioned_error <= 1


def test_a_problem_without_it_has_none(tmp_path, capsys):
    problem = Tautochrone(1)
    t = np.arange(1, 9) / 8
    assert math.isnan(compare.score(problem, t, problem.state(t)).max_conditioned_error)
    np.save(tmp_path / "a.npy", np.column_stack([t, problem.state(t)]))
    words = ["score", str(tmp_path / "a.npy"), "--problem", "tautochrone", "--angle", "1"]
    assert main([*words, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["max_conditioned_error"], found["max_conditioned_row"]) == (None, None)
    assert found["points"][0]["conditioned_error"] is None
    assert main(words) == 0
    assert "ulps" not in capsys.readouterr().out


def test_every_format_tells_it_and_text_that_all_rows_are_good(tmp_path, capsys):
    lines = ["t,theta,omega", *(f"{t!r},{a:.6f},{b:.6f}" for t, (a, b) in zip(T.tolist(), Y.tolist(), strict=True))]
    (tmp_path / "a.csv").write_text("\n".join(lines))
    words = ["score", str(tmp_path / "a.csv"), "--theta0", "1"]
    assert main([*words, "--format", "csv"]) == 0
    rows = [float(row["conditioned_error"]) for row in csv.DictReader(io.StringIO(capsys.readouterr().out))]
    assert main([*words, "--format", "json"]) == 0  # of 601 rows not all are judged exactly
    found = json.loads(capsys.readouterr().out)
    assert found["max_conditioned_error"] == max(rows) <= 1
    assert rows.index(max(rows)) + 1 == found["max_conditioned_row"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert GOOD in out
    assert f" condition ulps (row {found['max_conditioned_row']})" in out.splitlines()[-1]
    (tmp_path / "a.csv").write_text("\n".join(lines).replace("0.749614", "0.749615"))
    assert main(words) == 0
    assert GOOD not in capsys.readouterr().out
