"""The one error of a dataset that cannot be trusted."""

from __future__ import annotations

__all__ = ["DatasetError"]


class DatasetError(ValueError):
    """A file is not the dataset it should be; the message names the file and the object in it."""
