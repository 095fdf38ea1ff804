"""Every table has by algebra the order that it declares, and a slip in it is found."""

from __future__ import annotations

from dataclasses import replace

import pytest

from compare.methods import METHODS, find
from compare.methods.compositions import KAHAN_LI6
from compare.methods.explicit import RK4
from compare.methods.kinds.one_step import Method, Splitting, Tableau, compose
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.nystrom import NYSTROM
from compare.methods.order.algebraic import PROOF_BITS, Q, provable, vanishes
from compare.methods.order.certified_roots import Linear
from compare.methods.order.conditions import (
    order_by_assumptions,
    order_of_rosenbrock,
    order_of_splitting,
    order_of_tableau,
    proven_order,
)
from compare.methods.order.refined import jump
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from compare.methods.symplectic import VERLET, triple_jump
from reference.arithmetic.precision import ctx

TABLES = [method for method in METHODS if isinstance(method, (Tableau, Splitting, Partitioned, Rosenbrock))]


@pytest.mark.parametrize("method", TABLES, ids=lambda method: method.name)
def test_order_by_algebra_is_the_declared_one(method: Method) -> None:
    assert proven_order(method) == method.order


@pytest.mark.parametrize("method", [method for method in METHODS if isinstance(method, Tableau)], ids=lambda m: m.name)
def test_embedded_weights_have_the_order_that_they_declare(method: Tableau) -> None:
    for other in method.embedded:
        assert order_of_tableau(method, other.b) == other.order


def test_every_pair_has_embedded_weights() -> None:
    pairs = [method for method in METHODS if isinstance(method, Tableau) and method.embedded]
    assert {method.name: tuple(other.order for other in method.embedded) for method in pairs} == {
        "bogacki_shampine32": (2,),
        "fehlberg45": (5,),
        "cash_karp54": (4,),
        "dormand_prince54": (4,),
        "tsitouras54": (4,),
        "dop853": (5, 3),
        "gbs4": (2,),
        "gbs6": (4,),
        "gbs8": (6,),
        "gbs10": (8,),
        "gbs10_bulirsch": (8,),
        "tr_bdf2": (3,),
        "hairer_wanner43": (3,),
        "kvaerno32": (2,),
        "kvaerno43": (3,),
        "kvaerno54": (4,),
        "kencarp32": (2,),
        "kencarp43": (3,),
        "kencarp54": (4,),
    }


@pytest.mark.parametrize(
    "method", [method for method in METHODS if isinstance(method, Rosenbrock)], ids=lambda m: m.name
)
def test_embedded_weights_of_rosenbrock_methods_have_their_order(method: Rosenbrock) -> None:
    assert [order_of_rosenbrock(method, other.b) for other in method.embedded] == [e.order for e in method.embedded]
    assert method.embedded


def test_a_rosenbrock_method_without_its_jacobian_is_another_one() -> None:
    """With every gamma_ij of the slopes halved it is a W-method at best; a slip in one entry of c is seen as well."""
    rodas = find("rodas3")
    assert order_of_rosenbrock(replace(rodas, gamma=Q(1, 4))) < rodas.order
    assert order_of_rosenbrock(replace(rodas, c=(*rodas.c[:3], (Q(1), Q(1), Q(-8, 3))))) < rodas.order


@pytest.mark.parametrize(
    "name", ["gauss4", "gauss6", "gauss8", "radau5", "trapezoid", "alexander2", "euler", "midpoint"]
)
def test_simplifying_assumptions_and_trees_prove_the_same_order(name: str) -> None:
    method = find(name)
    with ctx.workprec(PROOF_BITS):
        values = provable([*method.b, *(entry for row in method.matrix for entry in row)])
        size = method.stages
        rows = [values[size * i : size * (i + 1)] for i in range(1, size + 1)]
        assert order_by_assumptions(rows, values[:size]) in {None, method.order}
        trees_of = ElementaryWeights(rows)
        missed = [
            any(not vanishes(trees_of.weight(values[:size], tree) * density(tree) - 1) for tree in trees(order))
            for order in range(1, method.order + 2)
        ]
    assert missed == [False] * method.order + [True]


def test_assumptions_leave_open_what_they_do_not_decide() -> None:
    """RK4 has stage order 1, which is not enough for order 4; the weights alone would be."""
    rk4 = find("rk4")
    assert order_by_assumptions(rk4.matrix, rk4.b) in {None, 4}
    slipped = replace(find("gauss4"), a=((Q(1, 4), Q(0)), (Q(1, 2), Q(1, 4))))
    assert order_of_tableau(slipped) < 4


def test_there_are_as_many_rooted_trees_as_cayley_counted() -> None:
    assert [len(trees(order)) for order in range(1, 10)] == [1, 1, 2, 4, 9, 20, 48, 115, 286]
    assert [len(trees(order, 2)) for order in range(1, 6)] == [2, 4, 14, 52, 214]


def test_a_slip_in_one_coefficient_lowers_the_proven_order() -> None:
    slipped = replace(RK4, a=((), (Q(1, 2),), (Q(0), Q(1, 2)), (Q(0), Q(0), Q(-1))))
    assert order_of_tableau(slipped) == 1
    assert order_of_tableau(find("rk4_misprinted")) == 1


def test_a_forest_ruth_with_a_sign_slip_is_not_of_order_four() -> None:
    weight, middle, _ = triple_jump(Q(5, 4))
    assert order_of_splitting(compose(VERLET, (weight, middle, weight), "slipped", 4, "none")) == 2


def test_the_printed_decimals_alone_do_not_have_the_order() -> None:
    """What is printed of Kahan and Li's weights is of order 2: the conditions are missed by 1e-26, and that is seen."""
    (zero,) = {weight.zero for _, weight in KAHAN_LI6.flows if isinstance(weight, Linear)}
    first, *others = map(Q, zero.printed)
    weights = jump(first, Q("0.33259913678935943859974864"), *others)
    printed = compose(VERLET, weights, "printed", 6, "none")
    assert order_of_splitting(printed) == 2
    assert order_of_splitting(KAHAN_LI6) == 6


@pytest.mark.parametrize(("name", "order"), [("mclachlan_atela4", 3), ("blanes_moan_srkn11b", 4)])
def test_a_method_of_nystroms_kind_has_a_lower_order_elsewhere(name: str, order: int) -> None:
    method = find(name)
    assert method.nystrom
    assert order_of_splitting(replace(method, nystrom=False)) == order


def test_only_what_needs_linear_velocities_says_so() -> None:
    needing = {method.name for method in METHODS if isinstance(method, Splitting) and method.nystrom}
    for method in NYSTROM:
        anywhere = order_of_splitting(replace(method, nystrom=False))
        assert (anywhere < method.order) == (method.name in needing)


def test_a_partitioned_method_with_its_matrices_exchanged_in_one_row_loses_order() -> None:
    pair = find("lobatto_pair4")
    assert isinstance(pair, Partitioned)
    slipped = replace(pair, hat=(pair.hat[0], pair.matrix[1], pair.hat[2]))
    assert proven_order(slipped) < 4
