"""The one error of a dataset that cannot be trusted."""

from __future__ import annotations

from reference.names import printable

__all__ = ["DatasetError"]


class DatasetError(ValueError):
    """A file is not the dataset it should be; the message names the file and the object in it, and can be printed."""

    def __init__(self, sentence: str) -> None:
        super().__init__(printable(sentence))
