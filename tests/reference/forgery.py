"""A file that was changed, its fingerprints put right again."""

from __future__ import annotations

import h5py

from reference.dataset.fingerprint import fingerprints

__all__ = ["marked"]


def marked(file: h5py.File, *, signed_zeros: bool) -> None:
    """Note the fingerprints of what is in an open file: its own, and those of groups that have one."""
    for path, mark in fingerprints(file, signed_zeros=signed_zeros).items():
        target = file[path or "/"]
        if "fingerprint" in target.attrs:
            target.attrs.create("fingerprint", mark.encode(), dtype=h5py.string_dtype("utf-8", len(mark)))
