"""What a problem is: frozen data, its equations, and the values that can be asked of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import wraps
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.exact import exact_array, positive
from reference.arithmetic.limbs import MAX_BITS, MAX_LIMBS, to_limbs
from reference.arithmetic.namespaces import BALL, MPMATH, NUMPY, Heyoka
from reference.arithmetic.precision import mp
from reference.arithmetic.rational import RATIONAL, IrrationalError
from reference.arithmetic.surds import SURD, known, surd
from reference.certified import Certified
from reference.names import unknown
from reference.once import cached_property
from reference.routes import enclosure, proven_flow, quadrature, taylor
from reference.routes.working_bits import FlowReading, OfClosedForm, OfFlow

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy as np
    from flint import arb

    from reference.arithmetic.protocols import Arithmetic
    from reference.constants import Constant
    from reference.declaration import ClosedForm, Form, Invariant, Row, Solution, StateSpace, Trial, WorkingBits
    from reference.input_condition import InputCondition
    from reference.orbits import Orbits
    from reference.row_domains import Domain
    from reference.state_bounds import StateBounds

__all__ = ["APART", "NO_TIME", "HamiltonianProblem", "Problem", "SeparableProblem", "UndeclaredError"]

TAYLOR_BITS = 1024
"""The Taylor route serves what needs at most this working precision."""
APART = Fraction(1, 1 << 36)
"""By such a part a neighbour begins elsewhere: far enough for other roundings, too near for other truncation errors."""
SEEN, STATES = 10, 16
"""Of a motion without a period so many turns or e-foldings of its start, and so many states, are looked at."""
ROUTE_BITS = 8192
"""No route but the enclosure serves what needs more working precision than this."""


class _NoTime:
    """What stands for the time in an equation that is without it.

    Raises:
        ValueError: it is made use of.
    """

    def _used(self, *_others: Any) -> Any:
        raise ValueError("the equation depends on the time; a problem that declares autonomous = False is accepted.")

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __pow__ = _used
    __neg__ = __float__ = __array__ = _used


NO_TIME = _NoTime()


class UndeclaredError(NotImplementedError, AttributeError):
    """Something is asked of a problem that it does not declare; the sentence names both."""

    @classmethod
    def of(cls, problem: type, lacking: str, words: str) -> UndeclaredError:
        """The error of a class of problems that lacks what has this name, and what that is, in words."""
        name = next((vars(one)["name"] for one in problem.__mro__ if "name" in vars(one)), None)
        told = f", the problem '{name}'," if isinstance(name, str) else ""
        return cls(f"{problem.__name__}{told} does not declare '{lacking}'{': ' * bool(words)}{words}.")


class Required:
    """In the place of a class variable without which a problem is none; it says in words what that is."""

    def __init__(self, words: str) -> None:
        self._words, self._name = words, ""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, problem: Any, owner: type) -> Any:
        raise UndeclaredError.of(owner, self._name, self._words)


def required(words: str) -> Any:
    """A class variable that each problem declares."""
    return Required(words)


Method = TypeVar("Method", bound="Callable[..., Any]")


def declared(method: Method) -> Method:
    """A method that each problem declares of which it is asked: this one says so, by its name and its first line."""

    @wraps(method)
    def lacking(problem: Any, *_arguments: Any, **_named: Any) -> Any:
        words = (method.__doc__ or "").partition("\n")[0].rstrip(".").replace("``", "")
        of = problem if isinstance(problem, type) else type(problem)
        raise UndeclaredError.of(of, method.__name__, words[:1].lower() + words[1:])

    return lacking  # type: ignore[return-value]


@dataclass(frozen=True)
class Problem:
    """A system of ordinary differential equations with exact parameters and a proven solution."""

    name: ClassVar[str] = required("what it is called")
    rows: ClassVar[tuple[Row, ...]] = required("the rows of values that can be asked of it")
    space: ClassVar[StateSpace] = required("how its state is read")
    invariants: ClassVar[tuple[Invariant, ...]] = required("what every exact motion conserves, () where it is nothing")
    trial: ClassVar[Trial] = required("where a compiled step is tried")
    form: ClassVar[Form | None] = None
    """Which form of its family's equations this is; None where there is one."""
    by_flow: ClassVar[Mapping[str, taylor.Reading]] = {"state": taylor.Along()}
    """How the Taylor route reads each row of a flow; a row that it cannot give says why in its ``lacks``."""
    max_bits: ClassVar[int] = MAX_BITS
    """Working precision at which a proof is given up: lower where a value takes an integral."""

    @property
    @declared
    def parameters(self) -> dict[str, Fraction]:
        """The exact parameters by name."""
        raise NotImplementedError

    @property
    @declared
    def start(self) -> tuple[Fraction, ...]:
        """The exact initial state."""
        raise NotImplementedError

    @property
    def state_names(self) -> tuple[str, ...]:
        """The components of the state."""
        return self.space.components

    @property
    def equation(self) -> str:
        """The equation of motion in one line, with its start."""
        if self.form is None:
            raise UndeclaredError.of(type(self), "equation", "the equation of motion in one line, with its start")
        return self.form.equation

    @property
    @declared
    def inputs(self) -> dict[str, tuple[Any, str]]:
        """What tells the problem from others of its family: numbers or names, and their units, by name."""
        raise NotImplementedError

    def parameters_in(self, m: Any) -> dict[str, Any]:
        """The parameters by name, as numbers of an arithmetic."""
        return {name: m.number(value) for name, value in self.parameters.items()}

    def start_in(self, m: Any) -> list[Any]:
        """The initial state, as numbers of an arithmetic."""
        return [m.number(value) for value in self.start]

    @property
    def constants(self) -> tuple[Constant, ...]:
        """The physical constants that the parameters come from; none where they are given themselves."""
        return ()

    autonomous: ClassVar[bool] = True
    """Whether the equation is without the time."""

    @declared
    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """dy/dt as a function of the time, the state and the parameters, in any arithmetic."""
        raise NotImplementedError

    @declared
    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The first of the invariants, in any arithmetic; for an energy with a rest, what it is above that.

        So it is free of cancellation, and its relative change means something.
        """
        raise NotImplementedError

    @declared
    def kinetic(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The kinetic energy, by which the drift of an invariant is told that may be zero."""
        raise NotImplementedError

    @property
    def positions(self) -> int:
        """How many components are positions apart from momenta; 0 where the equation does not split into both."""
        return 0

    bodies: ClassVar[tuple[str, ...]] = ("",)
    """The bodies that the positions are of: one coordinate of every body after the other."""

    @property
    def second_order(self) -> bool:
        """Whether the equation is q'' = F(q): it splits, is without the time, and the velocity is the momentum."""
        return False

    @property
    def original(self) -> Problem:
        """The problem as it was asked for: another one may stand for it where it is marched."""
        return self

    @cached_property
    def structure(self) -> Any:
        """What problems share whose equations differ in parameters alone: the equations and invariants in symbols.

        A number that does not come of the parameters is a symbol of its own.
        """
        from reference.arithmetic.compiler import hy

        def constant(value: Any) -> Any:
            return hy.expression(f"constant {Fraction(value)}" if isinstance(value, (int, Fraction)) else str(value))

        m: Any = Heyoka(constant)
        y = [hy.expression(name) for name in self.state_names]
        p = {name: hy.par[i] for i, name in enumerate(self.parameters)}
        time: Any = NO_TIME if self.autonomous else hy.time
        found = [*self.derivative(m, time, y, p), *(getattr(self, one.value)(m, y, p) for one in self.invariants)]
        return type(self), tuple(self.parameters), tuple(str(hy.expression(0.0) + value) for value in found)

    def cycle(self) -> float:
        """The period of the motion in its own unit of time; NaN where it has none."""
        return float(self.certified("period")) if self.serves("period") else math.nan

    def time_units(self) -> dict[str, float]:
        """Units of its own in which its time may be told, in s, by name: of itself the period, where it has one."""
        period = self.cycle()
        return {"periods": period} if math.isfinite(period) else {}

    def orbits(self) -> Orbits | None:
        """The exact orbits at the precision in force; None where phases and amplitudes are not defined."""
        return None

    @property
    def lacks_of_orbits(self) -> str:
        """What of phase and amplitude the exact motion lacks, in a sentence; "" where it has both."""
        return f"Phase and amplitude are not defined for the problem {self.name}."

    @property
    def has_momenta(self) -> bool:
        """Whether momenta are known: as components, as velocities themselves, or as an energy's slopes by them."""
        told = self.positions or (self.autonomous and [one.name for one in self.invariants[:1]] == ["energy"])
        return bool(self.space.momenta or (self.space.velocities and told))

    def state_bounds(self) -> StateBounds | None:
        """What bounds many of its states in doubles, to spare their proofs; None where nothing does."""
        return None

    def input_condition(self) -> InputCondition | None:
        """What tells how far roundings of time, start and parameters lead its states; None where nothing does."""
        return None

    event_words: ClassVar[str] = "events"
    """What the events of ``passages`` are called."""

    def passages(self, until: float) -> tuple[str, int] | None:
        """The row of its proven events and how many of them lie in (0, until]; None where it has none."""
        del until
        return None

    @declared
    def event(self, m: Arithmetic, y: Sequence[Any]) -> Any:
        """Zero at the events of ``passages``, in any arithmetic."""
        raise NotImplementedError

    def rate(self) -> float:
        """How fast neighbouring solutions turn or part, in 1/s, to choose the work of implicit methods and steps.

        Of itself the largest eigenvalue of df/dy at some states of the exact motion; a family may know a bound.
        """
        from reference.arithmetic.arrays import np

        arithmetic: Any = NUMPY
        duals: Any = DualArithmetic(arithmetic, len(self.state_names))
        p = self.parameters_in(NUMPY)

        def largest(t: float, y: Sequence[float]) -> float:
            variables = [duals.variable(value, i) for i, value in enumerate(y)]
            rates = self.derivative(duals, t, variables, p)
            slopes = [rate.slopes if isinstance(rate, Dual) else (0.0,) * len(y) for rate in rates]
            return float(np.max(np.abs(np.linalg.eigvals(np.array(slopes, dtype=float)))))

        at_start, period = largest(0.0, self.start_in(NUMPY)), self.cycle()
        end = Fraction(period if math.isfinite(period) else SEEN / at_start if at_start > 0 else SEEN)
        times = [end * Fraction(k, STATES) for k in range(1, STATES + 1)]
        return max(at_start, *(largest(float(t), y) for t, y in zip(times, self.state(times).tolist(), strict=True)))

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Problem:
        """The same problem from a start close by, but by many of a format's roundings.

        ``rounding`` gives the format's nearest number, ``epsilon`` its relative spacing.  Of itself it is the problem
        whose first number that is a field of it and not zero, inputs first, is smaller by 2^-36 of itself, or by 16
        roundings; where all are zero, the first is 2^-36, or 16 roundings of one.

        Raises:
            ValueError: no field is a number.
        """
        given: dict[str, Any] = {one.name: getattr(self, one.name) for one in fields(self) if one.init}
        numbers = [name for name in (*self.inputs, *given) if isinstance(given.get(name), Fraction)]
        for name in sorted(numbers, key=lambda name: given[name] == 0)[:1]:
            moved = given[name] * (1 - max(APART, 16 * epsilon)) if given[name] else max(APART, 16 * epsilon)
            return type(self)(**{**given, name: rounding(moved)})
        raise ValueError(f"{self!r} has no number to be moved; a problem that declares its neighbour is accepted.")

    @declared
    def closed_form(self, m: Any) -> ClosedForm:
        """The solution in one arithmetic with elliptic functions."""
        raise NotImplementedError

    @property
    def has_closed_form(self) -> bool:
        """Whether it declares its solution; without, its flow is proven."""
        return type(self).closed_form is not Problem.closed_form

    def enclosure_form(self) -> Solution:
        """The solution in balls: the closed form, or the state by the proven flow of its equation where it has none."""
        return self.closed_form(BALL) if self.has_closed_form else proven_flow.FlowSolution(self)

    def chart(self, row: str, count: int, bits: int) -> Solution | None:
        """A solution in balls that is faster for ``count`` arguments, good to about ``bits`` bits; None if none is."""
        del row, count, bits
        return None

    def quadrature_form(self) -> Solution:
        """The solution by mpmath at its working precision, built in it."""
        return self.closed_form(MPMATH)

    def taylor_form(self, bits: int) -> Solution:
        """The solution by heyoka's Taylor method in MPFR arithmetic of ``bits`` bits, as ``by_flow`` declares it."""
        return taylor.taylor_route(self, bits)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether the Taylor route reaches all of these arguments in bounded work.

        Here of a row along the flow of the equation itself or of its events: no time is negative, and none is so late
        that the flow takes more than ``taylor.STEPS`` steps.
        """
        return taylor.reaches(self, row, arguments)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The values of a row that are exactly rational, which no ball could decide; None for those that are not.

        Of itself the start.
        """
        return self.start if row == "state" and argument == 0 else None

    def exact_invariant(self, value: str) -> Fraction | None:
        """What the method of this name gives at the start where that is rational; None where it is not known to be.

        No ball might decide it.
        """
        found = _read_at_start(self, value, RATIONAL)
        found = known(lambda: surd(_read_at_start(self, value, SURD)).rational) if found is None else found
        return Fraction(found) if isinstance(found, (int, Fraction)) else None

    def working_bits(self, arguments: Sequence[Any]) -> int:
        """Bits that the solution in balls is expected to lose at these arguments; only speed depends on it.

        Of itself those of the latest time.
        """
        return int(_latest(arguments)).bit_length() if self.has_closed_form else self.working.bits("state", arguments)

    @property
    def working(self) -> WorkingBits:
        """How many working bits its rows take."""
        return OfClosedForm(self) if self.has_closed_form else OfFlow(self)

    def flow_reading(self, row: str, arguments: Sequence[Any], component: int | None = None) -> FlowReading:
        """Where a row is read of a flow: the state at the times among its arguments, but for what is exactly rational.

        Of a row of the problem's own only the last of these times is known.
        """
        times = [argument for argument in arguments if isinstance(argument, Fraction)]
        if row != "state":
            return FlowReading(self, [], until=_latest(times))

        return FlowReading(self, times, self.undecided(row, component))

    def undecided(
        self, row: str, component: int | None, first: int = 0
    ) -> Callable[[Fraction, list[arb]], Sequence[arb]]:
        """Reads a row, from the ``first`` component of a state on, but for what is exactly rational at a time."""

        def values(time: Fraction, state: list[arb]) -> list[arb]:
            asked = state[first : first + len(self.state_names)]
            exact = self.exact_row(row, time) or [None] * len(asked)
            places = range(len(asked)) if component is None else [component]
            return [asked[place] for place in places if exact[place] is None]

        return values

    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None:
        """The values of a row by "taylor" or "quadrature", good to ``digits`` digits; None if it has no such row.

        Raises:
            ValueError: an argument is outside of the row's domain.
        """
        arguments = self.arguments(row, arguments)
        if route in dict(self.row(row).lacks) or (route == "quadrature" and not self.has_closed_form):
            return None
        if route == "taylor" and not self.within_taylor(row, arguments):
            return None
        bits = self.working.of_route(row, arguments, int(digits * 3.33))
        if bits > ROUTE_BITS:
            return None
        if route == "quadrature":
            return quadrature.rows(self.quadrature_form, row, arguments, bits)
        if bits > TAYLOR_BITS:
            return None
        with mp.workprec(bits):
            return self.taylor_form(bits).rows(row, arguments)

    def row(self, name: str) -> Row:
        """The row of this name.

        Raises:
            KeyError: there is none; the message gives the nearest names.
        """
        known = {row.name: row for row in self.rows}
        if name not in known:
            raise KeyError(unknown("row", str(name), known))
        return known[name]

    def serves(self, row: str) -> bool:
        """Whether this problem has a row that its family knows."""
        return any(known.name == row for known in self.rows)

    def domain(self, row: Row) -> Domain:
        """The arguments that the row takes: what it declares, or less where this motion ends before."""
        return row.domain

    def arguments(self, row: str, arguments: Sequence[Any]) -> list[Any]:
        """The exact arguments of a row: None, ints or Fractions.

        Raises:
            KeyError: there is no such row.
            ValueError: an argument is outside of the row's domain.
            TypeError: an argument is no real number.
        """
        domain = self.domain(self.row(row))
        return [domain.argument(value, row) for value in arguments]

    def certified(self, row: str, argument: Any = None, component: int = 0) -> Certified:
        """One number of a row as a proven scalar.

        Raises:
            KeyError: there is no such row.
            ValueError: the argument is outside of the row's domain, or the row has no such component.
            TypeError: the argument is no real number.
        """
        return Certified(self, row, argument, component)

    def values(self, row: str, arguments: Sequence[Any], count: int) -> np.ndarray:
        """The correctly rounded limbs of a row: float64 of shape (arguments, quantities, count)."""
        from reference.arithmetic.arrays import np

        found = enclosure.decide(
            self,
            row,
            arguments,
            *to_limbs(count),
            53 * count,
            charted=True,
        )
        return np.array(found, dtype=np.float64).reshape(len(arguments), -1, count)

    def state(self, t: Any, limbs: int = 1) -> np.ndarray:
        """The state at the exact times ``t``, every limb proven correctly rounded.

        Args:
            t: one time or an array of any shape: float64 at its exact value, Fractions, or decimal strings; s.
            limbs: 1 for the correctly rounded double; 2, 3, ... append its tail.

        Returns:
            float64 of shape ``t.shape + (state,)``, with a last axis of length ``limbs`` where that is above 1.

        Raises:
            ValueError: ``t`` is empty, not finite or out of range, or ``limbs`` is not an integer from 1 to MAX_LIMBS.
            WorkBoundError: a value could not be decided within the bound on the working precision.
            ModuleNotFoundError: NumPy is not installed; ``certified`` does without.
        """
        return self.along("state", t, limbs)

    def along(self, row: str, arguments: Any, limbs: int = 1) -> np.ndarray:
        """A row at exact arguments of any shape, as ``state`` gives it: the last axis is of the row's quantities.

        Raises:
            KeyError: there is no such row.
            ValueError: ``arguments`` is empty, not finite or out of range, or ``limbs`` is not an integer from 1 to
                MAX_LIMBS.
            TypeError: ``arguments`` holds what is no real number.
            WorkBoundError: a value could not be decided within the bound on the working precision.
            ModuleNotFoundError: NumPy is not installed; ``certified`` does without.
        """
        asked, limbs = self.row(row), positive(limbs, "limbs", MAX_LIMBS)
        once: tuple[list[Any], tuple[int, ...]] = [arguments], ()
        numbers, shape = once if asked.over == "once" else exact_array(arguments, asked.domain.name)
        found = self.values(row, numbers, limbs).reshape(*shape, len(asked.quantities), limbs)
        return found[..., 0] if limbs == 1 else found


@dataclass(frozen=True)
class SeparableProblem(Problem):
    """A problem with q' = v(p) and p' = F(t, q), positions q first in the state."""

    @property
    def positions(self) -> int:
        return len(self.space.positions)

    @property
    def second_order(self) -> bool:
        trial = [Fraction(3 * k + 2, 7) for k in range(self.positions)]
        found = self.velocity(NUMPY, list(map(float, trial)), self.parameters_in(NUMPY))
        return self.autonomous and list(found) == list(map(float, trial))

    @declared
    def velocity(self, m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """q' as a function of the momenta and the parameters."""
        raise NotImplementedError

    @declared
    def force(self, m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """p' as a function of the time, the positions and the parameters."""
        raise NotImplementedError

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(q, p)' = (v(p), F(t, q))."""
        count = len(self.space.positions)
        return *self.velocity(m, y[count:], p), *self.force(m, t, y[:count], p)


@dataclass(frozen=True)
class HamiltonianProblem(Problem):
    """A problem with q' = dH/dp and p' = -dH/dq, of a Hamiltonian H(t, q, p) that is written once.

    Its first invariant is the value of H where that is without the time.  Where H = T(p) + V(t, q) it splits into kicks
    and drifts; whether it does is seen at its slopes.
    """

    @declared
    def hamiltonian(self, m: Arithmetic, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        """H as a function of the time, the positions, their momenta and the parameters, in any arithmetic."""

    def _slopes(self, m: Any, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> list[Any]:
        """dH/dq, then dH/dp."""
        duals, size = DualArithmetic(m, 2 * len(q)), len(q)
        positions = [duals.variable(value, i) for i, value in enumerate(q)]
        momenta = [duals.variable(value, size + i) for i, value in enumerate(p)]

        def fixed(value: Any) -> Any:
            """What has slopes of its own, by something else, is a constant here."""
            return duals.constant(value) if isinstance(value, Dual) else value

        constants = {name: fixed(value) for name, value in c.items()}
        return list(self.hamiltonian(duals, fixed(t), positions, momenta, constants).slopes)

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(dH/dp, -dH/dq) in the order of the state."""
        where = [*self.space.places(self.space.positions), *self.space.places(self.space.momenta)]
        size = len(where) // 2
        slopes = self._slopes(m, t, [y[i] for i in where[:size]], [y[i] for i in where[size:]], p)
        rates = [*slopes[size:], *(-slope for slope in slopes[:size])]
        return tuple(rate for _, rate in sorted(zip(where, rates, strict=True), key=lambda pair: pair[0]))

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The value of H, which is conserved where it is without the time."""
        q, momenta = ([y[i] for i in self.space.places(names)] for names in (self.space.positions, self.space.momenta))
        return self.hamiltonian(m, NO_TIME, q, momenta, p)

    def kinetic(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """What the momenta make of H: H(q, p) - H(q, 0)."""
        q, momenta = ([y[i] for i in self.space.places(names)] for names in (self.space.positions, self.space.momenta))
        still = [m.number(Fraction(0))] * len(momenta)
        return self.hamiltonian(m, NO_TIME, q, momenta, p) - self.hamiltonian(m, NO_TIME, q, still, p)

    @property
    def positions(self) -> int:
        return len(self.space.positions) if self._splits else 0

    @cached_property
    def _splits(self) -> bool:
        """Whether dH/dq is the same at other momenta, dH/dp at other positions and times, and positions stand first."""
        size = len(self.space.positions)
        if self.space.components != (*self.space.positions, *self.space.momenta):
            return False
        c, (one, other) = self.parameters_in(NUMPY), self._generic_states()
        here = self._slopes(NUMPY, EARLY, one[:size], one[size:], c)
        other_momenta = self._slopes(NUMPY, EARLY, one[:size], other[size:], c)
        elsewhere = self._slopes(NUMPY, LATE, other[:size], one[size:], c)
        pairs = zip(here, other_momenta[:size] + elsewhere[size:], strict=True)
        return all(abs(a - b) <= SAME * (abs(a) + abs(b)) for a, b in pairs)

    def _generic_states(self) -> tuple[list[float], list[float]]:
        """Two states about the start, at which no component is what it is there."""
        start = self.start_in(NUMPY)
        return tuple(  # type: ignore[return-value]
            [value * FAR[(i + k) % len(FAR)] + NEAR[(i + k) % len(NEAR)] for i, value in enumerate(start)]
            for k in range(2)
        )

    @property
    def second_order(self) -> bool:
        trial = [(3 * k + 2) / 7 for k in range(self.positions)]
        c = self.parameters_in(NUMPY)
        return bool(trial) and self.autonomous and [float(v) for v in self.velocity(NUMPY, trial, c)] == trial

    def velocity(self, m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """dH/dp, at the start: of a Hamiltonian that splits it is the same everywhere."""
        size = len(self.space.positions)
        start = [m.number(value) for value in self.start[:size]]
        return tuple(self._slopes(m, m.number(Fraction(0)), start, momenta, p)[size:])

    def force(self, m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """-dH/dq, at the momenta of the start."""
        size = len(positions)
        momenta = [m.number(value) for value in self.start[size:]]
        return tuple(-slope for slope in self._slopes(m, t, positions, momenta, p)[:size])


def _latest(arguments: Sequence[Any]) -> Fraction:
    """The time among them that is farthest from the start."""
    return max((abs(t) for t in arguments if isinstance(t, Fraction)), default=Fraction(0))


def _read_at_start(problem: Problem, value: str, m: Any) -> Any:
    """A method of a problem at its start, in an arithmetic; None where it is not known to be rational in it."""
    try:
        return getattr(problem, value)(m, problem.start_in(m), problem.parameters_in(m))
    except IrrationalError:
        return None


FAR, NEAR = (1.1, 0.9, 1.2), (0.05, -0.07, 0.03)
"""By such factors and terms a state is moved to see on what slopes depend."""
EARLY, LATE = 0.3, 0.7
"""Times at which they are taken."""
SAME = 1e-12
