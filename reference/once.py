"""A property that is computed once for each object, without a lock.

Until Python 3.12 ``functools.cached_property`` holds a lock of its own while it computes.  One thread that holds it and
waits for the working precision, and another that holds that and asks for the same property, would wait for ever.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING or sys.version_info >= (3, 12):
    from functools import cached_property
else:

    class cached_property:  # noqa: N801 - as functools names it
        """The value of the method, kept in the object's ``__dict__`` from the first time on."""

        def __init__(self, function: Any) -> None:
            self.func, self.__doc__ = function, function.__doc__

        def __set_name__(self, owner: type, name: str) -> None:
            self.attrname = name

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            """Compute it; two threads that ask at once may both do so, and keep the one value."""
            if instance is None:
                return self
            return instance.__dict__.setdefault(self.attrname, self.func(instance))


__all__ = ["cached_property"]
