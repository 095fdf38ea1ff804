"""The families of problems that a report covers, each by one number: how far the start is from rest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.names import unknown
from reference.problems.cycloid import CycloidalPendulum, Tautochrone
from reference.problems.pendulum import Pendulum
from reference.problems.polar import PolarBrachistochrone

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problem import Problem

__all__ = ["FAMILIES", "Family", "family"]


@dataclass(frozen=True)
class Family:
    """Problems that differ in one number.

    Attributes:
        name: as the command line spells it.
        symbol: the number's name.
        units: the number's and the error's; "" where they have none.
        amplitudes: those of a report that names none.
        build: from the number to the problem, its other parameters as they come.
    """

    name: str
    symbol: str
    units: str
    amplitudes: tuple[float, ...]
    build: Callable[[Any], Problem]

    def label(self, amplitude: float) -> str:
        """One of its problems in words."""
        return f"{self.name}, {self.symbol} = {amplitude!r} {self.units}".rstrip()


FAMILIES = (
    Family("pendulum", "theta0", "rad", (0.1, 1.0, 3.0), Pendulum),
    Family("cycloid", "arc", "m", (1.0,), CycloidalPendulum),
    Family("tautochrone", "angle", "rad", (1.0,), Tautochrone),
    Family("polar", "z0", "", (0.5, 0.1), PolarBrachistochrone),
)
"""The tautochrone moves as the cycloidal pendulum does; its angle hides it, and is not separable."""


def family(name: str) -> Family:
    """The family of this name.

    Raises:
        ValueError: there is none.
    """
    for known in FAMILIES:
        if known.name == name:
            return known
    raise ValueError(unknown("problem", name, [known.name for known in FAMILIES]))
