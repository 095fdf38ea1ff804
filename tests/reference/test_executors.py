"""Where tasks run: each done once, none behind another, queues bounded, and one sentence for what is not there."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import time
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from multiprocessing import util
from queue import SimpleQueue
from typing import Any

import pytest

from reference.command.executors import WorkerError, opened, processes, results


def test_never_more_than_a_few_tasks_wait_for_a_worker():
    taken = []

    def tasks():
        for i in range(100):
            taken.append(i)
            yield i

    with opened("process", 1) as pool:
        for done, (task, answer) in enumerate(results(pool, abs, tasks(), 1), 1):
            assert task == answer
            assert len(taken) <= done + 4
    assert len(taken) == 100


@pytest.mark.parametrize(
    ("name", "error", "words"),
    [
        ("proces", ValueError, "perhaps process"),
        ("dask:tcp://127.0.0.1:1", ImportError, "dask.distributed is not installed"),
        ("mpi", ImportError, "mpi4py is not installed"),
    ],
)
def test_an_executor_that_is_not_there_is_one_sentence(monkeypatch, name, error, words):
    for module in ("dask.distributed", "mpi4py.futures"):
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(error, match=words), opened(name, 2):
        pass


def die(_task):
    os._exit(3)


def test_a_worker_that_dies_is_a_worker_error():
    with pytest.raises(WorkerError, match=r"^a worker process died .*\.$"), opened("process", 2) as pool:
        list(results(pool, die, [1], 2))


def last(_task):
    time.sleep(60)


def test_processes_end_at_once_on_an_error_and_leave_no_traceback(monkeypatch):
    """A future that is cancelled when a process dies would stop the pool's thread, and print a traceback."""
    uncaught = []
    monkeypatch.setattr(threading, "excepthook", uncaught.append)
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt), opened("process", 2) as pool:  # noqa: PT012 (the block is what is tested)
        answers = results(pool, last, range(20), 2)
        pool.submit(abs, 1)
        monkeypatch.setattr("reference.command.executors.SimpleQueue", Interrupted)
        next(answers)
    assert uncaught == []
    assert time.monotonic() - begun < 50
    assert not [process for process in multiprocessing.active_children() if process.is_alive()]


class Interrupted(SimpleQueue):
    """An interrupt while an answer is waited for."""

    def get(self, *_args):
        raise KeyboardInterrupt


def test_nobody_but_the_pool_cancels_what_its_processes_were_to_do(monkeypatch):
    monkeypatch.setattr("reference.command.executors.SimpleQueue", Interrupted)
    futures = []
    with pytest.raises(KeyboardInterrupt), opened("process", 2) as pool:  # noqa: PT012 (the block is what is tested)
        submit = pool.submit
        monkeypatch.setattr(pool, "submit", lambda *task: futures.append(submit(*task)) or futures[-1])
        try:
            list(results(pool, last, range(20), 2))
        finally:
            assert len(futures) == 8
            assert not any(future.cancelled() for future in futures)
    assert all(future.done() for future in futures)


def test_a_signal_that_another_thread_takes_finds_no_process_half_begun(monkeypatch, capfd):
    """A child that never heard what it is to do ends with a traceback of its own."""
    begin, begun = util.spawnv_passfds, []

    def signalled(*args):
        begun.append(begin(*args))
        thread = threading.Thread(target=interrupt)
        thread.start()
        thread.join()
        return begun[-1]

    def interrupt():
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        signal.pthread_kill(threading.get_ident(), signal.SIGINT)

    monkeypatch.setattr(util, "spawnv_passfds", signalled)
    with pytest.raises(KeyboardInterrupt), processes(2) as executor:
        executor.submit(os.getpid)
    assert begun
    assert capfd.readouterr().err == ""


def square(number: int) -> int:
    return number * number


@pytest.mark.parametrize("count", [0, 1, 2, 7])
def test_without_an_executor_every_task_is_done_in_order(count: int) -> None:
    assert list(results(None, square, range(count))) == [(k, k * k) for k in range(count)]


@pytest.mark.parametrize("workers", [1, 3, 20])
def test_every_task_is_done_once_whoever_does_it(workers: int) -> None:
    with ThreadPoolExecutor(workers) as executor:
        assert sorted(results(executor, square, range(50))) == [(k, k * k) for k in range(50)]


def test_this_process_and_others_share_what_is_to_be_done() -> None:
    with processes(2) as executor:
        assert dict(results(executor, square, range(9))) == {k: k * k for k in range(9)}


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
        found = [task for task, _ in results(executor, note, range(6))]
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
        list(results(executor, fail, range(100)))
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
    assert dict(results(Refusing(), square, range(5))) == {k: k * k for k in range(5)}


def test_a_broken_executor_is_said_to_be_so() -> None:
    with pytest.raises(WorkerError, match=r"^a worker process died before .*\.$"):
        list(results(Refusing(BrokenExecutor()), square, range(5)))
