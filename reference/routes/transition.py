"""The derivatives of a flow by its start, the state transition matrix, carried from piece to piece.

On a piece they are V(s) Phi, with V from the variational equation about it and Phi what they are at its begin.  Phi is
kept as Q R, Q about orthogonal and R about triangular: docs/flows.md has it as rule 18.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.balls import BALL
from reference.arithmetic.precision import ctx
from reference.routes.proven_flow import KEPT, LEAST_BITS, FlowSolution
from reference.routes.variation import PARTS, Variation, grown, orthogonal, part, unit

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from flint import arb_mat

    from reference.routes.proven_flow import ProvenFlow
    from reference.routes.variation import Step

__all__ = ["Transition", "TransitionSolution", "frobenius"]


@dataclass(frozen=True)
class _Carried:
    """The derivatives on a piece: step(s) q r."""

    step: Step
    q: arb_mat
    r: arb_mat

    def at(self, s: arb) -> arb_mat:
        return (self.step.at(s) * self.q) * self.r


class Transition:
    """The derivatives of the state of a flow by its start on one side, as far as they are asked for."""

    def __init__(self, flow: ProvenFlow, sign: int) -> None:
        self._flow, self._sign = flow, sign
        _, lost = flow.lost(sign)
        bits = max(flow.bits - int(lost), min(flow.bits, LEAST_BITS))  # what is lost of them need not be known
        self._variation = Variation(flow.equation, bits)
        self._carried: list[_Carried] = []
        size = len(flow.equation.state_names)
        self._q, self._r = unit(size), unit(size)

    def at(self, time: Fraction) -> arb_mat:
        """The matrix at a time of the side, in balls: the derivatives of the i-th component in the i-th row.

        Raises:
            WorkBoundError: the flow is not proven so far.
        """
        place = self._flow.place(time)
        with ctx.workprec(self._flow.bits):
            while len(self._carried) <= place:
                self._carry()
            piece = self._flow.pieces(self._sign)[place]
            return self._carried[place].at(BALL.number((time - piece.t) / piece.h))

    def _carry(self) -> None:
        """On to the next piece."""
        piece, variation = self._flow.pieces(self._sign)[len(self._carried)], self._variation
        variation.follow(piece.polynomials, BALL.number(piece.t), BALL.number(piece.h))
        variation.close(piece.errors)
        step = variation.step(grown([variation.slopes(part(j)) for j in range(PARTS)]))
        self._carried.append(_Carried(step, self._q, self._r))
        turned = step.at(arb(1)) * self._q
        self._q = orthogonal(turned)
        self._r = (self._q.inv() * turned) * self._r


@lru_cache(maxsize=KEPT)
def _transition(flow: ProvenFlow, sign: int) -> Transition:
    """It, kept for a while."""
    return Transition(flow, sign)


class TransitionSolution(FlowSolution):
    """The derivatives of a problem's state by its start, row by row, at the precision in force."""

    def read(self, flow: ProvenFlow, time: Fraction) -> tuple[arb, ...]:
        return tuple(_transition(flow, -1 if time < 0 else 1).at(time).entries())

    def unread(self) -> tuple[arb, ...]:
        return super().unread() * len(super().unread())


def frobenius(m: Any, derivatives: Sequence[Any]) -> Any:
    """The Frobenius norm of a matrix: of the derivatives by the start, how far errors of the start are carried."""
    return m.sqrt(sum((one * one for one in derivatives[1:]), derivatives[0] * derivatives[0]))
