"""Numbers from any code, judged: ``compare.score`` of arrays, and ``python -m compare score`` of a file.

A file, whatever its format, is read and judged a chunk of rows at a time, in memory that does not grow with it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.files.arrays import chunks, npy_columns
from compare.files.chunk import Row
from compare.files.columns import Columns
from compare.files.crew import Crew
from compare.files.exact_rows import Times
from compare.files.fast_path import Sift
from compare.files.hdf5 import hdf5_columns
from compare.files.judge import CHUNK, Judge
from compare.files.lines import NOTHING
from compare.files.npz import npz_columns
from compare.files.show import csv_header, csv_rows
from compare.files.text import STANDARD_INPUT, TextRows
from compare.files.written import of_value
from reference.arithmetic.exact import NO_SEQUENCES
from reference.command import at
from reference.named import is_own
from reference.names import unknown
from reference.problems.families import FAMILIES, find_family

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from compare.files.chunk import Chunk
    from compare.files.conditioned import Resolution
    from compare.files.limits import Limits
    from compare.files.lines import Passed
    from compare.files.record import Score
    from compare.files.scales import Point
    from compare.files.written import Written
    from reference.family import Family
    from reference.problem import Problem

__all__ = ["SUFFIXES", "Rows", "Submission", "families", "judged", "score"]


def score(problem: Problem, t: Any, y: Any) -> Score:
    """Judge a trajectory against the proven state at exactly its times.

    Args:
        problem: a problem with a state in time, such as ``Pendulum(1.0)``.
        t: the times in s, increasing, of shape [rows]: floats at their exact values, decimal strings, Fractions.
        y: the states, of shape [rows, state]: floating-point numbers of any width, decimal strings, Decimals, Fractions
            or mpmath's numbers.  A decimal of 48 digits is judged to 48 digits.

    Raises:
        ValueError: times do not increase, shapes do not match, a number is not finite, or angles are in degrees.
        TypeError: ``problem`` is no problem, something is no real number, or an array is masked.
    """
    judge = Judge(problem)
    times = [of_value(value, "t") for value in _listed(t, "t")]
    states = [_state(row, number, problem.state_names) for number, row in enumerate(_listed(y, "y"), start=1)]
    if len(times) != len(states):
        raise ValueError(f"t has {len(times)} times and y {len(states)} rows; equally many are accepted.")
    judge.expect_numbers(number for state in states for number in state)
    running = judge.running(None)
    rows = [
        Row(when, state, f"row {number}")
        for number, (when, state) in enumerate(zip(times, states, strict=True), start=1)
    ]
    for first in range(0, len(rows), CHUNK):
        points = judge.points(rows[first : first + CHUNK])
        judge.turns.add(np.array([point.errors for point in points]))
        running.add(points)
    return judge.score(running, "as written")


def _state(row: Any, number: int, names: Sequence[str]) -> tuple[Written, ...]:
    values = _listed(row, f"row {number} of y")
    if len(values) != len(names):
        wanted = ", ".join(names)
        raise ValueError(f"row {number} of y has {len(values)} numbers; {len(names)} are accepted: {wanted}.")
    return tuple(of_value(value, f"{name} in row {number}") for name, value in zip(names, values, strict=True))


def _listed(values: Any, name: str) -> list[Any]:
    """A sequence or the first axis of an array as a list, whose numbers keep their types."""
    if isinstance(values, (str, *NO_SEQUENCES)):
        raise TypeError(f"{name} is of type {type(values).__name__}; a sequence or an array is accepted.")
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array, whose elements need not be numbers; an array is accepted.")
    if hasattr(values, "__array__"):
        array = np.asarray(values)
        if array.ndim == 0:
            raise ValueError(f"{name} is a single number; a sequence or an array is accepted.")
        return array.tolist() if array.dtype == np.float64 else list(array)
    if not isinstance(values, Iterable):
        raise TypeError(f"{name} is of type {type(values).__name__}; a sequence or an array is accepted.")
    return list(values)


TEXT = (".csv", ".tsv", ".txt", ".dat", ".tab", ".prn", ".lvm", ".json", ".jsonl", ".ndjson")
HDF5 = (".h5", ".hdf5", ".nc", ".mat")
"""HDF5 itself, and what is written in it: netCDF-4, and MATLAB's files since version 7.3."""
SUFFIXES = (*TEXT, ".npy", ".npz", *HDF5)


class Rows:
    """The rows of a file, in chunks; "-" is the standard input, as text.

    Attributes:
        times: how times are read, known after the first chunk: "as written" or "binary64".
        notes: sentences on what did not count, or may be amiss; known after the last chunk.

    Raises:
        FileNotFoundError: there is no such file.
        IsADirectoryError: it is a folder.
        ValueError: its suffix is of no format that is read here, or has no array of all states, which was asked for, or
            no lines that could be passed over.
    """

    def __init__(self, name: str, columns: Columns, passed: Passed = NOTHING, *, as_written: bool) -> None:
        self._path, self._columns = Path(name), columns
        self._suffix = TEXT[0] if name == STANDARD_INPUT else self._path.suffix.lower()
        if self._suffix not in (".npz", *HDF5):
            columns.refuse_packed()
        self._times = Times(as_written=as_written)
        self._text = TextRows(columns, passed, self._times)
        if name == STANDARD_INPUT:
            return
        if self._path.is_dir():
            raise IsADirectoryError(f"'{name}' is a folder; a file is accepted.")
        if not self._path.exists():
            raise FileNotFoundError(f"there is no file '{name}'.")
        if self._suffix not in SUFFIXES:
            raise ValueError(f"'{name}' is of no format that is read here; accepted are {', '.join(SUFFIXES)}.")
        if passed != NOTHING and self._suffix not in TEXT:
            raise ValueError(f"'{name}' has no lines; --skip and --comment are accepted of text.")

    @property
    def times(self) -> str:
        return str(self._times)

    @property
    def notes(self) -> tuple[str, ...]:
        return tuple(self._text.notes)

    def chunks(self, size: int) -> Iterator[Chunk]:
        """Read the file, ``size`` rows at a time.

        Raises:
            ValueError: it is not what its suffix says, or a row cannot be judged.
        """
        if self._suffix in TEXT:
            yield from self._text.chunks(self._path, size)
            return
        opened = {".npy": npy_columns, ".npz": npz_columns}.get(self._suffix, hdf5_columns)
        with opened(self._path, self._columns) as found:
            yield from chunks(self._columns, found, size, self._times)


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
        form: text, markdown, latex, json, html or csv; the last shows every row.
        limits: what is asked of the score.
    """

    file: str
    family: str
    inputs: Mapping[str, str]
    exact: bool
    columns: tuple[str, ...] | None
    passed: Passed
    rows: int
    form: str
    limits: Limits


def families() -> tuple[Family, ...]:
    """The families of problems with a state in time."""
    return tuple(
        family for family in FAMILIES if "state" in family.rows and any(i.over == "time" for i in family.inputs)
    )


def judged(asked: Submission, write: Callable[[str], None], progress: Callable[[str], None] | None = None) -> Score:
    """Judge a file; CSV is written row by row as it is found, and ``progress`` is told how many rows are done.

    Raises:
        OSError: the file is missing or cannot be read.
        ValueError: it, or what was asked, is not as it must be; one sentence says what is accepted.
    """
    problem = problem_of(asked)
    judge = Judge(problem)
    columns = Columns((judge.time, *problem.state_names), asked.columns, judge.units)
    rows = Rows(asked.file, columns, asked.passed, as_written=asked.exact)
    running = judge.running(asked.rows)
    done = 0
    with Crew(judge) as crew:
        sift = Sift(judge, running, crew)
        for points, held, resolution, count in _found(
            rows, judge, crew, crew.points if asked.form == "csv" else sift.points
        ):
            running.add(points)
            if asked.form == "csv":
                write("" if done else csv_header(problem.state_names))
                write(csv_rows(running.resolved(p, held, resolution) for p in points))
            done += count
            if progress is not None:
                progress(f"{done} rows")
    return judge.score(running, rows.times, rows.notes)


def _found(
    rows: Rows, judge: Judge, crew: Crew, judged: Callable[[Chunk], Callable[[], list[Point]]]
) -> Iterator[tuple[list[Point], float, Resolution, int]]:
    """What is found of each chunk, what the input holds and resolves up to there, and how many rows it has."""
    waiting: deque[tuple[Callable[[], list[Point]], float, Resolution, int]] = deque()
    for chunk in rows.chunks(CHUNK):
        found = judged(chunk)
        waiting.append((found, judge.held, judge.resolution, len(chunk)))
        while len(waiting) > crew.ahead:
            found, held, resolution, count = waiting.popleft()
            yield found(), held, resolution, count
    for found, held, resolution, count in waiting:
        yield found(), held, resolution, count


def problem_of(asked: Submission) -> Problem:
    """The problem, from the options of its family.

    Raises:
        ValueError: there is no such family, an input of it is missing or is none of its, or one is outside its range.
    """
    family = find_family(asked.family)
    if family not in families() and not is_own(asked.family):
        raise ValueError(unknown("problem", asked.family, [known.name for known in families()]))
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
            wanted.name: at.read(wanted, text, as_written=asked.exact)
            for wanted in accepted
            if (text := given[wanted.name]) is not None
        }
    )
