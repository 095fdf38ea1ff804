"""What stands in the file: names, attributes and the schema that writer and reader share.

Schema version 2: a root with the scale ``limb``, groups as their layouts say, and ``/provenance``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.binary64 import hexadecimal, shortest

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from reference.plan import Component, Coordinate, Layout

__all__ = [
    "ATTRIBUTE_LIMIT",
    "FEW",
    "LIMB",
    "PROVENANCE",
    "ROOT",
    "SCHEMA_VERSION",
    "Array",
    "arrays",
    "exact_texts",
    "group_attributes",
    "limb_axis",
    "root_attributes",
]

SCHEMA_VERSION = "2"
PROVENANCE = "provenance"
LIMB = "limb"
TAIL_LIMBS = 2
ATTRIBUTE_LIMIT = 64_000
"""Bytes; netCDF and HDF5 tools refuse attributes of 64 KiB and more."""
FEW = 64
"""Inputs of up to this many elements carry their decimals and hex floats as attributes."""

ROOT = {
    "title": "Horologium: proven reference values of classical mechanics",
    "Conventions": "CF-1.11",
    "license": "CC-BY-4.0",
    "creators": "The Horologium developers",
    "institution": "The Horologium developers",
    "references": "C. Huygens, Horologium Oscillatorium, 1673; P. F. Byrd and M. D. Friedman, Handbook of Elliptic "
    "Integrals, Springer 1971; NIST Digital Library of Mathematical Functions, chapters 19, 20 and 22; further ones "
    "stand beside the variables",
    "source": "closed forms, integrals and zeros in ball arithmetic, each limb the one correct rounding of the exact "
    "value; held against the Taylor method in MPFR arithmetic and against quadrature and elliptic functions of mpmath",
    "inputs": "exact binary64",
    "comment": "x = value + tail[0] + tail[1]: value is x correctly rounded to binary64, each tail limb the correctly "
    "rounded rest; about 48 digits",
    "fingerprint_definition": "SHA-256 over the groups and datasets in order of path, provenance left out: see "
    "fingerprint.py in the source",
}
"""Root attributes that are the same in every file of this schema version."""


def root_attributes(version: str, profile: str) -> dict[str, str]:
    """The root attributes of a file, except for its fingerprint; the profile may be a grid file's name."""
    numbers = "config" if profile.endswith(".toml") else "profile"
    command = f"python -m reference build --{numbers} {profile}"
    return {
        **ROOT,
        "version": version,
        "schema_version": SCHEMA_VERSION,
        "profile": profile,
        "command": command,
    }


def exact_texts(numbers: Sequence[float]) -> dict[str, str]:
    """The attributes in which a few exact inputs are repeated for readers: shortest decimals, and hex floats."""
    return {"decimal": " ".join(map(shortest, numbers)), "hex": " ".join(map(hexadecimal, numbers))}


def group_attributes(layout: Layout, parameters: Mapping[str, float]) -> dict[str, str | float]:
    """The attributes of a group with these fixed parameters."""
    found: dict[str, str | float] = {
        "long_name": layout.long_name,
        "statement": layout.statement,
        "difficulty": layout.difficulty,
        "parameters": " ".join(parameter.name for parameter in layout.parameters),
    }
    for parameter in layout.parameters:
        name, number = parameter.name, float(parameters[parameter.name])
        found |= {name: number, f"{name}_units": parameter.units, f"{name}_long_name": parameter.long_name}
        found |= {f"{name}_{kind}": text for kind, text in exact_texts([number]).items()}
    return found


@dataclass(frozen=True)
class Array:
    """One dataset of a group: what it must look like.

    ``dims`` are the names of its axes, ``limb`` the root's; ``attributes`` those that are known beforehand.
    An input's numbers may be repeated in its attributes.
    """

    name: str
    dtype: np.dtype[Any]
    dims: tuple[str, ...]
    attributes: Mapping[str, str]
    is_scale: bool = False
    is_input: bool = False


def arrays(layout: Layout) -> Iterator[Array]:
    """The datasets of a group in order: axes, further inputs, then each variable and its tail."""
    for coordinate in layout.coordinates:
        dimension = layout.dimension_of(coordinate.name)
        own = coordinate.name == dimension
        yield Array(coordinate.name, coordinate.dtype, (dimension,), _described(coordinate), own, is_input=True)
    for variable in layout.variables:
        yield from _variable_arrays(layout, variable)


def limb_axis() -> Array:
    """The axis of the tail's limbs at the root."""
    attributes = {
        "units": "1",
        "long_name": "limb of the tail",
        "definition": "x = value + tail[0] + tail[1]",
    }
    return Array(LIMB, np.dtype("<i4"), (LIMB,), attributes, is_scale=True)


def _described(coordinate: Coordinate) -> dict[str, str]:
    attributes = {
        "units": coordinate.units,
        "long_name": coordinate.long_name,
        "definition": coordinate.definition,
    }
    if coordinate.meanings:
        attributes["flag_meanings"] = " ".join(coordinate.meanings)
    return attributes


def _variable_arrays(layout: Layout, variable: Component) -> Iterator[Array]:
    quantity = variable.quantity
    float64 = np.dtype("<f8")
    value = {
        "units": quantity.units,
        "long_name": quantity.long_name,
        "definition": quantity.definition,
        "reference": layout.reference,
        "ancillary_variables": f"{quantity.name}_tail",
    }
    tail = {
        "units": quantity.units,
        "long_name": f"{quantity.long_name}: the limbs after the double",
        "definition": f"exact value = {quantity.name} + tail[0] + tail[1]",
    }
    yield Array(quantity.name, float64, variable.dims, value)
    yield Array(f"{quantity.name}_tail", float64, (*variable.dims, LIMB), tail)
