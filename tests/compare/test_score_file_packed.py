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
    for name, y in (("rows_first.h5", Y), ("state_first.h5", Y.T)):
        with h5py.File(folder / name, "w") as file:
            file["run/t"], file["run/y"], file["note"] = T, y, "ours"


PACKED = (
    "rows_first.npz", "state_first.npz", "solve_ivp.npz", "rows_first_by_columns.npz", "another_name.npz",
    "rows_first.h5", "state_first.h5",
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
    ({"t": T, "y": Y.astype(complex)}, "theta is an array of complex128; real numbers"),
]


@pytest.mark.parametrize(("arrays", "says"), MISTAKES)
@pytest.mark.parametrize("suffix", ["npz", "h5"])
def test_shapes_that_are_wrong_or_may_mean_two_things_are_one_sentence(suffix, arrays, says, tmp_path, capsys):
    path = tmp_path / f"a.{suffix}"
    if suffix == "npz":
        np.savez(path, **arrays)
    else:
        with h5py.File(path, "w") as file:
            file.update(arrays)
    assert main(["score", str(path), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in (err if suffix == "npz" else err.replace("dataset", "array"))


def test_one_of_two_datasets_with_equal_names_is_not_guessed(tmp_path, capsys):
    with h5py.File(tmp_path / "two.h5", "w") as file:
        for run in ("a", "b"):
            file[f"{run}/t"], file[f"{run}/y"] = T, Y
    assert main(["score", str(tmp_path / "two.h5"), "--theta0", "1"]) == 2
    assert "error: there are 2 datasets called t" in capsys.readouterr().err
