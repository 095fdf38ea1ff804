"""Every solver that is asked; one that is not installed is among them, for its install line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.solvers import (
    desolver,
    diffrax,
    extensisq,
    gala,
    heyoka,
    numbalsoda,
    probdiffeq,
    pyhamsys,
    rebound,
    scipy,
    sksundae,
    torchdiffeq,
    torchode,
)
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Iterable

    from compare.solvers.solver import Solver

__all__ = ["SOLVERS", "select"]

PACKAGES = (
    scipy,
    heyoka,
    diffrax,
    numbalsoda,
    desolver,
    extensisq,
    pyhamsys,
    rebound,
    sksundae,
    torchdiffeq,
    torchode,
    probdiffeq,
    gala,
)
SOLVERS: tuple[Solver, ...] = tuple(solver for package in PACKAGES for solver in package.SOLVERS)


def select(names: Iterable[str]) -> tuple[Solver, ...]:
    """The solvers of these names, each once; a package's name stands for all of its solvers.

    Raises:
        ValueError: there is no such solver or package.
    """
    chosen: dict[str, Solver] = {}
    for name in names:
        found = [s for s in SOLVERS if name in {s.name, s.package, *s.aliases}]
        if not found:
            packages = dict.fromkeys(solver.package for solver in SOLVERS)
            raise ValueError(unknown("solver", name, packages, [n for s in SOLVERS for n in (s.name, *s.aliases)]))
        chosen |= {solver.name: solver for solver in found}
    return tuple(chosen.values())
