"""heyoka, told once to keep its warnings to itself: it would write them to stdout, among the numbers."""

import heyoka as hy

__all__ = ["hy"]

hy.set_logger_level_error()
