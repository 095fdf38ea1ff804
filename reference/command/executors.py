"""Where blocks run: in this process, in a pool of processes, on a Dask cluster, or under MPI."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import deque
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from importlib import import_module
from multiprocessing import connection, resource_tracker
from typing import TYPE_CHECKING, Any, TypeVar

from reference.command.interrupts import held
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from multiprocessing.connection import Connection

__all__ = ["EXECUTORS", "WorkerError", "opened", "processes", "results"]

EXECUTORS = ("process", "dask:ADDRESS", "mpi")
AHEAD = 4
"""Tasks kept waiting for each worker: enough to keep it busy, few enough that memory stays bounded."""


class WorkerError(RuntimeError):
    """A process that worked on a block died."""


Task = TypeVar("Task")
Answer = TypeVar("Answer")


class Inline(Executor):
    """Runs each task at once in this process."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return a finished future; what ``fn`` raises is raised here and now."""
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future

    def map(self, fn: Callable[..., Any], *iterables: Iterable[Any], **_limits: Any) -> Iterator[Any]:
        """Yield the answers, each computed when it is asked for; a limit on time or size means nothing here."""
        return map(fn, *iterables)


@contextmanager
def opened(name: str, jobs: int) -> Iterator[Executor]:
    """Open an executor: "process" with ``jobs`` processes (one job runs here), "dask:ADDRESS" or "mpi".

    Raises:
        ValueError: the name is unknown, or ``jobs`` is less than one.
        ImportError: the cluster package is not installed.
    """
    if jobs < 1:
        raise ValueError(f"jobs is {jobs}; a positive integer is accepted.")
    kind, _, address = name.partition(":")
    if kind == "dask" and address:
        with _dask(address) as executor:
            yield executor
    elif name == "mpi":
        with _mpi(jobs) as executor:
            yield executor
    elif name != "process":
        raise ValueError(unknown("executor", name, EXECUTORS))
    elif jobs == 1:
        yield Inline()
    else:
        with processes(jobs) as executor:
            yield executor


class Pool(ProcessPoolExecutor):
    """A pool whose processes begin deaf to interrupts: what they import would otherwise end in a traceback."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return the future of the task; a process may begin, which inherits what is blocked."""
        with held():  # any thread takes a signal that this one blocks: a process half begun would miss what it is to do
            before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
            try:
                return super().submit(fn, *args, **kwargs)
            finally:
                signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def processes(count: int) -> Iterator[Executor]:
    """Open a pool of ``count`` fresh processes, at least one, that end with this one.

    On an error they end at once, in the middle of what they do.  Their futures are cancelled by the pool alone: one
    that somebody else had cancelled would stop the pool's own thread, with a traceback, where a process dies.
    """
    context = multiprocessing.get_context("spawn")
    resource_tracker.ensure_running()  # which lets in what is blocked
    holding, letting_go = context.Pipe(duplex=False)
    with holding, letting_go, Pool(count, context, initializer=_follow_parent, initargs=(holding,)) as executor:
        try:
            yield executor
        except BaseException:
            letting_go.close()
            executor.shutdown(wait=True, cancel_futures=True)
            raise


def _follow_parent(holding: Connection) -> None:
    """Leave an interrupt to the parent, and end when it ends, however it does, or when it lets go."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            connection.wait([parent.sentinel, holding])
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


@contextmanager
def _dask(address: str) -> Iterator[Executor]:
    with _cluster_module("dask.distributed", "dask.distributed").Client(address) as client:
        yield client.get_executor()


@contextmanager
def _mpi(jobs: int) -> Iterator[Executor]:
    with _cluster_module("mpi4py.futures", "mpi4py").MPIPoolExecutor(max_workers=jobs) as executor:
        yield executor


def _cluster_module(name: str, package: str) -> Any:
    try:
        return import_module(name)
    except ImportError:
        raise ImportError(f"{package} is not installed; 'pip install horologium[cluster]' provides it.") from None


def results(
    executor: Executor, function: Callable[[Task], Answer], tasks: Iterable[Task], jobs: int
) -> Iterator[tuple[Task, Answer]]:
    """Yield each task with its answer as they finish; never more than a few tasks a worker are in flight.

    Raises:
        WorkerError: a worker process died.
    """
    queue = iter(tasks)
    running: dict[Future[Answer], Task] = {}
    done: deque[Future[Answer]] = deque()
    try:
        while True:
            while len(running) < AHEAD * jobs and (task := next(queue, None)) is not None:
                running[executor.submit(function, task)] = task
                if isinstance(executor, Inline):
                    break
            if not running:
                return
            done.extend(wait(running, return_when=FIRST_COMPLETED).done)
            while done:
                future = done.popleft()
                yield running.pop(future), future.result()
    except BrokenExecutor:
        raise WorkerError(
            "a worker process died before its block was finished; the finished blocks are kept."
        ) from None
    finally:
        if not isinstance(executor, ProcessPoolExecutor):  # which cancels its own
            for future in running:
                future.cancel()
