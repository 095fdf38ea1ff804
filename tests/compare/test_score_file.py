"""``python -m compare score FILE``: every format, every mistake, memory that does not grow."""

from __future__ import annotations

import csv
import io
import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import h5py
import numpy as np
import pytest

from compare.__main__ import main
from compare.files import lines as numbered_lines
from compare.files.columns import Columns
from compare.files.score import Rows
from reference import Pendulum
from reference.problems.cycloid.problem import Cycloid
from reference.problems.cycloid.tautochrone import Tautochrone
from reference.problems.polar.problem import PolarBrachistochrone

ROOT = Path(__file__).parents[2]
P = Pendulum(1.0)
T = np.arange(0, 40) / 10
Y = P.state(T)
OFF = 1e-6
Y[30, 0] += OFF
ROWS = list(zip(T.tolist(), *Y.T.tolist(), strict=True))


def summary(path: Path, capsys, *options: str) -> dict:
    assert main(["score", str(path), "--theta0", "1", "--format", "json", *options]) == 0
    return json.loads(capsys.readouterr().out)


def lines(separator: str, header: str, order=(0, 1, 2)) -> str:
    return header + "".join(separator.join(repr(row[i]) for i in order) + "\n" for row in ROWS)


TEXTS = {
    "commas.csv": lines(",", "t,theta,omega\n"),
    "semicolons.csv": lines(";", "t;theta;omega\n"),
    "tabs.tsv": lines("\t", "t\ttheta\tomega\n"),
    "blanks.txt": lines("  ", "   t   theta    omega\n"),
    "no_header.dat": lines(",", ""),
    "comment.csv": lines(",", "# made by hand\n# t,theta,omega\n"),
    "another_order.csv": lines(",", "omega,t,theta\n", (2, 0, 1)),
    "order_in_a_comment.csv": lines(",", "# omega,t,theta\n", (2, 0, 1)),
    "with_more_columns.csv": lines(",", "theta,step,t,omega\n", (1, 0, 0, 2)),
    "quoted.csv": lines(",", '"T","Theta [rad]","omega (rad/s)"\n'),
    "byte_order_mark.csv": lines(",", "\ufefft,theta,omega\n"),
    "windows.csv": lines(",", "t,theta,omega\n").replace("\n", "\r\n"),
    "gaps.csv": lines(",", "\n\nt,theta,omega\n\n").replace("\n", "\n\n", 9),
    "fortran.txt": lines(" ", "").replace("e-", "D-"),
}


@pytest.mark.parametrize("name", TEXTS)
def test_a_table_of_text_is_read_whatever_separates_it(name, tmp_path, capsys):
    (tmp_path / name).write_bytes(TEXTS[name].encode())
    found = summary(tmp_path / name, capsys)
    assert (found["rows"], found["worst_row"], found["times"]) == (40, 31, "binary64")
    assert found["max_error"] == pytest.approx(OFF, rel=1e-9)


def test_a_table_that_a_windows_shell_redirected_is_read(tmp_path, capsys):
    (tmp_path / "wide.txt").write_text(TEXTS["commas.csv"], encoding="utf-16")
    assert summary(tmp_path / "wide.txt", capsys)["worst_row"] == 31


def test_columns_can_be_named_and_numbered(tmp_path, capsys):
    (tmp_path / "a.csv").write_text(lines(";", "Zeit;Winkel;Rate\n"))
    assert summary(tmp_path / "a.csv", capsys, "--columns", "Zeit,Winkel,Rate")["worst_row"] == 31
    (tmp_path / "b.csv").write_text(lines(" ", "", (2, 2, 1, 0)))
    assert summary(tmp_path / "b.csv", capsys, "--columns", "4,3,1")["worst_row"] == 31


def array_files(folder: Path) -> None:
    table = np.column_stack([T, Y])
    np.save(folder / "table.npy", table)
    np.save(folder / "by_column.npy", np.asfortranarray(table))
    np.save(folder / "big_endian.npy", table.astype(">f8"))
    np.save(folder / "fields.npy", np.array(ROWS, dtype=[("t", float), ("theta", float), ("omega", float)]))
    np.save(folder / "strings.npy", np.array([[repr(value) for value in row] for row in ROWS]))
    np.savez(folder / "arrays.npz", omega=Y[:, 1], t=T, theta=Y[:, 0], other=np.eye(3))
    np.savez_compressed(folder / "packed.npz", omega=Y[:, 1], t=T, theta=Y[:, 0])
    with h5py.File(folder / "group.h5", "w") as file:
        file["run/1/t"], file["run/1/theta"], file["run/1/omega"] = T, Y[:, 0].reshape(-1, 1), Y[:, 1].reshape(1, -1)
        file["note"] = "ours"
    with h5py.File(folder / "matlab.mat", "w") as file:
        file["t"], file["theta"], file["omega"] = T[None], Y[None, :, 0], Y[None, :, 1]
    with h5py.File(folder / "compound.hdf5", "w") as file:
        file["run"] = np.array(ROWS, dtype=[("t", float), ("theta", float), ("omega", float)])
    with h5py.File(folder / "strings.h5", "w") as file:
        for name, column in zip(("t", "theta", "omega"), zip(*ROWS, strict=True), strict=True):
            file[name] = [repr(value) for value in column]


ARRAYS = (
    "table.npy", "by_column.npy", "big_endian.npy", "fields.npy", "strings.npy",
    "arrays.npz", "packed.npz", "group.h5", "matlab.mat", "compound.hdf5", "strings.h5",
)  # fmt: skip


@pytest.mark.parametrize("name", ARRAYS)
def test_arrays_are_read_from_numpys_files_and_from_hdf5(name, tmp_path, capsys):
    array_files(tmp_path)
    found = summary(tmp_path / name, capsys)
    times = "binary64" if name.startswith("strings") else "as written"
    assert (found["rows"], found["worst_row"], found["times"]) == (40, 31, times)
    assert found["max_error"] == pytest.approx(OFF, rel=1e-9)


def test_the_path_of_a_dataset_tells_equal_names_apart(tmp_path, capsys):
    with h5py.File(tmp_path / "two.h5", "w") as file:
        for run, theta in (("a", Y[:, 0] * 0), ("b", Y[:, 0])):
            file[f"{run}/t"], file[f"{run}/theta"], file[f"{run}/omega"] = T, theta, Y[:, 1]
    assert summary(tmp_path / "two.h5", capsys, "--columns", "b/t,b/theta,b/omega")["worst_row"] == 31
    assert main(["score", str(tmp_path / "two.h5"), "--theta0", "1"]) == 2
    assert "there are 2 datasets called t; one is accepted" in capsys.readouterr().err


def test_48_digits_are_judged_to_48_digits_at_times_as_written(tmp_path, capsys):
    exact = Pendulum("0.7", g="9.81")
    rows = ["0,0.7,0"]
    rows += [
        ",".join([t, *(exact.certified("state", t_, i).digits(48) for i in (0, 1))])
        for t, t_ in ((f"{j / 10:.1f}", Fraction(j, 10)) for j in range(1, 30))
    ]
    (tmp_path / "long.csv").write_text("t,theta,omega\n" + "\n".join(rows))
    assert main(["score", str(tmp_path / "long.csv"), "--theta0", "0.7", "--exact", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["worst_digits"], found["rows"], found["times"]) == (48, 30, "as written")
    assert found["max_error"] < 1e-46
    assert main(["score", str(tmp_path / "long.csv"), "--theta0", "0.7", "--format", "json"]) == 0
    assert 14 < json.loads(capsys.readouterr().out)["worst_digits"] < 18  # 0.7 is no double


def test_times_of_a_double_precision_table_are_doubles_unless_they_are_to_be_exact(tmp_path, capsys):
    t = np.arange(0, 100) / 10
    path = tmp_path / "a.csv"
    path.write_text("".join(f"{a!r},{b!r},{c!r}\n" for a, (b, c) in zip(t.tolist(), P.state(t).tolist(), strict=True)))
    doubles, written = summary(path, capsys), summary(path, capsys, "--exact")
    assert (doubles["times"], written["times"]) == ("binary64", "as written")
    assert doubles["max_error"] < 4.5e-16 < written["max_error"] < 1e-14


@pytest.mark.parametrize(
    ("problem", "header", "options"),
    [
        (
            Tautochrone(1.0, 2.0),
            "t,angle,angular_velocity",
            ["--problem", "tautochrone", "--angle", "1", "--radius", "2"],
        ),
        (Cycloid(2.0, 1.0), "t,arc,arc_rate", ["--problem", "cycloid", "--end", "2,1"]),
        (PolarBrachistochrone(0.5), "tau,z,z_rate,phi", ["--problem", "polar", "--z0", "0.5"]),
    ],
)
def test_any_family_that_has_a_state_is_served_with_its_own_options(problem, header, options, tmp_path, capsys):
    times = np.arange(0, 8) / 8
    y = problem.state(times)
    y[5, 0] += 1e-7
    rows = [",".join(map(repr, [t, *state])) for t, state in zip(times.tolist(), y.tolist(), strict=True)]
    (tmp_path / "a.csv").write_text("\n".join([header, *rows]))
    assert main(["score", str(tmp_path / "a.csv"), *options, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["rows"], found["worst_row"]) == (8, 6)
    assert found["max_error"] == pytest.approx(1e-7, rel=1e-6)
    assert main(["score", str(tmp_path / "a.csv"), *options, "--theta0", "1"]) == 2
    assert "option '--theta0' is unknown" in capsys.readouterr().err


@pytest.mark.parametrize("form", ["text", "markdown", "latex"])
def test_tables_mark_the_first_wrong_digit_and_end_with_the_summary(form, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(TEXTS["commas.csv"])
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--format", form]) == 0
    out = capsys.readouterr().out
    assert "-0.82383[2]839" in out  # the truth is -0.82383384
    said = "40 rows, worst 5.9 correct digits (row 31), 6.0 on scale (row 31), max error 1.0e-06"
    assert said in out.splitlines()[-1]


def test_csv_has_every_row_and_json_an_even_choice(tmp_path, capsys):
    (tmp_path / "a.csv").write_text(TEXTS["commas.csv"])
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--format", "csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert [row["row"] for row in rows] == [str(number) for number in range(1, 41)]
    assert float(rows[30]["theta_error"]) == pytest.approx(OFF, rel=1e-9)
    assert rows[30]["theta"] == repr(Y[30, 0].item())
    found = summary(tmp_path / "a.csv", capsys, "--rows", "4")
    assert [point["row"] for point in found["points"]] == [1, 17, 31, 33, 40]
    assert found["points"][2]["first_wrong_digit"]["theta"] == 6


MISTAKES = {
    "t,theta\n0,1\n": "there is no column omega: the columns are t, theta, and t, theta, omega are needed",
    "Zeit,Winkel,Rate\n0,1,0\n": "and t, theta, omega are needed; --columns Zeit,Winkel,Rate would say which they are.",
    "t,theta,theta,omega\n0,1,1,0\n": "there are 2 columns called theta",
    "t,theta [deg],omega\n0,57,0\n": "the column theta [deg] is in degrees; radians are accepted",
    "0,1,0,7\n": "there are 4 columns without a header; 3 are accepted (t, theta, omega)",
    "t,theta,omega\n0,1,0\n1,0.5\n": "line 3 has 2 fields; 3 are accepted",
    "t,theta,omega\n0,1,0\n\n1,x,0\n": "theta in line 4 is 'x', which is not a number",
    "t,theta,omega\n0,1,0\n1,,0\n": "theta in line 3 is empty",
    "t,theta,omega\n0,1,0\n1,nan,0\n": "theta in line 3 is nan, which is not finite",
    "t,theta,omega\n0,1,0\n1,0.5,-inf\n": "omega in line 3 is -inf, which is not finite",
    "t,theta,omega\n0,1,0\n1,0.5,1e99999\n": "omega in line 3 is '1e99999', beyond the limit of 4000 digits",
    "t,theta,omega\n0,1,0\n0,1,0\n": "t = 0 in line 3 is repeated",
    "t,theta,omega\n1,1,0\n0.5,1,0\n": "t = 0.5 in line 3 comes after t = 1",
    "t,theta,omega\n0,57.29578,0\n0.1,54.94,-46.87\n": "theta is 57.3 times the truth, as an angle in degrees would be",
    "t,theta,omega\n": "has no rows",
    "": "has no rows",
    "\x00\x01\x02": "line 1 has a NUL character, as no text file has; a table of text in UTF-8 is accepted",
}  # fmt: skip


@pytest.mark.parametrize("text", MISTAKES)
def test_a_table_that_cannot_be_judged_is_one_sentence_and_exit_code_2(text, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(text)
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    assert MISTAKES[text] in err


def test_a_line_without_end_is_refused_before_it_is_read(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(numbered_lines, "MAX_LINE", 1000)
    (tmp_path / "a.csv").write_text("0" * 5000)
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    assert "line 1 is longer than 1000 characters" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["nowhere.csv", "--theta0", "1"], "there is no file 'nowhere.csv'"),
        ([".", "--theta0", "1"], "'.' is a folder"),
        (["README.md", "--theta0", "1"], "'README.md' is of no format that is read here; accepted are .csv"),
        (["README.md"], "--theta0 of the pendulum is needed"),
        (["README.md", "--theta0", "4"], "theta0 is 4.0"),
        (["README.md", "--theta0", "x"], "theta0 is 'x', which spells no number"),
        (["README.md", "--problem", "pendulm"], "perhaps pendulum"),
        (["README.md", "--theta0", "1", "--colums", "a"], "perhaps --columns"),
        (["README.md", "--theta0", "1", "--columns", "a,b"], "--columns names 2 columns; 3 are accepted"),
        (["README.md", "--theta0", "1", "--columns", "a,,b"], "--columns is 'a,,b'"),
        (["README.md", "--theta0", "1", "--rows", "0"], "--rows is '0'; a positive integer is accepted"),
        ([], "required: FILE"),
    ],
)
def test_a_mistake_in_the_command_is_one_sentence(words, says, capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    assert main(["score", *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("a.npy", b"t,theta,omega", "which NumPy cannot read"),
        ("a.npz", b"t,theta,omega", "which NumPy cannot read"),
        ("a.h5", b"t,theta,omega", "is no HDF5 file"),
        ("a.npy", np.arange(5.0), "the array has the shape (5,); [rows, columns] is accepted"),
        ("a.npy", np.ones((2, 5)), "there are 5 columns without a header"),
        ("a.npy", np.ones((0, 3)), "there are no rows"),
        ("a.npy", np.ones((2, 3), dtype=complex), "t is an array of complex128; real numbers"),
        ("a.npy", np.array([[0, 1, np.nan]]), "omega in row 1 is nan"),
        ("a.npz", {"t": T, "theta": T}, "there is no array omega: the arrays are t, theta"),
        ("a.npz", {"t": T, "theta": T, "omega": T[1:]}, "the shapes t (40,), theta (40,), omega (39,)"),
        ("a.npz", {"t": T, "theta": T, "omega": np.array([None])}, "omega.npy is an array of Python objects"),
    ],
)  # fmt: skip
def test_arrays_that_cannot_be_judged_are_one_sentence(name, content, says, tmp_path, capsys):
    path = tmp_path / name
    if isinstance(content, bytes):
        path.write_bytes(content)
    elif isinstance(content, dict):
        np.savez(path, **content)
    else:
        np.save(path, content)
    assert main(["score", str(path), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err


def test_a_file_is_read_a_part_at_a_time(tmp_path):
    """Of a table without end only what was asked for is taken."""
    path = tmp_path / "endless.csv"
    path.write_text("t,theta,omega\n" + "".join(f"{j},1,0\n" for j in range(10_000)))
    chunks = Rows(str(path), Columns(("t", "theta", "omega")), as_written=True).chunks(64)
    first, second = next(chunks), next(chunks)
    assert (len(first), second.rows([0])[0].t.text, second.rows()[-1].place) == (64, "64", "line 129")
    chunks.close()


def test_memory_does_not_grow_with_the_rows():
    write = "print('t,theta,omega'); [print(f'{j + 1},0.5,{j}') for j in range(int(__import__('sys').argv[1]))]"
    read = (
        "import resource, sys; from compare.__main__ import main\n"
        "main(['score', '-', '--theta0', '1', '--rows', '2'])\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)"
    )
    peaks = []
    for rows in (2_000, 24_000):
        with subprocess.Popen([sys.executable, "-c", write, str(rows)], stdout=subprocess.PIPE) as writer:
            done = subprocess.run(
                [sys.executable, "-c", read], cwd=ROOT, stdin=writer.stdout, capture_output=True, text=True, check=True
            )
        assert f"{rows} rows, worst" in done.stdout
        peaks.append(int(done.stderr))
    assert peaks[1] < peaks[0] + 3_000
