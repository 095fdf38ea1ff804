"""The rules of remainders against members: functions at the ends of what is claimed of the operands."""

# ruff: noqa: ARG001 - rules take what they are given, and wrong ones make no use of it

from __future__ import annotations

import random
import sys
from fractions import Fraction
from typing import Any

import pytest
from flint import arb, arb_poly

from reference.arithmetic import models
from reference.arithmetic.balls import BALL
from reference.arithmetic.models import ModelArithmetic, RefusedError, Tape, Variable
from reference.arithmetic.precision import ctx

BITS = 80
"""Of the polynomials: roundings are part of what the remainders bound."""
EXACT_BITS = 4000
"""Of the values they are held against, whose magnitudes differ by up to 10^600."""
CALLED = ("sin", "cos", "exp", "log", "sqrt", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
POWERS = (Fraction(3, 2), Fraction(-1, 2), Fraction(1, 3), Fraction(-2), Fraction(3))


def formula(rng: random.Random, depth: int, constants: list[arb]) -> Any:
    """A random formula of x_0, x_1, x_2 and of constants, each a ball of which a member is chosen later."""
    if depth == 0:
        place = rng.randrange(3)
        return lambda _m, x, _c: x[place]
    one, other = formula(rng, depth - 1, constants), formula(rng, depth - 1, constants)
    called, exponent, place = rng.choice(CALLED), rng.choice(POWERS), len(constants)
    constants.append(number(rng) + arb(0, size(rng) * arb(2) ** -rng.choice([20, 60, 90])))
    return rng.choice(
        [
            lambda m, x, c: one(m, x, c) + other(m, x, c),
            lambda m, x, c: one(m, x, c) - other(m, x, c),
            lambda m, x, c: one(m, x, c) * other(m, x, c),
            lambda m, x, c: one(m, x, c) / other(m, x, c),
            lambda m, x, c: getattr(m, called)(one(m, x, c)),
            lambda m, x, c: m.power(one(m, x, c), exponent),
            lambda m, x, c: -one(m, x, c),
            lambda m, x, c: one(m, x, c) ** 2,
            lambda m, x, c: c[place] + one(m, x, c),
            lambda m, x, c: c[place] * one(m, x, c),
            lambda m, x, c: c[place] / one(m, x, c),
        ]
    )


def size(rng: random.Random) -> arb:
    """Mostly near one, and now and then 10^300 or 10^-300."""
    return arb(10) ** rng.choice([0, 0, 0, 0, 0, -1, 1, -3, -150, 150, -300, 300])


def number(rng: random.Random) -> arb:
    return (arb(rng.uniform(-2, 2)) * size(rng)).mid()


def variable(rng: random.Random, order: int) -> tuple[list[arb], arb]:
    """A polynomial whose terms fall off at some rate, and a remainder."""
    scale, ratio = size(rng), rng.choice([0.1, 0.3, 0.6])
    terms = [(arb(rng.uniform(-1, 1)) * scale * arb(ratio) ** k).mid() for k in range(order + 1)]
    if rng.random() < 0.7:
        terms[0] = (terms[0] + 2 * scale).mid()
    remainder = scale * arb(2) ** -rng.choice([3, 8, 30, 70, 90])
    return terms, remainder.mid() if rng.random() < 0.8 else arb(0)


def modelled(order: int, told: Any, constants: list[arb], given: list[tuple[list[arb], arb]]) -> Any:
    """The node of a formula on a tape that is closed; None where it is a constant.

    Raises:
        RefusedError: a rule has no answer.
    """
    tape = Tape()
    with ctx.workprec(BITS):
        x = [Variable(tape, lambda k, terms=terms: terms[k]) for terms, _ in given]
        found = told(ModelArithmetic(tape), x, constants)
        found = found.node if isinstance(found, models.Function) else found
        tape.begin()
        for k in range(order + 1):
            tape.grow(k)
        tape.close([remainder for _, remainder in given])
    return found


def violations(seed: int, members: int = 6) -> tuple[int, int, float]:
    """How many members of a random formula were looked at, how many were outside, and the largest part of a bound."""
    rng = random.Random(seed)
    order, constants = rng.choice([1, 2, 3, 5, 9, 17]), list[arb]()
    told = formula(rng, rng.choice([1, 2, 2, 3]), constants)
    given = [variable(rng, order) for _ in range(3)]
    try:
        found = modelled(order, told, constants, given)
    except RefusedError:
        return 0, 0, 0.0
    if not isinstance(found, models.Node):
        return 0, 0, 0.0
    outside, largest = 0, 0.0
    for _ in range(members):
        s = rng.choice([Fraction(0), Fraction(1), Fraction(rng.random())])
        with ctx.workprec(EXACT_BITS):
            at = BALL.number(s)
            x = [value(terms, at) + rng.choice([-1, 1, rng.uniform(-1, 1)]) * remainder for terms, remainder in given]
            c = [one.mid() + rng.choice([-1, 1]) * one.rad() for one in constants]
            off = abs(told(BALL, x, c) - value(found.terms, at))
            if not off <= found.remainder:
                outside += 1
            elif found.remainder > 0:
                largest = max(largest, float(off / found.remainder))
    return members, outside, largest


def value(terms: list[arb], at: arb) -> arb:
    total = arb(0)
    for term in reversed(terms):
        total = total * at + term
    return total


def test_no_member_of_a_random_formula_is_outside() -> None:
    looked_at, largest = 0, 0.0
    for seed in range(600):
        members, outside, part = violations(seed)
        assert not outside, f"seed {seed}"
        looked_at, largest = looked_at + members, max(largest, part)
    assert looked_at > 1500
    assert 0.9 < largest <= 1


def product_without_its_remainders(self: models.Product, residual: arb) -> arb:
    return residual


def product_cut_at_the_order(self: models.Product, residual: arb) -> arb:
    kept = models.supremum((self.made - self.polynomial).truncate(len(self.terms)))
    return TRUE_PRODUCT(self, kept)


def inverse_of_the_polynomial_alone(self: models.Inverse, residual: arb) -> arb:
    return self.norm * residual / (1 - residual)


def root_without_the_remainder(self: models.Root, residual: arb) -> arb:
    low = self.terms[0] - self.swing
    return self.norm * residual / (low * low)


def exponential_moved_as_a_sine(self: models.Exponential, residual: arb) -> arb:
    return residual + self.a.remainder


def circular_of_the_polynomial_alone(self: models.Circular, residual: arb) -> arb:
    return residual


def hyperbolic_moved_as_a_sine(self: models.Hyperbolic, residual: arb) -> arb:
    return residual + self.a.remainder


def derivative_of_the_polynomial_alone(self: models.ByDerivative, residual: arb) -> arb:
    return residual


def linear_by_the_middles(self: models.Linear, residual: arb) -> arb:
    made = sum((factor.mid() * node.polynomial for node, factor in self._addends), arb_poly([self._constant.mid()]))
    return TRUE_LINEAR(self, models.supremum(made - self.polynomial))


def linear_without_the_last(self: models.Linear, residual: arb) -> arb:
    kept = self._addends[:-1]
    return residual + sum((factor.abs_upper() * node.remainder for node, factor in kept), arb(0))


def without_what_is_rounded(self: models.Linear, residual: arb) -> arb:
    return TRUE_LINEAR(self, arb(0))


TRUE_PRODUCT, TRUE_LINEAR = models.Product.remaining, models.Linear.remaining


@pytest.mark.parametrize(
    ("kind", "rule"),
    [
        (models.Product, product_without_its_remainders),
        (models.Product, product_cut_at_the_order),
        (models.Inverse, inverse_of_the_polynomial_alone),
        (models.Root, root_without_the_remainder),
        (models.Exponential, exponential_moved_as_a_sine),
        (models.Circular, circular_of_the_polynomial_alone),
        (models.Hyperbolic, hyperbolic_moved_as_a_sine),
        (models.ByDerivative, derivative_of_the_polynomial_alone),
        (models.Linear, linear_by_the_middles),
        (models.Linear, linear_without_the_last),
        (models.Linear, without_what_is_rounded),
    ],
    ids=lambda value: value.__name__,
)
def test_a_wrong_rule_is_noticed(kind: Any, rule: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kind, "remaining", rule)
    assert any(violations(seed)[1] for seed in range(600))


def test_an_equation_takes_no_branches() -> None:
    node = Variable(Tape(), lambda _k: arb(0))
    with pytest.raises(TypeError, match="takes no branches"):
        bool(node)
    with pytest.raises(TypeError):
        abs(node)  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        node < 1  # type: ignore[operator]  # noqa: B015
    with pytest.raises(AttributeError):
        ModelArithmetic(Tape()).floor(node)  # type: ignore[attr-defined]


def main() -> None:
    """Look at the formulas of a range of seeds: python tests/reference/test_models.py FIRST LAST."""
    looked_at, outside, largest = 0, 0, 0.0
    for seed in range(int(sys.argv[1]), int(sys.argv[2])):
        members, wrong, part = violations(seed)
        looked_at, outside, largest = looked_at + members, outside + wrong, max(largest, part)
    print(f"{looked_at} members, {outside} outside, largest part of a bound {largest:.6f}")  # noqa: T201


if __name__ == "__main__":
    main()
