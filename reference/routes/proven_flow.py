"""The flow of a smooth equation y' = f(t, y), proven: polynomials with bounds of their errors, one after another.

A step takes a Taylor polynomial P of the solution, about which nothing is claimed; bounds its defect P' - h f(t, P);
encloses df/dy on a box around what P sweeps; and concludes how far the solution is from P on the whole step, and that
it exists there.  docs/flows.md states and proves what is used here, by number.

What is known between steps is a midpoint and a set of errors: a box, carried by the growth bound of each step, or a
parallelepiped, carried by the proven derivative of the step's map (R. J. Lohner, 1987), which loses hardly more than
neighbouring solutions part.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, reduce
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb, arb_mat, arb_poly

from reference.arithmetic.balls import BALL
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.models import (
    BOUND_BITS,
    Function,
    ModelArithmetic,
    Node,
    RefusedError,
    Tape,
    Variable,
    bound,
    supremum,
)
from reference.arithmetic.precision import ctx
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.declaration import Equation

__all__ = ["KEPT", "FlowSolution", "HorizonError", "Piece", "ProvenFlow", "lost", "proven", "put_off", "see"]

STEPS = 1 << 15
"""Steps that are granted to a flow."""
WATCHED, LENIENT = 64, 2
"""After so many steps it is seen whether the rest will do, were steps so many times as long from there on."""
LITTLE = Fraction(1, 16)
"""A horizon that twice the bits extend by no more than that part is one of the equation, and not of the precision."""
KEPT = 3
"""Equations whose flows are kept with their pieces, and flows of each, of other precisions."""
LEAST_BITS, BITS_APART = 96, 16
"""Working precisions of flows: at least so many bits, and multiples of so many."""
VARIATIONAL_BITS = 53
"""df/dy is read in so many bits, and the derivative of a step's map found in doubles: errors need no more."""
PARTS = 2
"""Parts of a step on each of which df/dy is enclosed."""
TRIES = 40
"""So often a step is halved before it is given up."""
STEP_BITS = 8
"""Bits of a step's length: times are exact."""
SPARE = 10
"""A step whose own error comes to more than 2^SPARE roundings is halved, as long as that makes it smaller."""
GAIN = 8
"""Bits that halving a step has to gain."""
DECAY = 1.4
"""Terms fall off by e^DECAY from one to the next where a step has its length: longer steps take more terms."""
MOST_TERMS = 128
"""Terms of the derivative of a step's map, at most: it is nearly an exponential, and a stiff one takes many."""
SIDES = 10
"""Up to so many components a parallelepiped of errors is carried: it costs products of matrices in each step."""


class HorizonError(WorkBoundError):
    """A flow is proven to some time and no further, at its working precision."""

    def __init__(self, equation: Equation, reached: Fraction, bits: int) -> None:
        super().__init__(
            f"the flow of {equation!r} is proven to t = {float(reached):.12g}, and in {bits} bits no further: "
            "the equation may be singular there, or stiff."
        )
        self.reached = abs(reached)


@dataclass(frozen=True)
class Piece:
    """The solution on one step: |y(t + s h) - P(s)| <= error in each component, for 0 <= s <= 1 and nowhere else."""

    t: Fraction
    h: Fraction
    polynomials: tuple[arb_poly, ...]
    errors: tuple[arb, ...]

    def at(self, time: Fraction) -> list[arb]:
        """The state at a time of the step, in balls.

        Raises:
            ValueError: the time is not of the step.
        """
        s = (time - self.t) / self.h
        if not 0 <= s <= 1:
            raise ValueError(f"the time {time} is not in the step from {self.t} to {self.t + self.h}.")
        x = BALL.number(s)
        return [found(x) + arb(0, error) for found, error in zip(self.polynomials, self.errors, strict=True)]


class ProvenFlow:
    """The solution of y' = f(t, y) from its start at the time 0, to both sides, at a working precision of ``bits``.

    It goes on as far as it is asked, and keeps its pieces.
    """

    def __init__(self, equation: Equation, bits: int, steps: int) -> None:
        self.equation, self.bits, self._steps = equation, bits, steps
        self._sides: dict[int, _Side] = {}

    def _side(self, sign: int) -> _Side:
        """One side of the start, from the first time on that it is asked for."""
        if sign not in self._sides:
            self._sides[sign] = _Side(self.equation, self.bits, sign, self._steps)
        return self._sides[sign]

    def at(self, time: Fraction) -> list[arb]:
        """The state at a time, in balls.

        Raises:
            WorkBoundError: the work bound is met before; the sentence says up to which time it is proven.
        """
        with ctx.workprec(self.bits):
            return self._side(-1 if time < 0 else 1).piece(time).at(time)

    def piece(self, place: int) -> Piece:
        """A piece after the start, counted from 0.

        Raises:
            WorkBoundError: the work bound is met before.
        """
        side = self._side(1)
        while len(side.pieces) <= place:
            side.piece(side.reached + Fraction(1, 2**self.bits))
        return side.pieces[place]

    def reaches(self, time: Fraction) -> bool:
        """Whether it is proven to a time."""
        side = self._side(-1 if time < 0 else 1)
        return bool(side.pieces) and abs(time) <= abs(side.reached)

    def pieces(self, sign: int) -> Sequence[Piece]:
        """What is proven so far of one side, in order."""
        return self._side(sign).pieces

    def lost(self, sign: int) -> tuple[Fraction, float]:
        """How far one side is proven, and how many bits are lost there, of the largest component."""
        side = self._side(sign)
        largest = max((float(abs(value)) for value in side.middle), default=0.0)
        error = max((_log2(value) for value in side.errors.sides if value != 0), default=-math.inf)
        return abs(side.reached), max(0.0, error + self.bits - math.log2(largest or 1.0))


class _Side:
    """The flow on one side of the start: its pieces in order."""

    def __init__(self, equation: Equation, bits: int, sign: int, steps: int) -> None:
        self.equation, self.bits, self.sign, self.most = equation, bits, sign, steps
        self.pieces: list[Piece] = []
        self._ends: list[Fraction] = []
        self.reached = Fraction(0)
        self._usual: float = SPARE
        self.order = _order(bits)
        with ctx.workprec(bits):
            start = equation.start_in(BALL)
            sides = [bound(value.rad()) for value in start]
            self.middle = [value.mid() for value in start]
            self._reading = _Reading(equation)
        self._variation = _Variation(equation)
        self.errors: _Box | _Parallelepiped = _Box(sides)
        if len(start) <= SIDES or getattr(equation, "turned", False):
            self.errors = _Parallelepiped(_unit(len(start)), sides)

    def piece(self, time: Fraction) -> Piece:
        """The piece on which a time lies."""
        with ctx.workprec(self.bits):
            while not self.pieces or abs(time) > abs(self.reached):
                self._require_granted(abs(time))
                self._advance()
        place = bisect_right(self._ends, abs(time)) if time != self.reached else len(self.pieces) - 1
        return self.pieces[min(place, len(self.pieces) - 1)]

    def _require_granted(self, time: Fraction) -> None:
        """Refuse a time that is not reached in the steps that are granted; looked at after every WATCHED of them.

        Raises:
            WorkBoundError: it is not.
        """
        count = len(self.pieces)
        if count % WATCHED or not count:
            return
        longest = max(abs(piece.h) for piece in self.pieces[-WATCHED:])
        if count >= self.most or time - abs(self.reached) > LENIENT * longest * (self.most - count):
            raise WorkBoundError(
                f"the flow of {self.equation!r} is proven to t = {float(self.reached):.12g} in {count} steps, and "
                f"would take more than the {self.most} that are granted: it may be stiff, or singular there."
            )

    def _advance(self) -> None:
        reading = self._reading
        reading.grow(self.reached, self.middle, self.order)
        length = _length(reading.variables, self.bits)
        h = self.sign * (min(length, 2 * abs(self.pieces[-1].h)) if self.pieces else length)
        powers = [arb(1)]
        step = _exact(h)
        for _ in range(self.order):
            powers.append((powers[-1] * step).mid())
        reading.tape.scale(powers)
        least = math.inf
        for _ in range(TRIES):
            if abs(h) < abs(self.reached) / 2 ** (self.bits // 4):
                break
            try:
                self._take(h, least - GAIN)
            except RefusedError as refused:
                least = min(least, refused.roundings)
                reading.tape.scale([arb(2) ** -k for k in range(self.order + 1)])
                h /= 2
            else:
                return
        raise HorizonError(self.equation, self.reached, self.bits)

    def _take(self, h: Fraction, gained: float) -> None:
        """Prove a step of this length, of which the tape has the polynomials.

        Raises:
            RefusedError: it is not proven, or its own error is of more roundings than 2^SPARE, or than that of the step
                before where halving gained nothing, and less than gained.
        """
        variables, errors = self._reading.variables, self.errors
        defects = self._reading.defects(h)
        ends = [one.polynomial(arb(1)) for one in variables]
        middle = [end.mid() for end in ends]
        with ctx.workprec(BOUND_BITS):
            off = [(value - one.terms[0]).abs_upper() for value, one in zip(self.middle, variables, strict=True)]
            begun = [bound(side + one) for side, one in zip(errors.sides, off, strict=True)]
            tube = _Tube(self._variation, variables, _exact(self.reached), _exact(h), begun, defects)
            local = tube.end(off)
            # a component that begins at zero may have no term of the polynomial's order yet
            floor = reduce(larger, (one.norm for one in variables)) * arb(2) ** -self.bits
            units = (larger(one.norm, floor) for one in variables)
            roundings = max(self._roundings(*pair) for pair in zip(local, units, strict=True))
            if self._usual < roundings < gained:
                raise RefusedError("the step is too long", roundings)
            moved = errors.moved(tube, off, local, [bound(end.rad()) for end in ends])
        self.pieces.append(Piece(self.reached, h, tuple(one.polynomial for one in variables), tuple(tube.errors)))
        self.reached += h
        self._ends.append(abs(self.reached))
        self.middle, self.errors = middle, moved
        self._usual = max(SPARE, roundings + GAIN / 2)

    def _roundings(self, error: arb, unit: arb) -> float:
        """log2 of an error in roundings of a component of this size."""
        if error == 0:
            return -math.inf
        return _log2(error) + self.bits - _log2(unit) if unit != 0 else math.inf


def _order(bits: int) -> int:
    """Terms of polynomials of which each is e^DECAY times as small as that before it, to so many bits."""
    return math.ceil(bits * math.log(2) / DECAY)


def _exact(value: Fraction) -> arb:
    """A number whose denominator is a power of two, exactly."""
    exponent = value.denominator.bit_length() - 1
    return arb((value.numerator, -exponent))


def _log2(value: arb) -> float:
    """log2 of the size of an exact number, which is not zero, to within one."""
    mantissa, exponent = value.man_exp()
    return float(abs(int(mantissa)).bit_length() + int(exponent))


def _length(variables: Sequence[Variable], bits: int) -> Fraction:
    """A step after which the last terms are below the last bit of their component; a guess, which the defect judges."""
    order = len(variables[0].terms) - 1
    sizes = [_log2(one.terms[0]) if one.terms[0] != 0 else -math.inf for one in variables]
    largest = max(sizes) if max(sizes) > -math.inf else math.inf  # at a start of zeros nothing is known of the sizes
    found = []
    for one in variables:
        known = [(k, _log2(one.terms[k])) for k in range(order - 3, order + 1) if one.terms[k] != 0]
        first = next((_log2(term) for term in one.terms if term != 0), -math.inf)
        size = max(sizes[variables.index(one)], min(first, largest))
        found += [(size - bits - log) / k for k, log in known]
    exponent = min(found, default=0.0)
    whole = math.floor(exponent)
    mantissa = math.floor(2 ** (exponent - whole) * 2**STEP_BITS)
    return Fraction(mantissa, 2**STEP_BITS) * Fraction(2) ** whole


class _Reading:
    """The equation, read once in nodes: the polynomials of a step and their defects."""

    def __init__(self, equation: Equation) -> None:
        self.tape = Tape()
        m = ModelArithmetic(self.tape)
        self._start: list[arb] = []
        self._t = arb(0)
        names = equation.state_names
        self.variables = [Variable(self.tape, self._component(place)) for place in range(len(names))]
        self.time = Variable(self.tape, lambda k: self._t if k == 0 else arb(int(k == 1)))
        p = {name: BALL.number(value) for name, value in equation.parameters.items()}
        try:
            rates: Any = equation.derivative(m, self.time, self.variables, p)
        except TypeError as error:
            told = " ".join(str(error).split()).rstrip(".")
            raise ValueError(
                f"the equation of {equation!r} is none that is smooth in every arithmetic: {told}."
            ) from error
        except AttributeError as error:
            raise ValueError(f"the equation of {equation!r} asks for '{error.name}', which a flow has not.") from error
        self.rates = [_entry(rate) for rate in rates]
        self.tape.keep([*self.variables, *self.rates])
        self._parts: list[arb] = []

    def _component(self, place: int) -> Callable[[int], arb]:
        def given(k: int) -> arb:
            if k == 0:
                return self._start[place]
            rate = self.rates[place]
            if isinstance(rate, Node):
                return (rate.terms[k - 1] * self._parts[k]).mid()
            return rate.mid() if k == 1 else arb(0)

        return given

    def grow(self, t: Fraction, start: Sequence[arb], order: int) -> None:
        """The coefficients of the solution from an exact state, up to the order, by t itself."""
        self._t, self._start = _exact(t), list(start)
        self._parts = self._parts or [arb(0), *((1 / arb(k)).mid() for k in range(1, order + 1))]
        self.tape.begin()
        for k in range(order + 1):
            self.tape.grow(k)

    def defects(self, h: Fraction) -> list[arb]:
        """A bound of |P' - h f(t, P)| on the step in each component (rule 9).

        Raises:
            RefusedError: a rule has no answer on the step.
        """
        self.tape.close([arb(0)] * (len(self.variables) + 1))
        return [_defect(one, rate, _exact(h)) for one, rate in zip(self.variables, self.rates, strict=True)]


def _constant(value: Any) -> arb:
    return BALL.number(value) if isinstance(value, Fraction) else arb(value)


def _entry(value: Any) -> Node | arb:
    """What was read of an equation: a node, or a number."""
    return value.node if isinstance(value, Function) else _constant(value)


def _defect(variable: Node, rate: Node | arb, h: arb) -> arb:
    found = rate.polynomial if isinstance(rate, Node) else arb_poly([rate])
    off = variable.polynomial.derivative() - h * found
    with ctx.workprec(BOUND_BITS):
        missed = abs(h) * rate.remainder if isinstance(rate, Node) else arb(0)
        return bound(supremum(off) + missed)


class _Tube:
    """What surrounds the polynomials of a step, and how errors grow in it (rules 10 and 11).

    ``errors`` bound the distance of every solution of which the start is within ``sides`` from the polynomials.

    Raises:
        RefusedError: f or df/dy is not finite around it, or no room is enough.
    """

    def __init__(
        self,
        variation: _Variation,
        variables: Sequence[Variable],
        time: arb,
        step: arb,
        sides: Sequence[arb],
        defects: Sequence[arb],
    ) -> None:
        self.variation, self._defects = variation, defects
        driven = [bound(side + defect) for side, defect in zip(sides, defects, strict=True)]
        largest = reduce(larger, (one.norm for one in variables)) * arb(2) ** -64
        least = [larger(one.norm, largest) * arb(2) ** -40 for one in variables]
        room = [bound(4 * one + small) for one, small in zip(driven, least, strict=True)]
        variation.follow(variables, time, step)
        for _ in range(4):
            variation.close(room)
            self._slopes = [variation.slopes(_part(j)) for j in range(PARTS)]
            self.growth = self._grown([_positive(slopes) for slopes in self._slopes])
            self.errors = _times(self.growth, driven)
            if all(error < one for error, one in zip(self.errors, room, strict=True)):
                return
            room = [bound(4 * larger(error, one)) for error, one in zip(self.errors, room, strict=True)]
        raise RefusedError("no room around the step is enough")

    def _grown(self, parts: Sequence[Sequence[Sequence[arb]]]) -> arb_mat:
        size = len(parts[0])
        found = _unit(size)
        for part in parts:
            found = _upper((arb_mat([list(row) for row in part]) / PARTS).exp() * found)
        return found

    def end(self, sides: Sequence[arb]) -> list[arb]:
        """A bound of the errors at the end of the step from those at its start (rule 11)."""
        found = list(sides)
        for grown in self._ends:
            found = _times(grown, [*found, self._largest])[:-1]
        return found

    @cached_property
    def _largest(self) -> arb:
        found = reduce(larger, self._defects)
        return found if found != 0 else arb(1)

    @cached_property
    def _ends(self) -> list[arb_mat]:
        """Of each part of the step, the exponential from which rule 11 reads its two factors."""
        driven = [bound(defect / self._largest / PARTS) for defect in self._defects]
        found = []
        for slopes in self._slopes:
            metzler = [
                [value.upper() if i == j else value.abs_upper() for j, value in enumerate(row)]
                for i, row in enumerate(slopes)
            ]
            rows = [[*(value / PARTS for value in row), push] for row, push in zip(metzler, driven, strict=True)]
            found.append(_upper(arb_mat([*rows, [arb(0)] * (len(driven) + 1)]).exp()))
        return found


def _part(j: int) -> arb:
    """The j-th part of [0, 1]."""
    return (arb(2 * j + 1) + arb(0, 1)) / (2 * PARTS)


def larger(a: arb, b: arb) -> arb:
    """The larger of two exact numbers, neither of which is NaN."""
    return max(b, a)


def _positive(slopes: Sequence[Sequence[arb]]) -> list[list[arb]]:
    """|h df/dy| apart from the diagonal, and on it the positive part of its upper end; all are finite."""
    return [
        [larger(value.upper(), arb(0)) if i == j else value.abs_upper() for j, value in enumerate(row)]
        for i, row in enumerate(slopes)
    ]


def _upper(matrix: arb_mat) -> arb_mat:
    """The upper ends of a matrix that has no negative entry, whatever its balls hold besides."""
    return arb_mat([[larger(bound(value), arb(0)) for value in row] for row in matrix.tolist()])


def _sizes(matrix: arb_mat) -> arb_mat:
    """The bounds of the entries' sizes."""
    return arb_mat([[bound(value.abs_upper()) for value in row] for row in matrix.tolist()])


def _times(matrix: arb_mat, vector: Sequence[arb]) -> list[arb]:
    return [bound(row[0]) for row in (matrix * arb_mat([[value] for value in vector])).tolist()]


class _Box:
    """Errors in a box: each component's by itself (rule 12)."""

    def __init__(self, sides: Sequence[arb]) -> None:
        self.sides = list(sides)

    def moved(self, tube: _Tube, off: Sequence[arb], local: Sequence[arb], rounded: Sequence[arb]) -> _Box:
        """The errors after the step; its start is ``off`` the midpoint, and its end ``rounded`` off the new one."""
        del local
        found = tube.end([bound(side + one) for side, one in zip(self.sides, off, strict=True)])
        return _Box([bound(one + off) for one, off in zip(found, rounded, strict=True)])


class _Parallelepiped:
    """Errors A b, |b| <= B in each component: A is exact, and about orthogonal (rule 14)."""

    def __init__(self, a: arb_mat, b: Sequence[arb]) -> None:
        self.a, self.b = a, list(b)
        self.sides = _times(_sizes(a), self.b)

    def moved(self, tube: _Tube, off: Sequence[arb], local: Sequence[arb], rounded: Sequence[arb]) -> _Parallelepiped:
        """The errors after the step, its own ``local`` ones among them."""
        boxed = _Box(self.sides).moved(tube, off, local, rounded)
        added = [bound(one + off) for one, off in zip(local, rounded, strict=True)]
        turned = tube.variation.derivative(tube.growth) * self.a
        q = _orthogonal(turned, self.b)
        back = q.inv()
        carried, begun = _times(_sizes(back * turned), self.b), _times(_sizes(back), added)
        turned_on = _Parallelepiped(q, [bound(one + other) for one, other in zip(carried, begun, strict=True)])
        if all(one < other for one, other in zip(boxed.sides, turned_on.sides, strict=True)):
            return _Parallelepiped(_unit(len(self.b)), boxed.sides)
        return turned_on


def _unit(size: int) -> arb_mat:
    """The unit matrix."""
    return arb_mat([[arb(int(i == j)) for j in range(size)] for i in range(size)])


def _orthogonal(matrix: arb_mat, lengths: Sequence[arb]) -> arb_mat:
    """Exact columns that are about orthonormal, the longest of the matrix's columns first; the unit matrix where they
    are beyond the range of doubles.
    """
    size = matrix.nrows()
    columns = np.array([float(one.mid()) for one in matrix.entries()]).reshape(size, size)
    norms = np.abs(columns).max(axis=0)
    if not (np.isfinite(norms).all() and norms.all()):
        return _unit(size)
    logs = [_log2(length) if length != 0 else -math.inf for length in lengths]
    order = np.argsort(-(np.log2(norms) + logs), kind="stable")
    return arb_mat(np.linalg.qr(columns[:, order] / norms[order])[0].tolist())


class _Variation:
    """df/dy about the polynomials of a step, read once in nodes of few bits; and the derivative of the step's map by
    its start, from the variational equation V' = h df/dy V (rule 13).
    """

    def __init__(self, equation: Equation) -> None:
        self._order = _order(VARIATIONAL_BITS)
        self._tape = Tape()
        self._size = size = len(equation.state_names)
        self._known: list[list[arb]] = []
        self._h = arb(0)
        with ctx.workprec(VARIATIONAL_BITS):
            duals: Any = DualArithmetic(ModelArithmetic(self._tape), size)  # type: ignore[arg-type]
            variables = [Variable(self._tape, lambda k, i=i: self._known[i][k]) for i in range(size + 1)]  # type: ignore[misc]
            state = [duals.variable(one, i) for i, one in enumerate(variables[:-1])]
            p = {name: BALL.number(value) for name, value in equation.parameters.items()}
            rates = equation.derivative(duals, variables[-1], state, p)
            zeros = (arb(0),) * size
            self._rows = [[_entry(one) for one in (rate.slopes if isinstance(rate, Dual) else zeros)] for rate in rates]
            values = [_entry(rate.value if isinstance(rate, Dual) else rate) for rate in rates]
        self._constants = [
            one for one in (*values, *(one for row in self._rows for one in row)) if isinstance(one, arb)
        ]
        self._tape.keep([*variables, *(one for row in (values, *self._rows) for one in row)])

    def follow(self, variables: Sequence[Variable], time: arb, h: arb) -> None:
        """Take the polynomials of a step, in fewer terms and bits.

        Raises:
            RefusedError: what is constant in the equation or its derivative is not finite.
        """
        if not all(one.is_finite() for one in self._constants):
            raise RefusedError("the equation or its derivative is not finite")
        order = min(self._order, len(variables[0].terms) - 1)
        with ctx.workprec(VARIATIONAL_BITS):
            self._known = [[(term * 1).mid() for term in one.terms[: order + 1]] for one in variables]
            missed = [one.polynomial - arb_poly(known) for one, known in zip(variables, self._known, strict=True)]
            self._cut = [supremum(one) for one in missed]
            clock = [(time * 1).mid(), (h * 1).mid()]
            self._cut.append(bound((time - clock[0]).abs_upper() + (h - clock[1]).abs_upper()))
            self._known.append([*clock, *[arb(0)] * order])
            self._h = h
            self._tape.begin()
            self._tape.fill(order)

    def close(self, room: Sequence[arb]) -> None:
        """Enclose f and df/dy at all that is within the room of the polynomials.

        Raises:
            RefusedError: they are not known to be finite there.
        """
        self._tape.close([bound(one + cut) for one, cut in zip((*room, arb(0)), self._cut, strict=True)])

    def slopes(self, s: arb) -> list[list[arb]]:
        """h df/dy there, on a part of the step."""
        return [
            [self._h * (one.polynomial(s) + arb(0, one.remainder) if isinstance(one, Node) else one) for one in row]
            for row in self._rows
        ]

    def derivative(self, growth: arb_mat) -> arb_mat:
        """What the derivative of the step's map lies in, at every start of which the solution is in the room."""
        found, size = self._columns(), range(self._size)
        columns = [[arb_poly(found[:, i, j].tolist()) for i in size] for j in size]
        defects = self._defects(columns)
        ends = []
        for j, column in enumerate(columns):
            off = _times(growth, [row[j] for row in defects])
            ends.append([one(arb(1)) + arb(0, error) for one, error in zip(column, off, strict=True)])
        return arb_mat([list(row) for row in zip(*ends, strict=True)])

    def _columns(self) -> np.ndarray:
        """The coefficients of V, about which nothing is claimed: (k + 1) V_{k+1} = h sum_i J_i V_{k-i}, in doubles."""
        size, terms = self._size, len(self._known[0])
        slopes = np.zeros((size, terms, size))
        for i, row in enumerate(self._rows):
            for j, one in enumerate(row):
                known = one.terms if isinstance(one, Node) else [one]
                slopes[i, : len(known), j] = [float(term) for term in known]
        flat = float(self._h) * slopes.reshape(size, -1)
        order = self._order_for(np.abs(flat[:, :size]).sum(axis=1).max())
        backward = np.zeros(((order + 1) * size, size))  # V_order, ..., V_0, one below the other
        backward[-size:] = np.eye(size)
        for k in range(order):
            at, used = (order - k) * size, min(k + 1, terms) * size
            backward[at - size : at] = flat[:, :used] @ backward[at : at + used] / (k + 1)
        return backward.reshape(order + 1, size, size)[::-1]

    def _order_for(self, stretch: float) -> int:
        """Terms of the exponential of a matrix of this norm, to VARIATIONAL_BITS."""
        order, size = self._order, math.log2(max(1.0, stretch))
        while order < MOST_TERMS and order * size - math.lgamma(order + 1) / math.log(2) > -VARIATIONAL_BITS:
            order += self._order // 4
        return order

    def _defects(self, columns: Sequence[Sequence[arb_poly]]) -> list[list[arb]]:
        """Bounds of |V' - h J V| on the step, entry by entry (rules 1, 2 and 9)."""
        h, norms = self._h, [[supremum(one) for one in column] for column in columns]
        found = []
        for i, row in enumerate(self._rows):
            known = [
                (j, one.polynomial, one.remainder) if isinstance(one, Node) else (j, arb_poly([one]), arb(0))
                for j, one in enumerate(row)
                if isinstance(one, Node) or not one.is_zero()
            ]
            bounds = []
            for column, sizes in zip(columns, norms, strict=True):
                turned = sum((slope * column[j] for j, slope, _ in known), arb_poly())
                off = supremum(column[i].derivative() - h * turned)
                missed = sum((remainder * sizes[j] for j, _, remainder in known), arb(0))
                bounds.append(bound(off + abs(h) * missed))
            found.append(bounds)
        return found


class FlowSolution:
    """The state of a problem by its proven flow, at the precision in force."""

    def __init__(self, problem: Any) -> None:
        self._problem = problem

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[arb, ...]]:
        """The state at each time.

        Raises:
            ValueError: the row is another one, of which a problem without a closed form has none.
            WorkBoundError: the work bound is met before a time; the sentence says up to which it is proven.
        """
        if row != "state":
            raise ValueError(f"{row} of {self._problem!r} has no closed form; its state is proven by its flow.")
        flow = proven(self._problem, ctx.prec, max(arguments, key=abs))
        try:
            found = [tuple(flow.at(time)) for time in arguments]
        except HorizonError as end:
            put_off(self._problem, end, flow.bits)
            return [(arb.nan(),) * len(self._problem.state_names)] * len(arguments)
        for sign in {-1 if time < 0 else 1 for time in arguments}:
            _note(flow, sign)
        return found


def put_off(asked: Any, end: HorizonError, bits: int) -> None:
    """Leave what is not proven in so many bits to more of them, unless fewer reached about as far.

    Raises:
        HorizonError: they did.
    """
    ends = _horizons(asked)
    known = [reached for fewer, reached in ends.items() if fewer < bits]
    if known and end.reached <= (1 + LITTLE) * max(known):
        raise end
    ends[bits] = end.reached


def proven(equation: Any, bits: int, time: Fraction = Fraction(0)) -> ProvenFlow:
    """The flow of an equation at a working precision of at least so many bits, kept for a while.

    It goes on from where it is; one of more bits that is at the time already is as good.
    """
    flows = _flows(equation)
    able = [known for known in flows if known >= bits and flows[known].reaches(time)]
    shared = min(able, default=max(LEAST_BITS, BITS_APART * -(-bits // BITS_APART)))
    if shared not in flows:
        for known in list(flows)[: len(flows) - KEPT + 1]:
            del flows[known]
        flows[shared] = ProvenFlow(equation, shared, STEPS)
    return flows[shared]


@lru_cache(maxsize=KEPT)
def _flows(equation: Any) -> dict[int, ProvenFlow]:
    """The flows of an equation that are kept, by their bits."""
    del equation
    return {}


@lru_cache(maxsize=1024)
def _horizons(asked: Any) -> dict[int, Fraction]:
    """How far something was proven at which precision, where that was the end."""
    del asked
    return {}


@lru_cache(maxsize=1024)
def _losses(equation: Any) -> dict[int, tuple[Fraction, float]]:
    """How far each side of an equation was proven, and how many bits were lost there."""
    del equation
    return {}


def lost(equation: Any, time: Fraction) -> int:
    """Bits that the proof loses up to a time, about, told by what it lost so far; 0 where it has not begun."""
    reached, bits = _losses(equation).get(-1 if time < 0 else 1, (Fraction(0), 0.0))
    return math.ceil(bits * max(1.0, float(abs(time) / reached))) if reached else 0


def see(equation: Any, time: Fraction, bits: int) -> None:
    """Prove a flow to a time in so many bits, as far as these reach, where it was not: what it loses is then known."""
    sign = -1 if time < 0 else 1
    if _losses(equation).get(sign, (Fraction(0), 0.0))[0] < abs(time):
        flow = proven(equation, bits, time)
        with suppress(WorkBoundError):
            flow.at(time)
        _note(flow, sign)


def _note(flow: ProvenFlow, sign: int) -> None:
    reached, bits = flow.lost(sign)
    equation: Any = flow.equation
    known = _losses(equation)
    if reached and reached >= known.get(sign, (Fraction(0), 0.0))[0]:
        known[sign] = reached, bits
