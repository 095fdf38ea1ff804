"""Whether the processor has subnormal numbers, those below 2^-1022, as IEEE 754 has them.

It can be set to take them for zero (flush-to-zero, denormals-are-zero).  A library built with fast-math sets that for
the thread that loads it and for those that this one starts.
"""

from __future__ import annotations

import struct

__all__ = ["UnderflowModeError", "is_gradual", "require_gradual"]

LEAST, NORMAL = struct.unpack("<2d", struct.pack("<2Q", 1, 1 << 52))
"""The least number and the least normal one, by their bits: a literal is read as zero in that mode."""


class UnderflowModeError(ArithmeticError):
    """The processor takes subnormal numbers for zero."""


def is_gradual() -> bool:
    """Whether this thread's processor has them: as they come in, and as they go out."""
    return bool(LEAST > 0.0 and NORMAL / 2.0 * 2.0 == NORMAL)


def require_gradual(what: str) -> None:
    """Refuse to go on where floats decide and the processor takes some of them for zero.

    Raises:
        UnderflowModeError: it does.
    """
    if not is_gradual():
        raise UnderflowModeError(
            f"{what} needs subnormal numbers, which the processor here takes for zero, as fast-math libraries "
            "set it to do; a thread or a process where that is not set is accepted."
        )
