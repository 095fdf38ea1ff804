"""What can be asked of a tunnel through a uniform planet: names, units and definitions."""

from reference.problems.polar.quantities import Definitions, rows_of

__all__ = ["ROWS"]

ROWS = rows_of(
    Definitions(
        height="z^2 = (1 + z0^2)/2 + ((1 - z0^2)/2) cos(psi)",
        phi="phi = atan(z0 tan(psi/2)) - z0 psi/2, continuous in psi",
        tau="tau = sqrt(1 - z0^2) psi/2",
        rate="z'' = -z + kappa (1 - z^4)/z^3, phi' = sqrt(kappa) (1 - z^2)/z^2",
        kappa="kappa = z0^2/(1 - z0^2)",
        half_angle="(pi/2) (1 - z0)",
        descent_time="(pi/2) sqrt(1 - z0^2), in units of sqrt(r0/g)",
        time_unit="sqrt(r0/g)",
        setting="the density the same everywhere",
    )
)
