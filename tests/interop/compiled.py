"""Steps that numba and JAX compile with f, in every form; ``make interop`` names this file.

Beside the known methods each gives what the same lines give in plain Python, with as many evaluations.
"""

from __future__ import annotations

import inspect
from functools import partial
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numba
import numpy as np
import people
import pytest
import slips

import compare
from reference import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

jax.config.update("jax_enable_x64", True)


def midpoint_over_a_grid(f: Any, y0: Any, t: Any) -> Any:
    states = np.empty((len(t), len(y0)))
    states[0] = y0
    for i in range(len(t) - 1):
        h = t[i + 1] - t[i]
        middle = states[i] + h / 2 * f(t[i], states[i])
        states[i + 1] = states[i] + h * f(t[i] + h / 2, middle)
    return states


def with_the_time_last(f: Any, y0: Any, t: Any) -> Any:
    states = np.empty((len(t), len(y0)))
    states[0] = y0
    for i in range(len(t) - 1):
        h = t[i + 1] - t[i]
        middle = states[i] + h / 2 * f(states[i], t[i])
        states[i + 1] = states[i] + h * f(middle, t[i] + h / 2)
    return states


def heun_over_a_span(f: Any, t_span: Any, y0: Any, n: int) -> Any:
    h = (t_span[1] - t_span[0]) / n
    states = np.empty((n + 1, len(y0)))
    states[0] = y0
    for i in range(n):
        k = f(states[i])
        states[i + 1] = states[i] + h / 2 * (k + f(states[i] + h * k))
    return np.linspace(t_span[0], t_span[1], n + 1), states


def eulers_one_after_another(f: Any, y0: Any, h: float) -> Any:
    y = y0
    while True:
        y = y + h * f(y)
        yield y


def of_one_position(q: Any, p: Any, force: Any, h: float) -> Any:
    middle = p[0] + h / 2 * force(q[0])
    new = q[0] + h * middle
    return np.array([new]), np.array([middle + h / 2 * force(new)])


def of_tuples(f: Any, y: Any, h: float) -> Any:
    k = f((y[0], y[1]))
    return y + h / 2 * (k + f(y + h * k))


def adapting(f: Any, y0: Any, t: Any, rtol: float) -> Any:
    """Bogacki and Shampine's pair."""
    states = np.empty((len(t), len(y0)))
    states[0] = y0
    for i in range(len(t) - 1):
        y, s, h = states[i].copy(), t[i], (t[i + 1] - t[i]) / 2
        while s < t[i + 1]:
            h = min(h, t[i + 1] - s)
            k1 = f(s, y)
            k2 = f(s + h / 2, y + h / 2 * k1)
            k3 = f(s + 3 * h / 4, y + 3 * h / 4 * k2)
            end = y + h / 9 * (2 * k1 + 3 * k2 + 4 * k3)
            error = h * (-5 * k1 / 72 + k2 / 12 + k3 / 9 - f(s + h, end) / 8)
            size = np.max(np.abs(error)) / rtol + 1e-10
            if size < 1:
                y, s = end, s + h
            h *= min(5.0, max(0.2, 0.9 * size ** (-1 / 3)))
        states[i + 1] = y
    return states


def hermite_of_rk4(f: Any, y: Any, h: float, theta: float) -> Any:
    k = f(y)
    k2 = f(y + h / 2 * k)
    k3 = f(y + h / 2 * k2)
    end = y + h / 6 * (k + 2 * k2 + 2 * k3 + f(y + h * k3))
    slope = (1 - 2 * theta) * (end - y) + (theta - 1) * h * k + theta * h * f(end)
    return (1 - theta) * y + theta * end + theta * (theta - 1) * slope


def midpoint_within(f: Any, y: Any, h: float) -> Any:
    """Python's own, with a compiled step in it."""
    return MIDPOINT(f, y, h)


@numba.njit  # type: ignore[untyped-decorator]
def MIDPOINT(f: Any, y: Any, h: float) -> Any:  # noqa: N802
    return y + h * f(y + h / 2 * f(y))


def scanned(f: Any, y0: Any, t: Any) -> Any:
    def one(y: Any, ends: Any) -> Any:
        h = ends[1] - ends[0]
        y = y + h * f(ends[0] + h / 2, y + h / 2 * f(ends[0], y))
        return y, y

    return jnp.concatenate([y0[None], jax.lax.scan(one, y0, (t[:-1], t[1:]))[1]])


def iterated(f: Any, y: Any, h: float) -> Any:
    def better(now: Any) -> Any:
        new = y + h * f((y + now[0]) / 2)
        return new, jnp.max(jnp.abs(new - now[0]))

    return jax.lax.while_loop(lambda now: now[1] > 1e-13, better, (y, 1.0))[0]


first, third = partial(jax.jit, static_argnums=0), partial(jax.jit, static_argnums=2)
STEPS = {
    "numba": [
        (numba.njit, slips.rk4, {"order": 4}),
        (numba.njit, slips.rk4_in_time, {"order": 4}),
        (numba.njit, slips.separable_verlet, {"order": 2, "symplectic": True, "reversible": True}),
        (numba.njit, people.verlet_of_a_potential, {"order": 2, "symplectic": True}),
        (numba.njit, of_one_position, {"order": 2, "symplectic": True}),
        (numba.njit, of_tuples, {"order": 2}),
        (numba.njit, midpoint_over_a_grid, {"order": 2}),
        (numba.njit, with_the_time_last, {"order": 2}),
        (numba.njit, heun_over_a_span, {"order": 2}),
        (numba.njit, eulers_one_after_another, {"order": 1}),
    ],
    "jax": [
        (first, slips.rk4, {"order": 4}),
        (first, slips.rk4_in_time, {"order": 4}),
        (third, slips.separable_verlet, {"order": 2, "symplectic": True, "reversible": True}),
        (third, people.verlet_of_a_potential, {"order": 2, "symplectic": True}),
        (first, scanned, {"order": 2}),
        (first, iterated, {"order": 2}),
    ],
}
PLAIN = {scanned: midpoint_over_a_grid}
"""What is the same in plain Python, where JAX's own loop is not."""
CASES = [pytest.param(*case, id=f"{package}-{case[1].__name__}") for package, cases in STEPS.items() for case in cases]
BESIDE = [
    pytest.param(numba.njit(adapting), {"tolerance": 1}, id="numba-adapting"),
    pytest.param(numba.njit(people.bogacki_shampine), {"order": 3, "estimate": 2}, id="numba-estimate"),
    pytest.param(first(people.bogacki_shampine), {"order": 3, "estimate": 2}, id="jax-estimate"),
    pytest.param(
        numba.njit(slips.rk4), {"order": 4, "dense": 3, "interpolant": numba.njit(hermite_of_rk4)}, id="numba-dense"
    ),
    pytest.param(first(slips.rk4), {"order": 4, "dense": 3, "interpolant": first(hermite_of_rk4)}, id="jax-dense"),
    pytest.param(midpoint_within, {"order": 2}, id="numba-within"),
]
SECONDS = 300


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize(("compiled", "step", "claims"), CASES)
def test_a_compiled_step_holds_its_claims(compiled: Callable[..., Any], step: Any, claims: dict[str, Any]) -> None:
    compare.check(compiled(step), **claims, seconds=SECONDS).assert_holds()


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize(("step", "claims"), BESIDE)
def test_what_a_compiled_step_gives_beside_the_state_holds(step: Any, claims: dict[str, Any]) -> None:
    compare.check(step, **claims, seconds=SECONDS).assert_holds()


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize(("compiled", "step", "claims"), CASES)
def test_beside_the_known_methods_it_gives_what_its_lines_give(
    compiled: Callable[..., Any], step: Any, claims: dict[str, Any]
) -> None:
    made = compare.method(order=claims["order"], name="compiled")(compiled(step))
    with jax.disable_jit():
        plain = compare.method(order=claims["order"], name="plain")(PLAIN.get(step, step))
        expected = figures(plain)
    assert made.calls == plain.calls
    for (error, evaluations), (other, others) in zip(figures(made), expected, strict=True):
        assert evaluations == others
        assert error == pytest.approx(other, rel=1e-9, abs=1e-14)


def figures(method: Any) -> list[tuple[float, int]]:
    cells = compare.error_vs_n(Pendulum(1.0), [method], n=[32, 64], t_end=3)
    return [(cell.max_error, cell.evaluations) for cell in cells]


@numba.njit  # type: ignore[untyped-decorator]
def endless(f: Any, y: Any, h: float) -> Any:
    while True:
        y = y + h * f(y)


@numba.njit  # type: ignore[untyped-decorator]
def of_three(f: Any, y: Any, h: float) -> Any:
    return y + h * f(np.zeros(3))[:2]


@first
def endless_in_jax(f: Any, y: Any, h: float) -> Any:
    return jax.lax.while_loop(lambda now: now[0] < 1e300, lambda now: y + 0 * h * f(now), y)


@pytest.mark.parametrize(
    ("step", "says"),
    [
        (endless, "endless called f more than 10000 times in one step; it does not come to an end"),
        (of_three, "f was called with a state of shape \\(3,\\); 2 components along the first axis are accepted"),
        (endless_in_jax, "endless_in_jax called f more than 10000 times in one step"),
    ],
)
def test_what_f_raises_below_compiled_code_is_told(step: Any, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        compare.method(order=2)(step)


def test_the_lists_have_every_form() -> None:
    from compare.methods.own.adapters import adapted
    from compare.methods.own.forms import FORMS

    tried = {adapted(compiled(step))[1].name for compiled, step, _ in STEPS["numba"]}
    assert tried == {form.name for form in FORMS if not form.own} | {"solver", "generator"}
    assert inspect.isgeneratorfunction(eulers_one_after_another)
