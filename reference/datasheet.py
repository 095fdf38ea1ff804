"""The datasheet of a dataset, written from the file itself."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from reference.certify import REQUIRED_DIGITS
from reference.cite import cite
from reference.exact import expansion

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reference.store import Dataset, Variable

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
This file holds such values for problems with a closed form, each proven: to test methods with, and to cite.

## What a number means

Inputs (coordinates and the groups' parameters) are exact binary64 numbers{example}.
A value x is stored as `x = value + tail[0] + tail[1]`: \
`value` is x correctly rounded to binary64 (nearest, ties to even), \
each limb of `NAME_tail` is the correctly rounded rest.
`value` alone is the correctly rounded double, with one limb it is a double-double, with both it has about 48 digits.

## Contents
"""
CLOSING = """
## How it is certified

- The **enclosure** decides: the closed form is evaluated in ball arithmetic (Arb), \
at rising precision until every point of the ball rounds to the same three limbs.
- The **Taylor** route integrates the equation of motion alone, with heyoka in MPFR arithmetic.
- The **quadrature** route evaluates integrals and elliptic functions with mpmath.

The last two must agree with the enclosure to {required} digits (at most 60 are compared), \
relative to the largest value of the quantity along a trajectory, or nothing is written.
The columns above give the least number of agreeing digits of each route and over how many elements it was compared; \
in the file they are the attributes `taylor_digits`, `taylor_checked_elements`, \
`quadrature_digits` and `quadrature_checked_elements`.
`python -m reference verify FILE` proves every limb again, from twice the working precision, and every decimal of \
the attributes `decimal`; the routes are asked again for some of each row.

## How to read it

Any tool that reads HDF5 or netCDF-4 will do; with h5py:

```python
import h5py
with h5py.File("{name}") as file:
    theta, tail = file["pendulum/libration/theta"][...], file["pendulum/libration/theta_tail"][...]
```

and with this package, which checks the file first:

```python
import reference
period = reference.load()["pendulum/libration/period"]
print(period.value, period.tail, period.units)
```

## How to trust it

`sha256sum -c SHA256SUMS` checks the bytes.
The fingerprint is a SHA-256 over the content alone \
(paths, shapes, types, dimension names, units, definitions and numbers); \
since every number is the one correct rounding, every build on any machine gives the same.
Versions of the tools, processor and, where SOURCE_DATE_EPOCH was set, the date stand in `/provenance`, outside it.

## How to cite it

```bibtex
{citation}
```
"""


def datasheet(dataset: Dataset) -> str:
    """The datasheet in Markdown: why, contents, how certified, how to read, cite and trust it."""
    values = {
        **dataset.attrs,
        "name": dataset.path.name,
        "bytes": f"{dataset.path.stat().st_size:,}",
        "elements": f"{sum(_count(variable) for variable in dataset.values() if not variable.is_input):,}",
        "example": _example(dataset),
        "required": REQUIRED_DIGITS,
        "citation": cite(dataset),
    }
    return OPENING.format(**values) + "\n".join(_contents(dataset)) + "\n" + CLOSING.format(**values)


def _example(dataset: Dataset) -> str:
    """The first parameter or input that is not the decimal that it is written as; empty where there is none."""
    inputs = (number for variable in dataset.values() if variable.is_input for number in variable.value.tolist())
    parameters = (number for group in dataset.parameters.values() for number in group.values())
    for number in (*parameters, *inputs):
        if Fraction(repr(number)) != Fraction(number):
            return f": {number!r} stands for {expansion(Fraction(number))}"
    return ""


def _count(variable: Variable) -> int:
    count = 1
    for length in variable.shape:
        count *= length
    return count


def _contents(dataset: Dataset) -> Iterator[str]:
    for group, attributes in dataset.groups.items():
        fixed = [
            f"{name} = {attributes[name]!r} {attributes[f'{name}_units']}" for name in attributes["parameters"].split()
        ]
        yield f"\n### `/{group}`: {attributes['long_name']}\n"
        yield f"Fixed: {', '.join(fixed)}.\n" if fixed else ""
        members = [variable for variable in dataset.values() if variable.name.rpartition("/")[0] == group]
        yield "| input | units | what it is | numbers |\n|---|---|---|---|"
        yield from (_input_line(variable) for variable in members if variable.is_input)
        yield "\n| variable | shape | units | definition | taylor | quadrature |\n|---|---|---|---|---|---|"
        yield from (_variable_line(variable) for variable in members if not variable.is_input)


def _short(variable: Variable) -> str:
    return variable.name.rpartition("/")[2]


def _input_line(variable: Variable) -> str:
    value = variable.value
    numbers = f"{value.size}, from {value.min().item()!r} to {value.max().item()!r}"
    return f"| `{_short(variable)}` | {variable.units} | {variable.attrs['long_name']} | {numbers} |"


def _variable_line(variable: Variable) -> str:
    shape = " × ".join(f"{dim} {length}" for dim, length in zip(variable.dims, variable.shape, strict=True))
    routes = " | ".join(_route(variable, route) for route in ("taylor", "quadrature"))
    return f"| `{_short(variable)}` | {shape} | {variable.units} | {variable.definition} | {routes} |"


def _route(variable: Variable, route: str) -> str:
    if f"{route}_digits" not in variable.attrs:
        return "not given by this route"
    digits, checked = variable.attrs[f"{route}_digits"], variable.attrs[f"{route}_checked_elements"]
    return (
        f"{digits:.0f} digits, {checked} elements" if digits == int(digits) else f"{digits} digits, {checked} elements"
    )
