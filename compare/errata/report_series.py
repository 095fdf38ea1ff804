"""The report's expansions: section 3.3 and section 4, in the amplitude a = phi_init and with omega = 1."""

from __future__ import annotations

from fractions import Fraction
from math import factorial
from typing import TYPE_CHECKING, Any

from mpmath import mp

from compare.errata.cosines import coefficient, plus, sine, times
from compare.errata.erratum import REPORT, Erratum
from compare.errata.evidence import along, exactly, near, precisely, proven
from reference.problems.pendulum import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.errata.cosines import Cosines

__all__ = ["EXACT_SERIES", "PHI_B", "PROVEN_PERIOD", "SERIES", "is_forcing", "is_period", "third_order_vanishes"]

SMALL = Fraction(1, 1000)
PHI_A: Cosines = {(1, 1): Fraction(1)}
PHI_B: Cosines = {(3, 1): Fraction(1, 192), (3, 3): Fraction(-1, 192)}
PHI_B_PRINTED: Cosines = {key: -c for key, c in PHI_B.items()}
PHI_C: Cosines = {(5, k): Fraction(c, 184320) for k, c in ((1, 51), (3, -60), (5, 9))}
PHI_C_PRINTED: Cosines = {(5, k): Fraction(c, 184320) for k, c in ((1, 61), (3, -60), (5, -1))}
ALPHA, BETA, BETA_PRINTED = Fraction(-1, 8), Fraction(-17, 1536), Fraction(-5, 512)
STIFFNESS: Cosines = {(0, 0): Fraction(1), (2, 0): -ALPHA, (4, 0): -BETA}
"""omega0^2/omega^2."""


def _residual(phi: Cosines, power: int, stiffness: Cosines = STIFFNESS) -> dict[int, Fraction]:
    """What a^power is multiplied by in phi'' + stiffness sin phi."""
    curved = {(n, k): -k * k * c for (n, k), c in phi.items()}
    return coefficient(plus(curved, times(stiffness, sine(phi))), power)


def third_order_vanishes(phi_b: Cosines, alpha: Fraction = ALPHA) -> bool:
    """Whether phi_A + phi_B obeys the equation of motion up to the third power of the amplitude."""
    return not _residual(plus(PHI_A, phi_b), 3, {(0, 0): Fraction(1), (2, 0): -alpha})


def _fifth_order_vanishes(phi_c: Cosines) -> bool:
    return sum(phi_c.values()) == 0 and not _residual(plus(PHI_A, PHI_B, phi_c), 5)


def is_forcing(wanted: dict[int, Fraction]) -> bool:
    """Whether phi_C'' + phi_C is forced by these cosines, less beta cos: harmonics and their coefficients."""
    without_beta: Cosines = {(0, 0): Fraction(1), (2, 0): -ALPHA}
    found = _residual(plus(PHI_A, PHI_B), 5, without_beta)
    return all(found.get(k, Fraction(0)) == -c for k, c in wanted.items())


@precisely
def _phi_c_obeys(order: int) -> bool:
    """Whether the derivative of this order, plus phi_C, is the right side of (4.11)."""

    def value(series: Cosines, x: Any) -> Any:
        return sum(exactly(str(c)) * mp.cos(k * x) for (_, k), c in series.items())

    x = mp.mpf(1)
    a, b = value(PHI_A, x), value(PHI_B, x)
    alpha, beta = exactly(str(ALPHA)), exactly(str(BETA))
    right = beta * a - alpha * a**3 / 6 - a**5 / 120 + alpha * b + a * a * b / 2
    return near(mp.diff(lambda x: value(PHI_C, x), x, order) + value(PHI_C, x), right)


def _swing() -> Any:
    """T/T0 at the amplitude SMALL, proven."""
    return proven(Pendulum(SMALL, g=1, length=1), "period")[0] / (2 * mp.pi)


@precisely
def is_period(ratio: Callable[[Any], Any]) -> bool:
    """Whether T/T0 is right to the fourth power of a small amplitude."""
    return bool(abs(ratio(exactly(str(SMALL))) - _swing()) < exactly(str(SMALL)) ** 6)


@precisely
def _is_frequency(ratio: Callable[[Any], Any]) -> bool:
    """Whether omega^2/omega0^2 is right to the fourth power of a small amplitude."""
    return bool(abs(ratio(exactly(str(SMALL))) - 1 / _swing() ** 2) < exactly(str(SMALL)) ** 6)


@precisely
def _is_motion(series: tuple[Cosines, Cosines]) -> bool:
    """Whether phi_A + phi_B + phi_C is the proven motion to the sixth power of the amplitude 1/10."""
    amplitude = Fraction(1, 10)
    problem = Pendulum(amplitude, g=1, length=1)
    omega = 2 * mp.pi / proven(problem, "period")[0]
    terms = plus(PHI_A, *series)

    def phi(t: str) -> Any:
        return sum(exactly(str(c * amplitude**n)) * mp.cos(k * omega * exactly(t)) for (n, k), c in terms.items())

    return all(abs(phi(t) - along(problem, t)[0]) < exactly("1e-7") for t in ("1/2", "1", "5/2"))


@precisely
def _is_sine(form: Callable[[Any], Any]) -> bool:
    """Whether it is sin x to the sixth power of x = 1/10."""
    x = exactly("1/10")
    return bool(abs(form(x) - mp.sin(x)) < x**7)


def _sum_from(first: int) -> Callable[[Any], Any]:
    return lambda x: sum((-1) ** n * x ** (2 * n + 1) / factorial(2 * n + 1) for n in range(first, 10))


def _over(c: Fraction) -> Callable[[Any], Any]:
    return lambda a: 1 / (1 + a**2 / 8 - exactly(str(c)) * a**4)


PROVEN_PERIOD = "Both forms are held against the proven period at the amplitude 1/1000, to the sixth power of it."
EXACT_SERIES = "The residual of the equation of motion is expanded in powers of the amplitude, in exact rationals."

SERIES = (
    Erratum(
        REPORT, "(3.6)",
        "T = 2π √(l/g) (1 + y0²/16 + 11 y0²/3072)", "T = 2π √(l/g) (1 + y0²/16 + 11 y0⁴/3072), as in (2.7)",
        PROVEN_PERIOD, "None: the column of approximations in table 9 was computed with the fourth power.",
        (lambda a: 1 + a**2 / 16 + 11 * a**2 / 3072, lambda a: 1 + a**2 / 16 + 11 * a**4 / 3072), is_period,
    ),
    Erratum(
        REPORT, "(4.1)",
        "the sum runs from n = 1, over (2k + 1)!", "it runs from n = 0, over (2n + 1)!",
        "The sum is held against the sine at 1/10; (4.1)'s own expansion begins with φ, which is n = 0.",
        "None.", (_sum_from(1), _sum_from(0)), _is_sine,
    ),
    Erratum(
        REPORT, "(4.6)",
        "(εφ_A + ε³φ_B + …) − (εφ_A + ε³φ_B + …)/5! + …",
        "(εφ_A + ε³φ_B + …) − (εφ_A + ε³φ_B + …)³/3! + (εφ_A + ε³φ_B + …)⁵/5! − …",
        "Both are held against the sine at 1/10, to the seventh power of it.",
        "None: (4.11) has the terms that come from the full expansion.",
        (lambda x: x - x / 120, lambda x: x - x**3 / 6 + x**5 / 120), _is_sine,
    ),
    Erratum(
        REPORT, "(4.8)",
        "φ_B = (φ_init³/192) (cos 3ωt − cos ωt)", "φ_B = (φ_init³/192) (cos ωt − cos 3ωt)",
        EXACT_SERIES,
        "(4.12), β and (4.13) follow from it without another slip, and with (4.14) the approximations in table 12, "
        "whose largest error is 0.0351; all slips of section 4 put right, it is 0.0116.",
        (PHI_B_PRINTED, PHI_B), third_order_vanishes,
    ),
    Erratum(
        REPORT, "(4.11), (4.12), left side",
        "dφ_C/dt + ω² φ_C", "d²φ_C/dt² + ω² φ_C",
        "Both are held against the right side of (4.11) for the right φ_C, by differentiation with 50 digits.",
        "None: (4.13) solves the equation of second order.", (1, 2), _phi_c_obeys,
    ),
    Erratum(
        REPORT, "(4.12), cos ωt",
        "5/512 ω² φ_init⁵", "17/1536 ω² φ_init⁵",
        EXACT_SERIES, "β, (4.13), (4.14), (4.15), and the column of approximations in table 12.",
        ({1: Fraction(5, 512)}, {1: Fraction(17, 1536)}), is_forcing,
    ),
    Erratum(
        REPORT, "(4.12), cos 5ωt",
        "+1/7680 ω² φ_init⁵", "−3/2560 ω² φ_init⁵",
        EXACT_SERIES, "(4.13), (4.14), and the column of approximations in table 12.",
        ({5: Fraction(1, 7680)}, {5: Fraction(-3, 2560)}), is_forcing,
    ),
    Erratum(
        REPORT, "β, after (4.12), and (4.15)",
        "β = −5/512 ω² φ_init⁴", "β = −17/1536 ω² φ_init⁴",
        PROVEN_PERIOD, "(4.15), (4.16), and the column of approximations in table 12.",
        (_over(BETA_PRINTED), _over(BETA)), _is_frequency,
    ),
    Erratum(
        REPORT, "(4.13)",
        "61 cos ωt − 60 cos 3ωt − cos 5ωt", "51 cos ωt − 60 cos 3ωt + 9 cos 5ωt",
        EXACT_SERIES, "(4.14), and the column of approximations in table 12.",
        (PHI_C_PRINTED, PHI_C), _fifth_order_vanishes,
    ),
    Erratum(
        REPORT, "(4.14)",
        "the sum of (4.7), (4.8) and (4.13) as printed", "the sum of (4.7) and the corrected (4.8) and (4.13)",
        "Both are held against proven angles at the amplitude 1/10, to the seventh power of it.",
        "The column of approximations in table 12, and the curve in figure 11.",
        ((PHI_B_PRINTED, PHI_C_PRINTED), (PHI_B, PHI_C)), _is_motion,
    ),
    Erratum(
        REPORT, "after (4.15)",
        "ω² ≈ ω0²/(1 + (φ_init² + 5 φ_init⁴)/512)", "ω² ≈ ω0²/(1 + φ_init²/8 + 17 φ_init⁴/1536)",
        PROVEN_PERIOD, "None: table 12 was computed with 1 + φ_init²/8 + 5 φ_init⁴/512.",
        (lambda a: 1 / (1 + (a**2 + 5 * a**4) / 512), _over(BETA)), _is_frequency,
    ),
    Erratum(
        REPORT, "(4.16)",
        "5 φ_init⁴/1024", "11 φ_init⁴/3072, as in (2.7)",
        PROVEN_PERIOD, "None: table 9 was computed with (2.7); from (4.15) as printed, 3 φ_init⁴/1024 follows.",
        (lambda a: 1 + a**2 / 16 + 5 * a**4 / 1024, lambda a: 1 + a**2 / 16 + 11 * a**4 / 3072), is_period,
    ),
)  # fmt: skip
