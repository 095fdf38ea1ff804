"""Rows of written numbers against the proven state at their exact times.

Angles that are wrong by whole turns, as a wrapped angle is where the motion's own goes on, are counted over all rows.
"""

from __future__ import annotations

import math
import sys
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from flint import arb

from compare.files.conditioned import conditioned, resolution
from compare.files.record import Running
from compare.files.scales import Point
from compare.files.slips import FirstRows, disorder
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.arithmetic.underflow import require_gradual
from reference.consistency import consistent
from reference.names import short
from reference.orbits import apart
from reference.problem import Problem
from reference.routes import enclosure

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from compare.files.chunk import Row
    from compare.files.conditioned import Resolution
    from compare.files.record import Score
    from compare.files.written import Written
    from reference.orbits import Orbits

__all__ = ["CHUNK", "Judge", "Turns"]

TURN = 2 * math.pi
NEAR = 0.5
"""rad: a poor integrator's error may be added to the turns."""
MOST = 0.9
"""The least part of the angles wrong by more than half a turn that is wrong by whole ones where angles are wrapped:
an error that merely grows is as often a half as a whole."""
FARTHEST = 1e12
"""rad: larger errors are no turns; doubles, which are then 1e-4 apart and more, soon tell no turn from its parts."""


class Turns:
    """Counts, of the rows of a submission, the angles that are wrong by whole turns.

    ``names`` and ``units`` are of the state's numbers; those in rad are angles.
    """

    def __init__(self, names: Sequence[str], units: Sequence[str]) -> None:
        self._angles = {i: name for i, name in enumerate(names) if units[i] == "rad"}
        self._first: dict[int, int] = {}
        self._turned, self._astray, self._rows = dict.fromkeys(self._angles, 0), dict.fromkeys(self._angles, 0), 0

    def add(self, errors: np.ndarray) -> None:
        """Take in the errors of the next rows, [rows, state]."""
        for i in self._angles:
            size = np.abs(errors[:, i])
            astray = size > TURN / 2
            turned = astray & (size < FARTHEST) & (_past_turns(size) < NEAR)
            if i not in self._first and turned.any():
                self._first[i] = self._rows + int(np.argmax(turned)) + 1
            self._turned[i] += int(turned.sum())
            self._astray[i] += int(astray.sum())
        self._rows += len(errors)

    def unsure(self, errors: np.ndarray, within: np.ndarray) -> np.ndarray:
        """The rows that may count otherwise than with these errors, which are right to ``within``, [rows, state]."""
        found = np.zeros(len(errors), dtype=bool)
        for i in self._angles:
            size, least = np.abs(errors[:, i]), within[:, i]
            for measure, edge in ((size, TURN / 2), (size, FARTHEST), (_past_turns(size), NEAR)):
                found |= ~(np.abs(measure - edge) > least)  # what is not a number is unsure
        return found

    def notes(self) -> list[str]:
        """A sentence for each angle that is wrong by whole turns."""
        return [
            f"{name} is wrong by whole turns of 2 pi in {self._turned[i]} of {self._rows} rows, from row "
            f"{self._first[i]} on, as an angle that is wrapped would be; one that goes on from turn to turn is "
            "accepted, as numpy.unwrap makes it."
            for i, name in self._angles.items()
            if self._turned[i] and self._turned[i] >= MOST * self._astray[i]
        ]


def _past_turns(size: np.ndarray) -> np.ndarray:
    """How far each is from the nearest whole turns; what is beyond FARTHEST is taken for that."""
    within = np.minimum(size, FARTHEST)
    found: np.ndarray = np.abs(within - np.rint(within / TURN) * TURN)
    return found


SPARE_BITS = 64
"""Bits of the truth beyond the last that the input can hold, so that its errors are known to a good many digits."""
CHUNK = 1024
"""Rows that are judged together: enough to share what they can share, few enough for any memory."""


class Judge:
    """A problem's truth, held against rows in the order of their times.

    Attributes:
        time: what the state is a function of: "t", or the name of another time, such as "tau".
        held: the digits that the input can hold: the most that any of its numbers so far has.
        last_place: the least power of ten of the last digit of its numbers so far; -infinite where one is no decimal.
        condition: what tells the condition of the truth, or None.
        rows: how many rows are judged, and ``last`` the time of the last of them.
        turns: counts the angles that are wrong by whole turns, of all rows.

    Raises:
        TypeError: ``problem`` is no problem with a state in time.
    """

    def __init__(self, problem: Problem) -> None:
        if not isinstance(problem, Problem) or not _time(problem):
            raise TypeError(
                f"problem is {problem!r}; a problem with a state in time, such as Pendulum(1.0), is accepted."
            )
        require_gradual("a score")
        consistent(problem)
        self.problem = problem
        self.time = _time(problem)
        self.held, self.last_place = 0.0, math.inf
        self.condition = problem.input_condition()
        self._units = tuple(quantity.units for quantity in problem.row("state").quantities)
        self.turns = Turns(problem.state_names, self._units)
        self.rows = 0
        self.last: Written | None = None
        self._slip = ""

    def running(self, keep: int | None) -> Running:
        """A summary of no rows yet, which keeps ``keep`` of them at most; all if it is None."""
        start = [_log_size(BALL.number(value)) for value in self.problem.start]
        return Running(self.problem.state_names, keep, start)

    def expect(self, digits: float, last: float) -> None:
        """Learn the digits and the least last place of numbers to come."""
        self.held, self.last_place = max(self.held, digits), min(self.last_place, last)

    def expect_numbers(self, numbers: Iterable[Written]) -> None:
        """Learn them of the numbers themselves."""
        for number in numbers:
            self.expect(number.digits, -math.inf if number.last is None else number.last)

    @property
    def resolution(self) -> Resolution:
        """What the format of the numbers so far resolves."""
        return resolution(self.held, self.last_place)

    def points(self, rows: Sequence[Row]) -> list[Point]:
        """Judge the next rows; their digits are not yet capped at what the input can hold, nor their turns counted.

        Raises:
            ValueError: the times do not increase, an angle is in degrees, or an error is beyond the range of doubles.
        """
        self._refuse_disorder(rows)
        self.expect_numbers(number for row in rows for number in row.state)
        found = self.some(range(len(rows)), rows)
        self.pass_over(len(rows), rows[-1].t)
        return found

    def some(self, places: Sequence[int], rows: Sequence[Row]) -> list[Point]:
        """Judge rows at these places, counted from 0, among those that come next, in which none is passed yet.

        Raises:
            ValueError: an angle is in degrees, or an error is beyond the range of doubles.
        """
        bits = math.ceil(self.held * math.log2(10)) + SPARE_BITS
        instants = [row.t.value for row in rows]
        truths = self._truths(instants, bits)
        if not self.rows and not places[0]:
            first = FirstRows(self.problem, self.time, rows, truths, partial(self._truths, bits=bits))
            first.refuse_other_units()
            first.refuse_other_times()
            self._slip = first.exchanged()
        with ctx.workprec(bits + SPARE_BITS + self.problem.working_bits(instants) + _whole_bits(rows)):
            bench = _Bench(self.problem, bits)
            return [
                bench.point(self.rows + place + 1, row, truth, lost)
                for place, row, truth, lost in zip(places, rows, truths, self._losses(instants, truths), strict=True)
            ]

    def _losses(self, instants: list[Fraction], truths: list[tuple[arb, ...]]) -> list[list[float]]:
        """What the format must lose of the numbers at some times; NaN where that is not known."""
        if self.condition is None:
            return [[math.nan] * len(self._units)] * len(instants)
        times = [float(t) if abs(t) <= sys.float_info.max else math.inf for t in instants]
        sizes = np.abs(np.array([list(map(float, truth)) for truth in truths]))
        with np.errstate(all="ignore"):
            return self.resolution.losses(sizes, self.condition.led(np.array(times))).tolist()  # type: ignore[no-any-return]

    def _truths(self, instants: list[Fraction], bits: int) -> list[tuple[arb, ...]]:
        return enclosure.balls(self.problem, "state", instants, bits)

    def pass_over(self, count: int, last: Written) -> None:
        """Go on to the rows after the next ``count``, of which the last has this time."""
        self.rows += count
        self.last = last

    @property
    def units(self) -> tuple[str, ...]:
        """The units of the time and of the state's numbers."""
        return ("s" if self.time == "t" else "1", *self._units)

    def score(self, running: Running, times: str, notes: Sequence[str] = ()) -> Score:
        """The summary of all rows so far, which ``running`` took in; ``times`` says how times were read, and ``notes``
        what else is to be known of the file.
        """
        told = (*notes, *self._notes(running))
        return running.score(repr(self.problem), self._units, self.held, self.resolution, times, told)

    def _notes(self, running: Running) -> tuple[str, ...]:
        """What could not be judged, or is to be known of it, in sentences."""
        lacking, lost = self.problem.lacks_of_orbits, running.lost
        notes = [f"{constant}." for constant in self.problem.constants]
        notes += [lacking] if lacking else []
        if not self.problem.invariants:
            notes.append(f"No energy error is defined for the problem {self.problem.name}: nothing is conserved.")
        if lost is not None and not (lacking and self._phaseless):
            notes.append(
                f"Row {lost.number}, {self.time} = {lost.t}, is the first whose state is on no orbit of the exact "
                "motion's kind: it has no phase."
            )
        return *notes, *self.turns.notes(), *([self._slip] if self._slip else [])

    @property
    def _phaseless(self) -> bool:
        """Whether the exact motion has no phase."""
        found = self.problem.orbits()
        return found is None or found.truth(Fraction(0)).phase is None

    def _refuse_disorder(self, rows: Sequence[Row]) -> None:
        last = self.last
        for t, _, place in rows:
            if last is not None and t.value <= last.value:
                raise ValueError(disorder(self.time, rows, t, last, place))
            last = t


def _time(problem: Problem) -> str:
    """What the problem's state is a function of; "" where it has no state."""
    over = next((row.over for row in problem.rows if row.name == "state"), "")
    return {"time": "t", "once": "", "index": ""}.get(over, over)


def _whole_bits(rows: Sequence[Row]) -> int:
    """Bits of the largest number of the states before its point: an angle loses them where its turns are taken off."""
    values = [number.value for row in rows for number in row.state]
    return max(0, *(value.numerator.bit_length() - value.denominator.bit_length() + 1 for value in values))


class _Bench:
    """What the rows of a chunk share, at the working precision in force: the truth is good to ``bits`` bits."""

    def __init__(self, problem: Problem, bits: int) -> None:
        self._problem = problem
        self._parameters = problem.parameters_in(BALL)
        self._orbits: Orbits | None = problem.orbits()
        self._resolution = arb(2) ** -bits
        start = problem.start_in(BALL)
        self._start: arb | None = self._invariant(start)
        self._scale = arb(0) if self._start is None else self._start
        if problem.invariants and problem.invariants[0].scale == "kinetic":
            self._scale = arb(problem.kinetic(BALL, start, self._parameters))

    def point(self, number: int, row: Row, truth: Sequence[arb], losses: Sequence[float]) -> Point:
        """Judge one row, of whose numbers the format must lose so much.

        Raises:
            ValueError: an error is beyond the range of doubles.
        """
        t, state, place = row
        y = [BALL.number(given.value) for given in state]
        errors = [given - true for given, true in zip(y, truth, strict=True)]
        decimals = [self._digits(*pair) for pair in zip(errors, truth, strict=True)]
        relative = tuple(map(_correct, state, decimals, errors))
        phase, amplitude = self._orbital(t.value, y)
        energy = self._energy_error(y)
        floats = tuple(float(error) for error in errors)
        if any(map(math.isinf, (*floats, amplitude, energy))):
            shown = ", ".join(short(given.text) for given in state)
            raise ValueError(
                f"the state in {place} is {shown}: its error or its energy is beyond {sys.float_info.max:.1e}, the "
                "range of doubles; smaller numbers are accepted."
            )
        return Point(
            number=number,
            t=t.text,
            values=tuple(given.text for given in state),
            digits=min((digits for digits in relative if not math.isnan(digits)), default=math.inf),
            error=max(abs(error) for error in floats),
            errors=floats,
            first_wrong=tuple(map(_first_wrong, state, decimals, errors)),
            phase_error=phase,
            amplitude_error=amplitude,
            energy_error=energy,
            conditioned=conditioned(floats, losses),
            instant=t.value,
            scaled_digits=math.nan,
            relative=relative,
            sizes=tuple(
                -math.inf if math.isinf(digits) else _log10(abs(error))
                for digits, error in zip(decimals, errors, strict=True)
            ),
            truths=tuple(map(_log_size, truth)),
        )

    def _digits(self, error: arb, truth: arb) -> float:
        """-log10 |error/truth|, not below 0: infinite where that is met as far as it is known; NaN where it is 0."""
        size = abs(error)
        if size <= self._resolution * abs(truth) or error.is_zero():
            return math.inf
        return max(0.0, -_log10(size / abs(truth))) if not truth.is_zero() else math.nan

    def _orbital(self, t: Fraction, y: Sequence[arb]) -> tuple[float, float]:
        """(phase error in rad, amplitude error in rad)."""
        if self._orbits is None:
            return math.nan, math.nan
        return apart(self._orbits.place(y), self._orbits.truth(t))

    def _energy_error(self, y: Sequence[arb]) -> float:
        invariant = self._invariant(y)
        if invariant is None or self._start is None:
            return math.nan
        change = invariant - self._start
        return float(change if self._scale.contains(0) else change / abs(self._scale))

    def _invariant(self, y: Sequence[arb]) -> arb | None:
        if not self._problem.invariants:
            return None
        return arb(getattr(self._problem, self._problem.invariants[0].value)(BALL, y, self._parameters))


def _log10(ball: arb) -> float:
    """log10 of a positive ball, of any size."""
    return float(ball.mid().log() / arb(10).log())


def _log_size(ball: arb) -> float:
    """log10 of its size, -infinite where it is exactly zero."""
    return -math.inf if ball.is_zero() else _log10(abs(ball))


def _correct(given: Written, digits: float, error: arb) -> float:
    """The digits, or all that are written where the last of them is right too."""
    if given.last is not None and abs(error) <= arb(10) ** given.last / 2:
        return max(digits, given.digits)
    return digits


def _first_wrong(given: Written, digits: float, error: arb) -> int | None:
    """The place of the first significant digit of which half a unit is less than the error; None beyond the last."""
    if math.isinf(digits) or (given.last is None and digits >= given.digits):
        return None
    wrong = math.ceil(_log10(2 * abs(error))) - 1
    if given.last is not None and wrong < given.last:
        return None
    if given.last is not None:
        leading = given.last + max(int(given.digits), 1) - 1
    else:
        leading = math.floor(_log10(abs(BALL.number(given.value)))) if given.value else wrong
    return max(leading - wrong, 0) + 1
