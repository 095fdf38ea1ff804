"""Where blocks run: bounded queues, answers as they are asked for, and one sentence for what is not there."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import time
from multiprocessing import util

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


def test_in_this_process_each_answer_of_a_map_is_computed_when_it_is_asked_for():
    computed = []
    with opened("process", 1) as pool:
        answers = pool.map(lambda x, y: computed.append(x) or x + y, range(3), range(3), timeout=None, chunksize=2)
        assert computed == []
        assert next(answers) == 0
        assert computed == [0]
        assert list(answers) == [2, 4]


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
        monkeypatch.setattr("reference.command.executors.wait", interrupted)
        next(answers)
    assert uncaught == []
    assert time.monotonic() - begun < 50
    assert not [process for process in multiprocessing.active_children() if process.is_alive()]


def interrupted(*_args, **_kwargs):
    raise KeyboardInterrupt


def test_nobody_but_the_pool_cancels_what_its_processes_were_to_do(monkeypatch):
    monkeypatch.setattr("reference.command.executors.wait", interrupted)
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
