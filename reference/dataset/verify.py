"""The proofs again: every limb against balls of another precision, every decimal, the routes once more."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from reference.arithmetic.arrays import unsigned_zeros
from reference.arithmetic.binary64 import shortest
from reference.command.executors import opened, results
from reference.dataset.blocks import (
    LIMBS,
    START_BITS,
    compare,
    decimals,
    in_turn,
    prepare,
    prove,
    require_portable,
    together,
)
from reference.dataset.claims import decimal_fault, measurement_fault
from reference.dataset.errors import DatasetError
from reference.dataset.reader import load
from reference.dataset.schema import ATTRIBUTE_LIMIT
from reference.layout import Group
from reference.routes.agreement import ROUTES, DisagreementError

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterator, Sequence

    from reference.dataset.reader import Dataset
    from reference.declaration import Row
    from reference.family import Family
    from reference.layout import Block

    Digits = dict[str, list[float]] | str
    """For each route the digits to which it agrees on each quantity, or the sentence of a disagreement."""

__all__ = ["Proof", "differs", "verify"]

CLOSED_FORM_BITS, FLOW_BITS = 2 * START_BITS, START_BITS + 53
"""Balls start at so many bits: of closed forms at twice those of the build, of flows at a limb more, in other steps."""
TAYLOR_ELEMENTS = 6
"""Arguments a row that the Taylor route is asked for again, from the first."""


@dataclass
class Proof:
    """What became of one variable.

    Attributes:
        name: path without the leading slash.
        row: the row that it is of.
        elements: how many were proven again; each has three limbs.
        wrong: how many differ in a limb.
        first: the first that differs, in words, or what else the file says wrongly of it; empty where nothing does.
        digits: for each route that was asked again, the digits to which it agrees.
        decimals: for a variable that has them, the proven decimals by element.
    """

    name: str
    row: Row
    elements: int = 0
    wrong: int = 0
    first: str = ""
    digits: dict[str, float] = field(default_factory=dict)
    decimals: dict[int, str] = field(default_factory=dict)

    @property
    def holds(self) -> bool:
        """Whether every value is the one correct rounding and no route disagrees."""
        return not self.first

    def __str__(self) -> str:
        if self.first:
            return f"FAILED  {self.name}: {self.first}"
        routes = ", ".join(f"{route} {digits:.1f} digits" for route, digits in self.digits.items())
        return f"proven  {self.name}: {self.elements} elements, {LIMBS} limbs each; {routes}"


def verify(
    path: str | os.PathLike[str],
    *,
    families: Sequence[Family | str] = (),
    jobs: int = 1,
    executor: str = "process",
    progress: Callable[[int, int], None] | None = None,
) -> list[Proof]:
    """Check a file as loading does, ``families`` as there, then prove each of its values again; one Proof a variable.

    Raises:
        FileNotFoundError: there is no such file.
        DatasetError: the file failed a check before any proof.
        WorkBoundError: a value could not be decided within the bound on the working precision.
    """
    dataset = load(path, families)
    groups = [_group(dataset, layout.path) for layout in dataset.layouts]
    proofs = {
        (group.layout.path, component.quantity.name): Proof(
            f"{group.layout.path[1:]}/{component.quantity.name}", component.row
        )
        for group in groups
        for component in group.layout.variables
    }
    require_portable([group.layout for group in groups], executor, jobs)
    total = sum(1 for group in groups for _ in group.blocks())
    with opened(executor, jobs) as pool:
        done = 0
        agreed: list[tuple[Block, Digits]] = []
        for several, found in results(pool, _again, together(_sampled(groups)), jobs):
            for block, (limbs, spelled, routes) in zip(several, found, strict=True):
                _compare(dataset, block, limbs, proofs)
                for quantity, text in zip(block.row.quantities, spelled, strict=False):
                    proofs[block.layout.path, quantity.name].decimals[block.element] = text
                if routes is not None:
                    agreed.append((block, routes))
            done += len(several)
            if progress:
                progress(done, total)
    for block, digits in agreed:
        _note_routes(block, digits, proofs)
    for proof in proofs.values():
        said, texts = dataset[proof.name], [proof.decimals[element] for element in sorted(proof.decimals)]
        proof.first = (
            proof.first
            or decimal_fault(str(said.attrs.get("decimal", "")), texts, ATTRIBUTE_LIMIT)
            or measurement_fault(said.attrs, math.prod(said.shape), proof.row, proof.digits)
        )
    return list(proofs.values())


def _sampled(groups: Sequence[Group]) -> Iterator[Block]:
    """The blocks of groups: of each row the first one of the middle instance is to be held against the routes again, by
    the arguments that the Taylor route reaches quickly, others by none.
    """
    middle = {group.layout.path: group.elements // 2 for group in groups}
    for block in in_turn(groups):
        asked = block.element == middle[block.layout.path] and block.start == 0
        yield replace(block, taylor_elements=TAYLOR_ELEMENTS if asked else 0)


def _again(blocks: tuple[Block, ...]) -> list[tuple[np.ndarray, tuple[str, ...], Digits | None]]:
    """Of each block the limbs, proven in more bits than those of the build, the decimals, and the routes' digits."""
    bits = CLOSED_FORM_BITS if blocks[0].problem.has_closed_form else FLOW_BITS
    prepare(blocks, bits)
    return [
        (prove(block, bits), decimals(block), _routes(block) if block.taylor_elements else None) for block in blocks
    ]


def _group(dataset: Dataset, path: str) -> Group:
    """The group with the inputs that the file gives it."""
    layout = next(layout for layout in dataset.layouts if layout.path == path)
    inputs = {axis.name: dataset[f"{path}/{axis.name}"].value for axis in layout.given}
    group = Group(layout, dataset.parameters[path], inputs)
    for block in group.blocks():
        try:
            _ = block.problem
        except ValueError as error:
            raise DatasetError(f"'{dataset.path}': {path} at element {block.element} is no problem: {error}") from None
        try:
            block.check()
        except ValueError as error:
            where = f"{path} at element {block.element}"
            raise DatasetError(f"'{dataset.path}': {where} has no {block.row.name}: {error}") from None
    return group


def _compare(dataset: Dataset, block: Block, limbs: np.ndarray, proofs: dict[tuple[str, str], Proof]) -> None:
    for component in block.layout.variables:
        if component.row.name != block.row.name:
            continue
        proof = proofs[block.layout.path, component.quantity.name]
        value, tail = dataset[proof.name].read(block.selection(component))
        stored = np.concatenate([np.reshape(value, (-1, 1)), np.reshape(tail, (-1, LIMBS - 1))], axis=1)
        proven = limbs[:, component.component]
        differing = np.flatnonzero(differs(stored, proven, signed_zeros=dataset.schema.signed_zeros).any(axis=1))
        proof.elements += len(proven)
        proof.wrong += differing.size
        if differing.size and not proof.first:
            i = int(differing[0])
            proof.first = (
                f"element {(block.element, block.start + i)} is stored as {_spelled(stored[i])} "
                f"and proven to be {_spelled(proven[i])}"
            )


def differs(stored: np.ndarray, proven: np.ndarray, *, signed_zeros: bool) -> np.ndarray:
    """Where float64 numbers differ: in any bit, but for the sign of zero where ``signed_zeros`` may be stored."""
    if signed_zeros:
        stored, proven = unsigned_zeros(stored), unsigned_zeros(proven)
    other: np.ndarray = stored.view(np.int64) != proven.view(np.int64)
    return other


def _spelled(limbs: np.ndarray) -> str:
    return f"[{', '.join(map(shortest, limbs.tolist()))}]"


def _routes(block: Block) -> Digits:
    """For each route the digits to which it agrees on each quantity, or the sentence of a disagreement."""
    try:
        found = {route: compare(block, route) for route in ROUTES}
    except DisagreementError as error:
        return str(error)
    return {route: digits for route, (digits, checked) in found.items() if checked[0]}


def _note_routes(block: Block, digits: Digits, proofs: dict[tuple[str, str], Proof]) -> None:
    for i, quantity in enumerate(block.row.quantities):
        proof = proofs[block.layout.path, quantity.name]
        if isinstance(digits, str):
            proof.first = proof.first or digits
        else:
            proof.digits = {route: each[i] for route, each in digits.items()}
