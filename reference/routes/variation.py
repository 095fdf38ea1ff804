"""df/dy about the polynomials of a step of a flow, and the derivative of the step's map by its start.

Both are of rules 10, 11 and 13 of docs/flows.md: how errors grow in a tube, and V' = h df/dy V.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from flint import arb, arb_mat, arb_poly

from reference.arithmetic.balls import BALL
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.models import (
    Function,
    ModelArithmetic,
    Node,
    RefusedError,
    Tape,
    Variable,
    bound,
    rounded,
    supremum,
)
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.declaration import Equation

__all__ = [
    "PARTS",
    "VARIATIONAL_BITS",
    "Step",
    "Variation",
    "entry",
    "grown",
    "larger",
    "log2",
    "order_of",
    "orthogonal",
    "part",
    "sizes",
    "times",
    "unit",
    "upper",
]

VARIATIONAL_BITS = 53
"""df/dy is read in so many bits, and the derivative of a step's map found in doubles: errors need no more."""
PARTS = 2
"""Parts of a step on each of which df/dy is enclosed."""
DECAY = 1.4
"""Terms fall off by e^DECAY from one to the next where a step has its length: longer steps take more terms."""
MOST_TERMS = 128
"""Terms of the derivative of a step's map, at most: it is nearly an exponential, and a stiff one takes many."""


class Variation:
    """df/dy about the polynomials of a step, read once in nodes of ``bits`` bits; and the derivative of the step's map
    by its start, from the variational equation V' = h df/dy V (rule 13).
    """

    def __init__(self, equation: Equation, bits: int = VARIATIONAL_BITS) -> None:
        self._bits, self._order = bits, order_of(bits)
        self._tape = Tape()
        self._size = size = len(equation.state_names)
        self._known: list[list[arb]] = []
        self._h = arb(0)
        with ctx.workprec(bits):
            duals: Any = DualArithmetic(ModelArithmetic(self._tape), size)  # type: ignore[arg-type]
            variables = [Variable(self._tape, lambda k, i=i: self._known[i][k]) for i in range(size + 1)]  # type: ignore[misc]
            state = [duals.variable(one, i) for i, one in enumerate(variables[:-1])]
            p = {name: BALL.number(value) for name, value in equation.parameters.items()}
            rates = equation.derivative(duals, variables[-1], state, p)
            zeros = (arb(0),) * size
            self._rows = [[entry(one) for one in (rate.slopes if isinstance(rate, Dual) else zeros)] for rate in rates]
            values = [entry(rate.value if isinstance(rate, Dual) else rate) for rate in rates]
        self._constants = [
            one for one in (*values, *(one for row in self._rows for one in row)) if isinstance(one, arb)
        ]
        self._tape.keep([*variables, *(one for row in (values, *self._rows) for one in row)])

    def follow(self, polynomials: Sequence[arb_poly], time: arb, h: arb) -> None:
        """Take the polynomials of a step, in no more terms and bits than these.

        Raises:
            RefusedError: what is constant in the equation or its derivative is not finite.
        """
        if not all(one.is_finite() for one in self._constants):
            raise RefusedError("the equation or its derivative is not finite")
        with ctx.workprec(self._bits):
            self._known = [rounded(one, self._order) for one in polynomials]
            self._cut = [supremum(one - arb_poly(known)) for one, known in zip(polynomials, self._known, strict=True)]
            clock = [(time * 1).mid(), (h * 1).mid()]
            self._cut.append(bound((time - clock[0]).abs_upper() + (h - clock[1]).abs_upper()))
            self._known.append([*clock, *[arb(0)] * (self._order - 1)])
            self._h = h
            self._tape.begin()
            self._tape.fill(self._order)

    def close(self, room: Sequence[arb]) -> None:
        """Enclose f and df/dy at all that is within the room of the polynomials.

        Raises:
            RefusedError: they are not known to be finite there.
        """
        self._tape.close([bound(one + cut) for one, cut in zip((*room, arb(0)), self._cut, strict=True)])

    def slopes(self, s: arb) -> list[list[arb]]:
        """h df/dy there, on a part of the step."""
        return [
            [self._h * (one.polynomial(s) + arb(0, one.remainder) if isinstance(one, Node) else one) for one in row]
            for row in self._rows
        ]

    def derivative(self, growth: arb_mat) -> arb_mat:
        """What the derivative of the step's map lies in, at every start of which the solution is in the room."""
        return self.step(growth).at(arb(1))

    def step(self, growth: arb_mat) -> Step:
        """The derivative of the solution on the step by its start there (rule 13)."""
        polynomials = self._in_doubles() if self._bits <= VARIATIONAL_BITS else self._in_balls()
        size, defects = range(self._size), self._defects(polynomials)
        columns = [times(growth, [defects[i][j] for i in size]) for j in size]
        return Step(polynomials, [[columns[j][i] for j in size] for i in size])

    def _slopes(self, zero: Any, number: Callable[[arb], Any]) -> list[list[list[Any]]]:
        """The coefficients of df/dy by entry, as many of each."""
        terms = len(self._known[0])
        return [
            [
                [*map(number, one.terms if isinstance(one, Node) else [one.mid()]), *[zero] * (terms - 1)][:terms]
                for one in row
            ]
            for row in self._rows
        ]

    def _in_doubles(self) -> list[list[arb_poly]]:
        """V, about which nothing is claimed: (k + 1) V_{k+1} = h sum_i J_i V_{k-i}."""
        from reference.arithmetic.arrays import np

        size, terms = self._size, len(self._known[0])
        flat = float(self._h) * np.array(self._slopes(0.0, float)).transpose(0, 2, 1).reshape(size, -1)
        order = self._order_for(np.abs(flat[:, :size]).sum(axis=1).max())
        backward = np.zeros(((order + 1) * size, size))  # V_order, ..., V_0, one below the other
        backward[-size:] = np.eye(size)
        for k in range(order):
            at, used = (order - k) * size, min(k + 1, terms) * size
            backward[at - size : at] = flat[:, :used] @ backward[at : at + used] / (k + 1)
        found = backward.reshape(order + 1, size, size)[::-1]
        return [[arb_poly(found[:, i, j].tolist()) for j in range(size)] for i in range(size)]

    def _in_balls(self) -> list[list[arb_poly]]:
        """The same in as many bits as it is read in."""
        size, h = range(self._size), self._h
        slopes = self._slopes(arb(0), lambda term: (h * term).mid())
        varied = [i for i in size if any(isinstance(one, Node) for one in self._rows[i])]
        first = arb_mat([[one[0] for one in row] for row in slopes])
        others = [arb_mat([[one[k] for one in slopes[i]] for i in varied]) for k in range(1, len(slopes[0][0]))]
        order = self._order_for(max(sum(float(abs(one[0])) for one in row) for row in slopes))
        found = [unit(self._size)]
        for k in range(order):
            moved = (first * found[k]).tolist()
            if varied:
                pairs = zip(others[:k], reversed(found[:k]), strict=False)
                more = sum((slope * one for slope, one in pairs), arb_mat(len(varied), self._size)).tolist()
                for i, row in zip(varied, more, strict=True):
                    moved[i] = [one + other for one, other in zip(moved[i], row, strict=True)]
            found.append((arb_mat(moved) / (k + 1)).mid())
        entries = [one.entries() for one in found]
        return [[arb_poly([one[i * self._size + j] for one in entries]) for j in size] for i in size]

    def _order_for(self, stretch: float) -> int:
        """Terms of the exponential of a matrix of this norm, to as many bits."""
        order, size = self._order, math.log2(max(1.0, stretch))
        while order < MOST_TERMS and order * size - math.lgamma(order + 1) / math.log(2) > -self._bits:
            order += self._order // 4
        return order

    def _defects(self, polynomials: Sequence[Sequence[arb_poly]]) -> list[list[arb]]:
        """Bounds of |V' - h J V| on the step, entry by entry (rules 1, 2 and 9)."""
        h, norms = self._h, [[supremum(one) for one in row] for row in polynomials]
        found = []
        for moved, row in zip(polynomials, self._rows, strict=True):
            known = [
                (k, one.polynomial, one.remainder) if isinstance(one, Node) else (k, arb_poly([one]), arb(0))
                for k, one in enumerate(row)
                if isinstance(one, Node) or not one.is_zero()
            ]
            bounds = []
            for j, one in enumerate(moved):
                turned = sum((slope * polynomials[k][j] for k, slope, _ in known), arb_poly())
                off = supremum(one.derivative() - h * turned)
                missed = sum((remainder * norms[k][j] for k, _, remainder in known), arb(0))
                bounds.append(bound(off + abs(h) * missed))
            found.append(bounds)
        return found


@dataclass(frozen=True)
class Step:
    """The derivative of the solution on a step by its start: within ``errors`` of the polynomials, entry by entry."""

    polynomials: list[list[arb_poly]]
    errors: list[list[arb]]

    def at(self, s: arb) -> arb_mat:
        """It, in balls."""
        rows = zip(self.polynomials, self.errors, strict=True)
        return arb_mat([[one(s) + arb(0, off) for one, off in zip(*row, strict=True)] for row in rows])


def log2(value: arb) -> float:
    """log2 of the size of an exact number, which is not zero, to within one."""
    mantissa, exponent = value.man_exp()
    return float(abs(int(mantissa)).bit_length() + int(exponent))


def order_of(bits: int) -> int:
    """Terms of polynomials of which each is e^DECAY times as small as that before it, to so many bits."""
    return math.ceil(bits * math.log(2) / DECAY)


def _constant(value: Any) -> arb:
    return BALL.number(value) if isinstance(value, Fraction) else arb(value)


def entry(value: Any) -> Node | arb:
    """What was read of an equation: a node, or a number."""
    return value.node if isinstance(value, Function) else _constant(value)


def part(j: int) -> arb:
    """The j-th part of [0, 1]."""
    return (arb(2 * j + 1) + arb(0, 1)) / (2 * PARTS)


def larger(a: arb, b: arb) -> arb:
    """The larger of two exact numbers, neither of which is NaN."""
    return max(b, a)


def _positive(slopes: Sequence[Sequence[arb]]) -> list[list[arb]]:
    """|h df/dy| apart from the diagonal, and on it the positive part of its upper end; all are finite."""
    return [
        [larger(value.upper(), arb(0)) if i == j else value.abs_upper() for j, value in enumerate(row)]
        for i, row in enumerate(slopes)
    ]


def upper(matrix: arb_mat) -> arb_mat:
    """The upper ends of a matrix that has no negative entry, whatever its balls hold besides."""
    return arb_mat([[larger(bound(value), arb(0)) for value in row] for row in matrix.tolist()])


def sizes(matrix: arb_mat) -> arb_mat:
    """The bounds of the entries' sizes."""
    return arb_mat([[bound(value.abs_upper()) for value in row] for row in matrix.tolist()])


def times(matrix: arb_mat, vector: Sequence[arb]) -> list[arb]:
    """Bounds of a matrix without negative entries times a vector of bounds."""
    return [bound(row[0]) for row in (matrix * arb_mat([[value] for value in vector])).tolist()]


def grown(parts: Sequence[Sequence[Sequence[arb]]]) -> arb_mat:
    """How errors grow over the parts of a step, of each of which the slopes are given (rule 10)."""
    found = unit(len(parts[0]))
    for slopes in parts:
        found = upper((arb_mat(_positive(slopes)) / PARTS).exp() * found)
    return found


def unit(size: int) -> arb_mat:
    """The unit matrix."""
    return arb_mat([[arb(int(i == j)) for j in range(size)] for i in range(size)])


def orthogonal(matrix: arb_mat, lengths: Sequence[arb] | None = None) -> arb_mat:
    """Exact columns that are about orthonormal, from those of the matrix in order, or the longest ones first where
    lengths to multiply them by are given; the unit matrix where they are beyond the range of doubles.
    """
    from reference.arithmetic.arrays import np

    size = matrix.nrows()
    columns = np.array([float(one.mid()) for one in matrix.entries()]).reshape(size, size)
    norms = np.abs(columns).max(axis=0)
    if not (np.isfinite(norms).all() and norms.all()):
        return unit(size)
    order = np.arange(size)
    if lengths is not None:
        logs = [log2(length) if length != 0 else -math.inf for length in lengths]
        order = np.argsort(-(np.log2(norms) + logs), kind="stable")
    return arb_mat(np.linalg.qr(columns[:, order] / norms[order])[0].tolist())
