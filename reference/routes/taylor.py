"""The Taylor route: heyoka's adaptive Taylor method in MPFR arithmetic, on the equation of motion alone."""

from __future__ import annotations

import math
from copy import copy
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH, Heyoka
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.declaration import Equation

__all__ = ["Flow", "to_fraction"]

WORD = 64
"""MPFR computes with whole words."""
COMPILED = 16
"""Equations whose compiled integrators are kept: compiling takes a hundred times as long as a short flow."""


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

    @cached_property
    def _variables(self) -> list[Any]:
        return list(self._hy.make_vars(*self._problem.state_names))

    def _integrator(self, variational: tuple[str, ...] = (), order: int = 1, **events: Any) -> Any:
        """An integrator at the start; one without events is a copy of what was compiled once for the equation."""
        problem = self._problem
        names = tuple(problem.state_names), tuple(problem.parameters)
        compiled = _compiled.__wrapped__ if events else _compiled
        integrator = copy(compiled(problem.derivative, *names, self._bits, variational, order, **events))
        integrator.state[: len(problem.start)] = [self._real(value) for value in problem.start]
        integrator.pars[:] = [self._real(value) for value in problem.parameters.values()]
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

    def zeros(self, event: Callable[[Any, Sequence[Any]], Any], until: float) -> list[Fraction]:
        """The times in (0, until] at which a function of the state, event(m, y), crosses zero.

        heyoka overlooks the next zero where the start is one; the integration with the event begins just after it.
        """
        crossings: list[Fraction] = []
        crossing = self._hy.nt_event_real(
            event(Heyoka(self._real), self._variables), lambda _ta, time, _sign: crossings.append(to_fraction(time))
        )
        integrator = self._integrator(nt_events=[crossing])
        if event(MPMATH, [MPMATH.number(value) for value in self._problem.start]) == 0:
            early = Fraction(until) / 2 ** (self._bits // 4)
            (state,) = self.at([early])
            integrator.state[:], integrator.time = [self._real(value) for value in state], self._real(early)
        integrator.propagate_until(self._real(Fraction(until)))
        return crossings


@lru_cache(maxsize=COMPILED)
def _compiled(
    derivative: Callable[..., Sequence[Any]],
    state_names: tuple[str, ...],
    parameter_names: tuple[str, ...],
    bits: int,
    variational: tuple[str, ...],
    order: int,
    **events: Any,
) -> Any:
    """The integrator of an equation, its state and its parameters still to be set."""
    from reference.arithmetic.compiler import hy, not_kept

    variables = list(hy.make_vars(*state_names))
    symbols = {name: hy.par[i] for i, name in enumerate(parameter_names)}
    rates = [
        rate if isinstance(rate, hy.expression) else hy.expression(rate)
        for rate in derivative(Heyoka(lambda value: _real(value, bits)), hy.time, variables, symbols)
    ]
    system: Any = list(zip(variables, rates, strict=True))
    if variational:
        named = {**dict(zip(state_names, variables, strict=True)), **symbols}
        system = hy.var_ode_sys(system, [named[name] for name in variational], order)
    zero = _real(Fraction(0), bits)
    with not_kept():
        return hy.taylor_adaptive(
            system,
            [zero] * len(variables),
            fp_type=hy.real,
            prec=bits,
            tol=_tolerance(bits),
            pars=[zero] * len(symbols),
            compact_mode=True,
            **events,
        )


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
