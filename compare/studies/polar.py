"""Every method on the brachistochrone in the field of a point mass: as a motion, and as a curve in z and in psi.

dphi/dz is what the thesis integrates (J. Šalinović, Problem brahistokrone u nehomogenom gravitacijskom polju,
University of Split 2022): it is singular at the lowest point, where psi goes through smoothly.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.paths import PolarByPsi, PolarByZ
from compare.scoring import some
from compare.studies.common import SHORTER_N, distinct, forms_of, made
from reference import PolarBrachistochrone
from reference.exact import as_number, exact

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.records import Study
    from reference.problem import Problem

__all__ = ["FORMS", "study"]

FORMS = {
    "time": "z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3, from rest at z = 1",
    "z": "dphi/dz = -(z0^(3/2)/z) sqrt((1 - z)/((z - z0) Q)), Q = (1 - z0) z^2 + z0 (1 - z0) z + z0^2, down from z = 1",
    "psi": "dphi/dpsi = z0^(3/2) (1 - z)/(z sqrt(Q)), dtau/dpsi = z^2 sqrt((1 - z0)/Q), z = z0 sin^2 + cos^2 of psi/2",
}
ABOVE_THE_LOWEST = 1e-4
"""Part of the way down at which the curve in z ends before its lowest point."""


def study(
    z0: Sequence[Any] = (0.5,),
    tau_end: Any = 10.0,
    z_end: Any = None,
    psi_end: Any = 6.25,
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
        options: of ``compare.scoring.score_all``.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    forms = forms_of(some(form, "form"), tuple(FORMS))
    paths = [PolarBrachistochrone(z0=value) for value in some(z0, "z0")]
    distinct([float(path.z0 or 0) for path in paths], "z0", "lowest point")
    problems: list[Problem] = []
    ends: list[Any] = []
    for name in forms:
        for path in paths:
            lowest = exact(path.z0, "z0")
            problems.append({"time": path, "z": PolarByZ(lowest), "psi": PolarByPsi(lowest)}[name])
            ends.append({"time": tau_end, "z": _depth(lowest, z_end), "psi": psi_end}[name])
    parameters: dict[str, Any] = {"z0": [as_number(exact(path.z0, "z0")) for path in paths]}
    lasts = {"time": ("tau_end", tau_end), "psi": ("psi_end", psi_end)}
    parameters |= {lasts[name][0]: as_number(exact(lasts[name][1], lasts[name][0])) for name in forms if name in lasts}
    if "z" in forms:
        parameters["z_end"] = [float(1 - _depth(exact(path.z0, "z0"), z_end)) for path in paths]
    definition = {name: FORMS[name] for name in forms}
    return made("polar", problems, definition, parameters, traces=traces, n=n, t_end=ends, **options)


def _depth(lowest: Fraction, z_end: Any) -> Fraction:
    """How far below the release the curve in z ends."""
    if z_end is None:
        return exact(float(1 - lowest) * (1 - ABOVE_THE_LOWEST), "z_end")
    return 1 - exact(z_end, "z_end")
