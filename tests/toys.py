"""Families of problems that only the tests know: what every command has to serve without naming it.

Kepler's problem has two degrees of freedom, a negative energy that is exactly a double though no ball is, and a second
invariant; the forced oscillator a force that depends on the time, an angle, and nothing that is conserved or periodic.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.declaration import ClosedForm, Invariant, Quantity, Row, StateSpace, Trial
from reference.family import Comparison, Family, Input, Reported
from reference.layout import Coordinate, Group, Layout
from reference.problem import HamiltonianProblem, SeparableProblem
from reference.routes.taylor import Along, Period
from reference.row_domains import ONCE, TIME

if TYPE_CHECKING:
    from collections.abc import Sequence

PERICENTRE = Fraction(2, 5)


@dataclass(frozen=True, repr=False)
class Kepler(HamiltonianProblem):
    """H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2), from the pericentre (r, 0) at the speed v.

    With a = 1/(2/r - v^2), e = r v^2 - 1 and E - e sin E = t/a^(3/2): x = a (cos E - e), y = a sqrt(1 - e^2) sin E.
    """

    v: Fraction
    r: Fraction

    name: ClassVar[str] = "toy kepler"
    space: ClassVar[StateSpace] = StateSpace(
        positions=("x", "y"),
        momenta=("px", "py"),
        angles=(),
        odd=("px", "py"),
        along=None,
        scale="units",
        independent="",
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (
        Invariant("energy", ("Energy", "(E - E0)/|E0|"), "start"),
        Invariant("angular momentum", ("Angular momentum", "(L - L0)/L0"), "start", "angular_momentum"),
    )
    trial: ClassVar[Trial] = Trial(states=((0.5, 1.0), (0.5, 1.0), (-1, 1), (-1, 1)), parameters={}, step=(0.001, 0.01))
    by_flow: ClassVar[dict[str, Any]] = {"state": Along(), "period": Period(lambda _m, y: y[1], per_period=2)}
    rows: ClassVar[tuple[Row, ...]] = (
        Row(
            "state",
            tuple(
                Quantity(name, "1", words, "Kepler's problem")
                for name, words in (
                    ("x", "first coordinate"),
                    ("y", "second coordinate"),
                    ("px", "first momentum"),
                    ("py", "second momentum"),
                )
            ),
            TIME,
        ),
        Row("period", (Quantity("period", "1", "period", "2 pi a^(3/2)"),), ONCE),
    )

    def __init__(self, v: Any = 2, r: Any = PERICENTRE) -> None:
        for name, value in (("v", v), ("r", r)):
            object.__setattr__(self, name, exact(value, name))
        if not (self.r > 0 and 1 < self.r * self.v**2 < 2):
            raise ValueError(f"v is {as_number(self.v)}; a speed of an ellipse from its pericentre is accepted.")

    def __repr__(self) -> str:
        return f"Kepler(v={as_number(self.v)!r}, r={as_number(self.r)!r})"

    @property
    def equation(self) -> str:
        return "(x, y)'' = -(x, y)/(x^2 + y^2)^(3/2), from the pericentre (r, 0) at the speed v"

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"v": (float(self.v), "")}

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.r, Fraction(0), Fraction(0), self.v

    def hamiltonian(self, m: Any, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del t, c
        return (p[0] * p[0] + p[1] * p[1]) / 2 - 1 / m.sqrt(q[0] * q[0] + q[1] * q[1])

    def angular_momentum(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        del m, p
        return y[0] * y[3] - y[1] * y[2]

    def closed_form(self, m: Any) -> ClosedForm:
        return Ellipse(m, m.number(self.r), m.number(self.v))


class Ellipse(ClosedForm):
    """Kepler's ellipse in an arithmetic."""

    def __init__(self, m: Any, r: Any, v: Any) -> None:
        self.m, self.a, self.e = m, 1 / (2 / r - v * v), r * v * v - 1
        self.pace = m.sqrt(self.a * self.a * self.a)

    @property
    def period(self) -> Any:
        return 2 * self.m.pi() * self.pace

    def state(self, t: Any) -> tuple[Any, ...]:
        m, mean = self.m, t / self.pace
        anomaly = m.root(lambda m, x: x - self.e * m.sin(x) - mean, mean - 1, mean + 1)
        sine, cosine, minor = m.sin(anomaly), m.cos(anomaly), m.sqrt(1 - self.e * self.e)
        rate = self.a / (self.pace * (1 - self.e * cosine))
        return self.a * (cosine - self.e), self.a * minor * sine, -rate * sine, rate * minor * cosine


@dataclass(frozen=True, repr=False)
class Forced(SeparableProblem):
    """angle'' = -angle + F cos(nu t), from rest; angle = (angle0 - b) cos t + b cos(nu t), b = F/(1 - nu^2)."""

    angle: Fraction
    strength: Fraction

    name: ClassVar[str] = "toy forced"
    autonomous: ClassVar[bool] = False
    space: ClassVar[StateSpace] = StateSpace(
        positions=("angle",),
        velocities=("rate",),
        angles=("angle",),
        odd=("rate",),
        along=None,
        scale="units",
        independent="s",
    )
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    trial: ClassVar[Trial] = Trial(
        states=((-3, 3), (-3, 3)), parameters={"strength": (0.5, 2.0), "nu": (0.5, 0.9)}, step=(0.01, 0.1)
    )
    rows: ClassVar[tuple[Row, ...]] = (
        Row(
            "state",
            (
                Quantity("angle", "rad", "angle", "angle'' = -angle + strength cos(nu t)"),
                Quantity("rate", "rad s-1", "its rate", "d(angle)/dt"),
            ),
            TIME,
        ),
    )

    def __init__(self, angle: Any = 1, strength: Any = 2) -> None:
        for name, value in (("angle", angle), ("strength", strength)):
            object.__setattr__(self, name, exact(value, name))

    def __repr__(self) -> str:
        return f"Forced(angle={as_number(self.angle)!r}, strength={as_number(self.strength)!r})"

    @property
    def equation(self) -> str:
        return "angle'' = -angle + strength cos(nu t), from rest at angle"

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"angle": (float(self.angle), "rad")}

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"strength": self.strength, "nu": Fraction(5, 8)}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.angle, Fraction(0)

    @staticmethod
    def velocity(m: Any, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, p
        return (momenta[0],)

    @staticmethod
    def force(m: Any, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return (-positions[0] + p["strength"] * m.cos(p["nu"] * t),)

    def rate(self) -> float:
        return 1.0

    def closed_form(self, m: Any) -> ClosedForm:
        return Beats(m, *map(m.number, (self.angle, *self.parameters.values())))


class Beats(ClosedForm):
    """The sum of the two cosines in an arithmetic."""

    def __init__(self, m: Any, angle: Any, strength: Any, nu: Any) -> None:
        self.m, self.angle, self.nu, self.b = m, angle, nu, strength / (1 - nu * nu)

    def state(self, t: Any) -> tuple[Any, ...]:
        m, own = self.m, self.angle - self.b
        angle = own * m.cos(t) + self.b * m.cos(self.nu * t)
        return angle, -own * m.sin(t) - self.b * self.nu * m.sin(self.nu * t)


def independent_kepler(v: float, t: float) -> tuple[Fraction, ...]:
    """Kepler's ellipse once more, by mpmath's own root finder at 60 digits."""
    with mp.workdps(60):
        r, speed = mp.mpf(PERICENTRE.numerator) / PERICENTRE.denominator, mp.mpf(v)
        a, e = 1 / (2 / r - speed**2), r * speed**2 - 1
        n = a ** mp.mpf("-1.5")
        x = mp.findroot(lambda x: x - e * mp.sin(x) - n * mp.mpf(t), n * mp.mpf(t))
        return tuple(map(to_fraction, (a * (mp.cos(x) - e), a * mp.sqrt(1 - e**2) * mp.sin(x))))


V = Coordinate("v", "1", "speed at the pericentre")
TAU = Coordinate("time", "1", "time since the pericentre")
ELLIPSES = Layout(
    "/toy/kepler",
    "Kepler's ellipses from one pericentre",
    (V,),
    {"time": TAU},
    (),
    Kepler.rows,
    Kepler,
    "I. Newton, Philosophiae Naturalis Principia Mathematica, 1687",
    "(x, y)'' = -(x, y)/r^3",
    "average",
)
ANGLE = Coordinate("initial_angle", "rad", "angle at the start")


def released(initial_angle: float) -> Forced:
    """The oscillator from rest at an angle."""
    return Forced(initial_angle)


SECONDS = Coordinate("time", "s", "time since the start")
BEATS = Layout(
    "/toy/forced",
    "forced oscillations from rest",
    (ANGLE,),
    {"time": SECONDS},
    (),
    Forced.rows,
    released,
    "any textbook of mechanics",
    "angle'' = -angle + 2 cos(5 t/8)",
    "lower",
)


def ellipses() -> tuple[Group, ...]:
    return (Group(ELLIPSES, {}, {"v": (1.75, 2.0), "time": (0.5, 1.0, 7.25)}),)


def beats() -> tuple[Group, ...]:
    return (Group(BEATS, {}, {"initial_angle": (0.5, 1.0), "time": (0.5, 1.0, 7.25)}),)


KEPLER = Family(
    name="toy-kepler",
    help="Kepler's problem from its pericentre",
    problem=Kepler,
    inputs=(
        Input("v", "1", "speed at the pericentre"),
        Input("r", "1", "distance of the pericentre", "0.4"),
        Input("t", "1", "time", over="time"),
    ),
    rows=("state", "period"),
    comparison=Comparison(
        "toy-kepler", "score integrators on Kepler's problem", varied="v", values=(2.0,), what="speed", inputs=("r",)
    ),
    reported=(Reported("toy-kepler", "v", "", "", (2.0,), Kepler),),
    layouts=(ELLIPSES,),
    core=ellipses,
    full=ellipses,
)
FORCED = Family(
    name="toy-forced",
    help="a forced oscillator",
    problem=Forced,
    inputs=(
        Input("angle", "rad", "angle at the start"),
        Input("strength", "rad s-2", "strength of the force", "2"),
        Input("t", "s", "time", over="time"),
    ),
    rows=("state",),
    comparison=Comparison(
        "toy-forced", "score integrators on a forced oscillator", "angle", (1.0,), "angle", ("strength",)
    ),
    reported=(Reported("toy-forced", "angle", "rad", "rad", (1.0,), Forced),),
    layouts=(BEATS,),
    core=beats,
    full=beats,
)
