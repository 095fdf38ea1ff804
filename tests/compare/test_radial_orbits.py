"""Phase and amplitude in central fields: held against the reference, against mpmath, and against the flow itself."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from flint import arb

import compare
from reference import PolarBrachistochrone, Tunnel
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx, mp
from reference.orbits import apart
from reference.problems.polar.equations import POINT_MASS
from reference.problems.polar.radial import RadialOscillation
from reference.routes import enclosure
from reference.routes.flow import Flow, System

Q = Fraction
BITS = 200
DEPTHS = [Q(1, 2), Q(1, 10), Q(1, 1000), Q(9, 10), Q(999, 1000), 1 - Q(1, 10**6)]
PROBLEMS = [kind(z0=z0) for kind in (PolarBrachistochrone, Tunnel) for z0 in DEPTHS]
TIMES = [Q(k, 7) for k in range(40)]


def exact_states(problem, times):
    """The state as points, nearer to the truth than any number of the working precision."""
    return [[value.mid() for value in state] for state in enclosure.balls(problem, "state", times, BITS + 60)]


@pytest.mark.parametrize("problem", PROBLEMS, ids=repr)
def test_the_exact_motion_has_no_error_of_phase_or_amplitude(problem):
    with ctx.workprec(BITS + problem.working_bits(TIMES)):
        known = problem.orbits()
        for t, y in zip(TIMES, exact_states(problem, TIMES), strict=True):
            phase, amplitude = apart(known.place(y), known.truth(t))
            assert abs(phase) < 1e-48
            assert abs(amplitude) < 1e-48


@pytest.mark.parametrize("shift", [Q(1, 1000), Q(-1, 3), Q(1, 10**20)])
@pytest.mark.parametrize("problem", PROBLEMS, ids=repr)
def test_a_state_of_a_later_time_is_ahead_by_that_part_of_a_period(problem, shift):
    period = 2 * float(problem.certified("descent_time"))
    shift *= Q(period)
    with ctx.workprec(BITS + problem.working_bits(TIMES)):
        known = problem.orbits()
        for t, y in zip(TIMES, exact_states(problem, [t + shift for t in TIMES]), strict=True):
            phase, amplitude = apart(known.place(y), known.truth(t))
            assert phase == pytest.approx(2 * mp.pi * float(shift) / period, rel=1e-12)
            assert abs(amplitude) < 1e-48


@pytest.mark.parametrize("z0", DEPTHS)
def test_the_period_is_twice_the_proven_time_of_descent(z0):
    problem = PolarBrachistochrone(z0=z0)
    with ctx.workprec(BITS + problem.working_bits([])):
        kappa = BALL.number(problem.parameters["kappa"])
        orbit = RadialOscillation(kappa, arb(0), BALL.number((1 - z0) / z0), arb(0))
        proven = enclosure.balls(problem, "descent_time", [None], BITS)[0][0]
        assert abs(orbit.half_period / proven - 1) < arb(10) ** -55
        assert abs(orbit.amplitude - BALL.number((1 - z0) / 2)) < arb(10) ** -55


def test_the_rate_in_w_is_that_of_the_invariant():
    """In rationals: z'^2 = (E - 1) + w - kappa w^2 (1 + w)^2, w = (1 - z)/z."""
    for kappa, z, rate in [(Q(1, 4), Q(2, 3), Q(1, 7)), (Q(7), Q(5, 4), Q(-3)), (Q(2, 9), Q(9), Q(0))]:
        energy, w = POINT_MASS.energy(z, rate, kappa), POINT_MASS.speed_squared(z)
        assert rate**2 == energy - 1 + w - kappa * w**2 * (1 + w) ** 2


def place_by_mpmath(kappa, z, rate):
    """(phase, amplitude): the turning points are roots of a quartic, and the time is an integral over their angle."""
    excess = POINT_MASS.energy(z, rate, kappa) - 1
    guesses = np.roots([float(c) for c in (excess - 1, 1, -kappa, 2 * kappa, -kappa)])
    guesses = sorted(root.real for root in guesses if root.imag == 0 < root.real)[:2]

    def height(at):
        return (excess - 1) * at**4 + at**3 - kappa * (1 - at) ** 2

    low, high = (mp.findroot(height, (guess, guess * (1 + 1e-9))) for guess in guesses)
    middle, size = (low + high) / 2, (high - low) / 2
    total, product = 1 / (1 - excess) - low - high, kappa / (1 - excess) / (low * high)  # of the other roots

    def slowness(angle):
        at = middle + size * mp.cos(angle)
        return at * at / mp.sqrt((1 - excess) * (at * at - total * at + product))

    def passed(angle):
        return mp.quad(slowness, mp.linspace(0, angle, 9))

    part = passed(mp.acos((z - middle) / size)) / (2 * passed(mp.pi))
    return mp.mpf(1) / 2 - mp.sign(rate) * part, size


def near(ball, number, digits):
    return abs(ball - arb(mp.nstr(number, 40))) < arb(10) ** -digits


def held_against_mpmath(problem, z, rate):
    """Whether a place is that of mpmath, to 25 digits."""
    kappa = problem.parameters["kappa"]
    with ctx.workprec(BITS), mp.workdps(40):
        found = problem.orbits().place([arb(z), arb(rate), arb(0)])
        phase, amplitude = place_by_mpmath(mp.mpf(kappa.numerator) / kappa.denominator, mp.mpf(z), mp.mpf(rate))
        return near(found.phase, phase, 25) and near(found.amplitude, amplitude, 25)


@pytest.mark.parametrize("z0", [Q(1, 2), Q(1, 10), Q(9, 10), Q(99, 100)])
def test_places_on_orbits_of_other_energies_are_those_of_mpmath(z0):
    random.seed(7)
    depth = float(1 - z0)
    for _ in range(5):
        z = float(z0) + depth * random.uniform(-0.05, 1.3)
        rate = random.choice([-1, 1]) * random.uniform(0.01, 0.5) * depth**0.5
        assert held_against_mpmath(PolarBrachistochrone(z0=z0), z, rate)


@pytest.mark.parametrize(
    ("z0", "z", "rate"),
    [
        (Q(1, 2), 1.3, -0.3),
        (Q(1, 2), 4.8, 0.02),
        (Q(1, 2), 20.0, -0.001),
        (Q(87, 100), 2.9, 0.01),
        (Q(87, 100), 6.0, -0.01),
        (Q(88, 100), 2.2, 0.002),
        (Q(88, 100), 2.9, -0.01),
        (Q(9, 10), 2.2, 0.001),
    ],
)
def test_far_orbits_are_placed_too_where_the_other_roots_are_complex_or_real(z0, z, rate):
    assert held_against_mpmath(PolarBrachistochrone(z0=z0), z, rate)


@pytest.mark.parametrize(
    ("problem", "z", "rate"),
    [
        (PolarBrachistochrone(z0=0.5), 0.9, -0.6),
        (PolarBrachistochrone(z0=0.9), 0.95, 0.2),
        (PolarBrachistochrone(z0=0.5), 0.7, 0.01),
        (Tunnel(z0=0.5), 0.8, 0.7),
        (Tunnel(z0=0.9), 1.1, -0.1),
    ],
)
def test_along_the_flow_from_any_state_the_phase_is_uniform_and_the_amplitude_still(problem, z, rate):
    names = problem.state_names
    start = Q(z), Q(rate), Q(0)
    times = [Q(k, 4) for k in range(8)]
    system = System(problem.derivative, names, start, problem.parameters)
    with mp.workprec(BITS), ctx.workprec(BITS):
        states = [list(map(BALL.number, state)) for state in Flow(system, BITS).at(times)]
        found = [problem.orbits().place(state) for state in states]
        steps = [later.phase - now.phase for now, later in pairwise(found)]
        steps = [step - (step - steps[0] + arb(0.5)).mid().floor() for step in steps]
        assert all(abs(step - steps[0]) < arb(10) ** -45 for step in steps)
        assert all(abs(place.amplitude - found[0].amplitude) < arb(10) ** -45 for place in found)


def test_a_tunnel_has_one_period_at_every_amplitude():
    """(z^2)'' is linear in z^2: in a quarter of a period from the middle z^2 is where it turns."""
    problem = Tunnel(z0=0.5)
    with ctx.workprec(BITS):
        known = problem.orbits()
        kappa = BALL.number(problem.parameters["kappa"])
        for energy in (arb("0.9"), arb("1.5")):
            centre = (energy + 2 * kappa) / (2 * (1 + kappa))
            size = (centre**2 - kappa / (1 + kappa)).sqrt()
            low, high = (centre - size).sqrt(), (centre + size).sqrt()
            rate = (energy - centre - kappa * (1 - centre) ** 2 / centre).sqrt()
            for z, z_rate, phase in ((centre.sqrt(), rate, 0.25), (low, arb(0), 0), (high, arb(0), 0.5)):
                found = known.place([z, z_rate, arb(0)])
                assert abs(abs(found.phase) - phase) < arb(10) ** -25
                assert abs(found.amplitude - (high - low) / 2) < arb(10) ** -50


@pytest.mark.parametrize(
    ("problem", "z", "rate"),
    [
        (PolarBrachistochrone(z0=0.5), 0.3, 1.0),  # not bound
        (PolarBrachistochrone(z0=0.5), -0.3, 0.0),
        (PolarBrachistochrone(z0=0.88), 4.0, 0.0),  # in the other well
        (PolarBrachistochrone(z0=0.9), 2.3, 0.1),  # over the hump
        (Tunnel(z0=0.5), 0.0, 0.1),
    ],
)
def test_a_state_of_another_kind_has_no_place(problem, z, rate):
    with ctx.workprec(BITS):
        assert problem.orbits().place([arb(z), arb(rate), arb(0)]) == (None, None)


def test_where_nothing_moves_there_is_no_phase():
    """z^3 = 2 kappa (1 - z) (2 - z) at the bottom of the well; in the tunnel z^4 = kappa/(1 + kappa)."""
    with ctx.workprec(BITS), mp.workprec(BITS):
        still = mp.findroot(lambda z: z**3 - (1 - z) * (2 - z) / 2, 0.6)
        assert PolarBrachistochrone(z0=0.5).orbits().place([arb(mp.nstr(still, 60)), arb(0), arb(0)]).phase is None
        assert Tunnel(z0=0.5).orbits().place([arb(0.5).sqrt(), arb(0), arb(0)]).phase is None


@pytest.mark.parametrize("problem", [PolarBrachistochrone(z0=0.5), Tunnel(z0=0.5)])
def test_numbers_from_any_code_have_a_phase_and_an_amplitude(problem):
    times = [k / 8 for k in range(1, 40)]
    late = problem.state([t + 1e-6 for t in times])
    found = compare.score(problem, times, late)
    assert found.max_phase_error == pytest.approx(2e-6 * mp.pi / (2 * float(problem.descent_time())), rel=1e-5)
    assert found.max_amplitude_error < 1e-15
    assert (found.notes, problem.lacks_of_orbits) == ((), "")
