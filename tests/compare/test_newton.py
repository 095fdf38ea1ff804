"""Newton's method for implicit steps: the elimination, the number of iterations decided before, what is reported."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest

from compare.march.equation import plain_system
from compare.march.lanes import Lane, sample_steps
from compare.march.march import march
from compare.march.precision import Precision, precision
from compare.methods import METHODS, find
from compare.methods.kinds.newton import Elimination, iterations
from reference import Pendulum

if TYPE_CHECKING:
    from compare.march.equation import BoundSystem
    from compare.methods.kinds.protocol import Method

FLOAT64 = precision("float64")
RATE = float(np.sqrt(9.81))
FAMILIES = {"implicit", "diagonally implicit"}
IMPLICIT = [method for method in METHODS if method.family in FAMILIES and method.iterations(0.1, 53)]


def pendulums(hw: float, fmt: Precision = FLOAT64, speeds: tuple[float, ...] = (0, 2, 6, 20)) -> BoundSystem:
    """The equation for many lanes with step size hw/rate, and the states and step sizes of ``lanes_of``."""
    angles, _ = lanes_of(fmt, speeds)
    ones = fmt.array([1] * len(angles))
    h = ones * fmt.number(fmt.round(Fraction(hw / RATE)))
    return plain_system(Pendulum(1.0), fmt, np.stack([h, ones * 0, ones * fmt.number(Fraction("9.81")), ones]))


def lanes_of(fmt: Precision, speeds: tuple[float, ...] = (0, 2, 6, 20)) -> tuple[np.ndarray, np.ndarray]:
    """Angles up to 3.1 rad, at rest and at speeds up to whirling."""
    angles = [Fraction(k, 20) for k in range(1, 63)]
    return fmt.array(angles * len(speeds)), fmt.array([Fraction(s) for s in speeds for _ in angles])


@pytest.mark.parametrize("method", IMPLICIT, ids=lambda method: method.name)
@pytest.mark.parametrize("hw", [1e-5, 1e-3, 0.03, 0.1, 0.3, 0.5])
def test_as_many_iterations_as_were_decided_are_enough(method: Method, hw: float) -> None:
    """At any angle and speed, and with the step that a study of 64 steps in ten seconds takes."""
    y = lanes_of(FLOAT64)
    _, changes = method.step(pendulums(hw), y, hw / RATE, method.iterations(hw, 53))
    assert np.max(np.abs(np.stack(changes)) / np.maximum(1, np.abs(np.stack(y)))) < 1000 * FLOAT64.epsilon


@pytest.mark.parametrize("name", ["implicit_midpoint", "gauss6", "radau_iia5"])
@pytest.mark.parametrize("fmt", ["float32", "float128", "mp:200"])
def test_they_are_enough_in_other_formats(name: str, fmt: str) -> None:
    wide = precision(fmt)
    lanes = [Lane(Pendulum(2.0), n, wide.round(Fraction(10, n)), sample_steps(n, 8)) for n in (32, 64, 200)]
    for result in march(find(name), lanes, wide):
        assert np.isfinite(result.max_drifts[0])


def test_fewer_iterations_than_were_decided_are_seen_in_the_last_change() -> None:
    system, method = pendulums(0.3), find("gauss4")
    _, changes = method.step(system, lanes_of(FLOAT64), 0.3 / RATE, method.iterations(0.3, 53) - 3)
    assert np.max(np.abs(np.stack(changes))) > 1e6 * FLOAT64.epsilon


@pytest.mark.parametrize("n", [16, 31])
def test_steps_are_solved_where_no_fixed_point_iteration_would(n: int) -> None:
    """h times the rate is 1 to 2."""
    lanes = [Lane(Pendulum(amplitude), n, FLOAT64.round(Fraction(10, n)), (n,)) for amplitude in (0.5, 1.0, 2.0)]
    for name in ("gauss4", "gauss6", "radau_iia5"):
        for result in march(find(name), lanes, FLOAT64):
            assert np.all(np.isfinite(result.states))


def test_iterations_grow_with_the_step_and_with_the_bits() -> None:
    assert [iterations(size, 53) for size in (1e-9, 1e-3, 0.1, 0.5, 0.85, 100.0)] == [2, 2, 4, 6, 8, 8]
    assert [iterations(0.1, bits) for bits in (24, 53, 113, 200, 1000)] == [3, 4, 5, 6, 8]


def test_an_elimination_solves_for_any_right_side_and_skips_what_is_absent() -> None:
    random = np.random.default_rng(3)
    matrix = np.eye(6) + random.uniform(-0.1, 0.1, (6, 6))
    matrix[0, 1:] = matrix[1, 3] = matrix[4, 2] = 0
    rows = [[0 if entry == 0 else Untouchable(entry) for entry in row] for row in matrix]
    elimination = Elimination(rows)
    for _ in range(2):
        right = random.uniform(-1, 1, 6)
        found = [float(value) for value in elimination.solve([Untouchable(value) for value in right])]
        np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=1e-13)


class Untouchable(float):
    """A float that refuses to be multiplied by the integer zero."""

    def __mul__(self, other: float) -> Untouchable:
        assert not isinstance(other, int)
        return Untouchable(float(self) * other)

    def __rsub__(self, other: float) -> Untouchable:
        return Untouchable(other - float(self))

    def __sub__(self, other: float) -> Untouchable:
        return Untouchable(float(self) - other)

    def __truediv__(self, other: float) -> Untouchable:
        return Untouchable(float(self) / other)

    __rmul__ = __mul__
