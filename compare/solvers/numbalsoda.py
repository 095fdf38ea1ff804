"""numbalsoda: LSODA and DOP853 on equations that numba has compiled.

An equation as Python source, for compilers of Python that cannot read one with the arithmetic as an argument.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import LARGEST, RMS, Answer, Question, Solver, SolverError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

__all__ = ["SOLVERS", "SOURCE", "Term"]


class Term:
    """A piece of source; arithmetic on it writes longer pieces."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __str__(self) -> str:
        return self.text

    def _with(self, operator: str, other: Any) -> Term:
        return Term(f"({self} {operator} {other})")

    def _after(self, operator: str, other: Any) -> Term:
        return Term(f"({other} {operator} {self})")

    def __neg__(self) -> Term:
        return Term(f"(-{self})")

    def __add__(self, other: Any) -> Term:
        return self._with("+", other)

    def __radd__(self, other: Any) -> Term:
        return self._after("+", other)

    def __sub__(self, other: Any) -> Term:
        return self._with("-", other)

    def __rsub__(self, other: Any) -> Term:
        return self._after("-", other)

    def __mul__(self, other: Any) -> Term:
        return self._with("*", other)

    def __rmul__(self, other: Any) -> Term:
        return self._after("*", other)

    def __truediv__(self, other: Any) -> Term:
        return self._with("/", other)

    def __rtruediv__(self, other: Any) -> Term:
        return self._after("/", other)

    def __pow__(self, other: Any) -> Term:
        return self._with("**", other)


def _called(name: str) -> Callable[[Any], Term]:
    """The function of this name in the module ``math``, applied to a piece of source."""
    return lambda x: Term(f"math.{name}({x})")


class Source:
    """The arithmetic whose numbers are pieces of source that use the module ``math``."""

    time = Term("t")

    sin = staticmethod(_called("sin"))
    cos = staticmethod(_called("cos"))
    tan = staticmethod(_called("tan"))
    asin = staticmethod(_called("asin"))
    acos = staticmethod(_called("acos"))
    atan = staticmethod(_called("atan"))
    sinh = staticmethod(_called("sinh"))
    cosh = staticmethod(_called("cosh"))
    tanh = staticmethod(_called("tanh"))
    exp = staticmethod(_called("exp"))
    log = staticmethod(_called("log"))
    sqrt = staticmethod(_called("sqrt"))

    @staticmethod
    def number(value: Fraction) -> Term:
        return Term(repr(float(value)))

    @staticmethod
    def pi() -> Term:
        return Term("math.pi")

    @staticmethod
    def power(x: Any, exponent: Fraction) -> Term:
        return Term(f"({x} ** {float(exponent)!r})")


SOURCE = Source()


FAILED = "success is False"
MAX_STEPS = 1_000_000
"""Steps from one time to the next: numbalsoda's own bound of 10000 is for looser tolerances."""


def _source(question: Question) -> tuple[str, str]:
    """The equations of motion and the event as bodies of functions (t, u, out, data); data[0] counts."""
    names = list(question.problem.parameters)
    parameters = {name: Term(f"data[{place}]") for place, name in enumerate(names, start=1)}
    state = [Term(f"u[{i}]") for i in range(len(question.start))]
    rates = question.problem.derivative(SOURCE, SOURCE.time, state, parameters)
    lines = [f"out[{i}] = {rate}" for i, rate in enumerate(rates)]
    event = f"out[0] = {question.happens(SOURCE, state)}" if question.event else "pass"
    return "\n    ".join(["data[0] += 1.0", *lines]), event


@lru_cache(maxsize=8)
def _compiled(body: str) -> Any:
    """A body as a numba cfunc of numbalsoda's signature."""
    from numba import cfunc
    from numbalsoda import lsoda_sig

    space: dict[str, Any] = {"math": math}
    exec(f"def function(t, u, out, data):\n    {body}\n", space)  # noqa: S102 - the source is written here, from the equation
    return cfunc(lsoda_sig)(space["function"])


def _data(question: Question) -> np.ndarray:
    return np.array([0.0, *question.parameters.values()])


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import numbalsoda

    solve = getattr(numbalsoda, method)
    function = _compiled(_source(question)[0])

    def run() -> Answer:
        data = _data(question)
        states, success = solve(
            function.address,
            question.start,
            question.times,
            data=data,
            rtol=question.rtol,
            atol=question.rtol,
            mxstep=MAX_STEPS,
        )
        if not success:
            raise SolverError(FAILED)
        return Answer(states, int(data[0]), question.rtol)

    run()  # numba compiles the driver now
    return run


def _prepare_lsoda(question: Question) -> Callable[[], Answer]:
    return _prepare(question, "lsoda")


def _prepare_dop853(question: Question) -> Callable[[], Answer]:
    return _prepare(question, "dop853")


def _events(question: Question) -> Sequence[float]:
    from numbalsoda import solve_ivp

    body, event = _source(question)
    data = _data(question)
    found = solve_ivp(
        _compiled(body).address,
        np.array([0.0, question.end]),
        question.start,
        n_events=1,
        event_fcn=_compiled(event).address,
        data=data.ctypes.data,
        rtol=question.rtol,
        atol=question.rtol,
    )
    if not found.success:
        raise SolverError(found.message)
    return [found.t_event] if found.event_found else []


SOLVERS = (
    Solver(
        name="numbalsoda.lsoda",
        package="numbalsoda",
        call="lsoda(f.address, y0, times, data, rtol=rtol, atol=rtol)",
        prepare=_prepare_lsoda,
        tolerance=LARGEST,
    ),
    Solver(
        name="numbalsoda.dop853",
        package="numbalsoda",
        call="dop853(f.address, y0, times, data, rtol=rtol, atol=rtol); its events by solve_ivp(..., event_fcn=...)",
        prepare=_prepare_dop853,
        tolerance=RMS,
        events=_events,
        first_only=True,
    ),
)
