"""``python -m compare score FILE``: times and states in two arrays, as SciPy's solvers give them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import h5py
import numpy as np
import pytest

from compare.__main__ import main
from reference import Pendulum

if TYPE_CHECKING:
    from pathlib import Path

T = np.arange(0, 40) / 10
Y = Pendulum(1.0).state(T)
OFF = 1e-6
Y[30, 0] += OFF


def packed_files(folder: Path) -> None:
    np.savez(folder / "rows_first.npz", t=T, y=Y)
    np.savez(folder / "state_first.npz", t=T, y=np.ascontiguousarray(Y.T))
    np.savez_compressed(folder / "solve_ivp.npz", t=T, y=np.asfortranarray(Y.T), nfev=7, t_events=np.zeros((2, 1)))
    np.savez(folder / "rows_first_by_columns.npz", t=T, y=np.asfortranarray(Y))
    np.savez(folder / "another_name.npz", t=T, states=Y, rtol=1e-6)
    np.savez(folder / "times_in_a_column.npz", t=T[:, None], y=Y)
    np.savez(folder / "times_in_a_row.npz", t=T[None], states=Y.T)
    np.savez(folder / "columns_of_matrices.npz", t=T[:, None], theta=Y[:, :1], omega=np.asfortranarray(Y.T[1:]))
    for name, y in (("times_in_a_column.h5", Y), ("times_in_a_row.h5", Y.T)):
        with h5py.File(folder / name, "w") as file:
            file["t"], file["y"] = T[:, None] if y is Y else T[None], y
    with h5py.File(folder / "other_names_twice.h5", "w") as file:
        file["run/t"], file["run/y"], file["run/note"], file["note"] = T, Y, "ours", "ours"
    for name, y in (("rows_first.h5", Y), ("state_first.h5", Y.T)):
        with h5py.File(folder / name, "w") as file:
            file["run/t"], file["run/y"], file["note"] = T, y, "ours"


def saved(path: Path, arrays: dict[str, np.ndarray]) -> None:
    if path.suffix == ".npz":
        np.savez(path, **arrays)
        return
    with h5py.File(path, "w") as file:
        for name, array in arrays.items():
            file[name] = array


PACKED = (
    "rows_first.npz", "state_first.npz", "solve_ivp.npz", "rows_first_by_columns.npz", "another_name.npz",
    "rows_first.h5", "state_first.h5", "times_in_a_column.npz", "times_in_a_row.npz", "columns_of_matrices.npz",
    "times_in_a_column.h5", "times_in_a_row.h5", "other_names_twice.h5",
)  # fmt: skip


@pytest.mark.parametrize("name", PACKED)
def test_states_in_one_array_beside_the_times_are_read_either_way_round(name, tmp_path, capsys):
    packed_files(tmp_path)
    assert main(["score", str(tmp_path / name), "--theta0", "1", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["rows"], found["worst_row"]) == (40, 31)
    assert found["max_errors"]["theta"] == pytest.approx(OFF, rel=1e-9)
    assert found["max_errors"]["omega"] < 1e-15


MISTAKES = [
    ({"t": T, "y": np.ones((40, 3))}, "y has the shape (40, 3); (40, 2) or (2, 40) is accepted, with"),
    ({"t": T, "y": np.ones(40)}, "y has the shape (40,); (40, 2) or (2, 40) is accepted"),
    ({"t": T[:2], "y": np.eye(2)}, "so that rows and columns cannot be told apart; an array for each of"),
    ({"t": Y, "y": Y}, "t has the shape (40, 2); one number for each time is accepted"),
    ({"time": T, "y": Y}, "there is no array t: the arrays are time, y, and t, theta, omega are needed"),
    ({"t": T, "a": Y, "b": Y}, "there are 2 arrays that may hold theta, omega: a, b; one called y is accepted, or one"),
    ({"time": T, "y": Y}, "--columns A,B,C would say which they are (or A,B where B has all states)."),
    ({"t": T, "a": Y, "b": Y}, "or --columns t,a would say which it is."),
    ({"t": T, "y": Y.astype(complex)}, "theta is an array of complex128; real numbers"),
]


@pytest.mark.parametrize(("arrays", "says"), MISTAKES)
@pytest.mark.parametrize("suffix", ["npz", "h5"])
def test_shapes_that_are_wrong_or_may_mean_two_things_are_one_sentence(suffix, arrays, says, tmp_path, capsys):
    path = tmp_path / f"a.{suffix}"
    saved(path, arrays)
    assert main(["score", str(path), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in (err if suffix == "npz" else err.replace("dataset", "array"))


def test_one_of_two_datasets_with_equal_names_is_not_guessed(tmp_path, capsys):
    with h5py.File(tmp_path / "two.h5", "w") as file:
        for run in ("a", "b"):
            file[f"{run}/t"], file[f"{run}/y"] = T, Y
    assert main(["score", str(tmp_path / "two.h5"), "--theta0", "1"]) == 2
    assert capsys.readouterr().err == (
        "error: there are 2 datasets called t; one is accepted, and there are a/t, a/y, b/t, b/y; "
        "--columns a/t,a/y would say which by their paths.\n"
    )


NAMED = [
    ("npz", {"time": T, "y": Y, "z": Y * 0}, "time,y"),
    ("npz", {"t": T[:, None], "y": Y * 0, "z": Y.T}, "t,z"),
    ("h5", {"run1/t": T, "run1/y": Y * 0, "run2/t": T, "run2/y": Y}, "run2/t,run2/y"),
    ("h5", {"run1/t": T[None], "run1/y": Y.T, "run2/t": T, "run2/y": Y * 0}, "run1/t,run1/y"),
    ("h5", {"t": T, "a/y": Y * 0, "b/y": Y}, "t,b/y"),
    ("h5", {"run/time": T, "run/y": Y}, "time,y"),
    ("h5", {"a/t": T, "a/theta": Y[:, 0], "a/omega": Y[:, 1], "b/t": T, "b/theta": T}, "a/t,a/theta,omega"),
]


@pytest.mark.parametrize(("suffix", "arrays", "columns"), NAMED)
def test_the_times_and_the_array_of_states_can_be_named(suffix, arrays, columns, tmp_path, capsys):
    path = tmp_path / f"a.{suffix}"
    saved(path, arrays)
    assert main(["score", str(path), "--theta0", "1", "--columns", columns, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["rows"], found["worst_row"]) == (40, 31)
    assert found["max_errors"]["theta"] == pytest.approx(OFF, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "columns", "says"),
    [
        ("a.npz", "time,z", "there is no array z: the arrays are time, y."),
        ("a.npz", "y,time", "t has the shape (40, 2); one number for each time is accepted"),
        ("a.npz", "time,y,z,w", "names 4 columns; 3 are accepted, for t, theta, omega; or 2 of an NPZ or HDF5 file"),
        ("a.h5", "a/t,b/y", "there is no dataset b/y: the datasets are a/omega, a/t, a/theta."),
        ("a.csv", "t,y", "--columns names 2 columns; 3 are accepted, for t, theta, omega."),
        ("a.npy", "t,y", "--columns names 2 columns; 3 are accepted, for t, theta, omega."),
    ],
)  # fmt: skip
def test_names_that_do_not_lead_to_states_are_one_sentence(name, columns, says, tmp_path, capsys):
    np.save(tmp_path / "a.npy", np.column_stack([T, Y]))
    np.savez(tmp_path / "a.npz", time=T, y=Y)
    (tmp_path / "a.csv").write_text("t,y\n0,1\n")
    saved(tmp_path / "a.h5", {"a/t": T, "a/theta": T, "a/omega": T})
    assert main(["score", str(tmp_path / name), "--theta0", "1", "--columns", columns]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err


@pytest.mark.parametrize("suffix", ["npz", "h5"])
def test_arrays_are_known_by_other_names_of_the_same(suffix, tmp_path, capsys):
    path = tmp_path / f"a.{suffix}"
    saved(path, {"time": T, "theta": Y[:, 0], "theta_dot": Y[:, 1], "note": T})
    assert main(["score", str(path), "--theta0", "1", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["worst_row"] == 31


def test_the_groups_of_equal_columns_are_named(tmp_path, capsys):
    saved(tmp_path / "a.h5", {f"{run}/{name}": T for run in ("b", "a") for name in ("t", "theta", "omega")})
    assert main(["score", str(tmp_path / "a.h5"), "--theta0", "1"]) == 2
    assert "--columns a/t,a/theta,a/omega would say which by their paths." in capsys.readouterr().err


def test_an_array_that_lies_on_its_side_is_told(tmp_path, capsys):
    np.save(tmp_path / "a.npy", np.column_stack([T, Y]).T)
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1"]) == 2
    said = capsys.readouterr().err
    assert "there are 40 columns without a header" in said
    assert said.endswith("; the array has the shape (3, 40), so that its transpose may be meant.\n")
