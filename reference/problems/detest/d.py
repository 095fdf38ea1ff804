"""Class D: Kepler's problem of two bodies, from the pericentre, at five eccentricities."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.namespaces import MPMATH
from reference.declaration import Invariant, StateSpace
from reference.problem import SeparableProblem
from reference.problems.detest.nonstiff import Nonstiff
from reference.problems.kepler import on_ellipse

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["DetestD1", "DetestD2", "DetestD3", "DetestD4", "DetestD5"]


class _Orbit(Nonstiff, SeparableProblem):
    """y1' = y3, y2' = y4, y3' = -y1/r^3, y4' = -y2/r^3, r = sqrt(y1^2 + y2^2).

    H = (y3^2 + y4^2)/2 - 1/r; its slopes are written out, because of them a proof takes seven times as many operations
    as of these.

    It begins at (1 - eps, 0) with the velocity (0, sqrt((1 + eps)/(1 - eps))).  With u - eps sin u = t it is at
    (cos u - eps, sqrt(1 - eps^2) sin u).
    """

    space = StateSpace(
        positions=("y1", "y2"),
        momenta=("y3", "y4"),
        angles=(),
        odd=("y3", "y4"),
        along=None,
        scale="units",
        independent="",
    )
    begins = ("1 - eps", "0", "0", "sqrt((1 + eps)/(1 - eps))")
    equation = "y1' = y3, y2' = y4, y3' = -y1/r^3, y4' = -y2/r^3, r = sqrt(y1^2 + y2^2)"
    invariants = (
        Invariant("energy", ("Energy", "(E - E0)/|E0|"), "start"),
        Invariant("angular momentum", ("Angular momentum", "(L - L0)/L0"), "start", "angular_momentum"),
    )
    meanings: ClassVar[Mapping[str, str]] = {"eps": "eccentricity of the orbit"}
    known_for = ("eps",)

    def velocity(self, m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return tuple(momenta)

    def force(self, m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        y1, y2 = positions
        square = y1 * y1 + y2 * y2
        cube = square * m.sqrt(square)
        return -y1 / cube, -y2 / cube

    def known_state(self, t: Any) -> Sequence[Any]:
        return on_ellipse(t, MPMATH.number(self.parameters["eps"]))

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """H, which is -1/2."""
        return (y[2] * y[2] + y[3] * y[3]) / 2 - 1 / m.sqrt(y[0] * y[0] + y[1] * y[1])

    def angular_momentum(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """L = y1 y4 - y2 y3."""
        return y[0] * y[3] - y[1] * y[2]


class DetestD1(_Orbit):
    """Kepler's problem with the eccentricity 0.1."""

    name = "detest-d1"
    words = "Kepler's problem, eccentricity 0.1"
    numbers: ClassVar[Mapping[str, str]] = {"eps": "0.1"}
    difficulty = "lower: a smooth orbit, nearly a circle; the error grows linearly along it"


class DetestD2(_Orbit):
    """Kepler's problem with the eccentricity 0.3."""

    name = "detest-d2"
    words = "Kepler's problem, eccentricity 0.3"
    numbers: ClassVar[Mapping[str, str]] = {"eps": "0.3"}
    difficulty = "lower: a smooth orbit of small eccentricity; the error grows linearly along it"


class DetestD3(_Orbit):
    """Kepler's problem with the eccentricity 0.5."""

    name = "detest-d3"
    words = "Kepler's problem, eccentricity 0.5"
    numbers: ClassVar[Mapping[str, str]] = {"eps": "0.5"}
    difficulty = "average: the orbit is three times as far away as it is near"


class DetestD4(_Orbit):
    """Kepler's problem with the eccentricity 0.7."""

    name = "detest-d4"
    words = "Kepler's problem, eccentricity 0.7"
    numbers: ClassVar[Mapping[str, str]] = {"eps": "0.7"}
    difficulty = "average: each pericentre takes much smaller steps than the rest of the orbit"


class DetestD5(_Orbit):
    """Kepler's problem with the eccentricity 0.9."""

    name = "detest-d5"
    words = "Kepler's problem, eccentricity 0.9"
    numbers: ClassVar[Mapping[str, str]] = {"eps": "0.9"}
    difficulty = "higher: pericentres at a tenth of the axis, where the step must change by orders of magnitude"
