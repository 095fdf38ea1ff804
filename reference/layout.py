"""What a family of problems puts into a dataset: groups declared by path, coordinates and rows, and their work.

A layout says how a group looks at any size: its problem, its coordinates, its rows.  A group is a layout with numbers
on its coordinates; a block is a stretch of one of its rows.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import exact
from reference.names import each_once, short
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    import numpy as np

    from reference.declaration import Quantity, Row
    from reference.problem import Problem

__all__ = ["BLOCK_LENGTH", "Block", "Component", "Coordinate", "Group", "Layout", "parts"]

BLOCK_LENGTH = 2048
"""Times in one block: the unit of work, of resuming and of storage, and so the bound on memory."""
PATH = re.compile(r"(/[A-Za-z][A-Za-z0-9_-]*)+")


def parts(numbers: Iterable[int], whole: int) -> list[float]:
    """Numbers along an axis as parts of a whole: each k/whole, rounded once."""
    return [k / whole for k in numbers]


@dataclass(frozen=True)
class Coordinate:
    """An exact input: an axis, a number along one, or a fixed parameter.

    Attributes:
        name: its name in the file.
        units: UDUNITS spelling; "1" for a pure number.
        long_name: what it is, in words.
        definition: how its numbers were chosen.
        whole: True for int32 labels, False for float64.
        meanings: for a label axis, the CF flag meanings of 0, 1, 2, ...
    """

    name: str
    units: str
    long_name: str
    definition: str = "exact binary64 input"
    whole: bool = False
    meanings: tuple[str, ...] = ()

    @property
    def dtype(self) -> str:
        """Little-endian int32 for labels, float64 otherwise, as NumPy spells them."""
        return "<i4" if self.whole or self.meanings else "<f8"


@dataclass(frozen=True)
class Component:
    """A quantity of a group as it is stored: its dimensions by name, and the row and component that give it."""

    quantity: Quantity
    row: Row
    component: int
    dims: tuple[str, ...]


@dataclass(frozen=True)
class Layout:
    """How one group looks at any size.

    Attributes:
        path: absolute path of the group, such as "/pendulum/libration".
        long_name: what it holds, in words.
        instances: the inputs that make one problem an element; the first names the axis where there is no ``index``.
            Empty for a single problem.
        over: for each ``Row.over`` that occurs besides "once", the coordinate that the row runs along.
        parameters: inputs that are the same for the whole group, stored as its attributes.
        rows: the rows stored.
        problem: called with the instance's inputs and the parameters by name; returns the problem.
        reference: where the closed form is published.
        statement: the problem in one line: its equation and its start.
        difficulty: how hard it is on an integrator, "lower", "average" or "higher", and why.
        index: labels 0, 1, 2, ... of instances that are in no order by any one of their inputs, as points in a plane.
        inputs: the exact numbers and starts of a single problem, as texts; "" where coordinates tell them.

    Raises:
        ValueError: the path or a name cannot stand in a file, a name is there twice, or a row has no coordinate.
    """

    path: str
    long_name: str
    instances: tuple[Coordinate, ...]
    over: Mapping[str, Coordinate]
    parameters: tuple[Coordinate, ...]
    rows: tuple[Row, ...]
    problem: Callable[..., Problem]
    reference: str
    statement: str = ""
    difficulty: str = ""
    index: Coordinate | None = None
    inputs: str = ""

    def __post_init__(self) -> None:
        if not PATH.fullmatch(self.path):
            raise ValueError(f"the group's path is '{short(self.path)}'; one such as /pendulum/libration is accepted.")
        for row in self.rows:
            if row.over not in {"once", *self.over}:
                raise ValueError(f"{self.path} has the row {row.name} over '{row.over}', and no coordinate for that.")
        values = [name for row in self.rows for one in row.quantities for name in (one.name, f"{one.name}_tail")]
        each_once(self.path, [*(one.name for one in (*self.coordinates, *self.parameters)), *values])

    @property
    def first(self) -> tuple[Coordinate, ...]:
        """The axis of the instances: their index or their first input; empty for a single problem."""
        return self.instances[:1] if self.index is None else (self.index,)

    @property
    def axes(self) -> tuple[Coordinate, ...]:
        """The coordinates that are dimensions."""
        return (*self.first, *self.over.values())

    @property
    def auxiliary(self) -> tuple[Coordinate, ...]:
        """The inputs of the instances that are no dimensions."""
        return self.instances[1:] if self.index is None else self.instances

    @property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """Every one-dimensional input, axes first."""
        return (*self.axes, *self.auxiliary)

    @property
    def given(self) -> tuple[Coordinate, ...]:
        """The coordinates whose numbers are chosen: all but an index, which counts."""
        return tuple(coordinate for coordinate in self.coordinates if coordinate is not self.index)

    def dimension_of(self, coordinate: str) -> str:
        """The name of the axis that a coordinate runs along: its own, or for auxiliary ones that of the instances."""
        return self.first[0].name if coordinate in {extra.name for extra in self.auxiliary} else coordinate

    @property
    def variables(self) -> tuple[Component, ...]:
        """The quantities of the rows in order."""
        return tuple(
            Component(quantity, row, component, self._dims(row))
            for row in self.rows
            for component, quantity in enumerate(row.quantities)
        )

    def _dims(self, row: Row) -> tuple[str, ...]:
        along = () if row.over == "once" else (self.over[row.over].name,)
        return (*(axis.name for axis in self.first), *along)


@dataclass(frozen=True)
class Block:
    """One unit of work: a stretch of one row of one problem.

    ``values`` are the numbers along the row's axis as they are stored, a view of the plan's; empty for a row that is
    asked once.
    """

    key: str
    layout: Layout
    inputs: Mapping[str, float | int]
    element: int
    row: Row
    start: int
    values: np.ndarray
    taylor_elements: int | None = None

    @cached_property
    def arguments(self) -> tuple[Any, ...]:
        """The exact arguments of the row, or None once; made where the block is proven, as that takes its time."""
        if self.row.over == "once":
            return (None,)
        return tuple(value if isinstance(value, int) else exact(value) for value in self.values.tolist())

    @property
    def problem(self) -> Problem:
        """The problem at this element, its inputs exact."""
        return self.layout.problem(**self.inputs)

    def check(self) -> None:
        """Refuse a block that cannot be proven.

        Raises:
            ValueError: its inputs make no problem, or an argument is outside of its row's domain.
        """
        self.problem.arguments(self.row.name, self.arguments)

    def selection(self, variable: Component) -> tuple[Any, ...]:
        """Where the block lies in a variable: one index or slice a dimension."""
        lead = (self.element,) if self.layout.instances else ()
        along = () if self.row.over == "once" else (slice(self.start, self.start + len(self.values)),)
        return (*lead, *along)[: len(variable.dims)]


@dataclass(frozen=True)
class Group:
    """A layout with numbers: ``parameters`` by name, ``inputs`` as one-dimensional arrays by coordinate name.

    An index is counted where it is not given; zero has no sign.

    ``taylor_elements`` bounds how many arguments of a block the Taylor route is asked for, from the first: a route
    that integrates costs as much as its last time is late.

    Raises:
        ValueError: a name is missing or unknown, an input is empty, not finite or not one-dimensional, or lengths
            differ.
    """

    layout: Layout
    parameters: Mapping[str, float]
    inputs: Mapping[str, Any] = field(repr=False)
    taylor_elements: int | None = None

    def __post_init__(self) -> None:
        from reference.arithmetic.arrays import np, unsigned_zeros

        wanted = {coordinate.name: coordinate for coordinate in self.layout.given}
        index = "" if self.layout.index is None else self.layout.index.name
        parameters = {parameter.name for parameter in self.layout.parameters}
        if set(self.inputs) - {index} != set(wanted) or set(self.parameters) != parameters:
            raise ValueError(
                f"{self.layout.path} needs the inputs {sorted(wanted)} and parameters {sorted(parameters)}."
            )
        arrays = {name: unsigned_zeros(np.asarray(self.inputs[name], dtype=wanted[name].dtype)) for name in wanted}
        if self.layout.index is not None:
            arrays |= self._counted(self.layout.index, next(iter(arrays.values())).size)
        for name, array in arrays.items():
            if array.ndim != 1 or not array.size or not np.isfinite(array).all():
                raise ValueError(f"{self.layout.path}/{name} must be a non-empty list of finite numbers.")
            if array.size != arrays[self.layout.dimension_of(name)].size:
                raise ValueError(f"{self.layout.path}/{name} and its axis differ in length.")
        object.__setattr__(self, "inputs", arrays)
        object.__setattr__(self, "parameters", {name: float(unsigned_zeros(x)) for name, x in self.parameters.items()})

    def _counted(self, index: Coordinate, count: int) -> dict[str, np.ndarray]:
        """The index 0, 1, 2, ..., which may have been given as that and nothing else."""
        from reference.arithmetic.arrays import np

        counted = np.arange(count, dtype=index.dtype)
        if not np.array_equal(self.inputs.get(index.name, counted), counted):
            raise ValueError(f"{self.layout.path}/{index.name} counts its elements 0, 1, 2, ...; it cannot be chosen.")
        return {index.name: counted}

    def size(self, dims: tuple[str, ...]) -> tuple[int, ...]:
        """The shape that belongs to these dimensions."""
        return tuple(self.inputs[name].size for name in dims)

    @property
    def elements(self) -> int:
        """How many problems there are."""
        first = self.layout.first
        return self.inputs[first[0].name].size if first else 1

    def blocks(self) -> Iterator[Block]:
        """The work of this group in the order of storage."""
        for element in range(self.elements):
            instance = {axis.name: self.inputs[axis.name][element].item() for axis in self.layout.instances}
            for row in self.layout.rows:
                for start, values in self._stretches(row):
                    key = f"{self.layout.path} {element} {row.name} {start}"
                    inputs = {**instance, **self.parameters}
                    yield Block(key, self.layout, inputs, element, row, start, values, self.taylor_elements)

    def _stretches(self, row: Row) -> Iterator[tuple[int, np.ndarray]]:
        if row.over == "once":
            from reference.arithmetic.arrays import np

            yield 0, np.empty(0)
            return
        values = self.inputs[self.layout.over[row.over].name]
        for start in range(0, values.size, BLOCK_LENGTH):
            yield start, values[start : start + BLOCK_LENGTH]
