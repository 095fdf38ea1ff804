"""The swinging spring, or elastic pendulum, in space, where its frequencies are as two to one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import HamiltonianFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "SwingingSpring"]


class SwingingSpring(HamiltonianFlow):
    """H = (px^2 + py^2 + pz^2)/2 + k (r - 1 + 1/k)^2/2 + z, r = sqrt(x^2 + y^2 + z^2), the z-axis pointing up.

    A. Vitt and G. Gorelik, Zhurnal Tekhnicheskoi Fiziki 3 (1933), 294; D. D. Holm and P. Lynch, SIAM Journal on Applied
    Dynamical Systems 1 (2002), 44, who take the mass 1 kg, the length 1 m at rest under load, g = pi^2 m/s^2 and a
    stiffness of 4 pi^2 N/m, displaced by (0.04, 0, 0.08) m with a velocity of (0, 0.03427, 0) m/s.  In units of that
    length and of 1/pi s the stiffness is k = 4, the unloaded length 1 - 1/k, and the velocity 0.03427/pi.  Vertical and
    pendular oscillations exchange their energy, and the plane of the swing turns from one exchange to the next.
    """

    name = "swinging-spring"
    space = StateSpace(
        positions=("x", "y", "z"),
        momenta=("px", "py", "pz"),
        angles=(),
        odd=("px", "py", "pz"),
        along=None,
        scale="units",
        independent="",
    )
    numbers: ClassVar[dict[str, str]] = {"k": "4"}
    begins = ("0.04", "0", "0.08 - 1", "0", "0.03427/pi", "0")
    equation = "H = (px^2 + py^2 + pz^2)/2 + k (sqrt(x^2 + y^2 + z^2) - 1 + 1/k)^2/2 + z"
    invariants = (
        Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),
        Invariant("angular momentum", ("Angular momentum", "(L - L0)/L0"), "start", "angular_momentum"),
    )
    t_end = 20.0
    source = "D. D. Holm and P. Lynch, SIAM Journal on Applied Dynamical Systems 1 (2002), 44"
    difficulty = "average: smooth, with a resonance between two oscillations"
    meanings: ClassVar[dict[str, str]] = {
        "k": "stiffness of the spring",
        "x": "first horizontal position",
        "y": "second horizontal position",
        "z": "height over the suspension",
        "px": "first horizontal momentum",
        "py": "second horizontal momentum",
        "pz": "vertical momentum",
    }

    def hamiltonian(self, m: Arithmetic, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del t
        (x, y, z), (px, py, pz), k = q, p, c["k"]
        stretch = m.sqrt(x * x + y * y + z * z) - (1 - 1 / k)
        return (px * px + py * py + pz * pz) / 2 + k * (stretch * stretch) / 2 + z

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t
        x, y_, z, px, py, pz = y
        pull = (p["k"] - 1) / m.sqrt(x * x + y_ * y_ + z * z) - p["k"]
        return px, py, pz, x * pull, y_ * pull, z * pull - 1

    def angular_momentum(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """About the vertical."""
        del m, p
        return y[0] * y[4] - y[1] * y[3]


FAMILY = flow_family(SwingingSpring, "the swinging spring")
