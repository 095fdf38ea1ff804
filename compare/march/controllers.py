"""Step size controllers: each a row of coefficients, and the rules that all of them keep.

After a step of size h_n with the error err_n, which is 1 where it is just tolerated, and with k the order of that
error in h, the next step is

    h_(n+1) = h_n prod_i (s^k/err_(n+1-i))^(b_i/k) (h_n/h_(n-1))^(-a_2) (h_(n-1)/h_(n-2))^(-a_3),    i = 1, 2, 3,

with b_i and a_i of the controller and s = SAFETY: all of them lead to the error s^k (G. Söderlind, ACM Transactions on
Mathematical Software 29 (2003), 1, section 2).

The rules, of E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I (1993), section II.4,
and of dopri5.f, the program of its appendix, where nothing else is said:

- The error is the root of the mean square over the components of e_i/(atol + rtol max(|y_i|, |y_i at the end|)); the
  time, where it stands in the state, is no component.  Where a method has embedded results of two orders, E of the
  higher and L of the lower, it is E^2/sqrt(E^2 + 0.01 L^2) (section II.10); of two of one order the larger counts, as
  both must pass.
- A step is accepted where the error is at most 1.
- The ratio of two steps is held within SHORTEST and LONGEST.
- After a rejection the elementary controller gives the next attempt, and the step that is then accepted is followed by
  no longer one.
- Errors of steps before the last count as LEAST_KNOWN at least.
- Where a step gives no number, or an implicit one has not converged, the next attempt has HALVED the step (E. Hairer
  and G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.8, which has for the last change of the
  iteration a part of the tolerance too).
- Until a controller knows as many steps as it looks back on, the elementary one stands in, as in SUNDIALS.
- The step that would pass the end is cut to it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from compare.methods.order.algebraic import Q
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Iterable
    from fractions import Fraction

__all__ = [
    "CONTROLLERS",
    "CONVERGED",
    "DAMPING",
    "DEFAULT",
    "HALVED",
    "LEAST_KNOWN",
    "LONGEST",
    "SAFETY",
    "SHORTEST",
    "SMALLEST_STEP",
    "Controller",
    "controllers",
]

SAFETY = Q(9, 10)
SHORTEST, LONGEST = Q(1, 5), Q(10)
LEAST_KNOWN = Q(1, 10**4)
HALVED = Q(1, 2)
DAMPING = Q(1, 100)
"""Of the square of the lower embedded result."""
CONVERGED = Q(1, 10)
"""Of the tolerance: the last change of an iteration is at most so much."""
SMALLEST_STEP = 10
"""Units in the last place of the time: a shorter step is none, and ends the march (SciPy's rule)."""


@dataclass(frozen=True)
class Controller:
    """A controller of the step size: b_1, b_2, b_3 and a_2, a_3, none of them divided by k.

    Attributes:
        name: as the command line has it.
        title: what it is called.
        beta, alpha: the coefficients.
        source: where they are printed.
    """

    name: str
    title: str
    beta: tuple[Fraction, Fraction, Fraction]
    alpha: tuple[Fraction, Fraction]
    source: str

    @property
    def depth(self) -> int:
        """How many steps before the last one it looks back on."""
        if self.beta[2] or self.alpha[1]:
            return 2
        return 1 if self.beta[1] or self.alpha[0] else 0


def _controller(name: str, title: str, beta: str, source: str, alpha: str = "0 0") -> Controller:
    first, second, third = map(Q, beta.split())
    near, far = map(Q, alpha.split())
    return Controller(name, title, (first, second, third), (near, far), source)


SOEDERLIND = "G. Söderlind 2003, ACM Trans. Math. Softw. 29, 1, table III"

CONTROLLERS = (
    _controller(
        "i", "elementary", "1 0 0", "E. Hairer, S. P. Nørsett and G. Wanner 1993, Solving ODEs I, II.4, equation (4.13)"
    ),
    _controller(
        "pi",
        "PI.3.4 of Gustafsson",
        "7/10 -2/5 0",
        "K. Gustafsson 1991, ACM Trans. Math. Softw. 17, 533; E. Hairer and G. Wanner 1996, Solving ODEs II, IV.2",
    ),
    _controller("pid", "H312PID", "1/18 1/9 1/18", SOEDERLIND),
    _controller("h211pi", "H211PI", "1/6 1/6 0", SOEDERLIND),
    _controller("h211b", "H211b, b = 4", "1/4 1/4 0", SOEDERLIND, "1/4 0"),
    _controller("h312b", "H312b, b = 8", "1/8 1/4 1/8", SOEDERLIND, "3/8 1/8"),
    _controller("h321", "H321", "1/3 1/18 -5/18", SOEDERLIND, "-5/6 -1/6"),
)
DEFAULT = ("i", "pi", "pid")
"""The controllers that a study takes unless it is told which."""


def controllers(names: Iterable[str]) -> tuple[Controller, ...]:
    """The controllers of these names, each once.

    Raises:
        ValueError: there is none of a name.
    """
    known = {one.name: one for one in CONTROLLERS}
    found: dict[str, Controller] = {}
    for name in names:
        plain = str(name).strip().lower()
        if plain not in known:
            raise ValueError(unknown("controller", str(name), known))
        found[plain] = known[plain]
    return tuple(found.values())
