"""Extrapolation of Gragg, Bulirsch and Stoer with a fixed column: explicit Runge-Kutta methods, their tables derived.

With n even, the modified midpoint rule takes n steps H/n over the step H:
y_1 = y_0 + (H/n) f(y_0),  y_(m+1) = y_(m-1) + 2 (H/n) f(y_m),  and its end is smoothed: (y_(n-1) + 2 y_n + y_(n+1))/4.
Its error goes in even powers of H/n, so that the k-th column of the scheme of Aitken and Neville, by polynomials, has
order 2 k.  See E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I (1993), section II.9.
"""

from __future__ import annotations

from compare.methods.kinds.one_step import Embedded, Tableau
from compare.methods.order.algebraic import Q

__all__ = ["EXTRAPOLATION", "extrapolated"]

BULIRSCH = "Gragg 1965, SIAM J. Numer. Anal. 2, 384; Bulirsch and Stoer 1966, Numer. Math. 8, 1"
HARMONIC = "Gragg 1965, SIAM J. Numer. Anal. 2, 384; Deuflhard 1983, Numer. Math. 41, 399"

Weights = dict[int, Q]
"""Of the slopes of stages, in units of H; those that are not there are zero."""


def _combined(*parts: tuple[Q, Weights]) -> Weights:
    """The sum of some weights, each times a factor."""
    found: Weights = {}
    for factor, weights in parts:
        for stage, weight in weights.items():
            found[stage] = found.get(stage, 0) + factor * weight
    return found


def _midpoint(steps: int, first: int) -> tuple[list[Weights], Weights]:
    """The states y_1, ..., y_n, at which the stages from ``first`` on are, and the smoothed end."""
    before: Weights = {}
    states: list[Weights] = [{0: Q(1, steps)}]
    for stage in range(first, first + steps):
        before, now = states[-1], _combined((Q(1), before), (Q(2, steps), {stage: Q(1)}))
        states.append(now)
    *_, last, end, after = [{}, *states]
    return states[:-1], _combined((Q(1, 4), last), (Q(1, 2), end), (Q(1, 4), after))


def extrapolated(name: str, sequence: tuple[int, ...], source: str, aliases: tuple[str, ...] = ()) -> Tableau:
    """The last entry of the scheme over a sequence of numbers of steps; the one before it in its row is embedded.

    Raises:
        ValueError: the numbers are not even, or do not rise.
    """
    if any(steps % 2 for steps in sequence) or list(sequence) != sorted({0, *sequence})[1:]:
        raise ValueError(f"{name}: the numbers of steps are {sequence}; even ones that rise are accepted.")
    rows: list[Weights] = [{}]
    columns: list[Weights] = []
    for k, steps in enumerate(sequence):
        states, entry = _midpoint(steps, len(rows))
        rows += states
        row = [entry]
        for earlier, previous in zip(reversed(sequence[:k]), columns, strict=True):
            factor = 1 / (Q(steps, earlier) ** 2 - 1)
            row.append(_combined((1 + factor, row[-1]), (-factor, previous)))
        columns = row
    nothing, stages = Q(0), range(len(rows))
    return Tableau(
        name=name, order=2 * len(sequence), source=source,
        a=tuple(tuple(row.get(j, nothing) for j in range(i)) for i, row in enumerate(rows)),
        b=tuple(columns[-1].get(j, nothing) for j in stages),
        embedded=(Embedded(2 * len(sequence) - 2, tuple(columns[-2].get(j, nothing) for j in stages)),),
        family="extrapolation",
        aliases=aliases,
    )  # fmt: skip


EXTRAPOLATION = (
    extrapolated("gbs4", (2, 4), BULIRSCH),
    extrapolated("gbs6", (2, 4, 6), BULIRSCH),
    extrapolated("gbs8", (2, 4, 6, 8), BULIRSCH, aliases=("bulirsch_stoer8",)),
    extrapolated("gbs10", (2, 4, 6, 8, 10), HARMONIC, aliases=("gbs10_harmonic",)),
    extrapolated("gbs10_bulirsch", (2, 4, 6, 8, 12), BULIRSCH, aliases=("bulirsch_stoer10",)),
)
