"""Claims in one's own test-suite: assertions, the pytest plugin, JUnit's XML and SARIF."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import oddities
import pytest

import compare
from compare.__main__ import main
from compare.baseline import document_of
from compare.claims import exchange, show
from reference import Flow, Pendulum
from reference.problems.families import find_family

pytest_plugins = ["pytester"]

ODDITIES = Path(__file__).parent / "oddities.py"


def midpoint(f, y, h):
    return y + h * f(y + h / 2 * f(y))


def verlet(q, p, force, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def test_assertions_return_the_check_where_claims_hold():
    assert compare.assert_order(midpoint, 2).measured_order == pytest.approx(2, abs=0.05)
    assert compare.assert_symplectic(verlet).symplecticity.none
    assert compare.assert_reversible(verlet, problem=Pendulum(2.0)).problem == repr(Pendulum(2.0))
    (verdict,) = compare.check(verlet, symplectic=True).verdicts
    assert str(verdict).startswith("PASS  symplectic: defect ")


@pytest.mark.parametrize(
    ("claim", "says"),
    [
        (
            lambda: compare.assert_order(midpoint, 3),
            r"^midpoint on .*: FAIL  order 3: measured (1\.9|2\.0)\d ± 0\.\d\d; a condition of order 3 has 0\.25 in ",
        ),
        (lambda: compare.assert_symplectic(midpoint), r"^midpoint on .*: FAIL  symplectic: defect .* at h = 0\.1\.$"),
        (lambda: compare.assert_reversible(midpoint), r"^midpoint on .*: FAIL  reversible: defect .* at h = 0\.1\.$"),
        (
            lambda: compare.assert_order(oddities.verlet_of_a_gradient, 2),
            r"FAIL  order 2: .*; not consistent: the momenta go against the force",
        ),
    ],
)
def test_an_assertion_says_what_was_measured_and_why(claim, says):
    with pytest.raises(AssertionError, match=says):
        claim()


def test_what_is_not_established_is_no_pass():
    decay = Flow({"y": "-y"}, start={"y": 1}, name="decay")
    with pytest.raises(AssertionError, match=r"NOT ESTABLISHED  symplectic: not applicable: "):
        compare.assert_symplectic(midpoint, problem=decay)


def of_the_size_of_h_within(f, y, h):
    """Of order 2 forwards and 1 backwards, where it still goes along f."""
    return y + h * f(y + abs(h) / 2 * f(y))


def test_the_order_of_negative_steps_is_a_claim_of_its_own():
    found = compare.assert_order(midpoint, 2, backward=True)
    assert found.back.value == pytest.approx(2, abs=0.1)
    with pytest.raises(AssertionError, match=r"FAIL  order 2 for negative steps: measured (1\.0|0\.9)\d ± 0\.\d+"):
        compare.assert_order(of_the_size_of_h_within, 2, backward=True)
    with pytest.raises(
        ValueError, match=r"^an order for negative steps is claimed without an order; both are accepted"
    ):
        compare.check(midpoint, backward=True)


def test_conservation_is_that_of_every_invariant():
    kepler = find_family("kepler").problem()
    assert compare.assert_conserves(verlet).energy.behaviour == "bounded"
    with pytest.raises(AssertionError, match=r"FAIL  conservation of its invariants: energy (drifts|not kept)"):
        compare.assert_conserves(midpoint)
    with pytest.raises(AssertionError, match=r"FAIL  conservation of its invariants: energy bounded .*; angular mome"):
        compare.assert_conserves(verlet, problem=kepler)  # the ellipse turns
    found = compare.check(verlet, problem=kepler)
    assert [one.invariant for one in (found.energy, *found.others)] == [one.name for one in kepler.invariants]
    assert found.others[0].behaviour == "rounding"
    decay = Flow({"y": "-y"}, start={"y": 1}, name="decay")
    with pytest.raises(AssertionError, match=r"NOT ESTABLISHED  conservation of its invariants: energy not applicable"):
        compare.assert_conserves(midpoint, problem=decay)


def test_nothing_claimed_is_nothing_asserted():
    with pytest.raises(ValueError, match=r"^nothing is claimed of midpoint; an order, symplectic, "):
        compare.check(midpoint).assert_holds()


SUITE = """
import pytest
from reference import Pendulum


def midpoint(f, y, h):
    return y + h * f(y + h / 2 * f(y))


def test_right(horologium):
    assert horologium.check(midpoint, order=2).claims_hold


def test_wrong(horologium):
    horologium.check(midpoint, order=4)


@pytest.mark.horologium(problem=Pendulum(2.0))
class TestElsewhere:
    @pytest.mark.horologium(order=2)
    def test_it(self, horologium):
        assert horologium.check(midpoint).problem == repr(Pendulum(2.0))
"""


@pytest.mark.parametrize("processes", [(), ("-n", "2")])
def test_the_plugin_fails_a_test_and_tells_all_verdicts(pytester, processes):
    pytester.makepyfile(SUITE)
    found = pytester.runpytest_subprocess("-p", "no:cacheprovider", "--strict-markers", *processes)
    found.assert_outcomes(passed=2, failed=1)
    found.stdout.fnmatch_lines(
        [
            "*= horologium =*",
            "FAIL  midpoint: order 4, *test_wrong]",
            "PASS  midpoint: order 2, *]",
            "PASS  midpoint: order 2, *]",
        ]
    )


def parsed(text):
    return ET.fromstring(text)  # noqa: S314 - our own


def verdicts_of(form, capsys, *claims):
    code = main(["check", f"{ODDITIES}:verlet_of_a_gradient", *claims, "--format", form])
    return code, capsys.readouterr().out


@pytest.mark.usefixtures("without_a_process")
def test_junit_has_a_case_a_claim(capsys):
    code, out = verdicts_of("junit", capsys, "--order", "2", "--symplectic")
    suites = parsed(out)
    cases = suites.findall("./testsuite/testcase")
    assert code == 1
    assert suites.attrib == {"name": "horologium check", "tests": "2", "failures": "2", "skipped": "0"}
    assert [case.attrib["name"] for case in cases] == ["order 2", "symplectic"]
    assert {case.attrib["file"] for case in cases} == {ODDITIES.relative_to(Path.cwd()).as_posix()}
    line = ODDITIES.read_text(encoding="utf-8").splitlines()[int(cases[0].attrib["line"]) - 1]
    assert line.startswith("def verlet_of_a_gradient(")
    failure = cases[0].find("failure")
    assert failure.attrib["type"] == "FAIL"
    assert "the momenta go against the force" in failure.text


@pytest.mark.usefixtures("without_a_process")
def test_sarif_has_a_result_a_claim_at_the_line_of_the_step(capsys):
    code, out = verdicts_of("sarif", capsys, "--order", "2")
    (run,) = json.loads(out)["runs"]
    (result,) = run["results"]
    assert code == 1
    assert json.loads(out)["version"] == "2.1.0"
    assert [rule["id"] for rule in run["tool"]["driver"]["rules"]] == ["order"]
    assert (result["ruleId"], result["kind"], result["level"]) == ("order", "fail", "error")
    assert result["locations"][0]["physicalLocation"]["region"]["startLine"] > 1


def test_a_claim_that_holds_is_a_pass_in_both():
    found = compare.check(midpoint, order=2)
    document = document_of(show.page(found))
    assert parsed(exchange.junit(document)).find("./testsuite/testcase/failure") is None
    (result,) = json.loads(exchange.sarif(document))["runs"][0]["results"]
    assert (result["kind"], result["level"]) == ("pass", "none")
    assert "locations" not in result
    assert exchange.place_of(len) is None
