"""The Taylor route: heyoka's adaptive Taylor method in MPFR arithmetic, on the equation of motion alone."""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic import Heyoka

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = ["Flow", "to_fraction"]


class Flow:
    """The flow of a problem's equation from its start, to a tolerance of ``bits`` bits.

    Raises ArithmeticError where heyoka does not reach the end of the grid.
    """

    def __init__(self, problem: Problem, bits: int) -> None:
        from reference.compiler import hy, not_kept

        self._hy, self._not_kept = hy, not_kept
        self._problem = problem
        self._bits = bits

    def _real(self, value: Fraction) -> Any:
        real = self._hy.real
        return real(value.numerator, self._bits) / real(value.denominator, self._bits)

    @cached_property
    def _variables(self) -> list[Any]:
        return list(self._hy.make_vars(*self._problem.state_names))

    def _integrator(self, variational: Sequence[str] = (), **events: Any) -> Any:
        hy, problem = self._hy, self._problem
        parameters = problem.parameters
        symbols = {name: hy.par[i] for i, name in enumerate(parameters)}
        rates = problem.derivative(Heyoka(self._real), self._variables, symbols)
        system: Any = list(zip(self._variables, rates, strict=True))
        if variational:
            named = {**dict(zip(problem.state_names, self._variables, strict=True)), **symbols}
            chosen = [named[name] for name in variational]
            system = hy.var_ode_sys(system, chosen, 1)
        with self._not_kept():
            return hy.taylor_adaptive(
                system,
                [self._real(value) for value in problem.start],
                fp_type=hy.real,
                prec=self._bits,
                tol=self._real(Fraction(1, 2**self._bits)),
                pars=[self._real(value) for value in parameters.values()],
                compact_mode=True,
                **events,
            )

    def at(self, times: Sequence[Fraction], variational: Sequence[str] = ()) -> list[tuple[Fraction, ...]]:
        """The state at each time (none negative), and after it its derivatives by the named starts and parameters."""
        moments = sorted({Fraction(0), *times})
        integrator = self._integrator(variational)
        grid = np.array([self._real(moment) for moment in moments])
        outcome, *_, states = integrator.propagate_grid(grid)
        if outcome != self._hy.taylor_outcome.time_limit:
            raise ArithmeticError(f"heyoka stopped with {outcome} before the last time of {self._problem!r}.")
        found = {
            moment: tuple(to_fraction(value) for value in state) for moment, state in zip(moments, states, strict=True)
        }
        return [found[time] for time in times]

    def zeros(self, event: Callable[[Heyoka, Sequence[Any]], Any], until: float) -> list[Fraction]:
        """The times in (0, until] at which a function of the state, event(m, y), crosses zero."""
        crossings: list[Fraction] = []
        crossing = self._hy.nt_event_real(
            event(Heyoka(self._real), self._variables), lambda _ta, time, _sign: crossings.append(to_fraction(time))
        )
        self._integrator(nt_events=[crossing]).propagate_until(self._real(Fraction(until)))
        return [time for time in crossings if time > Fraction(until) / 10**9]


def to_fraction(value: Any) -> Fraction:
    """heyoka's MPFR number as a rational: its decimal, which reads back as the same number."""
    return Fraction(str(value))
