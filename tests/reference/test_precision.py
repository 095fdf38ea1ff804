"""Working precision: one lock, put back as it was, and bounds that hold whatever other code does to the contexts."""

from __future__ import annotations

import ast
import os
import sys
import threading
import warnings
from fractions import Fraction
from functools import cache, partial
from pathlib import Path

import flint
import mpmath
import numpy as np
import pytest
from flint import arb, arb_series

from reference import Cycloid, CycloidalPendulum, Descent, Pendulum, PolarBrachistochrone, Tautochrone, Tunnel
from reference.arithmetic.balls import SERIES
from reference.arithmetic.elliptic import BallElliptic, sine_polynomial
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import PrecisionError, ctx, held, mp
from reference.once import cached_property
from reference.problems.descent.clock import Primitive, clock

ROOT = Path(__file__).parents[2]
SOURCES = sorted(path for package in ("reference", "compare") for path in (ROOT / package).rglob("*.py"))
OWNERS = {"flint": "ctx", "mpmath": "mp"}
"""By package, the context that only one module may name."""


def in_force():
    return flint.ctx.prec, flint.ctx.cap, mp.prec, mpmath.mp.prec


def bits(values):
    """Doubles by their bits, so that the two zeros differ."""
    return np.ascontiguousarray(values, dtype=np.float64).view(np.int64).tolist()


@cache
def nodes():
    """Every node of every source but those of the module that owns the contexts, with the name of the file."""
    trees = {
        path: ast.parse(path.read_text(encoding="utf-8"))
        for path in SOURCES
        if path != ROOT / "reference" / "arithmetic" / "precision.py"
    }
    return [(path.name, node) for path, tree in trees.items() for node in ast.walk(tree)]


def test_only_one_module_names_the_contexts_of_python_flint_and_mpmath():
    for name, node in nodes():
        if isinstance(node, ast.ImportFrom) and node.module in OWNERS:
            assert not {alias.name for alias in node.names} & {OWNERS[node.module], "*"}, name
        if isinstance(node, ast.Import):
            assert not {alias.name.split(".")[0] for alias in node.names} & set(OWNERS), name


def test_a_property_that_is_computed_once_has_no_lock_of_its_own():
    for name, node in nodes():
        if isinstance(node, ast.ImportFrom) and node.module == "functools" and name != "once.py":
            assert "cached_property" not in {alias.name for alias in node.names}, name


def test_a_precision_is_set_by_blocks_only():
    for name, node in nodes():
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        found = {ast.unparse(target) for target in targets if isinstance(target, ast.Attribute)}
        assert not found & {"ctx.prec", "ctx.cap", "ctx.dps", "mp.prec", "mp.dps"}, name


def of_one_function(node):
    """The nodes below one, without those of the functions that are defined there."""
    for child in ast.iter_child_nodes(node):
        if not isinstance(child, (ast.FunctionDef, ast.Lambda)):
            yield child
            yield from of_one_function(child)


def test_no_generator_keeps_the_lock_between_two_values():
    for name, node in nodes():
        blocks = [ast.unparse(item.context_expr) for item in node.items] if isinstance(node, ast.With) else []
        if any(block.startswith(("ctx.work", "mp.work", "mp.extra", "SERIES.of")) for block in blocks):
            assert not any(isinstance(part, (ast.Yield, ast.YieldFrom)) for part in of_one_function(node)), name


@pytest.mark.parametrize(
    "block", [partial(ctx.workprec, 77), partial(ctx.worklength, 33), partial(mp.workprec, 77), partial(mp.workdps, 77)]
)
def test_the_contexts_are_left_as_they_were_with_errors_too(block):
    before = in_force()
    with block():
        assert in_force() != before
    with pytest.raises(ZeroDivisionError), block():
        _ = 1 / 0
    with pytest.raises(KeyboardInterrupt), block(), block():
        raise KeyboardInterrupt
    assert in_force() == before


def test_precision_is_raised_from_what_is_in_force():
    with mp.workprec(100), mp.extraprec(20):
        assert mp.prec == 120
        assert mp.sin(mp.mpf(1))._mpf_[3] > 110
    with mp.workdps(50):
        assert mp.dps == 50
        assert mpmath.mp.prec == 53


def test_mpmath_s_precision_is_set_inside_a_block_only():
    with pytest.raises(PrecisionError, match=r"^mpmath's precision is set outside of 'with mp\.workprec\(bits\)'"):
        mp.prec = 100
    with pytest.raises(PrecisionError, match="which alone is accepted"):
        mp.quad(mp.sin, [0, 1])


def test_a_thread_waits_for_the_one_that_holds_the_lock():
    seen, holding, done = [], threading.Event(), threading.Event()

    def other():
        holding.wait()
        with ctx.workprec(200):
            seen.append(("other", ctx.prec, mp.prec))
        done.set()

    thread = threading.Thread(target=other)
    thread.start()
    with ctx.workprec(90), held(), mp.workprec(80):
        holding.set()
        assert not done.wait(0.05)
        seen.append(("first", ctx.prec, mp.prec))
    thread.join()
    assert seen == [("first", 90, 80), ("other", 200, 53)]


def test_a_property_is_computed_once_without_a_lock():
    class Kept:
        count = 0

        @cached_property
        def value(self):
            """What it says."""
            self.count += 1
            return self.count

    kept = Kept()
    assert [kept.value, kept.value, kept.count] == [1, 1, 1]
    assert Kept.value.__doc__ == "What it says."
    started, looked = threading.Event(), []

    class Slow:
        @cached_property
        def value(self):
            started.set()
            with ctx.workprec(60):
                return 7

    slow = Slow()
    with held():
        thread = threading.Thread(target=lambda: looked.append(slow.value))
        thread.start()
        started.wait()
        assert slow.value == 7  # where the property held a lock while it waits for ours, this would never end
    thread.join()
    assert looked == [7]


def test_a_forked_process_works_while_another_thread_holds_the_lock():
    holding, ending = threading.Event(), threading.Event()

    def hold():
        with ctx.workprec(777), ctx.worklength(5), mp.workprec(999):
            holding.set()
            ending.wait()

    before, thread = in_force(), threading.Thread(target=hold)
    expected = bits(Pendulum(1.0).state(0.5, limbs=3))
    thread.start()
    holding.wait()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # from Python 3.12 on, of forks beside threads
        child = os.fork()
    if child == 0:
        right = in_force() == before and bits(Pendulum(1.0).state(0.5, limbs=3)) == expected
        os._exit(0 if right else 1)
    ending.set()
    thread.join()
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_a_process_forked_by_the_thread_that_holds_the_lock_keeps_it():
    with ctx.workprec(90):
        child = os.fork()
        if child == 0:
            with held(), mp.workprec(80):
                right = (ctx.prec, mp.prec) == (90, 80)
            os._exit(0 if right and ctx.prec == 90 else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


TIMES = {count: [Fraction(7 * i * i % 4001, 97) for i in range(count)] for count in (3, 12, 128, 200)}
ANGLES = [Fraction(i, 3) for i in range(1, 5)]
WORK = {
    "many states of a libration": lambda: bits(Pendulum(1.0).state(TIMES[200], limbs=3)),
    "many states of a rotation": lambda: bits(Pendulum(0.3, omega0=7).state(TIMES[128], limbs=3)),
    "states of a libration": lambda: bits(Pendulum(3.0).state(TIMES[12], limbs=3)),
    "digits": lambda: Pendulum(2.0).period().digits(120),
    "a cycloid": lambda: bits(Cycloid(2, 1).along("state", TIMES[3], limbs=3)),
    "a tautochrone": lambda: bits(Tautochrone(1).state(TIMES[3], limbs=3)),
    "a cycloidal pendulum": lambda: bits(CycloidalPendulum("0.3").state(TIMES[12], limbs=3)),
    "a descent": lambda: bits(Descent("quartic").along("motion", [Fraction(1, 5), Fraction(1, 2)], limbs=3)),
    "a polar path": lambda: bits(PolarBrachistochrone(z0="0.5").along("curve", ANGLES, limbs=3)),
    "a tunnel": lambda: bits(Tunnel(z0="0.5").along("curve", ANGLES, limbs=3)),
    "routes": lambda: Pendulum(1.0).certified("state", Fraction(3, 7)).routes,
}


def test_sixteen_threads_find_what_one_finds():
    before, expected = in_force(), {name: work() for name, work in WORK.items()}
    wrong, names, interval = [], list(WORK), sys.getswitchinterval()

    def work(first):
        for i in range(len(names)):
            name = names[(first + i) % len(names)]
            found = WORK[name]()
            if found != expected[name]:
                wrong.append(name)

    threads = [threading.Thread(target=work, args=(first,)) for first in range(16)]
    sys.setswitchinterval(1e-6)
    try:
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert wrong == []
    assert in_force() == before


class Meddler:
    """Sets python-flint's context and mpmath's as a thread without the lock would: at every so manyth line of ours."""

    def __init__(self, settings, every, phase):
        self._settings, self._every, self._count = settings, every, phase
        self.met = 0

    def __enter__(self):
        self._before = in_force()
        sys.settrace(self._calls)
        return self

    def __exit__(self, *_error):
        sys.settrace(None)
        flint.ctx.prec, flint.ctx.cap, _, mpmath.mp.prec = self._before

    def _calls(self, frame, _event, _argument):
        name = frame.f_globals.get("__name__", "")
        return self._lines if name.split(".")[0] in {"reference", "compare"} else None

    def _lines(self, _frame, event, _argument):
        if event == "line":
            self._count += 1
            if self._count % self._every == 0:
                flint.ctx.prec, flint.ctx.cap = self._settings[self.met % len(self._settings)]
                mpmath.mp.prec = flint.ctx.prec
                self.met += 1
        return self._lines


WORST = [(30, 4), (700, 90), (53, 10), (20, 300), (2000, 2), (110, 7)]


@pytest.mark.parametrize("phase", range(3))
@pytest.mark.parametrize("every", [1, 2, 7])
def test_the_polynomial_of_the_sine_encloses_it_whatever_is_done_to_the_context(every, phase):
    with ctx.workprec(300):
        k, width = arb(3) / 5, arb(1) / 9
        with Meddler(WORST, every, phase) as meddler:
            found = sine_polynomial(k, width, 160)
        assert meddler.met
        for x in (arb(1), arb(-1), arb(0.9), arb(-0.3)):
            truth = BallElliptic(arb(3) / 5, arb(4) / 5).functions(x * width)[0]
            assert (x * found(x * x)).overlaps(truth)


@pytest.mark.parametrize("phase", range(4))
@pytest.mark.parametrize("every", [1, 3, 5])
def test_the_chart_of_many_states_encloses_them_whatever_is_done_to_the_context(every, phase):
    times = TIMES[128]
    for pendulum in (Pendulum(2.5), Pendulum(0.3, omega0=7)):
        with ctx.workprec(400):
            truth = pendulum.closed_form(BALL).rows("state", times)
        with ctx.workprec(200), Meddler(WORST, every, phase):
            chart = pendulum.chart("state", len(times), 160)
            found = chart.rows("state", times) if chart else []
        with ctx.workprec(400):
            for near, exact in zip(found, truth, strict=False):
                assert all(not a.is_finite() or a.overlaps(b) for a, b in zip(near, exact, strict=True))


@pytest.mark.parametrize("phase", range(2))
@pytest.mark.parametrize("every", [1, 5])
@pytest.mark.parametrize("name", ["quartic", "circular_arc", "parabola"])
def test_the_clock_of_a_descent_encloses_the_time_whatever_is_done_to_the_context(name, every, phase):
    slide = Descent(name).slide
    with ctx.workprec(300):
        truth = Primitive(slide, "slowness").total
    with ctx.workprec(150), Meddler([(53, 10), (700, 90), (90, 40), (300, 6)], every, phase):
        found = Primitive(slide, "slowness").total
    with ctx.workprec(300):
        assert not found.is_finite() or found.overlaps(truth)


SLOWLY = {
    "many states": lambda: bits(Pendulum(1.0).state(TIMES[128], limbs=2)),
    "digits": lambda: Pendulum(2.0).period().digits(60),
    "a cycloid": lambda: bits(Cycloid(2, 1).along("state", TIMES[3], limbs=2)),
    "a polar path": lambda: bits(PolarBrachistochrone(z0="0.5").along("curve", ANGLES[:2], limbs=2)),
    "routes": lambda: Pendulum(1.0).certified("state", Fraction(3, 7)).routes,
}


@pytest.mark.parametrize("name", SLOWLY)
@pytest.mark.parametrize("every", [101, 331])
def test_what_is_proven_while_the_context_is_set_by_others_is_right(name, every):
    expected = SLOWLY[name]()
    with Meddler([(2000, 300), (64, 40), (300, 90)], every, 0) as meddler:
        found = SLOWLY[name]()
    assert meddler.met
    assert found == expected


@pytest.mark.parametrize("settings", [[(2000, 300), (700, 190)], [(2000, 300), (64, 40), (300, 90)]])
@pytest.mark.parametrize("every", [53, 331])
def test_a_descent_is_right_or_undecided_while_the_context_is_set_by_others(settings, every):
    """What would be kept of one precision is asked anew: a clock of wide balls, kept, would be asked again."""

    def states():
        clock.cache_clear()
        return bits(Descent("parabola").along("motion", [Fraction(1, 5)], limbs=2))

    expected = states()
    try:
        with Meddler(settings, every, 0) as meddler:
            found = states()
    except WorkBoundError:
        assert min(settings)[0] < 100, "balls that are only narrower decide as much"
    else:
        assert meddler.met
        assert found == expected
    finally:
        clock.cache_clear()


def shortened(terms, series):
    """1/series of at most nine terms, of which other code leaves some."""
    with ctx.workprec(100), SERIES.of_length(9):
        flint.ctx.cap = terms
        return 1 / arb_series(series)


def test_a_series_that_others_cut_to_nothing_is_refused_in_one_sentence():
    with pytest.raises(PrecisionError, match=r"^flint\.ctx\.cap was set by other code during a proof; code that"):
        shortened(0, [1, 1])
    with pytest.raises(ZeroDivisionError):
        shortened(9, [])
    assert shortened(3, [1, 1]).prec == 3
