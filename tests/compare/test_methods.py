"""Every method has the order that it declares: by algebra, and by slope in binary128."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest

from compare.algebraic import Q
from compare.method import Method, Splitting, Tableau, compose
from compare.methods import METHODS, find
from compare.methods.explicit import RK4
from compare.methods.symplectic import SUZUKI4, VERLET, YOSHIDA4, triple_jump
from compare.order import order_of_splitting, order_of_tableau, trees
from compare.precision import precision
from compare.scores import Course, fit_order, score_method
from reference import Pendulum

by_name = pytest.mark.parametrize(
    "method", [method for method in METHODS if method.family != "multistep"], ids=lambda method: method.name
)
FLOAT128 = precision("float128")
COURSES = [Course(Pendulum(1.0), n, Fraction(2), FLOAT128) for n in (256, 512, 1024, 2048, 4096)]


def algebraic_order(method: Method) -> int:
    return order_of_tableau(method) if isinstance(method, Tableau) else order_of_splitting(method)


@by_name
def test_order_by_algebra_is_the_declared_one(method: Method) -> None:
    assert algebraic_order(method) == method.order


@by_name
def test_order_by_slope_in_binary128_is_the_declared_one(method: Method) -> None:
    cells, _ = score_method(method, COURSES, FLOAT128)
    fitted = fit_order(method, cells)
    assert fitted.cells_used == len(COURSES)
    assert abs(fitted.fitted_order - method.order) < 0.02


@by_name
def test_a_source_is_an_author_and_a_year(method: Method) -> None:
    author, year = re.fullmatch(r"((?:de )?[A-Z]\D+) (\d{4}), .+", method.source).groups()
    assert author
    assert 1700 < int(year) < 2030


def test_names_and_aliases_are_unique() -> None:
    names = [name for method in METHODS for name in (method.name, *method.aliases)]
    assert len(names) == len(set(names))


def test_an_alias_is_the_same_method() -> None:
    assert find("velocity_verlet") is find("verlet") is VERLET
    assert find("forest_ruth") is YOSHIDA4


def test_an_unknown_method_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="method 'yoshida' is unknown, perhaps yoshida4"):
        find("yoshida")
    with pytest.raises(ValueError, match="method '###' is unknown; accepted are euler, midpoint"):
        find("###")


def test_there_are_as_many_rooted_trees_as_cayley_counted() -> None:
    assert [len(trees(order)) for order in range(1, 10)] == [1, 1, 2, 4, 9, 20, 48, 115, 286]


def test_a_slip_in_one_coefficient_lowers_the_proven_order() -> None:
    slipped = Tableau("rk4_misprinted", 4, RK4.source, ((), (Q(1),), (Q(0), Q(1)), (Q(0), Q(0), Q(1))), RK4.b)
    assert order_of_tableau(slipped) == 1


def test_a_forest_ruth_with_a_sign_slip_is_not_of_order_four() -> None:
    weight, middle, _ = triple_jump(Q(5, 4))
    assert order_of_splitting(compose(VERLET, (weight, middle, weight), "slipped", 4, "none")) == 2


def test_a_composition_of_symmetric_steps_merges_its_kicks() -> None:
    assert [kind for kind, _ in YOSHIDA4.flows] == ["drift", "kick"] * 3 + ["drift"]
    assert YOSHIDA4.evaluations(0) == (3, 0)
    assert SUZUKI4.evaluations(0) == (5, 1)


def test_nodes_are_derived_from_the_rows() -> None:
    assert RK4.c == (0, Q(1, 2), Q(1, 2), 1)
    assert RK4.explicit
    assert not find("implicit_midpoint").explicit


def test_a_table_that_is_no_method_is_refused() -> None:
    with pytest.raises(ValueError, match="the weights b sum to 1/2"):
        Tableau("bad", 1, "none", ((),), (Q(1, 2),))
    with pytest.raises(ValueError, match="a has 2 rows and b 1"):
        Tableau("bad", 1, "none", ((), (Q(1),)), (Q(1),))
    with pytest.raises(ValueError, match="kicks sum to 2"):
        Splitting("bad", 1, "none", (("kick", Q(2)), ("drift", Q(1))))
    with pytest.raises(ValueError, match="neighbouring flows are of one kind"):
        Splitting("bad", 1, "none", (("kick", Q(1)), ("drift", Q(1, 2)), ("drift", Q(1, 2))))
