"""``python -m compare score FILE``: what is no text, numbers of any size, and columns in each other's places."""

from __future__ import annotations

import json
import math

import h5py
import numpy as np
import pytest

import compare
from compare.__main__ import main
from reference import Pendulum
from reference.arithmetic.precision import mp
from reference.names import short
from reference.problems.polar.problem import PolarBrachistochrone

P = Pendulum(1.0)
T = np.arange(0, 600) / 64
ROWS = np.column_stack([T, P.state(T)])
HEADER = "t,theta,omega\n"


def text_of(rows: np.ndarray, changed: dict[int, str] | None = None) -> str:
    lines = [",".join(map(repr, row)) for row in rows.tolist()]
    for place, line in (changed or {}).items():
        lines[place] = line
    return HEADER + "\n".join(lines) + "\n"


def refused(path, capsys, *options: str) -> str:
    assert main(["score", str(path), "--theta0", "1", *options]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.removesuffix("\n").isprintable()
    return err


def test_an_angle_beyond_any_count_of_turns_is_wrong_and_not_wrapped(tmp_path, capsys):
    for size in ("1e300", "-1e15", "1e12"):
        (tmp_path / "a.csv").write_text(text_of(ROWS, {500: f"7.8125,{size},0.5"}))
        found = []
        for rows in ("1", "2000"):
            assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--format", "json", "--rows", rows]) == 0
            found.append(json.loads(capsys.readouterr().out))
        assert found[0]["max_errors"]["theta"] == pytest.approx(abs(float(size)))
        assert [note for note in found[0]["notes"] if "turns" in note] == []
        point = found[1]["points"][500]
        with mp.workdps(400):
            energy = mp.mpf("0.5") ** 2 / 2 + mp.mpf(9.81) * (1 - mp.cos(mp.mpf(size)))
            exact = energy / (mp.mpf(9.81) * (1 - mp.cos(1))) - 1
        assert point["energy_error"] == pytest.approx(float(exact), rel=1e-14)


def test_turns_are_counted_as_far_as_doubles_tell_them():
    rows = P.state(T)
    rows[100:, 0] += 2 * math.pi * 1e9
    (note,) = compare.score(P, T, rows).notes
    assert note.startswith("theta is wrong by whole turns of 2 pi in 500 of 600 rows, from row 101 on")


@pytest.mark.parametrize("form", ["json", "csv", "text"])
@pytest.mark.parametrize("line", ["7,1e400,0", "7,0.5,-1e309", "7,0.5,1e200"])
def test_an_error_beyond_doubles_is_one_sentence_and_no_number(line, form, tmp_path, capsys):
    last = line.replace("7,", "10,")
    for name, rows in (("long", ROWS[:448]), ("short", ROWS[:20])):
        text = text_of(rows) + f"{line}\n8,0.5,0.5\n{last}\n"
        (tmp_path / f"{name}.csv").write_text(text)
        said = refused(tmp_path / f"{name}.csv", capsys, "--format", form)
        number = len(rows) + 2
        assert (
            f"the state in line {number} is {line[2:].replace(',', ', ')}: its error or its energy is beyond 1.8e+308"
            in said
        )


def test_times_beyond_doubles_are_times(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("compare.files.score.CHUNK", 2)
    (tmp_path / "a.csv").write_text(f"{HEADER}0.0,1,0\n1e400,1,1\n2e400,0.5,1\n")
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 0
    assert "3 rows, worst" in capsys.readouterr().out
    (tmp_path / "a.csv").write_text(f"{HEADER}0.0,1,0\n1e400,1,1\n3,0.5,1\n")
    assert "t = 3 in line 4 comes after t = 1e400" in refused(tmp_path / "a.csv", capsys)


ESCAPES = "\x1b[31mtheta\x1b[0m"
NO_TEXT = {
    f"t,{ESCAPES},omega\n0,1,0\n": r"the columns are t, \x1b[31mtheta\x1b[0m, omega, and",
    f"t,{ESCAPES} [deg],omega\n0,1,0\n": r"\x1b[31mtheta",
    f"{HEADER}0,1,0\n1,\x1b[2J,0\n": r"theta in line 3 is '\x1b[2J', which is not a number",
    f"{HEADER}0,1,0\n1,nan(\x07),0\n": r"theta in line 3 is nan(\x07), which is not finite",
    "t,theta,theta\x9b,omega\n0,1,0\x00,0\n": "line 2 has a NUL character, as no text file has; a table of text in",
    f't,"{"a" * 200_000}",omega\n0,1,0\n': "a field in quotes is longer than 131072 characters",
}  # fmt: skip


@pytest.mark.parametrize("number", range(len(NO_TEXT)))
def test_no_sentence_commands_the_terminal(number, tmp_path, capsys):
    text, says = list(NO_TEXT.items())[number]
    (tmp_path / "a.csv").write_bytes(text.encode())
    assert says in refused(tmp_path / "a.csv", capsys)


def test_names_in_archives_do_not_command_the_terminal_either(tmp_path, capsys):
    column = np.ones(4)
    np.savez(tmp_path / "a.npz", **{"t": column, ESCAPES: column})
    np.savez(tmp_path / "b.npz", **{"t": column, ESCAPES: np.ones((5, 2))})
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["t"], file[ESCAPES], file[f"b/{ESCAPES}"] = column, column, column
    for name, options in (
        ("a.npz", ()),
        ("b.npz", ()),
        ("a.h5", ()),
        ("a.h5", ("--columns", f"t,{ESCAPES},x")),
        ("a.h5", ("--columns", "t,\x1b,x")),
    ):
        assert r"\x1b" in refused(tmp_path / name, capsys, *options)


def test_what_cannot_be_printed_is_escaped_and_all_else_is_as_it_was():
    assert short("θ, Δt and čas") == "θ, Δt and čas"
    assert short("a\x1bb\x85\u202e\udce8") == r"a\x1bb\x85\u202e\udce8"
    assert short("\x1b" * 100) == r"\x1b" * 40 + "... (100 characters)"


LATIN = {
    "Größe,theta,omega\n0,1,0\n": "line 1 has bytes that are not UTF-8; a table of text in UTF-8 is accepted",
    "t,theta [°],omega\n0,1,0\n": "line 1 has bytes that are not UTF-8",
    f"{HEADER}0,1,0\n1,½,0\n": "line 3 has bytes that are not UTF-8",
}


@pytest.mark.parametrize("text", LATIN)
def test_bytes_that_are_not_utf8_are_named_where_they_matter(text, tmp_path, capsys):
    (tmp_path / "a.csv").write_bytes(text.encode("latin-1"))
    assert LATIN[text] in refused(tmp_path / "a.csv", capsys)


def test_bytes_that_are_not_utf8_do_no_harm_in_comments_and_other_columns(tmp_path, capsys):
    text = "# für Δ\nt,theta,omega,Größe\n0,1,0,ä\n".replace("Δ", "d")
    (tmp_path / "a.csv").write_bytes(text.encode("latin-1"))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 0
    assert "1 row, worst" in capsys.readouterr().out


def test_bytes_of_no_text_file_are_no_table(tmp_path, capsys):
    random = np.random.default_rng(3)
    for size in (50, 3000):
        (tmp_path / "a.csv").write_bytes(b"\x89PNG\r\n\x1a\n" + random.bytes(size))
        assert "a table of text in UTF-8 is accepted" in refused(tmp_path / "a.csv", capsys)


SWAPPED = "The first 16 rows fit the truth where theta and omega are exchanged, and not as they are: each may be in the"


@pytest.mark.parametrize("rows", [600, 20])
def test_columns_in_each_others_places_are_pointed_out(rows, tmp_path, capsys):
    table = ROWS[:rows, [0, 2, 1]] * (1, 1 + 1e-3, 1 - 1e-3)
    (tmp_path / "a.csv").write_text(text_of(table))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--format", "json"]) == 0
    notes = json.loads(capsys.readouterr().out)["notes"]
    assert notes[-1].startswith(SWAPPED)


def test_numbers_that_are_merely_wrong_are_not_taken_for_ones_in_other_places():
    random = np.random.default_rng(4)
    states = P.state(T)
    for size in (1e-3, 0.3, 3.0):
        found = compare.score(P, T, states + random.standard_normal(states.shape) * size)
        assert not any("exchanged" in note for note in found.notes)
    assert not any("exchanged" in note for note in compare.score(P, [0, 0.1], states[:2, ::-1]).notes)
    alike = Pendulum(1e-3, g=1)
    later = alike.state(T + math.pi / 2)
    assert not any("exchanged" in note for note in compare.score(alike, T, later).notes)


def test_of_more_than_two_numbers_those_are_named_that_are_exchanged():
    problem = PolarBrachistochrone(0.5)
    t = np.arange(1, 30) / 64
    found = compare.score(problem, t, problem.state(t)[:, [0, 2, 1]])
    assert "z_rate and phi are exchanged" in found.notes[-1]
