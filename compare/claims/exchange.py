"""Verdicts in the formats that other programs collect: JUnit's XML, and SARIF 2.1.0 (OASIS, 2020)."""

from __future__ import annotations

import inspect
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from compare.claims.verdicts import Verdict
from reference.version import __version__

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from compare.baseline import Comparison

__all__ = ["WRITERS", "junit", "place_of", "sarif"]

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
KINDS = {"PASS": "pass", "FAIL": "fail", "NOT ESTABLISHED": "open"}
"""SARIF's words (section 3.27.9)."""
KEPT = ("unchanged", "better")
"""States of what does not count against a baseline."""
RULES = {
    "baseline": "Nothing is worse than in the baseline.",
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


def junit(document: Any, place: Place | None = None, changes: Comparison | None = None) -> str:
    """A test suite with a test case a claim; what is not established is a failure of the type of that name.

    Against a baseline what that has already is skipped, as it does not count, and a case more tells what is worse.

    Args:
        document: the JSON form of a check.
        place: where the step is written.
        changes: the check held against a baseline, if there is one.
    """
    cases, name = document["verdicts"], document["name"]
    states = _states(document, changes)
    missed = [one["words"] for one in cases if one["standing"] != "PASS"]
    skipped = [words for words in missed if states[words] in KEPT]
    suites = ET.Element("testsuites", name="horologium check")
    suite = ET.SubElement(suites, "testsuite", name=name)
    for one in cases:
        where: dict[str, str] = {} if place is None else {"file": place[0], "line": str(place[1])}
        case = ET.SubElement(suite, "testcase", where, name=one["words"], classname=name)
        if one["words"] in skipped:
            ET.SubElement(case, "skipped", message=f"{one['standing']} as in the baseline").text = _told(document, one)
        elif one["words"] in missed:
            ET.SubElement(case, "failure", type=one["standing"], message=one["measured"]).text = _told(document, one)
        else:
            ET.SubElement(case, "system-out").text = f"{_verdict(one)}."
    if changes is not None:
        case = ET.SubElement(suite, "testcase", name="no worse than the baseline", classname=name)
        if not changes.holds:
            ET.SubElement(case, "failure", type="worse", message=changes.title).text = "\n".join(
                map(str, changes.worse)
            )
    for each in (suites, suite):
        for key, tag in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
            each.set(key, str(len(list(suite.iter(tag)))))
    ET.indent(suites)
    return ET.tostring(suites, encoding="unicode", xml_declaration=True) + "\n"


def sarif(document: Any, place: Place | None = None, changes: Comparison | None = None) -> str:
    """A run with a result a claim: of the kind "pass", "fail" or "open".

    Against a baseline each has its state, and what is worse beside the claims is a result of its own.

    Args:
        document: the JSON form of a check.
        place: where the step is written.
        changes: the check held against a baseline, if there is one.
    """
    verdicts, states = document["verdicts"], _states(document, changes)
    results = [_result(document, one, place, states) for one in verdicts]
    for one in () if changes is None else changes.worse:
        if one.of not in states:
            text = f"{document['name']} on {document['problem']}: {one}."
            results.append({"ruleId": "baseline", "kind": "fail", "level": "error", "message": {"text": text}})
    used = dict.fromkeys(result["ruleId"] for result in results)
    rules = [{"id": one, "shortDescription": {"text": RULES[one]}} for one in used]
    driver: dict[str, Any] = {"name": "Horologium", "semanticVersion": __version__, "rules": rules}
    log: dict[str, Any] = {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{"tool": {"driver": driver}, "results": results}],
    }
    return json.dumps(log, indent=1, ensure_ascii=False) + "\n"


def _states(document: Any, found: Comparison | None) -> dict[str, str]:
    """How each claim stands against a baseline, by its words: "unchanged", "better", "worse" or "new"; "" without."""
    if found is None:
        return {one["words"]: "" for one in document["verdicts"]}
    states = {one["words"]: "new" if one["words"] in found.new else "unchanged" for one in document["verdicts"]}
    return states | {one.of: word for word, one in found.told if one.of in states}


def _result(document: Any, one: Any, place: Place | None, states: Mapping[str, str]) -> dict[str, Any]:
    state = states[one["words"]]
    kept = state in KEPT
    result: dict[str, Any] = {
        "ruleId": one["claim"],
        "kind": KINDS[one["standing"]],
        "level": "error" if one["standing"] == "FAIL" and not kept else "none",
        "message": {"text": _told(document, one)},
    }
    if state:
        result["baselineState"] = state if state in {"new", "unchanged"} else "updated"
    if place is not None:
        file, line = place
        where = {"artifactLocation": {"uri": file}, "region": {"startLine": line}}
        result["locations"] = [{"physicalLocation": where}]
    return result


def _verdict(one: Any) -> str:
    return str(Verdict(**{**one, "causes": tuple(one["causes"])}))


def _told(document: Any, one: Any) -> str:
    return f"{document['name']} on {document['problem']}: {_verdict(one)}."


WRITERS: dict[str, Callable[[Any, Place | None, Comparison | None], str]] = {"junit": junit, "sarif": sarif}
