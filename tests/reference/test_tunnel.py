"""The tunnel through a uniform planet: a hypocycloid, every returned bit of it, and what is known of it."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import heyoka as hy
import numpy as np
import pytest
from independent import correct_limbs, fraction
from independent_polar import BITS, number, rolled

from reference.arithmetic.namespaces import MPMATH, NUMPY, Heyoka
from reference.arithmetic.precision import mp
from reference.problems.polar.problem import PolarBrachistochrone
from reference.problems.tunnel.equations import UNIFORM_BALL
from reference.problems.tunnel.problem import Tunnel
from reference.routes.agreement import agreement

ARGUMENTS = {
    "once": [None],
    "psi": [Fraction(0), Fraction(1, 7), Fraction(3), Fraction(6), Fraction(9)],
    "height": [Fraction(0), Fraction(1, 3), Fraction(1)],
    "z": [Fraction(9, 10), Fraction(1)],
    "epsilon": [Fraction(-1), Fraction(0), Fraction(1, 10)],
    "tau": [Fraction(0), Fraction(1, 2), Fraction(3)],
    "time": [Fraction(0), Fraction(1)],
}


@pytest.mark.parametrize(
    "problem",
    [
        Tunnel(z0="1/5"),
        Tunnel(z0="0.6", r0=4, g=1),
        Tunnel(end=(0.5, "0.3"), r0=6.4e6, body="earth"),
        Tunnel(end=("0.9", 1.8)),
        Tunnel(end=(1, 1)),
    ],
    ids=repr,
)
@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_every_row_agrees_with_both_routes(problem, route):
    for row in problem.rows:
        if problem.serves(row.name):
            found = agreement(problem, row.name, ARGUMENTS[row.over], route)
            assert (found is None) == (route in dict(row.lacks))
            assert found is None or min(each.digits for each in found) >= 55, row.name


@pytest.mark.parametrize("z0", [1e-9, 1 - 1e-12])
def test_at_the_edges_the_routes_agree(z0):
    problem = Tunnel(z0=z0)
    for row, arguments in (("curve", ARGUMENTS["psi"]), ("half_angle", [None]), ("descent_time", [None])):
        found = agreement(problem, row, arguments, "quadrature")
        assert found is not None
        assert min(each.digits for each in found) >= 55


def test_every_limb_of_the_curve_is_correctly_rounded():
    rng = random.Random(1966)
    for _ in range(60):
        z0 = rng.choice([1e-6, 0.01, 0.5, 1 - 1e-9, rng.uniform(0.001, 0.999)])
        psi = rng.uniform(0.001, 6.28)
        found = Tunnel(z0=z0).along("curve", psi, limbs=3).tolist()
        with mp.workprec(BITS + 200):
            expected = rolled(Fraction(z0), Fraction(psi))
        assert found == [correct_limbs(fraction(value), 3) for value in expected]


def test_every_limb_of_the_motion_is_correctly_rounded():
    rng = random.Random(1967)
    for _ in range(60):
        z0, tau = rng.uniform(0.001, 0.999), rng.uniform(0, 2.9)
        found = Tunnel(z0=z0).state(tau, limbs=3).tolist()
        with mp.workprec(BITS + 200):
            pace = mp.sqrt(number(1 - Fraction(z0) ** 2))
            turns = mp.floor(number(Fraction(tau)) / (mp.pi * pace))
            psi = fraction(2 * (number(Fraction(tau)) / pace - turns * mp.pi))
            z, phi, _ = rolled(Fraction(z0), psi)
            # z z' = -(1 - z0^2) sin(psi)/(2 pace)
            rate = -pace * mp.sin(number(psi)) / (2 * z)
            phi += turns * mp.pi * number(1 - Fraction(z0))
        assert found == [correct_limbs(fraction(value), 3) for value in (z, rate, phi)]


def test_it_is_venezians_hypocycloid():
    """The circle of radius b = (1 - z0)/2 rolls once: 2 pi b of the surface, in pi sqrt(1 - z0^2)."""
    problem = Tunnel(z0="0.6")
    assert 2 * float(problem.certified("half_angle")) == pytest.approx(2 * math.pi * 0.2, rel=1e-15)
    assert float(problem.certified("arrival_time")) == pytest.approx(math.pi * 0.8, rel=1e-15)
    assert float(problem.certified("chord_time")) == math.pi
    earth = Tunnel(end=(1, 1), r0=6.371e6, g=9.82)
    assert float(earth.certified("z0")) == pytest.approx(1 - 1 / math.pi, rel=1e-15)
    chord = float(earth.certified("chord_time")) * float(earth.certified("time_unit"))
    assert chord / 60 == pytest.approx(42.17, abs=0.01)
    assert float(earth.certified("arrival_seconds")) < chord


def test_gravity_of_a_body_is_that_of_its_mass():
    earth = Tunnel(z0=0.5, r0=6371000, body="earth")
    assert earth.g == Fraction("3.986004e14") / 6371000**2
    of_the_thesis = Tunnel(z0=0.5, r0=6371000, body="thesis-earth")
    assert of_the_thesis.g == Fraction("6.6743e-11") * Fraction("5.9722e24") / 6371000**2
    assert earth.unit == (6371000, 6371000 / earth.g)


def test_near_the_surface_both_laws_are_the_cycloid():
    """In units of sqrt(r0/g): about a point mass sqrt(r0^3/(2 G M)) is sqrt(1/2) of it."""
    depth = Fraction(1, 10**20)
    tunnel, polar = Tunnel(z0=1 - depth), PolarBrachistochrone(z0=1 - depth)
    for row, factor in (("half_angle", 1.0), ("descent_time", math.sqrt(0.5))):
        assert float(tunnel.certified(row)) == pytest.approx(factor * float(polar.certified(row)), rel=1e-15)


def test_the_equation_of_motion_follows_from_the_energy():
    z, rate, kappa = hy.make_vars("z", "rate", "kappa")
    acceleration, turn = UNIFORM_BALL.motion(Heyoka(), z, kappa)
    energy = UNIFORM_BALL.energy(z, rate, kappa)
    along = hy.diff(energy, z) * rate + hy.diff(energy, rate) * acceleration
    speed = rate * rate + (z * turn) ** 2 - UNIFORM_BALL.speed_squared(z) - (energy - 1.0)
    points = np.random.default_rng(5).uniform(0.2, 0.9, (3, 100))
    assert np.abs(hy.cfunc([along, speed], [z, rate, kappa])(points)).max() < 1e-9
    assert np.abs(hy.cfunc([acceleration], [z, kappa])(points[:2])).min() > 1e-6


def test_the_motion_keeps_its_energy_and_starts_downward():
    problem = Tunnel(z0=0.3)
    with mp.workprec(200):
        kappa = MPMATH.number(problem.parameters["kappa"])
        for tau in (0, Fraction(1, 3), Fraction(3, 2), Fraction(9)):
            here = [mp.mpf(problem.certified("state", Fraction(tau), j).digits(60)) for j in range(3)]
            assert abs(problem.invariant(MPMATH, here, {"kappa": kappa}) - 1) < mp.mpf(10) ** -50
    z, rate, phi = problem.state("1e-3")
    assert z < 1
    assert rate < 0 < phi
    z = np.linspace(0.3, 1, 1000)
    slopes = np.gradient(problem.derivative(NUMPY, 0, (z, 0 * z, 0 * z), {"kappa": float(kappa)})[1], z)
    assert np.abs(slopes).max() <= problem.rate() ** 2


def test_the_envelope_law():
    for z0 in (0.1, 0.9):
        problem = Tunnel(z0=z0)
        assert float(problem.certified("dhalf_angle_dz0")) == -math.pi / 2
        expected = -math.pi / 2 * z0 / math.sqrt(1 - z0**2)
        assert float(problem.certified("ddescent_time_dz0")) == pytest.approx(expected, rel=1e-14)
        with mp.workprec(200):
            form = problem.closed_form(MPMATH)
            assert mp.almosteq(form.ddescent_time_dz0, mp.sqrt(form.kappa) * form.dhalf_angle_dz0, 1e-50)


def test_what_is_rational_is_exact():
    problem = Tunnel(z0="3/5", r0=4, g=1)
    assert problem.certified("time_unit").limbs(3) == (2, 0, 0)
    psi = 1 + Fraction(1, 2**52)
    tau = Fraction(2, 5) * psi
    assert problem.certified("curve", psi, 2).limbs(3) == tuple(correct_limbs(tau, 3))
    assert problem.certified("si_curve", 5 * psi, 1).limbs(3) == (float(4 * psi), 0, 0)
    assert problem.along("curve", 0).tolist() == [1, 0, 0]
    assert problem.along("si_curve", 0).tolist() == [4, 0]
    assert Tunnel(z0="1/2", r0=4, g=1).along("si_curve", 1)[1] == pytest.approx(math.sqrt(3) / 2, rel=1e-15)
    assert problem.along("by_height", "1/3")[0] == 11 / 15
    assert Tunnel(end=(1, 1)).certified("half_angle").limbs(3) == (0.5, 0, 0)


@pytest.mark.parametrize("problem", [Tunnel(z0=0.1), Tunnel(end=("0.3", 1), r0="1/7", g=3)])
def test_a_problem_reads_back_from_its_repr(problem):
    assert eval(repr(problem)) == problem  # noqa: S307 - our own text
    assert problem.neighbour(lambda x: x, Fraction(0)).z0 > problem.z0 if problem.z0 else True


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({}, "either z0, the lowest point, or end"),
        ({"z0": 1}, "z0 is 1"),
        ({"z0": 0.5, "r0": 1}, "both or neither"),
        ({"z0": 0.5, "body": "earth"}, "both or neither"),
        ({"z0": 0.5, "r0": 1, "g": 0}, r"g is 0\.0; a positive number"),
        ({"z0": 0.5, "r0": 0, "body": "earth"}, r"r0 is 0\.0; a positive number"),
        ({"z0": 0.5, "r0": 1, "g": 1, "body": "earth"}, "instead of g"),
    ],
)
def test_what_is_no_tunnel_is_refused(arguments, told):
    with pytest.raises(ValueError, match=told):
        Tunnel(**arguments)
