"""Rows of a long file that cannot matter are left out, and nothing that is reported changes for it."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from compare.__main__ import main
from compare.files import fast_path
from compare.files.arrays import Sliced, chunks
from compare.files.chunk import Chunk, Doubles, Row
from compare.files.columns import Columns
from compare.files.crew import Crew
from compare.files.exact_rows import Times
from compare.files.fast_path import BoundError, Sift
from compare.files.judge import Judge
from compare.files.show import page
from compare.files.written import of_decimal
from compare.show.render import render
from reference import Pendulum

SWING, TURNING = Pendulum(1.0), Pendulum(3, omega0=7)
NARROW, WIDE = Pendulum(1e-6), Pendulum(3.1415)
BACK = Pendulum(-7, omega0=-9.5)
RANDOM = np.random.default_rng(11)
T = np.arange(1, 3001) / 16


def chunked(numbers: np.ndarray, size: int = 512) -> list[Chunk]:
    columns = Columns(("t", "theta", "omega"))
    found = [Sliced(numbers.shape[:1], numbers.dtype, lambda rows, i=i: numbers[rows, i]) for i in range(3)]
    return list(chunks(columns, found, size, Times(as_written=True)))


def judged(problem: Pendulum, parts: list[Chunk], *, sifted: bool, keep: int = 9) -> tuple[str, int]:
    """The summary, and how many rows were judged exactly."""
    judge, count = Judge(problem), 0
    running = judge.running(keep)
    crew = Crew(judge, others=0)
    points = Sift(judge, running, crew).points if sifted else crew.points
    for part in parts:
        found = points(part)()
        running.add(found)
        count += len(found)
    return render(page(judge.score(running, "as written")), "json"), count


def verlet(rows: int, h: float) -> np.ndarray:
    table, theta, omega = np.empty((rows, 3)), 1.0, 0.0
    for n in range(rows):
        table[n] = n * h, theta, omega
        omega -= h / 2 * 9.81 * math.sin(theta)
        theta += h * omega
        omega -= h / 2 * 9.81 * math.sin(theta)
    return table


def spoiled(problem: Pendulum, size: float) -> np.ndarray:
    y = problem.state(T)
    return np.column_stack([T, y + RANDOM.standard_normal(y.shape) * size * np.abs(y).max(axis=0)])


@pytest.mark.parametrize("problem", [SWING, TURNING, NARROW, WIDE, BACK])
@pytest.mark.parametrize("size", [1e-1, 1e-4, 1e-9, 1e-13, 0.0])
def test_the_summary_and_the_rows_shown_are_those_of_all_rows_judged_exactly(problem, size):
    parts = chunked(spoiled(problem, size))
    assert judged(problem, parts, sifted=True)[0] == judged(problem, parts, sifted=False)[0]


def test_of_an_integrators_rows_few_are_judged_exactly():
    text, count = judged(SWING, chunked(verlet(20_000, 1 / 64)), sifted=True)
    assert json.loads(text)["rows"] == 20_000
    assert count < 2_000


@pytest.mark.parametrize("place", [700, 1023, 1024, 2999])
def test_one_wrong_row_among_thousands_is_found(place):
    table = spoiled(SWING, 1e-6)
    table[place, 1] += 1e-3
    found = json.loads(judged(SWING, chunked(table), sifted=True)[0])
    assert found["worst_row"] == place + 1 or found["max_errors"]["theta"] == pytest.approx(1e-3, rel=0.01)
    assert found["max_error"] == pytest.approx(1e-3, rel=0.01)


def test_a_state_over_the_top_is_found_among_thousands():
    table = spoiled(SWING, 1e-6)
    table[1500, 2] = 9.0
    table[2500, 2] = -9.0
    text = judged(SWING, chunked(table), sifted=True)[0]
    assert "Row 1501, t = 93.8125, is the first whose state is on no orbit" in json.loads(text)["notes"][0]
    assert json.loads(text)["max_phase_error"] is None


EDGE = 2e-14
"""What doubles cannot tell from the separatrix."""
LOST = [
    ({10: 1 - EDGE, 30: 1.0001, 64: 1.0001}, 31),  # of these places the rows kept have 64 alone
    ({10: 1 - EDGE, 30: 1 + EDGE, 64: 1.0001}, 31),
    ({10: 1 + EDGE, 64: 1.0001}, 11),
    ({10: 1 - EDGE, 64: 1.0001, 70: 1.0001}, 65),
    ({600: 1 - EDGE, 610: 1 + EDGE, 640: 1.0001}, 611),
    ({100: 1.0001, 600: 1 + EDGE, 640: 1.0001}, 101),
    ({600: 1 - EDGE}, None),
]
"""The speeds at some places, of those that lead just over the top, and the first row that is on no swing."""


@pytest.mark.parametrize(("speeds", "first"), LOST)
def test_the_first_row_without_a_phase_is_named_though_a_later_one_is_seen_first(speeds, first):
    """Passages of the bottom; the first and the last row are wrong by more than those that are lost."""
    problem = Pendulum(3.0)
    period = float(problem.period())
    t = period / 4 + np.arange(1024) * period / 2
    table = np.column_stack([t, problem.state(t)])
    fastest = 2 * math.sqrt(9.81) * np.copysign(np.cos(table[:, 1] / 2), table[:, 2])
    table[[0, 500, 1010], 1] += 0.1
    table[[0, 500, 1010], 2] *= 0.5
    for place, speed in speeds.items():
        table[place, 2] = fastest[place] * speed
    text, count = judged(problem, chunked(table), sifted=True)
    assert text == judged(problem, chunked(table), sifted=False)[0]
    notes = [note for note in json.loads(text)["notes"] if "no phase" in note]
    assert [int(note.split()[1].rstrip(",")) for note in notes] == ([] if first is None else [first])
    assert count < 64


def test_near_the_separatrix_the_first_row_on_no_swing_is_that_of_all_rows():
    problem = Pendulum(3.1415924826474946)
    random = np.random.default_rng(6)
    t = np.cumsum(random.exponential(0.05, 2500))
    noise = 4e-15 * np.exp(random.normal(0, 3, (2500, 2))) * random.choice([-1, 1], (2500, 2))
    parts = chunked(np.column_stack([t, problem.state(t) + noise]), 1024)
    text, count = judged(problem, parts, sifted=True, keep=24)
    assert text == judged(problem, parts, sifted=False, keep=24)[0]
    assert "is on no orbit" in text
    assert count < 2500


def test_angles_on_the_edge_between_wrapped_and_wrong_are_counted_as_of_all_rows():
    """Half a radian beyond a whole turn, as doubles round it, to one side or the other."""
    table = spoiled(SWING, 1e-6)
    table[1000:, 1] += 2 * math.pi
    table[1000::32, 1] = SWING.state(T[1000::32])[:, 0] + 2 * math.pi + (0.5 - 2**-50)
    table[1001, 1] += 20
    text, count = judged(SWING, chunked(table), sifted=True)
    assert text == judged(SWING, chunked(table), sifted=False)[0]
    assert "theta is wrong by whole turns of 2 pi in" in text
    assert count < 600


def test_rows_with_all_the_digits_of_doubles_are_equally_good_and_the_first_is_named():
    for sifted in (True, False):
        found = json.loads(judged(SWING, chunked(spoiled(SWING, 0.0)), sifted=sifted)[0])
        assert (found["worst_row"], found["worst_digits"]) == (1, found["digits_held"])


def test_decimals_of_few_digits_that_are_right_have_all_of_theirs():
    states = SWING.state(T)
    texts = [[f"{t!r}", f"{a:.5e}", f"{b:.5e}"] for t, (a, b) in zip(T.tolist(), states.tolist(), strict=True)]
    rows = [Row(*_written(line), f"row {n}") for n, line in enumerate(texts, 1)]
    parts = []
    for first in range(0, len(rows), 500):
        part = rows[first : first + 500]
        numbers = np.array([[float(row.t.value), *(float(x.value) for x in row.state)] for row in part])
        parts.append(
            Chunk(len(part), part.__getitem__, Doubles(numbers, 6, min(n.last for row in part for n in row.state)))
        )
    text, _ = judged(SWING, parts, sifted=True)
    assert text == judged(SWING, parts, sifted=False)[0]
    assert (json.loads(text)["worst_digits"], json.loads(text)["worst_row"]) == (6, 1)


def _written(line: list[str]):
    t, *state = map(of_decimal, line)
    return t, tuple(state)


@pytest.mark.parametrize("problem", [SWING, TURNING, NARROW, WIDE, BACK, Pendulum("0.5", omega0="-2")])
def test_no_exact_row_is_outside_its_bounds(problem):
    """States near the motion, far from it, near the separatrix and turns away, at times up to 10^6 s."""
    t = np.sort(RANDOM.uniform(0, 10.0 ** RANDOM.uniform(0, 6, 400)))
    y = problem.state(t)
    size = np.abs(y).max(axis=0)
    y[::2] += RANDOM.standard_normal((200, 2)) * 10.0 ** RANDOM.uniform(-17, 1, (200, 1)) * size
    y[::7, 0] += 2 * math.pi * RANDOM.integers(-9, 9, len(y[::7]))
    edge = 2 * math.sqrt(9.81) * np.cos(y[::5, 0] / 2) * (1 + 10.0 ** RANDOM.uniform(-17, -1, 80))
    y[::5, 1] = edge * RANDOM.choice([-1, 1], 80)
    numbers = np.column_stack([t, y])
    found = problem.state_bounds().bounds(numbers, 0.0)
    judge = Judge(problem)
    judge.expect(53 * math.log10(2), -math.inf)
    points = judge.some(range(400), chunked(numbers, 400)[0].rows())
    conditioned = fast_path._conditioned(judge, found, numbers)
    for place, point in enumerate(points):
        fast_path._hold(point, found, conditioned[place], place)


def test_the_bounds_are_near_what_they_bound():
    table = spoiled(SWING, 1e-4)
    found = SWING.state_bounds().bounds(table, 0.0)
    points = Judge(SWING).points(chunked(table, len(table))[0].rows())
    phases = np.array([abs(point.phase_error) for point in points])
    assert np.all(found.found.phase - phases < 1e-11)
    assert np.all(found.errors - np.abs([point.errors for point in points]) < 1e-12)


def test_a_bound_that_is_wrong_is_an_error_and_not_a_result(monkeypatch):
    monkeypatch.setattr("reference.problems.pendulum.bounds.SLACK", -1e-3)
    with pytest.raises(BoundError, match="was found outside its bounds"):
        judged(SWING, chunked(verlet(2000, 1 / 64)), sifted=True)


LATE = {
    "0,0.5,0": "t = 0 in line 2103 comes after t = 2100",
    "2100,0.5,0": "t = 2100 in line 2103 is repeated",
    "2101,nan,0": "theta in line 2103 is nan, which is not finite",
    "2101,0.5": "line 2103 has 2 fields; 3 are accepted",
    "2101,0.5,1e-99999": "omega in line 2103 is '1e-99999', beyond the limit",
    "2101,0,5,1": "line 2103 has 4 fields; 3 are accepted",
    "2101,1_0,1": "theta in line 2103 is '1_0', which is not a number",
}


@pytest.mark.parametrize("line", LATE)
def test_a_mistake_far_down_a_long_table_is_found(line, tmp_path, capsys):
    rows = [f"{j},{0.5 + j / 1e6},0.25" for j in range(2101)]
    (tmp_path / "a.csv").write_text("\n".join(["t,theta,omega", *rows, line]))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert LATE[line] in err


def test_a_number_with_more_digits_far_down_a_table_raises_what_the_input_holds(tmp_path, capsys):
    rows = [f"{j},0.5,0.25" for j in range(2200)]
    rows[2150] = f"2150,0.{'12345' * 6},0.25e-3"
    (tmp_path / "a.csv").write_text("\n".join(["t,theta,omega", *rows]))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["digits_held"] == 30


@pytest.mark.parametrize("form", ["csv", "json"])
def test_other_processes_find_the_same_in_the_same_order(form, tmp_path, capsys, monkeypatch):
    """Rows that are right to their last digit, so that every one is judged exactly."""
    rows = [",".join(map(repr, row)) for row in spoiled(SWING, 0.0).tolist()]
    (tmp_path / "a.csv").write_text("\n".join(["t,theta,omega", *rows]))
    np.save(tmp_path / "a.npy", spoiled(SWING, 0.0))
    monkeypatch.setattr("compare.files.score.CHUNK", 100)
    for name in ("a.csv", "a.npy"):
        outputs = []
        for cores in (1, 3):
            monkeypatch.setattr("os.cpu_count", lambda cores=cores: cores)
            assert main(["score", str(tmp_path / name), "--theta0", "1", "--format", form]) == 0
            outputs.append(capsys.readouterr().out)
        assert outputs[0] == outputs[1]
        assert form == "json" or outputs[0].count("\n") == 3001


def test_a_short_file_and_other_problems_are_judged_row_by_row():
    _, count = judged(SWING, chunked(verlet(100, 1 / 64)), sifted=True)
    assert count == 100
    separatrix = Pendulum(0, omega0=2, g=1)
    _, count = judged(separatrix, chunked(np.column_stack([T, separatrix.state(T)])), sifted=True)
    assert count == 3000
