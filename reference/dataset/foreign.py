"""What a dataset of others says of its numbers: their units, and whether they are meant as they are stored.

The attributes are those of the NetCDF Users Guide and the CF conventions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from h5py import h5a, h5o

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["MOST_ATTRIBUTES", "Said", "attribute_bytes", "said_of"]

PACKED = {"scale_factor": 1.0, "add_offset": 0.0}
"""Attributes of numbers that are stored scaled and shifted, and what leaves them as they are."""
MISSING = ("_FillValue", "missing_value")
MOST_ATTRIBUTES = 1 << 20
"""Bytes that the attributes of a dataset may take together, outside its header."""
MOST_BYTES = 1 << 16
"""Bytes of an attribute that may be units or a number."""


class Said(NamedTuple):
    """What a dataset says.

    Attributes:
        units: the units of its numbers, of a time without its epoch; "" where it says none.
        packed_by: the attribute by which they are stored scaled or shifted; "" where they are not.
        missing: the numbers that stand for missing ones.
        elsewhere: whether they are in another file.
    """

    units: str
    packed_by: str
    missing: tuple[float, ...]
    elsewhere: bool


def attribute_bytes(data: Any) -> int:
    """Bytes of the attributes that are kept outside the object's header."""
    size = h5o.get_info(data.id).meta_size.attr
    return int(size.heap_size + size.index_size)


def said_of(data: Any) -> Said:
    """What a dataset says, whose attributes are not too large to be read."""
    units = _attribute(data, "units")
    units = units.decode("utf-8", "backslashreplace") if isinstance(units, bytes) else units
    sources = [source.file_name for source in data.virtual_sources()] if data.is_virtual else []
    return Said(
        units.partition(" since ")[0] if isinstance(units, str) else "",
        next((name for name, plain in PACKED.items() if any(one != plain for one in _numbers(data, name))), ""),
        tuple(number for name in MISSING for number in _numbers(data, name)),
        bool(data.external) or any(name != "." for name in sources),
    )


def _numbers(data: Any, name: str) -> Sequence[float]:
    found = np.asarray(_attribute(data, name))
    return [float(found)] if found.dtype.kind in "fiu" and found.size == 1 else []


def _attribute(data: Any, name: str) -> Any:
    """The one value of an attribute; None where there is none, or several, or what is larger than units and numbers."""
    if not h5a.exists(data.id, name.encode()):
        return None
    attribute = h5a.open(data.id, name.encode())
    if attribute.get_storage_size() > MOST_BYTES or attribute.get_space().get_simple_extent_npoints() != 1:
        return None
    found = data.attrs[name]
    return found.reshape(()).item() if isinstance(found, np.ndarray) else found
