"""Careful opening: what a file must be before a number of it is believed.

HDF5 can point to other files, run filters and describe arrays larger than any memory.  None of that is part of a
dataset, so each object is compared with what the schema expects before it is read.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import h5py
from h5py import h5d, h5o, h5t, h5z

from reference.catalogue import LAYOUTS
from reference.names import short, unknown
from reference.store.content import dimensions, parameters_of, text_attribute
from reference.store.errors import DatasetError
from reference.store.schema import (
    ATTRIBUTE_LIMIT,
    FEW,
    LIMB,
    PROVENANCE,
    SCHEMA_VERSION,
    TAIL_LIMBS,
    arrays,
    exact_texts,
    group_attributes,
    limb_axis,
    root_attributes,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reference.plan import Layout
    from reference.store.schema import Array

__all__ = ["SIGNATURE", "inspect"]

SIGNATURE = b"\x89HDF\r\n\x1a\n"
SCALE_ATTRIBUTES = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates"}
MAX_ATTRIBUTES = 64
CHECKSUM_BYTES = 4
TYPES = {"<f8": h5t.IEEE_F64LE, "<i4": h5t.STD_I32LE}


def inspect(file: h5py.File, size: int) -> tuple[Layout, ...]:
    """Compare an open file of ``size`` bytes with the schema; return the layouts of its groups.

    Raises:
        DatasetError: an object is not what the schema says; the message names it.
    """
    return Inspection(file, size).layouts()


class Inspection:
    """One walk through a file, guided by the names that the schema knows."""

    def __init__(self, file: h5py.File, size: int) -> None:
        self._file, self._size = file, size
        self._addresses: dict[int, str] = {}
        self._dims: dict[str, tuple[str, ...]] = {}

    def _refuse(self, name: str, why: str) -> DatasetError:
        return DatasetError(f"'{self._file.filename}': {name} {why}.")

    def layouts(self) -> tuple[Layout, ...]:
        self._attributes(self._file)
        version = text_attribute(self._file, "schema_version")
        if version != SCHEMA_VERSION:
            raise self._refuse("/", f"has schema version '{version}'; version '{SCHEMA_VERSION}' is read")
        told = {name: text_attribute(self._file, name) for name in ("version", "profile", "fingerprint")}
        self._says(self._file, root_attributes(told["version"], told["profile"]))
        paths = {layout.path: layout for layout in LAYOUTS}
        self._array(self._member(self._file, LIMB, h5py.Dataset), limb_axis(), {LIMB: TAIL_LIMBS})
        found = self._tree(self._file, paths, {LIMB, PROVENANCE})
        provenance = self._member(self._file, PROVENANCE, h5py.Group)
        self._attributes(provenance)
        self._names(provenance, set())
        if not found:
            raise self._refuse("/", "holds no group of the schema")
        for path, names in dimensions(self._file).items():
            if names != self._dims[path]:
                raise self._refuse(path, f"has not the dimension scales {', '.join(self._dims[path])}")
        return tuple(layout for layout in LAYOUTS if layout.path in found)

    def _tree(self, group: h5py.Group, paths: dict[str, Layout], besides: set[str]) -> set[str]:
        """The layout groups at and below a group."""
        here = group.name.rstrip("/")
        if here in paths:
            self._group(group, paths[here])
            return {here}
        below = {path[len(here) + 1 :].partition("/")[0] for path in paths if path.startswith(here + "/")}
        found: set[str] = set()
        for name in self._names(group, below | besides):
            if name not in besides:
                child = self._member(group, name, h5py.Group)
                self._attributes(child)
                found |= self._tree(child, paths, set())
        return found

    def _names(self, group: h5py.Group, allowed: set[str]) -> list[str]:
        count = group.id.get_num_objs()
        if count > len(allowed):
            raise self._refuse(group.name, f"has {count} members where the schema has at most {len(allowed)}")
        names = list(group)
        for name in names:
            if name not in allowed:
                raise self._refuse(
                    group.name, f"has a member that is not in the schema: {unknown('name', name, allowed)}"[:-1]
                )
        return names

    def _member(self, group: h5py.Group, name: str, kind: type) -> Any:
        """A member behind a hard link, of the expected kind, that no other link leads to."""
        path = f"{group.name.rstrip('/')}/{name}"
        if name not in group.id:
            raise self._refuse(path, "is missing")
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise self._refuse(path, "is a soft or external link; only hard links are accepted")
        if group.get(name, getclass=True) is not kind:
            raise self._refuse(path, f"is not a {kind.__name__.lower()}")
        found = group[name]
        address = h5o.get_info(found.id).addr
        if address in self._addresses:
            raise self._refuse(path, f"is the same object as {self._addresses[address]}")
        self._addresses[address] = path
        return found

    def _group(self, group: h5py.Group, layout: Layout) -> None:
        parameters = parameters_of(group)
        if set(parameters) != {parameter.name for parameter in layout.parameters}:
            raise self._refuse(group.name, f"has the parameters {sorted(parameters)}, not the schema's")
        self._attributes(group)
        self._says(group, group_attributes(layout, parameters))
        expected = {array.name: array for array in arrays(layout)}
        self._names(group, set(expected))
        lengths = {LIMB: TAIL_LIMBS}
        for array in expected.values():
            dataset = self._member(group, array.name, h5py.Dataset)
            if array.is_scale and dataset.ndim == 1:
                lengths[array.name] = dataset.shape[0]
            self._array(dataset, array, lengths)

    def _array(self, dataset: h5py.Dataset, array: Array, lengths: dict[str, int]) -> None:
        self._storage(dataset, array)
        self._attributes(dataset)
        shape = tuple(lengths.get(name, -1) for name in array.dims)
        if dataset.shape != shape:
            raise self._refuse(dataset.name, f"has shape {dataset.shape} where its coordinates make {shape}")
        self._dims[dataset.name] = array.dims
        if bool(dataset.is_scale) != array.is_scale:
            raise self._refuse(dataset.name, f"is {'not ' if array.is_scale else ''}a dimension scale")
        self._says(dataset, array.attributes)
        if array.is_input:
            self._repeats(dataset)

    def _says(self, target: Any, expected: Mapping[str, str | float]) -> None:
        """Every attribute that the schema knows beforehand is there, and says what the schema says."""
        for name, value in expected.items():
            if isinstance(value, str) and (text := text_attribute(target, name)) != value:
                raise self._refuse(
                    target.name, f"has the attribute '{name}' = '{short(text)}' where '{short(value)}' is expected"
                )

    def _repeats(self, dataset: h5py.Dataset) -> None:
        """A few inputs are repeated as decimals and hex floats, and those are the numbers themselves."""
        few = dataset.dtype.kind == "f" and dataset.size <= FEW
        expected = exact_texts(dataset[...].tolist()) if few else {}
        self._says(dataset, expected)
        for name in ("decimal", "hex"):
            if name in dataset.attrs and name not in expected:
                raise self._refuse(dataset.name, f"has the attribute '{name}', which inputs like it do not have")

    def _storage(self, dataset: h5py.Dataset, array: Array) -> None:
        """Type, storage, filters and chunks, before any element is read."""
        properties = dataset.id.get_create_plist()
        if not dataset.id.get_type().equal(TYPES[array.dtype.str]):
            raise self._refuse(dataset.name, f"is not stored as little-endian {array.dtype.name}")
        if properties.get_layout() != h5d.CHUNKED or properties.get_external_count():
            raise self._refuse(dataset.name, "is not stored in chunks of this file")
        filters = [properties.get_filter(i)[0] for i in range(properties.get_nfilters())]
        if filters != [h5z.FILTER_FLETCHER32]:
            raise self._refuse(dataset.name, "has other filters than the checksum Fletcher32")
        shape, chunk = dataset.shape, dataset.chunks
        if not dataset.ndim or dataset.maxshape != shape or math.prod(shape) * array.dtype.itemsize > self._size:
            raise self._refuse(dataset.name, f"has the impossible shape {shape}")
        stored = math.prod(chunk) * array.dtype.itemsize + CHECKSUM_BYTES
        count = math.prod(-(-length // step) for length, step in zip(shape, chunk, strict=True))
        if stored > self._size or dataset.id.get_num_chunks() != count:
            raise self._refuse(dataset.name, "lacks some of its chunks")
        for i in range(count):
            info = dataset.id.get_chunk_info(i)
            if info.filter_mask or info.size != stored or info.byte_offset + stored > self._size:
                raise self._refuse(dataset.name, f"has a chunk that is unchecked or misplaced, number {i}")

    def _attributes(self, target: Any) -> None:
        """Few, small, and of the known types."""
        if len(target.attrs) > MAX_ATTRIBUTES:
            raise self._refuse(target.name, f"has more than {MAX_ATTRIBUTES} attributes")
        for name in target.attrs:
            if name in SCALE_ATTRIBUTES:
                continue
            attribute = target.attrs.get_id(name)
            kind = attribute.get_type()
            text = (
                isinstance(kind, h5t.TypeStringID) and not kind.is_variable_str() and kind.get_cset() == h5t.CSET_UTF8
            )
            number = any(kind.equal(known) for known in TYPES.values())
            if not (text or number) or len(attribute.shape) > 1 or attribute.get_storage_size() > ATTRIBUTE_LIMIT:
                raise self._refuse(target.name, f"has the attribute '{name}' of an unexpected type or size")
            if text and not isinstance(target.attrs[name], (str, bytes)):
                raise self._refuse(target.name, f"has the attribute '{name}', which is not one text")
