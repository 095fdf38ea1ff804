"""The derivatives of flows by their starts: against matrix exponentials, sensitivities and members of wide starts."""

from __future__ import annotations

import itertools
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from flint import arb, arb_mat
from test_proven_flow import RICCATI, STEPS, SYSTEMS, System

from reference.arithmetic.balls import BALL
from reference.arithmetic.precision import ctx
from reference.problems.detest.a import DetestA2
from reference.problems.detest.b import DetestB2
from reference.problems.henon_heiles import HenonHeiles
from reference.problems.lorenz import Lorenz
from reference.routes import transition, variation
from reference.routes.proven_flow import FlowSolution, ProvenFlow
from reference.routes.transition import Transition

BITS = 160


def transition_at(equation: Any, bits: int, times: list[Fraction], sign: int = 1) -> list[arb_mat]:
    carried = Transition(ProvenFlow(equation, bits, STEPS), sign)
    return [carried.at(time) for time in times]


def test_of_a_linear_equation_it_is_the_exponential_of_its_matrix() -> None:
    times = [Fraction(0), Fraction(1, 3), Fraction(5), Fraction(20)]
    with ctx.workprec(BITS):
        rates = arb_mat([[-1, 1, 0], [1, -2, 1], [0, 1, -1]])
        for time, found in zip(times, transition_at(DetestB2(), BITS, times), strict=True):
            expected = (rates * BALL.number(time)).exp()
            assert found.overlaps(expected)
            assert all(one.rel_accuracy_bits() > BITS - 40 for one in found.entries() if not one.contains(0))


@pytest.mark.parametrize("problem", [HenonHeiles(), Lorenz()], ids=repr)
def test_its_columns_are_the_sensitivities_by_the_start(problem: Any) -> None:
    """Which are proven by flows of their own, state and derivative together."""
    time, size = Fraction(3), len(problem.state_names)
    (found,) = transition_at(problem, BITS, [time])
    for j, by in enumerate(problem.state_names):
        with ctx.workprec(BITS):
            ((values),) = FlowSolution(problem.sensitivity(by)).rows("state", [time])
        for i in range(size):
            assert found[i, j].overlaps(values[size + i])
            assert found[i, j].rel_accuracy_bits() > BITS - 60


@pytest.mark.parametrize("system", SYSTEMS, ids=repr)
def test_balls_of_few_bits_hold_the_values_of_many(system: System) -> None:
    times = [system.end * k / 7 for k in range(1, 8)]
    for few, many in zip(transition_at(system, 80, times), transition_at(system, 200, times), strict=True):
        for ball, value in zip(few.entries(), many.entries(), strict=True):
            assert ball.contains(value.mid())


def test_before_the_start_it_goes_the_other_way() -> None:
    """y = 1/sqrt(1 + t), so that dy/dy(0) = (1 + t)^(-3/2)."""
    (found,) = transition_at(DetestA2(), BITS, [Fraction(-3, 4)], -1)
    with ctx.workprec(BITS):
        assert found[0, 0].contains(8)
        assert found[0, 0].rel_accuracy_bits() > BITS - 30


def outside(system: System, radius: Fraction) -> int:
    """Members of a box of starts whose derivatives are not in those that are proven of all of them."""
    wide = replace(system, radius=radius, end=system.end / 4)
    times, count = [wide.end * k / 20 for k in range(1, 21)], 0
    held = transition_at(wide, 70, times)
    with pytest.MonkeyPatch.context() as honest:
        honest.setattr(variation.Variation, "close", TRUE_CLOSE)
        honest.setattr(variation.Variation, "_defects", TRUE_DEFECTS)
        for corner in itertools.product((-1, 1), repeat=len(wide.start)):
            for balls, values in zip(held, transition_at(replace(wide, corner=corner), 120, times), strict=True):
                pairs = zip(balls.entries(), values.entries(), strict=True)
                count += sum(not ball.contains(value.mid()) for ball, value in pairs)
    return count


def of_the_polynomials_alone(self: variation.Variation, room: Any) -> None:
    TRUE_CLOSE(self, [arb(0)] * len(room))


def without_defects(self: variation.Variation, polynomials: Any) -> Any:
    return [[arb(0)] * len(row) for row in TRUE_DEFECTS(self, polynomials)]


TRUE_CLOSE, TRUE_DEFECTS = variation.Variation.close, variation.Variation._defects


@pytest.mark.parametrize("system", [*SYSTEMS, RICCATI], ids=repr)
def test_the_derivatives_at_the_corners_of_a_box_of_starts_are_inside(system: System) -> None:
    assert outside(system, Fraction(1, 2**20)) == 0


@pytest.mark.parametrize(("name", "wrong"), [("close", of_the_polynomials_alone), ("_defects", without_defects)])
def test_a_wrong_matrix_is_noticed(name: str, wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(transition.Variation, name, wrong)
    assert outside(RICCATI, Fraction(1, 2**14))
