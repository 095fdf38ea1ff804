"""``python -m compare score FILE``: what other programs say of their numbers beside them, in HDF5, JSON and headers."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import mpmath
import numpy as np
import pytest

from compare import score
from compare.__main__ import main
from compare.files.columns import Unit, unit
from reference import Pendulum

T = np.arange(11) / 10
Y = Pendulum(1.0).state(T)
NAMES = ("t", "theta", "omega")
DEGREE = np.pi / 180


def judged(path, capsys, *options):
    assert main(["score", str(path), "--theta0", "1", "--format", "json", *options]) == 0, capsys.readouterr().err
    return json.loads(capsys.readouterr().out)


def refusal(path, capsys, *options):
    assert main(["score", str(path), "--theta0", "1", *options]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    return err


def datasets(path: Path, **attributes: dict[str, object]) -> Path:
    with h5py.File(path, "w") as file:
        for name, column in zip(NAMES, (T, *Y.T), strict=True):
            file[name] = column
            file[name].attrs.update(attributes.get(name, {}))
    return path


@pytest.mark.parametrize(
    ("attributes", "says"),
    [
        ({"theta": {"units": "turns"}}, "theta, with the units turns, is in turns; radians are accepted"),
        ({"t": {"units": np.bytes_("ms")}}, "t, with the units ms, is in ms; s is accepted, so multiply by 0.001"),
        ({"t": {"units": "days since 2000-01-01"}}, "is in days; s is accepted, so multiply by 86400"),
        ({"omega": {"units": "m/s"}}, "omega, with the units m/s, is in m/s; rad s-1 is accepted"),
        ({"theta": {"scale_factor": 0.5}}, "is packed, with the attribute scale_factor"),
        ({"theta": {"add_offset": np.array([1.0])}}, "is packed, with the attribute add_offset"),
        ({"theta": {"_FillValue": Y[3, 0]}}, "stands there for a missing number"),
        ({"omega": {"missing_value": Y[10, 1]}}, "stands there for a missing number"),
    ],
)
def test_what_a_dataset_says_of_its_numbers_is_heeded(attributes, says, tmp_path, capsys):
    assert says in refusal(datasets(tmp_path / "a.nc", **attributes), capsys)


def test_attributes_that_leave_the_numbers_as_they_are_do_no_harm(tmp_path, capsys):
    same = {"scale_factor": 1.0, "add_offset": 0, "_FillValue": np.nan, "units": "rad"}
    said = {"t": {"units": "seconds since 2000-01-01"}, "theta": same, "omega": {"units": np.arange(3)}}
    assert judged(datasets(tmp_path / "a.nc", **said), capsys)["worst_digits"] > 15


def test_units_among_many_attributes_are_heeded_and_too_many_bytes_of_them_refused(tmp_path, capsys):
    for notes, says in ((20, "is in ms"), (300, "has attributes of")):
        with h5py.File(tmp_path / "a.h5", "w", libver="latest") as file:
            for name, column in zip(NAMES, (T, *Y.T), strict=True):
                file[name] = column
            for i in range(notes):
                file["t"].attrs[f"note{i}"] = np.bytes_("x" * 4000)
            file["t"].attrs["units"] = "ms"
        assert says in refusal(tmp_path / "a.h5", capsys)


def test_numbers_in_another_file_are_refused_and_none_of_its_bytes_shown(tmp_path, capsys):
    datasets(tmp_path / "other.h5")
    np.array([7.25] * 11).tofile(tmp_path / "secret")
    with h5py.File(tmp_path / "raw.h5", "w") as file:
        for name in NAMES:
            file.create_dataset(name, (11,), float, external=[(str(tmp_path / "secret"), 0, 88)])
    with h5py.File(tmp_path / "virtual.h5", "w") as file:
        for name in NAMES:
            layout = h5py.VirtualLayout((11,), float)
            layout[:] = h5py.VirtualSource(str(tmp_path / "other.h5"), name, shape=(11,))
            file.create_virtual_dataset(name, layout)
    for name in ("raw.h5", "virtual.h5"):
        said = refusal(tmp_path / name, capsys)
        assert "has its numbers in another file" in said
        assert "7.25" not in said


def test_times_as_strings_are_the_doubles_they_spell_in_every_file(tmp_path, capsys):
    table = np.array([[repr(float(x)) for x in row] for row in np.column_stack([T * 11, Pendulum(1.0).state(T * 11)])])
    np.save(tmp_path / "text.npy", table)
    np.save(tmp_path / "bytes.npy", table.astype(bytes))
    np.savez(tmp_path / "text.npz", **dict(zip(NAMES, table.T, strict=True)))
    (tmp_path / "a.csv").write_text("\n".join(map(",".join, table)))
    with h5py.File(tmp_path / "text.h5", "w") as file:
        for name, column in zip(NAMES, table.T, strict=True):
            file[name] = column.tolist()
    names = ("a.csv", "text.npy", "bytes.npy", "text.npz", "text.h5")
    found = [judged(tmp_path / name, capsys) for name in names]
    assert {each["times"] for each in found} == {"binary64"}
    assert len({each["worst_digits"] for each in found}) == 1
    assert found[0]["worst_digits"] > 15
    assert judged(tmp_path / "text.npy", capsys, "--exact")["times"] == "as written"


def test_bytes_that_are_no_decimals_are_one_sentence(tmp_path, capsys):
    np.save(tmp_path / "a.npy", np.array([[b"0", b"1", b"\xff"]]))
    assert "omega has a string of bytes that is no text" in refusal(tmp_path / "a.npy", capsys)


SWAPPED = [[t, omega, theta] for t, (theta, omega) in zip(T.tolist(), Y.tolist(), strict=True)]


@pytest.mark.parametrize(
    "document",
    [
        {"header": ["t", "omega", "theta"], "data": SWAPPED},
        {"units": ["s", "rad/s", "rad"], "names": ["t", "omega", "theta"], "data": SWAPPED},
        {"t": T.tolist(), "y": {"omega": Y[:, 1].tolist(), "theta": Y[:, 0].tolist()}},
        {"run": {"omega": Y[:, 1].tolist(), "theta": Y[:, 0].tolist(), "t": T.tolist()}, "n": 3},
        {"t": T.tolist(), "theta": Y[:, 0].tolist(), "omega": Y[:, 1].tolist(), "old": {"theta": [0.0] * 11}},
    ],
)
def test_names_in_json_go_before_the_order(document, tmp_path, capsys):
    (tmp_path / "a.json").write_text(json.dumps(document))
    assert judged(tmp_path / "a.json", capsys)["worst_digits"] > 15


def test_two_arrays_of_one_name_in_json_are_not_guessed(tmp_path, capsys):
    run = {"t": T.tolist(), "theta": Y[:, 0].tolist(), "omega": Y[:, 1].tolist()}
    (tmp_path / "a.json").write_text(json.dumps({"first": run, "second": run}))
    assert "there are 2 arrays called t; one is accepted" in refusal(tmp_path / "a.json", capsys)


@pytest.mark.parametrize("rate", ["theta'", "θ'", "theta′"])
def test_a_prime_is_a_derivative_and_no_quote(rate, tmp_path, capsys):
    rows = [f"{t},{omega!r},{theta!r}" for t, omega, theta in SWAPPED]
    (tmp_path / "a.csv").write_text("\n".join([f"t,{rate},theta", *rows]), encoding="utf-8")
    assert judged(tmp_path / "a.csv", capsys)["worst_digits"] > 15
    (tmp_path / "a.csv").write_text("\n".join(["t,theta'',theta", *rows]), encoding="utf-8")
    assert "there is no column omega" in refusal(tmp_path / "a.csv", capsys)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("krad/s", Unit("rad s-1", "1000")), ("1/min", Unit("s-1", "1/60")), ("ms^-1", Unit("s-1", "1000")),
        ("rad/ms", Unit("rad s-1", "1000")), ("deg/ms", Unit("rad s-1", "pi/180*1000")), ("days", Unit("s", "86400")),
        ("deg/min", Unit("rad s-1", "pi/180/60")), ("per s", Unit("s-1", "1")),
    ],
)  # fmt: skip
def test_units_of_rates_are_known_by_their_whole(text, found, tmp_path, capsys):
    assert unit(text) == found
    if found.of != "s":
        rows = [f"{t},{theta!r},{omega!r}" for t, omega, theta in SWAPPED]
        (tmp_path / "a.csv").write_text("\n".join([f"t,theta,omega ({text})", *rows]))
        if found.factor != "1":
            said = refusal(tmp_path / "a.csv", capsys)
            assert f"so multiply by {found.factor}" in said
            assert "degrees" in said or f"is in {text};" in said
        else:
            assert judged(tmp_path / "a.csv", capsys)["rows"] == 11


def test_a_name_that_is_a_unit_as_a_whole_is_no_quotient(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("s,rad,deg/s\n0,1,0\n")
    said = refusal(tmp_path / "a.csv", capsys, "--columns", "s,rad,deg/s")
    assert "the column deg/s is in degrees; radians are accepted, so multiply by pi/180" in said


def test_the_option_that_is_suggested_has_as_many_letters_as_columns_are_needed(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("a,b\n0,1\n")
    assert "--columns A,B,C would" in refusal(tmp_path / "a.csv", capsys)
    assert main(["score", str(tmp_path / "a.csv"), "--problem", "polar", "--z0", "0.5"]) == 2
    assert "--columns A,B,C,D would" in capsys.readouterr().err


def test_one_name_for_two_columns_is_refused(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("t,theta,omega\n0,1,0\n")
    assert "names theta twice" in refusal(tmp_path / "a.csv", capsys, "--columns", "t,theta,theta")


@pytest.mark.parametrize("mark", ["-", "+", ".", ",", "-.", "−", "−1", "-0"])
def test_a_comment_is_nothing_that_a_row_may_begin_with(mark, tmp_path, capsys):
    (tmp_path / "a.csv").write_text("omega,t,theta\n0,0,1\n-2.985419968700009,0.5,0.10425842413127351\n")
    assert "what begins a comment is accepted" in refusal(tmp_path / "a.csv", capsys, f"--comment={mark}")


def test_what_cannot_be_typed_is_not_suggested_as_a_comment(tmp_path, capsys):
    (tmp_path / "a.csv").write_text("t,theta,omega\n0,1,0\n\x1a\n")
    assert "--comment" not in refusal(tmp_path / "a.csv", capsys)


def test_a_closed_standard_input_is_one_sentence(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", None)
    assert refusal(Path("-"), capsys) == "error: the standard input is closed; a table of text is accepted.\n"


@pytest.mark.parametrize("count", [3, 1100])
@pytest.mark.parametrize(("off", "digits"), [("0.0", 15.95), ("1e-08", 8), ("6.1e-17", 15.95), ("-0.003", 2.52)])
def test_at_rest_digits_are_those_on_the_scale_whatever_the_zeros_are_written_with(
    off, digits, count, tmp_path, capsys
):
    rows = [f"{n / 16},0.0,0.0" for n in range(count)]
    rows[1] = f"{1 / 16},{off},0.0"
    (tmp_path / "a.csv").write_text("\n".join(["t,theta,omega", *rows]))
    options = ["score", str(tmp_path / "a.csv"), "--theta0", "0", "--omega0", "0"]
    assert main([*options, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["worst_digits"] == pytest.approx(digits, abs=0.01)
    assert found["worst_scaled_digits"] == pytest.approx(digits, abs=0.01)
    assert main([*options, "--format", "csv"]) == 0
    assert float(capsys.readouterr().out.split("\n")[2].split(",")[4]) == pytest.approx(digits, abs=0.01)


@pytest.mark.parametrize("masks", [([1] * 11, 0), (0, np.ones((11, 2)))])
def test_masked_arrays_are_refused(masks):
    t, y = (np.ma.masked_array(each, mask) for each, mask in zip((T, Y), masks, strict=True))
    for times, states in ((t, y), (t, Y), (T, y), (T, list(y))):
        with pytest.raises(TypeError, match="is a masked array, whose elements need not be numbers"):
            score(Pendulum(1.0), times, states)


@pytest.mark.parametrize("number", [mpmath.inf, -mpmath.inf, mpmath.nan])
def test_numbers_of_mpmath_that_are_not_finite_are_named(number):
    with pytest.raises(ValueError, match=r"theta in row 1 is .*, which is not finite"):
        score(Pendulum(1.0), [0], [[number, 0]])
