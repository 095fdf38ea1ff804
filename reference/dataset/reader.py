"""Reading the file: nothing is returned from one that failed a check."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from reference.dataset.attributes import SCALE_NAMES, text_of
from reference.dataset.catalogue import layouts_of
from reference.dataset.checksums import check_checksum
from reference.dataset.errors import DatasetError
from reference.dataset.files import regular_file
from reference.dataset.fingerprint import fingerprints, parameters_of
from reference.dataset.inspection import SIGNATURE, inspect
from reference.dataset.schema import LIMB, PROVENANCE, arrays, families_in
from reference.names import unknown
from reference.once import cached_property
from reference.packages import required

if TYPE_CHECKING:
    import os

    from reference.dataset.schema import Schema
    from reference.family import Family
    from reference.layout import Layout

__all__ = ["CORE_NAME", "Dataset", "Variable", "core_path", "load"]

CORE_NAME = "horologium-core.h5"
DAMAGE = (OSError, RuntimeError, KeyError, TypeError, ValueError, OverflowError, MemoryError)
"""What h5py raises on bytes that are not what they should be."""


def core_path() -> Path:
    """Where the core dataset is: in the installed package, or in the ``data`` folder of a checkout."""
    package = Path(__file__).resolve().parents[1]
    installed = package / "data" / CORE_NAME
    return installed if installed.exists() else package.parent / "data" / CORE_NAME


def load(path: str | os.PathLike[str] | None = None, families: Sequence[Family | str] = ()) -> Dataset:
    """Check a dataset and return it; without a path, the core dataset that ships with the package.

    The checks: checksum beside the file where there is one, signature, every object and attribute against the schema,
    every number finite, and the fingerprint over all of it.  Every published schema version is read, and groups of
    ``families`` that are not ours, each a Family, or its name as MODULE:NAME or FILE.py:NAME.

    Raises:
        FileNotFoundError: there is no such file.
        DatasetError: it failed a check.
        ValueError, ImportError: there is no such family, or its module cannot be imported.
        TypeError: ``path`` is no path, or ``families`` hold something else.
    """
    own = layouts_of(families)
    if path is None and not core_path().exists():
        raise FileNotFoundError(
            f"the core dataset '{core_path()}' does not exist; 'python -m reference build' makes it."
        )
    found = regular_file(core_path() if path is None else path)
    try:
        check_checksum(found)
        with found.open("rb") as file:
            start = file.read(9)
    except OSError as error:
        raise DatasetError(f"'{found}' cannot be read: {error.strerror}.") from None
    if start[:8] != SIGNATURE:
        raise DatasetError(f"'{found}' is not an HDF5 file.")
    return _checked(found, own)


def _checked(path: Path, own: tuple[Layout, ...]) -> Dataset:
    before = _stamp(path)
    try:
        with h5py.File(path, "r") as file:
            inspection = inspect(file, path.stat().st_size, own)
            schema, layouts = inspection.schema, inspection.layouts
            _check_fingerprint(file, schema)
            inspection.check_decimals()
            groups = {layout.path.strip("/"): _plain(file[layout.path]) for layout in layouts}
            parameters = {layout.path: parameters_of(file[layout.path]) for layout in layouts}
            return Dataset(path, _plain(file), groups, _plain(file[PROVENANCE]), schema, layouts, parameters, before)
    except DatasetError:
        raise
    except DAMAGE as error:
        reason = " ".join(str(error).split())
        raise DatasetError(f"'{path}' is truncated or damaged: {reason}.") from None


def _check_fingerprint(file: h5py.File, schema: Schema) -> None:
    marks = fingerprints(file, signed_zeros=schema.signed_zeros)
    for path, found in marks.items() if schema.group_fingerprints else [("", marks[""])]:
        noted = text_of(file[path or "/"], "fingerprint")
        if noted != found:
            where = f"'{file.filename}': the fingerprint of {path or 'its content'}"
            raise DatasetError(f"{where} is {found}, not {noted}: it is altered.")


def _stamp(path: Path) -> tuple[int, int, int]:
    status = path.stat()
    return status.st_ino, status.st_size, status.st_mtime_ns


def _plain(target: Any) -> dict[str, Any]:
    """Attributes as Python values, without those that HDF5 and netCDF-4 keep."""
    found = {}
    for name in sorted(target.attrs):
        if name not in SCALE_NAMES:
            value = target.attrs[name]
            found[name] = value.decode() if isinstance(value, bytes) else value.tolist()
    return found


def _frozen(array: np.ndarray) -> np.ndarray:
    array.setflags(write=False)
    return array


@dataclass(frozen=True, eq=False)
class Variable:
    """A variable of a checked dataset; its numbers are read once, when they are asked for, and cannot be changed.

    Attributes:
        name: path without the leading slash, such as "pendulum/libration/period".
        shape: of ``value``.
        dims: names of the axes.
        attrs: every attribute, such as ``units``, ``definition``, ``taylor_digits``.
        is_input: True for coordinates: exact inputs, which have no tail.
    """

    dataset: Dataset = field(repr=False)
    name: str
    shape: tuple[int, ...]
    dims: tuple[str, ...]
    attrs: dict[str, Any] = field(repr=False)
    is_input: bool

    @property
    def units(self) -> str:
        """UDUNITS spelling; "1" for a pure number."""
        return str(self.attrs["units"])

    @property
    def definition(self) -> str:
        """The defining equation in one line."""
        return str(self.attrs["definition"])

    @cached_property
    def value(self) -> np.ndarray:
        """The exact values correctly rounded to binary64, or for inputs the inputs: shape ``shape``."""
        return _frozen(self.read(...)[0])

    @cached_property
    def tail(self) -> np.ndarray:
        """The two limbs after ``value``: float64 of shape ``(*shape, 2)``; zeros for inputs, which are exact."""
        return _frozen(self.read(...)[1])

    def read(self, selection: Any) -> tuple[np.ndarray, np.ndarray]:
        """``value[selection]`` and ``tail[selection]`` from the file, and no more of it."""
        return self.dataset.read(self.name, selection, has_tail=not self.is_input)


@dataclass(frozen=True, eq=False)
class Dataset(Mapping[str, Variable]):
    """A checked dataset: variables by path, inputs among them; groups' attributes in ``groups``."""

    path: Path
    attrs: dict[str, Any] = field(repr=False)
    groups: dict[str, dict[str, Any]] = field(repr=False)
    provenance: dict[str, Any] = field(repr=False)
    schema: Schema = field(repr=False)
    layouts: tuple[Layout, ...] = field(repr=False)
    parameters: dict[str, dict[str, float]] = field(repr=False)
    _checked_as: tuple[int, int, int] = field(repr=False)

    @property
    def fingerprint(self) -> str:
        """The SHA-256 of the content: the same for every build of the same plan."""
        return str(self.attrs["fingerprint"])

    @property
    def families(self) -> tuple[str, ...]:
        """The families that were named when it was built."""
        return families_in(str(self.attrs["command"]))

    @cached_property
    def _variables(self) -> dict[str, Variable]:
        found = {}
        with self._open() as file:
            for layout in self.layouts:
                inputs = {coordinate.name for coordinate in layout.coordinates}
                for array in arrays(layout, self.schema):
                    if LIMB in array.dims:
                        continue
                    dataset = file[f"{layout.path}/{array.name}"]
                    name = dataset.name.strip("/")
                    found[name] = Variable(self, name, dataset.shape, array.dims, _plain(dataset), array.name in inputs)
        return found

    def _open(self) -> h5py.File:
        if _stamp(self.path) != self._checked_as:
            raise DatasetError(f"'{self.path}' changed since it was checked; load it again.")
        return h5py.File(self.path, "r")

    def __getitem__(self, name: str) -> Variable:
        """The variable at a path, with or without the leading slash.

        Raises:
            KeyError: there is none; the message gives the nearest names.
        """
        found = self._variables.get(name.strip("/"))
        if found is None:
            raise KeyError(unknown("variable", name, self))
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._variables)

    def __len__(self) -> int:
        return len(self._variables)

    def read(self, name: str, selection: Any, *, has_tail: bool) -> tuple[np.ndarray, np.ndarray]:
        """The selected elements and their tails, read from the file now.

        Raises:
            DatasetError: the file changed or was damaged since it was checked.
        """
        try:
            with self._open() as file:
                value = file[name][selection]
                tail = file[f"{name}_tail"][selection] if has_tail else np.zeros((*np.shape(value), 2))
        except DatasetError:
            raise
        except (OSError, KeyError, RuntimeError) as error:
            raise DatasetError(f"'{self.path}' was damaged since it was checked: {error}.") from None
        return value, tail

    def to_xarray(self, group: str | None = None) -> Any:
        """One group as an ``xarray.Dataset``, or all as an ``xarray.DataTree``; tails are variables ``NAME_tail``.

        Raises:
            ImportError: xarray is not installed.
            KeyError: there is no such group.
        """
        xarray = required("xarray", install="horologium[xarray]")
        if group is None:
            return xarray.DataTree.from_dict({name: self.to_xarray(name) for name in self.groups})
        name = group.strip("/")
        if name not in self.groups:
            raise KeyError(unknown("group", group, self.groups))
        members = [variable for path, variable in self.items() if path.rpartition("/")[0] == name]
        data: dict[str, Any] = {}
        for variable in members:
            short = variable.name.rpartition("/")[2]
            attributes = {key: value for key, value in variable.attrs.items() if key != "coordinates"}
            data[short] = (variable.dims, variable.value, attributes)  # xarray writes "coordinates" itself
            if not variable.is_input:
                data[f"{short}_tail"] = ((*variable.dims, "limb"), variable.tail, {"units": variable.units})
        inputs = {variable.name.rpartition("/")[2] for variable in members if variable.is_input}
        return xarray.Dataset(
            {short: entry for short, entry in data.items() if short not in inputs},
            coords={short: entry for short, entry in data.items() if short in inputs},
            attrs=self.groups[name],
        )
