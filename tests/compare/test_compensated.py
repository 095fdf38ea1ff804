"""Compensated summation keeps what rounding loses, compiled as plain, and long marches show it (Brouwer's law)."""

from __future__ import annotations

import pickle
from fractions import Fraction
from typing import TYPE_CHECKING

import heyoka as hy
import numpy as np
import pytest

import compare
from compare.march.equation import plain_system
from compare.march.lanes import Lane, sample_steps
from compare.march.march import march
from compare.march.precision import FORMATS, Precision, precision
from compare.march.trace import compile_block, entry_rows, plain_block
from compare.methods import METHODS, find
from compare.methods.kinds.compensated import Sum, compensate
from compare.methods.kinds.one_step import Tableau
from compare.methods.order.algebraic import enclose
from reference import Pendulum

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method

FLOAT32, FLOAT64 = precision("float32"), precision("float64")
by_name = pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)


@pytest.mark.parametrize("fmt", [*FORMATS, precision("mp:100")], ids=lambda fmt: fmt.name)
@pytest.mark.parametrize("batch", [1, 8])
def test_the_compiler_does_not_undo_a_compensated_sum(fmt: Precision, batch: int) -> None:
    """A thousandth of a rounding, added eight times, is all in what the sum remembers."""
    value, lost, change = (hy.expression(name) for name in ("value", "lost", "change"))
    total = Sum(value, lost)
    for _ in range(8):
        total = total + change * change
    function = hy.cfunc(
        [total.value, total.lost],
        vars=[value, lost, change],
        batch_size=min(batch, fmt.lanes),
        **fmt.compiler_options,
    )
    change_rooted = fmt.round(Fraction(1, 1 << (fmt.bits // 2 + 6)))
    zero = fmt.zeros((8,))
    inputs = np.stack([fmt.array([1] * 8), zero, fmt.array([change_rooted] * 8)])
    found = function(inputs)
    expected = float(8 * change_rooted**2)
    assert expected < fmt.epsilon / 2
    assert np.all(found[0] == fmt.number(Fraction(1)))
    np.testing.assert_allclose(found[1].astype(np.float64), expected, rtol=1e-6)


def test_a_sum_of_many_small_numbers_is_right_to_its_last_bit() -> None:
    tenth = np.float32(0.1)
    plain, total = np.float32(0), Sum(np.float32(0), np.float32(0))
    for _ in range(100_000):
        plain, total = plain + tenth, total + tenth
    exact = 100_000 * float(tenth)
    assert abs(float(plain) - exact) > 1
    assert abs(float(total.value) - exact) <= np.spacing(np.float32(exact))


LONG_STEP = 20
"""Evaluations of a step that takes long to compile."""


@by_name
def test_every_method_takes_it_and_stays_itself(method: Method) -> None:
    """A few steps differ by roundings alone, plain and compiled, and by some: the sums remember what they lost.

    Two roundings of slopes of 9.81 go into each of the four steps of 1/64 with the weights, whose sizes add up to 354
    in verner65.
    """
    helped = compensate(method)
    states = np.linspace(0.1, 2, 16).reshape(2, 8)
    parameters = np.stack([np.full(8, value) for value in (1 / 64, 0.0, 9.81, 1.0)])
    parameters[1] = plain_system(Pendulum(1.0), FLOAT64, parameters).invariant(tuple(states))
    iterations = method.iterations(0.05, 53)
    count = 4 if method.evaluations(iterations)[0] < LONG_STEP else 1
    steps = method.starting_steps + count
    plain = plain_block(helped, Pendulum(1.0), FLOAT64, states, parameters, steps, iterations)
    base = plain_block(method, Pendulum(1.0), FLOAT64, states, parameters, steps, iterations)
    weights = sum(abs(float(enclose(weight))) for weight in method.b) if isinstance(method, Tableau) else 1
    slopes = 2 * FLOAT64.epsilon * 9.81 * weights * 4 / 64
    np.testing.assert_allclose(plain[:, :2], base[:, :2], rtol=0, atol=1e-14 + slopes)
    lost = plain[-1, -4:-2]
    assert 0 < np.max(np.abs(lost)) < 1e-15
    entry = entry_rows(helped, Pendulum(1.0), FLOAT64, states, parameters)[-1]
    block = compile_block(helped, Pendulum(1.0), FLOAT64, count, "last", 8, iterations, brief=True)
    out = np.zeros((len(entry), 8))
    block(entry, parameters, out)
    assert 0 < np.max(np.abs(out[-4:-2])) < 1e-15
    np.testing.assert_allclose(out[:2] + out[-4:-2], plain[-1, :2] + lost, rtol=0, atol=2e-15 + slopes)


def rms(values: list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def rounding(name: str, n: int, *, compensated: bool) -> tuple[float, float]:
    """What rounding to float32 does to the state and to the energy in a long march: rms over some amplitudes.

    Against the same steps in float64; all numbers are short, so that no parameter is rounded.
    """
    problems = [Pendulum(Fraction(k, 16), g=10) for k in range(8, 40)]
    lanes = [Lane(problem, n, Fraction(1, 256), sample_steps(n, 64)) for problem in problems]
    method = compensate(find(name)) if compensated else find(name)
    states = [result.states.astype(np.float64) for result in march(method, lanes, FLOAT32)]
    wide = [result.states for result in march(find(name), lanes, FLOAT64)]

    def energy(y: np.ndarray) -> float:
        return float(y[-1, 1] ** 2 / 2 + 20 * np.sin(y[-1, 0] / 2) ** 2)

    return (
        rms([float(np.max(np.abs(a - b))) for a, b in zip(states, wide, strict=True)]),
        rms([energy(a) / energy(b) - 1 for a, b in zip(states, wide, strict=True)]),
    )


def test_rounding_follows_brouwers_law_and_compensation_takes_most_of_it_away() -> None:
    """D. Brouwer, Astron. J. 46 (1937), 149: the energy errs as the root of the time, the angle as its power 3/2."""
    counts = [2**k for k in (12, 14, 16, 18)]
    plain = np.array([rounding("verlet", n, compensated=False) for n in counts])
    helped = np.array([rounding("verlet", n, compensated=True) for n in counts])
    angle, energy = (np.polyfit(np.log(counts), np.log(column), 1)[0] for column in plain.T)
    assert 1.3 < angle < 1.7
    assert 0.3 < energy < 0.7
    assert np.all(helped[:, 0] < plain[:, 0] / 50)
    assert np.all(helped[:, 1] < plain[:, 1] / 50)


@pytest.mark.parametrize("name", ["rk4", "yoshida4", "ab4"])
def test_compensation_helps_other_methods_too(name: str) -> None:
    plain, helped = (rounding(name, 2**15, compensated=compensated) for compensated in (False, True))
    assert helped[0] < plain[0] / 10
    assert helped[1] < plain[1] / 10


def test_scores_of_compensated_methods_bear_their_name() -> None:
    options = {"methods": ("rk4",), "n": [2**16], "precision": "float32", "t_end": 256}
    (plain,), (helped,) = (compare.error_vs_n(Pendulum(1.0, g=10), compensated=c, **options) for c in (False, True))
    assert (plain.method, helped.method) == ("rk4", "rk4_compensated")
    assert plain.evaluations == helped.evaluations
    assert helped.max_error < plain.max_error / 10


def test_a_compensated_method_goes_to_other_processes() -> None:
    helped = compensate(find("ab4"))
    assert pickle.loads(pickle.dumps(helped)) == helped  # noqa: S301
    assert helped.order == 4
    assert not hasattr(helped, "nonsense")
