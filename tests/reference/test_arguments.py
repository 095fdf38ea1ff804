"""Every row of every family: which arguments it takes, however they are spelt, and one sentence for any other."""

import datetime as dt
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import reference
from reference import (
    Certified,
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
from reference.arithmetic.limbs import MAX_DIGITS, MAX_LIMBS, WorkBoundError
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.families import FAMILIES
from reference.problems.pendulum.approximations import LindstedtMotion, PendulumSeries
from reference.problems.polar.paths import PolarByPsi, PolarByZ

HALF = Fraction(1, 2)
PROBLEMS = (
    Pendulum(1.0),
    Pendulum(0.5, omega0=-1),
    Pendulum(0, omega0=7),
    Pendulum(0, 1, 1, 2),
    Pendulum(0, omega0=0),
    LinearPendulum(1, omega0=2),
    PendulumSeries(1),
    LindstedtMotion(1),
    Cycloid(2, 1),
    CycloidArc(1),
    Tautochrone(1),
    CycloidalPendulum(1),
    Descent("line"),
    Descent("quartic", released="1/4"),
    Descent("-x**2 - x", start=0, end=1),
    PolarBrachistochrone(z0=0.25),
    PolarBrachistochrone(z0="1/4", r0=7e6, body="earth"),
    PolarBrachistochrone(end=(0.75, 1), r0=1, gm=1),
    Tunnel(z0=0.25, r0=1, g=1),
    Tunnel(end=(0.75, 1)),
    CycloidCurve(1),
    PolarByZ(0.25),
    PolarByPsi(0.25),
)
CASES = [
    pytest.param(problem, row, id=f"{problem!r} {row.name}")
    for problem in PROBLEMS
    for row in problem.rows
    if problem.serves(row.name)
]
ALONG = [case for case in CASES if case.values[1].over != "once"]
OURS = (ValueError, TypeError, OverflowError, WorkBoundError)
HOME = Path(reference.__file__).parent
GARBAGE = {
    "empty text": "",
    "a word": "half",
    "a quotient by zero": "1/0",
    "a text of nan": "nan",
    "a long text": "9" * 10_000 + "x",
    "a text with a line break": "1\nx",
    "a huge exponent": "1e5000",
    "nan": float("nan"),
    "inf": float("inf"),
    "minus inf": np.float32("-inf"),
    "a decimal nan": Decimal("nan"),
    "a complex": 1j,
    "a complex of numpy": np.complex64(1),
    "a truth value": True,
    "a truth value of numpy": np.False_,
    "a huge integer": 10**5000,
    "a long fraction": Fraction(1, 3**9000),
    "bytes": b"0.5",
    "a bytearray": bytearray(b"1"),
    "a path": Path("0.5"),
    "a mapping": {0.5: 1},
    "a set": {0.5},
    "an object": object(),
    "a function": len,
    "a date": dt.datetime(2000, 1, 1, tzinfo=dt.UTC),
    "a date of numpy": np.datetime64("2000-01-01"),
    "a span of numpy": np.timedelta64(1, "s"),
    "the masked element": np.ma.masked,
    "a masked array": np.ma.array([0.5, 0.25], mask=[True, False]),
    "an array of dates": np.array(["2000-01-01"], dtype="datetime64[D]"),
    "an array of truth values": np.array([True]),
    "an array of bytes": np.array([b"1"]),
    "an array of records": np.zeros(2, dtype=[("t", float)]),
    "an array of objects": np.array([0.5, None], dtype=object),
    "an array of lists": np.array([[0.5], None], dtype=object),
    "an empty list": [],
    "a ragged list": [0.5, [0.5]],
    "a list of None": [None],
    "a deep list": __import__("functools").reduce(lambda inner, _: [inner], range(5000), 0.5),
}
NO_SCALARS = {"a list": [0.5, 0.25], "a tuple": (0.5,), "an array": np.array([0.5, 0.25]), "a range": range(2)}
COUNTS = [0, -1, 1.5, "2", None, True, 10**9, 10**5000, b"1", [1], np.array([1, 2]), float("nan"), 1j]


def refused(call, *words):
    """The call ends in one sentence of the reference's own, raised by itself."""
    with pytest.raises(OURS) as caught:
        call()
    said = str(caught.value)
    assert said.endswith("."), said
    assert said.isprintable(), said
    assert len(said) < 600, said
    assert Path(caught.traceback[-1].path).is_relative_to(HOME), caught.traceback[-1]
    for word in words:
        assert word in said, said


def looped():
    """A list that holds itself."""
    inner = []
    inner.append(inner)
    return inner


@pytest.mark.parametrize(("problem", "row"), CASES)
def test_no_row_takes_what_is_no_number(problem, row):
    for value in [*GARBAGE.values(), looped()]:
        refused(lambda value=value: problem.certified(row.name, value))
        refused(lambda value=value: problem.along(row.name, value))
    for value in NO_SCALARS.values():
        refused(lambda value=value: problem.certified(row.name, value))


@pytest.mark.parametrize(("problem", "row"), CASES)
def test_no_row_has_a_component_or_a_count_that_is_none(problem, row):
    argument = inside(row)
    last = len(row.quantities) - 1
    for component in [*COUNTS[1:], len(row.quantities)]:
        refused(
            lambda component=component: problem.certified(row.name, argument, component),
            f"an integer from 0 to {last} (",
            row.quantities[last].name,
        )
    for limbs in COUNTS:
        refused(lambda limbs=limbs: problem.along(row.name, argument, limbs), "accepted")
    value = problem.certified(row.name, argument)
    for count in COUNTS:
        refused(lambda count=count: value.limbs(count), "accepted")
        refused(lambda count=count: value.digits(count), "accepted")
    refused(lambda: value.limbs(10**9), f"at most {MAX_LIMBS} are accepted")
    refused(lambda: value.digits(10**9), f"at most {MAX_DIGITS} are accepted")
    for places in COUNTS[1:]:
        refused(lambda places=places: value.fixed(places), f"an integer from 0 to {MAX_DIGITS}")


def inside(row):
    """An argument that the row takes."""
    if row.over in {"once", "index"}:
        return None if row.over == "once" else 2
    return Fraction(7, 8) if row.over == "z" else HALF


@pytest.mark.parametrize(("problem", "row"), CASES)
def test_an_argument_may_be_spelt_in_any_way(problem, row):
    if row.over == "once":
        assert problem.along(row.name, None).shape == (len(row.quantities),)
        return
    number = inside(row)
    plain = float(number)
    spelt = [
        plain,
        str(plain),
        f"{2 * Fraction(number).numerator}/{2 * Fraction(number).denominator}",
        Decimal(plain),
        np.float64(plain),
        np.float32(plain),
    ]
    spelt += [number, np.array(plain), np.array(str(plain)), np.longdouble(plain), f" {plain} "]
    spelt += [np.int8(2), 2] if row.over == "index" else []
    for each in spelt:
        found = problem.certified(row.name, each)
        assert (found.argument, type(found.argument)) == (number, type(number))
    first = float(problem.certified(row.name, number))
    found = problem.along(row.name, [[plain, str(plain)]])
    assert found.shape == (1, 2, len(row.quantities))
    assert found[0, :, 0].tolist() == [first, first]


@pytest.mark.parametrize(("problem", "row"), CASES)
def test_a_row_takes_no_argument_outside_of_its_domain(problem, row):
    outside = {
        "once": [0, 0.5, "1/3", [1]],
        "index": [-1, -3, 0.5, 1.5, "1/3", "-1", -1e-9, Fraction(7, 2)],
        "fraction": [-1, "-1e-9", 1.0000001, 2, "4/3"],
        "arc_fraction": [-1, "-1e-9", 1.0000001, 2],
        "epsilon": [-2, 2, "1.0000001"],
        "height": [-1, "-1e-9", 3],
        "depth": [-1, "-1e-9", 1, 0.7500001],
        "z": [0, -1, 1.0000001, 0.01, 2],
    }.get(row.over, [])
    if row.over == "time" and isinstance(problem, Descent):
        outside = [-1, "-1e-9", 100, "1e30", float(problem.descent_time()) * (1 + 1e-12)]
    for value in outside:
        refused(lambda value=value: problem.certified(row.name, value), "accepted")
        refused(lambda value=value: problem.along(row.name, value), "accepted")
        refused(lambda value=value: problem.along(row.name, [value]), "accepted")
        refused(lambda value=value: problem.values(row.name, [value], 1), "accepted")
        refused(lambda value=value: Certified(problem, row.name, value), "accepted")
        for route in ("taylor", "quadrature"):
            refused(lambda value=value, route=route: problem.by_route(route, row.name, [value], 50), "accepted")
    taken = row.domain.contains if row.over != "once" else None
    assert taken is None or taken(Fraction(inside(row)))


def test_the_rows_over_an_index_say_what_an_index_is():
    pendulum = Pendulum(1.0)
    for asked, told in (([0.5], "0.5"), ([-3], "-3"), (["1/3"], "1/3"), ([2, 1.5], "1.5")):
        with pytest.raises(ValueError, match=rf"^index is {told}; an integer from 0 on is accepted\.$"):
            pendulum.along("zero_crossing", asked)
    with pytest.raises(ValueError, match=r"^index is 1\.5; an integer from 0 on is accepted\.$"):
        pendulum.certified("zero_crossing", 1.5)
    assert pendulum.along("zero_crossing", ["2"]) == pendulum.along("zero_crossing", [2.0])


def test_a_height_below_an_irrational_lowest_point_is_refused_and_one_above_it_is_not():
    for problem in (PolarBrachistochrone(end=(0.75, 1)), Tunnel(end=(0.75, 1))):
        lowest = Fraction(problem.certified("z0").digits(40))
        above, below = lowest + Fraction(1, 10**30), lowest - Fraction(1, 10**30)
        assert problem.certified("by_z", above).digits(20)
        with pytest.raises(ValueError, match=r"^z is 0\.\d+; a number from the lowest point, about 0\.\d+, to 1 is"):
            problem.certified("by_z", below)


def test_what_the_constructors_do_not_take_is_one_sentence():
    makers = {
        Pendulum: ("theta0", "g", "length", "omega0"),
        LinearPendulum: ("theta0", "g", "length", "omega0"),
        PendulumSeries: ("theta0", "g", "length"),
        LindstedtMotion: ("theta0", "g", "length", "order"),
        Cycloid: ("end_x", "end_y", "g"),
        CycloidArc: ("radius",),
        Tautochrone: ("angle", "radius", "g"),
        CycloidalPendulum: ("arc", "radius", "g"),
        Descent: ("curve", "g", "released", "to"),
        PolarBrachistochrone: ("z0", "end", "r0", "gm", "body"),
        Tunnel: ("z0", "end", "r0", "g", "body"),
    }
    for maker, names in makers.items():
        for name in names:
            good = {key: 1 for key in names if maker not in {PolarBrachistochrone, Tunnel, Descent}}
            good |= {"curve": "line"} if maker is Descent else {}
            good |= {"z0": HALF} if "z0" in names and name != "end" else {}
            for value in [*GARBAGE.values(), looped(), [0.5, 0.25, 1], {"a": 1, "b": 2}, "ab"]:
                refused(lambda maker=maker, name=name, value=value, good=good: maker(**{**good, name: value}))


def test_what_other_methods_do_not_take_is_one_sentence():
    released, cycloid, polar = Pendulum(1.0), Cycloid(2, 1), PolarBrachistochrone(z0=HALF)
    methods = (released.period_series, released.lindstedt, released.events, polar.limit)
    methods += (cycloid.neighbour_gap, cycloid.curve, released.state)
    for method in methods:
        for value in [*GARBAGE.values(), looped(), None]:
            refused(lambda method=method, value=value: method(value))


def test_numbers_of_thousands_of_digits_are_numbers():
    assert Pendulum("1e4000", omega0=0).certified("state", 1).digits(5) == "1.0000e+4000"

    with pytest.raises(OverflowError, match=r"beyond the range of a double"):
        Pendulum("1e4000", omega0=0).state(1)


CLOSED = [family for family in FAMILIES if family.has_closed_form]
FLOW = next(one for one in FAMILIES if not one.has_closed_form and any(wanted.over == "index" for wanted in one.inputs))
"""The options of all flows are made alike."""


@pytest.mark.parametrize("family", [*CLOSED, FLOW], ids=lambda family: family.name)
def test_no_option_takes_what_is_no_number(capsys, family):
    good = {
        "pendulum": {"theta0": "1", "t": "1"},
        "linear": {"theta0": "1", "t": "1"},
        "cycloid": {"end": "2,1"},
        "tautochrone": {"angle": "1"},
        "descent": {"curve": "line"},
        "polar": {"z0": "0.5"},
        "tunnel": {"z0": "0.5"},
    }.get(family.name, {"t": "1"})
    texts = ("", "--", "half", "nan", "1/0", "1e9999", "1,2,3", "\x1b[2J\n☃" + "9" * 9999)
    for option in [*(wanted.name for wanted in family.inputs), "digits"]:
        for i, text in enumerate(texts):
            words = [f"--{name}={value}" for name, value in {**good, option: text}.items()]
            code = main(["at", family.name, *words, *["--exact"][: i % 2]])
            out, err = capsys.readouterr()
            assert (code, out, err.count("\n")) == (2, "", 1), (option, text, err)
            assert err.startswith("error: ")
            assert err.endswith(".\n")
            assert err[:-1].isprintable()


def test_paths_of_bytes_are_refused(tmp_path):
    from reference.dataset.build import build
    from reference.dataset.catalogue import plan
    from reference.dataset.grids import plan_from
    from reference.dataset.verify import verify

    for path in (b"file.h5", 7, object()):
        refused(lambda path=path: reference.load(path), "the path is of type")
        refused(lambda path=path: verify(path), "the path is of type")
        refused(lambda path=path: build(plan("core"), path), "the path is of type")
    refused(lambda: plan_from(str(tmp_path / "grid.toml").encode()), "the grid file is of type bytes")
