"""Claims about an integrator as assertions of a test: nothing where they hold, else an AssertionError that says why.

    def test_my_method():
        compare.assert_order(my_package.rk4, 4)

What a claim rests on, and what ``how`` may be, is that of ``compare.check``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.claims.checking import check

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.claims.record import Check

__all__ = [
    "assert_conserves",
    "assert_dense",
    "assert_estimate",
    "assert_order",
    "assert_reversible",
    "assert_stiff_order",
    "assert_symplectic",
    "assert_tolerance",
]


def assert_order(step: Callable[..., Any], order: float, **how: Any) -> Check:
    """Return the check of a step whose order is at least the one that is claimed, whether the time enters or not.

    Raises:
        AssertionError: it is not, or that is not established.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, order=order, **how))


def assert_symplectic(step: Callable[..., Any], **how: Any) -> Check:
    """Return the check of a step that keeps the symplectic form.

    Raises:
        AssertionError: it does not, or that is not established, as where the problem has no momenta.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, symplectic=True, **how))


def assert_reversible(step: Callable[..., Any], **how: Any) -> Check:
    """Return the check of a step that leads back to where it came from with the velocities turned round.

    Raises:
        AssertionError: it does not, or that is not established, as where the problem has no way back in time.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, reversible=True, **how))


def assert_conserves(step: Callable[..., Any], **how: Any) -> Check:
    """Return the check of a step that keeps every invariant of the problem, bounded or to rounding, over a long march.

    Raises:
        AssertionError: one drifts or is lost, or that is not established, as where none is declared.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, conserves=True, **how))


def assert_dense(step: Callable[..., Any], order: float, interpolant: Callable[..., Any], **how: Any) -> Check:
    """Return the check of a step whose interpolant (f, y, h, theta) is of an order: it errs by O(h^(order + 1)).

    Raises:
        AssertionError: it is not, or that is not established.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, dense=order, interpolant=interpolant, **how))


def assert_estimate(step: Callable[..., Any], order: float, **how: Any) -> Check:
    """Return the check of a step that gives (y, error), the error being that of an embedded method of an order.

    Raises:
        AssertionError: it is not, or that is not established.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, estimate=order, **how))


def assert_tolerance(integrate: Callable[..., Any], power: float = 1, **how: Any) -> Check:
    """Return the check of an integrator whose error goes with a power of its relative tolerance.

    Raises:
        AssertionError: it does not, or that is not established.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(integrate, tolerance=power, **how))


def assert_stiff_order(step: Callable[..., Any], order: float, **how: Any) -> Check:
    """Return the check of a step of which an order is left on Prothero and Robinson's stiff equation.

    Raises:
        AssertionError: it is not, or that is not established.
        TypeError, ValueError: as ``compare.check``.
    """
    return _held(check(step, stiff=order, **how))


def _held(found: Check) -> Check:
    found.assert_holds()
    return found
