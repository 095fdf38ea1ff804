"""Arenstorf's periodic orbit of the restricted three-body problem: a satellite between the Earth and the Moon."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.binary64 import nearest
from reference.arithmetic.exact import exact
from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILIES", "Arenstorf", "ArenstorfBinary64"]


MU, START = "0.012277471", ("0.994", "0", "0", "-2.00158510637908252240537862224")
"""As they are printed."""


class Arenstorf(FlowProblem):
    """x'' = x + 2 y' - nu (x + mu)/r1^3 - mu (x - nu)/r2^3, y'' = y - 2 x' - nu y/r1^3 - mu y/r2^3, nu = 1 - mu.

    r1^2 = (x + mu)^2 + y^2 and r2^2 = (x - nu)^2 + y^2 are the squared distances from the Earth and from the Moon, in a
    frame that turns with both.  R. F. Arenstorf, American Journal of Mathematics 85 (1963), 27; the numbers, to every
    digit printed, are those of E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I,
    Springer 1993, section II.0, equations (0.1) and (0.2), with the period 17.0652165601579625588917206249.  The
    decimals are the inputs here; those that a program reads are others, by up to 2^-53 of themselves: see
    ArenstorfBinary64.
    """

    name = "arenstorf"
    space = StateSpace(
        positions=("x", "y"),
        velocities=("vx", "vy"),
        angles=(),
        odd=("y", "vx"),
        along=None,
        scale="units",
        independent="",
    )
    numbers: ClassVar[dict[str, str]] = {"mu": MU}
    begins: ClassVar[tuple[str, ...]] = START
    equation = (
        "x'' = x + 2 y' - nu (x + mu)/r1^3 - mu (x - nu)/r2^3, y'' = y - 2 x' - nu y/r1^3 - mu y/r2^3, nu = 1 - mu"
    )
    invariants = (Invariant("Jacobi constant", ("Jacobi constant", "(C - C0)/C0"), "start", "jacobi_constant"),)
    t_end = "17.0652165601579625588917206249"
    until = "34.1304331203159251177834412498"
    source = "E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 1993, section II.0"
    difficulty = "higher: near encounters with the Moon need steps a thousand times shorter, and multiply errors"
    meanings: ClassVar[dict[str, str]] = {
        "mu": "mass of the Moon, as a part of both",
        "x": "position along the line from the Earth to the Moon",
        "y": "position across it",
        "vx": "velocity along that line",
        "vy": "velocity across it",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t
        x, y_, vx, vy = y
        mu, nu = p["mu"], 1 - p["mu"]
        earth, moon, across = x + mu, x - nu, y_ * y_
        first, second = earth * earth + across, moon * moon + across
        by_earth, by_moon = nu / (first * m.sqrt(first)), mu / (second * m.sqrt(second))
        return (
            vx,
            vy,
            x + 2 * vy - earth * by_earth - moon * by_moon,
            y_ - 2 * vx - y_ * (by_earth + by_moon),
        )

    def jacobi_constant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """C = x^2 + y^2 + 2 nu/r1 + 2 mu/r2 - vx^2 - vy^2."""
        x, y_, vx, vy = y
        mu, nu = p["mu"], 1 - p["mu"]
        earth, moon, across = x + mu, x - nu, y_ * y_
        pulls = nu / m.sqrt(earth * earth + across) + mu / m.sqrt(moon * moon + across)
        return x * x + across + 2 * pulls - vx * vx - vy * vy


def _as_read(decimal: str) -> str:
    """The binary64 number that a program reads for a decimal, as a fraction."""
    return str(exact(nearest(exact(decimal))))


class ArenstorfBinary64(Arenstorf):
    """The same from mu, x and y' as a program in binary64 reads them, each the nearest such number, exactly.

    This orbit is not closed: after the period it is 1.4e-11 from its start.  A program is also off by its rounding of
    1 - mu, which is exact here.
    """

    name = "arenstorf-binary64"
    numbers: ClassVar[dict[str, str]] = {"mu": _as_read(MU)}
    begins: ClassVar[tuple[str, ...]] = tuple(map(_as_read, START))


FAMILIES = (
    flow_family(Arenstorf, "Arenstorf's orbit"),
    flow_family(ArenstorfBinary64, "Arenstorf's orbit from the numbers of a program"),
)
