"""Values that are exactly rational are decided exactly, in every family; and zero is +0.0."""

import json
import math
import random
from fractions import Fraction

import numpy as np
import pytest

from reference import (
    Cycloid,
    CycloidalPendulum,
    CycloidArc,
    Descent,
    LinearPendulum,
    Pendulum,
    PolarBrachistochrone,
    Tautochrone,
    Tunnel,
)
from reference.__main__ import main
from reference.arithmetic.exact import rational_root
from reference.arithmetic.limbs import exact_decimal, exact_limbs, fixed, limbs
from reference.arithmetic.precision import mp
from reference.problems.pendulum.approximations import LindstedtMotion, PendulumSeries

SPECIAL = [Fraction(k) for k in (0, 1, 2, 4, 9, 16, 25, "1/2", "1/4", "9/4", "3/5", "4/5", "5/13", "12/13", "1/3")]
SPECIAL += [Fraction(text) for text in ("1/1024", "0.1", "4.2", "8.82", "9.81")]
POSITIVE = SPECIAL[1:]
TIMES = [Fraction(text) for text in ["0", "1", "-1", "1/2", "3", "1/3", "100"]]
PARTS = [Fraction(text) for text in ["0", "1", "1/2", "1/4", "16/25", "1/3"]]
LINES = [
    ("line", None, None),
    ("-3*x/4", 0, 4),
    ("-x", 0, 1),
    ("x = 0*p; y = -p", 0, 2),
    ("x**2", 1, 0),
    ("x = p - sin(p); y = -1 + cos(p)", 0, "pi"),
    ("quarter_ellipse", None, None),
    ("cycloid", None, None),
]
R = random.Random(5)


def signed():
    return R.choice([1, -1]) * R.choice(SPECIAL)


def positive():
    return R.choice(POSITIVE)


def pendulum():
    if R.random() < 0.5:
        return Pendulum(0, positive(), positive(), signed())
    return Pendulum(R.choice([Fraction(1), Fraction(-1, 2), Fraction(7)]), positive(), positive(), signed())


def descent():
    curve, start, end = R.choice(LINES)
    return Descent(curve, positive(), start=start, end=end, released=R.choice([0, 0, Fraction(1, 4)]))


def cycloidal():
    radius = positive()
    return CycloidalPendulum(R.choice([4, -4, 1, Fraction(1, 3)]) * radius, radius, positive())


def central(of, strength):
    unit = {"r0": positive(), strength: positive()} if R.random() < 0.5 else {}
    if R.random() < 0.7:
        return of(z0=R.choice([Fraction(3, 5), Fraction(5, 13), Fraction(1, 2), Fraction("0.1")]), **unit)
    return of(end=(R.choice([Fraction(1), Fraction(1, 2)]), 1), **unit)


MAKERS = {
    "pendulum": pendulum,
    "linear": lambda: LinearPendulum(signed(), positive(), positive(), signed()),
    "series": lambda: PendulumSeries(R.choice([1, Fraction(1, 2)]), positive(), positive()),
    "lindstedt": lambda: LindstedtMotion(R.choice([1, Fraction(1, 2)]), positive(), positive(), 1),
    "cycloid": lambda: Cycloid(positive(), positive(), positive()),
    "arc": lambda: CycloidArc(positive()),
    "tautochrone": lambda: Tautochrone(R.choice([1, -1, Fraction(1, 2)]), positive(), positive()),
    "cycloidal": cycloidal,
    "descent": descent,
    "polar": lambda: central(PolarBrachistochrone, "gm"),
    "tunnel": lambda: central(Tunnel, "g"),
}


def argument(problem, row):
    """An argument that a row takes, of the places at which its values may be rational."""
    if row.over == "once":
        return None
    if row.over == "index":
        return R.choice([0, 1, 2])
    domain = problem.domain(row)
    candidates = PARTS if row.over in {"fraction", "arc_fraction", "height", "epsilon", "z"} else TIMES
    candidates = [*candidates, 2 * problem.radius] if isinstance(problem, CycloidArc) else candidates
    return R.choice([each for each in candidates if domain.contains(each)])


@pytest.mark.parametrize("family", MAKERS)
def test_every_value_at_a_special_place_is_decided_at_once(family):
    """Few-bit parameters and arguments, roots that are rational, the ends of the way; held against mpmath."""
    R.seed(f"special {family}")
    for _ in range(3 if family in {"descent", "polar", "tunnel", "arc"} else 12):
        problem = MAKERS[family]()
        for row in problem.rows:
            if not problem.serves(row.name) or row.name in {"neighbour_gap", "chord_gap", "chord_time"}:
                continue
            at = argument(problem, row)
            (at,) = problem.arguments(row.name, [at])
            rational = problem.exact_row(row.name, at)
            found = problem.values(row.name, [at], 3)[0]
            assert not np.signbit(found[found == 0]).any()
            for known, three in zip(rational or (), found.tolist(), strict=rational is not None):
                assert known is None or exact_limbs(known, 3) == tuple(three)
            if rational is not None:
                with mp.workprec(400):
                    values = problem.quadrature_form().rows(row.name, [at])[0]
                    for known, value in zip(rational, values, strict=True):
                        if known is not None:
                            truth = mp.mpf(known.numerator) / known.denominator
                            assert abs(truth - value) <= mp.mpf(10) ** -60 * (1 + abs(truth)), (problem, row.name, at)


def test_a_start_at_the_bottom_has_a_rational_energy_and_may_have_rational_moduli(capsys):
    command = "at pendulum --theta0 0 --omega0 4.2 --g 8.82 --exact --t 1 --format json"
    assert main(command.split()) == 0
    assert json.loads(capsys.readouterr().out)["energy"] == "0"
    libration = Pendulum(0, omega0="1.2")
    assert Pendulum(0, 1, 1, "1.2").certified("modulus").digits(3) == "0.600"
    assert Pendulum(0, 1, 1, "1.2").certified("modulus").limbs(3) == exact_limbs(Fraction(3, 5), 3)
    assert Pendulum(0, 1, 1, "-1.2").certified("complementary_modulus").limbs(3) == exact_limbs(Fraction(4, 5), 3)
    assert Pendulum(0, 1, 1, 4).certified("modulus").limbs(3) == (2, 0, 0)
    assert Pendulum(0, 1, 1, 1).certified("modulus").limbs(3) == (0.5, 0, 0)
    assert Pendulum(0, 1, 1, 1).certified("energy").limbs(3) == (-0.5, 0, 0)
    assert Pendulum(0, 1, 1, 2).certified("energy").limbs(3) == (1, 0, 0)
    assert libration.exact_row("modulus", None) == (None,)
    assert libration.certified("modulus").digits(20)
    assert Pendulum(1, omega0=1).exact_row("energy", None) is None


def test_a_square_of_which_the_root_is_rational():
    assert rational_root(Fraction(9, 25)) == Fraction(3, 5)
    assert rational_root(Fraction(0)) == 0
    assert rational_root(Fraction(2)) is None
    assert rational_root(Fraction(-4)) is None


def test_a_rational_value_between_two_doubles_goes_to_the_even_one():
    middle = Fraction(1) + Fraction(1, 2**53)
    assert Pendulum(0, 2 - middle, 1, 2).certified("energy").limbs(3) == (1, 2**-53, 0)
    above = 1 + 3 * Fraction(1, 2**53)
    assert Pendulum(0, 2 - above, 1, 2).certified("energy").limbs(3) == (1 + 2**-51, -(2**-53), 0)
    assert Pendulum(0, 1, 1, 2 * middle).certified("modulus").limbs(3) == (1, 2**-53, 0)
    assert Pendulum(0, 2 - Fraction(1, 8), 1, 2).certified("energy").digits(2) == "0.12"
    assert Pendulum(0, 2 - Fraction(3, 8), 1, 2).certified("energy").digits(2) == "0.38"
    assert LinearPendulum(0, omega0=1).certified("energy").fixed(0) == "0"


@pytest.mark.parametrize("zero", [0, 0.0, -0.0, "0", "-0", "-0.0", Fraction(0), np.float64(-0.0), np.int64(0)])
def test_an_integer_zero_is_a_time_and_zero_has_no_sign(zero):
    started = Pendulum(0.5, omega0=zero)
    assert started.certified("state", zero).limbs(3) == (0.5, 0, 0)
    for problem in (started, LinearPendulum(1), Tautochrone(1), Pendulum(0.5, omega0=-1), Descent("line")):
        row = problem.row("state")
        found = problem.along("state", zero, 3)
        for i in range(len(row.quantities)):
            value = problem.certified("state", zero, i)
            assert value.limbs(3) == tuple(found[i])
            assert value.digits(5).startswith("-") == (found[i][0] < 0)
        assert not np.signbit(found[found == 0]).any()
    assert started.certified("condition", zero).digits(3) == "1.00"
    assert started.along("zero_crossing", zero) == started.along("zero_crossing", [0.0])[0] > 0
    assert "-0" not in repr(started)


def test_zero_is_positive_where_a_negative_number_underflows():
    tiny = Fraction(-1, 10**400)
    assert [math.copysign(1, limb) for limb in exact_limbs(tiny, 3)] == [1, 1, 1]
    assert [math.copysign(1, limb) for limb in limbs((-1, -1, -2000), 3)] == [1, 1, 1]
    assert [math.copysign(1, limb) for limb in exact_limbs(Fraction(-1), 3)[1:]] == [1, 1]
    fallen = LinearPendulum("-1e-400")
    assert not np.signbit(fallen.state([0, 1, "1e-3"], 3)).any()
    assert fallen.certified("state", 0).digits(3) == "-1.00e-400"
    assert exact_decimal(Fraction(0), 5) == "0"
    assert fixed(tiny, 3) == "0.000"


def test_negative_zeros_at_the_command_line_are_shown_as_zero(capsys):
    assert main(["at", "pendulum", "--theta0", "0.5", "--omega0=-0.0", "--t=-0"]) == 0
    out = capsys.readouterr().out
    assert "-0" not in out.replace("e-0", "")
    assert "omega0 = 0.0 (0x0.0p+0)" in out
    assert "\n  omega = 0 rad s-1" in out
