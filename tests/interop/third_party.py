"""Methods of other packages, held to what the packages claim; ``make interop`` names this file.

Each claim passes but for those that are explained, and these do not: so a package that mends its method is noticed.
"""

from __future__ import annotations

from importlib.metadata import version

import pytest
from interop.made import of
from interop.methods import EXPLAINED, METHODS, Method

import compare

SECONDS = 900
"""For a check, on a machine that does other things as well."""


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("method", METHODS, ids=str)
def test_a_method_is_what_its_package_says(method: Method, record_property: pytest.RecordProperty) -> None:
    package = f"{method.package} {version(method.package)}"
    given = of(method.builder, method.name, method.claims)
    found = compare.check(**given, **method.claims, seconds=SECONDS)
    for verdict in found.verdicts:
        measured = "; ".join([verdict.measured, *verdict.causes])
        value = method.claims[verdict.claim]
        claim = verdict.claim if value is True else f"{verdict.claim} {value:g}"
        record_property("row", [package, method.name, claim, verdict.standing, measured])
    missed = {verdict.claim for verdict in found.verdicts if verdict.standing != "PASS"}
    explained = {claim for package, name, claim in EXPLAINED if (package, name) == (method.package, method.name)}
    assert missed == explained, found.verdict
