"""What can be asked of the pendulum: names, units and definitions, w = sqrt(g/length) throughout."""

from reference.declaration import Quantity, Row
from reference.problems.pendulum.series import MAX_ORDER
from reference.row_domains import INDEX, ONCE, TIME, Whole

__all__ = ["LINDSTEDT_ROWS", "LINEAR_ROWS", "ROWS", "SERIES_ROWS", "SERVED"]

START = "theta(0) = theta0, omega(0) = omega0"
THETA = Quantity("theta", "rad", "angle from the lower rest position", f"theta'' = -(g/length) sin(theta), {START}")
OMEGA = Quantity("omega", "rad s-1", "angular velocity", "omega = theta'")
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
CONDITION = Quantity(
    "condition",
    "1",
    "growth of an error of the start",
    "largest singular value of d(theta, omega/w)/d(theta0, omega0/w) at fixed t, w = sqrt(g/length)",
)
PERIOD = Quantity(
    "period", "s", "period", "T = 4 K(k)/w, in rotation the time of one turn T = 2 K(1/k)/(w k); w = sqrt(g/length)"
)
ENERGY = Quantity("energy", "s-2", "energy per m l^2", "E = omega^2/2 - (g/length) cos(theta)")
MODULUS = Quantity("modulus", "1", "elliptic modulus", "k^2 = sin^2(theta0/2) + omega0^2 length/(4 g)")
COMPLEMENTARY = Quantity(
    "complementary_modulus", "1", "complementary elliptic modulus", "kc^2 = cos^2(theta0/2) - omega0^2 length/(4 g)"
)
ZERO_CROSSING = Quantity(
    "zero_crossing",
    "s",
    "times at which the pendulum hangs at the bottom",
    "t[j], the (j + 1)-th t > 0 with sin(theta/2) = 0, j = 0, 1, ...",
)
TURNING_POINT = Quantity(
    "turning_point", "s", "times at which the pendulum turns back", "t[j], the (j + 1)-th t > 0 with omega = 0"
)
SENSITIVITY = (
    Quantity("dtheta_damplitude", "1", "sensitivity of the angle to the amplitude", "dtheta/dtheta0 at fixed t"),
    Quantity("domega_damplitude", "s-1", "sensitivity of the velocity to the amplitude", "domega/dtheta0 at fixed t"),
)
CURVATURE = (
    Quantity(
        "d2theta_damplitude2",
        "rad-1",
        "second derivative of the angle by the amplitude",
        "d^2 theta/d(theta0)^2 at fixed t",
    ),
    Quantity(
        "d2omega_damplitude2",
        "rad-1 s-1",
        "second derivative of the velocity by the amplitude",
        "d^2 omega/d(theta0)^2 at fixed t",
    ),
)
PERIOD_SLOPE = Quantity(
    "dperiod_damplitude", "s rad-1", "sensitivity of the period to the amplitude", "dT/da, a = |theta0|"
)
PERIOD_CURVATURE = Quantity(
    "d2period_damplitude2", "s rad-2", "second derivative of the period by the amplitude", "d^2 T/da^2, a = |theta0|"
)
FORMULA = (("taylor", "a formula of the inputs, which no motion gives"),)
ROWS = (
    Row("state", (THETA, OMEGA), TIME),
    Row("sensitivity", SENSITIVITY, TIME),
    Row("curvature", CURVATURE, TIME),
    Row("gradient", GRADIENT, TIME),
    Row("condition", (CONDITION,), TIME),
    Row("period", (PERIOD,), ONCE),
    Row("energy", (ENERGY,), ONCE),
    Row("modulus", (MODULUS,), ONCE, FORMULA),
    Row("complementary_modulus", (COMPLEMENTARY,), ONCE, FORMULA),
    Row("dperiod_damplitude", (PERIOD_SLOPE,), ONCE),
    Row("d2period_damplitude2", (PERIOD_CURVATURE,), ONCE),
    Row("zero_crossing", (ZERO_CROSSING,), INDEX),
    Row("turning_point", (TURNING_POINT,), INDEX),
)

_ALWAYS = ("state", "energy", "gradient", "condition")
_AMPLITUDE = {"sensitivity", "curvature", "dperiod_damplitude", "d2period_damplitude2"}
SERVED = {
    "rest": ("state", "gradient", "condition"),
    "separatrix": _ALWAYS,
    "rotation": (*_ALWAYS, "period", "modulus", "zero_crossing"),
    "libration": tuple(row.name for row in ROWS if row.name not in _AMPLITUDE),
    "release": tuple(row.name for row in ROWS),
}
"""The rows that each motion has; "release" is the libration that starts from rest."""

LINEAR_ROWS = (
    Row(
        "state",
        (
            Quantity("theta", "rad", "angle of the linearised pendulum", f"theta'' = -(g/length) theta, {START}"),
            OMEGA,
        ),
        TIME,
    ),
    Row("period", (Quantity("period", "s", "period of the linearised pendulum", "T = 2 pi sqrt(length/g)"),), ONCE),
    Row(
        "energy",
        (
            Quantity(
                "energy", "s-2", "energy per m l^2 of the linearised pendulum", "E = (omega^2 + (g/length) theta^2)/2"
            ),
        ),
        ONCE,
    ),
)

ORDER = Whole("index", "order", MAX_ORDER)
SERIES_ROWS = (
    Row(
        "period_series",
        (
            Quantity(
                "period_series",
                "s",
                "period by its series in the amplitude",
                "T_n = 2 pi sqrt(length/g) (1 + a^2/16 + ... up to a^(2 n)), a = theta0",
            ),
        ),
        ORDER,
        FORMULA,
    ),
    Row(
        "period_series_error",
        (
            Quantity(
                "period_series_error", "1", "relative error of the period by its series", "T_n/T - 1, T the period"
            ),
        ),
        ORDER,
    ),
    Row(
        "lindstedt_error",
        (
            Quantity(
                "lindstedt_error",
                "rad",
                "error of the solution of Lindstedt and Poincare after one period",
                "theta_n(T) - theta0, theta_n up to a^(2 n + 1), its frequency up to a^(2 n); T the exact period",
            ),
        ),
        ORDER,
    ),
    Row(
        "lindstedt_crossing_error",
        (
            Quantity(
                "lindstedt_crossing_error",
                "rad",
                "error of the solution of Lindstedt and Poincare at the first passage through the bottom",
                "theta_n(T/4), theta_n up to a^(2 n + 1), its frequency up to a^(2 n); T the exact period",
            ),
        ),
        ORDER,
    ),
)
LINDSTEDT_ROWS = (
    Row(
        "lindstedt_angle",
        (
            Quantity(
                "lindstedt_angle",
                "rad",
                "angle by the solution of Lindstedt and Poincare",
                "theta_n = sum_j a^(2 j + 1) sum_m c[j][m] cos(m w t), j = 0 ... n, a = theta0",
            ),
        ),
        TIME,
        FORMULA,
    ),
    Row(
        "lindstedt_angle_error",
        (
            Quantity(
                "lindstedt_angle_error",
                "rad",
                "error of the angle by the solution of Lindstedt and Poincare",
                "theta_n - theta",
            ),
        ),
        TIME,
    ),
)
