"""Symplectic, symmetric, A-stable and L-stable: derived from the tables, and as the books say."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

import pytest
from flint import arb

from compare.methods import METHODS, find
from compare.methods.kinds.one_step import Tableau, used_stages
from compare.methods.order.algebraic import Q, enclose, root_of
from compare.methods.order.stability import Stability, stability_of_rosenbrock
from reference.arithmetic.precision import ctx

IMPLICIT = {
    # name: symplectic, symmetric, A-stable, L-stable
    "implicit_euler": (False, False, True, True),
    "trapezoid": (False, True, True, False),
    "implicit_midpoint": (True, True, True, False),
    "gauss4": (True, True, True, False),
    "gauss6": (True, True, True, False),
    "radau3": (False, False, True, True),
    "radau5": (False, False, True, True),
    "gauss8": (True, True, True, False),
    "gauss10": (True, True, True, False),
    "radau15": (False, False, False, False),
    "alexander2": (False, False, True, True),
    "alexander3": (False, False, True, True),
    "tr_bdf2": (False, False, True, True),
    "crouzeix3": (False, False, True, False),
    "crouzeix4": (False, False, True, False),
    "hairer_wanner43": (False, False, True, True),
    "kvaerno32": (False, False, True, True),
    "kvaerno43": (False, False, True, True),
    "kvaerno54": (False, False, True, True),
    "kencarp32": (False, False, True, True),
    "kencarp43": (False, False, True, True),
    "kencarp54": (False, False, True, True),
}
ROSENBROCK = {
    # name: A-stable, L-stable
    "rosenbrock23": (True, True),
    "ros3p": (True, False),
    "rodas3": (True, True),
    "rodas4": (True, True),
    "rodas4p": (True, True),
    "rodas5p": (True, True),
}


@pytest.mark.parametrize("name", IMPLICIT)
def test_properties_of_implicit_methods_are_those_of_the_books(name: str) -> None:
    method = find(name)
    stability = Stability(method.matrix, method.b)
    assert (method.symplectic, method.symmetric, stability.a_stable, stability.l_stable) == IMPLICIT[name]


@pytest.mark.parametrize("name", ROSENBROCK)
def test_the_stability_of_rosenbrock_methods_is_that_of_the_papers(name: str) -> None:
    stability = stability_of_rosenbrock(find(name))
    assert (stability.a_stable, stability.l_stable) == ROSENBROCK[name]


def test_a_gamma_of_kvaernos_that_is_not_the_root_is_not_l_stable() -> None:
    """SUNDIALS advances the pair 4(3) with the gamma of order 3, and says so: A-stable alone."""
    g = root_of((-1, 9, -18, 6), 0.4358665)
    table = Tableau("ends", 1, "none", ((Q(0), Q(0)), (1 - g, g)), (1 - g, g))
    stability = Stability(table.matrix, table.b)
    assert not stability.a_stable
    table = replace(find("alexander3"), a=(*find("alexander3").a[:2], (Q(1, 3), 1 - g - Q(1, 3), g)))
    assert not Stability(table.matrix, table.b).l_stable


def test_signs_on_the_axis_are_found_beside_zeros_of_even_multiplicity() -> None:
    """R(z) = (1 + z/2)^2/(1 - z/2)^2 stays on the unit circle; (1 + 0.51 z)/(1 - z/2) leaves it."""
    twice = Tableau("twice", 2, "none", ((Q(1, 4), Q(0)), (Q(1, 2), Q(1, 4))), (Q(1, 2), Q(1, 2)))
    assert Stability(twice.matrix, twice.b).a_stable
    assert not Stability(twice.matrix, twice.b).l_stable
    beyond = Tableau("beyond", 1, "none", ((Q(0), Q(0)), (Q(51, 101), Q(50, 101))), (Q(51, 101), Q(50, 101)))
    assert not Stability(beyond.matrix, beyond.b).a_stable


def test_the_lobatto_pair_is_symplectic_and_symmetric() -> None:
    assert find("lobatto_pair4").symplectic
    assert find("lobatto_pair4").symmetric


def test_no_explicit_method_is_a_stable_symplectic_or_symmetric() -> None:
    for method in METHODS:
        if isinstance(method, Tableau) and method.explicit:
            assert not method.symplectic
            assert not method.symmetric
    for name in ("euler", "rk4", "dormand_prince54"):
        method = find(name)
        assert not Stability(method.matrix, method.b).a_stable


def test_the_stability_function_is_what_a_step_multiplies_by() -> None:
    """On y' = z y with h = 1: R(z) = 1 + z b^T (I - z a)^-1 1."""
    method, z = find("gauss4"), -0.7
    (a, b), (c, d) = ([float(enclose(entry)) for entry in row] for row in method.matrix)
    determinant = (1 - z * a) * (1 - z * d) - z * z * b * c
    slopes = ((1 - z * d) + z * b) / determinant, ((1 - z * a) + z * c) / determinant
    stability = Stability(method.matrix, method.b)
    above, below = (
        sum(float(enclose(c)) * z**i for i, c in enumerate(polynomial))
        for polynomial in (stability.numerator, stability.denominator)
    )
    found = above / below
    assert found == pytest.approx(1 + z * sum(slopes) / 2, abs=1e-14)


def test_a_method_that_is_stable_on_a_part_of_the_axis_only_is_not_a_stable() -> None:
    """theta = 2/5 of the theta method: R(z) = (1 + 3z/5)/(1 - 2z/5)."""
    table = Tableau("theta", 1, "none", ((Q(0), Q(0)), (Q(3, 5), Q(2, 5))), (Q(3, 5), Q(2, 5)))
    assert not Stability(table.matrix, table.b).a_stable


def test_a_stage_that_serves_the_estimate_alone_is_not_evaluated() -> None:
    for name, used in {"dormand_prince54": 6, "bogacki_shampine32": 3, "fehlberg45": 5, "cash_karp54": 6}.items():
        method = find(name)
        assert len(method.used) == method.evaluations(0)[0] == used
    rk4 = find("rk4")
    assert used_stages(rk4.matrix, rk4.b) == (0, 1, 2, 3)


def test_first_stages_are_seen_to_be_last_ones() -> None:
    same = {method.name for method in METHODS if isinstance(method, Tableau) and method.fsal}
    assert same == {
        "bogacki_shampine32", "dormand_prince54", "tsitouras54", "bogacki_shampine54", "verner65",
        "calvo_montijano_randez65", "trapezoid", "tr_bdf2", "kvaerno32", "kvaerno43", "kvaerno54", "kencarp32",
        "kencarp43", "kencarp54",
    }  # fmt: skip
    assert find("verlet").fsal
    assert not find("position_verlet").fsal


def test_the_nodes_of_gauss_are_the_roots_of_legendres_polynomial() -> None:
    with ctx.workprec(200):
        low, middle, high = (enclose(node) for node in find("gauss6").c)
        assert ((2 * high - 1) ** 2 - arb(3) / 5).contains(0)
        assert (low + high - 1).contains(0)
        assert middle.contains(arb("0.5"))
    assert float(enclose(find("gauss4").c[0])) == pytest.approx(0.5 - sqrt(3) / 6)
