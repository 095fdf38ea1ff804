"""Implicit, Rosenbrock and extrapolation methods against other codes: coefficients, and steps taken without ours."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.optimize import fsolve

from compare.methods import METHODS, find
from compare.methods.kinds import fixed_point
from compare.methods.kinds.one_step import Tableau
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.order.algebraic import enclose
from compare.methods.order.collocation import Collocation, legendre
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

SUNDIALS = {
    # name: a row, its entries, and the embedded weights
    "kvaerno32": (
        3,
        """0.3088099699767465233481624698867005109200 1.490563388421780570628467958466544690231
        -1.235239879906986093392649879546802043680 0.4358665215084589994160194511935568425293""",
        """0.4905633884217805706284679584665446902307 0.07357009006976042995551259033989846723997
        0.4358665215084589994160194511935568425293 0""",
    ),
    "kvaerno54": (
        6,
        """0.1365975117764029144062783844146127033921 0 -0.05496908796538376712487773114648630009105
        -0.04118626728321046868299776958296295741592 0.6299330489901640319161060392667246534806
        0.06962479448202728948549107704811190063421 0.26""",
        """0.1385564023126822495054973091161581456582 0 -0.04245337201752043098884399725982168512523
        0.02446657898003141965963581513879101305561 0.6194303907248067618237108730048725264114 0.26 0""",
    ),
    "kencarp32": (
        3,
        """0.1876410243467238251612921441668043913795 -0.5952974735769549480478230275858851737782
        0.9717899277217721234705114322255239398694 0.4358665215084589994160194511935568425293""",
        """0.2147402862233891404862383406484193714659 -0.4851622638849390928209050808398155895845
        0.86872500252038755116621237682951240796 0.4016969751411624011684543633618838101586""",
    ),
    "kencarp54": (
        7,
        """-872700587467/9133579230613 0 0 22348218063261/9555858737531 -1143369518992/8141816002931
        -39379526789629/19018526304540 32727382324388/42900044865799 41/200""",
        """-975461918565/9796059967033 0 0 78070527104295/32432590147079 -548382580838/3424219808633
        -33438840321285/15594753105479 3629800801594/4656183773603 4035322873751/18575991585200""",
    ),
}
"""SUNDIALS 7, arkode_butcher_dirk.def: 40 digits, or the fractions of Kennedy and Carpenter."""

AS_PRINTED = {"kencarp32": 1e-24, "kencarp54": 1e-23}
"""What fractions of 13 digits leave; the others are given to 40 places."""

REBOUND_NODES = (
    "0 0.0562625605369221464656521910318 0.180240691736892364987579942780 0.352624717113169637373907769648 "
    "0.547153626330555383001448554766 0.734210177215410531523210605558 0.885320946839095768090359771030 "
    "0.977520613561287501891174488626"
)
REBOUND_WEIGHTS = (
    "0.03125 0.185358154802979278540728972807180754479812609 0.304130620646785128975743291458180383736715043 "
    "0.376517545389118556572129261157225608762708603 0.391572167452493593082499533303669362149363727 "
    "0.347014795634501068709955597003528601733139176 0.249647901329864963257869294715235590174262844 "
    "0.114508814744257199342353731044292225247093225"
)
"""integrator_ias15.c of REBOUND: the nodes, and the weights on an interval of length 2."""

TRANSFORMED = {
    # as other codes hold them: MatMol for ROS3P, KPP for Rodas3, at the places of a, c and m in turn
    "ros3p": "1.267949192431123 1.267949192431123 0 -1.607695154586736 -3.464101615137755 -1.732050807568877 "
    "2 0.5773502691896258 0.4226497308103742",
    "rodas3": "0 2 0 2 0 1 4 1 -1 1 -1 -2.6666666666666667 2 0 1 1",
}


def numbers(text: str) -> list[Fraction]:
    return [Fraction(word) for word in text.split()]


def gap(values: Sequence[Any], others: Sequence[Fraction]) -> float:
    """The largest difference."""
    assert len(values) == len(others)
    with ctx.workprec(300):
        pairs = zip(values, others, strict=True)
        return max(float(abs(enclose(value) - enclose(other)).upper()) for value, other in pairs)


@pytest.mark.parametrize("name", SUNDIALS)
def test_weights_are_those_of_sundials(name: str) -> None:
    row, weights, embedded = SUNDIALS[name]
    method, allowed = find(name), AS_PRINTED.get(name, 2e-38)
    assert gap(method.matrix[row], numbers(weights)) < allowed
    assert gap(method.b, numbers(weights)) < allowed
    assert gap(method.embedded[0].b, numbers(embedded)) < allowed


def test_nodes_and_weights_are_those_of_rebound() -> None:
    """Its nodes are right to 26 places; of its weights the sixth is wrong from the 16th, and their sum misses 2."""
    method = find("ias15")
    assert gap(method.c, numbers(REBOUND_NODES)) < 2e-26
    weights = numbers(REBOUND_WEIGHTS)
    missing = 2 - sum(weights)
    assert float(missing) == pytest.approx(2.115e-16, rel=1e-3)
    weights[5] += missing
    assert gap(method.b, [weight / 2 for weight in weights]) < 2e-26


def test_gauss_is_numpys_quadrature() -> None:
    for name, degree in (("gauss8", 4), ("gauss10", 5)):
        nodes, weights = np.polynomial.legendre.leggauss(degree)
        method = find(name)
        assert gap(method.c, [Fraction(float(x)) for x in (1 + nodes) / 2]) < 1e-15
        assert gap(method.b, [Fraction(float(w)) for w in weights / 2]) < 1e-15


@pytest.mark.parametrize("name", TRANSFORMED)
def test_rosenbrock_methods_are_held_as_other_codes_hold_them(name: str) -> None:
    method = find(name)
    held = [value for row in (*method.a, *method.c, method.m) for value in row]
    assert gap(held, numbers(TRANSFORMED[name])) < 1e-14


def test_a_rational_node_is_exact() -> None:
    assert find("gauss10").c[2] == Fraction(1, 2)
    assert find("radau15").c[0] == 0
    assert find("radau15").matrix[0] == (0,) * 8
    rows, weights = Collocation("gauss4", legendre(2)).table()
    gauss4 = find("gauss4")
    assert gap([*rows[0], *rows[1], *weights], [*gauss4.matrix[0], *gauss4.matrix[1], *gauss4.b]) < 1e-80


STARTS = ((1.0, 0.3, 0.2), (2.5, -1.0, 1.1))
H = 0.05


def pendulum_driven(y: np.ndarray) -> np.ndarray:
    """y = (q, p, t): an equation that depends on the time."""
    q, p, t = y
    return np.array([p, -np.sin(q) - 0.3 * p * p * q + np.cos(2 * t), 1.0])


def jacobian(y: np.ndarray) -> np.ndarray:
    q, p, t = y
    return np.array([[0, 1, 0], [-np.cos(q) - 0.3 * p * p, -0.6 * p * q, -2 * np.sin(2 * t)], [0, 0, 0]], dtype=float)


class Plain:
    """The equation as a method asks for it, in doubles."""

    dimension, positions, clock, tiny, time, initial_invariant = 3, 0, None, 1e-300, 0.0, 0.0

    def __init__(self) -> None:
        self.asked = {"derivative": 0, "jacobian": 0}

    def number(self, value: Any) -> float:
        return float(enclose(value))

    def derivative(self, y: Sequence[Any]) -> tuple[Any, ...]:
        self.asked["derivative"] += 1
        return tuple(pendulum_driven(np.array(y)))

    def jacobian(self, y: Sequence[Any]) -> tuple[tuple[Any, ...], ...]:
        self.asked["jacobian"] += 1
        return tuple(tuple(value or 0 for value in row) for row in jacobian(np.array(y)))


def stages_by_scipy(method: Tableau, y: np.ndarray, h: float) -> np.ndarray:
    """The step with its stages solved by another Newton's method."""
    a = np.array([[float(enclose(entry)) for entry in row] for row in method.matrix])
    b = np.array([float(enclose(weight)) for weight in method.b])

    def residual(flat: np.ndarray) -> np.ndarray:
        slopes = flat.reshape(len(b), len(y))
        return (np.array([pendulum_driven(y + h * row @ slopes) for row in a]) - slopes).ravel()

    found = fsolve(residual, np.tile(pendulum_driven(y), len(b)), xtol=1e-15)
    return y + h * b @ found.reshape(len(b), len(y))


@pytest.mark.parametrize(
    "method",
    [m for m in METHODS if isinstance(m, Tableau) and not m.explicit],
    ids=lambda method: method.name,
)
def test_implicit_steps_are_those_of_another_solver_of_their_stages(method: Tableau) -> None:
    for start in STARTS:
        system: Any = Plain()
        iterations = method.iterations(H * 2, 53)
        y, changes = method.step(system, start, H, iterations)
        assert np.max(np.abs(np.array(y) - stages_by_scipy(method, np.array(start), H))) < 2e-14
        assert np.max(np.abs(changes)) < 1e-14
        assert system.asked == {
            "derivative": method.evaluations(iterations)[0],
            "jacobian": method.jacobians(iterations),
        }


def rosenbrock_in_its_slopes(method: Rosenbrock, y: np.ndarray, h: float, time_apart: bool) -> np.ndarray:
    """Hairer and Wanner's (7.4), with the time in the state, and (7.4a), with the derivative by the time."""
    size = method.stages
    gamma = float(enclose(method.gamma))
    full = np.zeros((size, size))
    a = np.zeros((size, size))
    for i, j in product(range(size), range(size)):
        if j < i:
            full[i, j], a[i, j] = -float(enclose(method.c[i][j])), float(enclose(method.a[i][j]))
    gammas = np.linalg.inv(full + np.eye(size) / gamma)
    alpha, b = a @ gammas, np.array([float(enclose(m)) for m in method.m]) @ gammas
    jac = jacobian(y)
    slopes = np.zeros((size, len(y)))
    for i in range(size):
        if not time_apart:
            right = pendulum_driven(y + h * alpha[i] @ slopes) + h * jac @ (gammas[i, :i] @ slopes[:i])
            slopes[i] = np.linalg.solve(np.eye(len(y)) - h * gamma * jac, right)
            continue
        state, stage_time = y[:2] + h * alpha[i] @ slopes[:, :2], y[2] + h * alpha[i].sum()
        inner, by_time = jac[:2, :2], jac[:2, 2]
        right = pendulum_driven(np.array([*state, stage_time]))[:2]
        right = right + h * inner @ (gammas[i, :i] @ slopes[:i, :2]) + h * gammas[i].sum() * by_time
        slopes[i] = [*np.linalg.solve(np.eye(2) - h * gamma * inner, right), 1.0]
    return y + h * b @ slopes


@pytest.mark.parametrize("method", [m for m in METHODS if isinstance(m, Rosenbrock)], ids=lambda method: method.name)
@pytest.mark.parametrize("time_apart", [False, True])
def test_rosenbrock_steps_are_those_of_both_forms_of_the_textbook(method: Rosenbrock, time_apart: bool) -> None:
    for start in STARTS:
        system: Any = Plain()
        y, changes = method.step(system, start, H)
        assert not changes
        assert np.max(np.abs(np.array(y) - rosenbrock_in_its_slopes(method, np.array(start), H, time_apart))) < 1e-13
        assert system.asked == {"derivative": method.evaluations(0)[0], "jacobian": 1}


def gragg_bulirsch_stoer(
    f: Callable[[np.ndarray], np.ndarray], y: np.ndarray, size: float, sequence: Sequence[int]
) -> list[list[np.ndarray]]:
    """The scheme, its rows by the recurrences themselves."""
    rows: list[list[np.ndarray]] = []
    for k, steps in enumerate(sequence):
        h = size / steps
        before, now = y, y + h * f(y)
        for _ in range(steps - 1):
            before, now = now, before + 2 * h * f(now)
        row = [(before + 2 * now + before + 2 * h * f(now)) / 4]
        for j in range(1, k + 1):
            row.append(row[-1] + (row[-1] - rows[-1][j - 1]) / ((steps / sequence[k - j]) ** 2 - 1))
        rows.append(row)
    return rows


@pytest.mark.parametrize(
    ("name", "sequence"),
    [("gbs4", (2, 4)), ("gbs6", (2, 4, 6)), ("gbs8", (2, 4, 6, 8)), ("gbs10", (2, 4, 6, 8, 10)),
     ("gbs10_bulirsch", (2, 4, 6, 8, 12))],
)  # fmt: skip
def test_an_extrapolated_step_is_that_of_its_scheme(name: str, sequence: tuple[int, ...]) -> None:
    method, size = find(name), 0.3
    for start in STARTS:
        system: Any = Plain()
        y, _ = method.step(system, start, size)
        last = gragg_bulirsch_stoer(pendulum_driven, np.array(start), size, sequence)[-1]
        assert np.max(np.abs(np.array(y) - last[-1])) < 1e-14
        slopes: list[Any] = []
        for row in method.matrix:
            state = np.array(start) + size * sum(float(a) * k for a, k in zip(row, slopes, strict=False))
            slopes.append(pendulum_driven(state))
        estimate = np.array(start) + size * sum(float(b) * k for b, k in zip(method.embedded[0].b, slopes, strict=True))
        assert np.max(np.abs(estimate - last[-2])) < 1e-14
        assert method.evaluations(0)[0] == system.asked["derivative"] == 1 + sum(sequence)


def test_the_first_stage_of_radau15_is_evaluated_once_and_no_jacobian_is() -> None:
    method = find("radau15")
    assert method.jacobians(9) == 0
    assert method.evaluations(9) == (1 + 7 * 9, 0)


def test_sweeps_grow_with_the_step_and_with_the_bits_and_end_somewhere() -> None:
    matrix = find("radau15").matrix
    counts = [fixed_point.iterations_of(matrix, size, 53) for size in (1e-6, 1e-2, 0.1, 1.0, 5.0, 1e9)]
    assert counts == sorted(counts)
    assert counts[-1] < 60
    assert [fixed_point.iterations_of(matrix, 0.1, bits) for bits in (24, 53, 113)] == [6, 10, 19]
