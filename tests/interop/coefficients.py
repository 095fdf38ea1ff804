"""Coefficients of tables against those that other packages have; ``make interop`` names this file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import pytest

from compare.methods import find
from compare.methods.kinds.one_step import Tableau
from compare.methods.order.algebraic import enclose

if TYPE_CHECKING:
    from collections.abc import Callable

ROUNDED, FRACTIONS = 1e-15, 4e-14
"""Relative to 1 or to the coefficient where it is greater; fractions are printed near to what they stand for."""
Theirs: TypeAlias = "tuple[Any, list[Any]]"
"""The matrix, and every row of weights that a package has."""


def _ours(name: str) -> tuple[Any, list[Any]]:
    method = find(name)
    assert isinstance(method, Tableau)
    rows = (*method.matrix, method.b, *(other.b for other in method.embedded))
    numbers = np.array([[float(enclose(value)) for value in row] for row in rows])
    return numbers[: method.stages], list(numbers[method.stages :])


def nodepy(name: str) -> Theirs:
    from nodepy.runge_kutta_method import loadRKM

    method = loadRKM(name)
    weights = [method.b, method.bhat] if hasattr(method, "bhat") else [method.b]
    return np.array(method.A, dtype=float), [np.array(row, dtype=float) for row in weights]


def desolver(name: str) -> Theirs:
    from desolver.integrators import explicit_integration_schemes

    method = getattr(explicit_integration_schemes, name)
    b, other = np.array(method.tableau_final, dtype=float)[:, 1:]
    return np.array(method.tableau_intermediate, dtype=float)[:, 1:], [b, other, 2 * b - other]


def extensisq(name: str) -> Theirs:
    import extensisq as package

    method = getattr(package, name)
    matrix = np.zeros((8, 8))
    matrix[:7, :7], matrix[7, :7] = method.A, method.B
    return matrix, [matrix[7], matrix[7] + method.E]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    ("name", "package", "theirs", "near"),
    [
        ("ssprk104", nodepy, "SSP104", ROUNDED),
        ("ssprk54", nodepy, "SSP54", 1e-9),
        ("bogacki_shampine54", nodepy, "BS5", ROUNDED),
        ("bogacki_shampine54", extensisq, "BS5", ROUNDED),
        ("calvo_montijano_randez65", nodepy, "CMR6", FRACTIONS),
        ("prince_dormand87", nodepy, "PD8", FRACTIONS),
        ("prince_dormand87", desolver, "RK8713MSolver", FRACTIONS),
        ("feagin10", desolver, "RK108Solver", ROUNDED),
        ("feagin14", desolver, "RK1412Solver", ROUNDED),
    ],
    ids=lambda value: getattr(value, "__name__", str(value)),
)
def test_a_table_is_that_of_another_package(
    name: str, package: Callable[..., Theirs], theirs: str, near: float
) -> None:
    """What is known to differ: nodepy's SSP54 is optimal to nine digits alone, and desolver adds Feagin's estimate.

    So weights less the estimate are among those that desolver has, or those that it has turned over.
    """
    (matrix, rows), (their_matrix, their_rows) = _ours(name), package(theirs)
    assert np.allclose(matrix, their_matrix, rtol=near, atol=near)
    for row in rows:
        assert any(np.allclose(row, their_row, rtol=near, atol=near) for their_row in their_rows)
