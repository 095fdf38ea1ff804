"""Every method, by name."""

from __future__ import annotations

import unicodedata
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

from compare.methods.compositions import COMPOSITIONS
from compare.methods.conservative import CONSERVATIVE
from compare.methods.embedded import EMBEDDED
from compare.methods.explicit import EULER, EXPLICIT, HEUN, MIDPOINT, RK4
from compare.methods.implicit import IMPLICIT, IMPLICIT_MIDPOINT
from compare.methods.multistep import MULTISTEP
from compare.methods.nystrom import NYSTROM
from compare.methods.step_function import StepFunction
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
from reference.named import named
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

    One of the user's own is named by where it is: MODULE:NAME or FILE.py:NAME of what ``compare.method`` made.

    Raises:
        ValueError: there is none; the sentence names the nearest.
        FileNotFoundError, ImportError: the user's module cannot be imported.
    """
    if ":" in name:
        own: Method = _own(name)
        return own
    plain = _plain(str(name))
    for method in METHODS:
        if plain in {_plain(known) for known in (method.name, *method.aliases)}:
            return method
    names, aliases = [method.name for method in METHODS], [alias for method in METHODS for alias in method.aliases]
    raise ValueError(unknown("method", str(name), names, aliases))


@cache
def _own(name: str) -> StepFunction:
    """A method in a module of the user's own, the same each time that it is asked for."""
    found: StepFunction = named(
        name, "function under @compare.method(order=N)", "STEP", lambda value: isinstance(value, StepFunction)
    )
    return replace(found, name=name, aliases=(found.name,)) if found.name != name else found


def _plain(name: str) -> str:
    """The letters and digits of a name, without accents."""
    return "".join(letter for letter in unicodedata.normalize("NFKD", name).casefold() if letter.isalnum())
