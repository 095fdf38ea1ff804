"""All errata, and with them the formulas that were held and found right."""

from __future__ import annotations

from compare.sources.errata.listings import LISTINGS
from compare.sources.errata.report_motion import MOTION
from compare.sources.errata.report_series import SERIES
from compare.sources.errata.report_tables import TABLES
from compare.sources.errata.sound import SOUND
from compare.sources.errata.thesis_curves import CURVES
from compare.sources.errata.thesis_field import FIELD

__all__ = ["ENTRIES", "ERRATA"]

ERRATA = (*MOTION, *TABLES, *SERIES, *CURVES, *LISTINGS, *FIELD)
ENTRIES = (*ERRATA, *SOUND)
