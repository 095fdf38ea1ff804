"""Plans of the real groups that are built in a moment."""

from __future__ import annotations

import numpy as np

from reference import catalogue
from reference.plan import Group, Plan

SMALL = Plan(
    "core",
    (
        Group(
            catalogue.LIBRATION,
            catalogue.EARTH,
            {"amplitude": [0.5, 2.0], "time": np.arange(5) / 4, "event": [0, 1]},
        ),
    ),
)
TINY = Plan(
    "core",
    (Group(catalogue.LONG, catalogue.EARTH, {"amplitude": [0.5, 2.0, 3.0], "time": [0.0, 1.0, 2.0**20]}),),
)


def leftovers(folder):
    return sorted(path.name for path in folder.iterdir())
