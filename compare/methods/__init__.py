"""Every method, by name."""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING

from compare.methods.compositions import COMPOSITIONS
from compare.methods.conservative import CONSERVATIVE
from compare.methods.embedded import EMBEDDED
from compare.methods.explicit import EULER, EXPLICIT, HEUN, MIDPOINT, RK4
from compare.methods.implicit import IMPLICIT, IMPLICIT_MIDPOINT
from compare.methods.multistep import MULTISTEP
from compare.methods.nystrom import NYSTROM
from compare.methods.symplectic import (
    POSITION_VERLET,
    RUTH3,
    SUZUKI4,
    SYMPLECTIC,
    SYMPLECTIC_EULER,
    SYMPLECTIC_EULER_ADJOINT,
    VERLET,
    YOSHIDA4,
)
from compare.methods.taylor import TAYLOR
from reference.names import unknown

if TYPE_CHECKING:
    from compare.methods.kinds.one_step import Method

__all__ = ["DEFAULT", "METHODS", "find"]

METHODS: tuple[Method, ...] = (
    *EXPLICIT,
    *EMBEDDED,
    *SYMPLECTIC,
    *COMPOSITIONS,
    *NYSTROM,
    *IMPLICIT,
    *CONSERVATIVE,
    *MULTISTEP,
    *TAYLOR,
)

DEFAULT: tuple[Method, ...] = (
    EULER,
    MIDPOINT,
    HEUN,
    RK4,
    SYMPLECTIC_EULER,
    SYMPLECTIC_EULER_ADJOINT,
    VERLET,
    POSITION_VERLET,
    RUTH3,
    YOSHIDA4,
    SUZUKI4,
    IMPLICIT_MIDPOINT,
)
"""Those that a study compares unless it is told which."""


def find(name: str) -> Method:
    """Return the method of this name or alias, however its letters, accents, blanks and hyphens are written.

    Raises:
        ValueError: there is none; the sentence names the nearest.
    """
    plain = _plain(str(name))
    for method in METHODS:
        if plain in {_plain(known) for known in (method.name, *method.aliases)}:
            return method
    names, aliases = [method.name for method in METHODS], [alias for method in METHODS for alias in method.aliases]
    raise ValueError(unknown("method", str(name), names, aliases))


def _plain(name: str) -> str:
    """The letters and digits of a name, without accents."""
    return "".join(letter for letter in unicodedata.normalize("NFKD", name).casefold() if letter.isalnum())
