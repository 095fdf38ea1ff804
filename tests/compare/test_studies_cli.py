"""The commands of the families: their options, what they print, one sentence for every mistake."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest

from compare import arguments
from compare.__main__ import main

FAMILIES = ("pendulum", "brachistochrone", "tautochrone", "descent", "polar")
SMALL = ["--n", "64,128", "--methods", "rk4,verlet"]


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_prints_its_tables(family, capsys):
    assert main([family, *SMALL]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith(family)
    assert "Error against N" in out
    assert "rk4" in out


@pytest.mark.parametrize("family", ["brachistochrone", "descent", "polar"])
def test_forms_and_curves_give_json_and_figures(family, capsys, tmp_path):
    assert main([family, *SMALL, "--format", "json", "--plots", "--out", str(tmp_path), "--quiet"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["problem"] == family
    assert {"method", "n", "h", "max_error", "rms_error", "digits"} < set(found["tables"]["error_vs_n"][0])
    assert (tmp_path / f"{family}.json").exists()
    assert len(list(tmp_path.glob("*.png"))) == len(list(tmp_path.glob("*.svg"))) >= 2


def test_scores_that_are_asked_for_are_shown_and_all_are_in_json(capsys):
    words = ["pendulum", *SMALL, "--scores", "phase,period", "--scores", "defects,norms"]
    assert main(words) == 0
    out = capsys.readouterr().out
    for title in ("Norms,", "Phase,", "Amplitude,", "Period,", "Symplecticity defect,", "Reversibility defect,"):
        assert title in out
    assert "Error against N" not in out
    assert main([*words, "--format", "json"]) == 0
    tables = json.loads(capsys.readouterr().out)["tables"]
    assert list(tables) == ["error_vs_n", "order", "energy_drift", "phase", "period", "defects"]


def test_compensated_summation_stands_beside_each_method(capsys):
    words = ["pendulum", "--n", "4096", "--methods", "yoshida4", "--compensated", "--precision", "float32"]
    assert main([*words, "--format", "json"]) == 0
    cells = json.loads(capsys.readouterr().out)["tables"]["error_vs_n"]
    assert [cell["method"] for cell in cells] == ["yoshida4", "yoshida4_compensated"]
    assert cells[0]["max_error"] > 10 * cells[1]["max_error"]


def test_a_pendulum_can_be_set_going(capsys):
    assert main(["pendulum", *SMALL, "--theta0", "0.5,4", "--omega0", "-8", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["parameters"]["omega0"] == -8.0
    assert {(cell["theta0"], cell["omega0"]) for cell in found["tables"]["error_vs_n"]} == {(0.5, -8.0), (4.0, -8.0)}


@pytest.mark.parametrize(
    ("words", "options"),
    [
        (["brachistochrone", "--end", "3,2", "--end", "1,4"], {"end": ((3.0, 2.0), (1.0, 4.0))}),
        (
            ["brachistochrone", "--exact", "--end=1/3,2", "--form", "curve"],
            {"end": ((Fraction(1, 3), 2),), "form": ("curve",)},
        ),
        (["tautochrone", "--angle", "-1,3", "--radius", "2"], {"angle": (-1.0, 3.0), "radius": 2.0}),
        (["descent", "--curve", "2*x", "--start", "pi", "--end", "0"], {"curve": ("2*x",), "start": "pi", "end": "0"}),
        (["polar", "--z0", "0.5", "--z-end", "0.6", "--tau-end", "2"], {"z0": (0.5,), "z_end": 0.6, "tau_end": 2.0}),
        (["tautochrone", "--methods", "all"], {"methods": ("all",)}),
        (["pendulum", "--compensated", "--scores", "growth"], {"compensated": "beside", "scores": ("growth",)}),
    ],
)
def test_options_given_reach_the_study_and_others_do_not(words, options):
    assert arguments.parse(words).options == options


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["brachistochrone", "--end", "3"], "--end is '3'; two numbers with a comma between them"),
        (["brachistochrone", "--end", "3,x"], "--end 'x' is not a number"),
        (["brachistochrone", "--theta0", "1"], "'--theta0' is unknown"),
        (["tautochrone", "--form", "arcs"], "form 'arcs' is unknown, perhaps arc"),
        (["descent", "--curve", "parabole"], "perhaps parabola"),
        (["descent", "--methods", "verlet,yoshida4"], "none of verlet, yoshida4 fits Descent"),
        (["descent", "--curve", "x**2", "--start", "0", "--end", "1"], "ends no lower than it starts"),
        (["polar", "--z0", "0.5,0.5"], "0.5 twice"),
        (["polar", "--scores", "errors"], "score 'errors' is unknown, perhaps error"),
        (["pendulum", "--scores", "error,error"], "error twice"),
    ],
)
def test_a_mistake_is_one_sentence_and_exit_code_2(words, says, capsys):
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert says in err
