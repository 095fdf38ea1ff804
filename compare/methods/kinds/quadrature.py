"""Gauss's quadrature on [0, 1]: nodes and weights known by their enclosures, to be rounded to any format."""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb

__all__ = ["gauss_rule"]


@dataclass(frozen=True)
class _Node:
    """The i-th zero of Legendre's polynomial of a degree, moved to [0, 1]."""

    degree: int
    place: int

    def ball(self) -> arb:
        return (1 + arb.legendre_p_root(self.degree, self.place)) / 2


@dataclass(frozen=True)
class _Weight:
    """The weight that belongs to it."""

    degree: int
    place: int

    def ball(self) -> arb:
        return arb.legendre_p_root(self.degree, self.place, weight=True)[1] / 2


def gauss_rule(count: int) -> tuple[tuple[_Node, _Weight], ...]:
    """(node, weight) of the rule with ``count`` nodes: exact for polynomials of degree 2 count - 1."""
    return tuple((_Node(count, place), _Weight(count, place)) for place in range(count))
