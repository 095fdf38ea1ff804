"""The identity of a dataset: one SHA-256 over what it says, and nothing of how or when it was made.

The hash runs over the line ``horologium-fingerprint-1`` and then, in ASCII order of path, over each group with fixed
parameters and each dataset, ``/provenance`` left out:

- a group: one line of JSON with its path, the hex floats of its parameters and, where they are texts, its inputs;
- a dataset: one line of JSON with path, shape, dtype, dimension names, units and definition, and after it the
  little-endian bytes of its elements in C order.

The fingerprint of one group is the same hash over its own lines and elements.

JSON is ASCII with sorted keys and no spaces; a line ends in a line feed.
"""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from h5py import h5a, h5o

from reference.arithmetic.arrays import is_negative_zero
from reference.arithmetic.binary64 import hexadecimal
from reference.dataset.attributes import refusal, text_of, value_of
from reference.dataset.errors import DatasetError
from reference.dataset.schema import PROVENANCE
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["dimensions", "fingerprint", "fingerprints", "parameters_of", "pieces"]


def parameters_of(group: h5py.Group) -> dict[str, float]:
    """The fixed parameters of a group by name; empty where it names none.

    Raises:
        DatasetError: one that it names is not there as a finite float64.
    """
    names = text_of(group, "parameters").split() if h5a.exists(group.id, b"parameters") else []
    found = {}
    for name in names:
        number = value_of(group, name)
        if not isinstance(number, float) or not np.isfinite(number):
            raise refusal(group, f"has the parameter '{short(name)}', which is no finite float64")
        found[name] = number
    return found


def dimensions(file: h5py.File) -> dict[str, tuple[str, ...]]:
    """The names of the axes of each dataset by path; a scale's own is its name.

    They are read from the scales, whose lists of users are checksummed.  The users' lists of scales, which other
    readers follow, are in a part of HDF5 files that has no checksum, and one flipped bit there can make HDF5 loop.

    Raises:
        DatasetError: an axis has not exactly one scale.
    """
    datasets = {path: found for path, found in _objects(file) if isinstance(found, h5py.Dataset)}
    axes: dict[str, list[list[str]]] = {path: [[] for _ in found.shape] for path, found in datasets.items()}
    paths = {h5o.get_info(found.id).addr: path for path, found in datasets.items()}
    for path, scale in datasets.items():
        if not scale.is_scale:
            continue
        name = path.rpartition("/")[2]
        axes[path] = [[name]]
        for reference, axis in scale.attrs.get("REFERENCE_LIST", ()):
            user = paths.get(h5o.get_info(file[reference].id).addr)
            if user is None or axis >= len(axes[user]):
                raise DatasetError(f"'{file.filename}': {path} is the scale of an axis that is not there.")
            axes[user][axis].append(name)
    for path, names in axes.items():
        if any(len(name) != 1 for name in names):
            raise DatasetError(f"'{file.filename}': an axis of {path} has not exactly one of the dimension scales.")
    return {path: tuple(name for (name,) in names) for path, names in axes.items()}


def fingerprint(file: h5py.File, *, signed_zeros: bool) -> str:
    """The fingerprint of an open file, as ``fingerprints`` has it."""
    return fingerprints(file, signed_zeros=signed_zeros)[""]


def fingerprints(file: h5py.File, *, signed_zeros: bool) -> dict[str, str]:
    """The fingerprints of an open file, by "", and of its groups by path: every number is read, and must be finite.

    Raises:
        DatasetError: a number is not finite, or is -0.0 without ``signed_zeros``, or what the fingerprint needs is not
            there.
    """
    digests = {"": Digest()}
    dims = dimensions(file)
    for path, found in sorted(_objects(file), key=lambda pair: pair[0]):
        if isinstance(found, h5py.Dataset):
            hashed = [digests[home] for home in ("", path.rpartition("/")[0] or "/") if home in digests]
            for digest in hashed:
                digest.line(
                    path=path,
                    shape=list(found.shape),
                    dtype=found.dtype.str,
                    dimensions=list(dims[path]),
                    units=text_of(found, "units"),
                    definition=text_of(found, "definition"),
                )
            for part in _parts(found, signed_zeros):
                data = np.ascontiguousarray(part, dtype=found.dtype).tobytes()
                for digest in hashed:
                    digest.elements(data)
        elif h5a.exists(found.id, b"parameters"):
            digests[path] = Digest()
            parameters = {name: hexadecimal(value) for name, value in parameters_of(found).items()}
            inputs = {"inputs": text_of(found, "inputs")} if h5a.exists(found.id, b"inputs") else {}
            for home in ("", path):
                digests[home].line(path=path, parameters=parameters, **inputs)
    return {home: digest.hexdigest() for home, digest in digests.items()}


def _objects(group: h5py.Group) -> Iterator[tuple[str, Any]]:
    for name, found in group.items():
        if group.name == "/" and name == PROVENANCE:
            continue
        yield found.name, found
        if isinstance(found, h5py.Group):
            yield from _objects(found)


def _parts(dataset: h5py.Dataset, signed_zeros: bool) -> Iterator[np.ndarray]:
    for selection in pieces(dataset.shape):
        part = dataset[selection]
        if not np.isfinite(part).all():
            raise refusal(dataset, "has an element that is not finite")
        if not signed_zeros and is_negative_zero(part).any():
            raise refusal(dataset, "has an element -0.0; zero has no sign there")
        yield part


PIECE_ELEMENTS = 1 << 17


class Digest:
    """The hash as it runs: groups and datasets must come in order of path."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256(b"horologium-fingerprint-1\n")

    def line(self, **record: Any) -> None:
        """Add a line of JSON."""
        text = json.dumps(record, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
        self._hash.update(text.encode() + b"\n")

    def elements(self, data: bytes) -> None:
        """Add elements in C order."""
        self._hash.update(data)

    def hexdigest(self) -> str:
        """The fingerprint."""
        return self._hash.hexdigest()


def pieces(shape: tuple[int, ...]) -> Iterator[tuple[slice, ...]]:
    """Selections that together run through an array of this shape in C order, each of bounded size."""
    if not shape:
        yield ()
        return
    rest = int(np.prod(shape[1:]))
    if rest > PIECE_ELEMENTS and len(shape) > 1:
        for i in range(shape[0]):
            for inner in pieces(shape[1:]):
                yield (slice(i, i + 1), *inner)
        return
    step = max(1, PIECE_ELEMENTS // max(1, rest))
    for start in range(0, shape[0], step):
        yield (slice(start, min(start + step, shape[0])),)
