"""Where tasks run: in this process, in a pool of processes, on a Dask cluster, or under MPI; and their answers."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import deque
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from importlib import import_module
from itertools import islice
from multiprocessing import connection, resource_tracker
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from reference.command.interrupts import held
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from multiprocessing.connection import Connection

__all__ = ["EXECUTORS", "WorkerError", "answer", "opened", "other_cores", "processes", "results"]

EXECUTORS = ("process", "dask:ADDRESS", "mpi")
AHEAD = 4
"""Tasks kept waiting for each worker: enough to keep it busy, few enough that memory stays bounded."""


class WorkerError(BrokenExecutor):
    """A process that worked on a task died."""


Task = TypeVar("Task")
Answer = TypeVar("Answer")


@contextmanager
def opened(name: str, jobs: int) -> Iterator[Executor | None]:
    """Open an executor: "process" with ``jobs`` processes (None for one job: it runs here), "dask:ADDRESS" or "mpi".

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
        yield None
    else:
        with processes(jobs) as executor:
            yield executor


def other_cores() -> int:
    """How many cores there are besides the one that this process runs on."""
    return (os.cpu_count() or 1) - 1


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
    executor: Executor | None,
    function: Callable[[Task], Answer],
    tasks: Iterable[Task],
    jobs: int | None = None,
    *,
    unfinished: str = "its block was finished; the finished blocks are kept",
) -> Iterator[tuple[Task, Answer]]:
    """Yield each task with its answer as they finish, the first begun first.

    Args:
        executor: where tasks are done; in this process, each when its answer is asked for, if None.
        function: what is done with a task.
        tasks: drawn by this thread alone.
        jobs: the number of workers, which do everything, each kept a few tasks ahead.  If None this process does its
            share: it takes the next task whenever it has ended one, and so does each worker, and all end at the same
            time; none is handed a task that it cannot begin at once, where the number of workers is known.
        unfinished: what had not come about when a worker died, for the sentence.

    Raises:
        WorkerError: a worker process died; and whatever ``function`` raises.
    """
    if executor is None:
        yield from ((task, function(task)) for task in tasks)
        return
    undrawn, under_way, handed = iter(tasks), 0, _Handed(executor, function, on=jobs is None)
    most = at_once = None if jobs is None else AHEAD * jobs
    if jobs is None:
        at_once = getattr(executor, "_max_workers", None)
    try:
        while True:
            drawn = list(islice(undrawn, None if most is None else most - under_way))
            handed.waiting.extend(drawn)
            for _ in drawn[:at_once]:
                handed.over()
            under_way += len(drawn)
            if not under_way:
                return
            task, future = handed.back()
            yield task, function(task) if future is None else answer(future, unfinished)
            under_way -= 1
    finally:
        handed.let_go()


def answer(future: Future[Answer], unfinished: str) -> Answer:
    """The answer of a task, waited for.

    Raises:
        WorkerError: its worker process died; and whatever the task raised.
    """
    try:
        return future.result()
    except BrokenExecutor:
        raise WorkerError(f"a worker process died before {unfinished}.") from None


class _Handed(Generic[Task, Answer]):
    """Tasks on their way to an executor and back.

    Where ``on`` is set, a worker that ends one is handed the next of those that wait, while this process is busy; else
    this thread alone hands over, and begins the processes.
    """

    def __init__(self, executor: Executor, function: Callable[[Task], Answer], *, on: bool) -> None:
        self._executor, self._function, self._on = executor, function, on
        self.waiting: deque[Task] = deque()
        self._running: set[Future[Answer]] = set()
        self._answered: SimpleQueue[tuple[Task, Future[Answer] | None]] = SimpleQueue()

    def over(self, _: object = None) -> None:
        """Hand over the next task; one that the executor does not take comes back unanswered."""
        try:
            task = self.waiting.popleft()
        except IndexError:  # none is left
            return
        try:
            future = self._executor.submit(self._function, task)
        except BrokenExecutor as error:
            future = Future()
            future.set_exception(error)
            self.waiting.clear()
        except RuntimeError:
            self._answered.put((task, None))
            return
        self._running.add(future)
        future.add_done_callback(lambda done: self._answered.put((task, done)))
        if self._on:
            future.add_done_callback(self.over)

    def back(self) -> tuple[Task, Future[Answer] | None]:
        """A task that is answered, or else one to be done here; where there is neither, the next to be answered."""
        if self._answered.empty() and self.waiting:
            with suppress(IndexError):  # a worker took it
                return self.waiting.popleft(), None
        task, future = self._answered.get()
        if future is not None:
            self._running.discard(future)
        return task, future

    def let_go(self) -> None:
        """Begin no other task."""
        self.waiting.clear()
        if not isinstance(self._executor, ProcessPoolExecutor):  # which cancels its own
            for future in list(self._running):
                future.cancel()
