"""RK4 along the brachistochrones: where its order breaks down, why, and how the smooth forms repair it."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from compare.__main__ import main
from compare.sources.published.entry import reproduce
from compare.sources.published.forms import CycloidByAngle, Form, forms
from reference.arithmetic.namespaces import NUMPY
from reference.problems.cycloid.arc import CycloidCurve

SINGULAR, SMOOTH = ("dx/dy", "dphi/dz"), ("dx/dtheta", "dphi/dpsi")


@pytest.fixture(scope="module")
def entries():
    (found,) = reproduce(["curves"])
    return {(entry.column, int(entry.row)): entry for entry in found.entries}


@pytest.fixture(scope="module")
def known():
    return forms(0.1, 1.9999, 0.5)


def column(entries, name, field="reproduced"):
    return {n: float(getattr(entry, field)) for (column, n), entry in entries.items() if column == name}


def local_orders(form, method, counts):
    errors = form.errors(method, counts, "float64")
    return [math.log2(before / after) for before, after in pairwise(errors)]


@pytest.mark.parametrize("form", SINGULAR)
def test_the_order_of_a_singular_form_rises_to_4_only_where_a_step_is_shorter_than_the_distance(entries, form):
    orders, ratios = column(entries, f"{form}: order", "exact"), column(entries, "h/distance")
    assert list(orders.values()) == sorted(orders.values())
    assert all(order < 2 for n, order in orders.items() if ratios[n] > 8)
    assert all(order > 3.5 for n, order in orders.items() if ratios[n] < 0.7)
    assert orders[1 << 17] == pytest.approx(4, abs=0.05)


@pytest.mark.parametrize("form", SMOOTH)
def test_a_smooth_form_has_order_4_from_the_first_row_and_reaches_rounding_where_the_other_has_two_digits(
    entries, form
):
    orders = column(entries, f"{form}: order", "exact")
    assert set(orders.values()) == {4.0}
    errors = column(entries, f"{form}: error")
    assert errors[128] < 1e-11
    assert errors[1024] < 1e-13
    assert column(entries, f"{SINGULAR[SMOOTH.index(form)]}: error")[1024] > 1e-3


@pytest.mark.parametrize("form", [*SINGULAR, *SMOOTH])
def test_no_order_is_shown_where_the_error_is_rounding(entries, form):
    errors = {n: entry for (name, n), entry in entries.items() if name == f"{form}: error"}
    orders = {n: entry.shown for (name, n), entry in entries.items() if name == f"{form}: order"}
    for n, order in orders.items():
        starred = errors[n].shown.endswith("*") or errors[n // 2].shown.endswith("*")
        assert (order == "*") == starred
        assert starred or 1 < float(order) < 4.1
    assert orders[256] != "*"
    assert form in SINGULAR or set(list(orders.values())[2:]) == {"*"}


def test_a_digit_that_is_shown_is_one_of_the_march_without_rounding(entries):
    for entry in entries.values():
        if not entry.shown.endswith("*") and not entry.shown.startswith("~"):
            unit = 10.0 ** -len(entry.shown.partition("e")[0].partition(".")[2])
            scale = 10.0 ** int(entry.shown.partition("e")[2] or 0)
            assert abs(float(entry.shown) - float(entry.exact)) <= 0.51 * unit * scale + 0.005 * scale


def test_the_marks_of_rounding_are_explained(capsys):
    assert main(["published", "curves"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "* means rounding" in out
    assert "-3.94" not in out
    assert main(["published", "figure7"]) == 0
    assert "* means rounding" not in capsys.readouterr().out


def test_the_table_goes_on_with_figure_7(entries):
    (figure7,) = reproduce(["figure7"])
    listed = {int(e.row): float(e.reproduced) for e in figure7.entries if e.column == "error"}
    n = np.log(list(listed))
    between = math.exp(np.interp(math.log(256), n, np.log(list(listed.values()))))
    assert column(entries, "dx/dy: error")[256] == pytest.approx(between, rel=0.03)


def test_rk4_on_a_slope_of_its_own_variable_is_simpsons_rule(known):
    form = known["dx/dy"]
    y = np.linspace(float(form.start), float(form.end), 257)
    slopes = np.sqrt(y / (2 - y))
    rule = (slopes[0] + 4 * slopes[1::2].sum() + 2 * slopes[2:-1:2].sum() + slopes[-1]) * (y[2] - y[0]) / 6

    def x(depth):
        return math.acos(1 - depth) - math.sqrt(depth * (2 - depth))

    (error,) = form.errors("rk4", [128], "float64")
    assert error == pytest.approx(abs(rule - (x(y[-1]) - x(y[0]))), rel=1e-10)


def test_a_method_of_order_8_is_held_up_in_the_same_way_and_repaired_in_the_same_way(known):
    counts = [128, 256, 512]
    assert max(local_orders(known["dx/dy"], "dop853", counts)) < 2
    assert known["dx/dtheta"].errors("dop853", [16], "float64")[0] < 1e-13


def test_a_march_from_the_release_itself_keeps_order_3_2_of_the_root_there():
    upper = Form(CycloidCurve(1), "state", Fraction(0), Fraction(1))
    assert local_orders(upper, "rk4", [256, 512, 1024]) == pytest.approx([1.5, 1.5], abs=0.01)


def test_the_smooth_form_goes_through_the_lowest_point():
    through = Form(CycloidByAngle(1), "curve", Fraction(0), Fraction(5))
    assert local_orders(through, "rk4", [64, 128, 256]) == pytest.approx([4, 4], abs=0.02)


def test_both_forms_of_a_curve_are_one_curve(known):
    theta, p = 2.0, {"radius": 1.0}
    y = 1 - math.cos(theta)
    by_angle, _ = CycloidByAngle.derivative(NUMPY, 0, (0.0, theta), p)
    by_depth, _ = CycloidCurve.derivative(NUMPY, 0, (0.0, y), p)
    assert by_angle == pytest.approx(by_depth * math.sin(theta), rel=1e-14)
    for singular, smooth, row in (("dx/dy", "dx/dtheta", "curve"), ("dphi/dz", "dphi/dpsi", "state")):
        one, other = known[singular], known[smooth]
        for along, angle in ((one.start, other.start), (one.end, other.end)):
            place = one.problem.along("state", [along])[0, 0]
            assert place == pytest.approx(other.problem.along(row, [angle])[0, 0], rel=1e-11)


def test_the_table_says_where_why_and_how(capsys):
    assert main(["published", "curves"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    for words in ("RK4 is Simpson's rule", "infinite at the lowest point", "The repair", "order 3/2"):
        assert words in said


def test_json_has_every_form_with_its_note(capsys):
    assert main(["published", "curves", "--format", "json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["item"] for row in rows} == {"thesis figure 7, continued"}
    assert {row["row"] for row in rows} == {str(2**k) for k in range(7, 18)}
    assert all(row["published"] is row["off_by"] is None and row["note"] for row in rows)
