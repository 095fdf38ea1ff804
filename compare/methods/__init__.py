"""Every method, by name."""

from __future__ import annotations

import unicodedata
from pathlib import PurePath
from typing import TYPE_CHECKING

from compare.methods.compositions import COMPOSITIONS
from compare.methods.conservative import CONSERVATIVE
from compare.methods.diagonally_implicit import DIAGONALLY_IMPLICIT
from compare.methods.embedded import EMBEDDED
from compare.methods.explicit import EULER, EXPLICIT, HEUN, MIDPOINT, RK4
from compare.methods.extrapolation import EXTRAPOLATION
from compare.methods.force_gradient import FORCE_GRADIENT
from compare.methods.implicit import IMPLICIT, IMPLICIT_MIDPOINT
from compare.methods.many_stages import MANY_STAGES
from compare.methods.multistep import MULTISTEP
from compare.methods.near_integrable import NEAR_INTEGRABLE
from compare.methods.nystrom import NYSTROM
from compare.methods.own.step_function import method_at
from compare.methods.processed import PROCESSED
from compare.methods.rosenbrock import ROSENBROCK
from compare.methods.runge_kutta_nystrom import RUNGE_KUTTA_NYSTROM
from compare.methods.symmetric import SYMMETRIC
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
    from collections.abc import Sequence

    from compare.methods.kinds.one_step import Method
    from compare.methods.own.step_function import StepFunction

__all__ = ["DEFAULT", "METHODS", "find", "own_methods"]

METHODS: tuple[Method, ...] = (
    *EXPLICIT,
    *EMBEDDED,
    *MANY_STAGES,
    *EXTRAPOLATION,
    *SYMPLECTIC,
    *SYMMETRIC,
    *COMPOSITIONS,
    *NEAR_INTEGRABLE,
    *NYSTROM,
    *FORCE_GRADIENT,
    *PROCESSED,
    *RUNGE_KUTTA_NYSTROM,
    *IMPLICIT,
    *DIAGONALLY_IMPLICIT,
    *ROSENBROCK,
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
        own: Method = method_at(name, None, name)
        return own
    plain = _plain(str(name))
    for method in METHODS:
        if plain in {_plain(known) for known in (method.name, *method.aliases)}:
            return method
    names, aliases = [method.name for method in METHODS], [alias for method in METHODS for alias in method.aliases]
    raise ValueError(unknown("method", str(name), names, aliases))


def own_methods(homes: Sequence[str], orders: Sequence[int]) -> tuple[StepFunction, ...]:
    """Methods of a user's own functions, each named as its function is, or FILE.py:NAME where another has that name.

    Args:
        homes: MODULE:NAME or FILE.py:NAME of each.
        orders: what each claims, or one for all; none where ``compare.method`` has declared them.

    Raises:
        ValueError: there are other numbers of orders than of functions, a function is named twice, or is no step.
        FileNotFoundError, ImportError: a module cannot be imported.
    """
    if len(orders) not in {0, 1, len(homes)}:
        raise ValueError(
            f"claims has {len(orders)} orders for {len(homes)} methods; one for all, or one for each, is accepted."
        )
    each: list[int | None] = [*orders] if orders else [None]
    each *= len(homes) if len(each) == 1 else 1
    words = [home.rpartition(":")[2] for home in homes]
    known = {one for method in METHODS for one in (method.name, f"{method.name}_compensated", *method.aliases)}
    others = [*map(_plain, known), *map(_plain, words)]
    found = tuple(
        method_at(home, order, word if others.count(_plain(word)) == 1 else PurePath(home).name)
        for home, order, word in zip(homes, each, words, strict=True)
    )
    for one in found:
        if [other.name for other in found].count(one.name) > 1:
            raise ValueError(f"method has {one.name} twice; each is accepted once.")
    return found


def _plain(name: str) -> str:
    """The letters and digits of a name, without accents."""
    return "".join(letter for letter in unicodedata.normalize("NFKD", name).casefold() if letter.isalnum())
