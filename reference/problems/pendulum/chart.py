"""The pendulum's state at many times: the closed form at nodes around one period, and a short way from the nearest.

From a node with s = sin(theta/2), c = cos(theta/2) and p = theta'/(2 w) the addition theorem of ``motions`` leads to
any time near it, with S = sn(w dt) by its Maclaurin polynomial, C = sqrt(1 - S^2) and D = sqrt(1 - k^2 S^2).  All is in
balls, so that every state encloses the exact one; what its balls do not decide is left to the closed form.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from flint import arb

from reference.arithmetic.elliptic import sine_polynomial
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.problems.pendulum.motions import Rotation, addition

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.problems.pendulum.motions import Libration

__all__ = ["MANY", "Chart", "chart"]

MANY = 128
"""Times from which a chart pays."""
TIMES_A_NODE = 24
WIDEST = 1 / 8
"""The largest half-width of a node's surroundings in the argument v of Jacobi's functions of a modulus below 1.

theta/2 changes by no more than v there, so that a node's arctangent keeps its branch; sn v converges for |v| < pi/2.
A half-width proven to be below twice as much serves as well.
"""
SPARE_BITS = 12
"""Bits that the arithmetic of one state may lose."""
FARTHEST = 2.0**52
"""Nodes are counted in floats up to here."""
UNIT = arb(0, 1)


class Node(NamedTuple):
    """The orbit at one time: its half-angle by sine and cosine, its rate, and what the arctangent leaves out."""

    s: arb
    c: arb
    p: arb
    lower: bool
    """Whether |c| >= |s|: the arctangent of s/c is taken, else that of -c/s."""
    offset: arb


def chart(form: Libration | Rotation, count: int, bits: int) -> Chart | None:
    """The chart for ``count`` times, to about ``bits`` bits where nothing cancels; None where it would not pay."""
    needed = math.ceil(float(form.period * form.w * _scale(form)) / (2 * WIDEST))
    if count < max(MANY, 3 * needed):
        return None
    found = Chart(form, max(needed, count // TIMES_A_NODE), bits)
    return found if found.half_width < 2 * WIDEST else None


def _scale(form: Libration | Rotation) -> arb:
    """v by w t, v the argument of Jacobi's functions of the modulus k or 1/k."""
    return form.modulus if isinstance(form, Rotation) else arb(1)


class Chart:
    """States of libration or rotation by a number of nodes around one period.

    Times are counted in half-widths of a node's surroundings: ``pace`` a second, nodes at the even numbers.
    """

    def __init__(self, form: Libration | Rotation, nodes: int, bits: int) -> None:
        self._form, self._nodes, self._bits = form, nodes, bits
        self._pace = 2 * nodes / form.period
        self.half_width = form.w * _scale(form) / self._pace
        self._sine = sine_polynomial(form.elliptic.k, self.half_width, bits) * (1 / _scale(form))
        self._twice_w, self._square = 2 * form.w, form.modulus**2
        self._advance = 2 * form.direction * arb.pi() if isinstance(form, Rotation) else None
        self._known: dict[int, Node] = {}

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        """The states at exact times; not a number where the nearest node is not certain."""
        del row
        places = [self._place(BALL.number(t) * self._pace) for t in arguments]
        with ctx.workprec(self._bits + SPARE_BITS):
            return [self._state(*place) for place in places]

    def _place(self, y: arb) -> tuple[Node, arb, int]:
        """The nearest node, the way from it in [-1, 1], and the whole periods before it."""
        middle = float(y) / 2
        nearest = round(middle) if abs(middle) < FARTHEST else 0
        x = y - 2 * nearest
        periods, number = divmod(nearest, self._nodes)
        return self._known.get(number) or self._at(number), x if x in UNIT else arb.nan(), periods

    def _state(self, node: Node, x: arb, periods: int) -> tuple[arb, arb]:
        sn = x * self._sine(x * x)
        square = sn * sn
        cn, dn = (1 - square).sqrt(), (1 - self._square * square).sqrt()
        sine, cosine, rate, scale = addition(node.s, node.c, node.p, sn, cn, dn)
        half = (sine / cosine).atan() if node.lower else -(cosine / sine).atan()
        theta = 2 * half + node.offset
        if self._advance is not None:
            theta = theta + periods * self._advance
        return theta, self._twice_w * rate / scale

    def _at(self, number: int) -> Node:
        """Compute a node, with the turns that its angle has made since the start."""
        form, pi = self._form, arb.pi()
        sn, cn, dn = form.functions(form.w * (2 * number / self._pace))
        sine, cosine, rate, scale = addition(form.s, form.c, form.p, sn, cn, dn)
        s, c, p = sine / scale, cosine / scale, rate / scale
        lower = bool(abs(c) >= abs(s))
        half = form.half + arb.atan2(s * form.c - c * form.s, c * form.c + s * form.s)
        quarter = 0 if lower else pi / 2
        turns = BALL.floor((half - quarter) / pi + arb(0.5))
        self._known[number] = Node(s, c, p, lower, 2 * (quarter + (turns + form.turns) * pi))
        return self._known[number]
