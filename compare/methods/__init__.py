"""Every method, by name."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

from compare.methods.explicit import EXPLICIT
from compare.methods.implicit import IMPLICIT
from compare.methods.symplectic import SYMPLECTIC

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
    names = [name for method in METHODS for name in (method.name, *method.aliases)]
    near = difflib.get_close_matches(name, names, 3, 0.5)
    accepted = ", ".join(near) if near else ", ".join(method.name for method in METHODS)
    raise ValueError(f"method '{name}' is unknown; {'the nearest are' if near else 'accepted are'} {accepted}.")
