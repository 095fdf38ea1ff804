"""Verdicts as gates: limits of a score, and answers held against earlier ones."""

from __future__ import annotations

import csv
import io
import json
import re
import shlex
from copy import deepcopy
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from uncontained import answered

import compare
from compare.__main__ import main
from compare.baseline import Entry, Gate, Large, Rounding, Small, Standing, opened
from compare.claims import exchange
from compare.claims import regression as of_check
from compare.files import regression as of_score
from compare.files.limits import Limits
from compare.report import regression as of_report
from compare.solvers import regression as of_solvers
from compare.solvers.solver import Counted
from reference import Pendulum

ROOT = Path(__file__).parents[2]
TABLE = ROOT / "tests" / "compare" / "snippets" / "python.csv"
"""Störmer-Verlet with h = 1/64 up to t = 1: 3.5 correct digits on scale, and errors of 9.5e-4."""
SCORE = ("score", str(TABLE), "--theta0", "1", "--rows", "3")
SOLVERS = ("solvers", "--solvers", "RK45", "--rtol", "1e-3,1e-6", "--t-end", "2", "--quiet")
SEVERAL = (*SOLVERS, "--problem", "pendulum", "--problem", "linear")
REPORT = ("report", "--problems", "pendulum", "--amplitudes", "1", "--methods", "rk4", "--solvers", "RK23", "--quiet")
REPORT = (*REPORT, "--n", "64", "--rtol", "1e-3", "--t-end", "2", "--jobs", "1")
STEPS = """
def verlet(q, p, force, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)
"""
EARLIER = "earlier.json"
MISSED = "The limits do not hold"


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("mine.py").write_text(STEPS, encoding="utf-8")
    return tmp_path


@cache
def check():
    def verlet(q, p, force, h):
        p = p + h / 2 * force(q)
        q = q + h * p
        return q, p + h / 2 * force(q)

    return compare.check(verlet, order=2, symplectic=True)


def measure_once(patch):
    """Let a contained check be one for all of them, in this process."""
    patch.setattr("compare.claims.contained.contained", answered)
    patch.setattr("compare.claims.tried.check", lambda _step, **_options: check())


@pytest.fixture
def measured_once(monkeypatch):
    measure_once(monkeypatch)


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """What each command prints, run once: its words and its JSON."""
    folder = tmp_path_factory.mktemp("kept")
    (folder / "mine.py").write_text(STEPS, encoding="utf-8")
    step = f"{folder / 'mine.py'}:verlet"
    commands = {
        "score": SCORE,
        "check": ("check", step, "--order", "2", "--symplectic"),
        "solvers": SOLVERS,
        "several": SEVERAL,
        "report": (*REPORT, "--out", str(folder / "report")),
    }
    found = {}
    for name, words in commands.items():
        with pytest.MonkeyPatch.context() as patch:
            printed = io.StringIO()
            measure_once(patch)
            patch.setattr("sys.stdout", printed)
            assert main([*words, "--format", "json"]) == 0
        found[name] = (words, printed.getvalue())
    assert json.loads((folder / "report" / "work-precision.json").read_bytes()) == json.loads(found["report"][1])
    return found


GATES = {
    "score": of_score.GATE,
    "check": of_check.GATE,
    "solvers": of_solvers.GATE,
    "several": of_solvers.SEVERAL,
    "report": of_report.GATE,
}


def changed(text, change):
    """The JSON with a change made in its document."""
    document = json.loads(text)
    change(document)
    return document


def compared(name, was, now, factor=None):
    """Two documents of a command."""
    Path(EARLIER).write_text(json.dumps(was), encoding="utf-8")
    return opened(EARLIER, GATES[name], factor).against(now)


def told(changes):
    return [(one.of, one.quantity, one.was, one.now) for one in changes]


@pytest.mark.parametrize(
    ("measure", "was", "fine", "worse"),
    [
        (Small(2.0), 1e-3, (1e-9, 1e-3, 2e-3), (2.001e-3, 1.0)),
        (Small(2.0, 1e-12), 1e-16, (0.0, 1e-13, 2e-12), (2.1e-12,)),
        (Large(0.5), 8.0, (7.5, 8.0, 16.0), (7.49, 0.0)),
        (Large(0.5, 13.0), 15.9, (12.5, 15.9), (12.4,)),
        (Rounding(1e-11, 10.0), 1e-16, (0.0, 1e-11, 9e-11), (1.1e-10, 1.0)),
        (Rounding(1e-11, 10.0), 1e-3, (1e-16, 1.0), ()),
        (Standing(("FAIL", "NOT ESTABLISHED", "PASS")), "NOT ESTABLISHED", ("PASS", "NOT ESTABLISHED"), ("FAIL",)),
    ],
)
def test_each_measure_has_its_way_of_being_worse(measure, was, fine, worse):
    assert not any(measure.worse(was, now) for now in fine)
    assert all(measure.worse(was, now) for now in worse)
    assert all(measure.accepts(value) for value in (was, *fine, *worse))
    assert not any(measure.accepts(value) for value in ("x", True, None, [1], float("inf"), float("nan")))


def test_what_is_gone_is_worse_and_what_is_new_or_lacks_a_number_is_not_compared():
    def entries(document, _factor):
        return [Entry(of, "size", value, Small(2.0)) for of, value in document.items()]

    Path(EARLIER).write_text('{"gone": 1, "null": null, "lost": 1, "kept": 1}', encoding="utf-8")
    found = opened(EARLIER, Gate("toy", lambda _: {}, entries)).against({"null": 1, "lost": None, "kept": 1, "new": 1})
    assert told(found.worse) == [("gone", "present", "yes", "no")]
    assert (found.better, found.same, found.new, found.holds) == ((), 1, ("new",), False)


@pytest.mark.parametrize("name", GATES)
def test_an_answer_is_no_worse_than_itself(name, kept, capsys):
    words, text = kept[name]
    found = compared(name, json.loads(text), json.loads(text))
    assert (found.worse, found.better, found.new) == ((), (), ())
    assert found.same >= 4
    assert main([*words, "--baseline", EARLIER]) == 0
    assert f"Against the baseline {EARLIER}: 0 worse, 0 better, {found.same} as before\n" in capsys.readouterr().out
    assert Path(EARLIER).read_text(encoding="utf-8") == json.dumps(json.loads(text))


def of_score_but(**fields):
    return lambda document: document.update(fields)


@pytest.mark.parametrize(
    ("change", "worse"),
    [
        (of_score_but(worst_scaled_digits=4.1), ("the rows", "digits on scale")),
        (of_score_but(max_errors={"theta": 5e-5, "omega": 9.5e-4}), ("theta", "largest error")),
        (of_score_but(points=[{"t": "2D0"}]), ("the rows", "last time")),
        (of_score_but(points=[{"t": "3/2"}]), ("the rows", "last time")),
    ],
)
def test_a_score_is_worse_by_its_digits_its_errors_or_an_early_end(kept, change, worse):
    now = json.loads(kept["score"][1])
    was = changed(kept["score"][1], change)
    assert [pair[:2] for pair in told(compared("score", was, now).worse)] == [worse]
    back = compared("score", now, was)
    assert back.holds
    assert [pair[:2] for pair in told(back.better)] == [worse]


def test_a_score_that_is_rounding_may_be_other_rounding(kept):
    errors = {"theta": 1e-17, "omega": 1e-17}
    was = changed(kept["score"][1], of_score_but(worst_scaled_digits=15.9, max_errors=errors))
    now = changed(kept["score"][1], of_score_but(worst_scaled_digits=13.0, max_errors=dict.fromkeys(errors, 1e-13)))
    assert compared("score", was, now).holds
    assert not compared("score", {**was, "digits_held": 34.0}, now).holds


def test_a_margin_is_the_factor_by_which_errors_may_grow(kept, capsys):
    errors = {name: error / 4 for name, error in json.loads(kept["score"][1])["max_errors"].items()}
    was = changed(kept["score"][1], of_score_but(max_errors=errors))
    Path(EARLIER).write_text(json.dumps(was), encoding="utf-8")
    assert main([*SCORE, "--baseline", EARLIER]) == 1
    assert "worse  omega  largest error  0.00024  0.00095\n" in capsys.readouterr().out
    assert main([*SCORE, "--baseline", EARLIER, "--margin", "4.1"]) == 0


def test_the_rows_are_csv_and_what_is_worse_is_on_stderr(kept, capsys):
    Path(EARLIER).write_text(json.dumps(changed(kept["score"][1], of_score_but(worst_scaled_digits=9.0))), "utf-8")
    assert main([*SCORE, "--baseline", EARLIER, "--format", "csv"]) == 1
    printed = capsys.readouterr()
    assert len(list(csv.DictReader(io.StringIO(printed.out)))) == 65
    assert printed.err == (
        f"Against the baseline {EARLIER}: 1 worse, 0 better, 3 as before.\n"
        "worse: the rows: digits on scale was 9.00, is 3.50\n"
    )
    assert main([*SCORE, "--baseline", EARLIER, "--format", "json", "--quiet"]) == 1
    printed = capsys.readouterr()
    assert printed.err == "worse: the rows: digits on scale was 9.00, is 3.50\n"
    found = json.loads(printed.out)["baseline"]
    digits = json.loads(kept["score"][1])["worst_scaled_digits"]
    assert found["worse"] == [{"of": "the rows", "quantity": "digits on scale", "was": 9.0, "is": digits}]
    assert (found["holds"], found["same"]) == (False, 3)


def standing(place, word):
    return lambda document: document["verdicts"][place].update(standing=word)


@pytest.mark.parametrize(
    ("change", "worse"),
    [
        (standing(0, "FAIL"), ("order 2", "verdict", "PASS", "FAIL")),
        (standing(1, "NOT ESTABLISHED"), ("symplectic", "verdict", "PASS", "NOT ESTABLISHED")),
        (lambda document: document["verdicts"].pop(), ("symplectic", "present", "yes", "no")),
        (lambda document: document.update(measured_order=1.4), ("the step", "measured order", 2, 1.4)),
        (lambda d: d.update(reversibility_defect=2e-10), ("the step", "reversibility defect", 0, 2e-10)),
    ],
)
def test_a_check_is_worse_by_a_verdict_a_claim_that_is_gone_its_order_or_a_defect(kept, change, worse):
    was = json.loads(kept["check"][1])
    now = changed(kept["check"][1], change)
    found = compared("check", was, now)
    ((of, quantity, before, after),) = told(found.worse)
    assert (of, quantity, after) == (worse[0], worse[1], worse[3])
    assert before == (worse[2] if isinstance(worse[2], str) else pytest.approx(worse[2], abs=1e-3))
    assert of_check.exit_code(now, found) == 1


def test_a_claim_that_failed_before_does_no_harm_and_a_new_one_that_fails_does(kept):
    was = changed(kept["check"][1], standing(0, "FAIL"))
    assert of_check.exit_code(was, compared("check", was, was)) == 0
    better = compared("check", was, json.loads(kept["check"][1]))
    assert told(better.better) == [("order 2", "verdict", "FAIL", "PASS")]
    for word, code in (("PASS", 0), ("NOT ESTABLISHED", 3), ("FAIL", 1)):
        now = deepcopy(was)
        now["verdicts"].append({"claim": "other", "words": "another claim", "standing": word})
        found = compared("check", was, now)
        assert found.new == ("another claim",)
        assert of_check.exit_code(now, found) == code


@pytest.mark.usefixtures("measured_once")
def test_a_check_tells_the_comparison_in_json_and_beside_xml(kept, capsys):
    words, text = kept["check"]
    was = changed(text, lambda d: d["verdicts"].append({"claim": "x", "words": "gone", "standing": "FAIL"}))
    Path(EARLIER).write_text(json.dumps(was), encoding="utf-8")
    assert main([*words, "--baseline", EARLIER, "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found.pop("baseline")["worse"] == [{"of": "gone", "quantity": "present", "was": "yes", "is": "no"}]
    assert found == json.loads(text)
    assert main([*words, "--baseline", EARLIER, "--format", "junit"]) == 1
    printed = capsys.readouterr()
    (failure,) = ET.fromstring(printed.out.encode()).iter("failure")  # noqa: S314 - our own
    assert failure.text == "gone: present was yes, is no"
    assert printed.err.endswith("worse: gone: present was yes, is no\n")


def test_what_a_baseline_has_already_is_no_failure_in_xml_and_in_sarif(kept):
    text = kept["check"][1]
    was = changed(text, standing(0, "FAIL"))
    for now, skipped, level in ((was, 1, "none"), (json.loads(text), 0, "none")):
        suite = ET.fromstring(exchange.junit(now, None, compared("check", was, now)).encode())  # noqa: S314
        assert (suite.get("failures"), suite.get("skipped")) == ("0", str(skipped))
        result = json.loads(exchange.sarif(now, None, compared("check", was, now)))["runs"][0]["results"][0]
        assert (result["level"], result["baselineState"]) == (level, "unchanged" if skipped else "updated")
    worse = compared("check", json.loads(text), was)
    assert ET.fromstring(exchange.junit(was, None, worse).encode()).get("failures") == "2"  # noqa: S314
    result = json.loads(exchange.sarif(was, None, worse))["runs"][0]["results"][0]
    assert (result["level"], result["baselineState"]) == ("error", "updated")


def cells(name, document):
    tables = {"solvers": lambda: document["tables"]["error_vs_rtol"], "report": lambda: document["tables"]["points"]}
    return tables[name]() if name in tables else document


FAILED = {"failure": "no convergence", "max_error": None, "evaluations": None}


@pytest.mark.parametrize("name", ["solvers", "several", "report"])
def test_solvers_and_reports_are_worse_by_error_evaluations_or_no_states(kept, name):
    text = kept[name][1]
    now = json.loads(text)
    first = cells(name, now)[0]

    def worse_than(**fields):
        was = changed(text, lambda document: cells(name, document)[0].update(fields))
        forth, back = compared(name, was, now), compared(name, now, was)
        assert told(back.better) == [(of, what, b, a) for of, what, a, b in told(forth.worse)]
        return [one[1:] for one in told(forth.worse)]

    error, work = first["max_error"], first["evaluations"]
    assert worse_than(max_error=error / 11) == [("largest error", error / 11, error)]
    assert worse_than(max_error=error / 1.9) == []
    assert worse_than(evaluations=work // 3) == [("evaluations", work // 3, work)]
    assert worse_than(seconds=1e-9) == []
    lost = changed(text, lambda document: cells(name, document)[0].update(FAILED))
    assert [one[1:] for one in told(compared(name, now, lost).worse)] == [("scored", "yes", "no")]
    assert [one[1:] for one in told(compared(name, lost, now).better)] == [("scored", "no", "yes")]
    gone = changed(text, lambda document: cells(name, document).append({**first, "solver": "other", "name": "other"}))
    assert [one[1:] for one in told(compared(name, gone, now).worse)] == [("present", "yes", "no")]


def test_an_error_of_a_method_that_is_marked_as_rounding_may_grow_by_more(kept):
    text = kept["report"][1]
    error = cells("report", json.loads(text))[0]["max_error"]
    was = changed(text, lambda d: cells("report", d)[0].update(max_error=error / 3))
    assert not compared("report", was, json.loads(text)).holds
    was["tables"]["points"][0]["floor"] = True
    assert compared("report", was, json.loads(text)).holds
    assert compared("report", was, json.loads(text), 1.0).holds


def test_commands_of_solvers_end_with_1_and_say_what_is_worse(kept, capsys):
    for name in ("solvers", "several"):
        words, text = kept[name]
        was = changed(text, lambda document, name=name: cells(name, document)[0].update(evaluations=1))
        Path(EARLIER).write_text(json.dumps(was), encoding="utf-8")
        assert main([*words, "--baseline", EARLIER]) == 1
        assert re.search(r"worse  scipy\.RK45, rtol 0\.001, .*  evaluations +1 +56\n", capsys.readouterr().out)
        assert main([*words, "--baseline", EARLIER, "--format", "json"]) == 1
        printed = capsys.readouterr()
        assert printed.err.count("evaluations was 1, is 56\n") == 1
        assert cells(name, json.loads(printed.out))[0]["evaluations"] == 56


def test_last_bits_that_differ_as_on_another_machine_are_not_worse(monkeypatch, capsys):
    words = ("solvers", "--solvers", "DOP853,LSODA", "--rtol", "1e-6,1e-11", "--t-end", "4", "--format", "json")
    assert main(words) == 0
    Path(EARLIER).write_text(capsys.readouterr().out, encoding="utf-8")
    exact, bits = Counted.derivative, np.random.default_rng(1)

    def other(self, t, y):
        rates = np.asarray(exact(self, t, y))
        return rates * (1 + bits.choice([-1, 0, 1], rates.shape) * np.finfo(float).eps)

    monkeypatch.setattr(Counted, "derivative", other)
    assert main([*words, "--baseline", EARLIER]) == 0
    printed = capsys.readouterr()
    found, was = json.loads(printed.out), json.loads(Path(EARLIER).read_text(encoding="utf-8"))
    pairs = zip(cells("solvers", found), cells("solvers", was), strict=True)
    assert all(one["max_error"] != other["max_error"] for one, other in pairs)
    found = found["baseline"]
    assert (found["worse"], found["better"]) == ([], [])


def test_a_baseline_in_the_folder_that_is_written_is_refused_before_anything_is_measured(capsys, kept):
    folder = Path("report")
    folder.mkdir()
    file = folder / "work-precision.json"
    file.write_text(kept["report"][1], encoding="utf-8")
    for words in ((*REPORT, "--out", "report"), (*SOLVERS, "--out", "report", "--format", "json")):
        assert main([*words, "--baseline", str(file)]) == 2
        assert "lies in the folder that is written" in capsys.readouterr().err
    assert file.read_text(encoding="utf-8") == kept["report"][1]


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("", "is empty, as a shell makes the file"),
        ('{"problem"', "is damaged; JSON is accepted"),
        ("[" * 100_000, "is damaged; JSON is accepted"),
        ('{"problem": NaN}', "is damaged; JSON is accepted"),
        ("\ufffd".encode("utf-16").decode("latin-1"), "is damaged; JSON is accepted"),
        ("3", "is no answer of this command; what 'python -m compare score' prints with --format json is accepted"),
        ("[]", "is no answer of this command"),
        ("{}", "is no answer of this command"),
        (of_score_but(worst_scaled_digits="many"), "is no answer of this command"),
        (of_score_but(worst_scaled_digits=True), "is no answer of this command"),
        (of_score_but(digits_held=None), "is no answer of this command"),
        (of_score_but(digits_held=10**400), "is no answer of this command"),
        (of_score_but(points=[]), "is no answer of this command"),
        (of_score_but(points=[{"t": "1/0"}]), "is no answer of this command"),
        (of_score_but(max_errors={"x": 1.0}), "is no answer of this command"),
        (of_score_but(problem="Pendulum(theta0=2.0)"), 'is of problem = "Pendulum(theta0=2.0)", and this answer of'),
    ],
)
def test_a_baseline_that_cannot_be_one_is_refused_in_a_sentence(kept, capsys, content, says):
    text = content if isinstance(content, str) else json.dumps(changed(kept["score"][1], content))
    Path(EARLIER).write_text(text, encoding="utf-8")
    assert main([*SCORE, "--baseline", EARLIER]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"error: the baseline '{EARLIER}' ")
    assert says in printed.err
    assert printed.err.count("\n") == 1


@pytest.mark.parametrize("name", GATES)
def test_a_baseline_of_another_command_is_refused(kept, name):
    for other in GATES:
        Path(EARLIER).write_text(kept[other][1], encoding="utf-8")
        if other != name:
            with pytest.raises(ValueError, match="is no answer of this command"):
                opened(EARLIER, GATES[name])


@pytest.mark.parametrize(
    ("name", "change", "says"),
    [
        ("solvers", lambda d: d["parameters"].update(theta0=[2.0]), r"is of theta0 = \[2.0\], and this answer of"),
        ("solvers", lambda d: d["parameters"].pop("g"), r"is of g = none, and this answer of 9.81"),
        ("solvers", lambda d: d["reference"].update(definition="x"), 'is of definition = "x"'),
        ("several", lambda d: [row.update(t_end=3.0) for row in d], "is of t_end of pendulum, theta0 = 1.0 rad = 3.0"),
        ("report", lambda d: d["parameters"].update(n=[128]), r"is of n = \[128\], and this answer of \[64\]"),
        ("check", lambda d: d.update(problem="Kepler(e=0.5)"), r'is of problem = "Kepler\(e=0.5\)"'),
    ],
)
def test_a_baseline_of_another_question_is_refused(kept, name, change, says):
    text = kept[name][1]
    with pytest.raises(ValueError, match=says):
        compared(name, changed(text, change), json.loads(text))


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--baseline", "nowhere.json"), "there is no baseline 'nowhere.json'; a file is accepted."),
        (("--baseline", "."), "the baseline '.' is a folder; a file is accepted."),
        (("--margin", "2"), "--margin is of a baseline, and none is given"),
        (("--baseline", EARLIER, "--margin", "0.9"), "--margin is '0.9'; a number of at least 1 is accepted."),
        (("--baseline", EARLIER, "--margin", "nan"), "--margin is 'nan'; a number of at least 1 is accepted."),
        (("--min-digits", "0"), "--min-digits is '0'; a positive number is accepted."),
        (("--min-digits", "few"), "--min-digits is 'few'; a positive number is accepted."),
        (("--max-error", "inf"), "--max-error is 'inf'; a positive number is accepted."),
        (("--max-error=-1",), "--max-error is '-1'; a positive number is accepted."),
        (
            ("--min-digits", "18"),
            "18 correct digits are asked for, and the numbers hold 17; at most those are accepted.",
        ),
    ],
)
def test_misuse_of_a_gate_is_one_sentence(capsys, words, says):
    assert main([*SCORE, *words]) == 2
    printed = capsys.readouterr().err
    assert printed.startswith(f"error: {says}")
    assert printed.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--min-digits", "3.5"), "The limits hold: at least 3.5 correct digits on scale."),
        (("--max-error", "1e-3"), "The limits hold: no error above 0.001."),
        (
            ("--min-digits", "3.6", "--max-error", "1e-9"),
            f"{MISSED}: 3.5 correct digits on scale in row 47, fewer than 3.6, and an error of 0.000948, above 1e-09.",
        ),
    ],
)
def test_limits_are_told_at_the_end_in_fields_and_beside_csv(capsys, words, says):
    holds = "not" not in says
    assert main([*SCORE, *words]) == (not holds)
    assert capsys.readouterr().out.endswith(f"\n\n{says}\n")
    for form in ("csv", "json"):
        assert main([*SCORE, *words, "--format", form]) == (not holds)
        printed = capsys.readouterr()
        assert printed.err == ("" if holds else f"{says}\n")
    found = json.loads(printed.out)
    assert found["holds"] is holds
    given = dict(zip(words[::2], map(float, words[1::2]), strict=True))
    assert found["limits"] == {"min_digits": given.get("--min-digits"), "max_error": given.get("--max-error")}


def test_digits_on_scale_are_the_limit_and_not_those_near_a_zero():
    p = Pendulum(1)
    quarter = p.events(until=1).zero_crossings[0]
    t = [0.0, float(quarter)]
    y = [[1.0, 0.0], [1e-12, p.state(t[1])[1]]]
    found = compare.assert_score(p, t, y, min_digits=11.9, max_error=1e-11)
    assert found.worst_digits == 0
    with pytest.raises(AssertionError, match=r"^Pendulum\(theta0=1\.0.*fewer than 12\.1\.$"):
        compare.assert_score(p, t, y, min_digits=12.1)
    close = replace(found, max_error=1.0004e-3)
    assert Limits(max_error=1e-3).sentence(close) == f"{MISSED}: an error of 0.0010004, above 0.001."
    with pytest.raises(ValueError, match="nothing is asked of the score"):
        compare.assert_score(p, t, y)
    with pytest.raises(ValueError, match="max_error is 0; a positive number is accepted"):
        compare.assert_score(p, t, y, max_error=0)


@pytest.mark.usefixtures("measured_once")
def test_the_commands_of_the_workflow_that_is_documented_pass(capsys):
    page = (ROOT / "docs" / "score.md").read_text(encoding="utf-8")
    (workflow,) = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    written = re.search(r"written once, and again.*?```\n(.*?)```", page, re.DOTALL)[1]
    Path("my_methods.py").write_text(STEPS, encoding="utf-8")
    Path("verlet.csv").write_bytes(TABLE.read_bytes())
    Path("baselines").mkdir()
    lines = [*written.splitlines(), *re.findall(r"run: (python -m compare .*)", workflow)]
    assert len(lines) == 5
    for line in lines:
        command, _, file = line.removeprefix("python -m compare ").partition(" > ")
        assert main(shlex.split(command)) == 0, line
        printed = capsys.readouterr()
        assert printed.err == ""
        if file:
            Path(file).write_text(printed.out, encoding="utf-8")
    assert ET.parse("check.xml").getroot().get("failures") == "0"  # noqa: S314 - our own
