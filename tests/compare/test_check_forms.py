"""Integrators in the forms that people have: each is measured as what it is, on the time too."""

from __future__ import annotations

import ctypes
import json
import math
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import people
import pytest

import compare
from compare.__main__ import main
from compare.claims.frames import Field, Scene
from compare.methods.own import jitted, library
from compare.methods.own.forms import loaded
from compare.methods.own.rates import Forces, Gradients
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


def test_a_step_in_another_process_is_any_step(tmp_path, capsys):
    program = tmp_path / "verlet.py"
    program.write_text(PROGRAM, encoding="utf-8")
    command = f"{sys.executable} {program}"
    h, theta, omega = 0.125, 1.0, 0.5
    middle = omega - h / 2 * 9.81 * math.sin(theta)
    new = theta + h * middle
    assert compare.Process(command)([theta, omega], h).tolist() == [new, middle - h / 2 * 9.81 * math.sin(new)]
    words = ["--process", command, "--problem", "pendulum", "--order", "4", "--seconds", "9"]
    assert main(["check", *words, "--format", "json"]) == 1
    (verdict,) = json.loads(capsys.readouterr().out)["verdicts"]
    assert verdict["standing"] == "FAIL"


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


def test_a_step_in_a_library_is_called_by_the_convention_of_c(tmp_path, monkeypatch):
    """The library is Python's own, compiled by nobody: ``make interop`` has one in C."""

    @ctypes.CFUNCTYPE(None, library.RATES, ctypes.c_int, ctypes.c_double, ctypes.c_double, *[library.NUMBERS] * 2)
    def midpoint(f, n, t, h, y, new):
        k, z = (ctypes.c_double * n)(), (ctypes.c_double * n)()
        f(t, y, k)
        z[:] = [y[i] + h / 2 * k[i] for i in range(n)]
        f(t + h / 2, z, k)
        for i in range(n):
            new[i] = y[i] + h * k[i]

    class Opened(dict):
        def __missing__(self, name):
            raise AttributeError(name)

    file = tmp_path / "midpoint.so"
    file.touch()
    monkeypatch.setattr(ctypes, "CDLL", lambda _: Opened(midpoint=midpoint))
    step = loaded(f"{file}:midpoint")

    def rates(t, y):
        return np.array([y[1], -y[0] + t])

    y, t, h = np.array([1.0, 0.5]), 0.25, 0.125
    expected = y + h * rates(t + h / 2, y + h / 2 * rates(t, y))
    assert step(rates, t, y, h).tolist() == expected.tolist()
    with pytest.raises(ZeroDivisionError):
        step(lambda t, y: y / 0 if t else 1 // 0, 0, y, h)
    with pytest.raises(ValueError, match="has no function nothing; one that it exports is accepted"):
        loaded(f"{file}:nothing")


def test_compiled_code_calls_python_back_and_what_that_raises_is_raised_after_it(monkeypatch):
    """With a compiler that compiles nothing; ``make interop`` has numba's and JAX's."""
    monkeypatch.setitem(sys.modules, "numba", SimpleNamespace(njit=lambda function: function))
    asked = []

    def f(*arguments):
        asked.append(arguments)
        if len(asked) > 4:
            raise LookupError("enough")
        return 2.0 * arguments[-1]

    rates = jitted._compiled_call([f])
    states, times = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]), np.array([0.1, 0.2, 0.3])
    for given in ((np.empty(0), [1, 2]), (np.array([0.5]), states[:, 1]), (times, states), (times, states[:, ::-1])):
        assert np.array_equal(rates(*given), 2.0 * np.asarray(given[1]))
    assert [len(arguments) for arguments in asked] == [1, 2, 2, 2]
    assert asked[1][0] == 0.5
    assert np.array_equal(asked[2][0], times)
    with pytest.raises(LookupError, match="enough"), jitted.raised_within():
        rates(times, states)
    with pytest.raises(KeyError), jitted.raised_within():
        raise KeyError


def test_forces_are_of_the_shape_of_positions_and_equal_where_right_hand_sides_are():
    one, other = (Field(Scene(Pendulum(1)), 10) for _ in range(2))
    force, slope = Forces(one), Gradients(one)
    expected = -9.81 * np.sin([1.0, 2.0])
    assert force(1.0).shape == ()
    assert force([1.0]).tolist() == [expected[0]]
    assert np.array_equal(force(np.array([[1.0, 2.0]])), [expected])
    assert slope(1.0) == -expected[0]
    assert (one, force) == (other, Forces(other))
    assert force != slope
    assert len({one, other, Field(Scene(Pendulum(2)), 10)}) == 2
    with pytest.raises(
        ValueError, match=r"force was called with an array of shape \(2,\); 1 positions along the first"
    ):
        force([1.0, 2.0])
