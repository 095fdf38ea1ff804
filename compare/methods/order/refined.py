"""Splittings from printed decimals: as many coefficients as there are order conditions are made to satisfy them.

The others are free parameters of the method, and are taken to be exactly what is printed.
"""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from math import factorial
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb

from compare.methods.kinds.one_step import Processed, Splitting, around, compose
from compare.methods.order.certified_roots import Zero
from compare.methods.order.lyndon_words import KICK, coefficient, exponent, lyndon_words, nystrom_words, odd_words
from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.methods.order.algebraic import Coefficient
    from compare.methods.order.lyndon_words import Word

__all__ = ["jump", "palindrome", "proven_composition", "proven_processed", "proven_splitting", "refined"]

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
    generalised: tuple[int, ...] = (),
    aliases: tuple[str, ...] = (),
) -> Splitting:
    """A splitting whose flows follow from the printed coefficients by ``layout``.

    ``degrees`` are those whose order conditions ``layout`` does not satisfy by itself: it makes kicks and drifts sum to
    1, and a palindromic one satisfies the even degrees.  Where a generalised order is stated, the conditions are its.
    """
    conditions = partial(_splitting_conditions, layout, degrees, nystrom, generalised)
    flows = layout(*refined(name, conditions, printed, kept, slack))
    return Splitting(name, order, source, flows, aliases, nystrom=nystrom, generalised=generalised)


def proven_processed(
    name: str,
    order: int,
    source: str,
    layout: Callable[..., tuple[Flows, Flows]],
    printed: Sequence[str],
    kept: Sequence[int],
    *,
    degrees: range,
    implied: int,
    slack: int = 1,
    nystrom: bool = False,
    generalised: tuple[int, ...] = (),
    aliases: tuple[str, ...] = (),
) -> Processed:
    """A processed splitting, whose processor and kernel follow from the printed coefficients by ``layout``.

    The flow of the equation itself is free in a processor, so that one of the conditions follows from the others: the
    one at the place ``implied``.
    """
    conditions = partial(_processed_conditions, layout, degrees, nystrom, generalised, implied)
    processor, kernel = layout(*refined(name, conditions, printed, kept, slack))
    return Processed(
        name, order, source, around(kernel, processor), aliases,
        nystrom=nystrom, generalised=generalised, processor=processor, kernel=kernel,
    )  # fmt: skip


def _processed_conditions(
    layout: Callable[..., tuple[Flows, Flows]],
    degrees: range,
    nystrom: bool,
    generalised: tuple[int, ...],
    implied: int,
    values: Values,
) -> list[Any]:
    def flows(*each: Any) -> Flows:
        processor, kernel = layout(*each)
        return (*processor, *kernel, *((kind, -weight) for kind, weight in reversed(processor)))

    found = _splitting_conditions(flows, degrees, nystrom, generalised, values)
    return found[:implied] + found[implied + 1 :]


def _splitting_conditions(
    layout: Callable[..., Flows], degrees: range, nystrom: bool, generalised: tuple[int, ...], values: Values
) -> list[Any]:
    factors = [exponent(kind, _ball(weight)) for kind, weight in layout(*values)]
    words = nystrom_words if nystrom and not generalised else lyndon_words
    asked = ((degree, word) for degree in degrees for word in words(degree) if _is_asked(word, generalised))
    return [coefficient(word, factors) - 1 / arb(factorial(degree)) for degree, word in asked]


def _ball(weight: Any) -> Any:
    """What is exact in a layout as a ball, beside which it stands."""
    return BALL.number(weight) if isinstance(weight, Fraction) else weight


def _is_asked(word: Word, generalised: tuple[int, ...]) -> bool:
    """Whether the power of epsilon that a word's kicks make is to vanish at its degree."""
    return not generalised or len(word) <= generalised[min(word.count(KICK), len(generalised)) - 1]


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
