"""What there is to know of a method: its coefficients as tables, and facts that follow from them.

An exact coefficient as it is read: its closed form where it has one, its decimal, its LaTeX.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.methods.kinds.multistep import LinearMultistep, PredictorCorrector
from compare.methods.kinds.nystrom import RungeKuttaNystrom
from compare.methods.kinds.one_step import Processed, Splitting, Tableau
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.kinds.stormer import StormerCowell
from compare.methods.order.algebraic import Algebraic
from compare.methods.order.conditions import (
    generalised_order,
    order_of_nystrom,
    order_of_rosenbrock,
    order_of_splitting,
    order_of_tableau,
    proven_order,
)
from compare.methods.order.stability import Stability, stability_of_rosenbrock
from reference.arithmetic.limbs import decimal, exact_decimal, fixed, interval, ziv

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.methods.kinds.protocol import Method
    from compare.methods.order.algebraic import Coefficient

__all__ = [
    "DIGITS",
    "Butcher",
    "Description",
    "Rows",
    "closed_form",
    "decimal_form",
    "describe",
    "exact_form",
    "latex_form",
]

DIGITS = 25
"""Significant digits of a decimal."""
LONG_DENOMINATOR, MOST_PLACES = 10**5, 80


def closed_form(value: Coefficient) -> str:
    """The number exactly, such as "1/6" or "5/36 - sqrt(15)/30"; of a proven zero's coordinate, its decimal."""
    exact = exact_form(value)
    return decimal_form(value) if exact is None else exact


def exact_form(value: Coefficient) -> str | None:
    """The number exactly, or None where it has no closed form."""
    if isinstance(value, (int, Fraction)):
        return _rational(Fraction(value))
    if value.rational is not None:
        return _rational(value.rational)
    return repr(value) if isinstance(value, Algebraic) else None


def _rational(value: Fraction) -> str:
    """A fraction, or where it is one of many digits that ends as a decimal, this."""
    if value.denominator > LONG_DENOMINATOR:
        places = next((n for n in range(6, MOST_PLACES) if 10**n % value.denominator == 0), None)
        if places is not None:
            return fixed(value, places)
    return str(value)


def decimal_form(value: Coefficient, digits: int = DIGITS) -> str:
    """The decimal of so many digits, proven correctly rounded."""
    if isinstance(value, (int, Fraction)):
        text = exact_decimal(Fraction(value), digits)
        return text.rstrip("0").rstrip(".") if "." in text and "e" not in text else text
    if value.rational is not None:
        return decimal_form(value.rational, digits)
    ((found,),) = ziv(
        lambda _: [[value.ball()]], lambda ball: decimal(interval(ball), digits), 1, 4 * digits + 40, repr(value)
    )
    return found


def latex_form(value: Coefficient) -> str:
    r"""The number in LaTeX's mathematics, such as \frac{5}{36} - \frac{\sqrt{15}}{30}."""
    text = closed_form(value)
    if exact_form(value) is None:
        return text
    text = re.sub(r"\*(?=\d)", r" \\cdot ", text).replace("*", "")
    text = re.sub(r"\^\((\d+/\d+)\)", r"^{\1}", text)
    text = re.sub(r"sqrt\((\d+)\)", r"\\sqrt{\1}", text)
    text = re.sub(r"r\^(\d+)", r"r^{\1}", text)
    return re.sub(r"(-?)((?:[^\s/{}-]|\{[^{}]*\})+)/(\d+)", r"\1\\frac{\2}{\3}", text)


DERIVED = {"symmetric": "symmetric", "fsal": "FSAL", "zero_stable": "zero-stable"}
"""Properties that some kinds of methods derive, and what they are called."""


@dataclass(frozen=True)
class Butcher:
    """A Butcher array: nodes, a square matrix, and rows of weights with the names they go by."""

    title: str
    nodes: tuple[Coefficient, ...]
    matrix: tuple[tuple[Coefficient, ...], ...]
    weights: tuple[tuple[str, tuple[Coefficient, ...]], ...]


@dataclass(frozen=True)
class Rows:
    """Coefficients one after another: the heads of the columns, and rows of words and coefficients."""

    title: str
    heads: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]


@dataclass(frozen=True)
class Description:
    """A method as it is shown.

    Attributes:
        name: of the method.
        facts: labels and values: booleans, numbers, strings, tuples of them or None, in the order of reading.
        tables: its coefficients.
    """

    name: str
    facts: tuple[tuple[str, Any], ...]
    tables: tuple[Butcher | Rows, ...]


def describe(method: Method) -> Description:
    """All that is shown of a method."""
    facts = [
        ("family", method.family),
        *_formula(method),
        *_orders(method),
        ("stages", method.stages),
        *_evaluations(method),
        *_iterations(method),
        ("symplectic", method.symplectic),
        *((label, getattr(method, name)) for name, label in DERIVED.items() if hasattr(method, name)),
        *_stability(method),
        *_needs(method),
        *_roots(method),
        ("aliases", method.aliases),
        ("source", method.source),
    ]
    return Description(method.name, tuple(facts), tuple(_tables(method)))


def _formula(method: Method) -> Iterator[tuple[str, str]]:
    """What a step does, where a method says so in words because it has no table."""
    if hasattr(method, "formula"):
        yield "step", method.formula


def _orders(method: Method) -> Iterator[tuple[str, Any]]:
    yield "order", method.order
    yield "proven order", proven_order(method)
    if isinstance(method, Tableau) and method.residual:
        yield "order conditions missed by at most", float(method.residual)
    if isinstance(method, Splitting) and method.nystrom and not method.linear_velocities_only:
        yield "proven order where velocities are not linear", order_of_splitting(replace(method, nystrom=False))
    if isinstance(method, Splitting) and method.generalised:
        yield "generalised order, where kicks are small", method.generalised
        yield "proven generalised order", generalised_order(method)
    if isinstance(method, Tableau) and method.embedded:
        yield "proven embedded orders", tuple(order_of_tableau(method, other.b) for other in method.embedded)
    if isinstance(method, RungeKuttaNystrom):
        yield "proven embedded orders", tuple(order_of_nystrom(method, other) for other in method.embedded)
    if isinstance(method, Rosenbrock) and method.embedded:
        yield "proven embedded orders", tuple(order_of_rosenbrock(method, other.b) for other in method.embedded)


def _evaluations(method: Method) -> Iterator[tuple[str, int]]:
    (once, start), (twice, _) = method.evaluations(1), method.evaluations(2)
    if twice > once:
        yield "evaluations with one iteration", once
        yield "evaluations per further iteration", twice - once
    else:
        yield "evaluations per step", once
    if start:
        yield "evaluations at the start", start
    if isinstance(method, Splitting) and method.linear_velocities_only:
        yield "derivatives of the force along itself per step", method.jacobians(1)
    if isinstance(method, Rosenbrock):
        yield "Jacobians per step", method.jacobians(0)


def _iterations(method: Method) -> Iterator[tuple[str, str]]:
    if isinstance(method, Tableau) and not method.explicit:
        yield "stages solved by", method.solved_by


def _stability(method: Method) -> Iterator[tuple[str, bool]]:
    if isinstance(method, Rosenbrock):
        stability = stability_of_rosenbrock(method)
    elif isinstance(method, Tableau) and not method.explicit:
        stability = Stability(method.matrix, method.b)
    else:
        return
    yield "A-stable", stability.a_stable
    yield "L-stable", stability.l_stable


def _needs(method: Method) -> Iterator[tuple[str, str]]:
    if method.separable_only:
        linear = method.linear_velocities_only or getattr(method, "nystrom", False)
        yield "needs", f"positions apart from momenta{', and velocities linear in the momenta' if linear else ''}"
    elif isinstance(method, Rosenbrock) or (isinstance(method, Tableau) and method.jacobians(2)):
        yield "needs", "the Jacobian of f"


def _roots(method: Method) -> Iterator[tuple[str, str]]:
    """What r is, where coefficients are polynomials in a root that has no name of its own."""
    weights: Sequence[Coefficient] = ()
    if isinstance(method, Splitting):
        weights = [weight for _, weight in method.flows]
    elif isinstance(method, Tableau):
        weights = [entry for row in method.a for entry in row]
    for field in {weight.field for weight in weights if isinstance(weight, Algebraic)}:
        if field.powers[0] == "r":
            powers = ["", *(f"*{power}" for power in (*field.powers, f"r^{field.degree}"))]
            terms = [f"{value}{power}" for value, power in zip(field.coefficients, powers, strict=True) if value]
            polynomial = " + ".join(reversed(terms)).replace("+ -", "- ")
            yield "r", f"{decimal_form(field.generator)}, where {polynomial} = 0"


def _tables(method: Method) -> Iterator[Butcher | Rows]:
    """The coefficients of a method; of one that is no table, none."""
    if isinstance(method, Tableau):
        weights = [("b", method.b), *((f"b, order {other.order}", other.b) for other in method.embedded)]
        yield Butcher("", method.c, method.matrix, tuple(weights))
    elif isinstance(method, Partitioned):
        yield Butcher("positions", method.c, method.matrix, (("b", method.b),))
        yield Butcher("momenta", tuple(map(_sum, method.hat)), method.hat, (("b", method.b),))
    elif isinstance(method, RungeKuttaNystrom):
        weights = [("b_bar", method.b_bar), ("b", method.b)]
        for other in method.embedded:
            weights += [(f"b_bar, order {other.order}", other.b_bar), (f"b, order {other.order}", other.b)]
        yield Butcher("", method.c, method.matrix, tuple(weights))
    elif isinstance(method, Rosenbrock):
        yield Rows("coefficients of the equations for u", ("coefficient", "value"), tuple(_of_rosenbrock(method)))
    elif isinstance(method, Splitting):
        yield from _flows(method)
    elif isinstance(method, PredictorCorrector):
        yield _steps("predictor", method.predictor)
        yield _steps("corrector", method.corrector)
    elif isinstance(method, (LinearMultistep, StormerCowell)):
        yield _steps("", method)
        if isinstance(method, StormerCowell):
            velocity = tuple((-j, weight) for j, weight in enumerate(method.of_velocity))
            yield Rows("weights of the forces in the velocity", ("step", "w"), velocity)


def _flows(method: Splitting) -> Iterator[Rows]:
    """Of a splitting; of one with a processor that and its kernel."""
    heads = ("flow", "weight")
    if isinstance(method, Processed):
        yield Rows("processor, undone behind the kernel", heads, method.processor)
        yield Rows("kernel", heads, method.kernel)
    else:
        yield Rows("flows, in the order in which they are applied", heads, method.flows)


def _of_rosenbrock(method: Rosenbrock) -> Iterator[tuple[str, Coefficient]]:
    """Each by its name; of a and c those that are not zero."""
    yield "gamma", method.gamma
    for letter, rows in (("a", method.a), ("c", method.c)):
        for i, row in enumerate(rows, start=1):
            yield from ((f"{letter}[{i},{j}]", value) for j, value in enumerate(row, start=1) if value != 0)
    for title, weights in (("m", method.m), *((f"m, order {other.order}", other.b) for other in method.embedded)):
        yield from ((f"{title}[{i}]", value) for i, value in enumerate(weights, start=1))


def _sum(row: Sequence[Any]) -> Any:
    return sum(row[1:], row[0])


def _steps(title: str, method: LinearMultistep | StormerCowell) -> Rows:
    """alpha and beta by step, the new one 1 and the present 0."""
    first = 2 - len(method.alpha)
    pairs = zip(method.alpha, method.beta, strict=True)
    return Rows(title, ("step", "alpha", "beta"), tuple((first + j, *pair) for j, pair in enumerate(pairs)))
