"""All errata, in the order of the sources."""

from __future__ import annotations

from compare.errata.report_motion import MOTION
from compare.errata.report_series import SERIES
from compare.errata.report_tables import TABLES
from compare.errata.thesis_curves import CURVES
from compare.errata.thesis_field import FIELD

__all__ = ["ERRATA"]

ERRATA = (*MOTION, *TABLES, *SERIES, *CURVES, *FIELD)
