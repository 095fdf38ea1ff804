"""Random sound integrators pass, and random slips do not: the short version of tests/benchmarks/false_alarms.py."""

from __future__ import annotations

import random

import pytest
import sound_and_slipped

import compare

QUICK = ("timed", "step", "separable", "gradient")
"""Forms that are compiled."""


def drawn(make, seed):
    r = random.Random(seed)
    while True:
        made = make(r)
        if made.form in QUICK and made.method.name != "rk4_misprinted":
            return made


@pytest.mark.parametrize("seed", range(4))
def test_a_sound_integrator_passes(seed):
    made = drawn(sound_and_slipped.sound, seed)
    found = compare.check(made.function, **made.claims)
    assert found.claims_hold is not False, made.told


@pytest.mark.parametrize("seed", range(4))
def test_a_slip_is_caught(seed):
    made = drawn(sound_and_slipped.slipped, seed)
    found = compare.check(made.function, **made.claims)
    assert found.claims_hold is False, made.told
