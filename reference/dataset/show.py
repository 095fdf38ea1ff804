"""A dataset as text or JSON: its tree, or one variable with its numbers."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.dataset.fingerprint import pieces
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reference.dataset.reader import Dataset, Variable

__all__ = ["show"]


def show(dataset: Dataset, path: str | None, form: str) -> Iterator[str]:
    """Yield lines: the tree of a dataset or of a group, or a variable's attributes and one line an element.

    Raises:
        ValueError: there is no group or variable of this path; the message gives the nearest.
    """
    name = (path or "").strip("/")
    if name in dataset:
        yield from (_variable_json if form == "json" else _variable_text)(dataset[name])
        return
    members = [found for found in dataset.values() if not name or found.name.startswith(f"{name}/")]
    if not members:
        raise ValueError(unknown("path", name, [*dataset.groups, *dataset]))
    if form == "json":
        yield json.dumps({"attributes": dataset.attrs, "variables": {m.name: _described(m) for m in members}}, indent=2)
        return
    if not name:
        yield from (f"{key}: {dataset.attrs[key]}" for key in ("title", "version", "profile", "fingerprint"))
    group = ""
    for found in members:
        home, _, short = found.name.rpartition("/")
        if home != group:
            group = home
            yield ""
            yield f"/{home}: {dataset.groups[home]['long_name']} ({_parameters(dataset, home)})"
        shape = ", ".join(f"{dim} {length}" for dim, length in zip(found.dims, found.shape, strict=True))
        yield f"  {short} [{shape}] {found.units}: {found.attrs['long_name']}"


def _parameters(dataset: Dataset, group: str) -> str:
    attributes = dataset.groups[group]
    names = attributes["parameters"].split()
    return str(attributes.get("inputs", "")) or ", ".join(
        f"{name} = {attributes[name]!r} {attributes[name + '_units']}" for name in names
    )


def _described(variable: Variable) -> dict[str, Any]:
    return {"dims": list(variable.dims), "shape": list(variable.shape), "input": variable.is_input, **variable.attrs}


def _variable_text(variable: Variable) -> Iterator[str]:
    shape = ", ".join(f"{dim} {length}" for dim, length in zip(variable.dims, variable.shape, strict=True))
    yield f"/{variable.name} [{shape}]"
    yield from (f"  {key}: {value}" for key, value in variable.attrs.items())
    yield "# index: value" if variable.is_input else "# index: value tail[0] tail[1]"
    for selection in pieces(variable.shape):
        offset = [part.start for part in selection] + [0] * (len(variable.shape) - len(selection))
        value, tail = variable.read(selection)
        for index in np.ndindex(value.shape):
            place = ", ".join(str(start + i) for start, i in zip(offset, index, strict=True))
            rest = [] if variable.is_input else tail[index].tolist()
            yield f"[{place}]: {' '.join(repr(number) for number in (value[index].item(), *rest))}"


def _variable_json(variable: Variable) -> Iterator[str]:
    numbers: dict[str, Any] = {"value": variable.value.tolist()}
    if not variable.is_input:
        numbers["tail"] = variable.tail.tolist()
    yield json.dumps({"name": variable.name, **_described(variable), **numbers})
