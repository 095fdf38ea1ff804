"""The families of the nonstiff DETEST, one for each problem."""

from __future__ import annotations

from reference.flow_families import flow_family
from reference.problems.detest.a import DetestA1, DetestA2, DetestA3, DetestA4, DetestA5
from reference.problems.detest.b import DetestB1, DetestB2, DetestB3, DetestB4, DetestB5
from reference.problems.detest.c import DetestC1, DetestC2, DetestC3, DetestC4, DetestC5
from reference.problems.detest.d import DetestD1, DetestD2, DetestD3, DetestD4, DetestD5
from reference.problems.detest.e import DetestE1, DetestE2, DetestE3, DetestE4, DetestE5

__all__ = ["DETEST", "FAMILIES"]

DETEST = (
    *(DetestA1, DetestA2, DetestA3, DetestA4, DetestA5),
    *(DetestB1, DetestB2, DetestB3, DetestB4, DetestB5),
    *(DetestC1, DetestC2, DetestC3, DetestC4, DetestC5),
    *(DetestD1, DetestD2, DetestD3, DetestD4, DetestD5),
    *(DetestE1, DetestE2, DetestE3, DetestE4, DetestE5),
)
"""The problems in the order of the set."""
FAMILIES = tuple(flow_family(kind, f"DETEST {kind.name[-2:].upper()}, {kind.words}") for kind in DETEST)
