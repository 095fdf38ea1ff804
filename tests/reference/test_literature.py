"""The problems of the literature: against other routes, closed forms and what is printed of them."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest

from compare.sources.published.source import solutions
from reference.arithmetic.compiler import hy
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.namespaces import BALL, MPMATH, Heyoka
from reference.arithmetic.precision import ctx, mp
from reference.flow_problem import FlowProblem, HamiltonianFlow
from reference.problem import HamiltonianProblem
from reference.problems.arenstorf import Arenstorf, ArenstorfBinary64
from reference.problems.duffing import Duffing
from reference.problems.families import FAMILIES, find_family
from reference.problems.figure_eight import FigureEight
from reference.problems.gravitation import Gravitation
from reference.problems.kepler import Kepler
from reference.problems.pleiades import Pleiades
from reference.problems.rigid_body import RigidBody
from reference.routes.proven_flow import ProvenFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

BITS = 100
"""Working precision of the proofs; the other routes have more."""
MORE = 160
STEPS = 4000
ENDS = {
    "arenstorf": "1/64",
    "arenstorf-binary64": "1/64",
    "brusselator": "2",
    "double-pendulum": "1/8",
    "driven-pendulum": "4",
    "duffing": "2",
    "duffing-driven": "1",
    "figure-eight": "1/4",
    "henon-heiles": "1/2",
    "kepler": "1/2",
    "lorenz": "1/2",
    "lotka-volterra": "2",
    "outer-planets": "20",
    "pleiades": "1/16",
    "rigid-body": "2",
    "swinging-spring": "1/2",
    "toda": "1/8",
    "van-der-pol": "2",
}
PERIOD = Fraction("17.0652165601579625588917206249")
"""Of Arenstorf's orbit, as printed."""


def problem_of(name: str) -> Any:
    return find_family(name).problem()


FLOWS = [family.name for family in FAMILIES if family.name in ENDS]


def by_heyoka(problem: FlowProblem, t: Fraction, bits: int = MORE) -> list[Fraction]:
    """The state by heyoka, its numbers put in as constants."""

    def real(value: Fraction) -> Any:
        return hy.real(value.numerator, bits) / hy.real(value.denominator, bits)

    m: Any = Heyoka(lambda value: hy.expression(real(value)))
    names = [hy.expression(name) for name in problem.state_names]
    rates = [m.expression(rate) for rate in problem.derivative(m, hy.time, m.terms(names), problem.parameters_in(m))]
    integrator = hy.taylor_adaptive(
        list(zip(names, rates, strict=True)),
        [real(value) for value in problem.start],
        fp_type=hy.real,
        prec=bits,
        compact_mode=True,
    )
    integrator.propagate_until(real(t))
    return [Fraction(str(value)) for value in integrator.state]


def off(found: Sequence[Fraction], other: Sequence[Any]) -> float:
    """The largest difference of two states."""
    return max(abs(float(a - Fraction(b))) for a, b in zip(found, other, strict=True))


def generic(problem: FlowProblem) -> list[Any]:
    """A state near the start at which no component is what it is there."""
    return [
        MPMATH.number(value * Fraction(9 + k % 3, 10) + Fraction(3 + k % 5, 50))
        for k, value in enumerate(problem.start)
    ]


def slopes(problem: FlowProblem, value: str, y: Sequence[Any]) -> tuple[Any, ...]:
    """The gradient of an invariant."""
    duals: Any = DualArithmetic(MPMATH, len(y))
    found = getattr(problem, value)(
        duals, [duals.variable(v, i) for i, v in enumerate(y)], problem.parameters_in(MPMATH)
    )
    assert isinstance(found, Dual)
    return found.slopes


def rates_of(problem: FlowProblem, y: Sequence[Any]) -> tuple[Any, ...]:
    return problem.derivative(MPMATH, MPMATH.number(Fraction(1, 3)), y, problem.parameters_in(MPMATH))


def test_every_problem_of_the_literature_is_tested_here() -> None:
    kinds: dict[str, Any] = {family.name: family.problem for family in FAMILIES}
    flows = {name: kind for name, kind in kinds.items() if isinstance(kind, type) and issubclass(kind, FlowProblem)}
    own = {name for name, kind in flows.items() if "detest" not in kind.__module__}
    assert own == set(ENDS)


@pytest.mark.parametrize("name", FLOWS)
def test_the_proven_flow_holds_the_state_by_heyoka(name: str) -> None:
    problem, end = problem_of(name), Fraction(ENDS[name])
    proven = ProvenFlow(problem, BITS, STEPS).at(end)
    size = max(abs(float(ball)) for ball in proven)
    for ball, value in zip(proven, by_heyoka(problem, end), strict=True):
        assert float(ball.rad()) < 1e-20 * size
        with ctx.workprec(MORE):
            assert ball.contains(BALL.number(value).mid())


@pytest.mark.parametrize("name", FLOWS)
def test_invariants_do_not_change_along_the_equation(name: str) -> None:
    problem = problem_of(name)
    with mp.workprec(MORE):
        y = generic(problem)
        rates = rates_of(problem, y)
        for one in problem.invariants:
            parts = [slope * rate for slope, rate in zip(slopes(problem, one.value, y), rates, strict=True)]
            assert abs(mp.fsum(parts)) < 1e-40 * mp.fsum(map(abs, parts)), one.name
            assert sum(part != 0 for part in parts) > 1


@pytest.mark.parametrize("name", FLOWS)
def test_the_scale_of_a_drift_is_not_zero(name: str) -> None:
    problem = problem_of(name)
    with mp.workprec(MORE):
        y, p = problem.start_in(MPMATH), problem.parameters_in(MPMATH)
        for one in problem.invariants:
            scale = getattr(problem, one.value if one.scale == "start" else "kinetic")(MPMATH, y, p)
            assert abs(scale) > 1e-12, one.name


@pytest.mark.parametrize("name", [name for name in FLOWS if problem_of(name).space.odd is not None])
def test_an_equation_turns_back_where_its_odd_components_do(name: str) -> None:
    problem = problem_of(name)
    with mp.workprec(MORE):
        y, odd = generic(problem), problem.space.places(problem.space.odd)
        turned = [-value if i in odd else value for i, value in enumerate(y)]
        for i, (rate, back) in enumerate(zip(rates_of(problem, y), rates_of(problem, turned), strict=True)):
            assert abs(back - (rate if i in odd else -rate)) <= 1e-40 * abs(rate)


@pytest.mark.parametrize("name", [name for name in FLOWS if isinstance(problem_of(name), HamiltonianFlow)])
def test_the_equation_is_that_of_the_hamiltonian(name: str) -> None:
    problem = problem_of(name)
    with mp.workprec(MORE):
        y, p = generic(problem), problem.parameters_in(MPMATH)
        of_energy = HamiltonianProblem.derivative(problem, MPMATH, MPMATH.number(Fraction(0)), y, p)
        for rate, other in zip(rates_of(problem, y), of_energy, strict=True):
            assert abs(rate - other) <= 1e-40 * (1 + abs(rate))


@pytest.mark.parametrize("name", [name for name in FLOWS if isinstance(problem_of(name), Gravitation)])
def test_the_forces_of_gravitation_are_the_slopes_of_the_energy(name: str) -> None:
    problem = problem_of(name)
    with mp.workprec(MORE):
        y, half = generic(problem), len(problem.state_names) // 2
        rates, found = rates_of(problem, y), slopes(problem, "invariant", y)
        masses = list(problem.masses(problem.parameters_in(MPMATH))) * (half // len(problem.bodies))
        for mass, slope, other, velocity, rate in zip(
            masses, found[:half], found[half:], y[half:], rates[half:], strict=True
        ):
            assert abs(slope + mass * rate) <= 1e-40 * abs(slope)
            assert abs(other - mass * velocity) <= 1e-40 * abs(other)


@pytest.mark.parametrize(
    ("problem", "t"),
    [
        *((Kepler(e=e), Fraction(1, 64)) for e in ("0", "0.5", "0.9", "0.99")),
        (Kepler(e="0.3"), Fraction(9)),
        (RigidBody(), Fraction(3, 2)),
        (Duffing(), Fraction(2)),
    ],
    ids=repr,
)
def test_the_proven_flow_holds_the_closed_form(problem: FlowProblem, t: Fraction) -> None:
    """Kepler's equation, Euler's free body and Duffing's oscillator by elliptic functions."""
    with mp.workprec(MORE):
        expected = problem.known_state(mp.mpf(t.numerator) / t.denominator)
        for ball, value in zip(ProvenFlow(problem, BITS, STEPS).at(t), expected, strict=True):
            assert abs(mp.mpf(ball.mid().str(45, radius=False)) - value) < 1e-24


def test_arenstorfs_satellite_is_back_after_the_printed_period() -> None:
    problem = Arenstorf()
    assert 1e-27 < off(by_heyoka(problem, PERIOD, 192), problem.start) < 1e-26


def test_the_numbers_of_a_program_do_not_close_arenstorfs_orbit() -> None:
    problem = ArenstorfBinary64()
    assert [float(value) for value in problem.start] == [0.994, 0.0, 0.0, -2.00158510637908252240537862224]
    assert problem.parameters["mu"] == Fraction(0.012277471) != Arenstorf().parameters["mu"]
    assert 1e-11 < off(by_heyoka(problem, PERIOD), problem.start) < 2e-11


def test_the_figure_eight_is_almost_closed_after_the_printed_period() -> None:
    problem = FigureEight()
    assert 1e-9 < off(by_heyoka(problem, Fraction("6.32591398")), problem.start) < 1e-6


def test_sixteen_of_the_printed_values_of_the_pleiades_are_not_correctly_rounded() -> None:
    (table,) = (one for one in solutions() if one.name == "pleiades")
    (column,) = table.columns
    assert table.rows == Pleiades.space.components
    found = by_heyoka(Pleiades(), Fraction(3), 128)
    wrong = 0
    for value, printed in zip(found, column.printed, strict=True):
        assert len(Decimal(printed).as_tuple().digits) == 16
        unit = Fraction(1, 10 ** len(printed.partition(".")[2]))
        assert abs(value - Fraction(printed)) < 200 * unit
        wrong += abs(value - Fraction(printed)) > unit / 2
    assert wrong == 16
