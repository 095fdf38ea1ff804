"""The map of a step keeps area where the method is symplectic: det J = 1 in balls, J by dual numbers."""

from __future__ import annotations

import math
from typing import Any

import pytest
from flint import arb

from compare.methods import METHODS, find
from compare.methods.kinds.one_step import Method, Splitting
from compare.methods.order.algebraic import enclose
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx

BITS = 300
DUALS = DualArithmetic(BALL, 2)


class Rotor:
    """q' = p + p^3/5,  p' = -sin q in dual balls: separable, with velocities that are not linear in the momenta."""

    positions, dimension, initial_invariant = 1, 2, None

    def number(self, value: Any) -> arb:
        return enclose(value)

    def velocity(self, momenta: tuple[Any, ...]) -> tuple[Any, ...]:
        (p,) = momenta
        return (p + p * p * p / 5,)

    def force(self, positions: tuple[Any, ...]) -> tuple[Any, ...]:
        return (-DUALS.sin(positions[0]),)

    def derivative(self, y: tuple[Any, ...]) -> tuple[Any, ...]:
        return *self.velocity(y[1:]), *self.force(y[:1])

    def jacobian(self, y: tuple[Any, ...]) -> tuple[tuple[Any, ...], ...]:
        return (0, 1 + 3 * y[1] * y[1] / 5), (-DUALS.cos(y[0]), 0)


def defect(method: Method, iterations: int = 0) -> arb:
    """det J - 1 of one step of 1/8 from (1, 1/2)."""
    y = DUALS.variable(arb(1), 0), DUALS.variable(arb(1) / 2, 1)
    (q, p), _ = method.step(Rotor(), y, arb(1) / 8, iterations)
    assert isinstance(q, Dual)
    return q.slopes[0] * p.slopes[1] - q.slopes[1] * p.slopes[0] - 1


SPLITTINGS = [method for method in METHODS if isinstance(method, Splitting)]
PLAIN = [method for method in SPLITTINGS if not method.linear_velocities_only]


@pytest.mark.parametrize("method", PLAIN, ids=lambda m: m.name)
def test_every_splitting_keeps_area_exactly(method: Splitting) -> None:
    with ctx.workprec(BITS):
        found = defect(method)
        assert found.contains(0)
        assert found.rad() < arb(2) ** -200


FOUR = DualArithmetic(BALL, 4)


class Coupled:
    """q' = A p,  p' = -grad V,  V = x y^2 + sin(x) y, in dual balls: two degrees of freedom, A not diagonal."""

    positions, dimension, initial_invariant = 2, 4, None

    def number(self, value: Any) -> arb:
        return enclose(value)

    def velocity(self, momenta: tuple[Any, ...]) -> tuple[Any, ...]:
        a, b = momenta
        return a + b / 2, a / 2 + b * 2

    def force(self, positions: tuple[Any, ...], m: Any = FOUR) -> tuple[Any, ...]:
        x, y = positions
        return -(y * y + m.cos(x) * y), -(x * y * 2 + m.sin(x))

    def force_along(self, positions: tuple[Any, ...], direction: tuple[Any, ...]) -> tuple[Any, ...]:
        moving = tuple(Dual(q, (slope,)) for q, slope in zip(positions, direction, strict=True))
        return tuple(rate.slopes[0] for rate in self.force(moving, DualArithmetic(FOUR, 1)))


def largest_defect(method: Method) -> arb:
    """The largest entry of S' W S - W, S of one step of 1/8."""
    start = [arb(value) / 4 for value in (3, -2, 1, 5)]
    y, _ = method.step(Coupled(), tuple(FOUR.variable(value, i) for i, value in enumerate(start)), arb(1) / 8)
    s = [component.slopes for component in y]
    pairs = [(i, j) for i in range(4) for j in range(i)]
    found = [sum(s[k][i] * s[k + 2][j] - s[k + 2][i] * s[k][j] for k in range(2)) + int(i - j == 2) for i, j in pairs]
    return max((abs(value) for value in found), key=lambda value: float(value.upper()))


GRADIENTS = [method for method in SPLITTINGS if method.linear_velocities_only]


@pytest.mark.parametrize("method", [find("verlet"), find("processed764"), *GRADIENTS], ids=lambda m: m.name)
def test_the_gradient_of_the_squared_force_is_a_symplectic_flow(method: Splitting) -> None:
    with ctx.workprec(BITS):
        assert largest_defect(method) < arb(2) ** -200


TURNED = "compare.methods.kinds.one_step.turned"


def test_a_derivative_along_what_no_symmetric_matrix_makes_of_the_force_is_not_symplectic(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(TURNED, lambda _, force: (force[1], -force[0]))
    with ctx.workprec(BITS):
        assert largest_defect(find("chin4a")) > arb(2) ** -30


def order_of_a_step(method: Method) -> float:
    """By how a step of h and two of its half differ, with h = 1/32 and 1/64."""
    gaps = []
    for h in (arb(1) / 32, arb(1) / 64):
        y = tuple(arb(value) / 4 for value in (3, -2, 1, 5))
        system: Any = Masses()
        whole, _ = method.step(system, y, h)
        half, _ = method.step(system, method.step(system, y, h / 2)[0], h / 2)
        gaps.append(max(abs(float(a - b)) for a, b in zip(whole, half, strict=True)))
    return math.log2(gaps[0] / gaps[1]) - 1


class Masses(Coupled):
    """The same in balls."""

    def force(self, positions: tuple[Any, ...], m: Any = BALL) -> tuple[Any, ...]:
        return super().force(positions, m)

    def force_along(self, positions: tuple[Any, ...], direction: tuple[Any, ...]) -> tuple[Any, ...]:
        moving = tuple(Dual(q, (slope,)) for q, slope in zip(positions, direction, strict=True))
        return tuple(rate.slopes[0] for rate in self.force(moving, DualArithmetic(BALL, 1)))


@pytest.mark.parametrize(("name", "order"), [("chin4a", 4), ("sabac2", 4), ("omelyan6_gp5", 6), ("rkn64", 6)])
def test_masses_turn_the_forces_into_velocities(name: str, order: int, monkeypatch: pytest.MonkeyPatch) -> None:
    with ctx.workprec(BITS):
        assert abs(order_of_a_step(find(name)) - order) < 0.1
        for home in (TURNED, "compare.methods.kinds.nystrom.turned"):
            monkeypatch.setattr(home, lambda _, force: force)
        assert order_of_a_step(find(name)) < 2.5


@pytest.mark.parametrize("name", ["rkn43", "rkn86"])
def test_an_explicit_nystrom_pair_is_not_symplectic(name: str) -> None:
    assert not find(name).symplectic
    with ctx.workprec(BITS):
        assert largest_defect(find(name)) > arb(2) ** -60


@pytest.mark.parametrize("name", ["implicit_midpoint", "gauss4", "gauss6", "lobatto_pair4"])
def test_every_symplectic_tableau_keeps_area(name: str) -> None:
    assert find(name).symplectic
    with ctx.workprec(BITS):
        assert abs(defect(find(name), iterations=9)) < arb(2) ** -200


@pytest.mark.parametrize("name", ["euler", "rk4", "dop853", "butcher6", "implicit_euler", "trapezoid", "radau5"])
def test_a_method_that_is_not_symplectic_does_not(name: str) -> None:
    assert not find(name).symplectic
    with ctx.workprec(BITS):
        assert abs(defect(find(name), iterations=9)) > arb(2) ** -60
