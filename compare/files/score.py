"""What ``python -m compare score`` does: a file judged a chunk at a time, in memory that does not grow with it."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

from compare.files.columns import Columns
from compare.files.crew import Crew
from compare.files.fast_path import Sift
from compare.files.files import Rows
from compare.files.judge import CHUNK, Judge
from compare.files.show import csv_header, csv_rows, rendered
from reference.names import unknown
from reference.problems.families import FAMILIES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from compare.files.chunk import Chunk
    from compare.files.lines import Passed
    from compare.files.scales import Point
    from reference.command.at import Family
    from reference.problem import Problem

__all__ = ["Submission", "families", "judged"]


@dataclass(frozen=True)
class Submission:
    """What is asked for.

    Attributes:
        file: the name of the file, "-" for the standard input.
        family: the name of the problem's family.
        inputs: the problem's parameters by name, as they were typed; those that were given.
        exact: whether parameters and times are taken as written, else as the doubles that they spell.
        columns: the file's names of the time and the state, or None for the usual ones.
        passed: which lines of a text are no part of its table.
        rows: how many rows are shown at most.
        form: text, markdown, latex, json or csv; the last shows every row.
    """

    file: str
    family: str
    inputs: Mapping[str, str]
    exact: bool
    columns: tuple[str, ...] | None
    passed: Passed
    rows: int
    form: str


def families() -> tuple[Family, ...]:
    """The families of problems with a state in time."""
    return tuple(
        family for family in FAMILIES if "state" in family.rows and any(i.over == "time" for i in family.inputs)
    )


def judged(asked: Submission, progress: Callable[[str], None] | None = None) -> Iterator[str]:
    """Judge a file and give the answer piece by piece; ``progress`` is told how many rows are done.

    Raises:
        OSError: the file is missing or cannot be read.
        ValueError: it, or what was asked, is not as it must be; one sentence says what is accepted.
    """
    problem = _problem(asked)
    judge = Judge(problem)
    columns = Columns((judge.time, *problem.state_names), asked.columns, judge.units)
    rows = Rows(asked.file, columns, asked.passed, as_written=asked.exact)
    running = judge.running(asked.rows)
    done = 0
    with Crew(judge) as crew:
        sift = Sift(judge, running, crew)
        for points, held, count in _found(rows, judge, crew, crew.points if asked.form == "csv" else sift.points):
            running.add(points)
            if asked.form == "csv":
                yield ("" if done else csv_header(problem.state_names)) + csv_rows(
                    running.resolved(p, held) for p in points
                )
            done += count
            if progress is not None:
                progress(f"{done} rows")
    if asked.form != "csv":
        yield rendered(judge.score(running, rows.times, rows.notes), asked.form)


def _found(
    rows: Rows, judge: Judge, crew: Crew, judged: Callable[[Chunk], Callable[[], list[Point]]]
) -> Iterator[tuple[list[Point], float, int]]:
    """What is found of each chunk, the digits that the input holds up to there, and how many rows it has."""
    waiting: deque[tuple[Callable[[], list[Point]], float, int]] = deque()
    for chunk in rows.chunks(CHUNK):
        found = judged(chunk)
        waiting.append((found, judge.held, len(chunk)))
        while len(waiting) > crew.ahead:
            found, held, count = waiting.popleft()
            yield found(), held, count
    for found, held, count in waiting:
        yield found(), held, count


def _problem(asked: Submission) -> Problem:
    """The problem, from the options of its family.

    Raises:
        ValueError: there is no such family, an input of it is missing or is none of its, or one is outside its range.
    """
    known = {family.name: family for family in families()}
    if asked.family not in known:
        raise ValueError(unknown("problem", asked.family, known))
    family = known[asked.family]
    accepted = [wanted for wanted in family.inputs if not wanted.over]
    for name in asked.inputs:
        if name not in {wanted.name for wanted in accepted}:
            raise ValueError(unknown("option", f"--{name}", [f"--{wanted.name}" for wanted in accepted]))
    given = {wanted.name: asked.inputs.get(wanted.name, wanted.default) for wanted in accepted}
    missing = [f"--{w.name}" for w in accepted if given[w.name] is None and not w.optional]
    if missing:
        raise ValueError(f"{', '.join(missing)} of the {family.name} is needed.")
    return family.problem(
        **{
            wanted.name: wanted.read(wanted.name, text, as_written=asked.exact)
            for wanted in accepted
            if (text := given[wanted.name]) is not None
        }
    )
