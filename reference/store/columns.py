"""Columns of numbers in any HDF5 file, read a slice at a time: what others wrote, not a dataset of ours."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import h5py

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

__all__ = ["ForeignColumn", "foreign_columns"]


class ForeignColumn:
    """A dataset, or one field of a compound dataset; a matrix of one row or one column is a column.

    Attributes:
        is_text: whether it holds strings, which are read as ``str``.
    """

    def __init__(self, data: Any, field: str | None = None) -> None:
        self._data, self._field = data, field
        self._one_row = len(data.shape) == 2 and data.shape[0] == 1
        self._one_column = not self._one_row and len(data.shape) == 2 and data.shape[1] == 1
        self.is_text = field is None and h5py.check_string_dtype(data.dtype) is not None
        self.shape: tuple[int, ...] = (data.size,) if self._one_row or self._one_column else data.shape
        self.dtype: Any = data.dtype if field is None else data.dtype[field]

    def __getitem__(self, rows: slice) -> Any:
        """Some consecutive rows."""
        data = self._data.asstr() if self.is_text else self._data
        if self._field is not None:
            data = data.fields(self._field)
        return data[0, rows] if self._one_row else data[rows, 0] if self._one_column else data[rows]


@contextmanager
def foreign_columns(path: Path) -> Iterator[Mapping[str, ForeignColumn]]:
    """The datasets of a file by their paths, and the fields of compound datasets by their names too.

    Raises:
        ValueError: it is no HDF5 file.
    """
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise ValueError(f"'{path}' is no HDF5 file, or it is truncated.") from error
    with file:
        found: dict[str, ForeignColumn] = {}

        def keep(path: str | bytes, item: Any) -> None:
            if isinstance(item, h5py.Dataset) and item.shape is not None:
                name = path if isinstance(path, str) else path.decode("utf-8", "backslashreplace")
                found[name] = ForeignColumn(item)
                for field in item.dtype.names or ():
                    found[field] = ForeignColumn(item, field)

        file.visititems(keep)
        yield found
