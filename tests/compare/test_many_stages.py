"""Tables of many stages: their conditions one by one, what is printed elsewhere, and slips in them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from flint import arb, fmpq

from compare.methods import find
from compare.methods.kinds.one_step import Tableau
from compare.methods.order.algebraic import Q, enclose
from compare.methods.order.conditions import order_of_tableau
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from compare.methods.order.stage_vectors import StageVectors
from reference.arithmetic.precision import PrecisionError, ctx


def table(name: str) -> Tableau:
    method = find(name)
    assert isinstance(method, Tableau)
    return method


def in_balls(values: tuple[object, ...]) -> list[arb]:
    return [enclose(value) for value in values]


@pytest.mark.parametrize(("name", "highest"), [("rk4", 7), ("gauss6", 6), ("fehlberg78", 8), ("dop853", 6)])
def test_stage_vectors_meet_the_conditions_of_all_trees_and_of_no_others(name: str, highest: int) -> None:
    method = table(name)
    vectors, weights = StageVectors(method.matrix), ElementaryWeights(method.matrix)
    for order in range(1, highest + 1):
        known = {weights.weight(method.b, tree) * density(tree) - 1 for tree in trees(order)}
        assert set(vectors.residuals(method.b, order)) == known


def test_rationals_of_two_kinds_and_balls_meet_the_same_conditions() -> None:
    method = table("verner65")
    rationals = [[fmpq(x.numerator, x.denominator) for x in row] for row in (method.b, *method.matrix)]
    with ctx.workprec(300):
        balls = [in_balls(row) for row in (method.b, *method.matrix)]
        for order in range(1, 9):
            exact = sorted(StageVectors(rationals[1:]).residuals(rationals[0], order))
            near = sorted(StageVectors(balls[1:]).residuals(balls[0], order), key=float)
            assert len(exact) == len(near)
            assert all(ball.contains(value) for value, ball in zip(exact, near, strict=True))


def test_balls_enclose_the_conditions_of_every_tree_that_was_joined_to_others() -> None:
    method = table("feagin10")
    with ctx.workprec(300):
        balls = [in_balls(row) for row in (method.b, *method.matrix)]
        vectors, weights = StageVectors(balls[1:]), ElementaryWeights(balls[1:])
        for order in (5, 8):
            found = list(vectors.residuals(balls[0], order))
            for tree in trees(order):
                residual = weights.weight(balls[0], tree) * density(tree) - 1
                assert any(ball.overlaps(residual) for ball in found)


def test_few_vectors_stand_for_many_trees() -> None:
    vectors = StageVectors(table("verner87").matrix)
    met = [len(list(vectors.residuals(table("verner87").b, order))) for order in (6, 9)]
    assert met[0] >= 16
    assert met[1] < len(trees(9))


@pytest.mark.parametrize(
    ("name", "stage", "place"),
    [("verner98", 13, 9), ("prince_dormand87", 9, 4), ("feagin10", 14, 11), ("feagin12", 20, 15), ("ssprk104", 6, 2)],
)
def test_a_slip_in_one_coefficient_is_found(name: str, stage: int, place: int) -> None:
    method = table(name)
    rows = [list(row) for row in method.matrix]
    rows[stage][place] = rows[stage][place] + Q(1, 10**12)
    assert order_of_tableau(replace(method, a=tuple(map(tuple, rows)))) < method.order


def test_printed_decimals_have_their_order_to_what_they_declare_and_no_better() -> None:
    method = table("feagin10")
    assert order_of_tableau(replace(method, residual=Q("1e-59"))) < 10
    assert order_of_tableau(replace(method, residual=Q("1e-9"))) == 10
    with pytest.raises(ValueError, match=r"feagin10: the weights b sum to .*; a sum of 1 is accepted"):
        replace(method, residual=Q(0))


def test_a_residual_among_the_conditions_own_widths_is_not_decided() -> None:
    method = table("feagin10")
    with pytest.raises(PrecisionError, match="too wide to decide"):
        order_of_tableau(replace(method, residual=Q("1e-58")))


def test_what_decimals_miss_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    from compare.__main__ import main

    assert main(["show", "rk108"]) == 0
    shown = capsys.readouterr().out
    assert "order conditions missed by at most  1e-56" in shown
    assert "a[3,2] = 1.45453440217827322805250021715664459117622483736537873607016" in shown


def digest(method: Tableau) -> list[arb]:
    """The sums of (i + 1) (j + 2) a_ij, of (j + 1) b_j and of (j + 1) times the embedded weights, i and j from 0."""
    entries = [(i + 1) * (j + 2) * enclose(x) for i, row in enumerate(method.matrix) for j, x in enumerate(row)]
    weights = (method.b, *(other.b for other in method.embedded))
    return [sum(entries, arb(0)), *(sum(((j + 1) * enclose(x) for j, x in enumerate(b)), arb(0)) for b in weights)]


PRINTED_ELSEWHERE = {
    "verner65": (
        "969.000181665054127148289915358",
        "173.135737855019582247170314515",
        "3.79115538634044959653102113930",
    ),
    "verner76": (
        "5.91179331758126483049331719330",
        "5.13638718152328128515904483848",
        "5.33269497043083569771211667100",
    ),
    "verner87": (
        "16243.3719176820411124635005282",
        "36.2115110086046545685566790120",
        "-22.3844555856663298625519886913",
    ),
    "verner98": (
        "-1473.33171584973380284597235317",
        "12.6553090935451281058582852968",
        "2.80137151546544809658259348035",
    ),
    "feagin10": ("-168.307065609917630061872500944", "8.96"),
    "feagin12": ("-2183.11614606139305013486914806", "10.3558035714285714285714285714"),
    "feagin14": ("6955.23214324012458336970231784", "14.3872767857142857142857142857"),
}
"""Of the 40 digits of Verner's that rklib of J. Williams has, and of Feagin's in DiffEqDevTools.jl, 85 digits."""


@pytest.mark.parametrize("name", PRINTED_ELSEWHERE)
def test_the_coefficients_are_those_of_other_codes(name: str) -> None:
    with ctx.workprec(300):
        for found, printed in zip(digest(table(name)), PRINTED_ELSEWHERE[name], strict=False):
            assert abs(found - enclose(Q(printed))) < 1e-24


def test_ralstons_decimals_are_those_of_his_square_roots() -> None:
    method = table("ralston4")
    found = [float(enclose(x)) for x in (*method.a[2], *method.a[3], *method.b)]
    printed = "0.29697761 0.15875964 0.21810040 -3.05096516 3.83286476 0.17476028 -0.55148066 1.20553560 0.17118478"
    assert found == pytest.approx([float(word) for word in printed.split()], abs=1.3e-8)


PRINCE_DORMAND_PRINTED = {
 (7, 5): "545815736/2771057229", (9, 3): "-37695042795/15268766246",
    (10, 6): "-48777925059/3047939560", (10, 9): "3065993473/597172653", (11, 7): "5232866602/850066563",
    (12, 10): "248638103/1413531060",
}  # fmt: skip


def test_the_fractions_that_prince_and_dormand_print_are_near() -> None:
    method = table("prince_dormand87")
    printed = "14005451/335480064 -59238493/1068277825 181606767/758867731 561292985/797845732 -1041891430/1371343529"
    weights = [Q(word) for word in printed.split()]
    assert all(abs(x - y) < 1e-17 for x, y in zip((method.b[0], *method.b[5:9]), weights, strict=True))
    assert abs(method.c[10] - Q(1201146811, 1299019798)) < 1e-17
    for (i, j), text in PRINCE_DORMAND_PRINTED.items():
        assert abs(method.matrix[i][j] - Q(text)) < 5e-17


def test_the_first_column_of_calvo_montijano_and_randez_is_what_they_print() -> None:
    method = table("calvo_montijano_randez65")
    printed = "86727015/196851553 -86860849/45628967 77759591/16096467 237564263/39280295 17572349/289262523"
    for row, word in zip(method.a[4:], printed.split(), strict=True):
        assert abs(enclose(row[0]) - enclose(Q(word))) < 2e-14


def test_ssprk54_is_optimal_the_coefficients_of_its_combinations_are_in_one_ratio() -> None:
    """alpha/beta = C in all but the first stage and the last: C is 1.508, as of Spiteri and Ruuth."""
    method = table("ssprk54")
    with ctx.workprec(200):
        a = [in_balls(row) for row in method.matrix]
        ratios = [a[2][0] / a[1][0] / a[2][1], a[3][0] / a[2][0] / a[3][2], a[4][0] / a[3][0] / a[4][3]]
        assert all(abs(ratio - ratios[0]) < 1e-40 for ratio in ratios)
        assert abs(ratios[0] - 1.508180049) < 1e-9
        assert a[1][0] * ratios[0] < 1
