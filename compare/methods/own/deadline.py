"""A time after which whatever runs is stopped: a user's function may never return."""

from __future__ import annotations

import ctypes
import signal
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["TimeOut", "deadline"]

AGAIN = 0.5
"""Seconds after which what was not stopped is told again: a bare ``except`` may have kept it."""


class TimeOut(BaseException):
    """The time is up: no ``except Exception`` of the user's keeps it."""


@contextmanager
def deadline(seconds: float, taken: Callable[[], object] | None = None) -> Iterator[None]:
    """Raise TimeOut in this thread after so many seconds: between two steps of Python, not within compiled code.

    Where ``taken`` is given, it is after so many in which that stays the same.
    """
    late = _Late(taken)
    in_main = threading.current_thread() is threading.main_thread()
    if (
        in_main
        and hasattr(signal, "setitimer")
        and signal.getsignal(signal.SIGALRM) in {signal.SIG_DFL, signal.SIG_IGN}
    ):
        with _alarm(seconds, late):
            yield
    else:
        with _watch(seconds, late):
            yield


class _Late:
    """Whether nothing has come about since it was asked before."""

    def __init__(self, taken: Callable[[], object] | None) -> None:
        self._taken = taken
        self._before = None if taken is None else taken()

    def __call__(self) -> bool:
        now = None if self._taken is None else self._taken()
        before, self._before = self._before, now
        return now == before


@contextmanager
def _alarm(seconds: float, late: _Late) -> Iterator[None]:
    """By the timer of the process, which ends waiting too."""

    def ring(_number: int, _frame: Any) -> None:
        if late():
            raise TimeOut
        signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def _watch(seconds: float, late: _Late) -> Iterator[None]:
    """By a thread that raises in this one."""
    done = threading.Event()
    here = ctypes.c_ulong(threading.get_ident())
    lock = threading.Lock()

    def wait() -> None:
        pause = seconds
        while not done.wait(pause):
            with lock:
                overdue = late()
                pause = AGAIN if overdue else seconds
                if overdue and not done.is_set():
                    ctypes.pythonapi.PyThreadState_SetAsyncExc(here, ctypes.py_object(TimeOut))

    watcher = threading.Thread(target=wait, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        with lock:
            done.set()
        watcher.join()
