"""What every test runs under."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

import flint
import heyoka
import mpmath
import pytest
from hypothesis import HealthCheck, settings

from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from collections.abc import Iterator

# No test judges how long something takes: the machine may be busy with others.
settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("untimed")


@pytest.fixture(scope="session", autouse=True)
def interrupts_are_heard() -> Iterator[None]:
    """A shell starts what it leaves in the background deaf to interrupts, and so are the processes that it starts."""
    before = signal.getsignal(signal.SIGINT)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session", autouse=True)
def one_heyoka_thread() -> Iterator[None]:
    """Compiled functions run on one thread, so that tests that run side by side do not fight over cores."""
    before = heyoka.get_nthreads()
    heyoka.set_nthreads(1)
    yield
    heyoka.set_nthreads(before)


@pytest.fixture(autouse=True)
def no_terminal(monkeypatch) -> None:
    """Tables are as wide as where they are piped, also in a process of a pool that has been told a width."""
    monkeypatch.delenv("COLUMNS", raising=False)


@pytest.fixture(autouse=True)
def working_precision_stays_as_it_was() -> Iterator[None]:
    """Precision is local: no test, and nothing that it calls, leaves another behind."""

    def in_force() -> tuple[int, ...]:
        return ctx.prec, ctx.cap, mp.prec, mpmath.mp.prec

    before = in_force()
    yield
    after = in_force()
    flint.ctx.prec, flint.ctx.cap, _, mpmath.mp.prec = before
    assert after == before, "the working precision of python-flint or mpmath was left changed"
