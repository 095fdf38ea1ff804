"""Order conditions of splittings: words in the letters of what is split, and their coefficients in a product of flows.

A product of exponentials is a series of words.  It is exp(X) up to degree p where finitely many words up to degree p
have the coefficients that they have in exp(X): the Lyndon words, which generate all others by the shuffle product
(R. Ree, Ann. of Math. 68, 1958; A. Murua, Found. Comput. Math. 6, 2006).
"""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq_mat

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

__all__ = [
    "DRIFT",
    "GRADIENT",
    "KICK",
    "Word",
    "coefficient",
    "exponent",
    "lyndon_words",
    "necessary_nystrom_words",
    "nystrom_words",
    "odd_words",
]

Word: TypeAlias = tuple[Any, ...]
DRIFT, KICK, GRADIENT = "drift", "kick", "gradient"
LETTERS = (DRIFT, KICK)


def exponent(kind: str, weight: Any) -> dict[Word, Any]:
    """What a flow of a splitting is the exponential of, as a sum of words.

    A gradient is [kick, [drift, kick]] = 2 kick drift kick - kick kick drift - drift kick kick.
    """
    if kind == GRADIENT:
        return {(KICK, DRIFT, KICK): 2 * weight, (KICK, KICK, DRIFT): -weight, (DRIFT, KICK, KICK): -weight}
    return {(kind,): weight}


def coefficient(word: Word, factors: Iterable[Mapping[Word, Any]]) -> Any:
    """The coefficient of a word in the product of exp(sum of factor[piece] piece), one factor after another."""
    prefixes: list[Any] = [1, *[None] * len(word)]
    for factor in factors:
        for end in range(len(word), 0, -1):
            terms: dict[int, Any] = {end: 1}
            for power in range(1, end + 1):
                terms = _before(terms, word, factor, power)
                for begin, term in terms.items():
                    if prefixes[begin] is not None:
                        added = prefixes[begin] * term
                        prefixes[end] = added if prefixes[end] is None else prefixes[end] + added
                if not terms:
                    break
    return 0 if prefixes[-1] is None else prefixes[-1]


def _before(terms: Mapping[int, Any], word: Word, factor: Mapping[Word, Any], power: int) -> dict[int, Any]:
    """X^power/power! of the words that end where one is to begin, X the factor, by X^(power-1)/(power-1)! of those."""
    found: dict[int, Any] = {}
    for begin, term in terms.items():
        for piece, weight in factor.items():
            start = begin - len(piece)
            if start >= 0 and word[start:begin] == piece:
                added = term * weight / power
                found[start] = found[start] + added if start in found else added
    return found


def _is_lyndon(word: Word) -> bool:
    """Whether the word comes before all its proper ends."""
    return all(word < word[i:] for i in range(1, len(word)))


@cache
def lyndon_words(degree: int) -> tuple[Word, ...]:
    """The Lyndon words of ``degree`` letters: 2, 1, 2, 3, 6, 9, 18, 30, 56, 99, ... of them."""
    return tuple(word for word in product(LETTERS, repeat=degree) if _is_lyndon(word))


@cache
def odd_words(degree: int) -> tuple[Word, ...]:
    """The Lyndon words in the letters 1, 3, 5, ... whose sum is ``degree``: one each for 1 and 3, then 2, 4, 8 for 9.

    They are the order conditions of a palindromic composition of symmetric steps: letter d is the method's error of
    degree d, the letter 1 the exact flow.
    """
    return tuple(word for word in _odd_sums(degree) if _is_lyndon(word))


def _odd_sums(degree: int) -> Iterable[Word]:
    if degree == 0:
        yield ()
    for first in range(1, degree + 1, 2):
        for rest in _odd_sums(degree - first):
            yield (first, *rest)


def nystrom_words(degree: int) -> tuple[Word, ...]:
    """Words whose coefficients decide the order where the velocity is linear in the momenta: 2, 1, 2, 2, 4, 5, 10, ...

    There [kick, [kick, [kick, drift]]] = 0, so that only functionals of series that vanish on the ideal of this bracket
    matter.  A word in which no four neighbours are three kicks and a drift is one; of these as many are taken as are
    independent on the Lie elements of the degree, which must be as many as there are beside the ideal.

    Raises:
        ArithmeticError: such words are too few, as they are in degree 9 and beyond.
    """
    chosen, needed = necessary_nystrom_words(degree)
    if len(chosen) != needed:
        raise ArithmeticError(f"{len(chosen)} words decide degree {degree}, {needed} are needed.")
    return chosen


@cache
def necessary_nystrom_words(degree: int) -> tuple[tuple[Word, ...], int]:
    """Independent words of which none may fail, and how many would decide the degree."""
    elements = [_bracketed(word) for word in lyndon_words(degree)]
    chosen: list[Word] = []
    rows: list[list[int]] = []
    for word in sorted(_outside_the_ideal(degree), key=lambda word: (not _is_lyndon(word), word)):
        row = [element.get(word, 0) for element in elements]
        if _rank([*rows, row]) > len(rows):
            chosen.append(word)
            rows.append(row)
    words = list(product(LETTERS, repeat=degree))
    ideal = _rank([[element.get(word, 0) for word in words] for element in _ideal(degree)])
    return tuple(chosen), len(elements) - ideal


def _outside_the_ideal(degree: int) -> Iterable[Word]:
    for word in product(LETTERS, repeat=degree):
        if all(word[i : i + 4].count(KICK) != 3 for i in range(degree - 3)):
            yield word


Element: TypeAlias = "dict[Word, int]"
"""A Lie element as a sum of words."""


def _commutator(x: Element, y: Element) -> Element:
    result: Element = {}
    for (a, p), (b, q) in product(x.items(), y.items()):
        result[a + b] = result.get(a + b, 0) + p * q
        result[b + a] = result.get(b + a, 0) - p * q
    return result


def _bracketed(word: Word) -> Element:
    """The Lie element of a Lyndon word, bracketed before its longest proper Lyndon end."""
    if len(word) == 1:
        return {word: 1}
    cut = next(i for i in range(1, len(word)) if _is_lyndon(word[i:]))
    return _commutator(_bracketed(word[:cut]), _bracketed(word[cut:]))


def _ideal(degree: int) -> list[Element]:
    """Elements that span the ideal of [kick, [kick, [kick, drift]]] in one degree."""
    kick: Element = {(KICK,): 1}
    bracket: Element = {(DRIFT,): 1}
    for _ in range(3):
        bracket = _commutator(kick, bracket)
    elements = [bracket] if degree > 3 else []
    for _ in range(4, degree):
        elements = [_commutator({(letter,): 1}, element) for element in elements for letter in LETTERS]
    return elements


def _rank(rows: Sequence[Sequence[int]]) -> int:
    if not rows:
        return 0
    return int(fmpq_mat(len(rows), len(rows[0]), [entry for row in rows for entry in row]).rank())
