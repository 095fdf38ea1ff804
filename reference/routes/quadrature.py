"""The quadrature route: mpmath's tanh-sinh and Gauss-Legendre rules and its elliptic functions, at fixed precision."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

    from reference.declaration import Solution

__all__ = ["rows"]


def rows(solution: Callable[[], Solution], row: str, arguments: Sequence[Any], bits: int) -> list[tuple[Fraction, ...]]:
    """The values of a row by a solution in mpmath's numbers, built and asked at ``bits`` bits of working precision."""
    with mp.workprec(bits):
        return [tuple(to_fraction(value) for value in values) for values in solution().rows(row, arguments)]
