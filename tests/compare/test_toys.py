"""Problems that no line of ours names: through studies, scores, checks, files, solvers and reports."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from toys import FORCED, KEPLER, Forced, Kepler, independent_kepler

import compare
from compare.__main__ import main
from compare.files.score import score
from compare.march.lanes import StartInvariant, initial_invariants
from compare.march.precision import precision
from compare.measure.truth import Course
from compare.report.run import plan, run
from compare.scored import score_all
from compare.study import study
from reference import load
from reference.__main__ import main as reference_main
from reference.dataset.build import build
from reference.dataset.catalogue import plan as dataset_plan
from reference.dataset.verify import verify
from reference.problem import HamiltonianProblem

TOYS = Path(__file__).parents[1] / "toys.py"
FLOAT64 = precision("float64")
EVERY_SCORE = ("error", "norms", "drift", "phase", "growth", "period", "defects")


def test_the_closed_form_is_keplers_ellipse() -> None:
    for t in (0.5, 1.0, 7.25):
        found = [sum(map(Fraction, limbs)) for limbs in Kepler().state(t, limbs=3)[:2].tolist()]
        for value, other in zip(found, independent_kepler(2.0, t), strict=True):
            assert abs(value - other) < Fraction(1, 10**45)


def test_an_error_in_the_second_position_counts() -> None:
    course = Course(Kepler(), 256, Fraction(8), FLOAT64)
    off = course.truth[:, :, 0] + np.array([0.0, 0.25, 0.0, 0.0])
    assert np.max(course.position_error(course.errors(off))) == pytest.approx(0.25)
    (cell,) = compare.error_vs_n(Kepler(), ["euler"], n=[256], t_end=8)
    assert cell.max_error > 0.5


def test_defects_are_those_that_a_check_finds() -> None:
    scored = score_all([Kepler()], ["verlet", "rk4"], n=[512], t_end=8, scores=["defects"])
    verlet, rk4 = scored.found["defects"]
    assert verlet.symplecticity < 1e-14
    assert verlet.reversibility < 1e-11
    assert 1e-12 < rk4.symplecticity < 1e-6

    def leapfrog(q: Any, p: Any, force: Any, h: float) -> tuple[Any, Any]:
        half = p + h / 2 * force(q)
        moved = q + h * half
        return moved, half + h / 2 * force(moved)

    found = compare.check(leapfrog, order=2, symplectic=True, reversible=True, problem=Kepler())
    assert found.claims_hold
    assert found.symplecticity.size < 1e-13
    assert found.reversibility.size < 1e-11


def test_the_drift_of_a_negative_energy_is_positive_and_scaled_by_its_size() -> None:
    drifts = compare.energy_drift(Kepler(), ["euler", "rk4"], n=[512], t_end=8)
    assert [drift.invariant for drift in drifts] == ["energy", "angular momentum"] * 2
    assert all(drift.max_drift_above_rest > 0 for drift in drifts)
    states = Course(Kepler(), 512, Fraction(8), FLOAT64)
    gained = states.drifts(states.truth[:, :, 0] * np.array([1.0, 1.0, 1.5, 1.5]))
    assert np.all(gained[0] > 0)  # more kinetic energy is more energy


def test_an_initial_energy_that_is_a_double_is_exact() -> None:
    """sqrt(x^2 + y^2) of 2/5 is no exact ball, so that no precision would tell -1/2 from its neighbours."""
    assert StartInvariant(Kepler()).exact() == Fraction(-1, 2)
    assert initial_invariants(Kepler(), FLOAT64)[0] == -0.5


def test_the_phase_is_said_not_to_be_defined(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([f"{TOYS}:KEPLER", "--n", "128", "--methods", "rk4", "--scores", "phase"]) == 0
    shown = capsys.readouterr().out
    assert "Phase, v = 2.0: Phase and amplitude are not defined for the problem toy kepler" in shown


@pytest.mark.parametrize("problem", [Kepler(), Forced()], ids=repr)
def test_every_method_that_fits_has_its_order(problem: Kepler | Forced) -> None:
    methods = ["rk4", "gauss4", "verlet", "yoshida4", "bdf2", "taylor8"]
    scored = score_all([problem], methods, n=[512, 1024, 2048, 4096], t_end=8)
    for fit in scored.orders:
        if fit.fitted_order is not None:
            assert fit.fitted_order == pytest.approx(fit.declared_order, abs=0.2)
    assert sum(fit.fitted_order is not None for fit in scored.orders) >= 4


def test_a_kick_sees_the_time_that_its_drifts_have_come_to() -> None:
    """Verlet by hand, the force at the times t and t + h."""
    h, q, p = 1 / 64, 1.0, 0.0
    for n in range(64):
        half = p + h / 2 * (-q + 2 * math.cos(0.625 * n * h))
        q += h * half
        p = half + h / 2 * (-q + 2 * math.cos(0.625 * (n + 1) * h))
    (cell,) = compare.error_vs_n(Forced(), ["verlet"], n=[64], t_end=1)
    assert cell.end_error == pytest.approx(abs(q - Forced().state(1)[0]), rel=1e-9)


def test_what_needs_second_order_or_an_invariant_is_left_out_and_named() -> None:
    found = study(FORCED, n=[64, 128], methods=["rk4", "stormer4", "avf"], scores=EVERY_SCORE)
    assert "stormer4" in found.engine["left out"]
    assert set(found.engine["lacking"]["angle = 1.0 rad"]) == {"drift", "phase", "period"}
    assert found.energy_drift == ()


@pytest.mark.parametrize("family", ["KEPLER", "FORCED"])
@pytest.mark.parametrize("form", ["text", "json", "csv", "markdown", "latex"])
def test_a_study_of_its_own_command(family: str, form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [f"{TOYS}:{family}", "--n", "128,256", "--methods", "rk4,verlet", "--scores", ",".join(EVERY_SCORE)]
    assert main([*words, "--format", form, "--out", str(tmp_path / "out"), "--quiet"]) == 0
    shown = capsys.readouterr().out
    assert "rk4" in shown
    if form == "json":
        tables = json.loads(shown)["tables"]
        assert {row["method"] for row in tables["error_vs_n"]} == {"rk4", "verlet"}


def test_figures_of_two_invariants(tmp_path: Path) -> None:
    words = [f"{TOYS}:KEPLER", "--n", "128,256", "--methods", "rk4,verlet", "--plots", "--quiet"]
    assert main([*words, "--out", str(tmp_path / "out")]) == 0
    drawn = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"toy-kepler-energy-drift.png", "toy-kepler-angular-momentum-drift.png"} <= drawn


def test_solvers(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--solvers", "scipy.DOP853,heyoka.taylor", "--rtol", "1e-6,1e-9", "--t-end", "3", "--format", "json"]
    for name in ("KEPLER", "FORCED"):
        assert main(["solvers", "--problem", f"{TOYS}:{name}", *words]) == 0
        rows = json.loads(capsys.readouterr().out)["tables"]["error_vs_rtol"]
        assert len(rows) == 4
        assert all(0 < row["max_error"] < 1e-4 for row in rows)


@pytest.mark.parametrize(
    ("name", "problem", "words"), [("KEPLER", Kepler(), ["--v", "2"]), ("FORCED", Forced(), ["--angle", "1"])]
)
def test_a_file_is_scored(
    name: str, problem: Any, words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    times = [0.5, 1.0, 2.0]
    states = problem.state(times)
    states[1, 1] += 1e-3
    lines = [
        ",".join(("t", *problem.state_names)),
        *(",".join(map(repr, (t, *y))) for t, y in zip(times, states.tolist(), strict=True)),
    ]
    path = tmp_path / "mine.csv"
    path.write_text("\n".join(lines) + "\n")
    assert main(["score", str(path), "--problem", f"{TOYS}:{name}", *words, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["max_error"] == pytest.approx(1e-3, rel=1e-6)
    assert any("No energy error is defined" in note for note in found["notes"]) == (not problem.invariants)
    assert score(problem, times, states).max_error == pytest.approx(1e-3, rel=1e-6)


def test_a_report(tmp_path: Path) -> None:
    wanted = plan(
        [f"{TOYS}:KEPLER", f"{TOYS}:FORCED"],
        methods=["rk4", "verlet"],
        solvers=["scipy.DOP853"],
        n=[128, 256],
        rtol=[1e-6],
    )
    found = run(wanted, tmp_path / "report")
    assert not [point for point in found.points if point.failure]
    assert "toy-kepler" in (tmp_path / "report" / "report.md").read_text()


def test_a_family_is_not_told_by_its_name() -> None:
    other = replace(KEPLER, name="other", comparison=replace(KEPLER.comparison, command="other"))
    assert study(other, n=[64], methods=["rk4"]).error_vs_n == study(KEPLER, n=[64], methods=["rk4"]).error_vs_n


@compare.method(order=4)
def classic(f: Any, y: Any, h: Any) -> Any:
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def test_a_step_function_of_the_users_own_is_the_method_that_it_is() -> None:
    mine, rk4 = compare.error_vs_n(Kepler(), [classic, "rk4"], n=[512], t_end=8)
    assert (mine.method, mine.evaluations) == ("classic", rk4.evaluations)
    assert mine.max_error == pytest.approx(rk4.max_error, rel=1e-6)
    found = study("pendulum", n=[256, 512, 1024, 2048], methods=[classic])
    assert found.order[0].fitted_order == pytest.approx(4, abs=0.1)


@pytest.mark.parametrize(
    ("methods", "sentence"),
    [
        ([lambda f, y, h: y + h * f(y)], "compare.method"),
        ([classic, compare.method(order=2, name="classic")(lambda f, y, h: y + h * f(y))], "two of the name classic"),
        ([3], "method '3' is unknown"),
    ],
)
def test_what_is_no_method_is_refused_in_one_sentence(methods: list[Any], sentence: str) -> None:
    with pytest.raises((TypeError, ValueError), match=sentence):
        compare.error_vs_n(Kepler(), methods, n=[64])


def test_a_step_function_in_another_precision_is_refused() -> None:
    with pytest.raises(ValueError, match="precision float64 is accepted"):
        compare.error_vs_n(Kepler(), [classic], n=[64], precision="float32")


def test_a_step_whose_path_depends_on_its_values_takes_the_path_that_it_says() -> None:
    @compare.method(order=1)
    def hasty(f: Any, y: Any, h: Any) -> Any:
        return y + h * f(y) if np.all(y[0] > 0.6) else y + 2 * h * f(y)

    @compare.method(order=1)
    def steady(f: Any, y: Any, h: Any) -> Any:
        return y + h * f(y) * (1 + (y[0] <= 0.6))

    found = compare.error_vs_n(Kepler(), [hasty, steady], n=[64], t_end=1)
    assert found[0].max_error == found[1].max_error > 0


def test_a_dataset_of_both_is_built_and_verified(tmp_path: Path) -> None:
    families = [f"{TOYS}:KEPLER", f"{TOYS}:FORCED"]
    out = tmp_path / "toys.h5"
    build(dataset_plan("core", families=families), out)
    assert all(proof.holds for proof in verify(out, families=families))
    found = load(out, families=families)
    for i, v in enumerate((1.75, 2.0)):
        for k, t in enumerate((0.5, 1.0, 7.25)):
            x, y = independent_kepler(v, t)
            for name, other in (("x", x), ("y", y)):
                stored = found[f"toy/kepler/{name}"]
                limbs = [stored.value[i, k], *stored.tail[i, k]]
                assert abs(sum(map(Fraction, map(float, limbs))) - other) < Fraction(1, 10**45)


def test_values_at_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--v", "2", "--t", "7.25", "--digits", "30", "--exact", "--format", "json"]
    assert reference_main(["at", f"{TOYS}:KEPLER", *words]) == 0
    x, y = independent_kepler(2.0, 7.25)
    found = json.loads(capsys.readouterr().out)
    assert abs(Fraction(found["x"]) - x) < Fraction(1, 10**29)
    assert abs(Fraction(found["y"]) - y) < Fraction(1, 10**29)


def test_an_equation_that_hides_its_time_is_refused() -> None:
    class Hidden(Forced):
        autonomous = True

    with pytest.raises(ValueError, match="autonomous = False is accepted"):
        compare.error_vs_n(Hidden(), ["rk4"], n=[64])


def test_a_hamiltonian_with_the_time_in_it_splits() -> None:
    class Driven(HamiltonianProblem):
        """H = p^2/2 + angle^2/2 - strength cos(nu t) angle: the forced oscillator once more."""

        name, rows, trial, invariants, autonomous = "driven", Forced.rows, Forced.trial, (), False
        space = replace(Forced.space, velocities=(), momenta=("rate",))
        parameters, start, inputs = Forced().parameters, Forced().start, Forced().inputs

        def hamiltonian(self, m: Any, t: Any, q: Any, p: Any, c: Any) -> Any:
            return p[0] * p[0] / 2 + q[0] * q[0] / 2 - c["strength"] * m.cos(c["nu"] * t) * q[0]

        def neighbour(self, rounding: Any, epsilon: Any) -> Any:
            return Forced().neighbour(rounding, epsilon)

        def closed_form(self, m: Any) -> Any:
            return Forced().closed_form(m)

    assert Driven().positions == 1
    for name in ("verlet", "rk4", "yoshida4", "gauss4", "bdf2"):
        (mine,), (other,) = (compare.error_vs_n(one, [name], n=[64], t_end=2) for one in (Driven(), Forced()))
        assert mine.max_error == pytest.approx(other.max_error, rel=1e-9)
