"""heyoka, told once to keep its warnings to itself: it would write them to stdout, among the numbers."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from reference.packages import required

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["hy", "not_kept", "parameter_rows"]

hy = required("heyoka", by="Taylor's method")
hy.set_logger_level_error()


def parameter_rows(outputs: Sequence[Any]) -> int:
    """How many rows of parameters a compiled function of these outputs takes: up to the last that occurs in them."""
    return max((int(str(parameter).removeprefix("p")) + 1 for parameter in hy.get_params(list(outputs))), default=0)


@contextmanager
def not_kept() -> Iterator[None]:
    """Compile without heyoka's cache on disk, which slows every start once it has grown by what is used once."""
    kept = hy.llvm_state.get_diskcache_enabled()
    hy.llvm_state.set_diskcache_enabled(False)
    try:
        yield
    finally:
        hy.llvm_state.set_diskcache_enabled(kept)
