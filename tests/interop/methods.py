"""Methods of other packages, with what each package itself claims of them.

An order is that of the method's name, of its documentation or of its attribute; ``symplectic`` and ``reversible`` stand
where the package says so, ``estimate`` and ``dense`` where it tells the order of its error estimate and of its states
between steps, and ``tolerance`` = 1 for a solver that chooses its steps by a relative tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

__all__ = ["EXPLAINED", "METHODS", "TABLES", "Method"]

TABLES = ("nodepy", "class_table", "torchdiffeq_table")
"""Builders that take a table of coefficients from a package, and march it themselves."""


@dataclass(frozen=True)
class Method:
    """A method of a package.

    Attributes:
        package: its name, as it is installed.
        name: of the method.
        builder: the function of ``made.py`` that makes of its name what ``compare.check`` takes.
        claims: what the package says of it.
    """

    package: str
    name: str
    builder: str
    claims: dict[str, Any] = field(hash=False)

    def __str__(self) -> str:
        return f"{self.package}: {self.name}"


def of(package: str, builder: str, table: str) -> tuple[Method, ...]:
    """A line a method: its name, and after two blanks its claims, a number or True where there is none."""
    found = []
    for line in table.strip().splitlines():
        name, _, words = line.strip().partition("  ")
        claims = {
            key: float(value) if value else True for key, _, value in (word.partition("=") for word in words.split())
        }
        found.append(Method(package, name.strip(), builder, claims))
    return tuple(found)


NODEPY = of(
    "nodepy",
    "nodepy",
    """
    FE  order=1
    BE  order=1
    SSP22star  order=2
    Heun22  order=2
    MTE22  order=2
    Mid22  order=2
    NSSP32  order=2
    NSSP33  order=3
    SSP33  order=3
    Heun33  order=3
    SSP43  order=3
    SSP53  order=3
    SSP63  order=3
    SSP54  order=4
    SSP104  order=4
    SSP75  order=5
    SSP85  order=5
    SSP95  order=5
    RK44  order=4
    BuRK65  order=5
    Lambert65  order=5
    BS3  order=3 estimate=2
    SS3  order=3 estimate=2
    Merson43  order=4 estimate=3
    Fehlberg43  order=4 estimate=3
    Soderlind43  order=4 estimate=3
    Zonneveld43  order=4 estimate=3
    Fehlberg45  order=5 estimate=4
    CK5  order=5 estimate=4
    DP5  order=5 estimate=4
    HH5  order=5 estimate=4
    HH5S  order=5 estimate=4
    Tsit5  order=5 estimate=4
    BS5  order=5 estimate=4
    CMR6  order=6 estimate=5
    PD8  order=8 estimate=7
    TR-BDF2  order=2
    SDIRK23  order=3
    SDIRK34  order=4
    SDIRK54  order=4
    GL2  order=4
    GL3  order=6
    LobattoIIIA2  order=2
    LobattoIIIA3  order=4
    LobattoIIIC2  order=2
    LobattoIIIC3  order=4
    LobattoIIIC4  order=6
    RadauIIA2  order=3
    RadauIIA3  order=5
    """,
)
"""Of Lobatto's, Radau's and Gauss's families the name tells the stages s, and nodepy's documentation the family: their
orders are 2s - 2, 2s - 1 and 2s."""

DESOLVER = of(
    "desolver",
    "desolver",
    """
    EulerSolver  order=1
    MidpointSolver  order=2
    HeunsSolver  order=2
    RalstonsSolver  order=2
    EulerTrapSolver  order=2
    HeunEulerSolver  order=2 estimate=1
    RK4Solver  order=4
    RK5Solver  order=5
    RK45CKSolver  order=5 estimate=4
    DOPRI45  order=5 estimate=4
    RK8713MSolver  order=8 estimate=7
    RK108Solver  order=10 estimate=8
    RK1412Solver  order=14 estimate=12
    SymplecticEulerSolver  order=1 symplectic
    ABAs5o6HSolver  order=6 symplectic
    BABs9o7HSolver  order=7 symplectic
    BackwardEuler  order=1
    ImplicitMidpoint  order=2 symplectic
    CrankNicolson  order=2
    DIRK3LStable  order=3
    GaussLegendre4  order=4 symplectic
    GaussLegendre6  order=6 symplectic
    LobattoIIIA2  order=2
    LobattoIIIA4  order=4
    LobattoIIIB2  order=2
    LobattoIIIB4  order=4
    LobattoIIIC2  order=2
    LobattoIIIC4  order=4
    RadauIA3  order=3
    RadauIA5  order=5
    RadauIIA3  order=3
    RadauIIA5  order=5
    """,
)

PYHAMSYS = of(
    "pyhamsys",
    "pyhamsys",
    """
    Verlet  order=2 symplectic
    FR  order=4 symplectic
    Yo4  order=4 symplectic
    Yo6  order=6 symplectic
    Yo8  order=8 symplectic
    Yos6  order=6 symplectic
    M2  order=2 symplectic
    M4  order=4 symplectic
    EFRL  order=4 symplectic
    PEFRL  order=4 symplectic
    VEFRL, kick first  order=4 symplectic
    BM4  order=4 symplectic
    BM6  order=6 symplectic
    RKN4b, kick first  order=4 symplectic
    RKN6b, kick first  order=6 symplectic
    RKN6a  order=6 symplectic
    ABA104  order=4 symplectic
    ABA864  order=4 symplectic
    ABA1064  order=4 symplectic
    """,
)
"""The generalised orders (10,4), (8,6,4) and (10,6,4) are of order 4 where no part is small."""

DIFFRAX = (
    *of(
        "diffrax",
        "diffrax",
        """
        Euler  order=1
        Heun  order=2 estimate=1
        Midpoint  order=2 estimate=1
        Ralston  order=2 estimate=1
        Bosh3  order=3 estimate=2 dense=3
        Dopri5  order=5 estimate=4 dense=5
        Tsit5  order=5 estimate=4 dense=5
        Dopri8  order=8 estimate=7 dense=8
        ImplicitEuler  order=1
        Kvaerno3  order=3
        Kvaerno4  order=4
        Kvaerno5  order=5
        KenCarp3  order=3
        KenCarp4  order=4
        KenCarp5  order=5
        Sil3  order=2
        """,
    ),
    *of("diffrax", "diffrax_pair", "SemiImplicitEuler  order=1 symplectic"),
    *of("diffrax", "diffrax_with_memory", "ReversibleHeun  order=2\n LeapfrogMidpoint  order=2"),
    *of("diffrax", "diffrax_adaptive", "Tsit5, adaptive  tolerance=1\n Dopri8, adaptive  tolerance=1"),
)

TORCHDIFFEQ = (
    *of(
        "torchdiffeq",
        "torchdiffeq",
        """
        euler  order=1
        midpoint  order=2
        heun2  order=2
        heun3  order=3
        rk4  order=4
        explicit_adams max_order=4  order=4
        implicit_adams max_order=4  order=4
        """,
    ),
    *of(
        "torchdiffeq",
        "torchdiffeq_table",
        """
        adaptive_heun  order=2
        fehlberg2  order=2
        bosh3  order=3
        dopri5  order=5
        dopri8  order=8
        """,
    ),
    *of("torchdiffeq", "torchdiffeq_adaptive", "dopri5, adaptive  tolerance=1\n dopri8, adaptive  tolerance=1"),
)

GALA = (
    *of(
        "gala",
        "gala",
        """
        LeapfrogIntegrator  order=2 symplectic reversible
        Ruth4Integrator  order=4 symplectic reversible
        RK5Integrator  order=5
        """,
    ),
    *of("gala", "gala_adaptive", "DOPRI853Integrator  tolerance=1"),
)

REBOUND = (
    *of(
        "rebound",
        "rebound",
        """
        leapfrog  order=2 symplectic
        leapfrog order=4  order=4 symplectic
        leapfrog order=6  order=6 symplectic
        leapfrog order=8  order=8 symplectic
        janus order=2  order=2 symplectic reversible
        janus order=4  order=4 symplectic reversible
        janus order=6  order=6 symplectic reversible
        janus order=8  order=8 symplectic reversible
        janus order=10  order=10 symplectic reversible
        ias15 epsilon=0  order=15
        """,
    ),
    *of("rebound", "rebound_adaptive", "ias15, adaptive  tolerance=1\n bs, adaptive  tolerance=1"),
)

SCIPY = (
    *of(
        "scipy",
        "solver_class",
        """
        scipy.integrate.RK23  order=3 estimate=2 dense=3
        scipy.integrate.RK45  order=5 estimate=4 dense=4
        scipy.integrate.DOP853  order=8 dense=7
        """,
    ),
    *of(
        "scipy",
        "solver_as_it_is",
        """
        scipy.integrate.RK23, adaptive  tolerance=1
        scipy.integrate.RK45, adaptive  tolerance=1
        scipy.integrate.DOP853, adaptive  tolerance=1
        scipy.integrate.Radau, adaptive  tolerance=1
        scipy.integrate.BDF, adaptive  tolerance=1
        scipy.integrate.LSODA, adaptive  tolerance=1
        """,
    ),
    *of("scipy", "odeint", "odeint, adaptive  tolerance=1"),
)

EXTENSISQ = (
    *of(
        "extensisq",
        "solver_class",
        """
        extensisq.Me4  order=4 dense=3
        extensisq.BS5  order=5 estimate=4 dense=5
        extensisq.CK5  order=5 estimate=4 dense=4
        extensisq.Ts5  order=5 estimate=4 dense=4
        extensisq.Pr7  order=7 estimate=5 dense=5
        extensisq.Pr8  order=8 estimate=6 dense=6
        extensisq.Pr9  order=9 estimate=7 dense=7
        extensisq.CFMR7osc  order=7 estimate=5 dense=5
        """,
    ),
    *of(
        "extensisq",
        "class_table",
        """
        extensisq.TRBDF2  order=2
        extensisq.TRX2  order=2
        extensisq.Kv3I  order=3
        extensisq.KC3I  order=3
        extensisq.KC4I  order=4
        extensisq.KC4Ia  order=4
        """,
    ),
    *of(
        "extensisq",
        "second_order_class",
        """
        extensisq.Fi4N  order=4
        extensisq.Fi5N  order=5
        extensisq.Mu5Nmb  order=5
        extensisq.MR6NN  order=6
        """,
    ),
    *of(
        "extensisq",
        "solver_as_it_is",
        """
        extensisq.BS5, adaptive  tolerance=1
        extensisq.CKdisc, adaptive  tolerance=1
        extensisq.Ts5, adaptive  tolerance=1
        extensisq.Pr7, adaptive  tolerance=1
        extensisq.Pr8, adaptive  tolerance=1
        extensisq.Pr9, adaptive  tolerance=1
        extensisq.SWAG, adaptive  tolerance=1
        extensisq.KC4I, adaptive  tolerance=1
        """,
    ),
)

NUMBA = of(
    "numba", "numba", "rk4, njit with f  order=4\n verlet, njit with its equation  order=2 symplectic reversible"
)
JAX = (
    *of("jax", "jax", "rk4, jit with f  order=4\n verlet, jit with its equation  order=2 symplectic reversible"),
    *of("jax", "jax_odeint", "jax.experimental.ode.odeint, adaptive  tolerance=1"),
)

METHODS = (
    *NODEPY, *DESOLVER, *PYHAMSYS, *DIFFRAX, *TORCHDIFFEQ, *GALA, *REBOUND, *SCIPY, *EXTENSISQ, *NUMBA, *JAX,
)  # fmt: skip

ROUNDING = (
    "the errors reach rounding before the slopes have settled; a step of plain arithmetic would have its power series"
)
LATE_TIMES = (
    "its __call__ gives every step the time of its end, times[ii], so that a force in time is taken a step too late; "
    "of a force without the time it is of its order"
)
EXPLAINED: dict[tuple[str, str, str], str] = {
    ("nodepy", "Lambert65", "order"): (
        "its third row is (1/8, 1/8), which fails the trees of order 3; with (3/16, 1/16), as Lawson has it, "
        "those up to order 5 hold"
    ),
    ("nodepy", "SS3", "order"): (
        "its weights b fail the trees of order 3, and those of its embedded method hold: the two are exchanged"
    ),
    ("nodepy", "SSP53", "order"): (
        "its weights add up to 1 + 3.2e-10: its coefficients have nine digits, and errors end at 2e-9"
    ),
    ("desolver", "ABAs5o6HSolver", "order"): (
        "its source, arXiv:1501.04345, is named Efficient Fourth Order Symplectic Integrators: 6 is an order for "
        "near-harmonic systems alone"
    ),
    ("desolver", "BABs9o7HSolver", "order"): "as ABAs5o6HSolver, of the same source",
    ("desolver", "RK8713MSolver", "order"): (
        "it carries on the first of its rows of weights, which fails the trees of order 8; its second is of order 8"
    ),
    ("desolver", "RK108Solver", "order"): ROUNDING,
    ("desolver", "RK108Solver", "estimate"): (
        "the trees of order 9 are missed by 6e-6 alone, so that the next term hides that one until rounding"
    ),
    ("desolver", "RK1412Solver", "order"): ROUNDING,
    ("desolver", "RK1412Solver", "estimate"): ROUNDING,
    ("desolver", "RadauIIA3", "order"): (
        "its second row is (3/4, 1/3), which does not add up to its node 1; (3/4, 1/4) does, and is Radau's"
    ),
    ("gala", "Ruth4Integrator", "order"): LATE_TIMES,
    ("gala", "RK5Integrator", "order"): LATE_TIMES,
    ("torchdiffeq", "explicit_adams max_order=4", "order"): (
        "its history has max_order - 1 slopes, so that the explicit formula has three steps and order 3"
    ),
    ("torchdiffeq", "dopri8, adaptive", "tolerance"): (
        "between its steps it has a polynomial of degree four, whose error is that of the states at the times asked for"
    ),
    ("rebound", "ias15, adaptive", "tolerance"): "its errors are rounding with every epsilon",
    ("scipy", "scipy.integrate.DOP853", "order"): ROUNDING,
    ("extensisq", "extensisq.Pr8", "order"): ROUNDING,
    ("extensisq", "extensisq.Pr9", "order"): ROUNDING,
    ("extensisq", "extensisq.Fi5N", "order"): "slopes from 5.0 to 5.4, which have not settled where rounding begins",
    ("diffrax", "Dopri8", "order"): ROUNDING,
    ("diffrax", "KenCarp5", "order"): ROUNDING,
    ("diffrax", "Dopri5", "dense"): (
        "in a step its error goes with h^5, which the documentation counts as order 5; Bosh3's with h^4, as order 3"
    ),
    ("diffrax", "Tsit5", "dense"): "as Dopri5",
    ("diffrax", "Dopri8", "dense"): (
        "its documentation says order 8, and in a step its error goes with h^6, on y' = y cos t too"
    ),
}
"""Package, method and claim of what is no PASS, and why that is so."""
