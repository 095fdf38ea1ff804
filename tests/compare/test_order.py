"""Every table has by algebra the order that it declares, and a slip in it is found."""

from __future__ import annotations

from dataclasses import replace

import pytest

from compare.methods import METHODS, find
from compare.methods.compositions import KAHAN_LI6
from compare.methods.explicit import RK4
from compare.methods.kinds.nystrom import RungeKuttaNystrom
from compare.methods.kinds.one_step import Method, Splitting, Tableau, compose
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.nystrom import NYSTROM
from compare.methods.order.algebraic import PROOF_BITS, Q, provable, vanishes
from compare.methods.order.certified_roots import Linear
from compare.methods.order.conditions import (
    generalised_order,
    order_by_assumptions,
    order_of_nystrom,
    order_of_rosenbrock,
    order_of_splitting,
    order_of_tableau,
    proven_order,
)
from compare.methods.order.nystrom_trees import nystrom_density, nystrom_trees
from compare.methods.order.refined import jump
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from compare.methods.runge_kutta_nystrom import RUNGE_KUTTA_NYSTROM
from compare.methods.symmetric import SYMMETRIC
from compare.methods.symplectic import VERLET, triple_jump
from reference.arithmetic.precision import ctx

KINDS = (Tableau, Splitting, Partitioned, RungeKuttaNystrom, Rosenbrock)
TABLES = [method for method in METHODS if isinstance(method, KINDS)]


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
        "bogacki_shampine54": (4,),
        "calvo_montijano_randez65": (5,),
        "fehlberg78": (8,),
        "dop853": (5, 3),
        "verner65": (5,),
        "verner76": (6,),
        "verner87": (7,),
        "verner98": (8,),
        "prince_dormand87": (7,),
        "feagin10": (8,),
        "feagin12": (10,),
        "feagin14": (12,),
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
    for method in (*NYSTROM, *SYMMETRIC):
        anywhere = order_of_splitting(replace(method, nystrom=False))
        assert (anywhere < method.order) == (method.name in needing)


@pytest.mark.parametrize("method", RUNGE_KUTTA_NYSTROM, ids=lambda method: method.name)
def test_embedded_weights_of_nystroms_pairs_have_the_order_that_they_declare(method: RungeKuttaNystrom) -> None:
    assert [order_of_nystrom(method, other) for other in method.embedded] == [other.order for other in method.embedded]


def test_nystroms_trees_are_those_of_the_books() -> None:
    """Hairer, Norsett and Wanner, table II.14.2, and Nystrom's method of order 4 with three stages."""
    assert [len(nystrom_trees(order)) for order in range(1, 11)] == [1, 1, 2, 3, 6, 10, 20, 36, 72, 137]
    assert [nystrom_density(tree) for tree in nystrom_trees(4)] == [24, 8, 4]
    nystrom4 = RungeKuttaNystrom(
        "nystrom4", 4, "none", (Q(0), Q(1, 2), Q(1)), ((), (Q(1, 8),), (Q(0), Q(1, 2))),
        (Q(1, 6), Q(1, 3), Q(0)), (Q(1, 6), Q(2, 3), Q(1, 6)),
    )  # fmt: skip
    assert proven_order(nystrom4) == 4
    assert proven_order(replace(nystrom4, a=((), (Q(1, 8),), (Q(0), Q(1, 3))))) < 4


def test_the_fractions_of_order_twelve_with_lost_digits_are_of_order_two() -> None:
    """As they stand in OrdinaryDiffEq.jl: with a 0 for the last digit of one entry of row 14."""
    whole = next(method for method in RUNGE_KUTTA_NYSTROM if method.order == 12)
    row = list(whole.a[13])
    assert str(row[5]) == (
        "-3625720213550267723370658302114678215563058405229078125/324512095420929759624784749347170583153994213035432256"
    )
    row[5] -= Q(-5, row[5].denominator)
    assert abs(sum(row) - whole.c[13] ** 2 / 2) < Q(1, 10**52)
    assert proven_order(replace(whole, a=(*whole.a[:13], tuple(row), *whole.a[14:]))) == 2


@pytest.mark.parametrize(
    "method", [m for m in METHODS if isinstance(m, Splitting) and m.generalised], ids=lambda method: method.name
)
def test_generalised_orders_are_those_that_are_stated(method: Splitting) -> None:
    assert generalised_order(method) == method.generalised


def test_a_corrector_of_another_weight_leaves_order_two() -> None:
    corrected = find("sabac3")
    assert isinstance(corrected, Splitting)
    slipped = tuple((kind, weight * 2 if kind == "gradient" else weight) for kind, weight in corrected.flows)
    assert order_of_splitting(replace(corrected, flows=slipped)) == 2
    assert generalised_order(replace(corrected, flows=slipped)) == (6, 2)


def test_a_partitioned_method_with_its_matrices_exchanged_in_one_row_loses_order() -> None:
    pair = find("lobatto_pair4")
    assert isinstance(pair, Partitioned)
    slipped = replace(pair, hat=(pair.hat[0], pair.matrix[1], pair.hat[2]))
    assert proven_order(slipped) < 4
