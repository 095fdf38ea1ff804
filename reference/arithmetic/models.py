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

from flint import arb, arb_poly

from reference.arithmetic.balls import BALL
from reference.arithmetic.precision import ctx
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

__all__ = ["BOUND_BITS", "ModelArithmetic", "Node", "RefusedError", "Tape", "Variable", "bound", "total"]

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
        self.kept: list[Any] = []

    def once(self, kind: type[Node], *operands: Any) -> Node:
        """The node of an operation on these operands, which is made only once."""
        key = (kind, *map(id, operands))
        if key not in self._made:
            self.kept.append(operands)
            self._made[key] = kind(self, *operands)
        return self._made[key]

    def keep(self, wanted: Iterable[Any]) -> None:
        """Drop what none of these is made of, such as the value of a Hamiltonian of which the slopes are wanted."""
        needed: set[Node] = set()
        waiting = [node for node in wanted if isinstance(node, Node)]
        while waiting:
            node = waiting.pop()
            if node not in needed:
                needed.add(node)
                waiting += node.operands
        self.nodes = [node for node in self.nodes if node in needed or isinstance(node, Variable)]

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
        for node in self.nodes:
            node.fill(order)

    def scale(self, powers: Sequence[arb]) -> None:
        """Replace each polynomial by S(h s), of which ``powers`` are the powers of h; they are rounded."""
        for node in self.nodes:
            node.terms = [term.mid() for term in map(mul, node.terms, powers)]

    def close(self, remainders: Sequence[arb]) -> None:
        """Bound every node's remainder, those of the variables being given.

        Raises:
            RefusedError: a rule has no answer on this step.
        """
        given = iter(remainders)
        for node in self.nodes:
            node.forget()
            node.remainder = next(given) if isinstance(node, Variable) else node.proven()
            if not (node.remainder.is_finite() and node.remainder >= 0):
                raise RefusedError(f"the remainder of a {type(node).__name__.lower()} is not finite")


class Node:
    """A function on the step: the coefficients of its polynomial, exact, and the bound of its distance from that."""

    def __init__(self, tape: Tape) -> None:
        self.tape = tape
        self.terms: list[arb] = []
        self.remainder = arb(0)
        tape.nodes.append(self)

    @property
    def operands(self) -> list[Node]:
        """The nodes that it is made of."""
        return [one for one in vars(self).values() if isinstance(one, Node)]

    def coefficient(self, k: int) -> arb:
        """The next coefficient, from those of the operands up to the k-th, rounded to an exact number."""
        raise NotImplementedError

    def fill(self, order: int) -> None:
        """All coefficients up to the order, those of the operands being known."""
        for k in range(order + 1):
            self.terms.append(self.coefficient(k))

    def proven(self) -> arb:
        """The remainder, from the polynomials of this node and its operands and from their remainders."""
        raise NotImplementedError

    def forget(self) -> None:
        """The coefficients are others: what was made of them goes."""
        for name in ("polynomial", "sizes", "norm", "swing", "slopes"):
            self.__dict__.pop(name, None)

    @cached_property
    def polynomial(self) -> arb_poly:
        """S."""
        return arb_poly(self.terms)

    @cached_property
    def sizes(self) -> list[arb]:
        """Bounds of the |S_k|."""
        with ctx.workprec(BOUND_BITS):
            return [term.abs_upper() for term in self.terms]

    @cached_property
    def norm(self) -> arb:
        """A bound of ||S||."""
        with ctx.workprec(BOUND_BITS):
            return bound(sum(self.sizes, arb(0)))

    @cached_property
    def swing(self) -> arb:
        """A bound of the sum of |S_k| over k >= 1: of |S(s) - S(t)|, and of the integral of |S'|."""
        with ctx.workprec(BOUND_BITS):
            return bound(sum(self.sizes[1:], arb(0)))

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

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Node):
            return self.tape.once(Sum, self, other)
        return self._shifted(other) if isinstance(other, NUMBERS) else NotImplemented

    def _shifted(self, value: Any) -> Node:
        return self if value == 0 else Shifted(self.tape, self, _ball(value))

    def _scaled(self, value: Any) -> Any:
        """The multiple; an equation's exact zeros and ones, such as slopes of its variables, are no operations."""
        if value == 0:
            return arb(0)
        if value == 1:
            return self
        return -self if value == -1 else Scaled(self.tape, self, _ball(value))

    def __neg__(self) -> Node:
        return self.tape.once(Negative, self)

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Node):
            return self.tape.once(Difference, self, other)
        return self._shifted(-other) if isinstance(other, NUMBERS) else NotImplemented

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Node):
            first, second = sorted((self, other), key=id)
            return self.tape.once(Square, self) if self is other else self.tape.once(Product, first, second)
        return self._scaled(other) if isinstance(other, NUMBERS) else NotImplemented

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, Node):
            return self * self.tape.once(Inverse, other)
        return self._scaled(1 / _ball(other)) if isinstance(other, NUMBERS) else NotImplemented

    def __rtruediv__(self, other: Any) -> Any:
        return self.tape.once(Inverse, self) * other

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


def _ball(value: Any) -> arb:
    return value if isinstance(value, arb) else arb(value)


def _dot(a: Sequence[arb], b: Sequence[arb]) -> arb:
    """a_0 b_n + ... + a_n b_0, of two parts of the same length."""
    return sum(map(mul, a, reversed(b)), arb(0))


def _off(found: arb_poly) -> arb:
    """||.|| of what should vanish."""
    with ctx.workprec(BOUND_BITS):
        return total(found.coeffs())


class Variable(Node):
    """A component of the state, or the time: its coefficients and its remainder are given."""

    def __init__(self, tape: Tape, given: Callable[[int], arb]) -> None:
        super().__init__(tape)
        self._given = given

    def coefficient(self, k: int) -> arb:
        return self._given(k)


class Sum(Node):
    """f + g (rule 1)."""

    def __init__(self, tape: Tape, a: Node, b: Node) -> None:
        super().__init__(tape)
        self.a, self.b = a, b

    def coefficient(self, k: int) -> arb:
        return (self.a.terms[k] + self.b.terms[k]).mid()

    def proven(self) -> arb:
        off = _off(self.a.polynomial + self.b.polynomial - self.polynomial)
        with ctx.workprec(BOUND_BITS):
            return bound(off + self.a.remainder + self.b.remainder)


class Difference(Sum):
    """f - g (rule 1)."""

    def coefficient(self, k: int) -> arb:
        return (self.a.terms[k] - self.b.terms[k]).mid()

    def proven(self) -> arb:
        off = _off(self.a.polynomial - self.b.polynomial - self.polynomial)
        with ctx.workprec(BOUND_BITS):
            return bound(off + self.a.remainder + self.b.remainder)


class Negative(Node):
    """-f."""

    def __init__(self, tape: Tape, a: Node) -> None:
        super().__init__(tape)
        self.a = a

    def coefficient(self, k: int) -> arb:
        return -self.a.terms[k]

    def proven(self) -> arb:
        off = _off(self.polynomial + self.a.polynomial)
        with ctx.workprec(BOUND_BITS):
            return bound(off + self.a.remainder)


class Shifted(Node):
    """f + c, c anywhere in a ball (rule 1)."""

    def __init__(self, tape: Tape, a: Node, value: arb) -> None:
        super().__init__(tape)
        self.a, self.value = a, value

    def coefficient(self, k: int) -> arb:
        return self.a.terms[k] if k else (self.a.terms[0] + self.value).mid()

    def proven(self) -> arb:
        off = _off(self.a.polynomial + self.value - self.polynomial)
        with ctx.workprec(BOUND_BITS):
            return bound(off + self.a.remainder)


class Scaled(Node):
    """c f, c anywhere in a ball (rule 1)."""

    def __init__(self, tape: Tape, a: Node, value: arb) -> None:
        super().__init__(tape)
        self.a, self.value, self._middle = a, value, value.mid()

    def coefficient(self, k: int) -> arb:
        return (self._middle * self.a.terms[k]).mid()

    def proven(self) -> arb:
        off = _off(self.a.polynomial * self.value - self.polynomial)
        with ctx.workprec(BOUND_BITS):
            return bound(off + self.value.abs_upper() * self.a.remainder)


class Product(Node):
    """f g (rule 2): ||AB - S||, of which the degrees beyond the order are what is cut, and a (||B|| + b) + ||A|| b."""

    def __init__(self, tape: Tape, a: Node, b: Node) -> None:
        super().__init__(tape)
        self.a, self.b = a, b

    def coefficient(self, k: int) -> arb:
        return _dot(self.a.terms[: k + 1], self.b.terms[: k + 1]).mid()

    def fill(self, order: int) -> None:
        product = self.a.polynomial * self.b.polynomial
        found = [term.mid() for term in product.truncate(order + 1).coeffs()]
        self.terms = found + [arb(0)] * (order + 1 - len(found))

    def proven(self) -> arb:
        off = _off(self.a.polynomial * self.b.polynomial - self.polynomial)
        with ctx.workprec(BOUND_BITS):
            return bound(off + self.a.remainder * self.b.reach + self.a.norm * self.b.remainder)


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

    def proven(self) -> arb:
        off = _off(self.a.polynomial * self.polynomial - 1)
        with ctx.workprec(BOUND_BITS):
            w = bound(off + self.a.remainder * self.norm)
            if not w < 1:
                raise RefusedError("a divisor may vanish")
            return bound(self.norm * w / (1 - w))


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

    def proven(self) -> arb:
        off = _off(self.polynomial * self.polynomial - self.a.polynomial)
        with ctx.workprec(BOUND_BITS):
            low = self.terms[0] - self.swing
            if not low > 0:
                raise RefusedError("what is under a root may vanish")
            w = bound((off + self.a.remainder) / (low * low))
            if not w <= 1:
                raise RefusedError("what is under a root may vanish")
            return bound(self.norm * w)


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

    def proven(self) -> arb:
        off = _integrated(self.a, self, self)
        start = (self.a.terms[0].exp() - self.terms[0]).abs_upper()
        with ctx.workprec(BOUND_BITS):
            far = bound(self.a.swing.exp() * (start + off))
            return bound(far + self.a.remainder.expm1() * (self.norm + far))


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

    def fill(self, order: int) -> None:
        for k in range(order + 1):
            self.terms.append(self.coefficient(k))
            self.other.terms.append(self.follow(k))

    def follow(self, k: int) -> arb:
        """The coefficient of the second function."""
        if k == 0:
            return self.starts(self.a.terms[0])[1].mid()
        return (self.sign * _dot(self.a.slope(k)[:k], self.terms[:k]) / k).mid()

    def apart(self) -> arb:
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

    def proven(self) -> arb:
        self.other.forget()
        apart = self.apart()
        with ctx.workprec(BOUND_BITS):
            return bound(apart + self.a.remainder)


class Hyperbolic(_Pair):
    """sinh f and cosh f (rule 7): the sum and the difference of the errors grow by at most exp(sum_{k>0} |A_k|)."""

    sign = 1

    @staticmethod
    def starts(x: arb) -> tuple[arb, arb]:
        return x.sinh(), x.cosh()

    def proven(self) -> arb:
        self.other.forget()
        apart = self.apart()
        with ctx.workprec(BOUND_BITS):
            far = bound(self.a.swing.exp() * apart)
            moved = self.a.remainder.expm1()
            return bound(far + moved * (self.norm + self.other.norm + 2 * far))


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

    def proven(self) -> arb:
        off = _integrated(self.a, self.rate, self)
        start = (self._function(self.a.terms[0]) - self.terms[0]).abs_upper()
        with ctx.workprec(BOUND_BITS):
            steep = self.rate.remainder * self.a.swing
            return bound(start + off + steep + self.a.remainder * self.rate.reach)


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
        return self.tape.once(kind, x)

    def sin(self, x: Any) -> Any:
        return self._pair(x, Circular) if isinstance(x, Node) else _ball(x).sin()

    def cos(self, x: Any) -> Any:
        return self._second(x, Circular) if isinstance(x, Node) else _ball(x).cos()

    def sinh(self, x: Any) -> Any:
        return self._pair(x, Hyperbolic) if isinstance(x, Node) else _ball(x).sinh()

    def cosh(self, x: Any) -> Any:
        return self._second(x, Hyperbolic) if isinstance(x, Node) else _ball(x).cosh()

    def _second(self, x: Node, kind: type[_Pair]) -> Node:
        pair: Any = self._pair(x, kind)
        second: Node = pair.other
        return second

    def tan(self, x: Any) -> Any:
        return self.sin(x) / self.cos(x)

    def tanh(self, x: Any) -> Any:
        return self.sinh(x) / self.cosh(x)

    def exp(self, x: Any) -> Any:
        return self.tape.once(Exponential, x) if isinstance(x, Node) else _ball(x).exp()

    def sqrt(self, x: Any) -> Any:
        return self.tape.once(Root, x) if isinstance(x, Node) else _ball(x).sqrt()

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
        if not isinstance(x, Node):
            return function(_ball(x))
        if (name, x) not in self._known:
            self._known[name, x] = ByDerivative(self.tape, x, rate(x), function)
        return self._known[name, x]

    def power(self, x: Any, exponent: Fraction) -> Any:
        """x to a rational power: by products, by a root and products, else exp(e log x)."""
        if not isinstance(x, Node):
            return BALL.power(_ball(x), exponent)
        exponent = Fraction(exponent)
        if exponent.denominator == 1:
            return x**exponent.numerator
        if exponent.denominator == 2:
            return self.sqrt(x) ** exponent.numerator
        return self.exp(self.log(x) * self.number(exponent))
