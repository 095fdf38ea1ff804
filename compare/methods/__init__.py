"""Every method, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.methods.explicit import EXPLICIT
from compare.methods.implicit import IMPLICIT
from compare.methods.symplectic import SYMPLECTIC
from reference.names import unknown

if TYPE_CHECKING:
    from compare.method import Method

__all__ = ["METHODS", "find"]

METHODS: tuple[Method, ...] = (*EXPLICIT, *SYMPLECTIC, *IMPLICIT)


def find(name: str) -> Method:
    """Return the method of this name or alias.

    Raises:
        ValueError: there is none; the sentence names the nearest.
    """
    for method in METHODS:
        if name in {method.name, *method.aliases}:
            return method
    names, aliases = [method.name for method in METHODS], [alias for method in METHODS for alias in method.aliases]
    raise ValueError(unknown("method", str(name), names, aliases))
