"""The order conditions of a Runge-Kutta method of many stages, with what trees have in common reckoned once.

A tree of k vertices with the subtrees u1, ..., um at its root asks for sum_i b_i psi_i = 1/k, where stage by stage
psi = sigma(u1) ... sigma(um), and sigma(u) = |u| A psi(u).  Subtrees of one size whose sigma is the same are one to
every greater tree, and a product of matrices meets all trees that have one of the same subtrees: so the 53,000
conditions up to order 14 take seconds, and none is left out.

In balls, vectors that agree to AGREED_BITS bits are taken as one ball around them: what comes of it encloses what comes
of each of them.

See J. C. Butcher, Numerical Methods for Ordinary Differential Equations (2016), section 31.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, count
from operator import mul
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb, arb_mat, fmpq, fmpq_mat

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["StageVectors"]

AGREED_BITS = 150
KEY_PLACES = 6
Vector: TypeAlias = Sequence[Any]


class ExactMatrix:
    """A matrix of numbers of any exact kind, with what is used here of python-flint's."""

    def __init__(self, height: int, width: int, entries: Sequence[Any]) -> None:
        self._rows = [entries[i * width : (i + 1) * width] for i in range(height)]

    def transpose(self) -> ExactMatrix:
        return ExactMatrix(len(self._rows[0]), len(self._rows), list(chain(*zip(*self._rows, strict=True))))

    def __mul__(self, other: ExactMatrix) -> ExactMatrix:
        columns = list(zip(*other.tolist(), strict=True))
        pairs = (zip(row, column, strict=True) for row in self._rows for column in columns)
        entries = [sum((x * y for x, y in some if x and y), 0) for some in pairs]
        return ExactMatrix(len(self._rows), len(columns), entries)

    def tolist(self) -> list[Vector]:
        return self._rows


class StageVectors:
    """What the trees make of the stages of a matrix, whose entries are ``fmpq``, or balls, or of another exact kind.

    Attributes:
        matrix: its rows.
    """

    def __init__(self, matrix: Sequence[Vector]) -> None:
        kinds = {type(entry) for row in matrix for entry in row if entry != 0}
        self._in_balls = arb in kinds
        self._kind: Any = arb_mat if self._in_balls else fmpq_mat if kinds <= {fmpq} else ExactMatrix
        self.matrix = matrix
        self._matrix = self._of_rows(matrix)
        self._none = (1,) * len(matrix)
        self._known_groups: dict[tuple[int, int], list[list[Vector]]] = {}
        self._known_sigmas: dict[int, list[Vector]] = {}
        self._known_images: dict[int, Any] = {}

    def residuals(self, b: Vector, order: int) -> Iterator[Any]:
        """k sum_i b_i psi_i - 1 for all trees with k = ``order`` vertices, those with small subtrees first."""
        if order == 1:
            yield sum(b[1:], b[0]) - 1
        for size in range(1, order):
            rests = self._forests(order - 1 - size, size)
            weights = self._of_rows([list(map(mul, b, rest)) for rest in rests])
            for row in (weights * self._images(size)).tolist():
                yield from (order * size * value - 1 for value in row)

    def _images(self, size: int) -> Any:
        """A psi of the trees with ``size`` vertices, a column for each."""
        if size not in self._known_images:
            self._known_images[size] = self._matrix * self._of_rows(self._forests(size - 1, size - 1)).transpose()
        return self._known_images[size]

    def _sigmas(self, size: int) -> list[Vector]:
        """The vectors sigma of the trees with ``size`` vertices, each once."""
        if size not in self._known_sigmas:
            images = self._images(size).transpose().tolist()
            sigmas = [tuple(size * x for x in image) for image in images]
            self._known_sigmas[size] = _joined(sigmas) if self._in_balls else list(dict.fromkeys(sigmas))
        return self._known_sigmas[size]

    def _forests(self, vertices: int, largest: int) -> list[Vector]:
        """The products of sigmas of subtrees with ``vertices`` vertices in all, none of more than ``largest``."""
        if vertices == 0:
            return [self._none]
        return list(
            chain(*(group for size in range(1, min(vertices, largest) + 1) for group in self._groups(vertices, size)))
        )

    def _groups(self, vertices: int, size: int) -> list[list[Vector]]:
        """Those with a largest subtree of this size, a group for each sigma that is the last of them."""
        if (vertices, size) not in self._known_groups:
            rest = vertices - size
            smaller = self._forests(rest, size - 1)
            equal = self._groups(rest, size) if rest >= size else []
            self._known_groups[vertices, size] = [
                [tuple(map(mul, sigma, psi)) for psi in chain(smaller, *equal[: i + 1])]
                for i, sigma in enumerate(self._sigmas(size))
            ]
        return self._known_groups[vertices, size]

    def _of_rows(self, rows: Sequence[Vector]) -> Any:
        return self._kind(len(rows), len(rows[0]), list(chain(*rows)))


def _joined(vectors: Sequence[Vector]) -> list[Vector]:
    """Balls around those vectors that agree, each vector in one of them."""
    found: dict[float, list[Vector]] = {}
    for vector in vectors:
        same = found.setdefault(round(float(sum(map(mul, vector, count(1)))), KEY_PLACES), [])
        for i, other in enumerate(same):
            both = tuple(x.union(y) for x, y in zip(vector, other, strict=True))
            if max(x.rad() for x in both) < arb(2) ** -AGREED_BITS:
                same[i] = both
                break
        else:
            same.append(vector)
    return list(chain(*found.values()))
