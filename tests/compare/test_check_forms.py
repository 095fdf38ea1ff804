"""Integrators in the forms that people have: each is measured as what it is, on the time too."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from dataclasses import replace

import numpy as np
import people
import pytest

import compare
from compare.__main__ import main
from compare.methods.own.forms import loaded
from reference import Pendulum
from reference.problems.families import find_family


@pytest.mark.parametrize(
    ("integrator", "form", "claims"),
    [
        (people.verlet_of_a_potential, "gradient", {"order": 2, "symplectic": True}),
        (people.with_its_own_equation, "own", {"order": 4, "problem": Pendulum(1)}),
        (people.Stepper, "class", {"order": 4}),
        (people.Advancing, "class", {"order": 2}),
        (people.Leapfrog, "class", {"order": 2}),
        (people.Formula, "timed", {"order": 4}),
        (people.for_second_order_alone, "timed", {"order": 4}),
        (people.states_one_after_another, "generator", {"order": 4}),
        (people.times_and_states, "generator", {"order": 4}),
        (people.over_a_span, "solver", {"order": 4}),
        (people.in_so_many_steps, "solver", {"order": 4}),
        (people.to_the_end, "solver", {"order": 4}),
    ],
)
def test_sound_integrators_hold_in_every_form(integrator, form, claims):
    found = compare.check(integrator, **claims)
    assert found.claims_hold
    assert found.form == form


def test_a_class_that_keeps_the_time_of_a_step_fails_where_the_time_enters():
    found = compare.check(people.WithFrozenTime, order=4)
    assert found.claims_hold is False
    assert found.still.value == pytest.approx(4, abs=0.1)
    assert found.swinging.value == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize("name", ["times_and_states", "over_a_span", "Formula"])
def test_every_form_is_found_by_its_name(name):
    assert compare.check(loaded(f"{people.__file__}:{name}"), order=4).claims_hold


@pytest.mark.parametrize("integrator", [people.doubly, people.Doubly])
def test_of_twice_the_step_nothing_holds_in_any_form(integrator):
    found = compare.check(integrator, order=2, reversible=True)
    assert [one.standing for one in found.verdicts] == ["FAIL", "FAIL"]
    assert all("a constant slope is advanced by 2 h" in str(one) for one in found.verdicts)


def test_a_whole_integrator_goes_back_where_falling_times_are_no_mistake():
    assert compare.check(people.over_a_span, order=4, backward=True).claims_hold
    found = compare.check(people.in_so_many_steps, order=4, backward=True)
    assert [one.standing for one in found.verdicts] == ["PASS", "PASS"]


def test_an_equation_of_its_own_is_that_of_the_problem():
    assert compare.check(people.with_its_own_equation, order=4, problem=Pendulum(2)).claims_hold
    assert compare.check(people.with_its_own_equation, order=4, problem=Pendulum(1, length=2)).claims_hold is False


def test_a_step_on_arrays_sees_few_numbers_of_lanes():
    """JAX compiles a step for each."""
    seen = set()

    def midpoint(f, y, h):
        seen.add(np.shape(np.asarray(y, dtype=float)))
        return y + h * f(y + h / 2 * f(y))

    found = compare.check(midpoint, order=2)
    assert (found.engine, found.claims_hold) == ("on arrays", True)
    assert seen == {(2,), (2, 8), (2, 16), (2, 32), (2, 64), (2, 256)}
    slopes = replace(found.still, value=2.2, half_width=0.35)
    assert replace(found, still=slopes).order_standing == "holds", "as high as is claimed from end to end"
    assert replace(found, still=replace(slopes, half_width=0.45)).order_standing == "open"


class NoStep:
    def __init__(self, f, y0, h):
        pass


class NoState(NoStep):
    def step(self):
        pass


def of_something(f, t_span, y0, colour):
    return f, t_span, y0, colour


def by_its_name(f, y, *, h):
    return y + h * f(y)


def three_states(f, y0, h):
    yield from [y0, y0 + h * f(y0)]


def own_times(fun, t_span, y0, h):
    del fun, h
    return np.linspace(*t_span, 7), np.tile(y0, (7, 1))


@pytest.mark.parametrize(
    ("integrator", "says"),
    [
        (people.with_its_own_equation, "takes no f, so that nobody knows of which equation it is a step"),
        (lambda f, y: f(y), "has the arguments f, y, and no step"),
        (NoStep, "is a class without a method step or advance or do_step"),
        (NoState, "has no state; one of y, state, u, x, or q and p, is accepted"),
        (of_something, "an argument colour, which it is not given; f, t_span, y0, t_eval, h, n are accepted"),
        (people.at_times_of_its_own, "gave the states at 9 times of its own"),
        (by_its_name, "takes h by its name alone; arguments by their places are accepted"),
        (three_states, "yielded 2 states where 9 were asked for"),
        (own_times, "gave the states at 7 times of its own, where 9 from 0 to 0.8 were asked for"),
    ],
)
def test_what_cannot_be_called_is_one_sentence(integrator, says):
    with pytest.raises(ValueError, match=says) as caught:
        compare.check(integrator, order=1)
    assert "\n" not in str(caught.value)


def test_a_form_by_itself_takes_no_other():
    with pytest.raises(ValueError, match="form is 'separable' for a generator, which is one by itself; none"):
        compare.check(people.times_and_states, order=4, form="separable")


def test_a_step_of_its_own_on_a_problem_in_time_takes_the_time():
    driven = find_family("driven-pendulum").problem()
    with pytest.raises(
        ValueError, match=r"takes no time, on which DrivenPendulum\(.*\) depends; \(t, y, h\) is accepted"
    ):
        compare.check(people.with_its_own_equation, order=4, problem=driven)


PROGRAM = """
import math, sys
for line in sys.stdin:
    h, theta, omega = map(float, line.split())
    omega -= h / 2 * 9.81 * math.sin(theta)
    theta += h * omega
    omega -= h / 2 * 9.81 * math.sin(theta)
    print(theta, omega, flush=True)
"""


def test_a_step_in_another_process_is_measured_as_any(tmp_path, capsys):
    program = tmp_path / "verlet.py"
    program.write_text(PROGRAM, encoding="utf-8")
    words = ["--process", f"{sys.executable} {program}", "--problem", "pendulum", "--order", "2", "--symplectic"]
    assert main(["check", *words, "--reversible", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [one["standing"] for one in found["verdicts"]] == ["PASS"] * 3
    assert main(["check", *words[:-2], "4"]) == 1


@pytest.mark.parametrize(
    ("command", "says"),
    [
        ("no-such-program", "'no-such-program' cannot be started: No such file or directory; a program is accepted"),
        ("cat", "cat wrote '.*' for the line '.*'; 2 numbers with blanks between them are accepted"),
        ("true", "true ended with exit code 0; a program that reads line after line is accepted"),
    ],
)
def test_a_program_that_is_no_step_is_one_sentence(command, says):
    with pytest.raises(ValueError, match=says):
        compare.check(compare.Process(command), order=2, problem=Pendulum(1))


LIBRARY = """
typedef void (*rhs)(double t, const double *y, double *dydt);

void midpoint(rhs f, int n, double t, double h, const double *y, double *ynew)
{
    double k[16], z[16];
    f(t, y, k);
    for (int i = 0; i < n; i++) z[i] = y[i] + h / 2 * k[i];
    f(t + h / 2, z, k);
    for (int i = 0; i < n; i++) ynew[i] = y[i] + h * k[i];
}
"""


@pytest.mark.parametrize("compiler", [one for one in ("cc", "gcc", "clang") if shutil.which(one)][:1])
def test_a_step_in_a_library_is_called_by_the_convention_of_c(tmp_path, compiler):
    (tmp_path / "midpoint.c").write_text(LIBRARY, encoding="utf-8")
    library = tmp_path / "midpoint.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", library, tmp_path / "midpoint.c"], check=True)
    found = compare.check(loaded(f"{library}:midpoint"), order=2)
    assert found.claims_hold
    assert found.swinging.value == pytest.approx(2, abs=0.1)
    with pytest.raises(ValueError, match="has no function nothing; one that it exports is accepted"):
        loaded(f"{library}:nothing")
