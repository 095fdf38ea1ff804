"""The one place where working precision is set: python-flint's context and a context of mpmath that is our own.

python-flint has one precision and one length of series for the whole process, whatever the thread.  So each working
precision is held together with a lock, by one thread at a time, and put back as it was.  A ball encloses the exact
value at any precision, and a series knows its own length: code that sets ``flint.ctx`` without the lock can make a ball
wider, never wrong.  mpmath's numbers have no bounds; they are of a context of their own, which no other code sets.
"""

from __future__ import annotations

import os
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import flint
from mpmath.ctx_mp import MPContext
from mpmath.libmp import dps_to_prec

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["BallContext", "NumberContext", "PrecisionError", "ctx", "held", "mp"]


class PrecisionError(ArithmeticError):
    """A context was set by code that does not hold the lock."""


class _Lock:
    """A lock that a thread may take again, which a forked process finds free or in the hands of its only thread."""

    def __init__(self) -> None:
        self.lock, self._depth, self._owner = threading.RLock(), 0, 0
        self._before: tuple[int, int, int] | None = None
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=self._alone)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Take it for the length of a block."""
        with self.lock:
            self.enter()
            try:
                yield
            finally:
                self.leave()

    def enter(self) -> None:
        """Note who took ``lock``, and what was in force before."""
        if not self._depth:
            self._before, self._owner = _in_force(), threading.get_ident()
        self._depth += 1

    def leave(self) -> None:
        """Note that one block less is open."""
        self._depth -= 1

    @property
    def mine(self) -> bool:
        """Whether this thread holds it."""
        return bool(self._depth) and self._owner == threading.get_ident()

    def _alone(self) -> None:
        """In a forked process: the thread that held the lock is not there to put the contexts back."""
        if self.mine:
            return
        if self._depth and self._before is not None:
            flint.ctx.prec, flint.ctx.cap, bits = self._before
            mp._set_prec(bits)  # noqa: SLF001 - as it was, and by no thread that works
        self.lock, self._depth = threading.RLock(), 0


def _in_force() -> tuple[int, int, int]:
    return flint.ctx.prec, flint.ctx.cap, mp.prec


class BallContext:
    """python-flint's context: the working precision of balls and the length of their series."""

    @property
    def prec(self) -> int:
        """The bits in force, to choose how much work is worth while; no bound may rest on them."""
        return int(flint.ctx.prec)

    @property
    def cap(self) -> int:
        """The terms in force; what a series is known to is its own ``prec``."""
        return int(flint.ctx.cap)

    @contextmanager
    def workprec(self, bits: int) -> Iterator[None]:
        """Balls are rounded to this many bits."""
        with _LOCK.lock:
            _LOCK.enter()
            before = flint.ctx.prec
            flint.ctx.prec = bits
            try:
                yield
            finally:
                flint.ctx.prec = before
                _LOCK.leave()

    @contextmanager
    def worklength(self, terms: int) -> Iterator[None]:
        """Series are known up to this many terms.

        Raises:
            PrecisionError: other code shortened them so far that one had no term left to work with.
        """
        with held():
            before = flint.ctx.cap
            flint.ctx.cap = terms
            try:
                yield
            except (ArithmeticError, AttributeError, LookupError, ValueError) as failure:
                if flint.ctx.cap == terms:
                    raise
                raise PrecisionError(
                    "flint.ctx.cap was set by other code during a proof; "
                    "code that sets it inside 'with reference.arithmetic.precision.held()' is accepted."
                ) from failure
            finally:
                flint.ctx.cap = before


class NumberContext(MPContext):  # type: ignore[misc]  # mpmath is untyped
    """A context of mpmath whose precision is set by one thread at a time.

    mpmath's own functions set it too while they work: they are called inside ``with mp.workprec(bits)``.
    """

    @contextmanager
    def workprec(self, bits: int) -> Iterator[None]:
        """Numbers are rounded to this many bits."""
        with held():
            before = self._prec
            self._set_prec(bits)
            try:
                yield
            finally:
                self._set_prec(before)

    @contextmanager
    def extraprec(self, bits: int) -> Iterator[None]:
        """Numbers are rounded to this many bits more."""
        with held(), self.workprec(self._prec + bits):
            yield

    @contextmanager
    def workdps(self, digits: int) -> Iterator[None]:
        """Numbers are rounded to about this many decimal digits."""
        with self.workprec(dps_to_prec(digits)):
            yield

    def _set_own(self, bits: int) -> None:
        if not _LOCK.mine:
            raise PrecisionError(
                "mpmath's precision is set outside of 'with mp.workprec(bits)', which alone is accepted."
            )
        self._set_prec(bits)

    prec = property(lambda self: self._prec, _set_own)


_LOCK = _Lock()
held = _LOCK.held
"""Hold the lock of all working precisions: ``with held(): ...``."""
ctx = BallContext()
mp: Any = NumberContext()
