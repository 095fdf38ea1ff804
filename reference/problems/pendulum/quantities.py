"""What can be asked of the pendulum: names, units and definitions."""

from reference.problem import Quantity, Row

__all__ = ["ROWS", "SERVED"]

THETA = Quantity("theta", "rad", "angle from the lower rest position", "theta = 2 atan(tan(theta0/2) cn(u, k))")
OMEGA = Quantity("omega", "rad s-1", "angular velocity", "omega = dtheta/dt = -2 k kc omega0 sn(u, k)/dn(u, k)")
GRADIENT = tuple(
    Quantity(f"d{name}_d{start}", units, f"sensitivity of the {what} to {which}", f"d({name})/d({start}) at fixed t")
    for name, what, all_units in (
        ("theta", "angle", ("1", "s", "rad s2 m-1", "rad m-1")),
        ("omega", "angular velocity", ("s-1", "1", "rad s m-1", "rad s-1 m-1")),
    )
    for (start, which), units in zip(
        (
            ("theta0", "the start's angle"),
            ("omega0", "the start's angular velocity"),
            ("g", "the acceleration of gravity"),
            ("length", "the length"),
        ),
        all_units,
        strict=True,
    )
)
FORMULA = (("taylor", "a formula of the inputs, which no motion gives"),)
ROWS = (
    Row("state", (THETA, OMEGA), "time"),
    Row(
        "sensitivity",
        (
            Quantity(
                "dtheta_damplitude", "1", "sensitivity of the angle to the amplitude", "dtheta/dtheta0 at fixed t"
            ),
            Quantity(
                "domega_damplitude", "s-1", "sensitivity of the velocity to the amplitude", "domega/dtheta0 at fixed t"
            ),
        ),
        "time",
    ),
    Row("gradient", GRADIENT, "time"),
    Row("period", (Quantity("period", "s", "period", "T = 4 K(k)/omega0, omega0 = sqrt(g/l)"),), "once"),
    Row(
        "energy",
        (Quantity("energy", "s-2", "energy per m l^2", "E = omega^2/2 - (g/l) cos(theta) = -(g/l) cos(theta0)"),),
        "once",
    ),
    Row("modulus", (Quantity("modulus", "1", "elliptic modulus", "k = sin(theta0/2)"),), "once", FORMULA),
    Row(
        "complementary_modulus",
        (Quantity("complementary_modulus", "1", "complementary elliptic modulus", "kc = cos(theta0/2)"),),
        "once",
        FORMULA,
    ),
    Row(
        "dperiod_damplitude",
        (Quantity("dperiod_damplitude", "s rad-1", "sensitivity of the period to the amplitude", "dT/dtheta0"),),
        "once",
    ),
    Row(
        "zero_crossing",
        (Quantity("zero_crossing", "s", "times at which theta = 0", "t[j] = (2 j + 1) T/4, j = 0, 1, ..."),),
        "index",
    ),
    Row(
        "turning_point",
        (
            Quantity(
                "turning_point", "s", "times at which omega = 0 after the start", "t[j] = (j + 1) T/2, j = 0, 1, ..."
            ),
        ),
        "index",
    ),
)

_ALWAYS = ("state", "energy", "gradient")
SERVED = {
    "rest": ("state", "gradient"),
    "separatrix": _ALWAYS,
    "rotation": (*_ALWAYS, "period", "modulus", "zero_crossing"),
    "libration": tuple(row.name for row in ROWS if row.name not in {"sensitivity", "dperiod_damplitude"}),
    "release": tuple(row.name for row in ROWS),
}
"""The rows that each motion has; "release" is the libration that starts from rest."""
