"""Every method on the brachistochrone in the field of a point mass: as a motion, and as a curve in z and in psi.

dphi/dz is what the thesis integrates (J. Šalinović, Problem brahistokrone u nehomogenom gravitacijskom polju,
University of Split 2022): it is singular at the lowest point, where psi goes through smoothly.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.studies.common import SHORTER_N, distinct, forms_of, made, positive_end
from compare.study import some
from reference import PolarBrachistochrone
from reference.arithmetic.exact import as_number, exact
from reference.problems.paths import PolarByPsi, PolarByZ

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Study
    from reference.problem import Problem

__all__ = ["FORMS", "PSI_END", "depth_above", "study"]

FORMS = {
    "time": "z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3, from rest at z = 1",
    "z": "dphi/dz = -(z0^(3/2)/z) sqrt((1 - z)/((z - z0) Q)), Q = (1 - z0) z^2 + z0 (1 - z0) z + z0^2, down from z = 1",
    "psi": "dphi/dpsi = z0^(3/2) (1 - z)/(z sqrt(Q)), dtau/dpsi = z^2 sqrt((1 - z0)/Q), z = z0 sin^2 + cos^2 of psi/2",
}
ABOVE_THE_LOWEST = Fraction(1, 10_000)
"""Part of the way down at which the curve in z ends before its lowest point."""
PSI_END = 6.25
"""Where the curve in psi ends, in rad: almost at rest again."""


def study(
    z0: Sequence[Any] = (0.5,),
    tau_end: Any = 10.0,
    z_end: Any = None,
    psi_end: Any = PSI_END,
    form: Sequence[str] = tuple(FORMS),
    n: Sequence[int] = SHORTER_N,
    *,
    traces: bool = False,
    **options: Any,
) -> Study:
    """Score methods on the brachistochrone to each lowest point.

    Args:
        z0: lowest points over the radius of the release, 0 < z0 < 1.
        tau_end: end of the march of the motion in units of sqrt(r0^3/(2 G M)); it goes on, up and down.
        z_end: end of the march of the curve in z, above z0; ABOVE_THE_LOWEST of the way before it if None.
        psi_end: end of the march of the curve in psi in rad.
        form: "time", "z" and "psi".
        n: numbers of steps, each a positive integer.
        traces: whether to keep trajectories for plots.
        options: of ``compare.study.score_all``.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    forms = forms_of(some(form, "form"), tuple(FORMS))
    lowest = [exact(value, "z0") for value in some(z0, "z0")]
    distinct([float(value) for value in lowest], "z0", "lowest point")
    motions = [PolarBrachistochrone(z0=value) for value in lowest]
    problems: list[Problem] = []
    ends: list[Fraction] = []
    parameters: dict[str, Any] = {"z0": [as_number(value) for value in lowest]}
    if "time" in forms:
        problems += motions
        ends += [positive_end(tau_end, "tau_end")] * len(lowest)
        parameters["tau_end"] = as_number(ends[-1])
    if "z" in forms:
        problems += [PolarByZ(value) for value in lowest]
        ends += [depth_above(value, z_end) for value in lowest]
        parameters["z_end"] = [as_number(1 - depth) for depth in ends[-len(lowest) :]]
    if "psi" in forms:
        problems += [PolarByPsi(value) for value in lowest]
        ends += [positive_end(psi_end, "psi_end")] * len(lowest)
        parameters["psi_end"] = as_number(ends[-1])
    definition = {name: FORMS[name] for name in forms}
    return made("polar", problems, definition, parameters, traces=traces, n=n, t_end=ends, **options)


def depth_above(lowest: Fraction, z_end: Any = None) -> Fraction:
    """How far below the release the curve in z ends: ABOVE_THE_LOWEST of the way if it is not said.

    Raises:
        ValueError: it is not above the lowest point and below the release.
    """
    if z_end is None:
        return 1 - exact(float(lowest + (1 - lowest) * ABOVE_THE_LOWEST), "z_end")
    if not lowest < (end := exact(z_end, "z_end")) < 1:
        raise ValueError(f"z_end is {as_number(end)}; a number with {as_number(lowest)} < z_end < 1 is accepted.")
    return 1 - end
