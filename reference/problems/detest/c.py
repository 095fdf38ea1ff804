"""Class C: moderate systems, four of them linear, and the five outer planets."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.precision import mp
from reference.declaration import Invariant
from reference.problems.detest.nonstiff import Nonstiff, first_order, second_order

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["DetestC1", "DetestC2", "DetestC3", "DetestC4", "DetestC5"]


class _Chain(Nonstiff):
    """A chain of decays: what one member loses, the next one gains, so that the sum is conserved."""

    space = first_order(10)
    begins = ("1", *("0",) * 9)
    invariants = (Invariant("sum", ("Sum", "(S - S0)/S0"), "start"),)

    @staticmethod
    def rate_of(member: int) -> int:
        """How fast a member decays, from 1 on."""
        raise NotImplementedError

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        lost = [self.rate_of(i) * value for i, value in enumerate(y[:-1], start=1)]
        between = [before - after for before, after in pairwise(lost)]
        return -lost[0], *between, lost[-1]

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """S = y1 + ... + y10."""
        return sum(y[1:], y[0])


class DetestC1(_Chain):
    """y1' = -y1, yi' = y(i-1) - yi, y10' = y9, y(0) = (1, 0, ..., 0): a radioactive decay chain.

    yi = t^(i-1) exp(-t)/(i-1)! for i < 10.
    """

    name = "detest-c1"
    words = "a radioactive decay chain with equal rates"
    equation = "y1' = -y1, yi' = y(i-1) - yi, y10' = y9"
    difficulty = "lower: linear with constant coefficients, but a ninefold eigenvalue and components from 2e-9 to 1"

    @staticmethod
    def rate_of(member: int) -> int:
        """1."""
        return 1

    def known_state(self, t: Any) -> Sequence[Any]:
        first = [t**i * mp.exp(-t) / mp.factorial(i) for i in range(9)]
        return *first, 1 - mp.fsum(first)


class DetestC2(_Chain):
    """y1' = -y1, yi' = (i-1) y(i-1) - i yi, y10' = 9 y9, y(0) = (1, 0, ..., 0): a radioactive decay chain.

    yi = exp(-t) (1 - exp(-t))^(i-1) for i < 10.
    """

    name = "detest-c2"
    words = "a radioactive decay chain with growing rates"
    equation = "y1' = -y1, yi' = (i-1) y(i-1) - i yi, y10' = 9 y9"
    difficulty = "average: linear with constant coefficients, mildly stiff, with components from 2e-9 to 1"

    @staticmethod
    def rate_of(member: int) -> int:
        """The number of the member."""
        return member

    def known_state(self, t: Any) -> Sequence[Any]:
        first = [mp.exp(-t) * (1 - mp.exp(-t)) ** i for i in range(9)]
        return *first, 1 - mp.fsum(first)


class _Rod(Nonstiff):
    """The heat equation in a rod, by the method of lines: each point by its neighbours, with zero at both ends."""

    equation = "yi' = y(i-1) - 2 yi + y(i+1), with zero at both ends"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        between = (before - 2 * at + after for before, at, after in zip(y, y[1:], y[2:], strict=False))
        return y[1] - 2 * y[0], *between, y[-2] - 2 * y[-1]

    def known_state(self, t: Any) -> Sequence[Any]:
        """By the eigenvectors, which are sines: of the values -4 sin(k pi/(2 (n + 1)))^2."""
        size = len(self.begins)
        angle = mp.pi / (size + 1)
        sines = [mp.sin(i * angle) for i in range(2 * (size + 1))]
        weights = [mp.exp(-4 * mp.sin(k * angle / 2) ** 2 * t) * sines[k] for k in range(1, size + 1)]
        return [
            2 * mp.fsum(one * sines[i * k % len(sines)] for k, one in enumerate(weights, 1)) / (size + 1)
            for i in range(1, size + 1)
        ]


class DetestC3(_Rod):
    """y' = A y, A with -2 on its diagonal and 1 beside it, of 10 equations; y(0) = (1, 0, ..., 0)."""

    name = "detest-c3"
    words = "a parabolic equation by lines, of 10 points"
    space = first_order(10)
    begins = ("1", *("0",) * 9)
    difficulty = "lower: linear with constant coefficients, mildly stiff"


class DetestC4(_Rod):
    """y' = A y, A with -2 on its diagonal and 1 beside it, of 51 equations; y(0) = (1, 0, ..., 0)."""

    name = "detest-c4"
    words = "a parabolic equation by lines, of 51 points"
    space = first_order(51)
    begins = ("1", *("0",) * 50)
    difficulty = "average: linear with constant coefficients, but 51 components from 2e-14 to 1e-2"


PLANETS = 5
JUPITER = ("0.000954786104043", ("3.42947415189", "3.35386959711", "1.35494901715"),
           ("-0.557160570446", "0.505696783289", "0.230578543901"))  # fmt: skip
SATURN = ("0.000285583733151", ("6.64145542550", "5.97156957878", "2.18231499728"),
          ("-0.415570776342", "0.365682722812", "0.169143213293"))  # fmt: skip
URANUS = ("0.0000437273164546", ("11.2630437207", "14.6952576794", "6.27960525067"),
          ("-0.325325669158", "0.189706021964", "0.0877265322780"))  # fmt: skip
NEPTUNE = ("0.0000517759138449", ("-30.1552268759", "1.65699966404", "1.43785752721"),
           ("-0.0240476254170", "-0.287659532608", "-0.117219543175"))  # fmt: skip
PLUTO = ("0.00000277777777778", ("-21.1238353380", "28.4465098142", "15.3882659679"),
         ("-0.176860753121", "-0.216393453025", "-0.0148647893090"))  # fmt: skip
OUTER = (JUPITER, SATURN, URANUS, NEPTUNE, PLUTO)
"""Mass, position and velocity of each planet."""


class DetestC5(Nonstiff):
    """The five outer planets about the sun: Jupiter, Saturn, Uranus, Neptune, Pluto.

    q_i'' = k2 (-(m0 + m_i) q_i/r_i^3 + sum_{j != i} m_j ((q_j - q_i)/d_ij^3 - q_j/r_j^3)), with positions q_i from the
    sun, r_i = |q_i|, d_ij = |q_i - q_j|.  The units are of astronomy, with 100 days for the time, and the sun has the
    inner planets in its mass.  y1 ... y15 are q_1, ..., q_5; y16 ... y30 their velocities.

    The decimals are the same in Algorithm 648, in J. Burkardt's test_ode and in the demonstration programs of DVODE.
    Some later copies differ: one has 165699966404 for y11, and one has each planet disturb the others with the mass of
    the one before it.  Collections of the outer solar system have 1/(1.3e8) for Pluto's mass, and other starts.
    """

    name = "detest-c5"
    words = "the five outer planets"
    space = second_order(3 * PLANETS, reversible=True)
    numbers: ClassVar[Mapping[str, str]] = {
        "k2": "2.95912208286",
        "m0": "1.00000597682",
        **{f"m{i}": mass for i, (mass, _, _) in enumerate(OUTER, start=1)},
    }
    begins = (*(x for _, place, _ in OUTER for x in place), *(v for _, _, velocity in OUTER for v in velocity))
    equation = (
        "q_i'' = k2 (-(m0 + m_i) q_i/r_i^3 + sum_{j != i} m_j ((q_j - q_i)/d_ij^3 - q_j/r_j^3)), "
        "q = (y1, ..., y15), q' = (y16, ..., y30)"
    )
    invariants = (
        Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),
        Invariant("first angular momentum", ("First angular momentum", "(L1 - L10)/L10"), "start", "momentum_1"),
        Invariant("second angular momentum", ("Second angular momentum", "(L2 - L20)/L20"), "start", "momentum_2"),
        Invariant("third angular momentum", ("Third angular momentum", "(L3 - L30)/L30"), "start", "momentum_3"),
    )
    difficulty = "average: 30 smooth equations with square roots, over half a turn of Jupiter"
    meanings: ClassVar[Mapping[str, str]] = {
        "k2": "gravitational constant",
        "m0": "mass of the sun",
        "m1": "mass of Jupiter",
        "m2": "mass of Saturn",
        "m3": "mass of Uranus",
        "m4": "mass of Neptune",
        "m5": "mass of Pluto",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        places, masses = _threes(y[: 3 * PLANETS]), [p[f"m{i}"] for i in range(1, PLANETS + 1)]
        sun = [[x * cube for x in place] for place, cube in ((one, _inverse_cube(m, one)) for one in places)]
        pulls = {(i, j): _pull(m, one, other) for i, j, one, other in _pairs(places)}
        found = list(y[3 * PLANETS :])
        for i in range(PLANETS):
            for k in range(3):
                total = -(p["m0"] + masses[i]) * sun[i][k]
                for j in range(PLANETS):
                    if j != i:
                        pull = pulls[i, j][k] if i < j else -pulls[j, i][k]
                        total = total + masses[j] * (pull - sun[j][k])
                found.append(p["k2"] * total)
        return tuple(found)

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy about the centre of mass.

        E = sum_i m_i v_i^2/2 - |sum_i m_i v_i|^2/(2 M) - k2 (sum_i m0 m_i/r_i + sum_{i < j} m_i m_j/d_ij), M the mass
        of all.
        """
        places, velocities = _threes(y[: 3 * PLANETS]), _threes(y[3 * PLANETS :])
        masses = [p[f"m{i}"] for i in range(1, PLANETS + 1)]
        all_of_it = sum(masses, p["m0"])
        shared = _moment(masses, velocities)
        energy = -(shared[0] * shared[0] + shared[1] * shared[1] + shared[2] * shared[2]) / (2 * all_of_it)
        for mass, place, velocity in zip(masses, places, velocities, strict=True):
            energy = energy + mass * _square(velocity) / 2 - p["k2"] * p["m0"] * mass / m.sqrt(_square(place))
        for i, j, one, other in _pairs(places):
            energy = energy - p["k2"] * masses[i] * masses[j] / m.sqrt(_square(_apart(one, other)))
        return energy

    def momentum_1(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The first component of the angular momentum about the centre of mass."""
        return self._momentum(y, p, 1, 2)

    def momentum_2(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The second component of it."""
        return self._momentum(y, p, 2, 0)

    def momentum_3(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The third component of it."""
        return self._momentum(y, p, 0, 1)

    @staticmethod
    def _momentum(y: Sequence[Any], p: dict[str, Any], a: int, b: int) -> Any:
        places, velocities = _threes(y[: 3 * PLANETS]), _threes(y[3 * PLANETS :])
        masses = [p[f"m{i}"] for i in range(1, PLANETS + 1)]
        where, shared = _moment(masses, places), _moment(masses, velocities)
        found = -(where[a] * shared[b] - where[b] * shared[a]) / sum(masses, p["m0"])
        for mass, q, v in zip(masses, places, velocities, strict=True):
            found = found + mass * (q[a] * v[b] - q[b] * v[a])
        return found


def _threes(values: Sequence[Any]) -> list[Sequence[Any]]:
    return [values[i : i + 3] for i in range(0, len(values), 3)]


def _pairs(places: Sequence[Sequence[Any]]) -> Iterator[tuple[int, int, Sequence[Any], Sequence[Any]]]:
    for i, one in enumerate(places):
        for j in range(i + 1, len(places)):
            yield i, j, one, places[j]


def _apart(one: Sequence[Any], other: Sequence[Any]) -> list[Any]:
    return [b - a for a, b in zip(one, other, strict=True)]


def _square(place: Sequence[Any]) -> Any:
    return place[0] * place[0] + place[1] * place[1] + place[2] * place[2]


def _inverse_cube(m: Arithmetic, place: Sequence[Any]) -> Any:
    """1/|q|^3."""
    square = _square(place)
    return 1 / (square * m.sqrt(square))


def _pull(m: Arithmetic, one: Sequence[Any], other: Sequence[Any]) -> list[Any]:
    """(q_j - q_i)/d_ij^3."""
    apart = _apart(one, other)
    cube = _inverse_cube(m, apart)
    return [x * cube for x in apart]


def _moment(masses: Sequence[Any], vectors: Sequence[Sequence[Any]]) -> list[Any]:
    """The sum of the vectors, each times its mass."""
    terms = [[mass * vector[k] for mass, vector in zip(masses, vectors, strict=True)] for k in range(3)]
    return [sum(one[1:], one[0]) for one in terms]
