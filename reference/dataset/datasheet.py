"""The datasheet of a dataset, written from the file itself."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from reference.arithmetic.exact import expansion
from reference.dataset.cite import cite
from reference.names import printable, unknown
from reference.routes.agreement import REQUIRED_DIGITS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any

    from reference.dataset.reader import Dataset, Variable

__all__ = ["datasheet"]

OPENING = """\
# {title}

This page is printed by `python -m reference datasheet` from `{name}` itself.

| | |
|---|---|
| version | {version}, profile {profile}, schema {schema_version} |
| fingerprint | `sha256:{fingerprint}` |
| licence | {license} (the program: BSD-3-Clause) |
| size | {bytes} bytes, {elements} values of three limbs |

## Why it exists

An integrator can only be judged against values that are better than its own.
This file holds such values, each proven, of problems with a closed form and of flows: to test methods with, and to \
cite.

## What a number means

Inputs (coordinates and the groups' parameters) are exact binary64 numbers{example}.
A value x is stored as `x = value + tail[0] + tail[1]`: \
`value` is x correctly rounded to binary64 (nearest, ties to even), \
each limb of `NAME_tail` is the correctly rounded rest.
`value` alone is the correctly rounded double, with one limb it is a double-double, with both it has about 48 digits.

## The groups

"""
LEVELS = """
The level of difficulty is what a group asks of an integrator in double precision, in the words of NIST's reference \
datasets: lower, average or higher.
"""
CLOSING = """
## How it is certified

- The **enclosure** decides: the closed form is evaluated in ball arithmetic (Arb), \
or the flow of the equation is proven in it step by step where there is none (a group below `/flow`), \
at rising precision until every point of the ball rounds to the same three limbs.
- The **Taylor** route integrates the equation of motion alone, with heyoka in MPFR arithmetic.
- The **quadrature** route evaluates integrals and elliptic functions with mpmath.

The last two must agree with the enclosure to {required} digits (at most 60 are compared), \
relative to the largest value of the quantity along a trajectory, or nothing is written.
The tables above give the least number of agreeing digits of each route and over how many elements it was compared; \
in the file these are the attributes `taylor_digits`, `taylor_checked_elements`, \
`quadrature_digits` and `quadrature_checked_elements`.
`python -m reference verify FILE` proves every limb again, in other working precisions, and every decimal of \
the attributes `decimal`; the routes are asked again for some of each row.

## How to read it

Any tool that reads HDF5 or netCDF-4 will do; with h5py:

```python
import h5py
with h5py.File("{name}") as file:
    value, tail = file["{variable}"][...], file["{variable}_tail"][...]
```

and with this package, which checks the file first:

```python
import reference
found = reference.load("{name}"{families})["{variable}"]
print(found.value, found.tail, found.units)
```

## How to trust it

`sha256sum -c SHA256SUMS` checks the bytes.
The fingerprint is a SHA-256 over the content alone \
(paths, shapes, types, dimension names, units, definitions and numbers); \
since every number is the one correct rounding, every build on any machine gives the same.
Versions of the tools, processor and, where SOURCE_DATE_EPOCH was set, the date stand in `/provenance`, outside it.

## How to cite all of it

```bibtex
{citation}
```
"""


def datasheet(dataset: Dataset, group: str | None = None) -> str:
    """The datasheet in Markdown: why, a page for each group, how certified, how to read, trust and cite it.

    With ``group`` the page of that group alone.

    Raises:
        ValueError: there is no such group.
    """
    if group is not None:
        name = group.strip("/")
        if name not in dataset.groups:
            raise ValueError(unknown("group", group, dataset.groups))
        return "\n".join(_page(dataset, name)) + "\n"
    values = {
        **dataset.attrs,
        "name": printable(dataset.path.name),
        "bytes": f"{dataset.path.stat().st_size:,}",
        "elements": f"{sum(math.prod(variable.shape) for variable in dataset.values() if not variable.is_input):,}",
        "example": _example(dataset),
        "required": REQUIRED_DIGITS,
        "citation": cite(dataset),
        "families": f", families={list(dataset.families)!r}" if dataset.families else "",
        "variable": next(variable.name for variable in dataset.values() if not variable.is_input),
    }
    contents = [f"- `/{name}`: {dataset.groups[name]['long_name']}" for name in dataset.groups]
    pages = [line for name in dataset.groups for line in ("", *_page(dataset, name))]
    return OPENING.format(**values) + "\n".join([*contents, LEVELS, *pages]) + "\n" + CLOSING.format(**values)


def _example(dataset: Dataset) -> str:
    """The first parameter or input that is not the decimal that it is written as; empty where there is none."""
    inputs = (number for variable in dataset.values() if variable.is_input for number in variable.value.tolist())
    parameters = (number for group in dataset.parameters.values() for number in group.values())
    for number in (*parameters, *inputs):
        if Fraction(repr(number)) != Fraction(number):
            return f": {number!r} stands for {expansion(Fraction(number))}"
    return ""


def _page(dataset: Dataset, group: str) -> Iterator[str]:
    """One group: problem, level of difficulty, inputs, certified values, how certified, how to cite."""
    attributes = dataset.groups[group]
    members = [variable for variable in dataset.values() if variable.name.rpartition("/")[0] == group]
    inputs = [variable for variable in members if variable.is_input]
    values = [variable for variable in members if not variable.is_input]
    yield f"### `/{group}`: {attributes['long_name']}\n"
    if "statement" in attributes:  # schema version 1 has none
        level, _, why = attributes["difficulty"].partition(": ")
        yield f"**Problem**: {attributes['statement']}.\n"
        yield f"**Level of difficulty**: {level}" + (f" ({why}).\n" if why else ".\n")
    if "inputs" in attributes:
        yield f"**Inputs, exactly**: {attributes['inputs']}.\n"
    yield "| input | units | what it is | numbers |\n|---|---|---|---|"
    for name in attributes["parameters"].split():
        units, meaning = attributes[f"{name}_units"], attributes[f"{name}_long_name"]
        yield _line(f"`{name}`", units, meaning, repr(attributes[name]))
    yield from (_input_line(variable) for variable in inputs)
    yield "\n| certified variable | shape | units | definition | taylor | quadrature |\n|---|---|---|---|---|---|"
    yield from (_variable_line(variable) for variable in values)
    yield from _samples(inputs, values)
    yield from _reasons(values)
    sources = sorted({variable.attrs["reference"] for variable in values})
    yield f"\n**{'Source' if 'inputs' in attributes else 'Closed form'}**: {'; '.join(sources)}."
    mark = f", fingerprint sha256:{attributes['fingerprint']}" if "fingerprint" in attributes else ""
    yield f"\n**To cite this group**: {cite(dataset, 'text')} Group `/{group}`{mark}."


def _line(*cells: str) -> str:
    """A row of a table; a bar in a cell is no border."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _input_line(variable: Variable) -> str:
    value = variable.value
    labels = str(variable.attrs.get("flag_meanings", ""))
    numbers = labels.replace(" ", ", ") or f"{value.size}, from {value.min().item()!r} to {value.max().item()!r}"
    return _line(f"`{_short(variable)}`", variable.units, variable.attrs["long_name"], numbers)


def _variable_line(variable: Variable) -> str:
    shape = " × ".join(f"{dim} {length}" for dim, length in zip(variable.dims, variable.shape, strict=True)) or "one"
    routes = (_route(variable, route) for route in ("taylor", "quadrature"))
    return _line(f"`{_short(variable)}`", shape, variable.units, variable.definition, *routes)


def _short(variable: Variable) -> str:
    return variable.name.rpartition("/")[2]


def _route(variable: Variable, route: str) -> str:
    if f"{route}_digits" not in variable.attrs:
        return "none"
    digits, checked = variable.attrs[f"{route}_digits"], variable.attrs[f"{route}_checked_elements"]
    return f"{digits:g} digits, {checked} elements"


def _samples(inputs: Sequence[Variable], values: Sequence[Variable]) -> Iterator[str]:
    """The certified numbers that are asked once, of the first, the middle and the last instance."""
    scalars = [variable for variable in values if "decimal" in variable.attrs]
    if not scalars:
        return
    instances = math.prod(scalars[0].shape)
    chosen = sorted({0, instances // 2, instances - 1})
    axis = scalars[0].dims[0] if scalars[0].dims else ""
    along = [variable for variable in inputs if axis and variable.dims == (axis,)]
    titles = [f"`{_short(variable)}`" for variable in along] + ["certified variable", "value, every digit proven"]
    yield f"\n{_line(*titles)}\n" + "|---" * len(titles) + "|"
    for place in chosen:
        given = [_input_at(variable, place) for variable in along]
        for variable in scalars:
            digits = variable.attrs["decimal"].split()[place]
            yield _line(*given, f"`{_short(variable)}`", digits)


def _input_at(variable: Variable, place: int) -> str:
    number: Any = variable.value[place].item()
    labels = str(variable.attrs.get("flag_meanings", "")).split()
    return labels[number] if labels else repr(number)


def _reasons(values: Sequence[Variable]) -> Iterator[str]:
    """Why a route does not give a variable."""
    for route in ("taylor", "quadrature"):
        missing: dict[str, list[str]] = {}
        for variable in values:
            if f"{route}_reason" in variable.attrs:
                missing.setdefault(variable.attrs[f"{route}_reason"], []).append(f"`{_short(variable)}`")
        for reason, names in missing.items():
            yield f"\nNo {route} route for {', '.join(names)}: {reason}."
