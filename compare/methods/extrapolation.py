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

Weights = list[Q]
"""Of the slopes of all stages, in units of H."""


def _midpoint(steps: int, first: int, stages: int) -> tuple[list[Weights], Weights]:
    """The states y_1, ..., y_n, at which the stages from ``first`` on are, and the smoothed end."""
    size = Q(1, steps)

    def moved(y: Weights, factor: Q, stage: int) -> Weights:
        return [weight + factor * (j == stage) for j, weight in enumerate(y)]

    before, now = [Q(0)] * stages, moved([Q(0)] * stages, size, 0)
    states = [now]
    for m in range(steps - 1):
        before, now = now, moved(before, 2 * size, first + m)
        states.append(now)
    after = moved(before, 2 * size, first + steps - 1)
    return states, [(a + 2 * b + c) / 4 for a, b, c in zip(before, now, after, strict=True)]


def extrapolated(name: str, sequence: tuple[int, ...], source: str, aliases: tuple[str, ...] = ()) -> Tableau:
    """The last entry of the scheme over a sequence of numbers of steps; the one before it in its row is embedded.

    Raises:
        ValueError: the numbers are not even, or do not rise.
    """
    if any(steps % 2 for steps in sequence) or list(sequence) != sorted({0, *sequence})[1:]:
        raise ValueError(f"{name}: the numbers of steps are {sequence}; even ones that rise are accepted.")
    stages = 1 + sum(sequence)
    rows: list[Weights] = [[Q(0)] * stages]
    columns: list[Weights] = []
    for k, steps in enumerate(sequence):
        states, entry = _midpoint(steps, len(rows), stages)
        rows += states
        row = [entry]
        for earlier, previous in zip(reversed(sequence[:k]), columns, strict=True):
            factor = 1 / (Q(steps, earlier) ** 2 - 1)
            row.append([new + factor * (new - old) for new, old in zip(row[-1], previous, strict=True)])
        columns = row
    return Tableau(
        name=name, order=2 * len(sequence), source=source,
        a=tuple(tuple(row[:i]) for i, row in enumerate(rows)),
        b=tuple(columns[-1]),
        embedded=(Embedded(2 * len(sequence) - 2, tuple(columns[-2])),),
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
