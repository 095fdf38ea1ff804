"""Verdicts in the formats that other programs collect: JUnit's XML, and SARIF 2.1.0 (OASIS, 2020)."""

from __future__ import annotations

import inspect
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from reference.version import __version__

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.verdicts import Judged, Verdict

__all__ = ["WRITERS", "junit", "place_of", "sarif"]

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
KINDS = {"PASS": "pass", "FAIL": "fail", "NOT ESTABLISHED": "open"}
"""SARIF's words (section 3.27.9)."""
RULES = {
    "order": "The global error falls with the power of the step that is claimed.",
    "symplectic": "A step keeps the symplectic form.",
    "backward": "The global error falls with that power of the step into the past too.",
    "conserves": "Every invariant that the problem declares is kept, bounded or to rounding.",
    "dense": "A state between two steps errs by the power of the step that is claimed, and one more.",
    "estimate": "An error estimate is the local error of a method of the order that is claimed.",
    "tolerance": "The global error goes with the power of the tolerance that is claimed.",
    "stiff": "The global error on a stiff equation falls with the power of the step that is claimed.",
    "events": "Every event is found, once, and to the accuracy that is claimed.",
    "gradients": "Derivatives by start, parameters and initial time have the accuracy that is claimed.",
    "reversible": "A step leads back to where it came from with the velocities turned round.",
}

Place = tuple[str, int]
"""A file, and a line of it, from 1."""


def place_of(function: Callable[..., Any]) -> Place | None:
    """Where a function is written, relative to the current folder if it is below it; None where nobody knows."""
    function = inspect.unwrap(function)
    try:
        file, line = inspect.getsourcefile(function), inspect.getsourcelines(function)[1]
    except (TypeError, OSError):
        return None
    if file is None:
        return None
    path, here = Path(file).resolve(), Path.cwd()
    return (path.relative_to(here) if path.is_relative_to(here) else path).as_posix(), max(1, line)


def junit(found: Judged, place: Place | None = None) -> str:
    """A test suite with a test case a claim; what is not established is a failure of the type of that name."""
    cases = found.verdicts
    missed = sum(one.standing != "PASS" for one in cases)
    suites = ET.Element("testsuites", name="horologium check", tests=str(len(cases)), failures=str(missed))
    suite = ET.SubElement(suites, "testsuite", name=found.name, tests=str(len(cases)), failures=str(missed))
    for one in cases:
        where: dict[str, str] = {} if place is None else {"file": place[0], "line": str(place[1])}
        case = ET.SubElement(suite, "testcase", where, name=one.words, classname=found.name)
        if one.standing == "PASS":
            ET.SubElement(case, "system-out").text = f"{one}."
        else:
            ET.SubElement(case, "failure", type=one.standing, message=one.measured).text = _told(found, one)
    ET.indent(suites)
    return ET.tostring(suites, encoding="unicode", xml_declaration=True) + "\n"


def sarif(found: Judged, place: Place | None = None) -> str:
    """A run with a result a claim: of the kind "pass", "fail" or "open"."""
    rules = [{"id": one.claim, "shortDescription": {"text": RULES[one.claim]}} for one in found.verdicts]
    driver: dict[str, Any] = {"name": "Horologium", "semanticVersion": __version__, "rules": rules}
    results = [_result(found, one, place) for one in found.verdicts]
    log: dict[str, Any] = {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{"tool": {"driver": driver}, "results": results}],
    }
    return json.dumps(log, indent=1, ensure_ascii=False) + "\n"


def _result(found: Judged, one: Verdict, place: Place | None) -> dict[str, object]:
    failed = one.standing == "FAIL"
    result: dict[str, object] = {
        "ruleId": one.claim,
        "kind": KINDS[one.standing],
        "level": "error" if failed else "none",
        "message": {"text": _told(found, one)},
    }
    if place is not None:
        file, line = place
        where = {"artifactLocation": {"uri": file}, "region": {"startLine": line}}
        result["locations"] = [{"physicalLocation": where}]
    return result


def _told(found: Judged, one: Verdict) -> str:
    return f"{found.name} on {found.problem}: {one}."


WRITERS: dict[str, Callable[[Judged, Place | None], str]] = {"junit": junit, "sarif": sarif}
