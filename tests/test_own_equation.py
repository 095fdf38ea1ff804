"""The worked example of docs/own-equation.md: a file with formulas, from proven digits to scored tables."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from compare.__main__ import main
from compare.report.problems import reported
from reference.__main__ import main as reference_main
from reference.problems.families import FAMILIES, find_family

FILE = Path(__file__).parents[1] / "docs" / "hoop.toml"
HOOP = ("flow", "--config", str(FILE))


def answer(capsys: pytest.CaptureFixture[str], command: Any, *words: str) -> Any:
    assert command([*words, "--format", "json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_its_digits_are_proven_and_agreed(capsys: pytest.CaptureFixture[str]) -> None:
    found = answer(capsys, reference_main, "at", *HOOP, "--t", "1", "--index", "0", "--digits", "30", "--routes")
    assert found["theta"] == "0.665686225879024776180881721992"
    assert min(digits for by_route in found["routes"].values() for digits in by_route.values()) >= 45
    assert find_family(str(FILE)).problem().state(float(found["zero_crossing"]))[1] == pytest.approx(0, abs=1e-14)


def test_integrators_are_scored_on_it_and_on_what_it_conserves(capsys: pytest.CaptureFixture[str]) -> None:
    found = answer(capsys, main, *HOOP, "--methods", "rk4,gauss4", "--n", "256,512,1024")["tables"]
    assert {row["method"]: round(row["fitted_order"]) for row in found["order"]} == {"rk4": 4, "gauss4": 4}
    drifts = {(row["method"], row["n"]): row["max_drift_relative"] for row in found["energy_drift"]}
    assert 0 < drifts["gauss4", 1024] < drifts["rk4", 1024] < 1e-9


def test_numbers_of_any_origin_are_judged_on_it(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    table = tmp_path / "mine.csv"
    table.write_text("t,theta,omega\n0.5,0.70,-1.2\n1,0.665686225879,-1.770780446572\n")
    rows = answer(capsys, main, "score", str(table), "--problem", *HOOP)["points"]
    assert [row["digits"] for row in rows] == [0, 13]


def test_help_lists_flows_by_name_and_a_report_draws_them_by_name() -> None:
    flows = {family.name for family in FAMILIES if not family.has_closed_form}
    assert flows
    assert not flows & set(reported())
    assert set(reported(["lorenz"])) == {"lorenz"}
