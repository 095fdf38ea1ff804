"""Verdicts that hang on more than one step, on what f gives, and on how an inner iteration ends."""

import numpy as np
import pytest

import compare


def _midpoint(tolerance):
    def midpoint(f, y, h):
        k = f(y)
        for _ in range(200):
            before, k = k, f(y + h / 2 * k)
            if np.max(np.abs(k - before)) < tolerance:
                break
        return y + h * k

    return midpoint


def _rk4(f, y, h):
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def _grid(first, step):
    """A whole integrator whose first step is one method's, and whose others are another's."""

    def integrate(f, y0, t):
        states = [np.array(y0)]
        for i, h in enumerate(np.diff(t)):
            states.append((step if i else first)(f, states[-1], h))
        return np.array(states)

    return integrate


def _verlet(f, y, h):
    half = y[1] + h / 2 * f(y)[1]
    q = y[0] + h * half
    return np.array([q, half + h / 2 * f(np.array([q, half]))[1]])


def test_a_whole_integrator_is_not_symplectic_by_its_first_step():
    found = compare.check(_grid(_midpoint(1e-14), _rk4), symplectic=True, form="integrator")
    assert found.claims_hold is False
    assert "claims to be symplectic, not symplectic" in found.verdict


def test_a_whole_integrator_of_symplectic_steps_is_symplectic():
    found = compare.check(_grid(_verlet, _verlet), order=2, symplectic=True, reversible=True, form="integrator")
    assert found.claims_hold is True
    assert found.symplecticity_defect < 1e-12


def _built_in(z):
    return np.array([z[1], -9.81 * np.sin(z[0])])


def _in_vain(f, y, h):
    return _rk4(_built_in, y, h) + 0 * f(y)


@pytest.mark.parametrize("step", [_in_vain, _grid(_in_vain, _in_vain)])
def test_a_motion_that_is_built_in_fails_though_f_is_called(step):
    found = compare.check(step, order=4)
    assert (found.claims_hold, found.consistent) == (False, False)
    assert "not consistent: it makes no use of f, and moves the same way whatever f is" in found.verdict


def test_a_step_that_gives_no_number_where_it_is_short_is_one_sentence():
    def lost_near_the_start(f, y, h):
        after = _rk4(f, y, h)
        return after if after[0] < 0.99 else after * np.nan

    with pytest.raises(ValueError, match=r"gives no finite states with steps of h = \S+, though it does with longer"):
        compare.check(lost_near_the_start, order=4)


@pytest.mark.parametrize("tolerance", [1e-7, 1e-8, 1e-9])
def test_the_tolerance_of_an_inner_iteration_is_no_fault_of_a_symplectic_method(tolerance):
    found = compare.check(_midpoint(tolerance), order=2, symplectic=True, reversible=True)
    assert found.claims_hold is True
    assert "symplectic to the tolerance of its inner iteration" in found.verdict
