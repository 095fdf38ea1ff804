"""The brachistochrone of a point mass as a curve, marched as the thesis marches it: singular at the lowest point.

The independent variable starts at zero and is the last component of the state, whose rate is one, so that a method's
stages are taken at its own nodes.  A march along a curve conserves nothing, and neighbouring solutions stay as far
apart as they start.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact
from reference.declaration import ClosedForm, Form, Invariant, Quantity, Row, StateSpace, Trial
from reference.once import cached_property
from reference.problem import APART, Problem
from reference.problems.polar.equations import POINT_MASS
from reference.problems.polar.problem import PolarBrachistochrone
from reference.routes.taylor import taylor_route
from reference.row_domains import Reals

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.routes.taylor import Reading, TaylorRoute
    from reference.row_domains import Domain

__all__ = ["PolarByPsi", "PolarByZ"]

ZERO, ONE = Fraction(0), Fraction(1)
DEPTH = Reals("depth", "depth", ZERO)
"""Below the release, to the lowest point."""
PHI = Quantity("phi", "rad", "angle swept since the release", "dphi/dpsi = z0^(3/2) (1 - z)/(z sqrt(Q))")


@dataclass(frozen=True, repr=False)
class PolarCurve(Problem):
    """The brachistochrone in the field of a point mass as a curve, by its lowest point z0, 0 < z0 < 1."""

    z0: Fraction

    invariants: ClassVar[tuple[Invariant, ...]] = ()
    row_of_polar: ClassVar[str]

    def __init__(self, z0: Any) -> None:
        object.__setattr__(self, "z0", exact(z0, "z0"))
        _ = self.polar  # refuses a lowest point that is none

    def __repr__(self) -> str:
        return f"{type(self).__name__}(z0={as_number(self.z0)!r})"

    @cached_property
    def polar(self) -> PolarBrachistochrone:
        """The same path as a motion."""
        return PolarBrachistochrone(z0=self.z0)

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"z0": self.z0}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return (ZERO,) * len(self.state_names)

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"z0": (float(self.z0), "")}

    def rate(self) -> float:
        """Zero: the slopes do not depend on what is summed."""
        return 0.0

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> PolarCurve:
        """The path whose lowest point is lower by 2^-36 of itself, or by 16 roundings."""
        return type(self)(rounding(self.z0 * (1 - max(APART, 16 * epsilon))))

    def working_bits(self, arguments: Sequence[Any]) -> int:
        return self.polar.working_bits(arguments)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The start, and the independent variable itself."""
        del row
        return self.start if argument == 0 else (*(None,) * (len(self.state_names) - 1), argument)

    def closed_form(self, m: Any) -> ClosedForm:
        """The closed form of the motion, read along the curve."""
        return _Along(self, m)

    def argument(self, along: Fraction) -> Fraction:
        """What the motion's row is asked for."""
        raise NotImplementedError

    def summed(self, values: Sequence[Any]) -> tuple[Any, ...]:
        """Of the motion's row what the curve sums up."""
        raise NotImplementedError


class _Along(ClosedForm):
    """The state of a curve from the row of its motion."""

    def __init__(self, curve: PolarCurve, m: Any) -> None:
        self._curve, self._m = curve, m
        self._form = curve.polar.closed_form(m)

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        """(what is summed, the independent variable)."""
        del row
        found = self._form.rows(self._curve.row_of_polar, [self._curve.argument(a) for a in arguments])
        return [(*self._curve.summed(one), self._m.number(a)) for one, a in zip(found, arguments, strict=True)]


def along_the_motion(route: TaylorRoute, _row: str, arguments: Sequence[Fraction]) -> list[tuple[Any, ...]]:
    """The state of a curve from the row of its motion, which the flow reads where the curve itself is regular."""
    curve = route.problem
    found = taylor_route(curve.polar, route.bits).rows(curve.row_of_polar, [curve.argument(a) for a in arguments])
    return [(*curve.summed(one), a) for one, a in zip(found, arguments, strict=True)]


@dataclass(frozen=True, init=False, repr=False)
class PolarByZ(PolarCurve):
    """dphi/dz = -(z0^(3/2)/z) sqrt((1 - z)/((z - z0) Q)), marched downwards by the depth d = 1 - z.

    Its slope is vertical at the release, and infinite at the lowest point d = 1 - z0.
    """

    name: ClassVar[str] = "polar curve in z"
    rows: ClassVar[tuple[Row, ...]] = (
        Row("state", (PHI, Quantity("depth", "1", "depth below the release", "1 - z")), DEPTH),
    )
    space: ClassVar[StateSpace] = StateSpace(
        positions=("phi",), angles=("phi",), odd=None, along="depth", scale="largest", independent=""
    )
    trial: ClassVar[Trial] = Trial(states=((-3.0, 3.0), (0.1, 0.2)), parameters={"z0": (0.2, 0.4)}, step=(0.001, 0.002))
    form: ClassVar[Form] = Form(
        "z",
        "curve dphi/dz",
        "dphi/dz = -(z0^(3/2)/z) sqrt((1 - z)/((z - z0) Q)), Q = (1 - z0) z^2 + z0 (1 - z0) z + z0^2, down from z = 1",
    )
    row_of_polar: ClassVar[str] = "by_z"
    by_flow: ClassVar[Mapping[str, Reading]] = {"state": along_the_motion}

    @staticmethod
    def derivative(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(dphi/dd, 1)."""
        z0, depth = p["z0"], y[1]
        z = 1 - depth
        bend = depth / ((z - z0) * POINT_MASS.quadratic(z0, z))
        return z0 * m.sqrt(z0) / z * m.sqrt(bend), m.number(ONE)

    def domain(self, row: Row) -> Domain:
        """Depths end at the lowest point, 1 - z0."""
        return replace(DEPTH, high=1 - self.z0) if row.domain is DEPTH else row.domain

    def argument(self, along: Fraction) -> Fraction:
        return 1 - along

    def summed(self, values: Sequence[Any]) -> tuple[Any, ...]:
        return (values[0],)


@dataclass(frozen=True, init=False, repr=False)
class PolarByPsi(PolarCurve):
    """The same by the angle psi, z = z0 sin^2(psi/2) + cos^2(psi/2): smooth, through the lowest point at psi = pi."""

    name: ClassVar[str] = "polar curve in psi"
    rows: ClassVar[tuple[Row, ...]] = (
        Row(
            "state",
            (
                PHI,
                Quantity("tau", "1", "time since the release", "dtau/dpsi = z^2 sqrt((1 - z0)/Q)"),
                Quantity("psi", "rad", "parameter of the curve", "psi"),
            ),
            Reals("psi", "psi"),
        ),
    )
    space: ClassVar[StateSpace] = StateSpace(
        positions=("phi", "tau"), angles=("phi",), odd=None, along="psi", scale="largest", independent="rad"
    )
    trial: ClassVar[Trial] = Trial(
        states=((-3.0, 3.0), (-3.0, 3.0), (0.5, 6.0)), parameters={"z0": (0.2, 0.8)}, step=(0.01, 0.1)
    )
    form: ClassVar[Form] = Form(
        "psi",
        "curve dphi/dpsi",
        "dphi/dpsi = z0^(3/2) (1 - z)/(z sqrt(Q)), dtau/dpsi = z^2 sqrt((1 - z0)/Q), z = z0 sin^2 + cos^2 of psi/2",
    )
    row_of_polar: ClassVar[str] = "curve"

    @staticmethod
    def derivative(m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(dphi/dpsi, dtau/dpsi, 1)."""
        half = y[2] / 2
        sine, cosine = m.sin(half), m.cos(half)
        return *POINT_MASS.rates(m, p["z0"], sine * sine, cosine * cosine), m.number(ONE)

    def argument(self, along: Fraction) -> Fraction:
        return along

    def summed(self, values: Sequence[Any]) -> tuple[Any, ...]:
        return tuple(values[1:])
