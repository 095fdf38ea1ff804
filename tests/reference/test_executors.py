"""Where blocks run: bounded queues, answers as they are asked for, and one sentence for what is not there."""

from __future__ import annotations

import os
import sys

import pytest

from reference.executors import WorkerError, opened, results


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
