"""Tasks are shared between this process and an executor: each done once, none waiting behind another."""

from __future__ import annotations

import threading
import time
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from typing import Any

import pytest

from reference.command.executors import Inline, processes
from reference.command.sharing import shared


def square(number: int) -> int:
    return number * number


@pytest.mark.parametrize("count", [0, 1, 2, 7])
def test_without_an_executor_every_task_is_done_in_order(count: int) -> None:
    assert list(shared(range(count), square, None)) == [(k, k * k) for k in range(count)]


@pytest.mark.parametrize("workers", [1, 3, 20])
def test_every_task_is_done_once_whoever_does_it(workers: int) -> None:
    with ThreadPoolExecutor(workers) as executor:
        assert sorted(shared(range(50), square, executor)) == [(k, k * k) for k in range(50)]


def test_processes_and_an_executor_in_this_process_serve_too() -> None:
    with processes(2) as executor:
        assert dict(shared(range(9), square, executor)) == {k: k * k for k in range(9)}
    assert dict(shared(range(9), square, Inline())) == {k: k * k for k in range(9)}


def test_no_task_waits_for_a_busy_worker() -> None:
    """The worker is held on its first task; this process does all the others meanwhile."""
    release, by = threading.Event(), {}

    def note(task: int) -> int:
        by[task] = threading.current_thread() is threading.main_thread()
        if not by[task]:
            release.wait(10)
        elif len(by) == 6:
            release.set()
        return task

    with ThreadPoolExecutor(1) as executor:
        found = [task for task, _ in shared(range(6), note, executor)]
    assert found == [1, 2, 3, 4, 5, 0]
    assert list(by.values()).count(False) == 1


def test_what_a_task_raises_is_raised_and_the_rest_is_left() -> None:
    done = []

    def fail(task: int) -> int:
        done.append(task)
        if task == 1:
            raise ZeroDivisionError
        time.sleep(0.01)
        return task

    with ThreadPoolExecutor(1) as executor, pytest.raises(ZeroDivisionError):
        list(shared(range(100), fail, executor))
    assert len(done) < 100


class Refusing(Executor):
    """Takes one task, which never ends well, and no other."""

    _max_workers = 2

    def __init__(self, error: Exception | None = None) -> None:
        self.taken, self.error = 0, error

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        del fn, args, kwargs
        self.taken += 1
        if self.taken > 1 or self.error is None:
            raise RuntimeError("cannot schedule new futures after shutdown")
        future: Future[Any] = Future()
        future.set_exception(self.error)
        return future


def test_what_an_executor_does_not_take_is_done_here() -> None:
    assert dict(shared(range(5), square, Refusing())) == {k: k * k for k in range(5)}


def test_a_broken_executor_is_said_to_be_so() -> None:
    with pytest.raises(BrokenExecutor):
        list(shared(range(5), square, Refusing(BrokenExecutor())))
