"""Conservative methods keep the energy to rounding at every step, in every format, for any problem."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import pytest

from compare.march.equation import plain_system
from compare.march.lanes import Lane, StartInvariant, sample_steps
from compare.march.march import march
from compare.march.precision import FORMATS, Precision, precision
from compare.measure.errors import score_method
from compare.measure.order_fit import fit_order
from compare.measure.truth import Course
from compare.methods import find
from compare.methods.conservative import AVF, CONSERVATIVE, GONZALEZ, PROJECTED_RK4
from reference import Pendulum
from reference.declaration import Invariant, StateSpace, Trial
from reference.problem import Problem

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method

FLOAT64, FLOAT128 = precision("float64"), precision("float128")
by_name = pytest.mark.parametrize("method", CONSERVATIVE, ids=lambda method: method.name)
COURSES = [Course(Pendulum(1.0), n, Fraction(2), FLOAT128) for n in (256, 512, 1024, 2048)]
STARTS = (Pendulum("1/100"), Pendulum(1.0), Pendulum(3.0), Pendulum(0.0, omega0=8.0))


def drifts(method: Method, n: int, fmt: Precision, problems: tuple[Problem, ...] = STARTS) -> list[float]:
    """The largest drift after any step over ten seconds, relative to the energy above rest."""
    lanes = [Lane(problem, n, fmt.round(Fraction(10, n)), sample_steps(n, 16)) for problem in problems]
    starts = [float(fmt.number(StartInvariant(problem))) for problem in problems]
    return [result.max_drifts[0] / start for result, start in zip(march(method, lanes, fmt), starts, strict=True)]


@by_name
@pytest.mark.parametrize("n", [64, 129, 1024, 2**15])
def test_the_energy_is_kept_to_rounding(method: Method, n: int) -> None:
    """What is held to the start's energy does not wander; the average vector field gathers roundings alone."""
    most = 16 * np.sqrt(n) if method is AVF else 40  # the one that turns over has come to 70 rad
    assert max(drifts(method, n, FLOAT64)) < most * FLOAT64.epsilon
    assert max(drifts(find("midpoint"), n, FLOAT64)) > 1000 * max(drifts(method, n, FLOAT64))


@by_name
@pytest.mark.parametrize("fmt", [*FORMATS, precision("mp:200")], ids=lambda fmt: fmt.name)
def test_the_energy_is_kept_to_the_rounding_of_every_format(method: Method, fmt: Precision) -> None:
    assert max(drifts(method, 256, fmt, STARTS[1:2])) < 100 * fmt.epsilon


@by_name
def test_order_by_slope_in_binary128_is_the_declared_one(method: Method) -> None:
    fitted = fit_order(method, score_method(method, COURSES, FLOAT128)[0])
    assert fitted.cells_used == len(COURSES)
    assert abs(fitted.fitted_order - method.order) < 0.02


def test_orders_are_proven_where_they_can_be() -> None:
    assert AVF.proven_order() == AVF.order == 2
    assert PROJECTED_RK4.proven_order() == PROJECTED_RK4.order == 4


def one_step(method: Method, y: tuple[float, float], h: float) -> tuple[np.ndarray, Any]:
    """A step of the pendulum in floats from a level of its own, and the equation."""
    parameters = np.array([h, 0.0, 9.81, 1.0])
    parameters[1] = plain_system(Pendulum(1.0), FLOAT64, parameters).invariant(y)
    system = plain_system(Pendulum(1.0), FLOAT64, parameters)
    new, _change = method.step(system, y, h, method.iterations(3.2 * abs(h), 53))
    return np.array(new), system


def test_the_projection_is_the_nearest_state_of_that_energy() -> None:
    """The way there is along the gradient where it ends, and the step of the base was not there."""
    new, system = one_step(PROJECTED_RK4, (1.0, 2.0), 0.2)
    base, _ = one_step(find("rk4"), (1.0, 2.0), 0.2)
    move, gradient = new - base, np.array(system.gradient(tuple(new)))
    assert np.linalg.norm(move) > 1e-5
    assert abs(move[0] * gradient[1] - move[1] * gradient[0]) < 1e-14 * np.linalg.norm(gradient)


def test_the_mean_force_is_the_difference_of_the_potentials_over_that_of_the_angles() -> None:
    (q, p), h = (1.0, -2.0), 0.2
    (new_q, new_p), _ = one_step(AVF, (q, p), h)
    assert new_q == pytest.approx(q + h * (p + new_p) / 2, abs=1e-15)
    assert new_p == pytest.approx(p + h * 9.81 * (np.cos(new_q) - np.cos(q)) / (new_q - q), abs=1e-13)


def test_gonzalezs_discrete_gradient_is_what_moves_the_state() -> None:
    """A pendulum's structure matrix turns the gradient by a right angle, whatever formula it is written by."""
    y, h = np.array([1.0, -2.0]), 0.2
    new, system = one_step(GONZALEZ, tuple(y), h)
    d, middle = new - y, (new + y) / 2
    g = np.array(system.gradient(tuple(middle)))
    a = (system.invariant(tuple(new)) - system.invariant(tuple(y)) - g @ d) / (d @ d)
    discrete = g + a * d
    assert abs(a) > 1e-3
    np.testing.assert_allclose(d, h * np.array([discrete[1], -discrete[0]]), rtol=0, atol=1e-14)


@pytest.mark.parametrize("method", [AVF, GONZALEZ], ids=lambda method: method.name)
def test_a_symmetric_step_is_undone_by_the_step_back(method: Method) -> None:
    there, _ = one_step(method, (1.0, 2.0), 0.1)
    back, _ = one_step(method, tuple(there), -0.1)
    np.testing.assert_allclose(back, (1.0, 2.0), rtol=0, atol=1e-14)


@by_name
@pytest.mark.parametrize("y", [(0.0, 0.0), (1.0, 0.0), (1e-8, 0.0), (0.0, 1e-8)])
def test_nothing_is_divided_by_zero_where_nothing_moves(method: Method, y: tuple[float, float]) -> None:
    new, _ = one_step(method, y, 0.01)
    np.testing.assert_allclose(new, one_step(find("rk4"), y, 0.01)[0], rtol=0, atol=2e-5)
    if y == (0.0, 0.0):
        assert tuple(new) == y


@by_name
def test_a_step_too_large_gives_no_number(method: Method) -> None:
    (result,) = march(method, [Lane(Pendulum(3.0), 8, Fraction(5, 4), (8,))], FLOAT64)
    assert np.all(np.isnan(result.states))


@dataclass(frozen=True)
class RigidBody(Problem):
    """Euler's equations of a free body with moments of inertia 1, 2 and 3: three components, no canonical ones."""

    name: ClassVar[str] = "rigid body"
    space: ClassVar[StateSpace] = StateSpace(
        positions=("a", "b", "c"), angles=(), odd=("a", "b", "c"), along=None, scale="largest", independent="s"
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),)
    trial: ClassVar[Trial] = Trial(states=((-3.0, 3.0),) * 3, parameters={}, step=(0.01, 0.1))
    parameters: ClassVar[dict[str, Fraction]] = {}
    start: ClassVar[tuple[Fraction, ...]] = (Fraction(1), Fraction(-1, 2), Fraction(2))

    @classmethod
    def derivative(cls, m: object, t: Any, y: Any, p: object) -> tuple[Any, ...]:  # noqa: ARG003
        a, b, c = y
        return -(b * c) / 6, 2 * (a * c) / 3, -(a * b) / 2

    @staticmethod
    def invariant(m: object, y: Any, p: object) -> Any:  # noqa: ARG004
        a, b, c = y
        return (a * a + b * b / 2 + c * c / 3) / 2

    def rate(self) -> float:
        return 2.0


@pytest.mark.parametrize("method", [PROJECTED_RK4, GONZALEZ], ids=lambda method: method.name)
def test_a_problem_without_canonical_variables_keeps_its_energy_too(method: Method) -> None:
    body = RigidBody()
    (drift,), (free,) = drifts(method, 100, FLOAT64, (body,)), drifts(find("rk4"), 100, FLOAT64, (body,))
    assert drift < 16 * FLOAT64.epsilon
    assert free > 1e-9
    lanes = [Lane(body, n, Fraction(1, n), (n,)) for n in (64, 1024)]
    coarse, fine = march(method, lanes, FLOAT64)
    assert 0 < np.max(np.abs(coarse.states - fine.states)) < 1e-3


@by_name
def test_a_problem_without_an_invariant_is_refused(method: Method) -> None:
    class Driven(RigidBody):
        invariants: ClassVar[tuple[Invariant, ...]] = ()

    with pytest.raises(ValueError, match=f"{method.name} keeps an invariant, and rigid body has none"):
        march(method, [Lane(Driven(), 64, Fraction(1, 64), (64,))], FLOAT64)
