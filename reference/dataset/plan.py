"""What a dataset holds: a tuple of groups, and the blocks of work that they come to.

Nothing that reads a plan knows which problems it holds.
"""

from __future__ import annotations

import hashlib
import json
import sys
from dataclasses import dataclass
from fractions import Fraction
from types import FunctionType
from typing import TYPE_CHECKING

import numpy as np

from reference.arithmetic.arrays import in_order
from reference.arithmetic.binary64 import hexadecimal, nearest
from reference.layout import BLOCK_LENGTH
from reference.named import program

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from reference.layout import Block, Group
    from reference.problem import Problem

__all__ = ["Plan", "monotonic"]


def monotonic(values: np.ndarray) -> bool:
    """Whether the numbers strictly rise or strictly fall, as those of a CF coordinate variable must."""
    keys = in_order(values)
    return bool((keys[1:] > keys[:-1]).all() or (keys[1:] < keys[:-1]).all())


@dataclass(frozen=True)
class Plan:
    """The groups of one dataset, the name of the profile they make up, and the families that were named for it.

    Raises:
        ValueError: the numbers on an axis neither rise nor fall.
    """

    profile: str
    groups: tuple[Group, ...]
    families: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for group in self.groups:
            for axis in group.layout.axes:
                if not monotonic(group.inputs[axis.name]):
                    raise ValueError(f"{group.layout.path}/{axis.name} is an axis: its numbers must rise or must fall.")

    def blocks(self) -> Iterator[Block]:
        """All the work, group by group."""
        for group in self.groups:
            yield from group.blocks()

    @property
    def size(self) -> int:
        """Bytes of the numbers that the plan comes to."""
        return sum(
            24 * int(np.prod(group.size(variable.dims))) for group in self.groups for variable in group.layout.variables
        )

    def identity(self, version: str) -> str:
        """SHA-256 of everything that decides the finished blocks, ``version`` of the program included."""
        digest = hashlib.sha256(f"{version} {BLOCK_LENGTH} {self.profile}\n".encode())
        for group in self.groups:
            layout = group.layout
            described = [layout.path, repr(layout.coordinates), repr(layout.rows), group.taylor_elements, layout.inputs]
            exact_parameters = {name: hexadecimal(nearest(Fraction(value))) for name, value in group.parameters.items()}
            digest.update(json.dumps([described, exact_parameters], sort_keys=True).encode())
            digest.update(_program(layout.problem).encode())
            for name in sorted(group.inputs):
                digest.update(f"{name} {group.inputs[name].size}\n".encode() + group.inputs[name].tobytes())
        return digest.hexdigest()


def _program(problem: Callable[..., Problem]) -> str:
    """What tells the program behind a family of the user's own from what it was, or will be, when it is changed.

    Ours is told by its version.
    """
    made_by = getattr(problem, "program", problem)
    home = sys.modules.get(made_by.__module__) if isinstance(made_by, (FunctionType, type)) else None
    if home is not None and home.__name__.startswith("reference."):
        return ""
    return program(home)
