"""What the problems of the nonstiff DETEST have in common.

T. E. Hull, W. H. Enright, B. M. Fellen and A. E. Sedgwick, SIAM Journal on Numerical Analysis 9 (1972), 603, chose
them; W. H. Enright and J. D. Pryce, ACM Transactions on Mathematical Software 13 (1987), 28, published them as
programs, Algorithm 648, whose equations, decimals and names are taken here.  All begin at the time 0 and end at 20.
The class F of the same algorithm, whose right sides are not smooth, is not of these.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from reference.declaration import StateSpace
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reference.declaration import Invariant

__all__ = ["Nonstiff", "components", "first_order", "second_order"]


class Nonstiff(FlowProblem):
    """A problem of the set, from the time 0 to 20; its components are y1, y2, ... as in Algorithm 648."""

    numbers: ClassVar[Mapping[str, str]] = {}
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    t_end = 20.0
    source = (
        "T. E. Hull, W. H. Enright, B. M. Fellen and A. E. Sedgwick, SIAM J. Numer. Anal. 9 (1972), 603; "
        "W. H. Enright and J. D. Pryce, ACM Trans. Math. Softw. 13 (1987), 28 (Algorithm 648)"
    )
    words: ClassVar[str]
    """What it is, in a few words."""


def components(count: int, first: int = 1) -> tuple[str, ...]:
    """The names of so many components."""
    return tuple(f"y{i}" for i in range(first, first + count))


def first_order(count: int, odd: tuple[str, ...] | None = None) -> StateSpace:
    """A state of which no component is the rate of another."""
    return StateSpace(positions=components(count), angles=(), odd=odd, along=None, scale="units", independent="")


def second_order(count: int, *, reversible: bool) -> StateSpace:
    """A state of so many positions, then their velocities."""
    velocities = components(count, count + 1)
    return StateSpace(
        positions=components(count),
        velocities=velocities,
        angles=(),
        odd=velocities if reversible else None,
        along=None,
        scale="units",
        independent="",
    )
