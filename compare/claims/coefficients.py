"""The coefficients of an explicit step, read off the step itself, and which of them is not what it should be.

A Runge-Kutta method asks f at Y_i = y + h sum_j a_ij k_j and gives y + h sum_i b_i k_i.  Given y = 0, h = 1 and the
i-th unit vector for k_i, what it asks are the rows of its tableau, what it gives are the weights, and the times at
which it asks are the nodes.  A splitting is read in the same way, from momenta that are a unit vector of their own.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.engine import Lanes
from compare.methods import METHODS
from compare.methods.kinds.one_step import Splitting, Tableau
from compare.methods.order.algebraic import enclose
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.frames import Scene

__all__ = ["slip"]

MOST = 40
"""Stages, at most."""
SAME, ALIKE = 1e-11, 1e-9
"""Coefficients that differ by less are the same, and states that a step gives."""
STEPS = 1.0, 2.0, 3.0
"""Of h, from which it is seen how a coefficient goes with it."""
FEW = 2
"""A method with no more coefficients than these beside those of a known one is that one with a slip."""
CONDITIONS = 6
"""Up to this order the first condition is named that does not hold."""


@dataclass(frozen=True)
class _Read:
    """What was read: by name each coefficient with h = 1, and how those of them that do not go with h go."""

    values: dict[str, float]
    by_square: tuple[str, ...]
    nodes: tuple[float, ...] | None
    rows: tuple[tuple[float, ...], ...]


def slip(candidate: Candidate, scene: Scene, order: float) -> str | None:
    """Which coefficient of a step is wrong, if that is known; ``order`` is the one that it should have."""
    try:
        read = _splitting(candidate) if candidate.form.separable else _tableau(candidate)
    except (ValueError, TypeError, IndexError):  # it makes no sense of such a state, or gives none back
        return None
    if read is None:
        return None
    if read.by_square:
        return f"{read.by_square[0]}, where it should go with h"
    if not _is_that_method(candidate, scene, read):
        return None
    if not candidate.form.separable and (told := _wrong_time(read)):
        return told
    return _near_a_known_one(read, order, splitting=candidate.form.separable) or _condition(read, order)


class _Probe:
    """In the place of f: its answers are unit vectors, from the first index on."""

    def __init__(self, first: int) -> None:
        self.questions: list[np.ndarray] = []
        self.times: list[float | None] = []
        self._first = first

    def __call__(self, *arguments: Any) -> np.ndarray:
        state = next(one for one in arguments if np.ndim(one) == 1)
        self.times.append(next((float(one) for one in arguments if np.ndim(one) == 0), None))
        self.questions.append(np.array(state, dtype=float))
        answer = np.zeros(len(state))
        answer[self._first + len(self.questions) - 1] = 1
        return answer


def _tableau(candidate: Candidate) -> _Read | None:
    """Of a step (f, y, h) or (f, t, y, h)."""
    if candidate.form.own or candidate.form.whole:
        return None

    def read(h: float) -> tuple[dict[str, float], _Probe, list[list[float]]]:
        probe = _Probe(0)
        values = {"f": probe, "y": np.zeros(MOST), "h": h, "t": 0.0}
        weights = np.asarray(candidate.called(values), dtype=float)
        count = len(probe.questions)
        rows = [question[:count].tolist() for question in probe.questions]
        found = {f"a_{i + 1}{j + 1}": row[j] for i, row in enumerate(rows) for j in range(i)}
        return found | {f"b_{i + 1}": weights[i] for i in range(count)}, probe, [*rows, weights[:count].tolist()]

    (values, probe, rows), *others = (read(h) for h in STEPS)
    if not values:
        return None
    times = probe.times
    nodes = None if any(t is None for t in times) else tuple(float(t or 0) for t in times)
    return _checked([values, *(other for other, _, _ in others)], nodes, rows)


def _splitting(candidate: Candidate) -> _Read | None:
    """Of a step (q, p, force, h) or (q, p, grad_V, h), as drifts between kicks."""
    sign = -1.0 if "gradient" in candidate.form.roles else 1.0

    def read(h: float) -> dict[str, float]:
        probe = _Probe(1)
        first = np.zeros(MOST)
        first[0] = 1
        values = {"q": np.zeros(MOST), "p": first, "force": probe, "gradient": probe, "h": h}
        q, p = (np.asarray(part) for part in candidate.called(values))
        places = [*(question[0] for question in probe.questions), q[0]]
        drifts = [b - a for a, b in zip([0.0, *places[:-1]], places, strict=True)]
        kicks = [sign * p[1 + i] for i in range(len(probe.questions))]
        return {f"drift {i + 1}": d for i, d in enumerate(drifts)} | {f"kick {i + 1}": k for i, k in enumerate(kicks)}

    values = [read(h) for h in STEPS]
    return _checked(values, None, []) if values[0] else None


def _checked(
    found: Sequence[dict[str, float]], nodes: tuple[float, ...] | None, rows: Sequence[Sequence[float]]
) -> _Read | None:
    """What was read with h = 1, 2 and 3: a h + b h^2 each, b zero as it should be; None where it is no such method."""
    values, twice, thrice = found
    if not values.keys() == twice.keys() == thrice.keys():
        return None
    if not all(np.isfinite(value) for one in found for value in one.values()):
        return None
    by_square = []
    for name, one in values.items():
        linear, square = (4 * one - twice[name]) / 2, (twice[name] - 2 * one) / 2
        if not _same(thrice[name], 3 * linear + 9 * square):
            return None
        if not _same(square, 0):
            by_square.append(f"{name} goes {'' if _same(linear, 0) else 'in part '}with h^2")
    return _Read(values, tuple(by_square), nodes, tuple(map(tuple, rows)))


def _is_that_method(candidate: Candidate, scene: Scene, read: _Read) -> bool:
    """Whether these coefficients make the step on the motion too: it may treat its components in different ways."""
    h, y = scene.step, scene.start
    found = Lanes(candidate, scene).one(y, h, 0.0)
    with np.errstate(all="ignore"):
        again = _stepped(scene, read, y, h) if read.rows else _flowed(scene, read, y, h)
    return bool(np.all(np.abs(found - again) <= ALIKE * (1 + np.abs(found))))


def _rates(scene: Scene, t: float, y: np.ndarray) -> np.ndarray:
    return np.array(scene.rates(NUMPY, t, tuple(y)))


def _stepped(scene: Scene, read: _Read, y: np.ndarray, h: float) -> np.ndarray:
    """A Runge-Kutta step."""
    slopes: list[np.ndarray] = []
    nodes = read.nodes or (0.0,) * (len(read.rows) - 1)
    for node, row in zip(nodes, read.rows, strict=False):
        stage = y + h * sum((a * k for a, k in zip(row, slopes, strict=False)), np.zeros(len(y)))
        slopes.append(_rates(scene, node * h, stage))
    found: np.ndarray = y + h * sum((b * k for b, k in zip(read.rows[-1], slopes, strict=True)), np.zeros(len(y)))
    return found


def _flowed(scene: Scene, read: _Read, y: np.ndarray, h: float) -> np.ndarray:
    """A step of drifts and kicks in turn, of q' = p."""
    y, half = y.copy(), scene.problem.positions
    kicks = [weight for name, weight in read.values.items() if name.startswith("kick")]
    drifts = [weight for name, weight in read.values.items() if name.startswith("drift")]
    for drift, kick in zip(drifts, [*kicks, 0.0], strict=True):
        y[:half] += h * drift * y[half:]
        y[half:] += h * kick * _rates(scene, 0.0, y)[half:]
    return y


def _same(one: float, other: float) -> bool:
    return abs(one - other) <= SAME * (1 + abs(other))


def _wrong_time(read: _Read) -> str | None:
    """A stage that is taken at another time than its own."""
    if read.nodes is None:
        return None
    for i, (node, row) in enumerate(zip(read.nodes, read.rows, strict=False)):
        if not _same(node, sum(row)):
            return f"stage {i + 1} is taken at the time t + {node:.6g} h, and is the state at t + {sum(row):.6g} h"
    return None


def _near_a_known_one(read: _Read, order: float, *, splitting: bool) -> str | None:
    """The coefficients that a known method of that order has otherwise, if they are few."""
    best: tuple[int, str] | None = None
    for name, its_order, known in _known(splitting=splitting):
        if known.keys() != read.values.keys() or its_order < order:
            continue
        off = [one for one, value in known.items() if not _same(read.values[one], float(enclose(value)))]
        if 0 < len(off) <= FEW and 2 * len(off) < len(known) and (best is None or len(off) < best[0]):
            told = ", ".join(
                f"{one} is {read.values[one]:.6g}, which is {_written(known[one])} in {name}" for one in off
            )
            best = len(off), told
    return None if best is None else best[1]


def _written(value: Any) -> str:
    """A coefficient as it is printed."""
    short = isinstance(value, Fraction) and len(str(value)) <= len("123/4567")
    return str(value) if short else f"{float(enclose(value)):.10g}"


@cache
def _known(*, splitting: bool) -> tuple[tuple[str, int, dict[str, Any]], ...]:
    """The coefficients of the methods that are known, by the same names."""
    if splitting:
        plain = [one for one in METHODS if isinstance(one, Splitting) and not one.linear_velocities_only]
        return tuple((one.name, one.order, _of_flows(one)) for one in plain)
    found = []
    for one in METHODS:
        if isinstance(one, Tableau) and one.explicit:
            for used in {one.used, tuple(range(one.stages))}:
                a = {f"a_{i + 1}{j + 1}": one.matrix[k][used[j]] for i, k in enumerate(used) for j in range(i)}
                found.append((one.name, one.order, a | {f"b_{i + 1}": one.b[k] for i, k in enumerate(used)}))
    return tuple(found)


def _of_flows(method: Splitting) -> dict[str, Any]:
    drifts: list[Any] = [Fraction(0)]
    kicks = []
    for kind, weight in method.flows:
        if kind == "kick":
            kicks.append(weight)
            drifts.append(Fraction(0))
        else:
            drifts[-1] = drifts[-1] + weight
    return {f"drift {i + 1}": d for i, d in enumerate(drifts)} | {f"kick {i + 1}": k for i, k in enumerate(kicks)}


def _condition(read: _Read, order: float) -> str | None:
    """The first order condition that does not hold, in the words of the field."""
    totals = {
        kind: sum(v for name, v in read.values.items() if name.startswith(kind)) for kind in ("b_", "kick", "drift")
    }
    for kind, words in (("b_", "the weights b"), ("kick", "the kicks"), ("drift", "the drifts")):
        if any(name.startswith(kind) for name in read.values) and not _same(totals[kind], 1):
            return f"{words} sum to {totals[kind]:.6g}, and not to 1"
    if not read.rows:
        return None
    weights = ElementaryWeights(read.rows[:-1])
    for vertices in range(2, min(int(order), CONDITIONS) + 1):
        for tree in trees(vertices):
            value = float(weights.weight(read.rows[-1], tree))
            if not _same(value, 1 / density(tree)):
                return f"a condition of order {vertices} has {value:.6g} in the place of 1/{density(tree)}"
    return None
