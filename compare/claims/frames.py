"""What an integrator is tried on: equations with a proven solution, one of them with the time in it.

The second is the first seen from a frame that swings: with theta(t) a solution of theta'' = F(theta) and
s(t) = a (1 - cos(w t)), the positions q = theta + s obey q'' = F(q - s) + s'', and start where theta starts.  A stage
that is taken at the wrong time sees the wrong s.  Momenta that are no velocities stay as they are, and q' gains s'.

A user's function sees the right-hand side as f(y) or f(t, y), on floats, arrays of lanes, and symbols.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.expansion import Expansion
from compare.march.trace import compiled_rates
from compare.measure.truth import errors_of_doubles
from compare.methods.own.hosting import Exhausted, MisuseError
from compare.methods.own.jitted import is_traced
from compare.methods.own.rates import Rates
from reference.arithmetic.compiler import hy
from reference.arithmetic.namespaces import JAX, NUMPY, Heyoka
from reference.once import cached_property
from reference.problem import SeparableProblem

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.declaration import Invariant
    from reference.problem import Problem

__all__ = ["Exhausted", "Field", "Frame", "MisuseError", "Scene", "nonzero"]

SYMBOLS = Heyoka()
LONG = 2000
"""A motion that goes on for so long, over the inverse of its rate, is one that does not end."""
PARTS, MOST = 32, 15 / 16
"""Of a motion that ends, the least number of steps, and the part over which the order is measured."""
SPAN = 20
"""The order is measured over so many of the steps at which defects are: about one period."""
SIGHTS = 8
"""Times at which the size of a motion is seen, and its compiled rates are held against plain ones."""


def nonzero(sizes: np.ndarray) -> np.ndarray:
    """Sizes to divide by: 1 for what is always zero."""
    return np.where(sizes > 0, sizes, 1.0)


class Field(Rates):
    """The right-hand side of a scene, on lanes and on series too.

    Attributes:
        calls: how often it was called.
        limit: calls after which Exhausted is raised.
    """

    def __init__(self, scene: Scene, limit: int, owner: Any = None) -> None:
        self.scene, self.limit, self._owner = scene, limit, owner
        self.dimension, self.positions = scene.dimension, scene.problem.positions
        self.calls = 0

    @property
    def key(self) -> Any:
        """The scene, and who is tried on it."""
        return id(self._owner), self.scene

    def of(self, t: Any, y: Any) -> Any:
        self.calls += 1
        if self.calls > self.limit:
            raise Exhausted(f"called f more than {self.limit} times")
        if t is None and not self.scene.problem.autonomous:
            raise MisuseError(
                f"the step gives f no time, on which {self.scene.problem!r} depends; f(t, y) is accepted, as in a "
                "step (f, t, y, h)."
            )
        t = 0.0 if t is None else t
        if is_traced(y):
            return self.scene.rates(JAX, t, tuple(y))
        if y.dtype != object:
            return self.scene.evaluated(t, y)
        series = next((part.home for part in (*y, t) if isinstance(part, Expansion)), None)
        if series is not None:
            return self.scene.rates(series, t, tuple(y))
        return self.scene.rates(SYMBOLS, hy.expression(float(t)) if isinstance(t, (int, float)) else t, tuple(y))


BINARY32 = Fraction(1, 1 << 24)
"""A step may work in numbers of so few bits, and both starts must differ in them."""


@dataclass(frozen=True)
class Frame:
    """s(t) = a (1 - cos(w t)), with the first two of its derivatives; w in rad/s.

    ``units`` are what each position that is displaced has for a unit; () where that is 1 for all.
    """

    a: float
    w: float
    units: tuple[float, ...] = ()

    def at(self, m: Arithmetic, t: Any) -> tuple[Any, Any, Any]:
        """(s, s', s'') at t."""
        a, w = self.a, self.w
        return a * (1.0 - m.cos(w * t)), a * w * m.sin(w * t), a * w * w * m.cos(w * t)


@dataclass(frozen=True)
class Scene:
    """A motion in time, still or seen from a frame that swings.

    Attributes:
        problem: the problem, whose positions and rates are where its state space says.
        frame: how the positions that have a rate are displaced, or all where none has one; or None.
    """

    problem: Problem
    frame: Frame | None = None

    @property
    def dimension(self) -> int:
        """How many numbers a state has."""
        return len(self.problem.state_names)

    @property
    def start(self) -> np.ndarray:
        """The initial state, in doubles."""
        return np.array([float(value) for value in self.problem.start])

    @cached_property
    def _parameters(self) -> dict[str, Any]:
        return {name: float(value) for name, value in self.problem.parameters.items()}

    @cached_property
    def rated(self) -> list[int]:
        """Where the positions stand that have a rate."""
        return [position for position, _ in self.problem.space.pairs]

    @cached_property
    def rates_places(self) -> list[int]:
        """Where their rates stand: velocities or momenta."""
        return [rate for _, rate in self.problem.space.pairs]

    @cached_property
    def displaced(self) -> list[int]:
        """Where the positions stand that a frame displaces."""
        return self.rated or self.problem.space.places(self.problem.space.positions)

    @cached_property
    def follows_rates(self) -> bool:
        """Whether q' = p, or q' is the velocity itself, as it is seen at the start with other rates."""
        if not self.rates_places:
            return False
        y = self.start
        y[self.rates_places] = [(3 * k + 2) / 7 for k in range(len(self.rates_places))]
        with np.errstate(all="ignore"):
            found = self.problem.derivative(NUMPY, 0.0, list(y), self._parameters)
        return all(found[position] == y[rate] for position, rate in self.problem.space.pairs)

    @property
    def confined(self) -> bool:
        """Whether a state further off may fall into a singularity: not with one degree of freedom that splits."""
        return self.problem.positions != 1

    @cached_property
    def pace(self) -> float:
        """The rate of the motion, in 1/s; 1 where it has none, and any unit of time is as good."""
        return self.problem.rate() or 1.0

    @cached_property
    def end(self) -> float:
        """When the motion ends, within a part in a thousand; infinity where it goes on."""
        domain = self.problem.domain(self.problem.row("state"))
        low, high = 0.0, LONG / self.pace
        if domain.contains(Fraction(high)):
            return math.inf
        while high - low > high / 1024:
            middle = (low + high) / 2
            low, high = (middle, high) if domain.contains(Fraction(middle)) else (low, middle)
        return low

    @cached_property
    def step(self) -> float:
        """One digit of 0.3/rate, the step at which defects are measured: 0.1 s for a pendulum of 1 m.

        Of a motion that ends no more than a part of it.
        """
        return _one_digit(min(0.3 / self.pace, self.end / PARTS))

    @property
    def span(self) -> float:
        """The time over which the order is measured."""
        return min(SPAN * _one_digit(0.3 / self.pace), MOST * self.end)

    @cached_property
    def units(self) -> tuple[float, ...]:
        """Of each position that is displaced: 1 rad of an angle, else one digit of the size of the motion."""
        sizes = self.sizes(self._seen)
        angles = self.problem.space.places(self.problem.space.angles)
        return tuple(1.0 if place in angles else float(f"{sizes[place]:.0e}") for place in self.displaced)

    @cached_property
    def _seen(self) -> np.ndarray:
        """Some states of the motion, [state, times]."""
        until = Fraction(min(10 / self.pace, self.end / 2))
        found: np.ndarray = self.problem.state([until * Fraction(k, SIGHTS) for k in range(SIGHTS + 1)]).T
        return found

    def sizes(self, states: np.ndarray) -> np.ndarray:
        """The largest of each component of states [state, lanes]; of one that is always zero, of its kind."""
        found: np.ndarray = np.max(np.abs(states), axis=1)
        space = self.problem.space
        for kind in (space.places(space.positions), space.places(space.rates)):
            found[kind] = np.where(found[kind] > 0, found[kind], np.max(found[kind], initial=0.0))
        return nonzero(found)

    def same_equation(self, other: Scene) -> bool:
        """Whether another scene has the same right-hand side, so that its start may be marched here."""
        here, there = self.problem, other.problem
        same: bool = (here.structure, here.parameters, self.frame) == (there.structure, there.parameters, other.frame)
        return same

    def neighbour(self) -> Scene:
        """The same from a start close by."""
        return Scene(self.problem.neighbour(lambda value: Fraction(float(value)), BINARY32), self.frame)

    def _displacements(self, s: Any, speed: Any) -> list[tuple[int, Any]]:
        """By how much each component is displaced that is: positions by s, and rates that they follow by s'."""
        units = (self.frame and self.frame.units) or (1.0,) * len(self.displaced)
        rates = zip(self.rates_places, units, strict=True) if self.follows_rates else ()
        positions = zip(self.displaced, units, strict=True)
        return [*((place, unit * s) for place, unit in positions), *((place, unit * speed) for place, unit in rates)]

    def rates(self, m: Arithmetic, t: Any, y: Sequence[Any]) -> tuple[Any, ...]:
        """dy/dt in an arithmetic whose numbers mix with floats."""
        if self.frame is None:
            return tuple(self.problem.derivative(m, t, y, self._parameters))
        s, speed, acceleration = self.frame.at(m, t)
        still = list(y)
        for place, shift in self._displacements(s, speed):
            still[place] = still[place] - shift
        rates = list(self.problem.derivative(m, t, still, self._parameters))
        for place, shift in self._displacements(speed, acceleration):
            rates[place] = rates[place] + shift
        if self.follows_rates:  # to the last bit: a method for second-order equations may ask
            for position, rate in self.problem.space.pairs:
                rates[position] = y[rate]
        return tuple(rates)

    def evaluated(self, t: Any, y: np.ndarray) -> np.ndarray:
        """dy/dt of one state or of lanes of them."""
        plain = y.ndim > 2 or y.dtype != np.float64 or np.asarray(t).dtype.kind not in "fiu"
        function = None if plain else self._compiled
        if function is None:
            rates = self.rates(NUMPY, t, tuple(y))
            return np.array(rates) if y.ndim == 1 else np.array(np.broadcast_arrays(*rates))
        rows = np.empty((len(y) + 1, *y.shape[1:]))
        rows[:-1], rows[-1] = y, t
        found: np.ndarray = function(rows)
        return found

    @cached_property
    def _compiled(self) -> Callable[[np.ndarray], np.ndarray] | None:
        """The rates of states and times, where that is faster and agrees with plain evaluation.

        A force that is written out is as fast plain; slopes of a Hamiltonian, or of a formula, are many times slower.
        """
        if isinstance(self.problem, SeparableProblem):
            return None
        variables = [hy.expression(f"y{i}") for i in range(self.dimension)]
        rates = self.rates(SYMBOLS, hy.expression("t"), tuple(variables))
        times = np.arange(self._seen.shape[1]) / self.pace
        plain = self.rates(NUMPY, times, tuple(self._seen))
        return compiled_rates(rates, [*variables, hy.expression("t")], np.vstack([self._seen, times]), plain)

    def errors(self, times: Sequence[Fraction], y: np.ndarray) -> np.ndarray:
        """y - truth, [times, state]."""
        if self.frame is not None:
            s, speed, _ = self.frame.at(NUMPY, np.array([float(t) for t in times]))
            y = y.copy()
            for place, shift in self._displacements(s, speed):
                y[:, place] -= shift
        return errors_of_doubles(self.problem, times, y)

    @property
    def invariants(self) -> tuple[Invariant, ...]:
        """Those that are declared, the energy first where there is one."""
        return self.problem.invariants

    @cached_property
    def lacks_energy(self) -> str | None:
        """Why no change of the first of them can be told; None where it can."""
        return self.lacks_change(0) if self.invariants else f"{self.problem!r} conserves nothing that is declared"

    def lacks_change(self, index: int) -> str | None:
        """Why no change of an invariant can be told; None where it can."""
        if self._levels[index][1] > 0:
            return None
        return f"the change of its {self.invariants[index].name} has no scale: {self.problem!r} starts at zero"

    @cached_property
    def _levels(self) -> list[tuple[float, float]]:
        """Each invariant at the start, and what its change is divided by."""
        found = []
        for one in self.invariants:
            level = self._value(one.value, self.start)
            found.append((level, abs(level if one.scale == "start" else self._value(one.scale, self.start))))
        return found

    def _value(self, name: str, y: Any) -> Any:
        return getattr(self.problem, name)(NUMPY, list(y), self._parameters)

    def energy(self, y: np.ndarray) -> np.ndarray:
        """The change of the first invariant over its scale, of states [times, state] of the still problem.

        Of an energy above rest that is (E - E0)/(E0 - Emin).
        """
        return self.change(0, y)

    def change(self, index: int, y: np.ndarray) -> np.ndarray:
        """The same of any invariant."""
        level, scale = self._levels[index]
        found: np.ndarray = np.asarray(self._value(self.invariants[index].value, y.T)) / scale - level / scale
        return found


def _one_digit(size: float) -> float:
    unit = 10.0 ** math.floor(math.log10(size))
    return float(f"{round(size / unit) * unit:.0e}")
