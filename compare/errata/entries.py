"""All errata, and with them the formulas that were held and found right."""

from __future__ import annotations

from compare.errata.listings import LISTINGS
from compare.errata.report_motion import MOTION
from compare.errata.report_series import SERIES
from compare.errata.report_tables import TABLES
from compare.errata.sound import SOUND
from compare.errata.thesis_curves import CURVES
from compare.errata.thesis_field import FIELD

__all__ = ["ENTRIES", "ERRATA"]

ERRATA = (*MOTION, *TABLES, *SERIES, *CURVES, *LISTINGS, *FIELD)
ENTRIES = (*ERRATA, *SOUND)
