"""Every family with a closed form is proven by its flow as well: the balls of both overlap.

The flow reads the equation of motion and the start, the closed form neither of them.

Three forms are singular where they start: the curves dx/dy and dphi/dz are vertical there, with a square root in the
depth, so that no step leads away.  Their flows start from the balls of the closed form at a depth below.  Series of
the pendulum, which are errors of expansions and have no equation, are no motions, and are not here.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest

from reference import (
    Cycloid,
    CycloidalPendulum,
    CycloidArc,
    Descent,
    LinearPendulum,
    Pendulum,
    PolarBrachistochrone,
    Tautochrone,
    Tunnel,
)
from reference.arithmetic.balls import BALL
from reference.arithmetic.precision import ctx
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.families import FAMILIES, find_family
from reference.problems.polar.paths import PolarByPsi, PolarByZ
from reference.routes.proven_flow import ProvenFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

    from flint import arb

    from reference import Problem

BITS, STEPS = 200, 1000
FORTY_DIGITS = 133
"""In bits."""
SOON = (Fraction(1, 8), Fraction(1, 3), Fraction(1))
BOTH_SIDES = (Fraction(-7, 2), Fraction(-1, 4), *SOON, Fraction(5))
MOTIONS: tuple[tuple[Problem, tuple[Fraction, ...]], ...] = (
    (Pendulum(1.0), BOTH_SIDES),
    (Pendulum("3.14159"), BOTH_SIDES),
    (Pendulum(0.5, omega0=-1), BOTH_SIDES),
    (Pendulum(0, omega0=7), BOTH_SIDES),
    (Pendulum(0, 1, 1, 2), BOTH_SIDES),
    (LinearPendulum(1, omega0=2), BOTH_SIDES),
    (Cycloid(2, 1), SOON),
    (Tautochrone(1.0), SOON),
    (CycloidalPendulum(1.0), BOTH_SIDES),
    (find_family("prothero-robinson").problem(-10, 2), SOON),
    (Descent("line"), SOON),
    (Descent("cycloid"), SOON),
    (Descent("quartic", released="1/4"), SOON),
    (PolarBrachistochrone(z0=0.25), SOON),
    (PolarByPsi(0.25), SOON),
    (Tunnel(z0=0.25), SOON),
)
CURVES = (CycloidArc(1.0), CycloidCurve(1.0), PolarByZ(0.25))
BELOW, DEEPER = Fraction(1, 8), (Fraction(1, 4), Fraction(1, 2), Fraction(5, 8))


@dataclass(frozen=True)
class Further:
    """The equation of a problem from its proven state at an argument."""

    problem: Any
    begun: Fraction

    @property
    def state_names(self) -> tuple[str, ...]:
        return self.problem.state_names

    @property
    def parameters(self) -> dict[str, Fraction]:
        return self.problem.parameters

    def start_in(self, _m: Any) -> list[arb]:
        return closed_form(self.problem, self.begun)

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return self.problem.derivative(m, t, y, p)


def closed_form(problem: Problem, t: Fraction) -> list[arb]:
    """The state by the closed form, in balls."""
    return list(problem.closed_form(BALL).rows("state", [t])[0])


def hold_together(problem: Problem, flow: ProvenFlow, begun: Fraction, times: Sequence[Fraction]) -> None:
    with ctx.workprec(BITS):
        for t in times:
            by_flow, by_form = flow.at(t - begun), closed_form(problem, t)
            assert [a.overlaps(b) for a, b in zip(by_flow, by_form, strict=True)] == [True] * len(by_form), t
            assert min(ball.rel_accuracy_bits() for ball in (*by_flow, *by_form)) >= FORTY_DIGITS, t


@pytest.mark.parametrize(("problem", "times"), MOTIONS, ids=lambda told: "" if isinstance(told, tuple) else repr(told))
def test_the_flow_of_a_motion_meets_its_closed_form(problem: Problem, times: tuple[Fraction, ...]) -> None:
    hold_together(problem, ProvenFlow(problem, BITS, STEPS), Fraction(0), times)


@pytest.mark.parametrize("problem", CURVES, ids=repr)
def test_the_flow_of_a_curve_meets_its_closed_form_below_its_start(problem: Problem) -> None:
    with ctx.workprec(BITS):
        flow = ProvenFlow(Further(problem, BELOW), BITS, STEPS)
    hold_together(problem, flow, BELOW, DEEPER)


def test_every_form_of_every_family_with_a_closed_form_is_here() -> None:
    tried = {type(problem) for problem in (*(one for one, _ in MOTIONS), *CURVES)}
    for family in FAMILIES:
        if family.has_closed_form:
            assert {type(one.problem(one.amplitudes[0])) for one in family.reported} <= tried, family.name


def test_a_flow_that_is_of_another_equation_does_not_meet_the_closed_form() -> None:
    heavier = ProvenFlow(Pendulum(1.0, g=Fraction(9.81) + Fraction(1, 2**100)), BITS, STEPS)
    with ctx.workprec(BITS):
        pairs = zip(heavier.at(Fraction(5)), closed_form(Pendulum(1.0), Fraction(5)), strict=True)
        assert not any(a.overlaps(b) for a, b in pairs)
