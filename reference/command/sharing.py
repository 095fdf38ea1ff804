"""Tasks shared between this process and an executor, so that both end at the same time."""

from __future__ import annotations

from collections import deque
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor, Future

__all__ = ["shared"]

Task = TypeVar("Task")
Answer = TypeVar("Answer")


def shared(
    tasks: Sequence[Task], function: Callable[[Task], Answer], executor: Executor | None
) -> Iterator[tuple[Task, Answer]]:
    """Yield each task with its answer as they finish, the first begun first.

    This process takes the next task whenever it has ended one, and so does each worker of the executor: none is handed
    a task that it cannot begin at once, where its number of workers is known.  Without an executor all are done here.

    Raises:
        BrokenExecutor: a worker died; and whatever ``function`` raises.
    """
    waiting, answered = deque(tasks), SimpleQueue[tuple[Task, "Future[Answer] | None"]]()

    def hand_over(_: Any = None) -> None:
        """Give the next task to the executor; one that it does not take comes back unanswered."""
        if executor is None:
            return
        try:
            task = waiting.popleft()
        except IndexError:  # none is left
            return
        try:
            future = executor.submit(function, task)
        except RuntimeError:
            answered.put((task, None))
            return
        future.add_done_callback(lambda done: answered.put((task, done)))
        future.add_done_callback(hand_over)

    for _ in range(getattr(executor, "_max_workers", len(tasks))):
        hand_over()
    try:
        left = len(tasks)
        while left:
            task, future = _next(waiting, answered)
            yield task, function(task) if future is None else future.result()
            left -= 1
    finally:
        waiting.clear()


def _next(waiting: deque[Task], answered: SimpleQueue[Any]) -> tuple[Task, Future[Any] | None]:
    """A task that is answered, or else one to be done here; where there is neither, the next to be answered."""
    if answered.empty():
        try:
            return waiting.popleft(), None
        except IndexError:
            pass
    found: tuple[Task, Future[Any] | None] = answered.get()
    return found
