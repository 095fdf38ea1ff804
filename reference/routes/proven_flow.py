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

from flint import arb, arb_mat, arb_poly

from reference.arithmetic.balls import BALL
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.models import (
    BOUND_BITS,
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
from reference.routes.variation import (
    PARTS,
    Variation,
    entry,
    grown,
    larger,
    log2,
    order_of,
    orthogonal,
    part,
    sizes,
    times,
    unit,
    upper,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.declaration import Equation

__all__ = [
    "KEPT",
    "FlowSolution",
    "HorizonError",
    "Piece",
    "ProvenFlow",
    "lost",
    "lost_in",
    "prove",
    "proven",
    "put_off",
    "see",
]

STEPS = 1 << 15
"""Steps that are granted to a flow."""
WATCHED, LENIENT = 64, 2
"""After so many steps it is seen whether the rest will do, were steps so many times as long from there on."""
LITTLE = Fraction(1, 16)
"""A horizon that more bits extend by no more than that part is one of the equation, and not of the precision."""
KEPT = 3
"""Equations whose flows are kept with their pieces, and flows of each, of other precisions."""
LEAST_BITS, BITS_APART = 96, 16
"""Working precisions of flows: at least so many bits, and multiples of so many."""
TRIES = 40
"""So often a step is halved before it is given up."""
STEP_BITS = 8
"""Bits of a step's length: times are exact."""
SPARE = 10
"""A step whose own error comes to more than 2^SPARE roundings is halved, as long as that makes it smaller."""
GAIN = 8
"""Bits that halving a step has to gain."""
TELLING = 32
"""After so many steps what is lost in a flow tells what will be."""
FARTHEST = 16
"""So many times as far, and no farther."""
SMALLER = 16
"""What a value of which not a bit is known is taken to lack beyond all bits of its flow."""
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

    def go(self, time: Fraction, until: Fraction) -> None:
        """Go on to a time, on the way to another one.

        Raises:
            WorkBoundError: the work bound is met before, or seen to be before the other one.
        """
        self._side(-1 if time < 0 else 1).place(time, until)

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

    def place(self, time: Fraction) -> int:
        """Which of the pieces of its side a time is on.

        Raises:
            WorkBoundError: the work bound is met before.
        """
        return self._side(-1 if time < 0 else 1).place(time)

    def pieces(self, sign: int) -> Sequence[Piece]:
        """What is proven so far of one side, in order."""
        return self._side(sign).pieces

    def lost(self, sign: int) -> tuple[Fraction, float]:
        """How far one side is proven, and how many bits are lost there, of the largest component."""
        side = self._side(sign)
        return abs(side.reached), self._lost(side.middle, side.errors.sides)

    def lost_at(self, time: Fraction) -> float:
        """How many bits are lost at a time that is proven, of the largest component."""
        state = self.at(time)
        return self._lost([ball.mid() for ball in state], [ball.rad() for ball in state])

    def _lost(self, state: Sequence[arb], errors: Sequence[arb]) -> float:
        largest = max((log2(value) for value in state if value != 0), default=0.0)
        error = max((log2(value) for value in errors if value != 0), default=-math.inf)
        return max(0.0, error + self.bits - largest)


class _Side:
    """The flow on one side of the start: its pieces in order."""

    def __init__(self, equation: Equation, bits: int, sign: int, steps: int) -> None:
        self.equation, self.bits, self.sign, self.most = equation, bits, sign, steps
        self.pieces: list[Piece] = []
        self._ends: list[Fraction] = []
        self.reached = Fraction(0)
        self._usual: float = SPARE
        self.order = order_of(bits)
        with ctx.workprec(bits):
            start = equation.start_in(BALL)
            sides = [bound(value.rad()) for value in start]
            self.middle = [value.mid() for value in start]
            self._reading = _Reading(equation)
        self._variation = Variation(equation)
        self.errors: _Box | _Parallelepiped = _Box(sides)
        if len(start) <= SIDES:
            self.errors = _Parallelepiped(unit(len(start)), sides)

    def piece(self, time: Fraction) -> Piece:
        """The piece on which a time lies."""
        return self.pieces[self.place(time)]

    def place(self, time: Fraction, until: Fraction = Fraction(0)) -> int:
        """Which of the pieces that is; as many steps are granted as lead on to another time, if it is later."""
        with ctx.workprec(self.bits):
            while not self.pieces or abs(time) > abs(self.reached):
                self._require_granted(max(abs(time), abs(until)))
                self._advance()
        place = bisect_right(self._ends, abs(time)) if time != self.reached else len(self.pieces) - 1
        return min(place, len(self.pieces) - 1)

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
        return log2(error) + self.bits - log2(unit) if unit != 0 else math.inf


def _exact(value: Fraction) -> arb:
    """A number whose denominator is a power of two, exactly."""
    exponent = value.denominator.bit_length() - 1
    return arb((value.numerator, -exponent))


def _length(variables: Sequence[Variable], bits: int) -> Fraction:
    """A step after which the last terms are below the last bit of their component; a guess, which the defect judges."""
    order = len(variables[0].terms) - 1
    sizes = [log2(one.terms[0]) if one.terms[0] != 0 else -math.inf for one in variables]
    largest = max(sizes) if max(sizes) > -math.inf else math.inf  # at a start of zeros nothing is known of the sizes
    found = []
    for one in variables:
        known = [(k, log2(one.terms[k])) for k in range(order - 3, order + 1) if one.terms[k] != 0]
        first = next((log2(term) for term in one.terms if term != 0), -math.inf)
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
        self.rates = [entry(rate) for rate in rates]
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
        variation: Variation,
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
        variation.follow([one.polynomial for one in variables], time, step)
        for _ in range(4):
            variation.close(room)
            self._slopes = [variation.slopes(part(j)) for j in range(PARTS)]
            self.growth = grown(self._slopes)
            self.errors = times(self.growth, driven)
            if all(error < one for error, one in zip(self.errors, room, strict=True)):
                return
            room = [bound(4 * larger(error, one)) for error, one in zip(self.errors, room, strict=True)]
        raise RefusedError("no room around the step is enough")

    def end(self, sides: Sequence[arb]) -> list[arb]:
        """A bound of the errors at the end of the step from those at its start (rule 11)."""
        found = list(sides)
        for factor in self._ends:
            found = times(factor, [*found, self._largest])[:-1]
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
            found.append(upper(arb_mat([*rows, [arb(0)] * (len(driven) + 1)]).exp()))
        return found


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
        self.sides = times(sizes(a), self.b)

    def moved(self, tube: _Tube, off: Sequence[arb], local: Sequence[arb], rounded: Sequence[arb]) -> _Parallelepiped:
        """The errors after the step, its own ``local`` ones among them."""
        boxed = _Box(self.sides).moved(tube, off, local, rounded)
        added = [bound(one + off) for one, off in zip(local, rounded, strict=True)]
        turned = tube.variation.derivative(tube.growth) * self.a
        q = orthogonal(turned, self.b)
        back = q.inv()
        carried, begun = times(sizes(back * turned), self.b), times(sizes(back), added)
        turned_on = _Parallelepiped(q, [bound(one + other) for one, other in zip(carried, begun, strict=True)])
        if all(one < other for one, other in zip(boxed.sides, turned_on.sides, strict=True)):
            return _Parallelepiped(unit(len(self.b)), boxed.sides)
        return turned_on


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
            found = [self.read(flow, time) for time in arguments]
        except HorizonError as end:
            put_off(self._problem, end, flow.bits)
            return [self.unread()] * len(arguments)
        for sign in {-1 if time < 0 else 1 for time in arguments}:
            _note(flow, sign)
        return found

    def read(self, flow: ProvenFlow, time: Fraction) -> tuple[arb, ...]:
        """What is read of a flow at a time."""
        return tuple(flow.at(time))

    def unread(self) -> tuple[arb, ...]:
        """As many balls that hold every number."""
        return (arb.nan(),) * len(self._problem.state_names)


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
def _losses(equation: Any) -> dict[int, _Loss]:
    """What each side of an equation lost, as far as it was proven."""
    del equation
    return {}


@dataclass(frozen=True)
class _Loss:
    """Bits that a side of a flow lost, of the largest component, as far as it was proven and half way."""

    reached: Fraction
    steps: int
    bits: float
    half: float

    def at(self, time: Fraction) -> float:
        """Those lost at a time, and beyond what was proven as they grew in its second half, were these steps many."""
        ratio = min(abs(time) / self.reached, Fraction(FARTHEST)) if self.steps >= TELLING else Fraction(1)
        further = max(0.0, float(ratio) - 1)
        return self.bits + 2 * further * max(0.0, self.bits - self.half)


def lost(equation: Any, time: Fraction) -> int:
    """Bits that the proof loses up to a time, about, told by what it lost so far; 0 where it has not begun."""
    known = _losses(equation).get(-1 if time < 0 else 1)
    return math.ceil(known.at(time)) if known else 0


def lost_in(
    equation: Any, times: Sequence[Fraction], values: Callable[[Fraction, list[arb]], Sequence[arb]]
) -> int | None:
    """Bits that values, read of the states at some times, lack, by the best flow that is kept and proven so far.

    None where there is none.  Of a ball with zero in it only a flow of the fewest bits says more than nothing: there it
    is taken to lack some bits beyond all of these.
    """
    flows = [flow for flow in _flows(equation).values() if flow.reaches(max(times)) and flow.reaches(min(times))]
    if not flows:
        return None
    flow, found = max(flows, key=lambda flow: flow.bits), list[int]()
    with ctx.workprec(flow.bits):
        for time in times:
            for ball in values(time, flow.at(time)):
                accurate = min(int(ball.rel_accuracy_bits()), flow.bits)
                if accurate > 0:
                    found.append(flow.bits - accurate)
                elif flow.bits <= LEAST_BITS:
                    found.append(flow.bits + SMALLER + min(-accurate, SMALLER))
    return max(found, default=None)


def see(equation: Any, time: Fraction, bits: Callable[[], int], until: Fraction | None = None) -> None:
    """Prove a flow to a time, where it was not, in so many bits, as far as these reach: what it loses is then known.

    Raises:
        WorkBoundError: to this time, or ``until`` another one, it takes more steps than are granted.
    """
    known = _losses(equation).get(-1 if time < 0 else 1)
    if known is None or known.reached < abs(time):
        prove(equation, time, bits(), until)


def prove(equation: Any, time: Fraction, bits: int, until: Fraction | None = None) -> None:
    """Prove a flow to a time in so many bits, as far as these reach: what is asked of it later is there then.

    Raises:
        WorkBoundError: to this time, or ``until`` another one, it takes more steps than are granted.
    """
    flow = proven(equation, bits, time)
    with suppress(HorizonError):
        flow.go(time, time if until is None else until)
    _note(flow, -1 if time < 0 else 1)


def _note(flow: ProvenFlow, sign: int) -> None:
    reached, bits = flow.lost(sign)
    equation: Any = flow.equation
    known = _losses(equation)
    if reached and (sign not in known or reached >= known[sign].reached):
        known[sign] = _Loss(reached, len(flow.pieces(sign)), bits, flow.lost_at(sign * reached / 2))
