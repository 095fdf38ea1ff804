"""Splittings from printed decimals: as many coefficients as there are order conditions are made to satisfy them.

The others are free parameters of the method, and are taken to be exactly what is printed.
"""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from math import factorial
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb

from compare.methods.kinds.one_step import Splitting, compose
from compare.methods.order.certified_roots import Zero
from compare.methods.order.lyndon_words import coefficient, exponent, lyndon_words, nystrom_words, odd_words
from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.methods.order.algebraic import Coefficient

__all__ = ["jump", "palindrome", "proven_composition", "proven_splitting", "refined"]

Values: TypeAlias = "Sequence[Any]"
Flows: TypeAlias = tuple[tuple[str, Any], ...]


def refined(
    name: str,
    conditions: Callable[[Values], Sequence[Any]],
    printed: Sequence[str],
    kept: Sequence[int] = (),
    slack: int = 1,
) -> tuple[Coefficient, ...]:
    """The printed decimals made to satisfy ``conditions``, those at the places ``kept`` left as they are.

    Args:
        name: of the method.
        conditions: the coefficients, in any arithmetic that mixes with integers, to residuals.
        printed: the decimals; those kept may be fractions such as "1/66".
        kept: places in ``printed``; there are as many others as there are conditions.
        slack: how far the others may be from what is printed, in units of their last places.
    """
    unknown = [text for i, text in enumerate(printed) if i not in kept]
    coordinates = iter(
        Zero(name, partial(_completed, conditions, tuple(printed), tuple(kept)), unknown, slack).coordinates
    )
    return tuple(Fraction(text) if i in kept else next(coordinates) for i, text in enumerate(printed))


def _completed(
    conditions: Callable[[Values], Sequence[Any]], printed: Sequence[str], kept: Sequence[int], unknowns: Values
) -> Sequence[Any]:
    """The conditions on the unknowns, the kept coefficients put between them."""
    rest = iter(unknowns)
    return conditions([BALL.number(Fraction(text)) if i in kept else next(rest) for i, text in enumerate(printed)])


def proven_splitting(
    name: str,
    order: int,
    source: str,
    layout: Callable[..., Flows],
    printed: Sequence[str],
    kept: Sequence[int] = (),
    *,
    degrees: range,
    slack: int = 1,
    nystrom: bool = False,
    aliases: tuple[str, ...] = (),
) -> Splitting:
    """A splitting whose flows follow from the printed coefficients by ``layout``.

    ``degrees`` are those whose order conditions ``layout`` does not satisfy by itself: it makes kicks and drifts sum to
    1, and a palindromic one satisfies the even degrees.
    """
    conditions = partial(_splitting_conditions, layout, degrees, nystrom)
    flows = layout(*refined(name, conditions, printed, kept, slack))
    return Splitting(name, order, source, flows, aliases, nystrom=nystrom)


def _splitting_conditions(layout: Callable[..., Flows], degrees: range, nystrom: bool, values: Values) -> list[Any]:
    factors = [exponent(kind, weight) for kind, weight in layout(*values)]
    words = nystrom_words if nystrom else lyndon_words
    return [coefficient(word, factors) - 1 / arb(factorial(degree)) for degree in degrees for word in words(degree)]


def proven_composition(
    base: Splitting,
    name: str,
    order: int,
    source: str,
    printed: Sequence[str],
    kept: Sequence[int] = (),
    *,
    slack: int = 1,
    aliases: tuple[str, ...] = (),
) -> Splitting:
    """A palindromic composition of a symmetric step of order 2, whose middle weight makes the sum of the weights 1.

    ``printed`` are the weights before the middle one.
    """
    conditions = partial(_composition_conditions, range(3, order, 2))
    weights = refined(name, conditions, printed, kept, slack)
    return compose(base, jump(*weights), name, order, source, aliases)


def _composition_conditions(degrees: range, values: Values) -> list[Any]:
    factors = [{(d,): weight**d for d in range(1, degrees.stop, 2)} for weight in jump(*values)]
    return [coefficient(word, factors) for degree in degrees for word in odd_words(degree)]


def jump(*weights: Any) -> tuple[Any, ...]:
    """w1, ..., wm, 1 - 2 (w1 + ... + wm), wm, ..., w1."""
    return (*weights, 1 - 2 * sum(weights[1:], weights[0]), *reversed(weights))


def palindrome(first: str, half: Sequence[Any]) -> Flows:
    """Flows with the weights up to the middle one and back, kicks and drifts in turn, beginning with ``first``."""
    second = {"kick": "drift", "drift": "kick"}[first]
    weights = (*half, *half[-2::-1])
    return tuple((second if i % 2 else first, weight) for i, weight in enumerate(weights))
