"""The report's expansions: section 3.3 and section 4, in the amplitude a = phi_init and with omega = 1.

Exact series in an amplitude a whose coefficients are sums of cosines: sum of c a^n cos(k x), n up to ORDER.

They decide what an expansion in powers of the amplitude says, with no number rounded.
"""

from __future__ import annotations

from collections import defaultdict
from fractions import Fraction
from math import factorial
from typing import TYPE_CHECKING, Any, TypeAlias

from compare.sources.errata.evidence import GRAVITY, REPORT, Erratum, along, exactly, near, precisely, proven
from compare.sources.errata.spelled import spelled
from reference.arithmetic.precision import mp
from reference.problems.pendulum.problem import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = [
    "EXACT_SERIES",
    "ORDER",
    "PHI_B",
    "PROVEN_PERIOD",
    "RIGHT_SIDE",
    "SERIES",
    "TO_THE_FOURTH",
    "coefficient",
    "is_forcing",
    "is_period",
    "is_right_side",
    "plus",
    "sine",
    "third_order_vanishes",
    "times",
]

ORDER = 5
Cosines: TypeAlias = dict[tuple[int, int], Fraction]
"""c by (n, k)."""


def times(p: Cosines, q: Cosines) -> Cosines:
    """The product, from cos(i x) cos(j x) = (cos((i - j) x) + cos((i + j) x))/2, up to ORDER."""
    found: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for (n, i), c in p.items():
        for (m, j), d in q.items():
            if n + m <= ORDER:
                found[n + m, abs(i - j)] += c * d / 2
                found[n + m, i + j] += c * d / 2
    return _kept(found)


def plus(*series: Cosines) -> Cosines:
    """The sum."""
    found: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for one in series:
        for key, c in one.items():
            found[key] += c
    return _kept(found)


def sine(p: Cosines) -> Cosines:
    """The sine of a series that begins with a, from Taylor's series."""
    power, terms = p, [p]
    for n in range(3, ORDER + 1, 2):
        power = times(times(power, p), p)
        terms.append({key: (-1) ** (n // 2) * c / factorial(n) for key, c in power.items()})
    return plus(*terms)


def coefficient(p: Cosines, n: int) -> dict[int, Fraction]:
    """What a^n is multiplied by: c by k."""
    return {k: c for (m, k), c in p.items() if m == n}


def _kept(found: dict[tuple[int, int], Fraction]) -> Cosines:
    return {key: c for key, c in found.items() if c != 0}


SMALL = Fraction(1, 1000)
PHI_A: Cosines = {(1, 1): Fraction(1)}


def _cosines(text: str, power: int) -> Cosines:
    """The amplitudes of cos ωt, cos 3ωt and cos 5ωt, each written cos(kωt), as the series of one power of a."""
    form = spelled(text, "cos ωt", "cos 3ωt", "cos 5ωt", "φ_init")
    one_each = {1: (1, 0, 0, 1), 3: (0, 1, 0, 1), 5: (0, 0, 1, 1)}
    return {(power, k): c for k, unit in one_each.items() if (c := Fraction(form(*map(Fraction, unit))))}


SPELLED_B, SPELLED_B_PRINTED = "(φ_init³/192) (cos ωt − cos 3ωt)", "(φ_init³/192) (cos 3ωt − cos ωt)"
SPELLED_C = "(φ_init⁵/184320) (51 cos ωt − 60 cos 3ωt + 9 cos 5ωt)"
SPELLED_C_PRINTED = "(φ_init⁵/184320) (61 cos ωt − 60 cos 3ωt − cos 5ωt)"
SPELLED_C_SLIP = "(φ_init⁵/184320) (52 cos ωt − 61 cos 3ωt + 9 cos 5ωt)"
PHI_B, PHI_B_PRINTED = _cosines(SPELLED_B, 3), _cosines(SPELLED_B_PRINTED, 3)
PHI_C, PHI_C_PRINTED = _cosines(SPELLED_C, 5), _cosines(SPELLED_C_PRINTED, 5)
ALPHA, BETA, BETA_PRINTED = Fraction(-1, 8), Fraction(-17, 1536), Fraction(-5, 512)
STIFFNESS: Cosines = {(0, 0): Fraction(1), (2, 0): -ALPHA, (4, 0): -BETA}
"""omega0^2/omega^2."""
RIGHT_SIDE = "βφ_A − αφ_A³/3! − ω²φ_A⁵/5! + αφ_B + ½ω²φ_A²φ_B"
"""Of (4.11)."""
TO_THE_FOURTH = "1 + y0²/16 + 11 y0⁴/3072"


def _residual(phi: Cosines, power: int, stiffness: Cosines = STIFFNESS) -> dict[int, Fraction]:
    """What a^power is multiplied by in phi'' + stiffness sin phi."""
    curved = {(n, k): -k * k * c for (n, k), c in phi.items()}
    return coefficient(plus(curved, times(stiffness, sine(phi))), power)


def third_order_vanishes(phi_b: Cosines, alpha: Fraction = ALPHA) -> bool:
    """Whether phi_A + phi_B starts at the amplitude and obeys the equation of motion up to its third power."""
    return sum(phi_b.values()) == 0 and not _residual(plus(PHI_A, phi_b), 3, {(0, 0): Fraction(1), (2, 0): -alpha})


def _is_phi_b(text: str) -> bool:
    return third_order_vanishes(_cosines(text, 3))


def _is_phi_c(text: str) -> bool:
    """Whether it is zero at the start, and phi_A + phi_B + phi_C obeys the equation up to the fifth power."""
    phi_c = _cosines(text, 5)
    return sum(phi_c.values()) == 0 and not _residual(plus(PHI_A, PHI_B, phi_c), 5)


def is_forcing(form: tuple[int, str]) -> bool:
    """Whether phi_C'' + phi_C is forced by this much, less beta, at this harmonic."""
    harmonic, text = form
    without_beta: Cosines = {(0, 0): Fraction(1), (2, 0): -ALPHA}
    found = _residual(plus(PHI_A, PHI_B), 5, without_beta)
    return bool(found.get(harmonic, Fraction(0)) == -spelled(text, "ω", "φ_init")(Fraction(1), Fraction(1)))


def _value(series: Cosines, x: Any) -> Any:
    return sum(exactly(str(c)) * mp.cos(k * x) for (_, k), c in series.items())


def _forced(text: str, x: Any) -> Any:
    """The right side of (4.11)."""
    form = spelled(text, "α", "β", "φ_A", "φ_B", "ω")
    return form(exactly(str(ALPHA)), exactly(str(BETA)), _value(PHI_A, x), _value(PHI_B, x), mp.mpf(1))


@precisely
def is_right_side(text: str) -> bool:
    """Whether it is phi_C'' + phi_C of the right phi_C."""
    x = mp.mpf(1)
    return near(mp.diff(lambda x: _value(PHI_C, x), x, 2) + _value(PHI_C, x), _forced(text, x))


@precisely
def _phi_c_obeys(order: int) -> bool:
    """Whether the derivative of this order, plus phi_C, is the right side of (4.11)."""
    x = mp.mpf(1)
    return near(mp.diff(lambda x: _value(PHI_C, x), x, order) + _value(PHI_C, x), _forced(RIGHT_SIDE, x))


def _swing() -> Any:
    """T/T0 at the amplitude SMALL, proven."""
    return proven(Pendulum(SMALL, g=1, length=1), "period")[0] / (2 * mp.pi)


@precisely
def is_period(text: str) -> bool:
    """Whether T/T0 is right to the fourth power of a small amplitude."""
    amplitude = next(name for name in ("φ0", "φ_init", "y0") if name in text)
    ratio = spelled(text, amplitude)
    return bool(abs(ratio(exactly(str(SMALL))) - _swing()) < exactly(str(SMALL)) ** 6)


@precisely
def _is_frequency(text: str) -> bool:
    """Whether omega^2/omega0^2 is right to the fourth power of a small amplitude."""
    ratio = spelled(text, "φ_init")
    return bool(abs(ratio(exactly(str(SMALL))) - 1 / _swing() ** 2) < exactly(str(SMALL)) ** 6)


@precisely
def _is_motion(series: tuple[str, str]) -> bool:
    """Whether phi_A + phi_B + phi_C is the proven motion to the seventh power of the amplitude SMALL."""
    problem = Pendulum(SMALL, g=1, length=1)
    omega = 2 * mp.pi / proven(problem, "period")[0]
    terms = plus(PHI_A, *(_cosines(text, power) for text, power in zip(series, (3, 5), strict=True)))

    def phi(t: str) -> Any:
        return sum(exactly(str(c * SMALL**n)) * mp.cos(k * omega * exactly(t)) for (n, k), c in terms.items())

    return all(abs(phi(t) - along(problem, t)[0]) < exactly(str(SMALL**7)) for t in ("1/2", "1", "5/2"))


@precisely
def _is_sine(form: Callable[[Any], Any]) -> bool:
    """Whether it is sin x to the sixth power of x = 1/100."""
    x = exactly("1/100")
    return bool(abs(form(x) - mp.sin(x)) < x**7)


@precisely
def _makes_it_odd(mirrored: Callable[[Fraction, Fraction], tuple[Fraction, Fraction]]) -> bool:
    """Whether the proven angle has the other sign where this is made of the amplitude and the time."""
    amplitude, t = Fraction(1), Fraction("0.3")

    def angle(theta0: Fraction, t: Fraction) -> Any:
        return proven(Pendulum(theta0, g=GRAVITY, length=1, omega0=0), "state", t)[0]

    return near(angle(*mirrored(amplitude, t)), -angle(amplitude, t))


def _sum_from(first: int, sign: int = -1) -> Callable[[Any], Any]:
    return lambda x: sum(sign**n * x ** (2 * n + 1) / factorial(2 * n + 1) for n in range(first, 10))


PROVEN_PERIOD = "Both forms are held against the proven period at the amplitude 1/1000, to the sixth power of it."
EXACT_SERIES = "The residual of the equation of motion is expanded in powers of the amplitude, in exact rationals."
OF_OMEGA = "1/(1 + φ_init²/8 + 17 φ_init⁴/1536)"

SERIES = (
    Erratum(
        REPORT, "(3.6)",
        f"T = 2π √(l/g) ({(squared := '1 + y0²/16 + 11 y0²/3072')})",
        f"T = 2π √(l/g) ({TO_THE_FOURTH}), as in (2.7)",
        PROVEN_PERIOD, "None: the column of approximations in table 9 was computed with the fourth power.",
        (squared, TO_THE_FOURTH), ("1 + y0²/16 + 12 y0⁴/3072", "1 + y0²/16"), is_period,
    ),
    Erratum(
        REPORT, "(4.1)",
        "the sum runs from n = 1, over (2k + 1)!", "it runs from n = 0, over (2n + 1)!",
        "The sum is held against the sine at 1/100; (4.1)'s own expansion begins with φ, which is n = 0.",
        "None.", (_sum_from(1), _sum_from(0)), (_sum_from(0, sign=1),), _is_sine,
    ),
    Erratum(
        REPORT, "after (4.2)",
        "even powers of ε are left out because an odd function is looked for",
        "the angle is odd in the amplitude, which ε counts; in t, from the release, it is even",
        "The proven angle at 0.3 s is held against that at −0.3 s, and against that from −1 rad.",
        "None: (4.3) is right.",
        (lambda a, t: (a, -t), lambda a, t: (-a, t)), (lambda a, t: (-a / 2, t),), _makes_it_odd,
    ),
    Erratum(
        REPORT, "(4.6)",
        "(εφ_A + ε³φ_B + …) − (εφ_A + ε³φ_B + …)/5! + …",
        "(εφ_A + ε³φ_B + …) − (εφ_A + ε³φ_B + …)³/3! + (εφ_A + ε³φ_B + …)⁵/5! − …",
        "Both are held against the sine at 1/100, to the seventh power of it.",
        "None: (4.11) has the terms that come from the full expansion.",
        (spelled("x − x/5!", "x"), spelled("x − x³/3! + x⁵/5!", "x")),
        (spelled("x − x³/3!", "x"), spelled("x − x³/3! − x⁵/5!", "x")), _is_sine,
    ),
    Erratum(
        REPORT, "(4.8)",
        f"φ_B = {SPELLED_B_PRINTED}", f"φ_B = {SPELLED_B}",
        EXACT_SERIES,
        "(4.12), β and (4.13) follow from it without another slip, and with (4.14) the approximations in table 12, "
        "whose largest error is 0.0351; all slips of section 4 put right, it is 0.0116.",
        (SPELLED_B_PRINTED, SPELLED_B),
        ("(φ_init³/192) (2 cos ωt − cos 3ωt)", "(φ_init³/193) (cos ωt − cos 3ωt)"), _is_phi_b,
    ),
    Erratum(
        REPORT, "(4.11), (4.12), left side",
        "dφ_C/dt + ω² φ_C", "d²φ_C/dt² + ω² φ_C",
        "Both are held against the right side of (4.11) for the right φ_C, by differentiation with 50 digits.",
        "None: (4.13) solves the equation of second order.", (1, 2), (0, 4), _phi_c_obeys,
    ),
    Erratum(
        REPORT, "(4.12), cos ωt",
        (first := "5/512 ω² φ_init⁵"), (first_right := "17/1536 ω² φ_init⁵"),
        EXACT_SERIES, "β, (4.13), (4.14), (4.15), and the column of approximations in table 12.",
        ((1, first), (1, first_right)), ((1, "18/1536 ω² φ_init⁵"), (1, "−17/1536 ω² φ_init⁵")), is_forcing,
    ),
    Erratum(
        REPORT, "(4.12), cos 5ωt",
        (fifth := "1/7680 ω² φ_init⁵"), (fifth_right := "−3/2560 ω² φ_init⁵"),
        EXACT_SERIES, "(4.13), (4.14), and the column of approximations in table 12.",
        ((5, fifth), (5, fifth_right)), ((5, "3/2560 ω² φ_init⁵"), (5, "−3/2561 ω² φ_init⁵")), is_forcing,
    ),
    Erratum(
        REPORT, "β, after (4.12), and (4.15)",
        f"β = −{-BETA_PRINTED} ω² φ_init⁴", f"β = −{-BETA} ω² φ_init⁴",
        PROVEN_PERIOD, "(4.15), (4.16), and the column of approximations in table 12.",
        ("1/(1 + φ_init²/8 + 5 φ_init⁴/512)", OF_OMEGA),
        ("1/(1 + φ_init²/8 + 18 φ_init⁴/1536)", "1/(1 + φ_init²/8 − 17 φ_init⁴/1536)"), _is_frequency,
    ),
    Erratum(
        REPORT, "(4.13)",
        f"φ_C = {SPELLED_C_PRINTED}", f"φ_C = {SPELLED_C}",
        EXACT_SERIES, "(4.14), and the column of approximations in table 12.",
        (SPELLED_C_PRINTED, SPELLED_C), (SPELLED_C.replace("51", "52"), SPELLED_C_SLIP), _is_phi_c,
    ),
    Erratum(
        REPORT, "(4.14)",
        "the sum of (4.7), (4.8) and (4.13) as printed", "the sum of (4.7) and the corrected (4.8) and (4.13)",
        "Both are held against proven angles at the amplitude 1/1000, to the seventh power of it.",
        "The column of approximations in table 12, and the curve in figure 11.",
        ((SPELLED_B_PRINTED, SPELLED_C_PRINTED), (SPELLED_B, SPELLED_C)),
        ((SPELLED_B, SPELLED_C_PRINTED), (SPELLED_B, SPELLED_C_SLIP)), _is_motion,
    ),
    Erratum(
        REPORT, "after (4.15)",
        f"ω² ≈ ω0²{(one_quotient := '1/(1 + (φ_init² + 5 φ_init⁴)/512)')[1:]}", f"ω² ≈ ω0²{OF_OMEGA[1:]}",
        PROVEN_PERIOD, "None: table 12 was computed with 1 + φ_init²/8 + 5 φ_init⁴/512.",
        (one_quotient, OF_OMEGA), (OF_OMEGA.replace("17", "16"), OF_OMEGA.replace("/8", "/7")), _is_frequency,
    ),
    Erratum(
        REPORT, "(4.16)",
        f"T ≈ 2π √(l/g) ({(fourth := '1 + φ_init²/16 + 5 φ_init⁴/1024')} + …)",
        f"T ≈ 2π √(l/g) ({(fourth_right := '1 + φ_init²/16 + 11 φ_init⁴/3072')} + …), as in (2.7)",
        PROVEN_PERIOD, "None: table 9 was computed with (2.7); from (4.15) as printed, 3 φ_init⁴/1024 follows.",
        (fourth, fourth_right), ("1 + φ_init²/16 + 3 φ_init⁴/1024", "1 + φ_init²/16 + 12 φ_init⁴/3072"), is_period,
    ),
)  # fmt: skip
