"""Attributes read with care: how many, how large and of which type is known before the first of them is read.

HDF5 reads an attribute whole to say its type, and all of an object's to list their names.  So the space that they
take, which the object's header tells, is bounded first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import h5py
from h5py import h5a, h5o, h5s, h5t

from reference.dataset.errors import DatasetError
from reference.dataset.schema import ATTRIBUTE_LIMIT
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    Value = str | float | int | tuple[int, ...]

__all__ = ["SCALE_NAMES", "TYPES", "bounded", "refusal", "says", "text_of", "texts", "value_of"]

MAX_ATTRIBUTES = 64
MAX_METADATA = 1 << 20
"""Bytes that an object's header may take, and its attributes, and a group's links."""
TYPES = {"<f8": h5t.IEEE_F64LE, "<i4": h5t.STD_I32LE}
SCALE_NAMES = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates")
"""Attributes that HDF5 and netCDF-4 keep beside a dataset's own."""


def refusal(target: Any, why: str, member: str = "") -> DatasetError:
    """The error that names the object, or a member of it."""
    path = f"{target.name.rstrip('/')}/{member}" if member else target.name
    return DatasetError(f"'{target.file.filename}': {path} {why}.")


def bounded(target: Any) -> None:
    """Refuse an object whose header, attributes or links take more space than any of the schema's.

    Raises:
        DatasetError: they do, or they are kept outside the object.
    """
    info = h5o.get_info(target.id)
    if info.hdr.mesg.shared:
        raise refusal(target, "shares a part of its description with other objects")
    for what, size in (
        ("a header", info.hdr.space.total),
        ("attributes", info.meta_size.attr.heap_size + info.meta_size.attr.index_size),
        ("links", info.meta_size.obj.heap_size),
    ):
        if size > MAX_METADATA:
            raise refusal(target, f"has {what} of {size} bytes where at most {MAX_METADATA} are accepted")
    if info.num_attrs > MAX_ATTRIBUTES:
        raise refusal(target, f"has {info.num_attrs} attributes where at most {MAX_ATTRIBUTES} are accepted")


def says(target: Any, expected: Mapping[str, Value], free: Collection[str] = ()) -> dict[str, Any]:
    """Check that a bounded object has the ``expected`` attributes and no others but ``free`` ones, which are returned.

    Every one is a text in UTF-8, a float64 or an int32, or a list of int32, and small; a dataset may also have those
    of HDF5's dimension scales.

    Raises:
        DatasetError: one is missing, unknown, of another type, or says something else.
    """
    names = _names(target)
    found = {}
    for name in names:
        if name in SCALE_NAMES and isinstance(target, h5py.Dataset):
            _check_scale_attribute(target, name)
        elif name in expected or name in free:
            value = value_of(target, name)
            if name in free:
                found[name] = value
            elif value != expected[name] or type(value) is not type(expected[name]):
                shown, wanted = (short(str(text)) for text in (value, expected[name]))
                raise refusal(target, f"has the attribute '{name}' = '{shown}' where '{wanted}' is expected")
        else:
            raise refusal(target, f"has the attribute '{short(name)}', which the schema does not have there")
    for name in expected:
        if name not in names:
            raise refusal(target, f"has no attribute '{name}'")
    return found


def text_of(target: Any, name: str) -> str:
    """A text attribute of a bounded object.

    Raises:
        DatasetError: it is missing or no text.
    """
    value = value_of(target, name)
    if not isinstance(value, str):
        raise refusal(target, f"has the attribute '{short(name)}', which is no text")
    return value


def texts(target: Any) -> dict[str, str]:
    """The attributes of a bounded group whose names and texts are free: names of small letters, texts of one line.

    Raises:
        DatasetError: one is something else.
    """
    found = says(target, {}, _names(target))
    for name, text in found.items():
        if not (name.isascii() and name.replace("_", "a").isalnum() and name == name.lower()):
            raise refusal(target, f"has the attribute '{short(name)}'; names of small letters are accepted there")
        if not isinstance(text, str) or not text.isprintable():
            raise refusal(target, f"has the attribute '{name}', which is not one line of text")
    return found


def _names(target: Any) -> list[str]:
    found: list[bytes] = []
    h5a.iterate(target.id, found.append)
    try:
        return [name.decode() for name in found]
    except UnicodeDecodeError as error:
        raise refusal(target, f"has the attribute '{short(error.object)}', whose name is not in UTF-8") from None


def value_of(target: Any, name: str) -> Any:
    """An attribute of a bounded object as a text, a number or a tuple of numbers, its type and size seen first.

    Raises:
        DatasetError: it is missing, or of another type or size.
    """
    if not h5a.exists(target.id, name.encode()):
        raise refusal(target, f"has no attribute '{short(name)}'")
    attribute = h5a.open(target.id, name.encode())
    kind = attribute.get_type()
    is_text = isinstance(kind, h5t.TypeStringID) and not kind.is_variable_str() and kind.get_cset() == h5t.CSET_UTF8
    is_number = any(kind.equal(known) for known in TYPES.values())
    small = attribute.get_space().get_simple_extent_type() in {h5s.SCALAR, h5s.SIMPLE}
    small = small and len(attribute.shape) <= 1 and attribute.get_storage_size() <= ATTRIBUTE_LIMIT
    if not (is_text or is_number) or not small:
        raise refusal(target, f"has the attribute '{short(name)}' of an unexpected type or size")
    value = target.attrs[name]
    if is_number:
        number = value.tolist()
        return tuple(number) if isinstance(number, list) else number
    if not isinstance(value, (str, bytes)):
        raise refusal(target, f"has the attribute '{short(name)}', which is not one text")
    try:
        return value if isinstance(value, str) else value.decode()
    except UnicodeDecodeError:
        raise refusal(target, f"has the attribute '{short(name)}', which is no text in UTF-8") from None


def _check_scale_attribute(target: Any, name: str) -> None:
    """What HDF5 and netCDF-4 say of dimension scales has their types, and the size that belongs to the dataset."""
    attribute = h5a.open(target.id, name.encode())
    kind, shape = attribute.get_type(), attribute.shape
    said = {"CLASS": "DIMENSION_SCALE", "NAME": target.name.rpartition("/")[2]}
    if name in said:
        is_text = isinstance(kind, h5t.TypeStringID) and not kind.is_variable_str() and shape == ()
        right = is_text and target.attrs[name] in {said[name], said[name].encode()}
    elif name == "DIMENSION_LIST":
        right = shape == (target.ndim,) and isinstance(kind, h5t.TypeVlenID)
    elif name == "REFERENCE_LIST":
        right = len(shape) == 1 and attribute.get_storage_size() <= ATTRIBUTE_LIMIT and _is_list_of_users(kind)
    else:
        right = kind.equal(h5t.STD_I32LE) and shape == (() if name == "_Netcdf4Dimid" else (target.ndim,))
    if not right:
        raise refusal(target, f"has the attribute '{name}', which is not as HDF5 or netCDF-4 writes it")


def _is_list_of_users(kind: Any) -> bool:
    if not isinstance(kind, h5t.TypeCompoundID) or kind.get_nmembers() != 2:
        return False
    reference, axis = kind.get_member_type(0), kind.get_member_type(1)
    return bool(reference.equal(h5t.STD_REF_OBJ)) and isinstance(axis, h5t.TypeIntegerID)
