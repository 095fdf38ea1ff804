"""The report's numbers, and what its text says of them: section 3 and table 12."""

from __future__ import annotations

from compare.sources.errata.evidence import GRAVITY, REPORT, Erratum, along, exactly, precisely, proven, rounds_to
from compare.sources.errata.report_series import TO_THE_FOURTH
from compare.sources.errata.spelled import spelled
from compare.sources.published.source import tables
from reference.arithmetic.precision import mp
from reference.problems.pendulum.problem import Pendulum

__all__ = ["TABLES"]

SMALLEST, LATE = "0.001", "8.01"
"""Rows of table 9 and table 12, as printed."""


def _entries(table: str, column: str) -> dict[str, str]:
    """The printed entries of a column by row."""
    own = next(one for one in tables() if one.name == table)
    return dict(zip(own.rows, next(one.printed for one in own.columns if one.name == column), strict=True))


@precisely
def _is_the_column_of_approximations(text: str) -> bool:
    ratio = spelled(text, "y0")
    unit = 2 * mp.pi / mp.sqrt(exactly(str(GRAVITY)))
    return all(rounds_to(unit * ratio(exactly(y0)), text) for y0, text in _entries("table9", "approximation").items())


@precisely
def _are_magnitudes(exponents: dict[str, int]) -> bool:
    """Whether the largest error of each column, in J, is between these powers of ten and the next."""
    exact = -exactly(str(GRAVITY)) * mp.cos(1)
    return all(
        mp.floor(mp.log10(max(abs(exactly(entry) - exact) for entry in _entries("table8", column).values()))) == power
        for column, power in exponents.items()
    )


@precisely
def _is_the_smallest_period(text: str) -> bool:
    return rounds_to(proven(Pendulum(SMALLEST, g=GRAVITY, length=1), "period")[0], text)


@precisely
def _is_the_angle_at_801(text: str) -> bool:
    return rounds_to(along(Pendulum("1", g=GRAVITY, length=1), LATE)[0], text)


TABLES = (
    Erratum(
        REPORT, "section 3.2, on table 8",
        "energy is kept to about 1e-5 by NDSolve, 1e-6 by SymplecticRungeKutta and 1e-3 by Projection",
        "table 8 itself shows 4.6e-7, 1.3e-7 and 3.4e-5 at most",
        "Of each column the entry farthest from E = −9.81 cos 1 is held against it: at 8 s, 7 s and 8 s.",
        "None: the entries of table 8 stand; what happens between them it does not show.",
        ({"NDSolve": -5, "SymplecticRungeKutta": -6, "Projection": -3},
         {"NDSolve": -7, "SymplecticRungeKutta": -7, "Projection": -5}),
        ({"NDSolve": -7, "SymplecticRungeKutta": -7, "Projection": -4},
         {"NDSolve": -7, "SymplecticRungeKutta": -6, "Projection": -5}), _are_magnitudes,
    ),
    Erratum(
        REPORT, "section 3.3, on table 9",
        "the approximation of the period (3.7)", "the approximation of the period (3.6); (3.7) is the linear one",
        "Both are computed and held against the six entries of that column, to the last printed digit.",
        "None.",
        ("1", TO_THE_FOURTH), ("1 + y0²/16 + 12 y0⁴/3072", "1 + y0²/16"), _is_the_column_of_approximations,
    ),
    Erratum(
        REPORT, "table 9, y0 = 0.001, NDSolve",
        (period := _entries("table9", "NDSolve")[SMALLEST]),
        f"{(period_right := '2.00607')}; what is printed has the error of the adaptive method",
        "Both are held against the proven period.", "This entry alone.",
        (period, period_right), ("2.00606", "2.00608"), _is_the_smallest_period,
    ),
    Erratum(
        REPORT, "table 12, t = 8.01, numerical",
        (angle := _entries("table12", "SymplecticRungeKutta")[LATE]).replace("-", "−"),
        (angle_right := "-0.0353278").replace("-", "−"),
        "Both are held against the proven angle at 8.01 s.", "This entry alone.",
        (angle, angle_right), ("-0.0353277", "0.0353278"), _is_the_angle_at_801,
    ),
)  # fmt: skip
