"""The flow of an equation: heyoka's adaptive Taylor method in MPFR arithmetic, compiled once for a structure."""

from __future__ import annotations

import math
from copy import copy
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH, Heyoka

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from reference.declaration import Equation

    Event = Callable[[Any, Sequence[Any]], Any]
    """A function of the state, event(m, y), in any arithmetic."""

__all__ = ["STEPS", "Flow", "System", "to_fraction", "within_steps"]

WORD = 64
"""MPFR computes with whole words."""
COMPILED = 32
"""Equations whose compiled integrators are kept: compiling takes a hundred times as long as a short flow."""
STEPS = 1 << 14
"""Steps that a flow takes at most for a problem that does not bound its work more sharply; some ten seconds."""


@dataclass(frozen=True)
class System:
    """y' = derivative(m, t, y, p) from its start: what a flow is of where it is not of the problem itself.

    What is compiled of it is known by its ``derivative``, which is a function or a frozen dataclass that is called.
    """

    derivative: Callable[..., tuple[Any, ...]]
    state_names: tuple[str, ...]
    start: tuple[Fraction, ...]
    parameters: Mapping[str, Fraction]

    @property
    def structure(self) -> Any:
        return self.derivative

    def start_in(self, m: Any) -> list[Any]:
        """The start, as numbers of an arithmetic."""
        return [m.number(value) for value in self.start]


class Flow:
    """The flow of a problem's equation from its start, to a tolerance of ``bits`` bits.

    Raises ArithmeticError where heyoka does not reach the end of the grid.
    """

    def __init__(self, problem: Equation, bits: int) -> None:
        from reference.arithmetic.compiler import hy

        self._hy = hy
        self._problem = problem
        self._bits = WORD * -(-bits // WORD)

    def _real(self, value: Fraction) -> Any:
        return _real(value, self._bits)

    def _integrator(self, variational: tuple[str, ...] = (), order: int = 1, event: Event | None = None) -> Any:
        """An integrator at the start, a copy of what was compiled once for the equation."""
        problem = self._problem
        integrator = copy(_compiled(_Known.of(problem), self._bits, variational, order, event))
        integrator.state[: len(problem.start)] = [self._real(value) for value in problem.start]
        _set_parameters(integrator, problem, self._real)
        return integrator

    def at(
        self, times: Sequence[Fraction], variational: Sequence[str] = (), order: int = 1
    ) -> list[tuple[Fraction, ...]]:
        """The state at each time (none negative), and after it its derivatives by the named starts and parameters.

        They come order by order up to ``order``, and in each order those of the first state first.
        """
        moments = sorted({Fraction(0), *times})
        integrator = self._integrator(tuple(variational), order)
        outcome, *_, states = integrator.propagate_grid([self._real(moment) for moment in moments])
        if outcome != self._hy.taylor_outcome.time_limit:
            raise ArithmeticError(f"heyoka stopped with {outcome} before the last time of {self._problem!r}.")
        found = {
            moment: tuple(to_fraction(value) for value in state) for moment, state in zip(moments, states, strict=True)
        }
        return [found[time] for time in times]

    def zeros(self, event: Event, until: float) -> list[Fraction]:
        """The times in (0, until] at which a function of the state, event(m, y), crosses zero.

        heyoka overlooks the next zero where the start is one; the integration with the event begins just after it.
        """
        integrator = self._integrator(event=event)
        if event(MPMATH, [MPMATH.number(value) for value in self._problem.start]) == 0:
            early = Fraction(until) / 2 ** (self._bits // 4)
            (state,) = self.at([early])
            integrator.state[:], integrator.time = [self._real(value) for value in state], self._real(early)
        integrator.propagate_until(self._real(Fraction(until)))
        return [to_fraction(time) for time in integrator.nt_events[0].callback]


class _Times(list[Any]):
    """heyoka's callback of an event, which copies of an integrator have each for itself: its times."""

    def __call__(self, _integrator: Any, time: Any, _sign: int) -> None:
        self.append(time)


@dataclass(frozen=True)
class _Known:
    """An equation by what is compiled of it: two of the same structure differ in starts and parameters alone."""

    structure: Any
    state_names: tuple[str, ...]
    parameter_names: tuple[str, ...]
    derivative: Callable[..., Sequence[Any]] = field(compare=False)

    @classmethod
    def of(cls, equation: Equation) -> _Known:
        return cls(equation.structure, tuple(equation.state_names), tuple(equation.parameters), equation.derivative)

    def system(self, number: Callable[[Fraction], Any]) -> tuple[list[Any], dict[str, Any], list[tuple[Any, Any]]]:
        """heyoka's variables and parameters, and their rates."""
        from reference.arithmetic.compiler import hy

        variables = [hy.expression(name) for name in self.state_names]
        symbols = {name: hy.par[i] for i, name in enumerate(self.parameter_names)}
        m = Heyoka(number)
        (time, *state), named = (
            m.terms([hy.time, *variables]),
            dict(zip(symbols, m.terms(symbols.values()), strict=True)),
        )
        rates = [m.expression(rate) for rate in self.derivative(m, time, state, named)]
        return variables, symbols, list(zip(variables, rates, strict=True))


@lru_cache(maxsize=COMPILED)
def _compiled(known: _Known, bits: int, variational: tuple[str, ...], order: int, event: Event | None) -> Any:
    """The integrator of an equation, its state and its parameters still to be set."""
    from reference.arithmetic.compiler import hy, not_kept

    def number(value: Fraction) -> Any:
        return _real(value, bits)

    variables, symbols, rates = known.system(number)
    system: Any = rates
    if variational:
        named = {**dict(zip(known.state_names, variables, strict=True)), **symbols}
        system = hy.var_ode_sys(system, [named[name] for name in variational], order)
    m = Heyoka(number)
    events = [] if event is None else [hy.nt_event_real(m.expression(event(m, m.terms(variables))), _Times())]
    zero = number(Fraction(0))
    with not_kept():
        return hy.taylor_adaptive(
            system,
            [zero] * len(variables),
            fp_type=hy.real,
            prec=bits,
            tol=_tolerance(bits),
            compact_mode=True,
            nt_events=events,
        )


@lru_cache(maxsize=COMPILED)
def _in_doubles(known: _Known) -> Any:
    from reference.arithmetic.compiler import hy, not_kept

    variables, _, rates = known.system(float)
    with not_kept():
        return hy.taylor_adaptive(rates, [0.0] * len(variables), compact_mode=True)


def _set_parameters(integrator: Any, equation: Equation, number: Callable[[Fraction], Any]) -> None:
    """heyoka has parameters up to the last that occurs in the equation."""
    integrator.pars[:] = [number(value) for value in equation.parameters.values()][: len(integrator.pars)]


def within_steps(equation: Equation, time: Fraction) -> bool:
    """Whether the flow is at a time, which is not negative, after at most STEPS steps: told by a flow in doubles.

    Its steps are about as long as those in more bits: the radius of convergence decides, and the order hardly.
    """
    from reference.arithmetic.compiler import hy

    integrator = copy(_in_doubles(_Known.of(equation)))
    integrator.state[:] = [float(value) for value in equation.start]
    _set_parameters(integrator, equation, float)
    outcome, *_ = integrator.propagate_until(float(time), max_steps=STEPS)
    return bool(outcome == hy.taylor_outcome.time_limit)


def _tolerance(bits: int) -> Any:
    """A tolerance of at most 2^-bits at which heyoka's order, ceil(1 - log(tolerance)/2), leaves 2 when divided by 4.

    heyoka takes its step from the last two terms of the series.  From rest these have even powers of t only, and where
    the force is even about the start, only t^2, t^6, t^10, ...: of other orders both terms could vanish, and with them
    all control of the error.
    """
    order = math.ceil(1 + bits * math.log(2) / 2)
    order += (2 - order) % 4
    return _real(Fraction(1, 2 ** round((2 * order - 3) / math.log(2))), bits)


def _real(value: Fraction, bits: int) -> Any:
    from reference.arithmetic.compiler import hy

    return hy.real(value.numerator, bits) / hy.real(value.denominator, bits)


def to_fraction(value: Any) -> Fraction:
    """heyoka's MPFR number as a rational: its decimal, which reads back as the same number."""
    return Fraction(str(value))
