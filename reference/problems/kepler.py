"""Kepler's problem in the plane, from the pericentre of an ellipse of any eccentricity."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import HamiltonianFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "Kepler", "on_ellipse"]


class Kepler(HamiltonianFlow):
    """H = (px^2 + py^2)/2 - 1/r from x = 1 - e, y = 0, px = 0, py = sqrt((1 + e)/(1 - e)).

    E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, Springer 2006, section I.2.  The period is 2 pi
    whatever e is, and Kepler's equation gives the state (J. Kepler 1609).  The same starts with e = 0.1, 0.3, ..., 0.9
    are the class D of T. E. Hull et al., SIAM Journal on Numerical Analysis 9 (1972), 603.
    """

    name = "kepler"
    space = StateSpace(
        positions=("x", "y"),
        momenta=("px", "py"),
        angles=(),
        odd=("y", "px"),
        along=None,
        scale="units",
        independent="",
    )
    numbers: ClassVar[dict[str, str]] = {"e": "0.5"}
    begins = ("1 - e", "0", "0", "sqrt((1 + e)/(1 - e))")
    equation = "H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)"
    invariants = (
        Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),
        Invariant("angular momentum", ("Angular momentum", "(L - L0)/L0"), "start", "angular_momentum"),
        Invariant("eccentricity x", ("Eccentricity vector, x", "(Ax - Ax0)/K0"), "kinetic", "eccentricity_x"),
        Invariant("eccentricity y", ("Eccentricity vector, y", "(Ay - Ay0)/K0"), "kinetic", "eccentricity_y"),
    )
    known_for = ("e",)
    t_end = 62.83185307179586
    variants = ({"e": "0"}, {"e": "0.9"}, {"e": "0.99"})
    source = "E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2006, section I.2"
    difficulty = "average: smooth and periodic; the larger e, the shorter the steps at the pericentre"
    meanings: ClassVar[dict[str, str]] = {
        "e": "eccentricity",
        "x": "first position",
        "y": "second position",
        "px": "first momentum",
        "py": "second momentum",
    }

    def hamiltonian(self, m: Arithmetic, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del t, c
        (x, y), (px, py) = q, p
        return (px * px + py * py) / 2 - 1 / m.sqrt(x * x + y * y)

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t, p
        x, y_, px, py = y
        square = x * x + y_ * y_
        pull = 1 / (square * m.sqrt(square))
        return px, py, -(x * pull), -(y_ * pull)

    def known_state(self, t: Any) -> Sequence[Any]:
        return on_ellipse(t, MPMATH.number(self.parameters["e"]))

    def angular_momentum(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """x py - y px."""
        del m, p
        x, y_, px, py = y
        return x * py - y_ * px

    def eccentricity_x(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """Towards the pericentre: the first component of p x L - q/r, which is e."""
        x, y_, _, py = y
        return py * self.angular_momentum(m, y, p) - x / m.sqrt(x * x + y_ * y_)

    def eccentricity_y(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The second component of p x L - q/r, which is zero."""
        x, y_, px, _ = y
        return -(px * self.angular_momentum(m, y, p)) - y_ / m.sqrt(x * x + y_ * y_)


def on_ellipse(t: Any, e: Any) -> tuple[Any, ...]:
    """Position and velocity at a time after the pericentre, of the semi-major axis 1, in mpmath's numbers.

    Kepler's equation u - e sin u = t has its root within e of t.
    """
    u = mp.findroot(lambda u: u - e * mp.sin(u) - t, (t - e, t + e), solver="anderson") if e else t
    root, rate = mp.sqrt(1 - e * e), 1 / (1 - e * mp.cos(u))
    return mp.cos(u) - e, root * mp.sin(u), -rate * mp.sin(u), rate * root * mp.cos(u)


FAMILY = flow_family(Kepler, "Kepler's problem")
