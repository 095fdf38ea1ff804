"""``python -m compare score FILE``: tables of text as programs write them, each read as meant or told in a sentence."""

from __future__ import annotations

import json
import re
import subprocess
from fractions import Fraction
from typing import TYPE_CHECKING

import pytest

from compare.__main__ import main
from reference import Pendulum

if TYPE_CHECKING:
    from pathlib import Path

P = Pendulum(1.0)
T = [j / 4 for j in range(11)]
ROWS = [(t, *P.state(t).tolist()) for t in T]
NAMES = ("t", "theta", "omega")
DEGREES = 57.29577951308232


def lines(separator: str = ",", word=repr, before: str = "", after: str = "", rows=ROWS, end: str = "\n") -> str:
    return "".join(f"{before}{separator.join(map(word, row))}{after}{end}" for row in rows)


def comma(number: float) -> str:
    return repr(number).replace(".", ",")


def minus(number: float) -> str:
    return repr(number).replace("-", "\u2212")


def power(number: float) -> str:
    mantissa, exponent = f"{number:.16e}".split("e")
    return f"{mantissa}*^{int(exponent)}"


def fixed(row) -> str:
    return "{:6.2f}{:19.16f}{:19.16f}\n".format(*row)


LABVIEW = (
    "LabVIEW Measurement\t\r\nSeparator\tTab\r\nX_Columns\tOne\r\n***End_of_Header***\t\t\t\r\n\t\t\t\r\n"
    "Channels\t2\t\t\r\nX_Value\ttheta\tomega\tComment\r\n"
)
MYSQL = "+------+-------+-------+\n| t    | theta | omega |\n+------+-------+-------+\n"
BOX = "┌─────┬───────┬───────┐\n│ t   ┆ theta ┆ omega │\n╞═════╪═══════╪═══════╡\n"
HEADER = "t,theta,omega\n"
READ = {
    "a spreadsheet's line on its separator": "sep=;\r\nt;theta;omega\r\n" + lines(";", end="\r\n"),
    "the same of commas, quoted": '"sep=,"\n' + HEADER + lines(),
    "the same of bars": "sep=|\n" + "t|theta|omega\n" + lines("|"),
    "a logger's measurement": LABVIEW + lines("\t", after="\t", end="\r\n"),
    "a logger's measurement with decimal commas": LABVIEW + lines("\t", comma, after="\t"),
    "units and remarks under the header": f"{HEADER}s,rad,rad/s\ntime,angle,rate\n{lines()}",
    "a long name over the header": f"Time,Angle,Rate\ns,rad,rad s^-1\n{HEADER}{lines()}",
    "units in brackets under the header": f"{HEADER}[s],[rad],[rad·s⁻¹]\n{lines()}",
    "types of the columns under the header": f"t\ttheta\tomega\nFloat64\tFloat64\tFloat64\n{lines(chr(9))}",
    "a drawn line under the header": "t theta omega\n-- ----- -----\n" + lines(" "),
    "semicolons for comments": f"; made by a logger\n; 250 MHz\nTime(s), theta, omega\n{lines()}",
    "semicolons for comments without a header": f"; made by a logger\n; 250 MHz\n{lines()}",
    "slashes for comments": f"// t theta omega\n{lines(' ')}",
    "semicolons for comments with a header": f"; omega,theta,t\n{lines(rows=[row[::-1] for row in ROWS])}",
    "a title before the header": f"Run 7 of 2024\n{HEADER}{lines()}",
    "a count before the header": f"11\n{HEADER}{lines()}",
    "empty fields at the end": "t;theta;omega;;;\r\n" + lines(";", comma, after=";;;") + ";;;;;\r\n;;;;;\r\n",
    "a separator at the end of rows": HEADER + lines(after=","),
    "a separator at the end without a header": lines(after=","),
    "empty rows in between": HEADER + lines().replace("\n", "\n,,\n", 4),
    "quoted rows of empty fields": HEADER + lines() + '"","",""\n',
    "R's write.table": '"t" "theta" "omega"\n'
    + "".join(f'"{n}" {lines(" ", rows=[r])}' for n, r in enumerate(ROWS, 1)),
    "R's write.table with tabs": '"t"\t"theta"\t"omega"\n'
    + "".join(f'"{n}"\t{lines(chr(9), rows=[r])}' for n, r in enumerate(ROWS, 1)),
    "R's write.csv": '"","t","theta","omega"\n' + "".join(f'"{n}",{lines(rows=[r])}' for n, r in enumerate(ROWS, 1)),
    "pandas' index without a name": ",t,theta,omega\n" + "".join(f"{n},{lines(rows=[r])}" for n, r in enumerate(ROWS)),
    "a true minus": HEADER + lines(word=minus),
    "a true minus before a decimal comma": "t;theta;omega\n" + lines(";", lambda x: minus(x).replace(".", ",")),
    "a dash for minus": HEADER + lines(word=lambda x: repr(x).replace("-", "\u2013")),
    "Fortran's exponent without a letter": HEADER
    + lines(rows=[(0.0, 1.0, 0.0), *ROWS[1:]]).replace("0.0,1.0,0.0", "0.0,1.0,0.100000-104", 1),
    "Mathematica's exponents": HEADER + lines(word=power),
    "Mathematica's precision": HEADER + lines(word=lambda x: f"{x!r}`17."),
    "powers of ten": HEADER + lines(word=lambda x: power(x).replace("*^", "×10^")),
    "a spreadsheet's text": HEADER + lines(word=lambda x: f'="{x!r}"'),
    "C's hexadecimal digits": HEADER + lines(word=float.hex),
    "NumPy's numbers in lists": HEADER + lines(word=lambda x: f"np.float64({x!r})"),
    "mpmath's numbers in lists": "t;theta;omega\n" + lines(";", lambda x: f"mpf('{x!r}')"),
    "a modelling language's derivative": '"time","theta","der(theta)"\n' + lines(),
    "other names of derivatives": "Time [s],theta(t),theta'(t)\n" + lines(),
    "names with units": "Time (s),theta (rad),omega (rad/s)\n" + lines(),
    "quotients of units": "t/s,theta/rad,omega/(rad/s)\n" + lines(),
    "units after an underscore": "time_s,theta_rad,omega_rad_per_s\n" + lines(),
    "Greek letters": "t,θ,ω\n" + lines(),
    "quoted names with blanks": '"Time (s)"  "theta (rad)" "omega (rad/s)"\n' + lines(" "),
    "fixed columns that run together": "t theta omega\n" + "".join(map(fixed, ROWS)),
    "fixed columns without a header": "".join(map(fixed, ROWS)),
    "a table of Markdown": "| t | theta | omega |\n|---|:---:|--:|\n" + lines(" | ", before="| ", after=" |"),
    "a table of Markdown without outer bars": "t | theta | omega\n--|---|--\n" + lines(" | "),
    "a database's table": MYSQL + lines(" | ", before="| ", after=" |") + "+------+-------+-------+\n",
    "another database's table": "  t  | theta | omega\n-----+-------+-------\n" + lines(" | ") + "(11 rows)\n",
    "empty fields before the header": ";;\n;;\nt;theta;omega\n" + lines(";"),
    "a database's list": "t|theta|omega\n" + lines("|"),
    "a data frame in a box": BOX + lines(" ┆ ", before="│ ", after=" │") + "└─────┴───────┴───────┘\n",
    "lines of JSON": "".join(json.dumps(dict(zip(NAMES, row, strict=True))) + "\n" for row in ROWS),
    "lines of JSON in another order": "".join(
        json.dumps({"n": 7, "omega": c, "theta": b, "t": a}) + "\n" for a, b, c in ROWS
    ),
    "arrays in lines": "".join(json.dumps(row) + "\n" for row in ROWS),
    "one array of objects": json.dumps([dict(zip(NAMES, row, strict=True)) for row in ROWS]),
    "one array of objects in many lines": json.dumps([dict(zip(NAMES, row, strict=True)) for row in ROWS], indent=1),
    "one array of arrays": json.dumps(ROWS),
    "an array of arrays with names": json.dumps([NAMES, *ROWS]),
    "an object of columns": json.dumps(dict(zip(NAMES, zip(*ROWS, strict=True), strict=True))),
    "an object of columns in many lines": json.dumps(dict(zip(NAMES, zip(*ROWS, strict=True), strict=True)), indent=2),
    "columns by the number of the row": json.dumps(
        {n: {i: r[k] for i, r in enumerate(ROWS)} for k, n in enumerate(NAMES)}
    ),
    "names, index and data": json.dumps({"columns": NAMES, "index": [*range(11)], "data": ROWS}),
    "times and states in two arrays": json.dumps(
        {"t": T, "y": [*zip(*(row[1:] for row in ROWS), strict=True)], "nfev": 7}
    ),
    "one object": json.dumps(dict(zip(NAMES, ROWS[3], strict=True))),
    "one array": json.dumps(ROWS[3]),
    "rows in round brackets": "".join(f"({a!r}, {b!r}, {c!r})\n" for a, b, c in ROWS),
    "rows in braces": "t,theta,omega\n" + "".join(f"{{{a!r}, {b!r}, {c!r}}}\n" for a, b, c in ROWS),
    "units whose radian is 1": "t,theta (1),omega (1/s)\n" + lines(),
    "a column of ranges beside": "t theta omega range\n" + lines(" ", after=" 0.5-1.5"),
    "two byte order marks": "\ufeff\ufeff" + HEADER + lines(end="\r\n"),
    "a byte order mark before a number": "\ufeff" + lines(),
    "a header with blanks and rows with commas": "t theta omega\n" + lines(),
    "a column of text beside": "t,theta,omega,ok\n" + lines(after=",yes"),
    "an empty first column": "\tt\ttheta\tomega\n" + lines("\t", before="\t"),
}


def judged(path: Path, capsys, *options: str) -> dict:
    code = main(["score", str(path), "--theta0", "1", "--format", "json", *options])
    out, err = capsys.readouterr()
    assert (code, err) == (0, "")
    return json.loads(out)


@pytest.mark.parametrize("kind", READ)
def test_a_table_is_read_as_it_was_meant(kind, tmp_path, capsys):
    (tmp_path / "a.txt").write_bytes(READ[kind].encode())
    found = judged(tmp_path / "a.txt", capsys)
    assert found["rows"] == (1 if kind in {"one object", "one array"} else 11)
    assert found["max_error"] < 4.5e-16
    assert found["worst_scaled_digits"] > 15.9


def test_unicode_text_as_a_spreadsheet_writes_it_is_read(tmp_path, capsys):
    text = "t\ttheta\tomega\r\n" + lines("\t", comma, end="\r\n")
    (tmp_path / "a.txt").write_bytes(b"\xff\xfe" + text.encode("utf-16-le"))
    assert judged(tmp_path / "a.txt", capsys)["rows"] == 11


@pytest.mark.parametrize(
    ("kind", "says"),
    [
        ("a logger's measurement", "5 lines before the header, which is line 7, did not count."),
        ("units and remarks under the header", "Line 3 under the header, of text, did not count."),
        ("fixed columns that run together", "Numbers that run together at a minus were taken apart."),
        ("semicolons for comments without a header", "2 lines before the table, beginning with ;, did not count."),
        ("a title before the header", "One line before the header, which is line 2, did not count."),
    ],
)
def test_what_did_not_count_is_told(kind, says, tmp_path, capsys):
    (tmp_path / "a.txt").write_bytes(READ[kind].encode())
    assert says in judged(tmp_path / "a.txt", capsys)["notes"]


def test_columns_of_a_header_can_be_asked_for_by_their_numbers(tmp_path, capsys):
    for before in ("", "a title, of mine, with four words, and commas, seven in all, at last\n"):
        (tmp_path / "a.csv").write_text(before + "a,b,b,b\n" + lines(before="7,"))
        assert judged(tmp_path / "a.csv", capsys, "--columns", "2,3,4")["rows"] == 11
    (tmp_path / "a.csv").write_text("a,b,b,b\n" + lines(before="x,"))
    assert judged(tmp_path / "a.csv", capsys, "--columns", "2,3,4")["rows"] == 11
    (tmp_path / "a.csv").write_text("a,b,b,b\nx,s,deg,deg/s\n" + lines(before="7,"))
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--columns", "2,3,4"]) == 2
    (tmp_path / "a.csv").write_text("0\n1\n2\n")
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", "--columns", "1,1,1", "--rows", "9"]) == 0
    assert "3 rows" in capsys.readouterr().out


@pytest.mark.parametrize("kind", ["comma", "units in brackets under the header", "lines of JSON"])
def test_where_all_was_understood_nothing_is_told(kind, tmp_path, capsys):
    (tmp_path / "a.txt").write_bytes(READ.get(kind, HEADER + lines()).encode())
    assert judged(tmp_path / "a.txt", capsys)["notes"] == []


MILLI = [(1000 * t, a, b) for t, a, b in ROWS]
TOLD = {
    f"{HEADER}s,deg,deg/s\n{lines()}": "theta, with the units deg, is in degrees; radians are accepted, so multiply by",
    f"t (ms),theta,omega\n{lines()}": "the column t (ms) is in ms; s is accepted, so multiply by 0.001.",
    f"t_ms,theta,omega\n{lines()}": "the column t_ms is in ms; s is accepted, so multiply by 0.001.",
    f"t [min],theta,omega\n{lines()}": "the column t [min] is in min; s is accepted, so multiply by 60.",
    f"t,theta (mrad),omega\n{lines()}": "the column theta (mrad) is in mrad; radians are accepted, so multiply",
    f"t,theta,omega [rpm]\n{lines()}": "the column omega [rpm] is in rpm; rad s-1 is accepted, so multiply by pi/30.",
    f"t,theta_deg,omega\n{lines()}": "the column theta_deg is in degrees; radians are accepted, so multiply by pi/180.",
    f"t,theta (m),omega\n{lines()}": "the column theta (m) is in m; rad is accepted.",
    f"time,angle,rate\nms,rad,rad/s\n{HEADER}{lines()}": "t, with the units ms, is in ms; s is accepted",
    HEADER + lines(rows=MILLI): "the first 11 rows fit the truth where t is in ms, and not where it is in s, which is",
    HEADER + lines(rows=[(1e3 * t, DEGREES * a, DEGREES * b) for t, a, b in ROWS]): "t is in ms and angles in degrees",
    HEADER + lines(word=lambda x: f"~{x!r}", rows=ROWS[:3]) + lines(rows=ROWS[3:]): "t in line 2 is '~0.0', which is",
    HEADER + lines(rows=[(1e6 * t, a, b) for t, a, b in ROWS]): "fit the truth where t is in µs, and not where it is",
    HEADER + lines(rows=[(t / 60, a, b) for t, a, b in ROWS]): "in minutes, and not where it is in s, which",
    HEADER + lines(rows=[(t, 1e3 * a, b) for t, a, b in ROWS]): "theta is 1000.0 times the truth, as an angle in mill",
    HEADER + lines(rows=[(t, a, DEGREES * b) for t, a, b in ROWS]): "omega is 57.3 times the truth, as an angle in deg",
    "t theta omega\n" + "".join(f"{n} {lines(' ', rows=[r])}" for n, r in enumerate(ROWS)): (
        "line 2 has 4 fields; 3 are accepted, as in the first line of the table; where the first field of a row is its"
    ),
    HEADER + lines().replace("0.5,0.1", "NA,0.1"): "t in line 4 is 'NA', which is not a number",
    HEADER + lines().replace("0.5,0.1", "#N/A,0.1"): "t in line 4 is '#N/A', which is not a number",
    "t theta omega\n" + lines(" ", rows=ROWS[:3]) + "-- -- --\n": "t in line 5 is '--', which is not a number",
    f"{HEADER}NA,NA,NA\n{lines()}": "t in line 2 is 'NA', which is not a number",
    f"{HEADER}-,-,-\n{lines()}": "t in line 2 is '-', which is not a number",
    f"{HEADER}1:30,x,y\n{lines()}": "t in line 2 is '1:30', which is not a number",
    HEADER + lines().replace("0.5,0.1", "0.5,∞,0.1"): "line 4 has 4 fields",
    HEADER + lines().replace("1.0,", "1'000.5,", 1): "theta in line 2 is '1'000.5', with several marks",
    "t;theta;omega\n" + lines(";").replace("1.0;", "1\u202f000,5;", 1): "with several marks; one decimal mark is",
    "t;theta;omega\n" + lines(";").replace("1.0;", "1 000.5;", 1): "with several marks; one decimal mark is",
    HEADER + lines().replace("1.0,", '"1,000",', 1): "has another decimal mark",
    HEADER + lines().replace("1.0,", "1-104,", 1): "theta in line 2 is '1-104', which is not a number",
    HEADER + lines().replace("1.0,", "0x,", 1): "theta in line 2 is '0x', which is not a number",
    HEADER + lines().replace("1.0,", "0x1p99999,", 1): "digits; fewer are accepted",
    HEADER + lines().replace("1.0,", "1.#INF,", 1): "theta in line 2 is 1.#INF, which is not finite",
    HEADER + lines().replace("1.0,", "-nan(ind),", 1): "theta in line 2 is -nan(ind), which is not finite",
    "t theta omega\n0.00 1.00012.5000 3.0000\n": "with several marks; one decimal mark is accepted",
    "t theta omega\n0.00 ****** 3.0000\n": "theta in line 2 is '******', which is not a number",
    HEADER + lines() + "…,…,…\n": "t in line 13 is '…', which is not a number",
    "  t | theta | omega\n----+---+---\n" + lines("|") + "(12 rows)\n": "is '(12 rows)', after 11 rows; all of them",
    "x\n" + lines(): "no line before line 2, the first of numbers, names t, theta, omega; a header with these names",
    '{"t": 0, "theta": 1}\n{"t": 1, "theta": 1}\n': "there is no column omega: the columns are t, theta",
    '{"t": 0, "theta": 1, "omega": 0}\n{"t": 1, "theta": 1}\n': "line 2 has no omega; the keys of the first row are",
    '{"t": 0, "theta": 1, "omega": null}\n{"t": 1}\n': "omega in line 1 is 'null', which is not a number",
    '{"t": 0, "theta": NaN, "omega": 0}\n{"t": 1}\n': "theta in line 1 is NaN, which is not finite",
    '{"t": 0, "theta": 1, "omega": 0}\n{"t": 1, "theta": 1, "om\n': "line 2 begins as JSON, and is none",
    '{"t": 0, "t": 1, "theta": 1, "omega": 0}\n{"t": 1}\n': "line 1 has an object with a key twice; each once",
    '{"t": [0, 1], "theta": [1], "omega": [0]}': "the columns have different lengths, t 2, theta 1, omega 1",
    '[{"t": 0, "theta": 1, "omega": 0}, {"t": 1}]': "the objects have different keys",
    '{"t": {"theta": {"omega": 1}}}': "there is no column",
    "[" * 100_000: "brackets within brackets beyond any row",
    "[1, 2, [3]]": "the file is JSON of something else than rows",
    "[]": "the file is JSON of something else than rows",
    "{": "the file begins as JSON, and is none",
}  # fmt: skip


@pytest.mark.parametrize("number", range(len(TOLD)))
def test_what_cannot_be_read_as_meant_is_one_sentence(number, tmp_path, capsys):
    text, says = list(TOLD.items())[number]
    (tmp_path / "a.csv").write_bytes(text.encode())
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.endswith(".\n")
    assert says in err


PASTED = {
    "Zeit (s),Winkel,Rate (1/min)'s\n" + lines(): "--columns",
    "$HOME,`x`,a b\n" + lines(): "--columns",
    '"angle, rad",time,"rate, \\"\n' + lines(rows=[(b, a, c) for a, b, c in ROWS]): "--columns",
    "\x1b[1m,zwei,drei\n" + lines(): "--columns",
    "speed,theta,time\n" + lines(rows=[row[::-1] for row in ROWS]): "--columns",
    "my very own run\n" + lines(): "--skip",
    "my very own run\nin three columns; these\n\n" + lines(): "--skip",
    "t theta omega\n" + "".join(f"{n} {lines(' ', rows=[r])}" for n, r in enumerate(ROWS)): "--skip",
    HEADER + lines(rows=ROWS[:4]) + "@ note of mine\n" + lines(rows=ROWS[4:]): "--comment",
    HEADER + lines(rows=ROWS[:4]) + "$$ note, of, mine, too\n" + lines(rows=ROWS[4:]): "--comment",
}  # fmt: skip


@pytest.mark.parametrize("number", range(len(PASTED)))
def test_the_options_that_a_sentence_names_can_be_pasted_into_a_shell_and_work(number, tmp_path, capsys):
    text, name = list(PASTED.items())[number]
    (tmp_path / "a.csv").write_bytes(text.encode())
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    said = re.search(rf"({name} .*) would", capsys.readouterr().err)
    typed = subprocess.run(["/bin/sh", "-c", f"printf '%s\\0' {said[1]}"], capture_output=True, text=True, check=True)
    found = judged(tmp_path / "a.csv", capsys, *typed.stdout.split("\0")[:-1])
    assert (found["rows"], found["max_error"] < 4.5e-16) == (11, True)


def test_lines_can_be_skipped_and_comments_named(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("1,2,3\n4,5\n@ a\n" + HEADER + lines() + "@ b\n")
    assert judged(tmp_path / "a.csv", capsys, "--skip", "2", "--comment", "@")["rows"] == 11
    (tmp_path / "b.csv").write_text("\0\0\n" + lines())
    assert judged(tmp_path / "b.csv", capsys, "--skip", "1")["rows"] == 11


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--skip", "0"], "--skip is '0'; a positive integer is accepted."),
        (["--skip", "x"], "--skip is 'x'; a positive integer is accepted."),
        (["--comment", "-1"], "--comment is '-1'; what begins a comment is accepted"),
        (["--comment", " "], "--comment is ' '; what begins a comment is accepted"),
        (["--skip", "99"], "has no rows"),
    ],
)
def test_what_is_no_number_of_lines_and_no_mark_is_one_sentence(options, says, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(lines())
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1", *options]) == 2
    assert says in capsys.readouterr().err


def test_arrays_have_no_lines_to_skip(tmp_path, capsys):
    (tmp_path / "a.npy").write_bytes(b"")
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1", "--skip", "1"]) == 2
    assert "has no lines; --skip and --comment are accepted of text." in capsys.readouterr().err


HUGE = 1 << 18
LONG = {
    "-" * HUGE + "x": "there is no column t",
    "(" + " " * HUGE + "1": "there is no column t",
    "{1" + " " * HUGE + "(": "there is no column t",
    "a" * HUGE: "there is no column t",
    "," * HUGE: "has no rows",
    "a," * HUGE + "\n" + "b," * HUGE: "there is no column t",
    "a" * 100 + " " * HUGE + "b / c": "there is no column t",
    f"{HEADER}0,1,{'9' * HUGE}": "beyond the limit of 4000 digits",
    f"{HEADER}0,1,{'9-' * HUGE}": "which is not a number",
    f"{HEADER}0,1,{'f.' * (HUGE // 2)}(1)": "which is not a number",
    "t theta omega\n0 1 " + "0.5-" * (HUGE // 4): "which is not a number",
    f"{HEADER}0,1,0x{'f' * HUGE}": "which is not a number",
}


@pytest.mark.parametrize("number", range(len(LONG)))
def test_long_lines_of_anything_are_refused_before_they_cost(number, tmp_path, capsys):
    text, says = list(LONG.items())[number]
    (tmp_path / "a.csv").write_text(text)
    assert main(["score", str(tmp_path / "a.csv"), "--theta0", "1"]) == 2
    assert says in capsys.readouterr().err


@pytest.mark.parametrize("cut", [3, 6, 9])
def test_a_last_number_that_is_cut_off_is_pointed_out(cut, tmp_path, capsys):
    text = HEADER + lines()
    (tmp_path / "a.csv").write_text(text[: -cut - 1])
    (note,) = judged(tmp_path / "a.csv", capsys)["notes"]
    assert re.match(r"omega in line 12, the last row, is '-2.5\d+', of \d+ digits, and those before it have 16", note)


@pytest.mark.parametrize("places", [3, 6, 9])
def test_a_table_of_fixed_places_ends_as_it_should(places, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(HEADER + lines(word=lambda x: f"{x:.{places}f}"))
    assert judged(tmp_path / "a.csv", capsys)["notes"] == [
        note for note in judged(tmp_path / "a.csv", capsys)["notes"] if "last row" not in note
    ]
    last = (10.0, 0.001, 0.0001)
    (tmp_path / "a.csv").write_text(HEADER + lines(rows=[*ROWS, last], word=lambda x: f"{x:.{places}f}"))
    assert not any("last row" in note for note in judged(tmp_path / "a.csv", capsys)["notes"])


@pytest.mark.parametrize(
    ("text", "value"),
    [("4.9e-324", 4.9e-324), ("1e-400", 0.0), ("-0.0", 0.0), ("-0", 0.0), ("0x1p-1074", 5e-324), ("+0.0", 0.0)],
)
def test_subnormal_numbers_and_zeros_with_a_sign_are_numbers(text, value, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(f"{HEADER}0,1,{text}\n")
    assert judged(tmp_path / "a.csv", capsys)["max_errors"]["omega"] == value


def test_hexadecimal_digits_are_exact(tmp_path, capsys):
    """113 bits of theta at t = 1."""
    exact = P.certified("state", 1, 0)
    bits = round(abs(Fraction(exact.digits(60))) * 2**113)
    (tmp_path / "a.csv").write_text(f"{HEADER}1,-0x{bits:x}p-113,-0x1p-1\n")
    found = judged(tmp_path / "a.csv", capsys)
    assert found["max_errors"]["theta"] < 2e-34
    assert found["digits_held"] > 33.7
