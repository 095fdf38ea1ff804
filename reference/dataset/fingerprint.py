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

import numpy as np

from reference.arithmetic.binary64 import hexadecimal

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = ["Digest", "pieces"]

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
