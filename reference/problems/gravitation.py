"""Points that attract each other by Newton's law: of each pair the distance is computed once."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import Invariant, StateSpace
from reference.flow_problem import FlowProblem
from reference.problem import SeparableProblem, required

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["Gravitation", "axes_of", "conserved", "named"]

AXES = "xyz"
PLANES = {"x": "yz", "y": "zx", "z": "xy"}
"""The axes in which a component of the angular momentum turns."""


class Gravitation(FlowProblem, SeparableProblem):
    """q_i'' = G sum_j m_j (q_j - q_i)/|q_j - q_i|^3, in the plane or in space.

    The state is one coordinate of every body after the other, then their velocities alike.
    """

    bodies: ClassVar[tuple[str, ...]] = required("the names of its bodies")

    def masses(self, p: dict[str, Any]) -> Sequence[Any]:
        """The masses of the bodies by its numbers, or 1 each."""
        del p
        return (1,) * len(self.bodies)

    def constant(self, p: dict[str, Any]) -> Any:
        """G."""
        del p
        return 1

    def velocity(self, m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, p
        return tuple(momenta)

    def force(self, m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """The accelerations."""
        del t
        masses = self.masses(p)
        found: list[list[Any]] = [[] for _ in positions]
        for i, j, apart, square in self._pairs(positions):
            pull = self.constant(p) / (square * m.sqrt(square))
            for k, difference in enumerate(apart):
                drawn = difference * pull
                found[k * len(masses) + i].append(drawn * masses[j])
                found[k * len(masses) + j].append(-drawn * masses[i])
        return tuple(sum(parts[1:], parts[0]) for parts in found)

    def _pairs(self, positions: Sequence[Any]) -> Iterator[tuple[int, int, list[Any], Any]]:
        """Two bodies, the vector from the first to the second, and its squared length."""
        count = len(self.bodies)
        for i, j in combinations(range(count), 2):
            apart = [positions[k + j] - positions[k + i] for k in range(0, len(positions), count)]
            squares = [one * one for one in apart]
            yield i, j, apart, sum(squares[1:], squares[0])

    def _by_axis(self, y: Sequence[Any]) -> list[tuple[Sequence[Any], Sequence[Any]]]:
        """The coordinates and the velocities of every body by one axis after the other."""
        count, half = len(self.bodies), len(y) // 2
        return [(y[k : k + count], y[half + k : half + k + count]) for k in range(0, half, count)]

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy."""
        masses = self.masses(p)
        pairs = [masses[i] * masses[j] / m.sqrt(s) for i, j, _, s in self._pairs(y[: len(y) // 2])]
        return self.kinetic(m, y, p) - self.constant(p) * sum(pairs[1:], pairs[0])

    def kinetic(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The kinetic energy."""
        del m
        parts = [mass * (v * v) for _, rates in self._by_axis(y) for mass, v in zip(self.masses(p), rates, strict=True)]
        return sum(parts[1:], parts[0]) / 2

    def _momentum(self, axis: str, y: Sequence[Any], p: dict[str, Any]) -> Any:
        _, rates = self._by_axis(y)[AXES.index(axis)]
        parts = [mass * v for mass, v in zip(self.masses(p), rates, strict=True)]
        return sum(parts[1:], parts[0])

    def _angular(self, axis: str, y: Sequence[Any], p: dict[str, Any]) -> Any:
        (a, va), (b, vb) = (self._by_axis(y)[AXES.index(one)] for one in PLANES[axis])
        parts = [
            mass * (q * rate - other * v) for mass, q, v, other, rate in zip(self.masses(p), a, va, b, vb, strict=True)
        ]
        return sum(parts[1:], parts[0])

    def momentum_x(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total momentum along x."""
        del m
        return self._momentum("x", y, p)

    def momentum_y(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total momentum along y."""
        del m
        return self._momentum("y", y, p)

    def momentum_z(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total momentum along z."""
        del m
        return self._momentum("z", y, p)

    def angular_x(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total angular momentum about x."""
        del m
        return self._angular("x", y, p)

    def angular_y(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total angular momentum about y."""
        del m
        return self._angular("y", y, p)

    def angular_z(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total angular momentum about z."""
        del m
        return self._angular("z", y, p)


def named(bodies: Sequence[str], axes: str, prefix: str = "") -> tuple[str, ...]:
    """The names of coordinates or, with a prefix, velocities in the order of the state: x1, x2, ..., y1, y2, ..."""
    return tuple(f"{prefix}{axis}{body}" for axis in axes for body in bodies)


def axes_of(bodies: Sequence[str], axes: str, independent: str = "") -> StateSpace:
    """How the state of bodies is read; a motion turns back with its velocities."""
    rates = named(bodies, axes, "v")
    return StateSpace(
        positions=named(bodies, axes),
        velocities=rates,
        angles=(),
        odd=rates,
        along=None,
        scale="units",
        independent=independent,
    )


def conserved(axes: str, turning: str) -> tuple[Invariant, ...]:
    """Energy, total momentum by each axis, and total angular momentum: about z in the plane, else by each axis.

    Args:
        axes: of the state.
        turning: by what the change of an angular momentum is divided; "kinetic" where it may be zero at the start.
    """
    about = "z" if len(axes) == 2 else axes
    scale: Any = turning
    below = "L0" if turning == "start" else "K0"
    return (
        Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),
        *(
            Invariant(f"momentum {axis}", (f"Momentum, {axis}", "(P - P0)/K0"), "kinetic", f"momentum_{axis}")
            for axis in axes
        ),
        *(
            Invariant(
                f"angular momentum {axis}",
                (f"Angular momentum, {axis}", f"(L - L0)/{below}"),
                scale,
                f"angular_{axis}",
            )
            for axis in about
        ),
    )
