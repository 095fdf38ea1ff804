"""The public functions."""

from __future__ import annotations

from functools import partial
from typing import Any

import pytest

import compare
from compare import scored as scoring
from compare import study as studies
from compare.methods import DEFAULT, METHODS, find
from reference import Pendulum
from reference.command.executors import processes
from reference.problems.polar.paths import PolarByPsi

study = partial(studies.study, "pendulum")


def test_error_vs_n_and_energy_drift_give_what_the_study_gives() -> None:
    found = study(n=(128, 256), methods=("rk4", "verlet"))
    assert compare.error_vs_n(Pendulum(1.0), methods=("rk4", "verlet"), n=[128, 256]) == found.error_vs_n
    assert compare.energy_drift(Pendulum(1.0), methods=("rk4", "verlet"), n=[128, 256]) == found.energy_drift


def test_processes_give_what_one_process_gives() -> None:
    alone = study(n=(128, 16384), methods=("yoshida4", "euler", "implicit_midpoint"))
    with processes(1) as executor:
        shared = study(n=(128, 16384), methods=("yoshida4", "euler", "implicit_midpoint"), executor=executor)
    assert shared == alone


def test_scores_in_a_wide_format_are_numbers_too() -> None:
    (cell,) = compare.error_vs_n(Pendulum("1/2"), methods=("suzuki4",), n=[512], precision="mp:160", t_end="2.5")
    assert 0 < cell.max_error < 1e-6
    assert not cell.floor


def test_all_stands_for_every_method_once_in_their_order() -> None:
    assert scoring.named(["all"]) == METHODS
    assert scoring.named([" All ", "rk4"]) == METHODS
    assert scoring.named(["rk4", "all"]) == (find("rk4"), *(method for method in METHODS if method.name != "rk4"))
    assert scoring.named(None) == DEFAULT


def test_of_all_methods_those_that_do_not_fit_the_problem_are_left_out_and_named(monkeypatch) -> None:
    monkeypatch.setattr(scoring, "METHODS", tuple(map(find, ("rk4", "verlet", "avf", "ab4"))))
    found = scoring.score_all([PolarByPsi("1/2")], ["all"], n=[128], t_end=6)
    assert [cell.method for cell in found.cells] == ["rk4", "adams_bashforth4"]
    assert list(found.left_out.values()) == [("verlet", "avf")]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"n": 1000}, "n is 1000; a sequence such as"),
        ({"n": [128], "methods": "rk4"}, "methods is 'rk4'; a sequence such as"),
        ({"n": [128], "methods": [3]}, "method '3' is unknown"),
        ({"n": [128], "precision": 64}, "precision '64' is unknown"),
    ],
)
def test_a_wrong_kind_of_argument_is_refused_in_one_sentence(options: dict[str, Any], sentence: str) -> None:
    with pytest.raises((TypeError, ValueError), match=sentence):
        compare.error_vs_n(Pendulum(1.0), **options)


def test_what_is_no_problem_is_refused() -> None:
    with pytest.raises(TypeError, match=r"problems such as Pendulum\(1.0\) are accepted"):
        compare.error_vs_n(3, n=[128])


def test_an_unknown_name_is_no_attribute() -> None:
    assert not hasattr(compare, "nonsense")
