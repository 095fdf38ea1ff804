"""The order of a step by its power series in h, where it is plain arithmetic."""

from __future__ import annotations

import numpy as np
import oddities
import pytest
import slips

from compare.claims.candidate import Candidate
from compare.claims.expansion import Expansion, Expansions, NoSeriesError
from compare.claims.frames import Frame, Scene
from compare.claims.powers import Powers, lower, powers
from compare.methods.own.forms import form_of
from reference import Pendulum
from reference.arithmetic.precision import mp

STILL = Scene(Pendulum(1.0))
SWINGING = Scene(Pendulum(1.0), Frame(0.5, 2.0))


def found(step, scene=STILL):
    return powers(Candidate(step, form_of(step), "step"), scene, 0.1)


@pytest.mark.parametrize(
    ("name", "order"),
    [("euler", 1), ("kutta3", 3), ("tsitouras54", 5), ("butcher6", 6), ("dop853", 8)],
)
def test_a_tableau_has_its_order_where_the_time_enters(name, order):
    assert found(oddities.with_coefficients_of(name), SWINGING).order == order


@pytest.mark.parametrize(
    ("name", "order"),
    [("ruth3", 3), ("blanes_moan_srkn14a", 6), ("yoshida8a", 8), ("sofroniou_spaletta10", 10)],
)
def test_a_splitting_has_its_order(name, order):
    """The second has the smallest of all errors, the third the largest terms."""
    series = found(oddities.splitting_of(name))
    assert series.order == order
    assert max(series.differences[:order]) < 1e-12
    assert series.differences[order] > 1e-9


@pytest.mark.parametrize(("stage", "term"), [((2, 1), 7), ((8, 6), 2), ((11, 10), 2)])
def test_a_coefficient_that_is_a_tenth_of_a_percent_off_shows_in_the_term_that_it_spoils(stage, term):
    assert found(oddities.with_coefficients_of("dop853", slip=stage), SWINGING).order == term - 1


def test_a_slip_that_shows_no_more_than_missing_digits_would_leaves_the_order_open():
    """Of DOP853's first coefficient the eighth term alone takes notice, and little."""
    series = found(oddities.with_coefficients_of("dop853", slip=(1, 0)), SWINGING)
    assert series.order is None
    assert series.rounded


def test_stages_at_the_wrong_times_are_seen_where_the_time_enters():
    still, swinging = (found(slips.stages_at_the_wrong_times, scene) for scene in (STILL, SWINGING))
    assert (still.order, swinging.order) == (4, 1)
    assert lower(still, swinging).order == 1
    assert lower(still, None) is None


def test_digits_that_a_coefficient_lacks_leave_the_order_open():
    series = found(oddities.rk4_with_a_node_of_ten_digits)
    assert series.order is None
    assert series.rounded
    assert not Powers((1e-16,) * 24).rounded
    assert Powers((1e-16,) * 24).order is None


def branches_on_the_step(f, y, h):
    return slips.rk4(f, y, h) if h < 0.01 else slips.euler(f, y, h)


def takes_the_root_of_the_step(f, y, h):
    return y + np.sqrt(h) ** 2 * f(y)


def iterates_until_it_is_near(f, y, h):
    new = y + h * f(y)
    while np.max(np.abs(new - (y + h * f((y + new) / 2)))) > 1e-13:
        new = y + h * f((y + new) / 2)
    return new


def is_another_for_floats(f, y, h):
    return slips.euler(f, y, h) if isinstance(h, float) else slips.rk4(f, y, h)


def turns_all_into_doubles(f, y, h):
    return slips.euler(f, np.asarray(y, dtype=float), h)


def gives_one_number(f, y, h):
    return (y + h * f(y))[0]


@pytest.mark.parametrize(
    "step",
    [
        branches_on_the_step,
        takes_the_root_of_the_step,
        iterates_until_it_is_near,
        is_another_for_floats,
        turns_all_into_doubles,
        gives_one_number,
    ],
)
def test_a_step_without_a_series_or_with_another_has_no_order_by_it(step):
    assert found(step) is None


def test_a_branch_that_no_step_changes_and_functions_of_the_step_are_followed():
    def exponential(f, y, h):
        """Midpoint with h written as ln(exp h), |h| and the like."""
        size = np.log(np.exp(h)) + 2 * np.sin(h / 2) ** 2 + np.cos(h) - 1
        half = abs(h) * np.float64(0.5) if y[0] < 100 else h
        return y + size * f(y + np.tan(np.arctan(half)) * f(y)) + 0 / np.sqrt(4 + h) * y + (1 + h) ** 0.5 * 0 * y

    assert found(exponential).order == 2


def test_an_expansion_is_a_number():
    with mp.workprec(100):
        home = Expansions(6)
        h = home.step()
        table = {
            "products": ((1 + h) * (1 - h), [1, 0, -1, 0]),
            "quotients": (1 / (1 - h), [1, 1, 1, 1]),
            "powers": ((1 + h) ** 3, [1, 3, 3, 1]),
            "arrays": ((np.array([1.0, 2.0]) * h)[1] + np.float64(3), [3, 2, 0, 0]),
            "negatives": (+(-h) - 1, [-1, -1, 0, 0]),
            "sizes": (abs(-h), [0, 1, 0, 0]),
            "fractions": ((1 + h) ** 2.0 / 4, [0.25, 0.5, 0.25, 0]),
        }
        for name, (value, terms) in table.items():
            assert [float(term) for term in value.terms()[:4]] == terms, name


def test_an_expansion_is_compared_only_where_the_step_does_not_matter():
    home = Expansions(6)
    h, two = home.step(), home.constant(2)
    assert 1 < two <= 2 < home.constant(3)
    assert two >= 2
    assert two > 1
    assert two == 2
    assert two != 3
    assert two
    for question in (lambda: h < 1, lambda: h == 0, lambda: bool(h), lambda: two < "3", lambda: two == [2]):
        with pytest.raises(NoSeriesError):
            question()
    with pytest.raises(TypeError):
        float(h)
    assert not hasattr(h, "conjugate")
    assert isinstance(np.sin(np.array([h], dtype=object))[0], Expansion)
