"""The report's numbers, and what its text says of them: section 3 and table 12."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp

from compare.errata.erratum import REPORT, Erratum
from compare.errata.evidence import GRAVITY, along, exactly, precisely, proven, rounds_to
from reference.problems.pendulum import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["TABLES"]

APPROXIMATIONS = {"0.001": "2.00607", "0.901": "2.11258", "1.501": "2.32501"}
"""Table 9, the column of approximations: T in s by y0 in rad."""
FARTHEST = ("-5.300366084", "-5.300365495", "-5.300399387")
"""Table 8: the entries of each column that are farthest from the exact energy."""


@precisely
def _is_the_column_of_approximations(ratio: Callable[[Any], Any]) -> bool:
    unit = 2 * mp.pi / mp.sqrt(exactly(str(GRAVITY)))
    return all(rounds_to(unit * ratio(exactly(y0)), printed) for y0, printed in APPROXIMATIONS.items())


@precisely
def _are_magnitudes(exponents: tuple[int, int, int]) -> bool:
    """Whether the largest error of each column, in J, is between these powers of ten and the next."""
    exact = -exactly(str(GRAVITY)) * mp.cos(1)
    errors = (abs(exactly(entry) - exact) for entry in FARTHEST)
    return all(mp.floor(mp.log10(error)) == power for error, power in zip(errors, exponents, strict=True))


@precisely
def _is_the_smallest_period(text: str) -> bool:
    return rounds_to(proven(Pendulum("0.001", g=GRAVITY, length=1), "period")[0], text)


@precisely
def _is_the_angle_at_801(text: str) -> bool:
    return rounds_to(along(Pendulum("1", g=GRAVITY, length=1), "8.01")[0], text)


TABLES = (
    Erratum(
        REPORT, "section 3.2, on table 8",
        "energy is kept to about 1e-5 by NDSolve, 1e-6 by SymplecticRungeKutta and 1e-3 by Projection",
        "table 8 itself shows 4.6e-7, 1.3e-7 and 3.4e-5 at most",
        "The entries farthest from E = −9.81 cos 1, at 8 s, 7 s and 8 s, are held against the exact energy.",
        "None: the entries of table 8 stand; what happens between them it does not show.",
        ((-5, -6, -3), (-7, -7, -5)), _are_magnitudes,
    ),
    Erratum(
        REPORT, "section 3.3, on table 9",
        "the approximation of the period (3.7)", "the approximation of the period (3.6); (3.7) is the linear one",
        "Both are computed and held against entries of the column of approximations, to the last printed digit.",
        "None.",
        (lambda y0: 1 + 0 * y0, lambda y0: 1 + y0**2 / 16 + 11 * y0**4 / 3072), _is_the_column_of_approximations,
    ),
    Erratum(
        REPORT, "table 9, y0 = 0.001, NDSolve",
        "2.00605", "2.00607; what is printed has the error of the adaptive method",
        "Both are held against the proven period.", "This entry alone.",
        ("2.00605", "2.00607"), _is_the_smallest_period,
    ),
    Erratum(
        REPORT, "table 12, t = 8.01, numerical",
        "−0.0353279", "−0.0353278",
        "Both are held against the proven angle at 8.01 s.", "This entry alone.",
        ("-0.0353279", "-0.0353278"), _is_the_angle_at_801,
    ),
)  # fmt: skip
