"""Every family at the command line: its names, its values, its edges, and one sentence for what it does not take."""

import json
import math
from decimal import Decimal
from fractions import Fraction

import pytest

import reference
from reference.__main__ import main
from reference.problems.families import FAMILIES

MOVING = "x y speed velocity_x velocity_y place place_rate"
PASSING = "passage_time passage_x passage_y passage_speed passage_velocity_x"
ASKED = {
    "pendulum": ("--theta0 1 --t 10", "theta omega period energy"),
    "linear": ("--theta0 1 --t 10", "theta omega period energy"),
    "cycloid": (
        "--end 2,1 --fraction 0.5 --epsilon 0.25",
        "radius end_angle descent_time arc_length chord_time chord_gap x y neighbour_gap",
    ),
    "tautochrone": ("--angle 2 --radius 1 --t 0.5", "angle angular_velocity x y descent_time period energy"),
    "descent": (
        "--curve quartic --t 0.5 --fraction 0.5",
        f"descent_time arc_length {MOVING} {PASSING}",
    ),
    "polar": (
        "--z0 0.2 --tau 1",
        "z z_rate phi kappa half_angle descent_time arrival_time chord_time chord_gap",
    ),
    "prothero-robinson": ("--lam -10 --t 0.5", "y"),
    "tunnel": (
        "--z0 0.5 --psi 1",
        "z phi tau kappa half_angle descent_time arrival_time chord_time chord_gap",
    ),
}

COMPONENTS = 3
"""A flow of more of them is like the others, and proven at length in the tests of its problem."""
FLOWS = {
    family.name: family.problem
    for family in FAMILIES
    if not family.has_closed_form and len(family.problem.space.components) <= COMPONENTS
}
ASKED |= {name: ("--t 0.125", " ".join(kind.space.components)) for name, kind in FLOWS.items()}


def test_every_family_with_a_closed_form_is_asked():
    assert {family.name for family in FAMILIES if family.has_closed_form} <= set(ASKED)


def answer(capsys, family, options):
    assert main(["at", family, *options.split(), "--format", "json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("family", ASKED)
def test_every_family_answers_with_the_names_of_the_dataset_and_agreeing_routes(capsys, family):
    options, names = ASKED[family]
    found = answer(capsys, family, f"{options} --routes --digits 30")
    routes = found.pop("routes")
    assert list(found) == names.split()
    assert all(len(Decimal(text).as_tuple().digits) == 30 for text in found.values())
    assert min(digits for by_route in routes.values() for digits in by_route.values()) >= 45
    assert all(routes.values())


@pytest.mark.parametrize("family", ASKED)
def test_every_family_shows_its_inputs_and_units_as_text(capsys, family):
    options, names = ASKED[family]
    assert main(["at", family, *options.split(), "--digits", "8"]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"{family}: ")
    for name in names.split():
        assert f"\n  {name} = " in out


def test_the_published_facts(capsys):
    times = {answer(capsys, "tautochrone", f"--angle {a} --radius 1")["descent_time"] for a in (0.001, 1, 3.14)}
    assert len(times) == 1
    assert float(times.pop()) == pytest.approx(math.pi * math.sqrt(1 / 9.81), rel=1e-15)
    swept = answer(capsys, "polar", "--z0 0.2 --exact")["half_angle"]
    assert f"{math.degrees(2 * float(swept)):.2f}" == "100.90"
    steep = answer(capsys, "polar", "--z0 1e-12")
    assert float(steep["half_angle"]) == pytest.approx(math.pi / 3, rel=1e-11)
    assert float(steep["descent_time"]) == pytest.approx(math.pi / 2, rel=1e-15)
    fall = answer(capsys, "polar", "--z0 1e-12 --r0 6.371e6 --body earth")["descent_seconds"]
    unit = math.sqrt(6.371e6**3 / (2 * 3.986004e14))
    assert float(fall) == pytest.approx(math.pi / 2 * unit, rel=1e-14)


BODIES = [
    ("earth", "398600400000000", "IAU 2015 Resolution B3"),
    ("thesis-earth", "398602544600000", "G M with G = 6.6743e-11 m3 kg-1 s-2 and M = 5.9722e24 kg"),
]


@pytest.mark.parametrize("family", ["polar", "tunnel"])
@pytest.mark.parametrize(("body", "gm", "source"), BODIES)
def test_a_body_is_shown_with_its_constant_and_the_source(capsys, family, body, gm, source):
    options = f"--z0 0.5 --r0 6.371e6 --body {body} --digits 15"
    found = answer(capsys, family, options)
    constant = found["constants"]["gm"]
    assert (constant["value"], constant["units"]) == (gm, "m3 s-2")
    assert source in constant["source"]
    seconds = math.sqrt(6.371e6**3 / (float(gm) * (2 if family == "polar" else 1)))
    assert float(found["time_unit"]) == pytest.approx(seconds, rel=1e-14)
    assert main(["at", family, *options.split()]) == 0
    out = capsys.readouterr().out
    assert f"  gm = {gm} m3 s-2 ({constant['source']})\n" in out
    assert "constants" not in answer(capsys, family, "--z0 0.5")


def test_the_earth_of_the_thesis_is_heavier_by_five_millionths():
    now, then = (reference.PolarBrachistochrone(z0=0.5, r0=7e6, body=body) for body, *_ in BODIES)
    assert float(then.gm / now.gm - 1) == pytest.approx(5.38e-6, rel=1e-3)
    assert repr(now) == "PolarBrachistochrone(z0=0.5, r0=7000000.0, body='earth')"
    assert [constant.value for constant in now.constants] == [Fraction("3.986004e14")]
    assert reference.PolarBrachistochrone(z0=0.5, r0=7e6, gm="3.986004e14") == now
    assert reference.Pendulum(1).constants == ()


def test_the_envelope_law(capsys):
    for z0 in (0.01, 0.2, 0.9):
        path = reference.PolarBrachistochrone(z0)
        by_time, by_angle, kappa = (
            Fraction(path.certified(name).digits(40)) for name in ("ddescent_time_dz0", "dhalf_angle_dz0", "kappa")
        )
        assert abs(by_time**2 / (kappa * by_angle**2) - 1) < Fraction(1, 10**38)
    del capsys


@pytest.mark.parametrize(
    ("family", "options", "name", "near"),
    [
        ("pendulum", "--theta0 3.141592653588793 --t 1", "theta", 3.141592653),
        ("pendulum", "--theta0 1e-150 --t 1", "theta", -0.99997 * 1e-150),
        ("pendulum", "--theta0 0 --omega0 6.264183905352594 --t 1", "theta", 2.9681),
        ("pendulum", "--theta0 2 --t 1073741824", "omega", None),
        ("polar", "--z0 1e-6 --tau 1", "phi", None),
        ("polar", "--z0 0.999999999", "half_angle", 1.5707962812e-9),
        ("cycloid", "--end 1e-9,1 --t 0.1", "descent_time", 0.45152364),
        ("cycloid", "--end 1,1e-9", "descent_time", 0.80029),
        ("cycloid", "--end 1e9,1", "end_angle", 2 * math.pi - 2 * math.sqrt(math.pi / 1e9)),
    ],
)
def test_the_edges_are_proven(capsys, family, options, name, near):
    found = answer(capsys, family, options)
    assert len(Decimal(found[name]).as_tuple().digits) == 50
    if near is not None:
        assert float(found[name]) == pytest.approx(near, rel=1e-3 if name == "theta" else 1e-5)


def test_numbers_are_binary64_or_as_written_in_pairs_too(capsys):
    binary = answer(capsys, "cycloid", "--end 0.1,0.3")["radius"]
    written = answer(capsys, "cycloid", "--end 0.1,3/10 --g 981/100 --exact")["radius"]
    assert binary == reference.Cycloid(0.1, 0.3).certified("radius").digits(50)
    assert written == reference.Cycloid("0.1", "0.3", "9.81").certified("radius").digits(50)
    assert binary != written


def test_a_curve_of_ones_own_is_a_formula(capsys):
    found = answer(capsys, "descent", "--curve 2*(x/pi)**4 --start pi --end 0 --t 0.5")
    assert found == answer(capsys, "descent", "--curve quartic --t 0.5")


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("cycloid", "--end"),
        ("cycloid --end 1", "two numbers with a comma"),
        ("cycloid --end 1,2,3", "two numbers with a comma"),
        ("cycloid --end 1,x", "spells no number"),
        ("cycloid --end=-1,1", "end_x is -1.0; a positive number"),
        ("cycloid --end 1,0", "end_y is 0.0; a positive number"),
        ("cycloid --end 1,1 --fraction 2", "0 <= fraction <= 1"),
        ("tautochrone --angle 3.2", "0 < |angle| < pi"),
        ("tautochrone --angle 1 --radius 0", "radius is 0.0"),
        ("descent --curve quartik", "perhaps quartic"),
        ("descent --curve quartic --t 5", "descent time"),
        ("descent --curve x**2 --start 0 --end 1", "start"),
        ("descent --curve import(x) --start 1 --end 0", "import"),
        ("polar", "z0"),
        ("polar --z0 1.5", "0 < z0 < 1"),
        ("polar --z0 0.5 --end 1,1", "either z0"),
        ("polar --end 1,2.2", "2 pi/3"),
        ("polar --z0 0.2 --tau 1 --psi 1", "--tau and --psi both give z; one of them is accepted"),
        ("polar --z0 0.2 --t 1", "--t asks for nothing that PolarBrachistochrone(z0=0.2) has"),
        ("polar --z0 0.2 --r0 1e6 --body mars", "earth"),
        ("tunnel --end 1,3.2", "pi"),
    ],
)
def test_what_a_family_does_not_take_is_one_sentence(capsys, command, words):
    assert main(["at", *command.split(" ")]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith("error: ")
    assert words in err
