"""``python -m compare score FILE``: decimal commas, as European spreadsheets write them."""

from __future__ import annotations

import json
from fractions import Fraction

import numpy as np
import pytest

from compare.__main__ import main
from reference import Pendulum

T = np.arange(0, 40) / 10
Y = Pendulum(1.0).state(T)
OFF = 1e-6
Y[30, 0] += OFF
ROWS = list(zip(T.tolist(), *Y.T.tolist(), strict=True))


def comma(text: str) -> str:
    return text.replace(".", ",")


def lines(separator: str, header: str) -> str:
    return header + "".join(comma(separator.join(map(repr, row))) + "\n" for row in ROWS)


TEXTS = {
    "semicolons.csv": lines(";", "t;theta;omega\n"),
    "tabs.tsv": lines("\t", "t\ttheta\tomega\n"),
    "blanks.txt": lines("  ", "t theta omega\n"),
    "semicolons_without_header.csv": lines(";", ""),
    "blanks_without_header.txt": lines(" ", ""),
    "quotes.csv": "t,theta,omega\n" + "".join(",".join(f'"{comma(repr(x))}"' for x in row) + "\n" for row in ROWS),
}


@pytest.mark.parametrize("name", TEXTS)
def test_commas_are_decimal_where_something_else_separates_the_columns(name, tmp_path, capsys):
    (tmp_path / name).write_text(TEXTS[name])
    assert main(["score", str(tmp_path / name), "--theta0", "1", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["rows"], found["worst_row"], found["times"]) == (40, 31, "binary64")
    assert found["max_error"] == pytest.approx(OFF, rel=1e-9)


def test_a_mark_may_come_late_and_whole_numbers_have_none(tmp_path, capsys):
    rows = [
        "0;1;0",
        *(f"{j};{comma(repr(a))};{comma(repr(b))}" for j, (a, b) in enumerate(Pendulum(1.0).state([1, 2]).tolist(), 1)),
    ]
    (tmp_path / "a.csv").write_text("\n".join(["t;theta;omega", *rows]))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["max_error"] < 4.5e-16


def test_48_digits_with_decimal_commas_are_judged_to_48_digits(tmp_path, capsys):
    exact = Pendulum("0.7", g="9.81")
    rows = [
        [f"{j / 10:.1f}", *(exact.certified("state", Fraction(j, 10), i).digits(48) for i in (0, 1))]
        for j in range(1, 30)
    ]
    for rows_, digits in ((rows, 48), ([*rows[:-1], [*rows[-1][:2], rows[-1][2][:40]]], 36)):
        (tmp_path / "long.csv").write_text(comma("t;theta;omega\n" + "\n".join(map(";".join, rows_))))
        assert main(["score", str(tmp_path / "long.csv"), "--theta0", "0.7", "--exact", "--format", "json"]) == 0
        found = json.loads(capsys.readouterr().out)
        assert digits <= found["worst_digits"] <= 48
        assert found["points"][0]["theta"] == rows[0][1]
    assert (found["worst_row"], found["worst_digits"]) == (29, pytest.approx(38, abs=1.5))


MISTAKES = {
    "t;theta;omega\n0,5;1.5;0\n": "theta in line 2 is '1.5', and t in line 2 has another decimal mark; points",
    "t;theta;omega\n0;1,0;0\n1;0.5;0\n": "theta in line 3 is '0.5', and theta in line 2 has another decimal mark",
    "t;theta;omega\n0.0;1.0;0\n1.0;0,5;0\n": "theta in line 3 is '0,5', and t in line 2 has another decimal mark",
    "t;theta;omega\n0;1.234,5;0\n": "theta in line 2 is '1.234,5', with several marks; one decimal mark is accepted",
    "t;theta;omega\n0;1;0\n1;0,5;x\n": "omega in line 3 is 'x', which is not a number",
    "t,theta,omega\n0,01,0,99,0,1\n": "line 2 has 6 fields; 3 are accepted, as in the first line of the table; where",
    "0,01,0,99,-0,1\n": "there are 6 columns without a header; 3 are accepted (t, theta, omega), or a header",
    "0,01,0,99\n": "where commas are decimal marks, columns with semicolons, tabs or blanks between them are accepted.",
}  # fmt: skip


@pytest.mark.parametrize("text", MISTAKES)
def test_what_may_mean_two_things_is_one_sentence_and_exit_code_2(text, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(text)
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert MISTAKES[text] in err
