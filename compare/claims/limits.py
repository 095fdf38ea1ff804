"""How long a check may take."""

from __future__ import annotations

__all__ = ["SECONDS"]

SECONDS = 60.0
"""Time after which a check is given up."""
