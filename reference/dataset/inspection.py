"""Careful opening: what a file must be before a number of it is believed.

HDF5 can point to other files, run filters and describe arrays larger than any memory.  None of that is part of a
dataset, so each object is compared with what the schema expects before it is read.
"""

from __future__ import annotations

import itertools
import math
import re
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from h5py import h5d, h5l, h5o, h5z

from reference.arithmetic.arrays import is_negative_zero
from reference.dataset.attributes import TYPES, bounded, refusal, says, text_of, texts
from reference.dataset.catalogue import PROFILES, YOUR_OWN, is_family_name
from reference.dataset.claims import free_attributes, limbs_fault, measurement_fault
from reference.dataset.fingerprint import dimensions, parameters_of
from reference.dataset.plan import monotonic
from reference.dataset.schema import (
    ATTRIBUTE_LIMIT,
    FEW,
    LIMB,
    PROVENANCE,
    RELEASED,
    TAIL_LIMBS,
    arrays,
    chunks,
    exact_texts,
    families_in,
    group_attributes,
    limb_axis,
    root_attributes,
)
from reference.dataset.versions import SCHEMAS
from reference.named import is_own
from reference.names import is_grid_file, short, unknown

if TYPE_CHECKING:
    from reference.dataset.schema import Array, Schema
    from reference.layout import Layout

__all__ = ["SIGNATURE", "inspect"]

SIGNATURE = b"\x89HDF\r\n\x1a\n"
CHECKSUM_BYTES = 4
FINGERPRINT = re.compile(r"[0-9a-f]{64}")
DATE = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00")


def inspect(file: h5py.File, size: int, own: tuple[Layout, ...] = ()) -> Inspection:
    """Compare an open file of ``size`` bytes with the schema that it names, and the groups of the user's families.

    Raises:
        DatasetError: an object is not what the schema says; the message names it.
    """
    bounded(file)
    version = text_of(file, "schema_version")
    if version not in SCHEMAS:
        read = ", ".join(f"'{known}'" for known in SCHEMAS)
        raise refusal(file, f"has schema version '{short(version)}'; the versions {read} are read")
    return Inspection(file, size, SCHEMAS[version], own)


class Inspection:
    """One walk through a file, guided by the names that the schema knows.

    Attributes:
        schema: the schema of the file.
        layouts: those of its groups, in the order of the schema.
    """

    def __init__(self, file: h5py.File, size: int, schema: Schema, own: tuple[Layout, ...]) -> None:
        self._file, self._size, self.schema, self._known = file, size, schema, (*schema.layouts, *own)
        self._addresses: dict[int, str] = {}
        self._dims: dict[str, tuple[str, ...]] = {}
        self._decimals: dict[str, str] = {}
        self.layouts = self._walk()

    def _walk(self) -> tuple[Layout, ...]:
        families = self._root()
        self._array(self._member(self._file, LIMB, h5py.Dataset), limb_axis(), {LIMB: TAIL_LIMBS})
        variants: dict[str, list[Layout]] = {}
        for layout in self._known:
            variants.setdefault(layout.path, []).append(layout)
        found = self._tree(self._file, variants, {LIMB, PROVENANCE})
        if not found:
            raise refusal(self._file, "holds no group of the schema")
        for path, names in dimensions(self._file).items():
            if names != self._dims[path]:
                raise refusal(self._file[path], f"has not the dimension scales {', '.join(self._dims[path])}")
        layouts = tuple(layout for layout in self._known if found.get(layout.path) is layout)
        if any(is_own(family) for family in families) and set(found) <= {layout.path for layout in self.schema.layouts}:
            raise refusal(self._file, f"names the family '{short(families[-1])}' and holds no group of one")
        return layouts

    def _root(self) -> tuple[str, ...]:
        """What the root says, which nothing but its form and its parts among one another can confirm.

        The families that its command names are returned.
        """
        provenance = self._member(self._file, PROVENANCE, h5py.Group)
        self._names(provenance, set())
        date = texts(provenance).get("date", "")
        if date and not DATE.fullmatch(date):
            raise refusal(
                provenance, f"has the date '{short(date)}'; 2026-11-23T00:00:00+00:00 is of the accepted form"
            )
        version, profile = (text_of(self._file, name) for name in ("version", "profile"))
        if version not in RELEASED:
            raise refusal(self._file, f"is of version '{short(version)}'; {', '.join(RELEASED)} is known")
        if profile not in PROFILES and not is_grid_file(profile):
            raise refusal(self._file, f"has the profile '{short(profile)}', which is none, nor the name of a grid file")
        named = families_in(text_of(self._file, "command")) if self.schema.names_families else ()
        families = tuple(family for family in named if is_family_name(family))
        expected = root_attributes(self.schema, version, profile, date, families)
        fingerprint = says(self._file, expected, {"fingerprint"}).get("fingerprint", "")
        if not (isinstance(fingerprint, str) and FINGERPRINT.fullmatch(fingerprint)):
            raise refusal(self._file, "has no attribute 'fingerprint' of 64 hexadecimal digits")
        return families

    def _tree(self, group: h5py.Group, variants: dict[str, list[Layout]], besides: set[str]) -> dict[str, Layout]:
        """The layouts of the groups at and below a group, by path."""
        here = group.name.rstrip("/")
        if here in variants:
            return {here: self._group(group, variants[here])}
        below = {path[len(here) + 1 :].partition("/")[0] for path in variants if path.startswith(here + "/")}
        found: dict[str, Layout] = {}
        for name in self._names(group, below | besides, f"; {YOUR_OWN}"):
            if name not in besides:
                child = self._member(group, name, h5py.Group)
                if f"{here}/{name}" not in variants:
                    says(child, {})
                found |= self._tree(child, variants, set())
        return found

    def _names(self, group: h5py.Group, allowed: set[str], more: str = "") -> list[str]:
        count = group.id.get_num_objs()
        if count > len(allowed):
            raise refusal(group, f"has {count} members where the schema has at most {len(allowed)}{more}")
        names = []
        for name in group.id:
            known = name.decode("utf-8", "backslashreplace")
            if known not in allowed:
                sentence = unknown("name", known, sorted(allowed))
                raise refusal(group, f"has a member that is not in the schema: {sentence[:-1]}{more}")
            names.append(known)
        return names

    def _member(self, group: h5py.Group, name: str, kind: type) -> Any:
        """A member behind a hard link, of the expected kind, that no other link leads to; its metadata bounded."""
        if name.encode() not in group.id:
            raise refusal(group, "is missing", name)
        link = group.id.links.get_info(name.encode())
        if link.type != h5l.TYPE_HARD:
            raise refusal(group, "is a soft or external link; only hard links are accepted", name)
        if group.get(name, getclass=True) is not kind:
            raise refusal(group, f"is not a {kind.__name__.lower()}", name)
        found = group[name]
        bounded(found)
        address = h5o.get_info(found.id).addr
        if address in self._addresses:
            raise refusal(group, f"is the same object as {self._addresses[address]}", name)
        self._addresses[address] = f"{group.name.rstrip('/')}/{name}"
        return found

    def _group(self, group: h5py.Group, variants: list[Layout]) -> Layout:
        members = set(self._names(group, {array.name for layout in variants for array in self._arrays(layout)}))
        layout = next(
            (layout for layout in variants if members == {array.name for array in self._arrays(layout)}), variants[0]
        )
        parameters = parameters_of(group)
        if set(parameters) != {parameter.name for parameter in layout.parameters}:
            raise refusal(group, f"has the parameters {short(', '.join(sorted(parameters)))}, not the schema's")
        for name, number in parameters.items():
            if not self.schema.signed_zeros and is_negative_zero(number):
                raise refusal(group, f"has the parameter {name} = -0.0; zero has no sign there")
        marked = {"fingerprint"} if self.schema.group_fingerprints else set()
        mark = says(group, group_attributes(layout, parameters), marked).get("fingerprint", "")
        if marked and not (isinstance(mark, str) and FINGERPRINT.fullmatch(mark)):
            raise refusal(group, "has no attribute 'fingerprint' of 64 hexadecimal digits")
        lengths = {LIMB: TAIL_LIMBS}
        for array in self._arrays(layout):
            dataset = self._member(group, array.name, h5py.Dataset)
            if array.is_scale and dataset.ndim == 1:
                lengths[array.name] = dataset.shape[0]
            self._array(dataset, array, lengths)
        return layout

    def _arrays(self, layout: Layout) -> tuple[Array, ...]:
        return tuple(arrays(layout, self.schema))

    def _array(self, dataset: h5py.Dataset, array: Array, lengths: dict[str, int]) -> None:
        self._storage(dataset, array)
        shape = tuple(lengths.get(name, -1) for name in array.dims)
        if dataset.shape != shape:
            raise refusal(dataset, f"has shape {dataset.shape} where its coordinates make {shape}")
        self._dims[dataset.name] = array.dims
        self._attributes(dataset, array)
        if bool(dataset.is_scale) != array.is_scale:
            raise refusal(dataset, f"is {'not ' if array.is_scale else ''}a dimension scale")
        if array.is_index and not np.array_equal(dataset[...], np.arange(dataset.size)):
            raise refusal(dataset, "does not count 0, 1, 2, ...")
        if array.is_scale and self.schema.monotonic_axes and not monotonic(dataset[...]):
            raise refusal(dataset, "is an axis whose numbers neither rise nor fall")

    def _attributes(self, dataset: h5py.Dataset, array: Array) -> None:
        """What the schema says, what repeats the numbers of a few inputs, and measurements that are possible."""
        expected = dict(array.attributes)
        if "flag_meanings" in expected:
            expected.setdefault("flag_values", tuple(range(dataset.size)))
        if array.is_input and dataset.dtype.kind == "f" and dataset.size <= FEW:
            expected |= exact_texts(dataset[...].tolist())
        said = says(dataset, expected, free_attributes(array.row) if array.row is not None else ())
        if array.row is not None and array.row.over == "once":
            self._decimals[dataset.name] = str(said.get("decimal", ""))
        fault = measurement_fault(said, dataset.size, array.row) if array.row is not None else ""
        if fault:
            raise refusal(dataset, f"cannot be as it says: {fault}")

    def check_decimals(self) -> None:
        """Compare the decimals of variables that are asked once with their limbs, whose numbers must be finite.

        Raises:
            DatasetError: one is not of its limbs, as far as these go.
        """
        for path, text in self._decimals.items():
            value, tail = self._file[path], self._file[f"{path}_tail"]
            limbs = np.concatenate([value[...].reshape(-1, 1), tail[...].reshape(-1, TAIL_LIMBS)], axis=1)
            fault = limbs_fault(text, limbs, ATTRIBUTE_LIMIT)
            if fault:
                raise refusal(value, f"cannot be as it says: {fault}")

    def _storage(self, dataset: h5py.Dataset, array: Array) -> None:
        """Type, storage, filters and chunks, before any element is read."""
        properties = dataset.id.get_create_plist()
        if not dataset.id.get_type().equal(TYPES[array.dtype.str]):
            raise refusal(dataset, f"is not stored as little-endian {array.dtype.name}")
        if properties.get_layout() != h5d.CHUNKED or properties.get_external_count():
            raise refusal(dataset, "is not stored in chunks of this file")
        filters = [properties.get_filter(i)[0] for i in range(properties.get_nfilters())]
        if filters != [h5z.FILTER_FLETCHER32]:
            raise refusal(dataset, "has other filters than the checksum Fletcher32")
        shape, chunk = dataset.shape, dataset.chunks
        if not dataset.ndim or dataset.maxshape != shape or math.prod(shape) * array.dtype.itemsize > self._size:
            raise refusal(dataset, f"has the impossible shape {shape}")
        if len(shape) != len(array.dims) or chunk != chunks(array, shape):
            raise refusal(dataset, f"has chunks of the shape {chunk}, not the schema's")
        stored = math.prod(chunk) * array.dtype.itemsize + CHECKSUM_BYTES
        corners = [range(0, length, step) for length, step in zip(shape, chunk, strict=True)]
        count = math.prod(len(corner) for corner in corners)
        if count * stored > self._size or dataset.id.get_num_chunks() != count:
            raise refusal(dataset, "lacks some of its chunks")
        for corner in itertools.product(*corners):
            info = dataset.id.get_chunk_info_by_coord(corner)
            misplaced = info.byte_offset is None or info.byte_offset + stored > self._size
            if info.filter_mask or info.size != stored or misplaced:
                raise refusal(dataset, f"has a chunk that is unchecked or misplaced, that at {corner}")
