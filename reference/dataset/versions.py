"""The schema versions that were published: the newest in full, each older one by what it says differently.

Files are cited, so every published version is read and proven again for good.  A stored number means the same in all
of them: only its description changed.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from reference.dataset.catalogue import LAYOUTS
from reference.dataset.schema import ROOT, Schema
from reference.problems.pendulum import family as pendulum
from reference.problems.polar import family as polar
from reference.problems.tunnel import family as tunnel
from reference.routes.agreement import ROUTES

if TYPE_CHECKING:
    from reference.declaration import Quantity, Row
    from reference.layout import Layout

__all__ = ["NEWEST", "SCHEMAS"]

NEWEST = Schema(
    "4",
    ROOT,
    LAYOUTS,
    has_history=True,
    names_auxiliary=True,
    monotonic_axes=True,
    signed_zeros=False,
    names_families=True,
    group_fingerprints=True,
)


def _changed(layouts: tuple[Layout, ...], *changed: Layout) -> tuple[Layout, ...]:
    """The layouts with some changed, found by their paths."""
    by_path = {layout.path: layout for layout in changed}
    return tuple(by_path.get(layout.path, layout) for layout in layouts)


def _without_heights(layout: Layout) -> Layout:
    """A family of curves as it was first published: without the curve by its height."""
    over = {name: coordinate for name, coordinate in layout.over.items() if name != "height"}
    return replace(layout, over=over, rows=tuple(row for row in layout.rows if row.name != "by_height"))


CLOSED = tuple(layout for layout in LAYOUTS if not layout.inputs)
"""The groups of problems with a closed form, which stood alone in the schemas before."""
THIRD = replace(
    NEWEST,
    version="3",
    root={
        **ROOT,
        "source": "closed forms, integrals and zeros in ball arithmetic, each limb the one correct rounding of the "
        "exact value; held against the Taylor method in MPFR arithmetic and against quadrature and elliptic functions "
        "of mpmath",
        "fingerprint_definition": "SHA-256 over the groups and datasets in order of path, provenance left out: see "
        "fingerprint.py in the source",
    },
    layouts=CLOSED,
    group_fingerprints=False,
)
SECOND = replace(
    THIRD,
    version="2",
    layouts=(
        *_changed(CLOSED, replace(polar.BOUNDARY, index=None)),
        _without_heights(polar.EXTREMALS),
        _without_heights(tunnel.HYPOCYCLOIDS),
    ),
    has_history=False,
    names_auxiliary=False,
    monotonic_axes=False,
    signed_zeros=True,
    names_families=False,
)

FIRST_WORDS: dict[str, dict[str, str]] = {
    "theta": {"definition": "theta = 2 atan(tan(theta0/2) cn(u, k))"},
    "omega": {"definition": "omega = dtheta/dt = -2 k kc omega0 sn(u, k)/dn(u, k)"},
    "period": {"definition": "T = 4 K(k)/omega0, omega0 = sqrt(g/l)"},
    "energy": {"definition": "E = omega^2/2 - (g/l) cos(theta) = -(g/l) cos(theta0)"},
    "modulus": {"definition": "k = sin(theta0/2)"},
    "complementary_modulus": {"definition": "kc = cos(theta0/2)"},
    "dperiod_damplitude": {"definition": "dT/dtheta0"},
    "zero_crossing": {"long_name": "times at which theta = 0", "definition": "t[j] = (2 j + 1) T/4, j = 0, 1, ..."},
    "turning_point": {
        "long_name": "times at which omega = 0 after the start",
        "definition": "t[j] = (j + 1) T/2, j = 0, 1, ...",
    },
}
"""How schema version 1 described the quantities that it described in other words."""
FIRST_LACKS = tuple((route, f"the {route} route does not give this quantity") for route in ROUTES)
LATER_ROWS = {"condition", "d2period_damplitude2"}


def _first_row(row: Row) -> Row:
    def described(quantity: Quantity) -> Quantity:
        return replace(quantity, **FIRST_WORDS.get(quantity.name, {}))

    return replace(row, quantities=tuple(map(described, row.quantities)), lacks=FIRST_LACKS)


def _first(layout: Layout) -> Layout:
    """A group as schema version 1 has it: fewer rows, and no word on its problem."""
    rows = tuple(_first_row(row) for row in layout.rows if row.name not in LATER_ROWS)
    return replace(layout, rows=rows, statement="", difficulty="")


FIRST = replace(
    SECOND,
    version="1",
    root={
        **THIRD.root,
        "references": "C. Huygens, Horologium Oscillatorium, 1673; P. F. Byrd and M. D. Friedman, Handbook of Elliptic "
        "Integrals, Springer 1971; NIST Digital Library of Mathematical Functions, chapters 19, 20 and 22",
        "source": "closed forms in ball arithmetic, each limb the one correct rounding of the exact value; held "
        "against the Taylor method in MPFR arithmetic and against quadrature and elliptic functions of mpmath",
    },
    layouts=tuple(_first(layout) for layout in (pendulum.LIBRATION, pendulum.DIMENSIONLESS, pendulum.LONG)),
)
SCHEMAS = {schema.version: schema for schema in (FIRST, SECOND, THIRD, NEWEST)}
"""Every published schema by its version, oldest first."""
