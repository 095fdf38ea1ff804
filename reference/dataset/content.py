"""What a file says, read in a defined order: its objects, their dimensions, and the fingerprint of it all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from h5py import h5a, h5o

from reference.arithmetic.binary64 import is_negative_zero
from reference.dataset.attributes import refusal, text_of, value_of
from reference.dataset.errors import DatasetError
from reference.dataset.fingerprint import Digest, pieces
from reference.dataset.schema import PROVENANCE
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["dimensions", "fingerprint", "parameters_of"]


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
