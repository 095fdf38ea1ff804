"""Signals as exceptions that let a process end in good order, raised only where one can be raised."""

from __future__ import annotations

import signal
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["Terminated", "held", "terminable"]


class Terminated(BaseException):
    """The process was asked to end: as an exception, so that whatever has something to clear away does."""


def _in_main_thread() -> bool:
    """Elsewhere no handler can be set, and none runs."""
    return threading.current_thread() is threading.main_thread()


@contextmanager
def terminable() -> Iterator[None]:
    """Let the signal to terminate raise Terminated, once, unless somebody else handles it."""
    if not _in_main_thread() or signal.getsignal(signal.SIGTERM) != signal.SIG_DFL:
        yield
        return

    def terminate(number: int, _frame: object) -> NoReturn:
        signal.signal(number, signal.SIG_IGN)
        raise Terminated

    signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


@contextmanager
def held() -> Iterator[Callable[[], None]]:
    """Keep interrupts waiting until the end of the block, or until the function given is called to let them in.

    For code that C calls back: an exception raised there would be lost, and what it stopped taken for done.
    """
    waiting: list[int] = []
    if not _in_main_thread():
        yield waiting.clear
        return
    found = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    handlers: dict[int, Any] = {number: handler for number, handler in found.items() if callable(handler)}

    def hold(number: int, _frame: object) -> None:
        waiting.append(number)

    def let_in() -> None:
        while waiting:
            number = waiting.pop(0)
            handlers[number](number, None)

    for number in handlers:
        signal.signal(number, hold)
    try:
        yield let_in
    finally:
        for number, handler in handlers.items():
            if signal.getsignal(number) is hold:
                signal.signal(number, handler)
        let_in()
