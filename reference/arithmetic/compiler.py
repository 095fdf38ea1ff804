"""heyoka, told once to keep its warnings to itself: it would write them to stdout, among the numbers."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import heyoka as hy

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["hy", "not_kept"]

hy.set_logger_level_error()


@contextmanager
def not_kept() -> Iterator[None]:
    """Compile without heyoka's cache on disk, which slows every start once it has grown by what is used once."""
    kept = hy.llvm_state.get_diskcache_enabled()
    hy.llvm_state.set_diskcache_enabled(False)
    try:
        yield
    finally:
        hy.llvm_state.set_diskcache_enabled(kept)
