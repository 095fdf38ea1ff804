"""The identity of a dataset: one SHA-256 over what it says, and nothing of how or when it was made.

The hash runs over the line ``horologium-fingerprint-1`` and then, in ASCII order of path, over each group with fixed
parameters and each dataset, ``/provenance`` left out:

- a group: one line of JSON with its path and the hex floats of its parameters;
- a dataset: one line of JSON with path, shape, dtype, dimension names, units and definition, and after it the
  little-endian bytes of its elements in C order.

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
    from collections.abc import Iterable, Iterator

__all__ = ["dimensions", "fingerprint", "parameters_of", "pieces"]


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
    """The fingerprint of an open file: every number is read, piece by piece, and must be finite.

    Raises:
        DatasetError: a number is not finite, or is -0.0 without ``signed_zeros``, or what the fingerprint needs is not
            there.
    """
    digest = Digest()
    dims = dimensions(file)
    for path, found in sorted(_objects(file), key=lambda pair: pair[0]):
        if isinstance(found, h5py.Dataset):
            described = text_of(found, "units"), text_of(found, "definition")
            digest.dataset(path, found.shape, dims[path], described, _parts(found, signed_zeros), found.dtype)
        elif h5a.exists(found.id, b"parameters"):
            digest.group(path, parameters_of(found))
    return digest.hexdigest()


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
    """The hash as it runs: ``group`` and ``dataset`` must come in order of path."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256(b"horologium-fingerprint-1\n")

    def _line(self, **record: Any) -> None:
        text = json.dumps(record, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
        self._hash.update(text.encode() + b"\n")

    def group(self, path: str, parameters: dict[str, float]) -> None:
        """Add a group with its fixed parameters."""
        self._line(path=path, parameters={name: hexadecimal(value) for name, value in parameters.items()})

    def dataset(
        self,
        path: str,
        shape: tuple[int, ...],
        dims: tuple[str, ...],
        described: tuple[str, str],
        parts: Iterable[np.ndarray],
        dtype: np.dtype[Any],
    ) -> None:
        """Add a dataset: ``described`` is its units and definition, ``parts`` its elements in C order."""
        units, definition = described
        self._line(
            path=path, shape=list(shape), dtype=dtype.str, dimensions=list(dims), units=units, definition=definition
        )
        for part in parts:
            self._hash.update(np.ascontiguousarray(part, dtype=dtype).tobytes())

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
