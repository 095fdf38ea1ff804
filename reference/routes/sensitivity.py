"""The derivatives of a flow by one of its inputs, a component of the start or a parameter, as a flow of their own.

With y' = f(t, y, p) their equation is V' = df/dy V + df/dp, from the derivatives of the start: f is read once, with
dual numbers, and state and derivatives are proven together.  docs/flows.md has it as rule 17.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.balls import BALL
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.precision import ctx
from reference.arithmetic.rational import RATIONAL, IrrationalError
from reference.routes.taylor import Along

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.routes.taylor import TaylorRoute

__all__ = ["Sensitivity", "Variations", "known_sensitivity"]

LOOK_BITS = 64
"""Working precision at which it is seen which slopes of an equation are zero everywhere."""
WIDE = Fraction(1, 1 << 20)
"""So far from the start they are looked at."""


@dataclass(frozen=True, repr=False)
class Sensitivity:
    """The state of a problem and its derivatives by the input of the name ``by``: an equation.

    The problem has ``start_slopes(m, by)``, the derivatives of its start in an arithmetic.
    """

    problem: Any
    by: str

    def __repr__(self) -> str:
        return f"{self.problem!r} with its derivatives by {self.by}"

    @property
    def state_names(self) -> tuple[str, ...]:
        """The components, then the derivative of each."""
        names = self.problem.state_names
        return *names, *(f"d{name}_d{self.by}" for name in names)

    @property
    def parameters(self) -> dict[str, Fraction]:
        """Those of the problem."""
        found: dict[str, Fraction] = self.problem.parameters
        return found

    @property
    def structure(self) -> Any:
        """What is compiled of it is of its problem and the input."""
        return self.problem.structure, self.by

    def start_in(self, m: Any) -> list[Any]:
        """The start and its derivatives, as numbers of an arithmetic."""
        return [*self.problem.start_in(m), *self.problem.start_slopes(m, self.by)]

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(f, df/dy V + df/dp)."""
        size, duals = len(y) // 2, DualArithmetic(m, 1)
        state = [Dual(value, (slope,)) for value, slope in zip(y[:size], y[size:], strict=True)]
        moved = {**p, self.by: duals.variable(p[self.by], 0)} if self.by in p else p
        rates = self.problem.derivative(duals, t, state, moved)
        zero = m.number(Fraction(0))
        values = [rate.value if isinstance(rate, Dual) else rate for rate in rates]
        return *values, *(rate.slopes[0] if isinstance(rate, Dual) else zero for rate in rates)


@dataclass(frozen=True)
class _Pattern:
    """What is zero at every state and time: df_i/dp where i is not in ``pushed``, df_i/dy_j where j is not in
    ``turned[i]``, and the derivative of the start of what is not in ``begun``.
    """

    begun: frozenset[int]
    pushed: frozenset[int]
    turned: tuple[frozenset[int], ...]

    @property
    def moving(self) -> frozenset[int]:
        """The components whose derivative by the input is not always zero, as far as the pattern shows."""
        found = self.begun | self.pushed
        while more := {i for i, row in enumerate(self.turned) if row & found} - found:
            found |= more
        return found

    @property
    def constant(self) -> frozenset[int]:
        """Those whose derivative stays what it is at the start."""
        moving = self.moving
        return frozenset(i for i, row in enumerate(self.turned) if i not in self.pushed and not row & moving)


@lru_cache(maxsize=256)
def _pattern(problem: Any, by: str) -> _Pattern:
    """Seen on a box about the start, where a slope that is exactly zero is zero everywhere."""
    size = len(problem.state_names)
    with ctx.workprec(LOOK_BITS):
        duals: Any = DualArithmetic(BALL, size + 1)
        around = arb(0, BALL.number(WIDE))
        y = [duals.variable(value + around, i) for i, value in enumerate(problem.start_in(BALL))]
        p: dict[str, Any] = {name: BALL.number(value) for name, value in problem.parameters.items()}
        if by in p:
            p[by] = duals.variable(p[by], size)
        zeros = (arb(0),) * (size + 1)
        slopes = [rate.slopes if isinstance(rate, Dual) else zeros for rate in problem.derivative(duals, around, y, p)]
        begun = [
            arb(slope) if not isinstance(slope, Fraction) else BALL.number(slope)
            for slope in problem.start_slopes(BALL, by)
        ]
    return _Pattern(
        frozenset(i for i, slope in enumerate(begun) if not slope.is_zero()),
        frozenset(i for i, row in enumerate(slopes) if not row[size].is_zero()),
        tuple(frozenset(j for j in range(size) if not row[j].is_zero()) for row in slopes),
    )


@lru_cache(maxsize=256)
def _begun(problem: Any, by: str) -> tuple[Fraction | None, ...]:
    """The derivatives of the start, None for what is not known to be rational."""
    found: list[Fraction | None] = []
    for place in range(len(problem.state_names)):
        try:
            found.append(Fraction(problem.start_slopes(RATIONAL, by, place)[0]))
        except IrrationalError:
            found.append(None)
    return tuple(found)


def known_sensitivity(problem: Any, by: str, time: Fraction) -> tuple[Fraction | None, ...]:
    """The derivatives at a time that are exactly rational, None for the others: at the start, and what stays so."""
    start = _begun(problem, by)
    if time == 0:
        return start
    constant = _pattern(problem, by).constant
    return tuple(value if i in constant else None for i, value in enumerate(start))


@dataclass(frozen=True)
class Variations(Along):
    """The derivatives by an input, of heyoka's variational equations, by the chain rule at the start."""

    input: str = field(kw_only=True)

    def __call__(self, route: TaylorRoute, row: str, arguments: Sequence[Any]) -> Sequence[Any]:
        problem, pattern = route.problem, _pattern(route.problem, self.input)
        starts = tuple(name for i, name in enumerate(problem.state_names) if i in pattern.begun)
        parameter = (self.input,) if self.input in problem.parameters and pattern.pushed else ()
        return Along(_Chain(self.input, len(parameter)), by=(*starts, *parameter))(route, row, arguments)


@dataclass(frozen=True)
class _Chain:
    """From the state and its derivatives by starts, and by the parameter last if it is one, to those by the input."""

    by: str
    parameters: int

    def __call__(self, route: TaylorRoute, state: Sequence[Any]) -> list[Any]:
        problem, m = route.problem, route.m
        size, pattern = len(problem.state_names), _pattern(problem, self.by)
        slopes = problem.start_slopes(m, self.by)
        weights = [slope for i, slope in enumerate(slopes) if i in pattern.begun]
        weights += [m.number(Fraction(1))] * self.parameters
        derivatives = state[size:]
        count = len(weights)
        return [
            sum(
                (w * d for w, d in zip(weights, derivatives[i * count : (i + 1) * count], strict=True)),
                m.number(Fraction(0)),
            )
            for i in range(size)
        ]
