"""Columns of an HDF5 file: one dataset each, or one of times and one of states."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.files.arrays import Sliced
from compare.files.columns import DATASETS
from compare.files.packed import packed, rows_first

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from compare.files.arrays import Column
    from compare.files.columns import Columns
    from reference.dataset.columns import ForeignColumn

__all__ = ["hdf5_columns"]


@contextmanager
def hdf5_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an HDF5 file: one dataset each, by its path or by the last part of it; or one of times and
    one of states.

    Raises:
        ValueError: it is no such file, or has no such datasets.
    """
    from reference.dataset.columns import foreign_columns

    with foreign_columns(path) as found:
        in_two = packed(columns, {name: data.shape for name, data in found.items()}, DATASETS)
        if in_two is None:
            names = list(found)
            datasets = [found[names[place]] for place in columns.among(names, DATASETS)]
            columns.refuse_units([data.units for data in datasets], alone=True)
            yield [_column(data) for data in datasets]
            return
        time, table = (found[name] for name in in_two)
        columns.refuse_units([time.units], alone=True)
        by_rows = rows_first(columns, in_two[1], table.shape, time.shape)
        states = [_of_table(table, place, rows_first=by_rows) for place in range(len(columns.wanted) - 1)]
        yield [_column(time), *states]


def _column(data: ForeignColumn) -> Column:
    return Sliced(data.shape, _dtype(data), data.__getitem__)


def _of_table(data: ForeignColumn, place: int, *, rows_first: bool) -> Column:
    """The numbers at ``place`` of every row, of a dataset of shape [rows, state] or else [state, rows]."""
    pick: Any = data.__getitem__  # h5py takes a slice for each axis
    if rows_first:
        return Sliced(data.shape[:1], _dtype(data), lambda rows: pick((rows, place)))
    return Sliced(data.shape[1:], _dtype(data), lambda rows: pick((place, rows)))


def _dtype(data: ForeignColumn) -> Any:
    return np.dtype(str) if data.is_text else data.dtype
