"""All errata, and with them the formulas that were held and found right.

What was noticed in the text of the sources and has no number in it that a check could decide.
"""

from __future__ import annotations

from dataclasses import dataclass

from compare.sources.errata.evidence import THESIS
from compare.sources.errata.listings import LISTINGS
from compare.sources.errata.report_motion import MOTION
from compare.sources.errata.report_series import SERIES
from compare.sources.errata.report_tables import TABLES
from compare.sources.errata.sound import SOUND
from compare.sources.errata.thesis_curves import CURVES
from compare.sources.errata.thesis_field import FIELD

__all__ = ["ENTRIES", "ERRATA", "NOTICED"]


@dataclass(frozen=True)
class Remark:
    """A slip of the text.

    Attributes:
        source, place: as of an erratum.
        printed: what stands there.
        right: what is meant.
    """

    source: str
    place: str
    printed: str
    right: str


NOTICED = (
    Remark(
        THESIS, "before (1.7)", "(1.2) and (1.5) are put into (1.7)", "into (1.6); (1.7) is what comes of it",
    ),
    Remark(
        THESIS, "before (1.36)", "(1.33) and (1.35) are put into (1.36)", "into (1.6); (1.36) is what comes of it",
    ),
    Remark(THESIS, "before (1.41)", "a new variable and constant z", "a new variable z and a constant z0"),
    Remark(
        THESIS, "after (1.42)", "different z from 0 to 1 give different paths",
        "different z0; z runs along each path, from 1 down to z0",
    ),
    Remark(THESIS, "contents and chapter 4", "sections 4.1, 4.3 and 4.5", "there is no 4.2 and no 4.4"),
    Remark(THESIS, "reference [6]", "Richard Hilbert, D. Courant", "R. Courant, D. Hilbert"),
    Remark(
        THESIS, "references [5] and [6]", "the address of D. S. Stutts' Lagrange.pdf stands under [6]",
        "it belongs to [5], which is that text",
    ),
)  # fmt: skip


ERRATA = (*MOTION, *TABLES, *SERIES, *CURVES, *LISTINGS, *FIELD)
ENTRIES = (*ERRATA, *SOUND)
