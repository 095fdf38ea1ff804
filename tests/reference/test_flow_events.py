"""Crossings and derivatives of proven flows: against closed forms, members of wide starts, differences and sabotage."""

# ruff: noqa: ARG001, ARG002, ARG005 - equations take what they are given, and some make no use of it

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

import mpmath
import pytest
from flint import arb, arb_mat
from test_proven_flow import SYSTEMS, System, driven, henon_heiles, kepler, lorenz, van_der_pol

from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.command.at import quantities
from reference.declaration import StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem, _quotient
from reference.problems.henon_heiles import FAMILY, HenonHeiles
from reference.problems.pendulum.equations import SWING, angular_acceleration, through_the_bottom
from reference.problems.pendulum.problem import Pendulum
from reference.routes import flow_events, proven_flow
from reference.routes.flow_events import ProvenCrossings, TangencyError
from reference.routes.proven_flow import ProvenFlow

if TYPE_CHECKING:
    from collections.abc import Callable

STEPS = 4000


@pytest.fixture(autouse=True)
def _boxes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over short times errors in boxes are as good, and fast."""
    monkeypatch.setattr(proven_flow, "SIDES", 0)


PLANE = StateSpace(positions=("x",), velocities=("v",), angles=(), odd=None, along=None, scale="units", independent="")
LINE = StateSpace(positions=("x",), angles=(), odd=None, along=None, scale="units", independent="")


class Flowing(FlowProblem):
    """What the problems of these tests share."""

    invariants = ()
    t_end = 1.0
    source, difficulty = "a test", "lower"


class Swing(Flowing):
    """The pendulum, its closed form unknown."""

    name = "swing"
    space = SWING
    numbers: ClassVar = {"g": "9.81", "length": "1"}
    begins = ("1", "0")
    equation = "theta'' = -(g/length) sin(theta)"
    units: ClassVar = {"theta": "rad", "omega": "rad s-1", "g": "m s-2", "length": "m"}
    event_words = "passages through the bottom"

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return y[1], angular_acceleration(m, y[0], p["g"], p["length"])

    def event(self, m: Any, y: Any) -> Any:
        return through_the_bottom(m, y)


class Spring(Flowing):
    """x'' = -w^2 x from x = a, x' = a w: its start depends on the number by which it is derived too."""

    name = "spring"
    space = PLANE
    numbers: ClassVar = {"w": "1.5", "a": "2"}
    begins = ("a", "a*w")
    equation = "x'' = -w^2 x"

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return y[1], -(p["w"] * p["w"] * y[0])


class Clock(Flowing):
    """x' = rate."""

    name = "clock"
    space = LINE
    numbers: ClassVar = {"rate": "1", "level": "1"}
    begins = ("0",)
    equation = "x' = rate"

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return (p["rate"],)

    def event(self, m: Any, y: Any) -> Any:
        return y[0] - self.parameters_in(m)["level"]


class Touching(Spring):
    """Its event touches zero where the spring turns."""

    name = "touching"
    numbers: ClassVar = {"w": "1", "a": "1"}
    begins = ("a", "0")

    def event(self, m: Any, y: Any) -> Any:
        return y[0] + 1


class Coupled(Flowing):
    """x is alone, v follows it, and by v alone nothing else changes."""

    name = "coupled"
    space = PLANE
    numbers: ClassVar = {"c": "3"}
    begins = ("1", "1/2")
    equation = "x' = -x^2, v' = c x"

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return -y[0] * y[0], p["c"] * y[0]


LINEAR = System("linear", lambda m, t, y, p: (m.number(Fraction(1)),), ("0",), Fraction(4))
TURNING = System("turning", lambda m, t, y, p: (y[1], -y[0]), ("0", "1"), Fraction(40))


def crossings(system: Any, function: Callable[..., Any], bits: int = 128, *, vanishes: bool = False) -> ProvenCrossings:
    return ProvenCrossings(ProvenFlow(system, bits, STEPS), function, vanishes=vanishes)


@pytest.mark.parametrize(("theta0", "omega0"), [("1", None), ("0.5", "7")])
def test_crossings_of_the_pendulum_are_those_of_its_closed_form(theta0: str, omega0: str | None) -> None:
    problem = Swing(theta=theta0) if omega0 is None else Swing(theta=theta0, omega=omega0)
    known = Pendulum(theta0, "9.81", 1, omega0)
    with ctx.workprec(200):
        proven = problem.enclosure_form().rows("zero_crossing", range(3))
        for (ball,), index in zip(proven, range(3), strict=True):
            assert ball.overlaps(known.closed_form(BALL).zero_crossing(index))
            assert ball.rel_accuracy_bits() > 150
    assert problem.certified("zero_crossing", 2).limbs(3) == known.certified("zero_crossing", 2).limbs(3)
    assert problem.passages(2.0) == known.passages(2.0)


@pytest.mark.parametrize("bits", [60, 300])
def test_a_harmonic_oscillator_crosses_at_the_multiples_of_pi_and_not_at_its_start(
    bits: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(proven_flow, "SIDES", 2)
    found = crossings(TURNING, lambda m, t, y, p: y[0], bits, vanishes=True)
    assert found.count(Fraction(40)) == 12
    with ctx.workprec(400):
        for k, time in enumerate(found.times, 1):
            assert time.contains(k * arb.pi())
            assert time.rel_accuracy_bits() > bits - 25


def test_a_start_of_which_the_sign_is_not_told_is_refused_and_an_exact_zero_is_none_of_the_crossings() -> None:
    with pytest.raises(TangencyError, match=r"may both be zero at t = 0, and in 128 bits"):
        crossings(TURNING, lambda m, t, y, p: y[0]).at(0)
    bottom = Swing(theta="0", omega="1")
    assert (
        bottom.certified("zero_crossing", 0).limbs() == Pendulum(0, "9.81", 1, 1).certified("zero_crossing", 0).limbs()
    )


def test_many_crossings_in_one_piece_are_all_found() -> None:
    found = crossings(LINEAR, lambda m, t, y, p: m.sin(40 * y[0]), vanishes=True)
    assert found.count(Fraction(3)) == math.floor(120 / math.pi)
    with ctx.workprec(200):
        assert all(time.contains(k * arb.pi() / 40) for k, time in enumerate(found.times, 1))


def near(apart: int) -> Callable[..., Any]:
    """(y - 1)^2 - 4^-apart, with two zeros at 1 + 2^-apart and 1 - 2^-apart."""
    return lambda m, t, y, p: (y[0] - 1) ** 2 - m.number(Fraction(1, 4**apart))


def test_two_zeros_that_are_near_are_told_apart_where_the_bits_are_enough() -> None:
    assert crossings(LINEAR, near(40)).count(Fraction(2)) == 2
    with pytest.raises(TangencyError, match=r"t = 1,? "):
        crossings(LINEAR, near(100)).count(Fraction(2))
    found = crossings(LINEAR, near(100), 300)
    assert found.count(Fraction(2)) == 2
    with ctx.workprec(300):
        for time, exact in zip(found.times, (1 - Fraction(1, 2**100), 1 + Fraction(1, 2**100)), strict=True):
            assert time.contains(BALL.number(exact))
    assert crossings(LINEAR, lambda m, t, y, p: (y[0] - 1) ** 2 + m.number(Fraction(1, 4**40))).count(Fraction(2)) == 0


def test_a_tangency_is_refused_in_one_sentence() -> None:
    with pytest.raises(WorkBoundError, match=r"^the event of Touching\(\) and its rate .* where they are simple\.$"):
        float(Touching().certified("zero_crossing", 0))


@pytest.mark.parametrize(
    "branched", [lambda m, t, y, p: m.floor(y[0]), lambda m, t, y, p: abs(y[0]), lambda m, t, y, p: max(y[0], t)]
)
def test_an_event_that_takes_a_branch_is_refused(branched: Callable[..., Any]) -> None:
    with pytest.raises(ValueError, match="is no smooth formula"):
        crossings(LINEAR, branched)


def test_a_crossing_where_two_pieces_meet_is_found_once() -> None:
    for system in (LINEAR, *SYSTEMS[:4]):
        flow = ProvenFlow(system, 100, STEPS)
        ends = [flow.piece(place).t for place in range(1, 6)]
        for end in ends:
            found = ProvenCrossings(flow, lambda m, t, y, p, end=end: t - m.number(end))
            assert found.count(ends[-1] * 2) == 1
            assert found.times[0].contains(BALL.number(end))
    meeting = crossings(LINEAR, lambda m, t, y, p: y[0] - 1, 64)
    assert meeting.flow.piece(1).t == 1
    assert meeting.count(Fraction(3)) == 1
    assert meeting.times[0].contains(1)


def test_a_time_like_event_counts_what_is_exactly_at_the_end_as_undecided() -> None:
    assert Clock().passages(2.0) == ("zero_crossing", 1)
    assert Clock().passages(0.5) == Clock().passages(0.0) == ("zero_crossing", 0)
    with pytest.raises(
        WorkBoundError, match=r"the number of crossings of Clock\(\) up to t = 1.0 could not be decided"
    ):
        Clock().passages(1.0)
    assert Spring().passages(1.0) is None
    with pytest.raises(KeyError, match="zero_crossing"):
        Spring().certified("zero_crossing", 0)


def test_what_never_crosses_is_given_up_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flow_events, "QUIET", 10)
    with pytest.raises(WorkBoundError, match=r"crosses zero 1 times up to t = .*, and in 10 steps no more"):
        crossings(LINEAR, lambda m, t, y, p: y[0] - 1).at(1)


def section(m: Any, t: Any, y: Any, p: Any) -> Any:
    return y[1] - y[0] / 3


WIDE = (
    System("henon-heiles", henon_heiles, ("0", "0.1", "0.5", "0"), Fraction(5)),
    System("lorenz", lorenz, ("1", "2", "1"), Fraction(3, 4), {"rho": Fraction(28), "beta": Fraction(8, 3)}),
    System("kepler", kepler, ("0.5", "0", "0", "1.75"), Fraction(2)),
    System("van der pol", van_der_pol, ("2", "0"), Fraction(5)),
    System("driven", driven, ("0.2", "0"), Fraction(6)),
)


def outside(system: System, radius: Fraction, members: int = 3) -> int:
    """Crossings of members of a box of starts that are not in those of all of them."""
    wide = crossings(replace(system, radius=radius), section, 90)
    count, found = wide.count(system.end), 0
    corners = list(itertools.product((-1, 1), repeat=len(system.start)))
    for corner in corners[:: max(1, len(corners) // members)]:
        member = crossings(replace(system, radius=radius, corner=corner), section, 150)
        found += member.count(system.end) != count
        found += sum(not ball.contains(time.mid()) for ball, time in zip(wide.times, member.times, strict=False))
    return found


@pytest.mark.parametrize("system", WIDE, ids=repr)
def test_crossings_of_wide_starts_hold_those_of_their_members(system: System) -> None:
    assert outside(system, Fraction(1, 2**20)) == 0


TRUE_ENCLOSED = ProvenCrossings._enclosed
TRUE_FURTHER = ProvenCrossings._further


def backwards(self: Any, piece: Any, s: arb) -> tuple[arb, arb]:
    value, rate = TRUE_ENCLOSED(self, piece, s)
    return value, -rate


def without_errors(self: Any, piece: Any, s: arb) -> tuple[arb, arb]:
    return TRUE_ENCLOSED(self, replace(piece, errors=(arb(0),) * len(piece.errors)), s)


def without_the_slope_of_time(self: Any, piece: Any, s: arb) -> tuple[arb, arb]:
    value, rate = TRUE_ENCLOSED(self, piece, s)
    return value, rate - 1


def without_joins(self: Any) -> None:
    TRUE_FURTHER(self)
    self._run = []


def test_a_rate_of_the_wrong_sign_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ProvenCrossings, "_enclosed", backwards)
    with pytest.raises(ArithmeticError, match="changes its sign against its rate"):
        crossings(TURNING, lambda m, t, y, p: y[0] - y[1] / 2).at(0)


def test_a_rate_without_the_time_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ProvenCrossings, "_enclosed", without_the_slope_of_time)
    with pytest.raises(ArithmeticError):
        crossings(TURNING, lambda m, t, y, p: t / 2 - 1).at(0)


def test_an_error_that_is_left_out_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ProvenCrossings, "_enclosed", without_errors)
    assert outside(WIDE[3], Fraction(1, 2**20))


def at_a_join() -> bool:
    """Whether crossings on both sides of a join, of starts on both sides of 0, are held by those of all of them."""
    found = crossings(replace(LINEAR, radius=Fraction(1, 2**20)), lambda m, t, y, p: y[0] - 1, 64)
    assert found.count(Fraction(3)) == 1
    assert found.flow.piece(1).t == 1
    return all(found.times[0].contains(BALL.number(1 + Fraction(sign, 2**21))) for sign in (1, -1))


def test_a_join_that_is_left_out_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    assert at_a_join()
    monkeypatch.setattr(ProvenCrossings, "_further", without_joins)
    assert not at_a_join()


@pytest.mark.parametrize(("omega0", "sides"), [("0", 0), ("7", 4)])
def test_derivatives_of_the_pendulum_are_those_of_its_closed_form(
    omega0: str, sides: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(proven_flow, "SIDES", sides)
    problem, known = Swing(omega=omega0), Pendulum(1, "9.81", 1, omega0)
    named = {one.name: place for place, one in enumerate(known.row("gradient").quantities)}
    for by, other in (("theta", "theta0"), ("omega", "omega0"), ("g", "g"), ("length", "length")):
        for place, component in enumerate(("theta", "omega")):
            certified = problem.certified(f"sensitivity_{by}", "0.75", place)
            same = known.certified("gradient", "0.75", named[f"d{component}_d{other}"])
            assert certified.limbs() == same.limbs()
            assert certified.quantity.name == f"d{component}_d{by}"
            assert sorted(certified.quantity.units.split()) == sorted(same.quantity.units.split())


def test_derivatives_of_a_spring_are_those_of_its_formula() -> None:
    problem, t = Spring(), Fraction(7, 2)
    with mpmath.workdps(60):
        w, a, s = mpmath.mpf("1.5"), mpmath.mpf(2), mpmath.mpf("3.5")
        sine, cosine = mpmath.sin(w * s), mpmath.cos(w * s)
        by_w = (a * s * (cosine - sine), a * (cosine - sine) - a * w * s * (sine + cosine))
        by_x = (cosine, -w * sine)
        for by, exact in (("w", by_w), ("x", by_x)):
            for place, value in enumerate(exact):
                assert abs(mpmath.mpf(problem.certified(f"sensitivity_{by}", t, place).digits(50)) - value) < 1e-48
        fixed = Spring(v="3")
        assert fixed.certified("sensitivity_a", t, 1).digits(40) == mpmath.nstr(-w * sine, 40)


def test_derivatives_of_a_linear_system_are_its_exponential() -> None:
    rates = [[Fraction(-1, 2), Fraction(3)], [Fraction(-2), Fraction(1, 4)]]

    class Linear(Spring):
        name = "linear-system"
        begins = ("1", "1")

        def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
            return tuple(sum((m.number(a) * v for a, v in zip(row, y, strict=True)), 0 * y[0]) for row in rates)

    with ctx.workprec(160):
        exponential = (arb_mat([[BALL.number(a) * 2 for a in row] for row in rates])).exp()
        for j, by in enumerate(("x", "v")):
            ((*column,),) = Linear().enclosure_form().rows(f"sensitivity_{by}", [Fraction(2)])
            for i, ball in enumerate(column):
                assert ball.overlaps(exponential[i, j])
                assert ball.rel_accuracy_bits() > 120


class Lorenz(Flowing):
    """Lorenz' equations, from a start on the way to its attractor."""

    name = "lorenz"
    space = StateSpace(positions=("x", "y", "z"), angles=(), odd=None, along=None, scale="units", independent="")
    numbers: ClassVar = {"rho": "28", "beta": "8/3"}
    begins = ("1", "sqrt(rho)/5", "beta**2")
    equation = "Lorenz"

    def derivative(self, m: Any, t: Any, y: Any, p: Any) -> Any:
        return lorenz(m, t, y, p)


class Unmoved(Lorenz):
    """Its start is said not to depend on anything."""

    def start_slopes(self, m: Any, by: str, place: int | None = None) -> list[Any]:
        return [m.number(Fraction(0))] * 3


def differences(by: str, time: Fraction) -> list[arb]:
    """(y(c + h) - y(c - h))/(2 h), h = 2^-70, so that they are off by about 2^-140."""
    h = Fraction(1, 2**70)
    inputs = {**dict(zip(Lorenz.space.components, Lorenz().start, strict=True)), **Lorenz().parameters}
    with ctx.workprec(230):
        above, below = (
            Lorenz(**{by: inputs[by] + sign * h}).enclosure_form().rows("state", [time])[0] for sign in (1, -1)
        )
        return [(a - b) / (2 * BALL.number(h)) for a, b in zip(above, below, strict=True)]


def off_differences(problem: FlowProblem, by: str) -> float:
    """How far proven derivatives are from differences."""
    time = Fraction(1, 4)
    with ctx.workprec(200):
        ((*proven,),) = problem.enclosure_form().rows(f"sensitivity_{by}", [time])
        assert min(ball.rel_accuracy_bits() for ball in proven) > 130
        return max(float(abs(a - b).upper()) for a, b in zip(proven, differences(by, time), strict=True))


@pytest.mark.parametrize("by", ["rho", "x"])
def test_derivatives_are_the_limits_of_differences(by: str) -> None:
    assert off_differences(Lorenz(), by) < 1e-35


def test_a_derivative_without_that_of_the_start_is_noticed() -> None:
    assert off_differences(Unmoved(), "rho") > 1e-6


def test_the_other_route_agrees_on_crossings_and_derivatives() -> None:
    problem = Spring()
    for by in ("w", "x"):
        assert problem.certified(f"sensitivity_{by}", 2).routes["taylor"] >= 45
    for index in (0, 2):
        assert Swing().certified("zero_crossing", index).routes["taylor"] >= 45


def test_derivatives_that_are_exactly_rational_are_told() -> None:
    assert Spring().exact_row("sensitivity_w", Fraction(0)) == (0, 2)
    assert HenonHeiles().exact_row("sensitivity_energy", Fraction(0)) == (0, 0, None, 0)
    assert HenonHeiles(px="0.5").exact_row("sensitivity_energy", Fraction(3)) == (0, 0, 0, 0)
    assert Coupled().exact_row("sensitivity_v", Fraction(3)) == (0, 1)
    assert Coupled().exact_row("sensitivity_x", Fraction(3)) == (None, None)
    assert Coupled().exact_row("sensitivity_c", Fraction(3)) == (0, None)
    assert Clock().exact_row("sensitivity_level", Fraction(3)) == (0,)
    assert Clock().exact_row("sensitivity_rate", Fraction(3)) == (None,)
    assert Coupled().certified("sensitivity_c", 3).digits(20) == "0"
    assert Coupled().certified("sensitivity_c", 3, 1).digits(20) == "1.3862943611198906188"
    assert HenonHeiles().certified("sensitivity_energy", 0, 2).digits(17) == "2.0384122874775878"


def test_an_input_that_there_is_not_is_refused() -> None:
    assert Spring().sensitivity("w").state_names == ("x", "v", "dx_dw", "dv_dw")
    with pytest.raises(ValueError, match="'mass'"):
        Spring().sensitivity("mass")


def test_units_of_derivatives_are_quotients() -> None:
    assert _quotient("rad s-1", "m s-2") == "rad s m-1"
    assert _quotient("rad", "rad") == "1"
    assert _quotient("1", "s") == "s-1"


def test_the_command_line_asks_for_events_and_never_computes_derivatives_unasked() -> None:
    assert FAMILY.rows == ("state", "zero_crossing")
    (crossing,) = quantities(FAMILY, {"index": Fraction(0)})
    assert 1.0 < float(crossing) < 1.6
    with pytest.raises(ValueError, match=r"nothing is asked of HenonHeiles\(\); --t or --index is accepted"):
        quantities(FAMILY, {})
    assert [one.name for one in flow_family(Spring, "a spring").inputs] == ["w", "a", "x", "v", "t"]
