"""Functions on a step, each by a polynomial and a bound: f(s) for 0 <= s <= 1 lies within a remainder of S(s).

An equation is read once, with the nodes of a ``Tape`` for numbers.  Each node then serves every step: from the
coefficients of its operands follows its own next one, rounded, about which nothing is claimed; and from its operands'
polynomials and remainders its own remainder, which is proven, whatever the coefficients are.

A node claims of *any* function f that is what its operation makes of functions within its operands' remainders, and of
constants within their balls, that |f(s) - S(s)| <= r for every s of [0, 1].  Nothing else about f is used: it need not
be continuous.  With ||S|| for the sum of the |S_k|, and S exact, the rules are those of docs/flows.md, by number.
"""

from __future__ import annotations

import math
from fractions import Fraction
from operator import mul
from typing import TYPE_CHECKING, Any

from flint import arb, arb_poly, arb_series

from reference.arithmetic.balls import BALL
from reference.arithmetic.precision import ctx
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

__all__ = [
    "BOUND_BITS",
    "Function",
    "ModelArithmetic",
    "Node",
    "RefusedError",
    "Tape",
    "Variable",
    "bound",
    "rounded",
    "supremum",
]

BOUND_BITS = 64
"""Bounds are balls of so many bits, whose exponents have no end: nothing overflows, and nothing underflows to zero."""


NUMBERS = (int, float, arb)
"""What a constant may be: a float is its exact value."""


class RefusedError(ArithmeticError):
    """A rule has no answer on this step, or one of so many bits of roundings: a shorter one may have a better one."""

    def __init__(self, why: str, roundings: float = math.inf) -> None:
        super().__init__(why)
        self.roundings = roundings


def bound(value: arb) -> arb:
    """An exact number that is at least every point of the ball, which is of something that is not negative.

    Raises:
        RefusedError: the ball is not finite.
    """
    if not value.is_finite():
        raise RefusedError("a bound is not finite")
    return value.upper()


def total(values: Iterable[arb]) -> arb:
    """A bound of the sum of all |values|, at the precision in force."""
    return bound(sum((value.abs_upper() for value in values), arb(0)))


class Tape:
    """The nodes of an equation in the order in which they were made: operands stand before what is made of them."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._made: dict[Any, Node] = {}

    def once(self, kind: type[Node], *operands: Any) -> Node:
        """The node of an operation on these operands, which is made only once."""
        key = (kind, *operands)
        if key not in self._made:
            self._made[key] = kind(self, *operands)
        return self._made[key]

    def combined(self, constant: arb, parts: dict[Node, arb]) -> Any:
        """The constant and these multiples of nodes together; a number where there are none."""
        parts = {node: factor for node, factor in parts.items() if not factor.is_zero()}
        if not parts:
            return constant
        if len(parts) == 1 and constant.is_zero():
            ((node, factor),) = parts.items()
            if factor == 1:
                return node
        return Combination(self, constant, parts)

    def keep(self, wanted: Iterable[Any]) -> None:
        """Drop what none of these is made of, such as the value of a Hamiltonian of which the slopes are wanted."""
        needed: set[Node] = set()
        waiting = [node for node in wanted if isinstance(node, Node)]
        while waiting:
            node = waiting.pop()
            if node not in needed:
                needed.add(node)
                waiting += node.operands
        self.nodes = [node for node in self.nodes if node in needed]

    def begin(self) -> None:
        """Forget all coefficients."""
        for node in self.nodes:
            node.forget()
            node.terms = []

    def grow(self, k: int) -> None:
        """Give every node its k-th coefficient; those before it are known."""
        for node in self.nodes:
            node.terms.append(node.coefficient(k))

    def fill(self, order: int) -> None:
        """Give every node its coefficients up to the order, where those of the variables are known beforehand."""
        with ctx.worklength(order + 1):
            for node in self.nodes:
                node.fill(order)

    def scale(self, powers: Sequence[arb]) -> None:
        """Replace each polynomial by S(h s), of which ``powers`` are the powers of h; they are rounded."""
        for node in self.nodes:
            node.forget()
            node.terms = [term.mid() for term in map(mul, node.terms, powers)]

    def close(self, remainders: Sequence[arb]) -> None:
        """Bound every node's remainder, those of the variables being given.

        Raises:
            RefusedError: a rule has no answer on this step.
        """
        given = iter(remainders)
        for node in self.nodes:
            node.remainder = next(given) if isinstance(node, Variable) else node.proven()
            if not (node.remainder.is_finite() and node.remainder >= 0):
                raise RefusedError(f"the remainder of a {type(node).__name__.lower()} is not finite")


class Function:
    """A number and multiples of nodes together: sums and multiples are no nodes until they are operands."""

    tape: Tape
    constant: arb
    parts: dict[Node, arb]

    @property
    def node(self) -> Node:
        """The node of this function."""
        order = sorted(self.parts, key=lambda node: node.place)
        return self.tape.once(Linear, _Told(self.constant), *((node, _Told(self.parts[node])) for node in order))

    def factored(self) -> tuple[arb, Node]:
        """A number and a node of which it is the product."""
        first = min(self.parts, key=lambda node: node.place)
        if len(self.parts) == 1 and self.constant.is_zero():
            return self.parts[first], first
        return (arb(-1), (-self).node) if self.parts[first] < 0 else (arb(1), self.node)

    def times(self, value: Any) -> Any:
        """A multiple by a number."""
        return self.tape.combined(self.constant * value, {node: one * value for node, one in self.parts.items()})

    def _inverse(self) -> Any:
        factor, node = self.factored()
        return self.tape.once(Inverse, node).times(1 / factor)

    def __add__(self, other: Any) -> Any:
        if isinstance(other, NUMBERS):
            return self.tape.combined(self.constant + other, self.parts)
        if not isinstance(other, Function):
            return NotImplemented
        parts = dict(self.parts)
        for node, factor in other.parts.items():
            parts[node] = parts[node] + factor if node in parts else factor
        return self.tape.combined(self.constant + other.constant, parts)

    def __neg__(self) -> Any:
        return self.times(-1)

    def __sub__(self, other: Any) -> Any:
        return self + -other if isinstance(other, (Function, *NUMBERS)) else NotImplemented

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, NUMBERS):
            return self.times(other)
        if not isinstance(other, Function):
            return NotImplemented
        factor, node = self.factored()
        its_factor, its_node = other.factored()
        if node is its_node:
            return self.tape.once(Square, node).times(factor * its_factor)
        first, second = sorted((node, its_node), key=lambda one: one.place)
        return self.tape.once(Product, first, second).times(factor * its_factor)

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, NUMBERS):
            return self.times(1 / _ball(other))
        return self * other._inverse() if isinstance(other, Function) else NotImplemented

    def __rtruediv__(self, other: Any) -> Any:
        return self._inverse() * other

    def __pow__(self, power: int) -> Any:
        """f to a whole power, by products."""
        if not isinstance(power, int):
            raise TypeError(f"the power {power!r} is no integer; m.power takes fractions.")
        if power < 1:
            return 1 / self**-power if power else BALL.number(Fraction(1))
        if power == 1:
            return self
        half = self ** (power // 2)
        square = half * half
        return square * self if power % 2 else square

    def __bool__(self) -> bool:
        raise TypeError("an equation of a flow takes no branches, since a step may be on both sides of one")

    def __float__(self) -> float:
        raise TypeError("it asks for a float; functions are those of its arithmetic, such as m.sin")

    __abs__ = __gt__ = __lt__ = __ge__ = __le__ = lambda self, *_others: bool(self)

    __radd__ = __add__
    __rmul__ = __mul__


class Combination(Function):
    """Some of nodes, and a number."""

    def __init__(self, tape: Tape, constant: arb, parts: dict[Node, arb]) -> None:
        self.tape, self.constant, self.parts = tape, constant, parts


class Node(Function):
    """A function on the step: the coefficients of its polynomial, exact, and the bound of its distance from that."""

    def __init__(self, tape: Tape) -> None:
        self.tape, self.constant, self.parts = tape, arb(0), {self: arb(1)}
        self.terms: list[arb] = []
        self.remainder = arb(0)
        self.place = len(tape.nodes)
        tape.nodes.append(self)

    @property
    def node(self) -> Node:
        return self

    @property
    def operands(self) -> list[Node]:
        """The nodes that it is made of."""
        return [one for one in vars(self).values() if isinstance(one, Node)]

    def coefficient(self, k: int) -> arb:
        """The next coefficient, from those of the operands up to the k-th, rounded to an exact number."""
        raise NotImplementedError

    def fill(self, order: int) -> None:
        """All coefficients up to the order, those of the operands being known."""
        raise NotImplementedError

    @cached_property
    def residual(self) -> arb:
        """What the polynomial misses its operation on those of the operands by, as the rule measures it."""
        raise NotImplementedError

    def remaining(self, residual: arb) -> arb:
        """The remainder, from that and the remainders of the operands, in bounds."""
        raise NotImplementedError

    def proven(self) -> arb:
        """A bound of the remainder; polynomials are of the precision in force."""
        residual = self.residual
        with ctx.workprec(BOUND_BITS):
            return bound(self.remaining(residual))

    def forget(self) -> None:
        """The coefficients are others: what was made of them goes."""
        for name in ("polynomial", "norm", "swing", "slopes", "made", "residual"):
            self.__dict__.pop(name, None)

    @cached_property
    def polynomial(self) -> arb_poly:
        """S."""
        return arb_poly(self.terms)

    @cached_property
    def norm(self) -> arb:
        """||S||."""
        return supremum(self.polynomial)

    @cached_property
    def swing(self) -> arb:
        """A bound of the sum of |S_k| over k >= 1: of |S(s) - S(t)|, and of the integral of |S'|."""
        with ctx.workprec(BOUND_BITS):
            return total(self.terms[1:])

    @cached_property
    def slopes(self) -> list[arb]:
        """The k S_k, of the polynomial so far."""
        return []

    def slope(self, k: int) -> list[arb]:
        """1 S_1, ..., k S_k."""
        while len(self.slopes) < k:
            j = len(self.slopes) + 1
            self.slopes.append((j * self.terms[j]).mid())
        return self.slopes

    @property
    def reach(self) -> arb:
        """A bound of |f| on the step."""
        with ctx.workprec(BOUND_BITS):
            return bound(self.norm + self.remainder)


class _Told:
    """A ball that is known by its numbers: two of the same ones are one operand."""

    def __init__(self, value: arb) -> None:
        self.value = value
        self._key = (value.mid().man_exp(), value.rad().man_exp()) if value.is_finite() else id(value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Told) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


def _ball(value: Any) -> arb:
    return value if isinstance(value, arb) else arb(value)


def _dot(a: Sequence[arb], b: Sequence[arb]) -> arb:
    """a_0 b_n + ... + a_n b_0, of two parts of the same length."""
    return sum(map(mul, a, reversed(b)), arb(0))


def supremum(found: arb_poly) -> arb:
    """||.||, a bound of |S(s)| for |s| <= 1: S of the ball of these s."""
    with ctx.workprec(BOUND_BITS):
        return bound(found(_AROUND).abs_upper())


_AROUND = arb(0, 1)


def rounded(made: arb_poly | arb_series, order: int) -> list[arb]:
    """The coefficients up to the order."""
    found = [term.mid() for term in made.coeffs()[: order + 1]]
    return found + [arb(0)] * (order + 1 - len(found))


def _series(node: Node) -> arb_series:
    """S, in as many terms as it has."""
    return arb_series(node.terms, len(node.terms))


class Variable(Node):
    """A component of the state, or the time: its coefficients and its remainder are given."""

    def __init__(self, tape: Tape, given: Callable[[int], arb]) -> None:
        super().__init__(tape)
        self._given = given

    def coefficient(self, k: int) -> arb:
        return self._given(k)

    def fill(self, order: int) -> None:
        self.terms = [self._given(k) for k in range(order + 1)]


class Linear(Node):
    """c_0 + c_1 f_1 + ..., each c anywhere in a ball (rule 1)."""

    def __init__(self, tape: Tape, constant: _Told, *parts: tuple[Node, _Told]) -> None:
        super().__init__(tape)
        self._constant = constant.value
        self._addends = [(node, told.value) for node, told in parts]
        self._added = [node for node, factor in self._addends if factor == 1]
        self._scaled = [(node, factor.mid()) for node, factor in self._addends if not factor == 1]  # noqa: SIM201 - a ball about one is neither

    @property
    def operands(self) -> list[Node]:
        return [node for node, _ in self._addends]

    def coefficient(self, k: int) -> arb:
        found = sum([node.terms[k] for node in self._added], arb(0) if k else self._constant)
        for node, factor in self._scaled:
            found += factor * node.terms[k]
        return found.mid()

    def fill(self, order: int) -> None:
        self.terms = rounded(self.made, order)

    @cached_property
    def made(self) -> arb_poly:
        """c_0 + c_1 A_1 + ..."""
        return sum((factor * node.polynomial for node, factor in self._addends), arb_poly([self._constant]))

    @cached_property
    def residual(self) -> arb:
        """||c_0 + c_1 A_1 + ... - S||."""
        return supremum(self.made - self.polynomial)

    def remaining(self, residual: arb) -> arb:
        return residual + sum((factor.abs_upper() * f.remainder for f, factor in self._addends), arb(0))


class Product(Node):
    """f g (rule 2): ||AB - S||, of which the degrees beyond the order are what is cut, and a (||B|| + b) + ||A|| b."""

    def __init__(self, tape: Tape, a: Node, b: Node) -> None:
        super().__init__(tape)
        self.a, self.b = a, b

    def coefficient(self, k: int) -> arb:
        return _dot(self.a.terms[: k + 1], self.b.terms[: k + 1]).mid()

    def fill(self, order: int) -> None:
        self.terms = rounded(self.made, order)

    @cached_property
    def made(self) -> arb_poly:
        """AB, in full."""
        return self.a.polynomial * self.b.polynomial

    @cached_property
    def residual(self) -> arb:
        """||AB - S||."""
        return supremum(self.made - self.polynomial)

    def remaining(self, residual: arb) -> arb:
        return residual + self.a.remainder * self.b.reach + self.a.norm * self.b.remainder


class Square(Product):
    """f f."""

    def __init__(self, tape: Tape, a: Node) -> None:
        super().__init__(tape, a, a)

    def coefficient(self, k: int) -> arb:
        return _square(self.a.terms[: k + 1])


def _square(a: Sequence[arb]) -> arb:
    """a_0 a_n + ... + a_n a_0, by half of the products."""
    half = len(a) // 2
    twice = 2 * sum(map(mul, a[:half], reversed(a)), arb(0))
    return (twice + a[half] * a[half] if len(a) % 2 else twice).mid()


class Inverse(Node):
    """1/f (rule 3): with w = ||1 - AS|| + a ||S|| < 1, f has no zero and r = ||S|| w/(1 - w)."""

    def __init__(self, tape: Tape, a: Node) -> None:
        super().__init__(tape)
        self.a = a

    def coefficient(self, k: int) -> arb:
        if k == 0:
            return (1 / self.a.terms[0]).mid()
        return -(_dot(self.a.terms[1 : k + 1], self.terms) * self.terms[0]).mid()

    def fill(self, order: int) -> None:
        self.terms = rounded(1 / _series(self.a), order)

    @cached_property
    def residual(self) -> arb:
        """||1 - AS||."""
        return supremum(self.a.polynomial * self.polynomial - 1)

    def remaining(self, residual: arb) -> arb:
        w = bound(residual + self.a.remainder * self.norm)
        if not w < 1:
            raise RefusedError("a divisor may vanish")
        return self.norm * w / (1 - w)


class Root(Node):
    """The square root of f (rule 4).

    S_0 > 0 and low = S_0 - sum_{k>0} |S_k| > 0, so that S >= low; with w = (||S^2 - A|| + a)/low^2 <= 1 it is
    f = S^2 (1 - v), |v| <= w, and |sqrt(f) - S| <= ||S|| w.
    """

    def __init__(self, tape: Tape, a: Node) -> None:
        super().__init__(tape)
        self.a = a

    def coefficient(self, k: int) -> arb:
        if k == 0:
            return self.a.terms[0].sqrt().mid()
        if k == 1:
            return (self.a.terms[1] / (2 * self.terms[0])).mid()
        return ((self.a.terms[k] - _square(self.terms[1:])) / (2 * self.terms[0])).mid()

    def fill(self, order: int) -> None:
        self.terms = rounded(_series(self.a).sqrt(), order)

    @cached_property
    def residual(self) -> arb:
        """||S^2 - A||."""
        return supremum(self.polynomial * self.polynomial - self.a.polynomial)

    def remaining(self, residual: arb) -> arb:
        low = self.terms[0] - self.swing
        if not low > 0:
            raise RefusedError("what is under a root may vanish")
        w = bound((residual + self.a.remainder) / (low * low))
        if not w <= 1:
            raise RefusedError("what is under a root may vanish")
        return self.norm * w


class Exponential(Node):
    """exp f (rule 5).

    e = exp A - S solves e' = A' e + (A'S - S'), so that |e| <= exp(sum_{k>0} |A_k|) (|e(0)| + integral of |A'S - S'|)
    = t, and |exp f - S| <= t + (exp(a) - 1)(||S|| + t).
    """

    def __init__(self, tape: Tape, a: Node) -> None:
        super().__init__(tape)
        self.a = a

    def coefficient(self, k: int) -> arb:
        if k == 0:
            return self.a.terms[0].exp().mid()
        return (_dot(self.a.slope(k)[:k], self.terms) / k).mid()

    def fill(self, order: int) -> None:
        self.terms = rounded(_series(self.a).exp(), order)

    @cached_property
    def residual(self) -> arb:
        """t: what |exp A - S| is at most."""
        off = _integrated(self.a, self, self)
        start = (self.a.terms[0].exp() - self.terms[0]).abs_upper()
        with ctx.workprec(BOUND_BITS):
            return bound(self.a.swing.exp() * (start + off))

    def remaining(self, residual: arb) -> arb:
        return residual + self.a.remainder.expm1() * (self.norm + residual)


def _integrated(x: Node, factor: Node, found: Node, sign: int = 1) -> arb:
    """A bound of the integral over the step of |sign X'F - S'|, S the polynomial of ``found``."""
    defect = sign * (x.polynomial.derivative() * factor.polynomial) - found.polynomial.derivative()
    with ctx.workprec(BOUND_BITS):
        return bound(sum((term.abs_upper() / (k + 1) for k, term in enumerate(defect.coeffs())), arb(0)))


class _Pair(Node):
    """Two functions of f, each the other's derivative but for a sign: both are made with the first of them."""

    sign: int
    """Of second' = sign f' first."""

    def __init__(self, tape: Tape, a: Node) -> None:
        super().__init__(tape)
        self.a = a
        self.other = Derived(tape, self)

    @staticmethod
    def starts(x: arb) -> tuple[arb, arb]:
        """Both of a number."""
        raise NotImplementedError

    def coefficient(self, k: int) -> arb:
        if k == 0:
            return self.starts(self.a.terms[0])[0].mid()
        return (_dot(self.a.slope(k)[:k], self.other.terms[:k]) / k).mid()

    @staticmethod
    def series(x: arb_series) -> tuple[arb_series, arb_series]:
        """Both of a series."""
        raise NotImplementedError

    def fill(self, order: int) -> None:
        self.terms, self.other.terms = (rounded(one, order) for one in self.series(_series(self.a)))

    def follow(self, k: int) -> arb:
        """The coefficient of the second function."""
        if k == 0:
            return self.starts(self.a.terms[0])[1].mid()
        return (self.sign * _dot(self.a.slope(k)[:k], self.terms[:k]) / k).mid()

    @cached_property
    def residual(self) -> arb:
        """A bound of the integrals of both defects, and of both errors at the start."""
        first, second = self.starts(self.a.terms[0])
        off = _integrated(self.a, self.other, self), _integrated(self.a, self, self.other, self.sign)
        begun = (first - self.terms[0]).abs_upper(), (second - self.other.terms[0]).abs_upper()
        with ctx.workprec(BOUND_BITS):
            return bound(sum((*off, *begun), arb(0)))


class Derived(Node):
    """The second function of a pair."""

    def __init__(self, tape: Tape, pair: _Pair) -> None:
        super().__init__(tape)
        self.pair = pair

    def coefficient(self, k: int) -> arb:
        return self.pair.follow(k)

    def fill(self, order: int) -> None:
        """Its pair has given them."""

    def proven(self) -> arb:
        return self.pair.remainder


class Circular(_Pair):
    """sin f and cos f (rule 6).

    The errors of the pair turn with A and are pushed by the defects, so both are at most their starts and the defects'
    integrals together; and neither function moves by more than f does.
    """

    sign = -1

    @staticmethod
    def starts(x: arb) -> tuple[arb, arb]:
        return x.sin(), x.cos()

    @staticmethod
    def series(x: arb_series) -> tuple[arb_series, arb_series]:
        return x.sin_cos()  # type: ignore[no-any-return]

    def remaining(self, residual: arb) -> arb:
        return residual + self.a.remainder


class Hyperbolic(_Pair):
    """sinh f and cosh f (rule 7): the sum and the difference of the errors grow by at most exp(sum_{k>0} |A_k|)."""

    sign = 1

    @staticmethod
    def starts(x: arb) -> tuple[arb, arb]:
        return x.sinh(), x.cosh()

    @staticmethod
    def series(x: arb_series) -> tuple[arb_series, arb_series]:
        grown = x.exp()
        return (grown - 1 / grown) / 2, (grown + 1 / grown) / 2

    def remaining(self, residual: arb) -> arb:
        far = bound(self.a.swing.exp() * residual)
        moved = self.a.remainder.expm1()
        return far + moved * (self.norm + self.other.norm + 2 * far)


class ByDerivative(Node):
    """g(f), g' being known as a node W of the same f (rule 8).

    |g(A) - S| <= |g(A_0) - S_0| + integral of |A'W - S'| + w sum_{k>0} |A_k|, and g moves by at most a (||W|| + w).
    """

    def __init__(self, tape: Tape, a: Node, rate: Node, function: Callable[[arb], arb]) -> None:
        super().__init__(tape)
        self.a, self.rate, self._function = a, rate, function

    def coefficient(self, k: int) -> arb:
        if k == 0:
            return self._function(self.a.terms[0]).mid()
        return (_dot(self.a.slope(k)[:k], self.rate.terms[:k]) / k).mid()

    def fill(self, order: int) -> None:
        moved = (self.a.polynomial.derivative() * self.rate.polynomial).integral()
        self.terms = rounded(moved + self._function(self.a.terms[0]), order)

    @cached_property
    def residual(self) -> arb:
        """|g(A_0) - S_0| and the integral of |A'W - S'|."""
        off = _integrated(self.a, self.rate, self)
        start = (self._function(self.a.terms[0]) - self.terms[0]).abs_upper()
        with ctx.workprec(BOUND_BITS):
            return bound(start + off)

    def remaining(self, residual: arb) -> arb:
        steep = self.rate.remainder * self.a.swing
        return residual + steep + self.a.remainder * self.rate.reach


class ModelArithmetic:
    """An arithmetic of nodes on a tape; a constant stays a ball."""

    def __init__(self, tape: Tape) -> None:
        self.tape = tape
        self._known: dict[tuple[str, Node], Node] = {}

    @staticmethod
    def number(value: Fraction) -> arb:
        return BALL.number(value)

    @staticmethod
    def pi() -> arb:
        return arb.pi()

    def _pair(self, x: Any, kind: type[_Pair]) -> Node:
        return self.tape.once(kind, x.node)

    def sin(self, x: Any) -> Any:
        return self._pair(x, Circular) if isinstance(x, Function) else _ball(x).sin()

    def cos(self, x: Any) -> Any:
        return self._second(x, Circular) if isinstance(x, Function) else _ball(x).cos()

    def sinh(self, x: Any) -> Any:
        return self._pair(x, Hyperbolic) if isinstance(x, Function) else _ball(x).sinh()

    def cosh(self, x: Any) -> Any:
        return self._second(x, Hyperbolic) if isinstance(x, Function) else _ball(x).cosh()

    def _second(self, x: Function, kind: type[_Pair]) -> Node:
        pair: Any = self._pair(x, kind)
        second: Node = pair.other
        return second

    def tan(self, x: Any) -> Any:
        return self.sin(x) / self.cos(x)

    def tanh(self, x: Any) -> Any:
        return self.sinh(x) / self.cosh(x)

    def exp(self, x: Any) -> Any:
        return self.tape.once(Exponential, x.node) if isinstance(x, Function) else _ball(x).exp()

    def sqrt(self, x: Any) -> Any:
        return self.tape.once(Root, x.node) if isinstance(x, Function) else _ball(x).sqrt()

    def log(self, x: Any) -> Any:
        return self._of(x, "log", lambda a: 1 / a)

    def atan(self, x: Any) -> Any:
        return self._of(x, "atan", lambda a: 1 / (1 + a * a))

    def asin(self, x: Any) -> Any:
        return self._of(x, "asin", lambda a: 1 / self.sqrt(1 - a * a))

    def acos(self, x: Any) -> Any:
        return self._of(x, "acos", lambda a: -1 / self.sqrt(1 - a * a))

    def _of(self, x: Any, name: str, rate: Callable[[Any], Any]) -> Any:
        function = getattr(arb, name)
        if not isinstance(x, Function):
            return function(_ball(x))
        node = x.node
        if (name, node) not in self._known:
            self._known[name, node] = ByDerivative(self.tape, node, rate(node).node, function)
        return self._known[name, node]

    def power(self, x: Any, exponent: Fraction) -> Any:
        """x to a rational power: by products, by a root and products, else exp(e log x)."""
        if not isinstance(x, Function):
            return BALL.power(_ball(x), exponent)
        exponent = Fraction(exponent)
        if exponent.denominator == 1:
            return x**exponent.numerator
        if exponent.denominator == 2:
            return self.sqrt(x) ** exponent.numerator
        return self.exp(self.log(x) * self.number(exponent))
