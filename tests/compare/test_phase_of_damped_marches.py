"""The phase of a march whose amplitude falls far below the exact one."""

import cmath
import json
import math

import pytest

from compare.__main__ import main


def test_the_phase_of_a_march_that_is_damped_away_is_that_of_the_stability_function(capsys):
    march = ["--theta0", "1e-9", "--n", "64", "--t-end", "50", "--methods", "rk4"]
    words = ["pendulum", *march, "--scores", "phase", "--quiet", "--format", "json"]
    assert main(words) == 0
    row = json.loads(capsys.readouterr().out)["tables"]["phase"][0]
    z = 1j * math.sqrt(9.81) * row["h"]
    own = cmath.phase(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24)  # a step of RK4 turns a small oscillation by this
    assert abs(row["end_phase_error"]) == pytest.approx(64 * (own - z.imag), rel=1e-9)
    assert row["max_phase_error"] == abs(row["end_phase_error"])
