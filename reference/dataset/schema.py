"""What stands in the file: names, attributes and the schema that writer and reader share.

A root with the scale ``limb``, groups as their layouts say, and ``/provenance``.
"""

from __future__ import annotations

import itertools
import shlex
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.binary64 import hexadecimal, shortest
from reference.layout import BLOCK_LENGTH

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from reference.declaration import Row
    from reference.layout import Component, Coordinate, Layout

__all__ = [
    "ATTRIBUTE_LIMIT",
    "FEW",
    "LIMB",
    "PROVENANCE",
    "RELEASED",
    "ROOT",
    "TAIL_LIMBS",
    "Array",
    "Schema",
    "arrays",
    "chunks",
    "exact_texts",
    "families_in",
    "group_attributes",
    "limb_axis",
    "root_attributes",
]

PROVENANCE = "provenance"
LIMB = "limb"
TAIL_LIMBS = 2
ATTRIBUTE_LIMIT = 64_000
"""Bytes; netCDF and HDF5 tools refuse attributes of 64 KiB and more."""
FAMILY = "--family"
FEW = 64
"""Inputs of up to this many elements carry their decimals and hex floats as attributes."""
RELEASED = {"0.1.0": "2026-11-23"}
"""The versions of the program that files can be of, and when each was released."""

ROOT = {
    "title": "Horologium: proven reference values of classical mechanics",
    "Conventions": "CF-1.11",
    "license": "CC-BY-4.0",
    "creators": "The Horologium developers",
    "institution": "The Horologium developers",
    "references": "C. Huygens, Horologium Oscillatorium, 1673; P. F. Byrd and M. D. Friedman, Handbook of Elliptic "
    "Integrals, Springer 1971; NIST Digital Library of Mathematical Functions, chapters 19, 20 and 22; further ones "
    "stand beside the variables",
    "source": "closed forms, integrals, zeros and flows in ball arithmetic, each limb the one correct rounding of the "
    "exact value; held against the Taylor method in MPFR arithmetic and against quadrature and elliptic functions of "
    "mpmath",
    "inputs": "exact binary64",
    "comment": "x = value + tail[0] + tail[1]: value is x correctly rounded to binary64, each tail limb the correctly "
    "rounded rest; about 48 digits",
    "fingerprint_definition": "SHA-256 over the groups and datasets in order of path, provenance left out; of a group "
    "over it alone: see fingerprint.py in the source",
}
"""Root attributes that are the same in every file of the newest schema version."""


@dataclass(frozen=True)
class Schema:
    """One version of what a file says.

    Attributes:
        version: its name, the root attribute ``schema_version``.
        root: root attributes that are the same in every file.
        layouts: the groups that a file can hold; where two have the same path, a group is of either.
        has_history: whether the root has the attribute ``history``.
        names_auxiliary: whether a variable names the inputs that are no dimensions in the attribute ``coordinates``,
            and a label axis has as many ``flag_values`` as ``flag_meanings``.
        monotonic_axes: whether the numbers on every axis rise or fall.
        signed_zeros: whether a zero may be stored as -0.0.
        names_families: whether the command may name families whose groups the file holds.
        group_fingerprints: whether each group has a fingerprint of its own.
    """

    version: str
    root: Mapping[str, str]
    layouts: tuple[Layout, ...]
    has_history: bool
    names_auxiliary: bool
    monotonic_axes: bool
    signed_zeros: bool
    names_families: bool
    group_fingerprints: bool


def root_attributes(
    schema: Schema, version: str, profile: str, date: str, families: Sequence[str] = ()
) -> dict[str, str]:
    """The root attributes of a file, except for its fingerprint.

    Args:
        schema: its schema.
        version: of the program.
        profile: its name, or that of a grid file.
        date: when it was built, in ISO form; empty where that is not told.
        families: those that were named when it was built.
    """
    numbers = "config" if profile.endswith(".toml") else "profile"
    named = "".join(f" {FAMILY} {shlex.quote(family)}" for family in families)
    command = f"python -m reference build --{numbers} {profile}{named}"
    found = {
        **schema.root,
        "version": version,
        "schema_version": schema.version,
        "profile": profile,
        "command": command,
    }
    if schema.has_history:
        found["history"] = f"{date} {command} (horologium {version})".lstrip()
    return found


def families_in(command: str) -> tuple[str, ...]:
    """The families that the command of a file names."""
    try:
        words = shlex.split(command)
    except ValueError:  # a quotation without an end
        return ()
    return tuple(word for option, word in itertools.pairwise(words) if option == FAMILY)


def exact_texts(numbers: Sequence[float]) -> dict[str, str]:
    """The attributes in which a few exact inputs are repeated for readers: shortest decimals, and hex floats."""
    return {"decimal": " ".join(map(shortest, numbers)), "hex": " ".join(map(hexadecimal, numbers))}


def group_attributes(layout: Layout, parameters: Mapping[str, float]) -> dict[str, str | float]:
    """The attributes of a group with these fixed parameters."""
    found: dict[str, str | float] = {
        "long_name": layout.long_name,
        "parameters": " ".join(parameter.name for parameter in layout.parameters),
    }
    found |= {name: text for name in ("statement", "difficulty", "inputs") if (text := getattr(layout, name))}
    for parameter in layout.parameters:
        name, number = parameter.name, float(parameters[parameter.name])
        found |= {name: number, f"{name}_units": parameter.units, f"{name}_long_name": parameter.long_name}
        found |= {f"{name}_{kind}": text for kind, text in exact_texts([number]).items()}
    return found


@dataclass(frozen=True)
class Array:
    """One dataset of a group: what it must look like.

    ``dims`` are the names of its axes, ``limb`` the root's; ``attributes`` those that are known beforehand.
    An input's numbers may be repeated in its attributes; it is an index where these are 0, 1, 2, ....
    A ``row`` has measurements, and where it is asked once decimals, in the attributes of its variable.
    """

    name: str
    dtype: np.dtype[Any]
    dims: tuple[str, ...]
    attributes: Mapping[str, str | float | int | tuple[int, ...]]
    is_scale: bool = False
    is_input: bool = False
    is_index: bool = False
    row: Row | None = None


def arrays(layout: Layout, schema: Schema) -> Iterator[Array]:
    """The datasets of a group in order: axes, auxiliary inputs, then each variable and its tail."""
    for coordinate in layout.coordinates:
        dimension = layout.dimension_of(coordinate.name)
        yield Array(
            coordinate.name,
            np.dtype(coordinate.dtype),
            (dimension,),
            _described(coordinate, schema),
            is_scale=coordinate.name == dimension,
            is_input=True,
            is_index=coordinate is layout.index,
        )
    auxiliary = " ".join(extra.name for extra in layout.auxiliary) if schema.names_auxiliary else ""
    for variable in layout.variables:
        yield from _variable_arrays(layout, variable, {"coordinates": auxiliary} if auxiliary else {})


def chunks(array: Array, shape: tuple[int, ...]) -> tuple[int, ...]:
    """The shape of an array's chunks: one block's share of one instance; the whole axis of an input up to a block."""
    chunk = tuple(min(length, BLOCK_LENGTH) for length in shape)
    return (1, *chunk[1:]) if len([name for name in array.dims if name != LIMB]) > 1 else chunk


def limb_axis() -> Array:
    """The axis of the tail's limbs at the root."""
    attributes = {
        "units": "1",
        "long_name": "limb of the tail",
        "definition": "x = value + tail[0] + tail[1]",
    }
    return Array(LIMB, np.dtype("<i4"), (LIMB,), attributes, is_scale=True)


def _described(coordinate: Coordinate, schema: Schema) -> dict[str, str | tuple[int, ...]]:
    attributes: dict[str, str | tuple[int, ...]] = {
        "units": coordinate.units,
        "long_name": coordinate.long_name,
        "definition": coordinate.definition,
    }
    if coordinate.meanings:
        attributes["flag_meanings"] = " ".join(coordinate.meanings)
        if schema.names_auxiliary:
            attributes["flag_values"] = tuple(range(len(coordinate.meanings)))
    return attributes


def _variable_arrays(layout: Layout, variable: Component, besides: dict[str, str]) -> Iterator[Array]:
    quantity = variable.quantity
    float64 = np.dtype("<f8")
    value = {
        "units": quantity.units,
        "long_name": quantity.long_name,
        "definition": quantity.definition,
        "reference": layout.reference,
        "ancillary_variables": f"{quantity.name}_tail",
        **besides,
    }
    tail = {
        "units": quantity.units,
        "long_name": f"{quantity.long_name}: the limbs after the double",
        "definition": f"exact value = {quantity.name} + tail[0] + tail[1]",
        **besides,
    }
    yield Array(quantity.name, float64, variable.dims, value, row=variable.row)
    yield Array(f"{quantity.name}_tail", float64, (*variable.dims, LIMB), tail)
