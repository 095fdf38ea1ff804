"""The map of a step keeps area where the method is symplectic: det J = 1 in balls, J by dual numbers."""

from __future__ import annotations

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


@pytest.mark.parametrize("method", [m for m in METHODS if isinstance(m, Splitting)], ids=lambda m: m.name)
def test_every_splitting_keeps_area_exactly(method: Splitting) -> None:
    with ctx.workprec(BITS):
        found = defect(method)
        assert found.contains(0)
        assert found.rad() < arb(2) ** -200


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
