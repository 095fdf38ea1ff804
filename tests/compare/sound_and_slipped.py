"""Random integrators: sound ones of known methods in every form, and the same with one slip."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.methods import METHODS
from compare.methods.kinds.one_step import Splitting, Tableau
from compare.methods.order.algebraic import enclose
from reference import Pendulum
from reference.problems.families import find_family

if TYPE_CHECKING:
    import random
    from collections.abc import Callable

MOST_STAGES = 13


def number(value: Any) -> float:
    return float(enclose(value))


EXPLICIT = [one for one in METHODS if isinstance(one, Tableau) and one.explicit and one.stages <= MOST_STAGES]
IMPLICIT = [one for one in METHODS if isinstance(one, Tableau) and not one.explicit and one.stages <= 3]
SPLITTINGS = [one for one in METHODS if isinstance(one, Splitting) and one.stages <= MOST_STAGES and not one.nystrom]


def problems() -> dict[str, Callable[[random.Random], Any]]:
    """Of each family one with random numbers."""
    return {
        "pendulum": lambda r: Pendulum(round(r.uniform(0.1, 3.0), 3), length=round(r.uniform(0.3, 3.0), 3)),
        "rotating": lambda r: Pendulum(0.3, omega0=round(r.uniform(7, 9), 3)),
        "linear": lambda r: find_family("linear").problem(theta0=round(r.uniform(0.1, 1.0), 3)),
        "henon-heiles": lambda _: find_family("henon-heiles").problem(),
        "lotka-volterra": lambda _: find_family("lotka-volterra").problem(),
        "van-der-pol": lambda r: find_family("van-der-pol").problem(mu=str(round(r.uniform(0.2, 2.0), 2))),
        "lorenz": lambda _: find_family("lorenz").problem(),
        "rigid-body": lambda _: find_family("rigid-body").problem(),
        "duffing": lambda _: find_family("duffing").problem(),
    }


@dataclass(frozen=True)
class Made:
    """A random integrator: a method's numbers, and how they are called."""

    method: Tableau | Splitting
    form: str
    problem: Any
    tolerance: float = 1e-13
    numbers: dict[str, Any] = field(default_factory=dict)
    slip: str = ""
    beside: bool = False

    @property
    def told(self) -> str:
        more = " with all that it has beside" * self.beside
        return f"{self.method.name} as {self.form}{more} on {self.problem!r}{': ' * bool(self.slip)}{self.slip}"

    @property
    def function(self) -> Any:
        return FORMS[self.form](self.numbers, self.tolerance)

    @property
    def claims(self) -> dict[str, Any]:
        found: dict[str, Any] = {"order": self.method.order, "problem": self.problem}
        if isinstance(self.method, Splitting):
            found |= {"symplectic": True, "reversible": self.method.symmetric or None}
        if self.beside:
            found["backward"] = True
        if self.beside and self.form in WITH_ESTIMATES:
            found |= {"dense": min(3, self.method.order), "interpolant": hermite(self.function)}
            if self.method.embedded:
                found["estimate"] = min(self.method.order, self.method.embedded[0].order)
        return found


def numbers_of(method: Tableau | Splitting, *, beside: bool = False) -> dict[str, Any]:
    """Its coefficients as doubles; "e" is what its estimate is made of, None where it gives none beside its state."""
    if isinstance(method, Splitting):
        return {"flows": [(kind, number(weight)) for kind, weight in method.flows]}
    a = np.array([[number(entry) for entry in row] for row in method.matrix])
    b = np.array([number(entry) for entry in method.b])
    pairs = [b - np.array([number(entry) for entry in other.b]) for other in method.embedded[:1] if beside]
    return {"a": a, "b": b, "c": a.sum(axis=1), "e": pairs[0] if pairs else None}


def runge_kutta(numbers, _tolerance):
    a, b, c, e = numbers["a"], numbers["b"], numbers["c"], numbers.get("e")

    def step(f, t, y, h):
        k = []
        for i in range(len(b)):
            z = y
            for j in range(i):
                if a[i, j]:
                    z = z + h * float(a[i, j]) * k[j]
            k.append(f(t + h * float(c[i]), z))
        error = 0 * y
        for weight, slope in zip(b, k, strict=True):
            if weight:
                y = y + h * float(weight) * slope
        for weight, slope in zip(() if e is None else e, k, strict=e is not None):
            error = error + h * float(weight) * slope
        return y if e is None else (y, error)

    return step


def hermite(step):
    """Hermite's cubic between the ends of a step (f, t, y, h), of order 3 where that has it."""

    def between(f, t, y, h, theta):
        found = step(f, t, y, h)
        end = found[0] if isinstance(found, tuple) else found
        first, last = h * f(t, y), h * f(t + h, end)
        bend = (1 - 2 * theta) * (end - y) + (theta - 1) * first + theta * last
        return (1 - theta) * y + theta * end + theta * (theta - 1) * bend

    return between


def untimed(numbers, tolerance):
    timed = runge_kutta(numbers, tolerance)

    def step(f, y, h):
        return timed(lambda _, z: f(z), 0.0, y, h)

    return step


def of_floats(numbers, tolerance):
    """Cannot be traced: it works with Python's floats."""
    timed = runge_kutta(numbers, tolerance)

    def step(f, t, y, h):
        return timed(
            lambda s, z: np.array([float(part) for part in f(s, z)]), t, np.array([float(part) for part in y]), h
        )

    return step


def made_anew(numbers, tolerance):
    timed = runge_kutta(numbers, tolerance)

    class Solver:
        def __init__(self, f, t0, y0, h):
            self.f, self.t, self.y, self.h = f, t0, y0, h

        def step(self):
            self.y = timed(self.f, self.t, self.y, self.h)
            self.t += self.h

    return Solver


def yielding(numbers, tolerance):
    timed = runge_kutta(numbers, tolerance)

    def states(f, t0, y0, h):
        t, y, count = t0, y0, 0
        while True:
            yield t, y
            y = timed(f, t, y, h)
            count += 1
            t = t0 + count * h

    return states


def spanning(numbers, tolerance):
    timed = runge_kutta(numbers, tolerance)

    def solve(fun, t_span, y0, n):
        t = np.linspace(*t_span, n + 1)
        states = [y0]
        for begun in t[:-1]:
            states.append(timed(fun, begun, states[-1], t[1] - t[0]))
        return t, np.array(states)

    return solve


def newton(numbers, tolerance):
    """An implicit method whose stages are iterated until they change by no more than a tolerance."""
    a, b, c = numbers["a"], numbers["b"], numbers["c"]

    def step(f, t, y, h):
        d, s = len(y), len(b)

        def residual(k):
            k = k.reshape(s, d)
            return np.concatenate([k[i] - f(t + c[i] * h, y + h * (a[i] @ k)) for i in range(s)])

        k, size = np.tile(f(t, y), s), np.inf
        for _ in range(50):
            at, nudges = residual(k), 1e-7 * (1 + np.abs(k))
            slopes = [
                (residual(k + nudge * unit) - at) / nudge for nudge, unit in zip(nudges, np.eye(s * d), strict=True)
            ]
            change = np.linalg.solve(np.array(slopes).T, at)
            k, before, size = k - change, size, float(np.max(np.abs(change) / (1 + np.abs(k))))
            if size <= tolerance or (size < 1e-9 and size >= before):
                break
        return y + h * (b @ k.reshape(s, d))

    return step


def splitting(numbers, _tolerance):
    def step(q, p, force, h):
        for kind, weight in numbers["flows"]:
            if kind == "kick":
                p = p + weight * h * force(q)
            else:
                q = q + weight * h * p
        return q, p

    return step


def of_a_potential(numbers, _tolerance):
    def step(q, p, grad_v, h):
        for kind, weight in numbers["flows"]:
            if kind == "kick":
                p = p - weight * h * grad_v(q)
            else:
                q = q + weight * h * p
        return q, p

    return step


FORMS: dict[str, Callable[..., Any]] = {
    "timed": runge_kutta,
    "step": untimed,
    "floats": of_floats,
    "class": made_anew,
    "generator": yielding,
    "solver": spanning,
    "newton": newton,
    "separable": splitting,
    "gradient": of_a_potential,
}
WITH_ESTIMATES = ("timed", "floats")
WITH_A_PAST = ("pendulum", "rotating", "linear")
"""Problems whose motion is proven before the start."""
OF_RUNGE_KUTTA = ("timed", "step", "floats", "class", "generator", "solver")
SEPARABLE = ("pendulum", "rotating", "linear", "henon-heiles")


def sound(r: random.Random) -> Made:
    """A method of any kind, in any form, on any problem, with any tolerance of its inner iteration."""
    kind = r.choice(("explicit", "explicit", "splitting", "implicit"))
    known = problems()
    if kind == "splitting":
        method: Any = r.choice(SPLITTINGS)
        form, name = r.choice(("separable", "gradient")), r.choice(SEPARABLE)
    else:
        method = r.choice(EXPLICIT if kind == "explicit" else IMPLICIT)
        form, name = "newton" if kind == "implicit" else r.choice(OF_RUNGE_KUTTA), r.choice(sorted(known))
    beside = name in WITH_A_PAST and form not in {"class", "generator", "solver"} and r.random() < 0.5
    return Made(
        method,
        form,
        known[name](r),
        10.0 ** -r.randint(11, 14),
        numbers_of(method, beside=beside and form in WITH_ESTIMATES),
        beside=beside,
    )


def slipped(r: random.Random) -> Made:
    """One coefficient changed by a part in ten thousand to a tenth, one sign, or one index."""
    found = sound(r)
    while found.form == "newton":
        found = sound(r)
    kind = r.choice(("coefficient", "sign", "index"))
    numbers = {name: value if value is None else value.copy() for name, value in found.numbers.items()}
    if "flows" in numbers:
        told = _slip_of_flows(r, kind, numbers["flows"])
    else:
        told = _slip_of_tableau(r, kind, numbers, timed=found.form != "step")
    return replace(found, numbers=numbers, slip=f"{kind}: {told}") if told else slipped(r)


def _slip_of_flows(r: random.Random, kind: str, flows: list[tuple[str, float]]) -> str:
    i = r.randrange(len(flows))
    name, weight = flows[i]
    if kind == "index":
        j = r.randrange(len(flows))
        flows[i], flows[j] = (name, flows[j][1]), (flows[j][0], weight)
        return f"flows {i} and {j} exchanged" if not math.isclose(flows[i][1], weight) else ""
    factor = -1 if kind == "sign" else 1 + 10 ** r.uniform(-4, -1)
    flows[i] = name, factor * weight
    return f"flow {i} times {factor:.5g}"


def _slip_of_tableau(r: random.Random, kind: str, numbers: dict[str, Any], *, timed: bool) -> str:
    names = [name for name in "abce" if numbers[name] is not None and (timed or name != "c")]
    name = r.choice(names)
    array = numbers[name]
    places = list(zip(*np.nonzero(array), strict=True))
    if not places:
        return ""
    place = r.choice(places)
    before = float(array[place])
    if kind == "index":
        others = [(*place[:-1], k) for k in range(place[0] if name == "a" else len(array)) if k != place[-1]]
        if not others:
            return ""
        other = r.choice(others)
        if math.isclose(array[other], before):
            return ""
        array[place], array[other] = array[other], before
        return f"{name}{[int(k) for k in place]} and {[int(k) for k in other]} exchanged"
    factor = -1 if kind == "sign" else 1 + 10 ** r.uniform(-4, -1)
    array[place] = factor * before
    return f"{name}{[int(k) for k in place]} times {factor:.5g}"
