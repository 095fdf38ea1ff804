"""Reference values of classical mechanics, proven correctly rounded."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from reference.version import __version__

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from reference.arithmetic.exact import exact
    from reference.certified import Certified
    from reference.dataset.reader import Dataset
    from reference.declaration import ENERGY_ABOVE_REST, ClosedForm, Form, Invariant, Quantity, Row, StateSpace, Trial
    from reference.family import Comparison, Family, Input, Reported
    from reference.flow import Flow
    from reference.flow_families import flow_family
    from reference.flow_problem import FlowProblem, HamiltonianFlow
    from reference.layout import Coordinate, Group, Layout
    from reference.problem import HamiltonianProblem, Problem, SeparableProblem
    from reference.problems.cycloid.arc import CycloidArc
    from reference.problems.cycloid.problem import Cycloid
    from reference.problems.cycloid.tautochrone import CycloidalPendulum, Tautochrone
    from reference.problems.descent.problem import Descent
    from reference.problems.pendulum.linear import LinearPendulum
    from reference.problems.pendulum.problem import Pendulum
    from reference.problems.polar.problem import PolarBrachistochrone
    from reference.problems.tunnel.problem import Tunnel
    from reference.routes.taylor import Along, Crossings, Period
    from reference.row_domains import ONCE, TIME

__all__ = [
    "ENERGY_ABOVE_REST",
    "ONCE",
    "TIME",
    "Along",
    "Certified",
    "ClosedForm",
    "Comparison",
    "Coordinate",
    "Crossings",
    "Cycloid",
    "CycloidArc",
    "CycloidalPendulum",
    "Descent",
    "Family",
    "Flow",
    "FlowProblem",
    "Form",
    "Group",
    "HamiltonianFlow",
    "HamiltonianProblem",
    "Input",
    "Invariant",
    "Layout",
    "LinearPendulum",
    "Pendulum",
    "Period",
    "PolarBrachistochrone",
    "Problem",
    "Quantity",
    "Reported",
    "Row",
    "SeparableProblem",
    "StateSpace",
    "Tautochrone",
    "Trial",
    "Tunnel",
    "__version__",
    "exact",
    "flow_family",
    "load",
]

_HOMES = {
    "Certified": "reference.certified",
    "Cycloid": "reference.problems.cycloid.problem",
    "CycloidArc": "reference.problems.cycloid.arc",
    "CycloidalPendulum": "reference.problems.cycloid.tautochrone",
    "Descent": "reference.problems.descent.problem",
    "Family": "reference.family",
    "Flow": "reference.flow",
    "FlowProblem": "reference.flow_problem",
    "HamiltonianFlow": "reference.flow_problem",
    "flow_family": "reference.flow_families",
    "HamiltonianProblem": "reference.problem",
    "LinearPendulum": "reference.problems.pendulum.linear",
    "Pendulum": "reference.problems.pendulum.problem",
    "PolarBrachistochrone": "reference.problems.polar.problem",
    "Problem": "reference.problem",
    "SeparableProblem": "reference.problem",
    "StateSpace": "reference.declaration",
    "Tautochrone": "reference.problems.cycloid.tautochrone",
    "Tunnel": "reference.problems.tunnel.problem",
    "Along": "reference.routes.taylor",
    "ClosedForm": "reference.declaration",
    "Comparison": "reference.family",
    "Coordinate": "reference.layout",
    "Crossings": "reference.routes.taylor",
    "ENERGY_ABOVE_REST": "reference.declaration",
    "Form": "reference.declaration",
    "Group": "reference.layout",
    "Input": "reference.family",
    "Invariant": "reference.declaration",
    "Layout": "reference.layout",
    "ONCE": "reference.row_domains",
    "Period": "reference.routes.taylor",
    "Quantity": "reference.declaration",
    "Reported": "reference.family",
    "Row": "reference.declaration",
    "TIME": "reference.row_domains",
    "Trial": "reference.declaration",
    "exact": "reference.arithmetic.exact",
}


def __getattr__(name: str) -> Any:
    """The public classes, imported when first asked for: a command line's help needs none of them."""
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'reference' has no attribute {name!r}")


def load(path: str | os.PathLike[str] | None = None, families: Sequence[Family | str] = ()) -> Dataset:
    """Check a dataset and return it; without a path, the core dataset that ships with the package.

    A file with groups of families that are not ours is read with these, each a Family, or its name as MODULE:NAME or
    FILE.py:NAME.

    ``load()["pendulum/libration/period"]`` has ``value`` (float64), ``tail`` (its next two limbs) and ``units``.

    Raises:
        FileNotFoundError: there is no such file; the message says how to build it.
        DatasetError: a ValueError: the file is truncated, altered, of another schema, or no dataset.
        ValueError, ImportError: there is no such family, or its module cannot be imported.
        TypeError: ``path`` is no path, or ``families`` hold something else.
    """
    from reference.dataset.reader import load as load_checked

    return load_checked(path, families)
