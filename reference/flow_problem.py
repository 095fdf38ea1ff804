"""A problem that is its equation and its start: its state is proven by its flow.

    class VanDerPol(FlowProblem):
        name = "van-der-pol"
        space = StateSpace(positions=("x",), velocities=("v",), ...)
        numbers = {"mu": "1"}
        begins = ("2", "0")
        equation = "x'' = mu (1 - x^2) x' - x"
        invariants, t_end = (), 20
        source, difficulty = "...", "average: ..."

        def derivative(self, m, t, y, p): ...

    FAMILY = flow_family(VanDerPol, "van der Pol's oscillator")  # of reference.flow_families

Its numbers are decimals, and its start formulas of them: exact, until an arithmetic reads them.

A problem that declares ``event(m, y)`` has the row ``zero_crossing``, the times at which that crosses zero; and each
has a row ``sensitivity_<input>`` for each of its inputs, the derivatives of its state by it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.formula import Expression
from reference.arithmetic.limbs import ziv
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import ctx, mp
from reference.arithmetic.rational import RATIONAL, IrrationalError, rational_root
from reference.declaration import Quantity, Row, Trial
from reference.names import unknown
from reference.problem import APART, HamiltonianProblem, Problem, required
from reference.routes import quadrature
from reference.routes.flow_events import crossing_times, crossings
from reference.routes.proven_flow import LEAST_BITS, FlowSolution, lost, see
from reference.routes.sensitivity import Sensitivity, Variations, known_sensitivity
from reference.routes.taylor import Along, Passages
from reference.routes.transition import TransitionSolution, frobenius
from reference.routes.working_bits import FlowReading
from reference.row_domains import INDEX, TIME, Whole

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from flint import arb

    from reference.declaration import Solution
    from reference.routes.taylor import Reading, TaylorRoute

__all__ = [
    "CONDITION",
    "CONSERVED",
    "CROSSINGS",
    "END",
    "FlowProblem",
    "HamiltonianFlow",
    "has_event",
    "is_rational",
    "start_formulas",
]

CROSSINGS, CONSERVED, END = "zero_crossing", "conserved", "end"
"""The rows of crossings, of what is conserved and of the ends."""
CONDITION, SENSITIVITY = "condition", "sensitivity_"
"""The row of condition numbers, and how those of derivatives begin."""
CONDITIONED = 8
"""A state of more components has none: it would take the square of their number."""
MULTIPLE = Whole("multiple", "multiple")
"""Of the end, which is an exact decimal."""
TRANSITION_BITS = 12
"""What condition numbers lose beside what the state does: bits of products of matrices."""
COUNT_BITS = 1 << 12
"""A crossing that so many bits do not tell from the end of the time in which they are counted is at that end."""
VARIED = Fraction(1, 4)
"""Many condition numbers are held against variations up to this part of a march."""
KNOWN_BITS = 100
"""So many more bits than it is held against does the state take that mathematics knows."""
READ_BITS = 20
"""And the proven state of which invariants are read."""
START_BITS = 4096
"""An irrational start is told to so many bits where a number is asked for: beyond those of any format."""
AROUND = Fraction(1, 16)
"""A compiled step is tried so far about the start, in parts of its size, and of the numbers."""


@dataclass(frozen=True, init=False, repr=False)
class FlowProblem(Problem):
    """An equation with named numbers and a start, each of which may be another than the declared one.

    Args:
        given: numbers and components of the start by name; the others are as declared.

    Raises:
        ValueError: a name is unknown, or a value is not finite.
        TypeError: a value is no real number.
    """

    numbers: ClassVar[Mapping[str, str]] = required("its numbers by name, as decimals or fractions")
    begins: ClassVar[tuple[str, ...]] = required("its start, a formula of its numbers for each component")
    t_end: ClassVar[str | float] = required("where a march ends, as the literature has it")
    source: ClassVar[str] = required("where it is published")
    difficulty: ClassVar[str] = required("how hard it is on an integrator: lower, average or higher, and why")
    until: ClassVar[str] = ""
    """Until when a dataset has it; of itself where a march ends."""
    variants: ClassVar[tuple[Mapping[str, str], ...]] = ()
    """Other inputs of which a dataset has a group each, such as other energies."""
    crossings: ClassVar[int] = 0
    """How many crossings a dataset has."""
    known_for: ClassVar[tuple[str, ...]] = ()
    """Inputs of which ``known_state`` takes any; of the others the declared ones."""
    meanings: ClassVar[Mapping[str, str]] = {}
    """What numbers and components are, in words; where there are none, their names."""
    units: ClassVar[Mapping[str, str]] = {}
    """Units of components that are no pure numbers."""

    given: tuple[tuple[str, Fraction], ...]

    def __init__(self, **given: Any) -> None:
        accepted = self.input_names()
        for name in given:
            if name not in accepted:
                raise ValueError(unknown(f"the input of {self.name},", name, accepted))
        known = [(name, exact(given[name], name)) for name in accepted if name in given]
        object.__setattr__(self, "given", tuple(known))

    @classmethod
    def input_names(cls) -> tuple[str, ...]:
        """The numbers, then the components of the start."""
        return *cls.numbers, *cls.space.components

    @property
    def kind(self) -> Any:
        """Its class, which declares it."""
        return type(self)

    def __repr__(self) -> str:
        told = ", ".join(f"{name}={as_number(value)!r}" for name, value in self.given)
        return f"{type(self).__name__}({told})"

    @property
    def rows(self) -> tuple[Row, ...]:  # type: ignore[override]
        """The state, its derivatives by each input, and the crossings where there is an event."""
        return _rows(self.kind)

    @property
    def by_flow(self) -> Mapping[str, Reading]:  # type: ignore[override]
        """The state along the flow and at its ends, its derivatives by the variations, its crossings at its events.

        What is conserved is read of the state where a march ends.
        """
        found: dict[str, Reading] = {"state": Along(), CROSSINGS: Passages(), END: _ends, CONSERVED: _at_the_end}
        found[CONDITION] = Along(_condition, by=self.space.components)
        return {**found, **{SENSITIVITY + name: Variations(input=name) for name in self.input_names()}}

    @property
    def trial(self) -> Trial:  # type: ignore[override]
        """About the start."""
        return _trial(self)

    @property
    def parameters(self) -> dict[str, Fraction]:
        given = dict(self.given)
        return {name: given.get(name, exact(text, name)) for name, text in self.numbers.items()}

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        """What is other than declared; where nothing is, the first number or component."""
        first = self.input_names()[0]
        told = dict(self.given) or {
            first: dict(zip(self.space.components, self.start, strict=True), **self.parameters)[first]
        }
        return {name: (float(value), self.units.get(name, "")) for name, value in told.items()}

    def start_in(self, m: Any) -> list[Any]:
        """The start in an arithmetic: what is given, and the formulas of the others."""
        given, p = dict(self.given), self.parameters_in(m)
        formulas = start_formulas(self.kind)
        return [m.number(given[name]) if name in given else formulas[name](m, p) for name in self.space.components]

    def start_slopes(self, m: Any, by: str, place: int | None = None) -> list[Any]:
        """The derivatives of the start by an input, in an arithmetic: of each component, or of the one of a place."""
        given, duals, formulas = dict(self.given), DualArithmetic(m, 1), start_formulas(self.kind)
        p = self.parameters_in(m)
        if by in p:
            p[by] = duals.variable(p[by], 0)
        names = self.space.components

        def slope(name: str) -> Any:
            if name == by or name in given or by not in p:
                return m.number(Fraction(int(name == by)))
            found = formulas[name](duals, p)
            return found.slopes[0] if isinstance(found, Dual) else m.number(Fraction(0))

        return [slope(name) for name in (names if place is None else names[place : place + 1])]

    def known_state(self, t: Any) -> Sequence[Any]:
        """The state at a time where mathematics knows it, in mpmath's numbers: a third route, which proves nothing."""
        raise NotImplementedError

    @property
    def end(self) -> Fraction:
        """Where a march ends, exactly."""
        return exact(self.t_end, "t_end")

    def conserved(self, index: int, m: Any, state: Sequence[Any]) -> Any:
        """An invariant of a state, in an arithmetic."""
        return getattr(self, self.invariants[index].value)(m, state, self.parameters_in(m))

    def sensitivity(self, by: str) -> Sensitivity:
        """The equation of the state and of its derivatives by an input.

        Raises:
            ValueError: there is no such input.
        """
        if by not in self.input_names():
            raise ValueError(unknown(f"the input of {self.name},", by, self.input_names()))
        return Sensitivity(self, by)

    def passages(self, until: float) -> tuple[str, int] | None:
        """The crossings of its event."""
        if not has_event(self.kind):
            return None
        end = exact(until, "until")
        return CROSSINGS, _counted(self, end) if end > 0 else 0

    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None:
        if route != "quadrature" or route in dict(self.row(row).lacks):
            return super().by_route(route, row, arguments, digits)
        if is_known(self.kind) and not {name for name, _ in self.given}.issubset(self.known_for):
            return None
        arguments, bits = self.arguments(row, arguments), int(digits * 3.33)
        return quadrature.rows(lambda: _Known(self, bits), row, arguments, bits + KNOWN_BITS)

    def enclosure_form(self) -> Solution:
        """The proven flow, with its crossings and its derivatives."""
        return _FlowRows(self)

    def flow_reading(self, row: str, arguments: Sequence[Any], component: int | None = None) -> FlowReading:
        """As ever; ends at their times, what is conserved at the end, derivatives of a flow of their own."""
        if row == END:
            return super().flow_reading("state", [multiple * self.end for multiple in arguments], component)
        if row == CONSERVED:
            return FlowReading(self, [self.end], lambda _, state: self._invariants(arguments, state), proves=False)
        if row == CROSSINGS:
            return FlowReading(self, [], until=self.end)
        if row == CONDITION:
            return FlowReading(self, arguments, beside=TRANSITION_BITS)
        if not row.startswith(SENSITIVITY):
            return super().flow_reading(row, arguments, component)
        slopes = self.undecided(row, component, len(self.state_names))
        return FlowReading(self.sensitivity(row.removeprefix(SENSITIVITY)), arguments, slopes)

    def _invariants(self, indices: Sequence[int], state: Sequence[arb]) -> list[arb]:
        return [BALL.number(Fraction(0)) + self.conserved(index, BALL, state) for index in indices]

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """As ever; of many condition numbers those of the first times, since variations take longer than the proof."""
        if row == CONDITION and len(arguments) > 1 and max(arguments) > VARIED * self.end:
            return False
        return super().within_taylor(row, arguments)

    @property
    def start(self) -> tuple[Fraction, ...]:
        """The start; a component that is irrational to START_BITS bits."""
        return _start(self)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The start and its derivatives, where they are rational, and derivatives that never change."""
        if row == END:
            return self.exact_row("state", argument * self.end)
        if row == CONSERVED:
            return (self.exact_invariant(self.invariants[argument].value),)
        if row == "state" and argument == 0:
            return _rational(self)
        if row == CONDITION and argument == 0:
            return (rational_root(Fraction(len(self.state_names))),)
        if row.startswith(SENSITIVITY):
            return known_sensitivity(self, row.removeprefix(SENSITIVITY), argument)
        return None

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> FlowProblem:
        """From a start of which the first component that is not zero is smaller by 2^-36, or by 16 roundings."""
        for name, value in zip(self.space.components, self.start, strict=True):
            if value:
                return type(self)(**{**dict(self.given), name: rounding(value * (1 - max(APART, 16 * epsilon)))})
        name = self.space.components[0]
        return type(self)(**{**dict(self.given), name: rounding(max(APART, 16 * epsilon))})


class HamiltonianFlow(FlowProblem, HamiltonianProblem):
    """The same, of a Hamiltonian."""


class _FlowRows(FlowSolution):
    """The rows of a problem by proven flows, at the precision in force."""

    def __init__(self, problem: FlowProblem) -> None:
        super().__init__(problem)
        self._flow_problem = problem

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[arb, ...]]:
        problem = self._flow_problem
        if row == CROSSINGS:
            return crossing_times(problem, arguments)
        if row == END:
            return super().rows("state", [multiple * problem.end for multiple in arguments])
        if row == CONSERVED:
            start = problem.start_in(BALL)
            return [(BALL.number(Fraction(0)) + problem.conserved(index, BALL, start),) for index in arguments]
        if row == CONDITION:
            return [(frobenius(BALL, values),) for values in TransitionSolution(problem).rows("state", arguments)]
        if row.startswith(SENSITIVITY):
            flow, size = FlowSolution(problem.sensitivity(row.removeprefix(SENSITIVITY))), len(problem.state_names)
            return [values[size:] for values in flow.rows("state", arguments)]
        return super().rows(row, arguments)


class _Known:
    """The rows of a problem by the state that mathematics knows; what is conserved of any, by its proven state."""

    def __init__(self, problem: FlowProblem, bits: int) -> None:
        self._problem, self._bits = problem, bits

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        problem = self._problem
        if row == "state":
            return [tuple(problem.known_state(MPMATH.number(time))) for time in arguments]
        if row == END:
            return self.rows("state", [multiple * problem.end for multiple in arguments])
        if is_known(problem.kind):
            state = problem.known_state(MPMATH.number(problem.end))
            return [(problem.conserved(index, MPMATH, state),) for index in arguments]
        bits = self._bits + READ_BITS
        see(problem, problem.end, lambda: bits)
        bits += problem.flow_reading(row, arguments).seen(1) or lost(problem, problem.end)
        with ctx.workprec(bits):
            (balls,) = FlowSolution(problem).rows("state", [problem.end])
            found = [one.mid() for one in problem._invariants(arguments, balls)]  # noqa: SLF001 - of the same module
        return [(mp.ldexp(mp.mpf(int(mantissa)), int(e)),) for mantissa, e in (one.man_exp() for one in found)]


def is_known(kind: Any) -> bool:
    """Whether mathematics knows the state of a class of problems."""
    return kind.known_state is not FlowProblem.known_state


def _ends(route: TaylorRoute, row: str, arguments: Sequence[int]) -> Sequence[Any]:
    """The states at multiples of the end."""
    del row
    return route.states([multiple * route.problem.end for multiple in arguments])


def _condition(route: TaylorRoute, state: Sequence[Any]) -> Any:
    """The condition number, of the variations."""
    return frobenius(route.m, state[len(route.problem.state_names) :])


def _at_the_end(route: TaylorRoute, row: str, arguments: Sequence[int]) -> Sequence[Any]:
    """What is conserved, where a march ends."""
    del row
    (state,) = route.states([route.problem.end])
    numbers = [route.m.number(value) for value in state]
    return [(route.problem.conserved(index, route.m, numbers),) for index in arguments]


def has_event(kind: Any) -> bool:
    """Whether a class of problems declares an event."""
    return kind.event is not Problem.event


def _counted(problem: FlowProblem, until: Fraction) -> int:
    """How many crossings there are in (0, until].

    Raises:
        WorkBoundError: they are not proven, or one is at the end itself.
    """

    def counted(_rows: Sequence[int]) -> list[list[arb]]:
        count = crossings(problem, ctx.prec).count(until)
        return [[BALL.number(Fraction(count)) if count is not None else BALL.number(Fraction(0)) / 0]]

    bits = LEAST_BITS + lost(problem, until)
    what = f"the number of crossings of {problem!r} up to t = {as_number(until)}"
    found = ziv(counted, lambda ball: ball if ball.is_finite() else None, 1, bits, what, COUNT_BITS)
    return int(found[0][0].unique_fmpz())


@lru_cache(maxsize=256)
def _rows(kind: Any) -> tuple[Row, ...]:
    names, lacks = kind.space.components, (("quadrature", "there is no closed form"),)
    quantities = {
        name: Quantity(name, kind.units.get(name, "1"), kind.meanings.get(name, name), str(kind.equation))
        for name in names
    }
    states: tuple[tuple[str, str], ...] = () if is_known(kind) else lacks
    found = [Row("state", tuple(quantities.values()), TIME, lacks=states)]
    ends = tuple(
        replace(one, name=f"{name}_{END}", long_name=f"{one.long_name} at multiples of the end of the march")
        for name, one in quantities.items()
    )
    found.append(Row(END, ends, MULTIPLE, lacks=states))
    if kind.invariants:
        what = "invariants of the motion, at its start"
        conserved = Quantity(CONSERVED, "1", what, f"what does not change along it; {kind.equation}")
        domain = Whole("invariant", "invariant", len(kind.invariants) - 1)
        found.append(Row(CONSERVED, (conserved,), domain))
    if len(names) <= CONDITIONED:
        growth = Quantity(
            CONDITION,
            "1",
            "condition number: growth of errors of the start",
            f"Frobenius norm of the derivatives of the state by its start at fixed t; {kind.equation}",
        )
        found.append(Row(CONDITION, (growth,), TIME, lacks=lacks))
    if has_event(kind):
        crossing = Quantity(
            CROSSINGS,
            kind.space.independent or "1",
            f"times of the {kind.event_words}",
            f"t[j], the (j + 1)-th t > 0 of the {kind.event_words}, j = 0, 1, ...; {kind.equation}",
        )
        found.append(Row(CROSSINGS, (crossing,), INDEX, lacks=lacks))
    for by in kind.input_names():
        which = f"the start of {by}" if by in names else by
        slopes = tuple(
            Quantity(
                f"d{name}_d{by}",
                _quotient(one.units, kind.units.get(by, "1")),
                f"sensitivity of {name} to {which}",
                f"d({name})/d({which}) at fixed t; {kind.equation}",
            )
            for name, one in quantities.items()
        )
        found.append(Row(f"{SENSITIVITY}{by}", slopes, TIME, lacks=lacks))
    return tuple(found)


def _quotient(above: str, below: str) -> str:
    """Units over units, such as "m" over "s2" as "m s-2"."""
    powers: dict[str, int] = {}
    for units, sign in ((above, 1), (below, -1)):
        for word in units.split():
            unit = word.rstrip("-0123456789")
            if unit:
                powers[unit] = powers.get(unit, 0) + sign * int(word[len(unit) :] or 1)
    told = (unit if power == 1 else f"{unit}{power}" for unit, power in powers.items() if power)
    return " ".join(told) or "1"


@lru_cache(maxsize=256)
def start_formulas(kind: Any) -> dict[str, Expression]:
    """The formula of each component of the start.

    Raises:
        ValueError: one is no formula of the numbers.
    """
    names = tuple(kind.numbers)
    return {
        name: Expression.parse(text, names, f"the start of {name}")
        for name, text in zip(kind.space.components, kind.begins, strict=True)
    }


@lru_cache(maxsize=256)
def _rational(problem: FlowProblem) -> tuple[Fraction | None, ...]:
    """The start, None for what is not known to be rational."""
    given, formulas = dict(problem.given), start_formulas(problem.kind)
    found: list[Fraction | None] = []
    for name in problem.space.components:
        try:
            found.append(given[name] if name in given else Fraction(formulas[name](RATIONAL, problem.parameters)))
        except IrrationalError:
            found.append(None)
    return tuple(found)


def is_rational(problem: FlowProblem, name: str) -> bool:
    """Whether an input is a rational number, exactly."""
    known = dict(zip(problem.space.components, _rational(problem), strict=True))
    return name in problem.numbers or known[name] is not None


@lru_cache(maxsize=256)
def _start(problem: FlowProblem) -> tuple[Fraction, ...]:
    with ctx.workprec(START_BITS):
        balls = problem.start_in(BALL)
        told = [
            mantissa * Fraction(2) ** int(e)
            for mantissa, e in ((int(m), e) for m, e in (b.mid().man_exp() for b in balls))
        ]
    return tuple(near if known is None else known for near, known in zip(told, _rational(problem), strict=True))


@lru_cache(maxsize=256)
def _trial(problem: FlowProblem) -> Trial:
    size = max((abs(value) for value in problem.start), default=Fraction(0)) or Fraction(1)

    def around(value: Fraction, least: Fraction) -> tuple[float, float]:
        room = max(abs(value), least) * AROUND
        return float(value - room), float(value + room)

    parameters = {name: around(value, Fraction(1)) for name, value in problem.parameters.items()}
    return Trial(
        states=tuple(around(value, size) for value in problem.start), parameters=parameters, step=(0.001, 0.01)
    )
