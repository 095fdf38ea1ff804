"""The families of problems that a report covers, each by one number, how far the start is from rest, or by one name."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.studies.brachistochrone import depth_of
from compare.studies.descent import last_tick
from compare.studies.polar import PSI_END, depth_above
from reference.names import unknown
from reference.problems.cycloid import CycloidalPendulum, Tautochrone
from reference.problems.descent import Descent
from reference.problems.paths import CycloidCurve, PolarByPsi, PolarByZ
from reference.problems.pendulum import Pendulum
from reference.problems.polar import PolarBrachistochrone

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problem import Problem

__all__ = ["FAMILIES", "Amplitude", "Family", "family"]

Amplitude = float | str
"""What tells a problem from others of its family: a number, or the name of a curve."""


@dataclass(frozen=True)
class Family:
    """Problems that differ in one number, or in one name.

    Attributes:
        name: as the command line spells it.
        symbol: what the number or the name is.
        units: the number's; "" where it has none.
        error_units: the error's; "" where it has none, or errors of several units are compared.
        amplitudes: those of a report that names none.
        build: from the number or the name to the problem, its other parameters as they come.
        end: from the problem to where its march ends of itself; None where it goes on for as long as it is asked to.
    """

    name: str
    symbol: str
    units: str
    error_units: str
    amplitudes: tuple[Amplitude, ...]
    build: Callable[[Any], Problem]
    end: Callable[[Any], Fraction] | None = None

    @property
    def named(self) -> bool:
        """Whether its problems differ in a name."""
        return isinstance(self.amplitudes[0], str)

    def label(self, amplitude: Amplitude) -> str:
        """One of its problems in words."""
        shown = amplitude if isinstance(amplitude, str) else repr(amplitude)
        return f"{self.name}, {self.symbol} = {shown} {self.units}".rstrip()


def _descent(curve: Any) -> Descent:
    """The descent along a curve, which has a start to march from.

    Raises:
        ValueError: there is no such curve, or it starts at a cusp.
    """
    problem = Descent(curve)
    _ = problem.start
    return problem


FAMILIES = (
    Family("pendulum", "theta0", "rad", "rad", (0.1, 1.0, 3.0), Pendulum),
    Family("cycloid", "arc", "m", "m", (1.0,), CycloidalPendulum),
    Family("cycloid-curve", "radius", "m", "m", (1.0,), CycloidCurve, depth_of),
    Family("tautochrone", "angle", "rad", "rad", (1.0,), Tautochrone),
    Family("descent", "curve", "", "", ("quartic", "cycloid"), _descent, last_tick),
    Family("polar", "z0", "", "", (0.5, 0.1), PolarBrachistochrone),
    Family("polar-z", "z0", "", "rad", (0.5, 0.1), PolarByZ, lambda problem: depth_above(problem.z0)),
    Family("polar-psi", "z0", "", "", (0.5, 0.1), PolarByPsi, lambda _: Fraction(PSI_END)),
)
"""The tautochrone moves as the cycloidal pendulum does; its angle hides it, and is not separable.

The brachistochrone's curve is dx/dy of the cycloid, singular at the bottom; the one in a central field is dphi/dz,
singular at the lowest point, and dphi/dpsi, which is smooth.  Curves and descents end where those of their studies do.
"""


def family(name: str) -> Family:
    """The family of this name.

    Raises:
        ValueError: there is none.
    """
    for known in FAMILIES:
        if known.name == name:
            return known
    raise ValueError(unknown("problem", name, [known.name for known in FAMILIES]))
