"""Splittings and Nystrom's pairs: coefficients of other public codes, the force's derivative, kernels, small kicks."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import pytest
from toys import Forced, Kepler

import compare
from compare.__main__ import main
from compare.march.autonomous import autonomous
from compare.march.equation import plain_system
from compare.march.march import fits, lacking
from compare.march.precision import precision
from compare.march.trace import random_points
from compare.methods import METHODS, find
from compare.methods.kinds.nystrom import RungeKuttaNystrom
from compare.methods.kinds.one_step import Processed
from compare.scored import score_all
from reference import Pendulum, PolarBrachistochrone
from reference.problems.families import find_family

if TYPE_CHECKING:
    from reference.problem import Problem

BINARY64, LONG = precision("float64"), precision("longdouble")


def test_the_pairs_of_nystroms_kind_are_those_of_other_public_codes() -> None:
    """GMAT's fractions of order 8, and 21 decimals of order 12, from RKNINT and in Oldenhuis's rkn1210 and in brahe."""
    eight, twelve = find("rkn86"), find("rkn1210")
    assert isinstance(eight, RungeKuttaNystrom)
    assert isinstance(twelve, RungeKuttaNystrom)
    assert eight.a[7] == tuple(
        map(
            Fraction,
            (
                "13836959/3667458", "-17731450/1833729", "1063919505/156478208", "-33213845/39119552", "13335/28544",
                "-705/14272", "1645/57088",
            ),
        )
    )  # fmt: skip
    assert eight.b[2] == Fraction(5875, 36288)
    assert eight.embedded[0].b[7:] == (Fraction(-4251941, 54970650), Fraction(3, 20))
    printed = {
        (14, 0): "-9.132967666973580820963e-1", (14, 5): "2.158970867004575600308",
        (14, 6): "3.997915583117879901153", (14, 7): "28.43415180023223189845", (14, 8): "-25.25936435494159843788",
        (14, 9): "7.733878542362237365534", (15, 0): "-2.751962972055939382061e-1", (15, 5): "14.20722645393790269429",
        (15, 6): "1.586647690678953683225", (15, 7): "2.457773532759594543903", (16, 0): "1.307639184740405758800",
        (16, 5): "9.383176308482470907879", (16, 6): "-5.228426199944542254147", (16, 7): "-48.95128052584765080401",
        (16, 8): "38.29709603433792256258", (13, 5): "-11.17283535717609792679", (8, 0): "3.651839374801129713751e-3",
    }  # fmt: skip
    for (i, j), text in printed.items():
        assert abs(twelve.a[i][j] - Fraction(text)) < abs(Fraction(text)) * Fraction(1, 10**20)


def usual(name: str) -> Problem:
    """The first problem of a family, with the time in its state where its force depends on it."""
    family = find_family(name)
    return autonomous(family.problem(**{family.comparison.varied: family.comparison.values[0]}))


SEPARABLE = [usual(name) for name in ("kepler", "henon-heiles", "toda", "outer-planets", "pleiades", "detest-e3")]


@pytest.mark.parametrize("problem", [*SEPARABLE, autonomous(Forced()), Kepler(), Pendulum(1.0)], ids=repr)
def test_the_derivative_of_the_force_is_that_of_its_jacobian(problem: Problem) -> None:
    states, parameters = random_points(problem, BINARY64, 4)
    system, count = plain_system(problem, BINARY64, parameters), problem.positions
    direction = tuple(np.random.default_rng(7).uniform(-1, 1, (count, states.shape[1])))
    rows = [row[:count] for row in system.jacobian(tuple(states))[count:]]
    expected = [sum(np.asarray(a) * d for a, d in zip(row, direction, strict=True)) for row in rows]
    found = system.force_along(tuple(states[:count]), direction)
    for value, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(value + np.zeros(states.shape[1]), other, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize(("name", "order"), [("chin4a", 4), ("rkn64", 6), ("sabac3", 4), ("processed4", 4)])
def test_forces_in_time_have_the_order(name: str, order: int) -> None:
    """The time is among the positions and drifts on, and no force changes its rate."""
    (fitted,) = score_all([Forced()], [name], n=(16, 32, 64, 128), t_end=4, precision="float128").orders
    assert fitted.cells_used >= 3
    assert abs(fitted.fitted_order - order) < 0.1


class Quartic(Kepler):
    """Kepler's potential, with a kinetic energy that is not quadratic."""

    name: ClassVar[str] = "toy quartic"

    def hamiltonian(self, m: Any, t: Any, q: Any, p: Any, c: Any) -> Any:
        square = p[0] * p[0] + p[1] * p[1]
        return super().hamiltonian(m, t, q, p, c) + square * square / 4


def test_what_turns_forces_into_velocities_is_left_out_where_these_are_not_linear() -> None:
    needing = [method for method in METHODS if method.linear_velocities_only]
    assert {"chin4a", "sabac1", "processed4", "rkn1210"} <= {method.name for method in needing}
    assert all(fits(method, Kepler()) and not fits(method, Quartic()) for method in needing)
    assert fits(find("verlet"), Quartic())
    assert lacking(find("chin4a"), Quartic()) == (
        "turns forces into velocities, which are not linear in the momenta in toy quartic"
    )
    with pytest.raises(ValueError, match="it needs positions apart from momenta"):
        compare.error_vs_n(PolarBrachistochrone(z0="1/2"), ["chin4a"], n=[64])


def test_steps_of_a_processed_method_are_steps_of_its_kernel() -> None:
    """(P K P^-1)^n = P K^n P^-1, and its work is that of the kernels, with the processors once."""
    for method in (find("processed4"), find("processed6"), find("processed764")):
        assert isinstance(method, Processed)
        _, parameters = random_points(Pendulum(1.0), LONG, 1)
        system, h = plain_system(Pendulum(1.0), LONG, parameters[:, 0]), LONG.number(Fraction(1, 10))
        y = whole = tuple(map(LONG.number, (Fraction(1), Fraction(1, 3))))
        for _ in range(5):
            whole, _ = method.step(system, whole, h)
        inner = _flowed(system, y, h, method.processor)
        for _ in range(5):
            inner = _flowed(system, inner, h, method.kernel)
        inner = _flowed(system, inner, h, tuple((kind, -weight) for kind, weight in method.processor[::-1]))
        assert all(abs(float(a - b)) < 1e-17 for a, b in zip(whole, inner, strict=True))
    assert find("processed4").evaluations(0) == (1, 6)
    assert {name: find(name).jacobians(0) for name in ("processed4", "processed6", "sabac3", "chin4b")} == {
        "processed4": 1, "processed6": 1, "sabac3": 1, "chin4b": 2,
    }  # fmt: skip
    (cell,) = compare.error_vs_n(Pendulum(1.0), ["processed4"], n=[64], t_end=1)
    assert cell.evaluations == 64 + 6


def _flowed(system: Any, y: Any, h: Any, flows: Any) -> Any:
    """Flows that need not sum to one, each by itself."""
    q, p = y[: system.positions], y[system.positions :]
    for kind, weight in flows:
        size = system.number(weight) * h
        if kind == "drift":
            q = tuple(a + size * v for a, v in zip(q, system.velocity(p), strict=True))
            continue
        pull = system.force(q)
        if kind == "gradient":
            pull, size = system.force_along(q, pull), 2 * size * h * h
        p = tuple(a + size * f for a, f in zip(p, pull, strict=True))
    return q + p


@pytest.mark.parametrize(("name", "order"), [("saba3", 6), ("sbab4", 8), ("sabac2", 4), ("aba864", 8), ("aba104", 10)])
def test_where_kicks_are_small_the_error_falls_with_the_first_generalised_order(name: str, order: int) -> None:
    """The errors of epsilon are all that is left where epsilon is 1e-40, in a format of 512 bits."""
    problem = Pendulum(theta0="1", g="1e-40", omega0="2")
    (fitted,) = score_all([problem], [name], n=(16, 32, 64, 128), t_end=4, precision="mp:512").orders
    assert abs(fitted.fitted_order - order) < 0.1


def test_what_is_shown_of_each_kind(capsys: pytest.CaptureFixture[str]) -> None:
    for name, words in {
        "chin4a": ("gradient", "1/72", "derivatives of the force along itself per step", "velocities linear in the"),
        "aba864": ("generalised order, where kicks are small", "8, 6, 4"),
        "processed4": ("processor, undone behind the kernel", "kernel", "evaluations at the start"),
        "rkn64": ("b_bar, order 4", "7873/50000", "proven embedded orders"),
    }.items():
        assert main(["show", name]) in {0, None}
        text = capsys.readouterr().out
        assert all(word in " ".join(text.split()) for word in words), text
