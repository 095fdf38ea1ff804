"""What the first rows of a file betray: angles and times in other units or from another origin, and exchanged numbers.

Such rows do not fit the truth as they are, and do where they are read otherwise.  A step of which the times are the
numbers is found by the rule y(n + 1) - y(n) = h (f(n) + f(n + 1))/2 and Newton's method on the truth at n h.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import combinations, pairwise, product
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from reference.arithmetic.namespaces import BALL, NUMPY
from reference.problem import NO_TIME

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from flint import arb

    from compare.files.chunk import Row
    from compare.files.written import Written
    from reference.problem import Problem

__all__ = ["FIRST_ROWS", "FirstRows", "disorder"]

FIRST_ROWS = 16
"""Rows that tell degrees from radians: a poor integrator needs some time to be 57 times wrong."""
LEAST_ROWS = 3
"""Rows that tell numbers that are exchanged, or of other units, from ones that happen to be alike."""
ANGLES = (
    ("degrees", 180 / math.pi, "pi/180"),
    ("gradians", 200 / math.pi, "pi/200"),
    ("milliradians", 1e3, "0.001"),
    ("arc minutes", 10800 / math.pi, "pi/10800"),
    ("arc seconds", 648000 / math.pi, "pi/648000"),
)
"""Units of angles, how many of them are a radian, and by what they are to be multiplied."""
CLOSE = 0.02
"""Relative to such a factor, within which a number is wrong by it."""
FITS = 1 / 100
"""Of a number's size, within which rows fit the truth; an integrator that is worse gets no hint."""
FAILS = 1 / 4
"""Of a number's size, within which some row does not fit as it is."""
NEWTON_STEPS = 8
"""Steps of Newton's method towards a step of the time."""


class TimeUnit(NamedTuple):
    """A unit of time, what it is in s, and how this is written."""

    name: str
    seconds: Fraction
    written: str


SECOND = TimeUnit("s", Fraction(1), "1")
TIME_UNITS = (
    TimeUnit("ms", Fraction(1, 1000), "0.001"),
    TimeUnit("µs", Fraction(1, 10**6), "1e-6"),
    TimeUnit("ns", Fraction(1, 10**9), "1e-9"),
    TimeUnit("minutes", Fraction(60), "60"),
    TimeUnit("hours", Fraction(3600), "3600"),
    TimeUnit("days", Fraction(86400), "86400"),
)


class Reading(NamedTuple):
    """How rows may be meant.

    Attributes:
        degrees: whether the angles are in degrees.
        unit: the unit of the time, and ``rates`` whether rates are by it too.
        origin: the time from which times are counted, or None where that is 0.
    """

    degrees: bool
    unit: TimeUnit
    rates: bool
    origin: Written | None


class FirstRows:
    """The first rows of a file beside their truths; ``truth`` gives the states at other times.

    ``time`` is what the state is a function of.
    """

    def __init__(
        self,
        problem: Problem,
        time: str,
        rows: Sequence[Row],
        truths: Sequence[Sequence[arb]],
        truth: Callable[[list[Fraction]], list[Any]],
    ) -> None:
        self._problem, self._time, self._truth = problem, time, truth
        self._names = problem.state_names
        self._units = [quantity.units for quantity in problem.row("state").quantities]
        self._times = [row.t for row in rows[:FIRST_ROWS]]
        self._given = _columns(
            [[float(BALL.number(number.value)) for number in row.state] for row in rows[:FIRST_ROWS]]
        )
        self._true = _columns([list(map(float, truth)) for truth in truths[:FIRST_ROWS]])

    def refuse_other_units(self) -> None:
        """Refuse rows whose angles are wrong by the factor that another unit would make them wrong by.

        Raises:
            ValueError: they are.
        """
        for name, unit, ours, theirs in zip(self._names, self._units, self._given, self._true, strict=True):
            size = max(map(abs, theirs))
            ratios = [a / b for a, b in zip(ours, theirs, strict=True) if abs(b) > size / 8]
            for what, factor, by in ANGLES if unit.startswith("rad") and ratios else ():
                near = abs(median(ratios) / factor - 1)
                if near < CLOSE and (what == "degrees" or _all_near(ratios, factor)):
                    raise ValueError(
                        f"{name} is {median(ratios):.1f} times the truth, as an angle in {what} would be; {unit} is "
                        f"accepted, so multiply by {by}."
                    )

    def exchanged(self) -> str:
        """A sentence where two numbers of the state fit each other's truth, and not their own; "" else."""
        given, true, names = self._given, self._true, self._names
        count = len(self._times)
        for i, j in combinations(range(len(names)), 2):
            other = max(_misfit(given[j], true[i]), _misfit(given[i], true[j]))
            own = max(_misfit(given[i], true[i]), _misfit(given[j], true[j]))
            if count >= LEAST_ROWS and other < FITS and own > FAILS:
                return (
                    f"The first {count} rows fit the truth where {names[i]} and {names[j]} are exchanged, and not as "
                    "they are: each may be in the other's place."
                )
        return ""

    def refuse_other_times(self) -> None:
        """Refuse rows that are not where the motion is at their times, and are where it is in other units of time, at
        times from the first on, or at equal steps of which the times are the numbers.

        Raises:
            ValueError: they are.
        """
        if self._time != "t" or len(self._times) < LEAST_ROWS or max(map(_misfit, self._given, self._true)) <= FAILS:
            return
        for origin in (None, self._times[0]) if self._times[0].value else (None,):
            for unit in self._time_units(origin):
                instants = self._instants(origin, unit.seconds)
                readings = [
                    Reading(degrees, unit, rates, origin) for degrees, rates in product((False, True), repeat=2)
                ]
                self._refuse_readings(readings, instants)
        self._refuse_numbers()

    def _time_units(self, origin: Written | None) -> Iterator[TimeUnit]:
        """Units of time, in which rows may be; a second too, where times are counted from elsewhere."""
        yield from (() if origin is None else (SECOND,))
        yield from TIME_UNITS
        for name, seconds in self._problem.time_units().items():
            yield TimeUnit(name, Fraction(seconds), repr(seconds))

    def _instants(self, origin: Written | None, step: Fraction) -> list[Fraction]:
        begin = Fraction(0) if origin is None else origin.value
        return [(t.value - begin) * step for t in self._times]

    def _states(self, instants: list[Fraction]) -> list[tuple[float, ...]]:
        """The truths at some times, as columns; [] where there is no motion then, or where it would be proven farther
        than the rows ask for.
        """
        farthest = max(abs(t.value) for t in self._times)
        if not self._problem.has_closed_form and max(map(abs, instants)) > farthest:
            return []
        try:
            return _columns([list(map(float, state)) for state in self._truth(instants)])
        except ValueError:  # a descent ends
            return []

    def _refuse_readings(self, readings: Iterable[Reading], instants: list[Fraction]) -> None:
        """Refuse rows that are at these instants, where they are read in one of some ways."""
        last = self._states(instants[-1:])
        for reading in readings if last else ():
            given = self._read(reading)
            if not all(_near(a[-1], b, c) for a, (b,), c in zip(given, last, self._true, strict=True)):
                continue
            found = self._states(instants)
            if found and max(map(_misfit, given, found)) < FITS:
                raise ValueError(self._sentence(reading))

    def _read(self, reading: Reading) -> list[tuple[float, ...]]:
        """The numbers of the rows in the units of the truth."""
        degree, second = (ANGLES[0][1] if reading.degrees else 1.0), float(reading.unit.seconds)
        factors = [
            (1 / degree if unit.startswith("rad") else 1.0) / (second if reading.rates and _is_rate(unit) else 1.0)
            for unit in self._units
        ]
        return [
            tuple(number * factor for number in column) for factor, column in zip(factors, self._given, strict=True)
        ]

    def _sentence(self, reading: Reading) -> str:
        time, unit, origin, rates = self._time, reading.unit, reading.origin, self._rates
        is_second = unit is SECOND
        where = [] if is_second else [f"in {unit.name}"]
        where += [] if origin is None else [f"counted from the first ({origin.text})"]
        also = [] if not reading.degrees else ["angles in degrees"]
        also += [f"so is the time in {rates}"] if reading.rates and not is_second else []
        instead = " ".join([*([] if is_second else ["in s"]), *([] if origin is None else ["from 0"])])
        wanted = [] if origin is None else [f"subtract {origin.text} from {time}"]
        wanted += [] if is_second else [f"multiply {time} by {unit.written}"]
        todo = " and ".join(wanted)
        todo += ", and angles by pi/180" if reading.degrees and not is_second else ""
        todo += " and multiply angles by pi/180" if reading.degrees and is_second else ""
        todo += f", and divide {rates} by {unit.written}" if reading.rates and not is_second else ""
        return (
            f"the first {len(self._times)} rows fit the truth where {time} is {' and '.join([', '.join(where), *also])}"
            f", and not where it is {instead}, which is accepted, so {todo}."
        )

    @property
    def _rates(self) -> str:
        """The names of the numbers that are rates."""
        return " and ".join(name for name, unit in zip(self._names, self._units, strict=True) if _is_rate(unit))

    def _refuse_numbers(self) -> None:
        """Refuse rows whose times count equal steps, of which the motion tells the size."""
        values = [t.value for t in self._times]
        if not self._problem.autonomous or any(b - a != 1 for a, b in pairwise(values)):
            return
        for degrees, begin in product((False, True), dict.fromkeys((Fraction(0), values[0]))):
            given = self._read(Reading(degrees, SECOND, rates=False, origin=None))
            numbers = [int(value - begin) for value in values]
            step = self._step(given, numbers)
            found = self._states([Fraction(step) * number for number in numbers]) if step else []
            if found and max(map(_misfit, given, found)) < FITS:
                count = "" if not begin else f", from {self._times[0].text} on"
                turned = ", and angles by pi/180" if degrees else ""
                also = " and angles are in degrees" if degrees else ""
                raise ValueError(
                    f"the first {len(values)} rows fit the truth where {self._time} is the number of a step of about "
                    f"{step:.6g} s{count}{also}, and not where it is in s, which is accepted, so multiply "
                    f"{self._time} by the step{turned}."
                )

    def _step(self, given: Sequence[tuple[float, ...]], numbers: Sequence[int]) -> float:
        """The step at whose multiples the motion is nearest to the rows; 0.0 where none is found."""
        rows, sizes = np.array(given), np.max(np.abs(given), axis=1, keepdims=True)
        slopes = self._slopes(given)
        if not sizes.all() or not np.isfinite(slopes).all():
            return 0.0
        changes, means = np.diff(rows) / sizes, (slopes[:, 1:] + slopes[:, :-1]) / 2 / sizes
        if not means.any():
            return 0.0
        step = float(np.sum(changes * means) / np.sum(means * means))
        count = np.array(numbers)
        for used in np.linspace(LEAST_ROWS, len(numbers), NEWTON_STEPS).astype(int):
            found = self._states([Fraction(step) * number for number in numbers[:used]]) if step > 0 else []
            if not found:
                return 0.0
            along = self._slopes(found) * count[:used] / sizes
            if not along.any():
                return 0.0
            step += float(np.sum(along * (rows[:, :used] - np.array(found)) / sizes) / np.sum(along * along))
        return step if step > 0 else 0.0

    def _slopes(self, states: Sequence[tuple[float, ...]]) -> np.ndarray:
        """The derivative of the state at some states, [state, rows]."""
        parameters = self._problem.parameters_in(NUMPY)
        columns = tuple(np.array(column) for column in states)
        with np.errstate(all="ignore"):
            found = self._problem.derivative(NUMPY, NO_TIME, columns, parameters)
        return np.array([np.broadcast_to(column, columns[0].shape) for column in found], dtype=float)


def disorder(time: str, rows: Sequence[Row], t: Written, last: Written, place: str) -> str:
    """What is said of a time that is not after the last before it."""
    fault = "is repeated" if t.value == last.value else f"comes after {time} = {last.text}"
    accepted = "increasing times are accepted"
    if len(rows) >= LEAST_ROWS and all(b.t.value < a.t.value for a, b in pairwise(rows)):
        accepted += f", and all of these rows are in the order of decreasing {time}, so turn them round"
    return f"{time} = {t.text} in {place} {fault}; {accepted}."


def _is_rate(unit: str) -> bool:
    return unit.endswith("s-1")


def _all_near(ratios: Sequence[float], factor: float) -> bool:
    return len(ratios) >= LEAST_ROWS and all(abs(ratio / factor - 1) < FITS for ratio in ratios)


def _near(given: float, found: float, others: Sequence[float]) -> bool:
    """Whether a number may be another, against the size that it has elsewhere."""
    return abs(given - found) <= FITS * max(abs(found), *map(abs, others))


def _columns(rows: Iterable[Sequence[float]]) -> list[tuple[float, ...]]:
    return list(zip(*rows, strict=True))


def _misfit(given: Sequence[float], true: Sequence[float]) -> float:
    """The largest difference, of the truth's largest size; infinite where that is zero."""
    size = max(map(abs, true))
    return max(abs(a - b) for a, b in zip(given, true, strict=True)) / size if size else math.inf
