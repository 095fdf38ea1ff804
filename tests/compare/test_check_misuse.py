"""compare.check and ``python -m compare check``: every mistake is one sentence, every claim an exit code."""
# ruff: noqa: ARG001 - the functions take what they are given, and some make no use of it

from __future__ import annotations

import json
import re
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import slips

import compare
from compare.__main__ import main

HERE = Path(__file__).parent
SLIPS = str(HERE / "slips.py")
COUNT = iter(range(10**9))
MEMORY: dict[str, np.ndarray] = {}


def raises(f, y, h):
    return y + h * f(y) / [1][len(y)]


def leaves(f, y, h):
    raise SystemExit("enough")


def gives_nothing(f, y, h):
    y + h * f(y)


def gives_one_number(f, y, h):
    return (y + h * f(y))[0]


def gives_a_table(f, y, h):
    return np.outer(y, f(y)) * h


def gives_nan(f, y, h):
    return y + np.sqrt(-1 - y[0] ** 2) * h


def gives_complex(f, y, h):
    return y + 1j * h * f(y)


def gives_words(f, y, h):
    return ["a", "b"]


def gives_ragged(f, y, h):
    return [y, [1.0]]


def gambles(f, y, h):
    return y + h * f(y) * np.random.default_rng().random()


def counts(f, y, h):
    return y + h * f(y) * (1 + next(COUNT) * 1e-9)


def remembers(f, y, h):
    """The slope at the end of the step before, as a method with first-same-as-last might keep it."""
    k = MEMORY.get("k", f(y))
    new = y + h * k
    MEMORY["k"] = f(new)
    return new


def asks_without_end(f, y, h):
    while True:
        f(y)


def asks_with_scalars(f, y, h):
    return y + h * np.array(f(y[0], y[1]))


def asks_with_three(f, y, h):
    return y + h * f(0, y, h)


def asks_with_too_many(f, y, h):
    return y + h * f(np.zeros(3))[:2]


def forgets_the_momenta(q, p, force, h):
    return q + h * p


def gives_too_few_times(f, y0, t):
    return np.zeros((3, 2))


def gives_nan_in_time(f, y0, t):
    return np.full((len(t), 2), np.nan)


SENTENCES = {
    raises: "raises raised IndexError: list index out of range.",
    leaves: "leaves raised SystemExit: enough.",
    gives_nothing: "gives_nothing returned nothing; the new state is accepted.",
    gives_one_number: "gives_one_number returned an array of shape () for a state of shape (2,); the same shape",
    gives_a_table: "gives_a_table returned an array of shape (2, 2) for a state of shape (2,)",
    gives_nan: "gives_nan returned [nan, nan] for y = (",
    gives_complex: "gives_complex returned complex numbers; real ones are accepted.",
    gives_words: "gives_words returned a list; an array of real numbers is accepted.",
    gives_ragged: "gives_ragged returned a ragged sequence",
    gambles: "for the same state and step: it is not deterministic, or keeps something from call to call",
    counts: "for the same state and step: it is not deterministic, or keeps something from call to call",
    remembers: "for the same state and step: it is not deterministic, or keeps something from call to call",
    asks_without_end: "asks_without_end called f more than 10000 times in one step; it does not come to an end.",
    asks_with_scalars: "f was called with arguments of the shapes (), (); f(y) or f(t, y) is accepted.",
    asks_with_three: "f was called with arguments of the shapes (), (2,), (); f(y) or f(t, y) is accepted.",
    asks_with_too_many: "f was called with a state of shape (3,); 2 components along the first axis are accepted.",
    forgets_the_momenta: "returned an array of float64; the new positions and momenta (q, p) are accepted.",
    gives_too_few_times: "gives_too_few_times returned an array of shape (3, 2) for 9 times; (9, 2) is accepted",
    gives_nan_in_time: "gives_nan_in_time returned states that are not finite",
}


@pytest.mark.parametrize("step", SENTENCES)
def test_a_function_that_cannot_be_checked_is_one_sentence(step):
    MEMORY.clear()
    with pytest.raises(ValueError, match=re.escape(SENTENCES[step])) as raised:
        compare.check(step)
    sentence = str(raised.value)
    assert sentence.endswith(".")
    assert "\n" not in sentence
    assert len(sentence) < 320


def never_returns(f, y, h):
    while True:
        pass


def never_returns_and_keeps_what_is_raised(f, y, h):
    while True:
        try:
            time.sleep(0.01)
        except BaseException:  # as a user might write it
            if next(COUNT) % 3 == 2:
                raise


@pytest.mark.parametrize("step", [never_returns, never_returns_and_keeps_what_is_raised])
def test_a_step_that_never_returns_is_stopped(step):
    with pytest.raises(ValueError, match=r"never_returns\w* took more than 0\.3 s; a step that returns is accepted"):
        compare.check(step, seconds=0.3)


def test_it_is_stopped_in_another_thread_too():
    said: list[str] = []

    def run():
        try:
            compare.check(never_returns, seconds=0.3)
        except ValueError as error:
            said.append(str(error))

    thread = threading.Thread(target=run)
    thread.start()
    thread.join(30)
    assert said == ["never_returns took more than 0.3 s; a step that returns is accepted, or a longer time."]


@pytest.mark.parametrize(
    ("arguments", "error", "says"),
    [
        ({"step": 3}, TypeError, "the integrator is of type int; a function is accepted"),
        ({"step": lambda f: f}, ValueError, r"the integrator has the arguments f; \(f, y, h\)"),
        ({"step": slips.rk4, "order": -1}, ValueError, "order is -1; a positive number below 100 is accepted"),
        ({"step": slips.rk4, "order": "four"}, ValueError, "order is 'four'"),
        ({"step": slips.rk4, "form": "stp"}, ValueError, "form 'stp' is unknown, perhaps step"),
        (
            {"step": slips.rk4, "problem": "pendulum"},
            TypeError,
            "problem is 'pendulum'; a problem with positions and momenta",
        ),
    ],
)
def test_arguments_that_make_no_check_are_one_sentence(arguments, error, says):
    with pytest.raises(error, match=says):
        compare.check(**arguments)


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["rk4", "--order", "4"], 0),
        (["rk4", "--order", "5"], 1),
        (["rk4", "--symplectic"], 1),
        (["rk4", "--reversible"], 1),
        (["yoshida4", "--order", "4", "--symplectic", "--reversible"], 0),
        (["weights_that_miss_one"], 0),
        (["rk4_over_a_grid", "--order", "4", "--form", "integrator"], 0),
    ],
)
@pytest.mark.usefixtures("without_a_process")
def test_the_exit_code_says_whether_the_claims_hold(words, code, capsys):
    assert main(["check", f"{SLIPS}:{words[0]}", *words[1:], "--format", "json"]) == code
    found = json.loads(capsys.readouterr().out)
    assert found["claims_hold"] is (code == 0)
    assert {"measured_order", "order_interval", "symplecticity_defect", "reversibility_defect", "verdict"} <= set(found)


@pytest.mark.usefixtures("without_a_process")
def test_the_text_begins_with_the_verdict_and_shows_the_errors(capsys):
    assert main(["check", f"{SLIPS}:forest_ruth_of_order_two", "--order", "4"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("FAIL  order 4: measured 2.00 ± 0.0")
    assert lines[2].startswith("forest_ruth_of_order_two: claims order 4, measured 2.00 ± 0.0")
    assert sum(line.endswith("*") for line in lines) >= 4


def test_a_module_is_imported_from_where_one_is_and_its_words_are_kept_apart(tmp_path, capsys, monkeypatch):
    (tmp_path / "my_own_step.py").write_text(
        "print('hello')\nclass Methods:\n    @staticmethod\n    def euler(f, y, h):\n        return y + h * f(y)\n"
    )
    monkeypatch.chdir(tmp_path)
    assert main(["check", "my_own_step:Methods.euler", "--order", "1", "--format", "json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["measured_order"] == pytest.approx(1, abs=0.03)
    assert err == "hello\n"


BROKEN = {
    "syntax.py": "def step(:\n",
    "raises.py": "1/0\n",
    "leaves.py": "raise SystemExit('no')\n",
    "lacks.py": "import no_such_module_anywhere\n",
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_module_that_cannot_be_imported_is_one_sentence(name, tmp_path, capsys):
    (tmp_path / name).write_text(BROKEN[name])
    assert main(["check", f"{tmp_path / name}:step"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert f"{name} cannot be imported: " in err


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ([], "a function MODULE:STEP or --process COMMAND is accepted, one of both"),
        (["slips"], "'slips' names no function; MODULE:STEP or FILE.py:STEP is accepted"),
        (["no_such_module_anywhere:step"], "cannot be imported: ModuleNotFoundError"),
        (["nowhere.py:step"], "there is no file 'nowhere.py'"),
        ([f"{SLIPS}:rk5"], "function 'rk5' is unknown, perhaps rk4"),
        ([f"{SLIPS}:W1"], "is of type float; a function is accepted"),
        ([f"{SLIPS}:rk4", "--order", "x"], "--order is 'x'; a positive number is accepted"),
        ([f"{SLIPS}:rk4", "--form", "stp"], "perhaps step"),
        ([f"{SLIPS}:rk4", "--symplektic"], "perhaps --symplectic"),
        ([f"{SLIPS}:adaptive", "--order", "3"], "chooses its own steps"),
    ],
)
@pytest.mark.usefixtures("without_a_process")
def test_a_mistake_in_the_command_is_one_sentence_and_exit_code_2(words, says, capsys):
    assert main(["check", *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith("error: ")
    assert says in err


def rk4_that_fails_with_long_steps(f, y, h):
    """RK4, but no number for h >= 0.15."""
    if not isinstance(h, (float, np.ndarray)):
        raise TypeError("numbers are asked for")
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return np.where(np.asarray(h) >= 0.15, np.nan, 1.0) * (y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4))


def explodes(f, y, h):
    del f, h
    return y * 1e300


@pytest.mark.parametrize(
    ("step", "sentence"),
    [
        (
            rk4_that_fails_with_long_steps,
            r"a step of h = 0\.[12]\d* gives no finite state; finite numbers are accepted\.",
        ),
        (explodes, "gives no finite states however short its steps are; finite ones are accepted"),
    ],
)
def test_a_step_that_gives_no_number_now_and_then_is_one_sentence(step, sentence):
    with pytest.raises(ValueError, match=sentence):
        compare.check(step)


def test_a_step_in_binary32_has_its_order():
    def midpoint(f, y, h):
        narrow, size = np.asarray(y, dtype=np.float32), np.float32(h)
        half = narrow + size / np.float32(2) * np.asarray(f(narrow), dtype=np.float32)
        return narrow + size * np.asarray(f(half), dtype=np.float32)

    found = compare.check(midpoint, order=2)
    assert found.claims_hold
    assert found.advance == 1
    assert found.measured_order == pytest.approx(2, abs=0.15)
