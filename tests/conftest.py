"""What every test runs under."""

from __future__ import annotations

from typing import TYPE_CHECKING

import heyoka
import pytest
from flint import ctx
from mpmath import mp

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(scope="session", autouse=True)
def one_heyoka_thread() -> Iterator[None]:
    """Compiled functions run on one thread, so that tests that run side by side do not fight over cores."""
    before = heyoka.get_nthreads()
    heyoka.set_nthreads(1)
    yield
    heyoka.set_nthreads(before)


@pytest.fixture(autouse=True)
def working_precision_stays_as_it_was() -> Iterator[None]:
    """Precision is local: no test, and nothing that it calls, leaves another behind."""
    before = ctx.prec, mp.prec
    yield
    after = ctx.prec, mp.prec
    ctx.prec, mp.prec = before
    assert after == before, "the working precision of python-flint or mpmath was left changed"
