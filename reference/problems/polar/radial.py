"""The oscillation of z = r/r0 about a point mass at any energy, in closed form: its amplitude, period and time.

With w = (1 - z)/z the energy E is that of z'^2 = (E - 1) + w - kappa w^2 (1 + w)^2; along the exact motion E is 1.  In
u = 1/z = 1 + w, between u1 at the lowest point and u2 at the highest,

    z'^2 = kappa (u1 - u) (u - u2) R(u),     R = u^2 + (u1 + u2 - 2) u + (2 - E)/(kappa u1 u2),     dt = -du/(u^2 z').

x = (u1 - u)/(u - u2) goes from 0 at the lowest point to infinity at the highest; there, with q = u1/u2, and R = 0 where
x is -a or -b, conjugate or real,

    dt = c ((x + 1)/(x + q))^2 dx/sqrt(P),     P = x (x + a) (x + b),     c = 1/(u2^2 sqrt(kappa R(u2))).

The simple pole is an integral of the third kind, and the derivative of sqrt(P)/(x + a) - sqrt(P)/(x + q) leads from the
double one to those of all three kinds: R_F, R_D and R_J (B. C. Carlson's forms, DLMF 19.16).
"""

from __future__ import annotations

from flint import acb, arb

from reference.arithmetic.precision import ctx
from reference.once import cached_property

__all__ = ["RadialOscillation"]


class RadialOscillation:
    """One orbit, by kappa, E - 1 < 1 and w at its lowest and at its highest point; in balls at the precision in force.

    What vanishes as the orbit becomes shallow, u1 - u2, q - 1, q - (a + b)/2 and a - b, is taken from products.
    """

    def __init__(self, kappa: arb, excess: arb, lowest: arb, highest: arb) -> None:
        self._kappa, self._lowest, self._highest = kappa, lowest, highest
        far, near = 1 + lowest, 1 + highest
        self._depth, self._linear = lowest - highest, lowest + highest
        self._constant = (1 - excess) / (kappa * far * near)
        at_far, at_near = self._quadratic(far), self._quadratic(near)
        self._q, self._beyond = far / near, self._depth / near  # q and q - 1
        self._less = self._depth * (self._linear * near / 2 + self._constant) / (near * at_near)
        self._mean, self._size = self._q - self._less, (at_far / at_near).sqrt()  # (a + b)/2 and sqrt(a b)
        self._bend = (self._depth / at_near) ** 2 * (self._constant - self._linear**2 / 4)  # -(a - b)^2/4
        self._scale = 1 / (near * near * (kappa * at_near).sqrt())
        self._weight = at_near / (self._q * self._constant)  # -(q - 1)^2/P(-q)
        self._slope = self._constant * self._beyond**2 / at_near + 2 * self._q * self._less  # P'(-q)

    def _quadratic(self, u: arb) -> arb:
        """R(u)."""
        return u * (u + self._linear) + self._constant

    @property
    def amplitude(self) -> arb:
        """Half of what z moves over: (1/u2 - 1/u1)/2."""
        return self._depth / (2 * (1 + self._lowest) * (1 + self._highest))

    @cached_property
    def half_period(self) -> arb:
        """From the one turning point to the other: complete integrals by the arithmetic-geometric mean.

        R_F = pi/(2 M), R_J = (3 R_F/(2 q)) sum Q_n, and of the second kind q R_F - 2 R_G = R_F (q - (a + b)/2 + sum
        2^(n - 1) c_n^2), n > 0 (DLMF 19.22(ii)); the mean's first step is from sqrt(a) and sqrt(b) to real numbers.
        The mean is between its last two numbers, and each term of the sums that is left out below half of that before.
        """
        large, small = ((self._size + self._mean) / 2).sqrt(), self._size.sqrt()
        square, power = -self._bend / (2 * (self._mean + self._size)), 1
        pole, q_sum = (self._q + self._size) / (2 * self._q.sqrt()), arb(1)
        term, c_sum = (self._q - self._size) / (2 * (self._q + self._size)), arb(0)
        tiny = arb(2) ** -ctx.prec
        while abs(square) * power > tiny * small * small or abs(term) > tiny:
            c_sum, q_sum = c_sum + power * square, q_sum + term
            product = large * small
            term *= (pole * pole - product) / (2 * (pole * pole + product))
            pole = (pole * pole + product) / (2 * pole)
            large, small = (large + small) / 2, product.sqrt()
            square, power = (square / (4 * large)) ** 2, 2 * power
        least, rest = large.min(small), power * square
        c_sum += _within(2 * rest if abs(square) < 4 * least * least else arb.nan())
        q_sum += _within(2 * term)
        first = arb.pi() / (2 * large.union(small))
        third = 3 * first / (2 * self._q) * q_sum
        second = first * (self._less + c_sum) - self._slope * third / 3
        return self._scale * (2 * first - 4 * self._beyond * third / 3 - self._weight * second)

    def since_highest(self, w: arb, rate: arb) -> arb:
        """The time between the highest point and a state of this orbit, by its w and z', at most half a period."""
        below, above = w - self._highest, self._lowest - w
        both = self._kappa * self._quadratic(1 + w)
        if below < above:  # of the two distances the smaller is known better by the rate
            root = abs(rate) / (both * above).sqrt()
            below = root * root
        else:
            above, root = rate * rate / (both * below), below.sqrt()
        turn = acb(self._bend).sqrt() * acb(0, 1)
        a, b = self._mean + turn, self._mean - turn
        x, xa, xb, xq = acb(above), above + a * below, above + b * below, above + self._q * below
        cube = 2 * root * below / 3
        first = 2 * root * acb.elliptic_rf(x, xa, xb)
        third = cube * acb.elliptic_rj(x, xa, xb, acb(xq))
        cubic = above * (above * (above + 2 * self._mean * below) + (self._size * below) ** 2)
        edge = root * cubic.sqrt() / (xa * xq)
        second = a * turn * cube * acb.elliptic_rd(x, xb, xa) - (self._less - turn) * (edge - first / 2)
        whole = first - 2 * self._beyond * third - self._weight * (second - self._slope * third / 2)
        time: arb = self._scale * whole.real
        return time


def _within(size: arb) -> arb:
    """A ball around zero that holds all numbers of this size."""
    return size * arb(0, 1)
