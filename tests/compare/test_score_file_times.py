"""Times in other units, from another origin, in another order, and numbers of steps in their place."""

from __future__ import annotations

import math

import pytest

from compare.__main__ import main
from reference import Pendulum

P = Pendulum(1.0)
ROWS = [(j / 4, *P.state(j / 4).tolist()) for j in range(11)]
FINE = [(j / 1000, *P.state(j / 1000).tolist()) for j in range(40)]
PERIOD, W, D = float(P.period()), math.sqrt(9.81), 180 / math.pi
HEADER = "t,theta,omega\n"


def scaled(of_t: float, of_theta: float = 1, of_omega: float = 1, begin: float = 0, rows=ROWS):
    return [((begin + t) * of_t, theta * of_theta, omega * of_omega) for t, theta, omega in rows]


def numbered(rows, first: int = 0, factor: float = 1):
    return [(n, factor * theta, factor * omega) for n, (_, theta, omega) in enumerate(rows, first)]


INSTEAD = "and not where it is in s, which is accepted, so multiply t by"
UNIT = "units of sqrt(length/g)"
TOLD = [
    (scaled(1000), f"where t is in ms, {INSTEAD} 0.001."),
    (scaled(1e6), f"where t is in µs, {INSTEAD} 1e-6."),
    (scaled(1e9), f"where t is in ns, {INSTEAD} 1e-9."),
    (scaled(1 / 60), f"where t is in minutes, {INSTEAD} 60."),
    (scaled(1 / 3600), f"where t is in hours, {INSTEAD} 3600."),
    (scaled(1 / 86400), f"where t is in days, {INSTEAD} 86400."),
    (scaled(1 / PERIOD), f"where t is in periods, {INSTEAD} {PERIOD!r}."),
    (scaled(W), f"where t is in {UNIT}, {INSTEAD} 0.31927542840705"),
    (scaled(W, 1, 1 / W), f"where t is in {UNIT} and so is the time in omega, {INSTEAD} 0.3192754284070505, and"),
    (scaled(1000, 1, 0.001), f"where t is in ms and so is the time in omega, {INSTEAD} 0.001, and divide omega by"),
    (scaled(1000, D, D), f"where t is in ms and angles in degrees, {INSTEAD} 0.001, and angles by pi/180."),
    (numbered(ROWS), f"where t is the number of a step of about 0.25 s, {INSTEAD} the step."),
    (numbered(FINE, 0), f"where t is in ms, {INSTEAD} 0.001."),
    (numbered(FINE[::3]), f"where t is the number of a step of about 0.003 s, {INSTEAD} the step."),
    (numbered(ROWS, 1), "where t is the number of a step of about 0.25 s, from 1 on, and not where it is in s"),
    (numbered(ROWS[1:], 1), f"where t is the number of a step of about 0.25 s, {INSTEAD} the step."),
    (numbered(ROWS, 0, D), f"a step of about 0.25 s and angles are in degrees, {INSTEAD} the step, and angles by pi/1"),
    (scaled(1, begin=5), "where t is counted from the first (5.0), and not where it is from 0, which is accepted, so"),
    (scaled(1000, begin=5), "where t is in ms, counted from the first (5000.0), and not where it is in s from 0, wh"),
    (scaled(1, begin=5, rows=FINE), "where t is counted from the first (5.0), and not where it is from 0"),
    (ROWS[::-1], "t = 2.25 in line 3 comes after t = 2.5; increasing times are accepted, and all of these rows are"),
]  # fmt: skip


def refused(path, text: str, capsys) -> str:
    path.write_text(text)
    assert main(["score", str(path), "--theta0", "1"]) == 2
    captured = capsys.readouterr()
    assert (captured.out, captured.err.count("\n")) == ("", 1)
    return captured.err


@pytest.mark.parametrize("number", range(len(TOLD)))
def test_times_that_are_read_otherwise_are_one_sentence_with_what_is_accepted(number, tmp_path, capsys):
    rows, says = TOLD[number]
    text = "".join(f"{','.join(map(repr, row))}\n" for row in rows)
    found = refused(tmp_path / "a.csv", HEADER + text, capsys)
    assert says in found
    if says.startswith("t ="):
        says = says.replace("line 3", "line 2")
        found = found.replace("line 3", "line 2")
    assert refused(tmp_path / "a.csv", text, capsys).replace("line 3", "line 2") == found


def test_what_is_asked_for_is_accepted(tmp_path, capsys):
    table = scaled(W, D, D / W, begin=5)
    fixed = [((t - table[0][0]) / W, theta / D, omega * W / D) for t, theta, omega in table]
    for rows, code in ((table, 2), (fixed, 0)):
        (tmp_path / "a.csv").write_text("".join(f"{','.join(map(repr, row))}\n" for row in rows))
        assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == code
    assert "angles in degrees and so is the time in omega" in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["still", "noise", "too fast", "other numbers"])
def test_rows_that_are_merely_wrong_get_no_hint(kind, tmp_path, capsys):
    rows = {
        "still": [(n, 1.0, 0.0) for n in range(16)],
        "noise": [(n, math.sin(37.3 * n * n), 3 * math.cos(11.1 * n * n)) for n in range(16)],
        "too fast": [(t, *P.state(1.1 * t).tolist()) for t, *_ in ROWS],
        "other numbers": numbered([(0, *P.state(n * n / 16).tolist()) for n in range(9)]),
    }[kind]
    (tmp_path / "a.csv").write_text("".join(f"{','.join(map(repr, row))}\n" for row in rows))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 0
    assert "rows, worst" in capsys.readouterr().out


def test_a_flow_is_not_proven_farther_than_the_rows_go(tmp_path, capsys):
    """Minutes and hours of it would take hours."""
    rows = "".join(f"{n},{n * 7 % 5},{n * 3 % 4},{n % 3},1\n" for n in range(6))
    (tmp_path / "a.csv").write_text(f"t,x,y,px,py\n{rows}")
    assert main(["score", str(tmp_path / "a.csv"), "--problem", "kepler"]) == 0
    assert "6 rows, worst 0.0 correct digits" in capsys.readouterr().out
