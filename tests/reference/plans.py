"""Plans of the real groups that are built in a moment."""

from __future__ import annotations

import numpy as np

from reference.dataset.plan import Plan
from reference.layout import Group
from reference.problems.pendulum import family as groups

SMALL = Plan(
    "core",
    (
        Group(
            groups.LIBRATION,
            groups.EARTH,
            {"amplitude": [0.5, 2.0], "time": np.arange(5) / 4, "event": [0, 1]},
        ),
    ),
)
TINY = Plan(
    "core",
    (Group(groups.LONG, groups.EARTH, {"amplitude": [0.5, 2.0, 3.0], "time": [0.0, 1.0, 2.0**20]}),),
)


def leftovers(folder):
    return sorted(path.name for path in folder.iterdir())
