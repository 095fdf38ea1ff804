"""The worked example of docs/own-problem.md: one file from an equation to a scored table."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import pytest

import compare
from compare.__main__ import main
from compare.study import study
from reference.__main__ import main as reference_main
from reference.problems.families import find_family

FILE = Path(__file__).parents[1] / "docs" / "duffing.py"
DUFFING = find_family(f"{FILE}:FAMILY")


@pytest.mark.parametrize("a", [0.125, 1.0, 3.5])
@pytest.mark.parametrize("t", [0.25, 2.5, 40.0])
def test_the_state_is_jacobis_cn_by_mpmath(a: float, t: float) -> None:
    with mpmath.workdps(80):
        w = mpmath.sqrt(1 + mpmath.mpf(a) ** 2)
        m = mpmath.mpf(a) ** 2 / (2 * w**2)
        other = Fraction(mpmath.nstr(a * mpmath.ellipfun("cn", w * t, m=m), 70))
    found = sum(map(Fraction, DUFFING.problem(a).state(t, limbs=3)[0].tolist()))
    assert abs(found - other) <= abs(other) * Fraction(1, 10**45)


def test_the_period_is_an_integral() -> None:
    """4 int_0^a dx/sqrt(H(a) - V(x)) without its singularity: x = a sin s."""
    with mpmath.workdps(60):
        a = mpmath.mpf(1)
        other = 4 * mpmath.quad(lambda s: 1 / mpmath.sqrt(1 + a**2 * (1 + mpmath.sin(s) ** 2) / 2), [0, mpmath.pi / 2])
        assert DUFFING.problem(1).certified("period").digits(40) == mpmath.nstr(other, 40)


def test_the_table_has_the_orders() -> None:
    found = study(DUFFING, n=[256, 512, 1024, 2048], methods=["verlet", "rk4", "gauss4", "yoshida4"])
    for fit in found.order:
        assert fit.fitted_order == pytest.approx(fit.declared_order, abs=0.1)


def test_every_command_of_the_page(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([f"{FILE}:FAMILY", "--a", "1,2", "--n", "128", "--methods", "rk4,verlet", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"]["a"] == [1.0, 2.0]
    words = ["--a", "1", "--rtol", "1e-6", "--solvers", "scipy.DOP853", "--format", "json"]
    assert main(["solvers", "--problem", f"{FILE}:FAMILY", *words]) == 0
    (row,) = json.loads(capsys.readouterr().out)["tables"]["error_vs_rtol"]
    assert row["max_error"] < 1e-4


def test_a_dataset_of_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "duffing.h5"
    assert reference_main(["build", "--family", f"{FILE}:FAMILY", "--out", str(path), "--jobs", "1", "--quiet"]) == 0
    assert reference_main(["verify", str(path), "--family", f"{FILE}:FAMILY", "--jobs", "1"]) == 0
    assert "3 of 3 variables proven." in capsys.readouterr().out


def test_a_check_on_it() -> None:
    def leapfrog(q: Any, p: Any, force: Any, h: float) -> tuple[Any, Any]:
        half = p + h / 2 * force(q)
        moved = q + h * half
        return moved, half + h / 2 * force(moved)

    found = compare.check(leapfrog, order=2, symplectic=True, reversible=True, problem=DUFFING.problem(1))
    assert found.claims_hold
