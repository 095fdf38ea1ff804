"""``python -m compare score FILE``: files that are damaged or made to do harm are one sentence with their name."""

from __future__ import annotations

import io
import json
import os
import random
import struct
import subprocess
import sys
import zipfile
from pathlib import Path

import h5py
import numpy as np
import pytest

import compare
from compare.__main__ import main
from compare.files.columns import Columns
from compare.files.score import Rows
from reference import Pendulum

T = np.arange(0, 40) / 10
Y = Pendulum(1.0).state(T)
TABLE = np.column_stack([T, Y])
FIELDS = [("t", float), ("theta", float), ("omega", float)]
COLUMNS = {"t": T, "theta": Y[:, 0], "omega": Y[:, 1]}


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def npz(arrays: dict, *, packed: bool = False) -> bytes:
    file = io.BytesIO()
    (np.savez_compressed if packed else np.savez)(file, **arrays)
    return file.getvalue()


def hdf5(arrays: dict, **options) -> bytes:
    file = io.BytesIO()
    with h5py.File(file, "w") as opened:
        for name, array in arrays.items():
            opened.create_dataset(name, data=array, **options)
    return file.getvalue()


def hdf5_with_heap(arrays: dict) -> bytes:
    """Numbers as strings of variable length, and units, all in a global heap: the file's last part by far."""
    file = io.BytesIO()
    with h5py.File(file, "w") as opened:
        for name, array in arrays.items():
            opened[name] = [repr(x) for x in array.tolist()]
            opened[name].attrs["units"] = {"t": "s", "theta": "rad", "omega": "rad s-1"}[name]
    return file.getvalue()


def text(separator: str = ",") -> bytes:
    rows = [separator.join(map(repr, row)) for row in TABLE.tolist()]
    return "\n".join([separator.join(COLUMNS), *rows, ""]).encode()


RECORDS = np.array(list(map(tuple, TABLE.tolist())), dtype=FIELDS)
WHOLE = {
    ".npy": [npy(TABLE), npy(RECORDS), npy(np.array([[repr(x) for x in row] for row in TABLE.tolist()]))],
    ".npz": [
        npz(COLUMNS),
        npz(COLUMNS, packed=True),
        npz({"t": T, "y": Y}),
        npz({"t": T, "y": np.asfortranarray(Y.T)}, packed=True),
    ],
    ".h5": [
        hdf5(COLUMNS),
        hdf5({"run/t": T, "run/y": Y}),
        hdf5(COLUMNS, chunks=(8,), compression="gzip"),
        hdf5({"run": RECORDS}),
        hdf5_with_heap(COLUMNS),
    ],
    ".csv": [
        text(),
        text(";").replace(b".", b","),
        text("\t").decode().encode("utf-16"),
        text(" "),
        "".join(json.dumps(dict(zip(COLUMNS, row, strict=True))) + "\n" for row in TABLE.tolist()).encode(),
        json.dumps({"t": T.tolist(), "y": Y.T.tolist()}).encode(),
        ("| t | theta | omega |\n|---|---|---|\n" + "".join(f"| {a} | {b} | {c} |\n" for a, b, c in TABLE)).encode(),
        ("t,theta,omega\n" + "".join(",".join(map(float.hex, row)) + "\n" for row in TABLE.tolist())).encode(),
    ],
}
HEADS = {".npy": 128, ".npz": 200, ".h5": 2048, ".csv": 40}
"""Bytes at the beginning that declare what follows."""


def mutant(source: random.Random, whole: bytes, head: int) -> bytes:
    data = bytearray(whole)
    for _ in range(source.choice([1, 1, 1, 2, 4])):
        if not data:
            break
        at = source.randrange(len(data) if source.random() < 0.6 else min(len(data), head))
        kind = source.randrange(7)
        if kind == 0:
            data[at] ^= 1 << source.randrange(8)
        elif kind == 1:
            del data[at:]
        elif kind == 2:
            data[at:at] = source.randbytes(source.randrange(1, 20))
        elif kind == 3:
            data[at:at] = data[at : at + source.randrange(1, 60)]
        elif kind == 4:
            del data[at : at + source.randrange(1, 40)]
        elif kind == 5:
            data[at] = source.choice(b"0123456789-+.,;()[]{}'\" \n\0\xff<>|OUSV")
        else:
            other, length = source.randrange(len(data)), source.randrange(1, 40)
            one, two = data[at : at + length], data[other : other + length]
            data[other : other + length], data[at : at + length] = one, two
    return bytes(data)


@pytest.mark.parametrize("suffix", WHOLE)
def test_of_hundreds_of_damaged_files_each_is_read_whole_or_refused_in_one_sentence(suffix, tmp_path):
    source, path = random.Random(20), tmp_path / f"a{suffix}"
    refused = 0
    for count in range(300):
        whole = WHOLE[suffix][count % len(WHOLE[suffix])]
        path.write_bytes(mutant(source, whole, HEADS[suffix]))
        try:
            rows = [
                row
                for chunk in Rows(str(path), Columns(("t", "theta", "omega")), as_written=False).chunks(16)
                for row in chunk.rows()
            ]
        except ValueError as error:
            said = str(error)
            assert said.endswith("."), said
            assert said.isprintable(), said
            assert len(said) < 1500
            refused += 1
        else:
            assert suffix == ".csv" or len(rows) == 40
    assert 150 < refused < 300


@pytest.mark.parametrize("suffix", WHOLE)
def test_what_is_not_damaged_is_read(suffix, tmp_path, capsys):
    for whole in WHOLE[suffix]:
        (tmp_path / f"a{suffix}").write_bytes(whole)
        assert main(["score", str(tmp_path / f"a{suffix}"), "--theta0", "1", "--format", "json"]) == 0
        assert json.loads(capsys.readouterr().out)["rows"] == 40


def heap_mutant(source: random.Random, whole: bytes) -> bytes:
    """Other bytes in the header of an object of a global heap."""
    data = bytearray(whole)
    begin = data.index(b"GCOL")
    heads, at = [], begin + 16
    while data[at]:
        heads.append(at)
        at += 16 + -(-data[at + 8] // 8) * 8
    for _ in range(source.choice([1, 1, 2])):
        place = source.choice([*heads, at]) + source.choice([0, 1, 8, 8, 8, 9, 14, 15])
        data[place] = source.choice([0, 1, 7, 8, 15, 16, 0x7F, 0xF8, 0xFF])
    return bytes(data)


def test_heaps_over_which_hdf5_goes_round_for_ever_are_refused(tmp_path):
    """In a process of its own, which the clock ends: HDF5 hears no signal meanwhile."""
    source, whole = random.Random(21), hdf5_with_heap(COLUMNS)
    for count in range(200):
        (tmp_path / f"{count}.h5").write_bytes(heap_mutant(source, whole))
    code = (
        "import sys\n"
        "from compare.__main__ import main\n"
        "for count in range(200):\n"
        "    print(main(['score', f'{count}.h5', '--theta0', '1', '--format', 'json']), file=sys.stderr)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(Path(compare.__file__).parents[1])},
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    said = done.stderr.splitlines()
    refused = [line for line in said if line.startswith("error: ")]
    assert len(said) == 200 + len(refused)
    assert all(line.endswith(".") for line in refused)
    assert sum("has a damaged global heap at its byte" in line for line in refused) > 50


def header(shape: str, kind: str = "'<f8'", *, order: str = "False", version: bytes = b"\x01\x00") -> bytes:
    said = f"{{'descr': {kind}, 'fortran_order': {order}, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY" + version + struct.pack("<H" if version == b"\x01\x00" else "<I", len(said)) + said


BYTES = TABLE.tobytes()
NPY = {
    "a shape of more": (
        header("(41, 3)") + BYTES,
        "declares an array of shape (41, 3), which takes 984 bytes, and has 960",
    ),
    "a shape of fewer": (
        header("(39, 3)") + BYTES,
        "declares an array of shape (39, 3), which takes 936 bytes, and has 960",
    ),
    "a shape of very many": (header("(10**30, 3)") + BYTES, "which NumPy cannot read as an array of numbers"),
    "a shape beyond any disk": (header(f"({10**30}, 3)") + BYTES, "declares an array of shape (1000"),
    "a shape below zero": (
        header("(-40, -3)") + BYTES,
        "declares the shape (-40, -3); lengths of 0 and more are accepted",
    ),
    "a shape of truths": (header("(True, 3)") + BYTES[:24], "declares the shape (True, 3); lengths of 0 and more are"),
    "numbers of no bytes": (header("(40, 3)", "'<U0'"), "declares numbers of 0 bytes each"),
    "numbers of a megabyte": (
        header("(1, 3)", "'<U262144'") + bytes(3 << 20),
        "declares numbers of 1048576 bytes each",
    ),
    "Python objects": (header("(40, 3)", "'|O'") + BYTES, "is an array of Python objects"),
    "nothing": (b"", "which NumPy cannot read"),
    "a header alone": (header("(40, 3)"), "which takes 960 bytes, and has 0 bytes of numbers"),
    "half a header": (header("(40, 3)")[:30], "which NumPy cannot read"),
    "an open bracket": (header("((40, 3)") + BYTES, "which NumPy cannot read"),
    "brackets in brackets": (header("(" * 5000) + BYTES, "which NumPy cannot read"),
    "a header too long": (header("(40, 3)" + " " * 60_000, version=b"\x02\x00") + BYTES, "which NumPy cannot read"),
    "a version to come": (header("(40, 3)", version=b"\x09\x00") + BYTES, "which NumPy cannot read"),
    "a kind of no numbers": (header("(40, 3)", "'<M8[D]'") + BYTES, "t is an array of datetime64[D]; real numbers or"),
    "a kind that is none": (header("(40, 3)", "'<q99'") + BYTES, "which NumPy cannot read"),
    "a kind of keys": (header("(40, 3)", "{(): []}") + BYTES, "which NumPy cannot read"),
    "a letter of Python 2": (header("(40L, 3L)") + BYTES[:-1], "which takes 960 bytes, and has 959"),
    "letters that are none": (
        header("(40, 3)", "'<U2'") + BYTES,
        "has a string that is no text; decimals such as '0.5'",
    ),
}


@pytest.mark.parametrize("kind", NPY)
def test_an_npy_file_that_declares_what_it_is_not_is_one_sentence(kind, tmp_path, capsys):
    content, says = NPY[kind]
    refused(tmp_path / "a.npy", content, says, capsys)


def test_a_header_of_python_2_is_read(tmp_path, capsys):
    (tmp_path / "a.npy").write_bytes(header("(40L, 3L)") + BYTES)
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1"]) == 0
    assert capsys.readouterr().err == ""


def test_names_beyond_latin_letters_are_read(tmp_path, capsys):
    with pytest.warns(UserWarning, match="format 3.0"):
        np.save(tmp_path / "a.npy", RECORDS.view([("čas", float), ("úhel", float), ("rychlost ω", float)]))
    options = ["--columns", "čas,úhel,rychlost ω", "--format", "json"]
    assert main(["score", str(tmp_path / "a.npy"), "--theta0", "1", *options]) == 0
    assert json.loads(capsys.readouterr().out)["rows"] == 40


def refused(path, content: bytes, says: str, capsys, *options: str) -> None:
    path.write_bytes(content)
    assert main(["score", str(path), "--theta0", "1", *options]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith("error: ")
    assert err.removesuffix("\n").isprintable()
    assert says in err


def archive(members: dict[str, bytes], method: int = zipfile.ZIP_STORED) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", method) as opened:
        for name, content in members.items():
            opened.writestr(name, content)
    return file.getvalue()


MEMBERS = {f"{name}.npy": npy(np.ascontiguousarray(column)) for name, column in COLUMNS.items()}


def declared(content: bytes, old: int, new: int) -> bytes:
    """An archive whose directory, and local headers, declare another size of each member that has the old one."""
    return content.replace(struct.pack("<I", old), struct.pack("<I", new))


SIZE = len(MEMBERS["t.npy"])
STORED, DEFLATED = archive(MEMBERS), archive(MEMBERS, zipfile.ZIP_DEFLATED)
FEWER = {**MEMBERS, "t.npy": header("(39,)") + T.tobytes()}
NPZ = {
    "an array of fewer rows than bytes": (archive(FEWER), "declares an array of shape (39,), which takes 312 bytes,"),
    "arrays of more rows than bytes": (
        archive({f"{name}.npy": header("(41,)") + column.tobytes() for name, column in COLUMNS.items()}),
        "declares an array of shape (41,), which takes 328 bytes, and has 320",
    ),
    "members that declare more than the archive has": (declared(DEFLATED, SIZE, SIZE * 5000), "declares 2240000 bytes"),
    "members that declare a little more": (declared(DEFLATED, SIZE, SIZE + 8), "declares an array of shape (40,)"),
    "members that declare a little less": (declared(DEFLATED, SIZE, SIZE - 8), "in its array t.npy: Bad CRC-32"),
    "a password": (STORED.replace(b"PK\x01\x02\x14\x03\x14\x00\x00", b"PK\x01\x02\x14\x03\x14\x00\x01"), "encrypted"),
    "another packing": (archive(MEMBERS, zipfile.ZIP_BZIP2), "packed by method 12; stored and deflated ones"),
    "a changed number": (STORED.replace(T[7:9].tobytes(), T[7:8].tobytes() + T[9:10].tobytes()), "Bad CRC-32 for file"),
    "an end that is cut off": (STORED[:-40], "File is not a zip file"),
    "a beginning that is cut off": (STORED[200:], "zipfile says"),
    "a hole in the packed bytes": (DEFLATED[:90] + bytes(20) + DEFLATED[110:], "zipfile says in its array t"),
    "a name twice": (archive({**MEMBERS, "t": MEMBERS["t.npy"]}), "holds 2 arrays called t; one of"),
    "an array of Python objects": (archive({**MEMBERS, "t.npy": header("(40,)", "'|O'") + T.tobytes()}), "of Python"),
    "a text instead of an array": (archive({**MEMBERS, "t.npy": b"0,1,2"}), "NumPy cannot read"),
}  # fmt: skip


@pytest.mark.parametrize("kind", NPZ)
def test_an_archive_that_is_not_what_it_declares_is_one_sentence(kind, tmp_path, capsys):
    content, says = NPZ[kind]
    refused(tmp_path / "a.npz", content, says, capsys)


def test_a_changed_number_in_a_column_by_columns_is_found_by_the_checksum(tmp_path, capsys):
    """The states are read by the first axis alone, and all of the array is held against its checksum."""
    content = npz({"t": T, "y": np.asfortranarray(Y)})
    at = content.rindex(Y[39, 0].tobytes())
    changed = bytearray(content)
    changed[at] ^= 1
    refused(tmp_path / "a.npz", bytes(changed), "Bad CRC-32 for file 'y.npy'", capsys)


def test_what_nobody_asked_for_may_be_of_any_kind(tmp_path, capsys):
    others = {"note.txt": b"ours", "odd.npy": b"\x93NUMPYx", "folder/": b"", "o.npy": header("(1,)", "'|O'") + bytes(8)}
    (tmp_path / "a.npz").write_bytes(archive({**others, **MEMBERS}))
    assert main(["score", str(tmp_path / "a.npz"), "--theta0", "1", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["rows"] == 40


def test_arrays_that_are_together_larger_than_what_is_unpacked_are_one_sentence(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("compare.files.npz.MOST_BYTES", 3 * SIZE - 1)
    says = f"declares {SIZE} bytes of omega.npy, which with the other columns is more than the {3 * SIZE - 1}"
    refused(tmp_path / "a.npz", DEFLATED, says, capsys)


def test_a_chunk_of_a_gigabyte_is_refused_before_it_is_unpacked(tmp_path, capsys):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name in COLUMNS:
            file.create_dataset(name, shape=(1 << 27,), dtype=float, chunks=(1 << 27,), compression="gzip")
    content = (tmp_path / "a.h5").read_bytes()
    refused(tmp_path / "a.h5", content, "has numbers of 8 bytes in chunks of 1073741824; 16384 and 67108864", capsys)


def test_what_hdf5_says_of_a_damaged_file_has_the_files_name(tmp_path, capsys):
    whole = hdf5(COLUMNS)
    at = whole.index(b"TREE")
    refused(tmp_path / "a.h5", whole[:at] + b"EERT" + whole[at + 4 :], "a.h5' cannot be read: HDF5 says: ", capsys)
    packed = hdf5(COLUMNS, chunks=(8,), compression="gzip")
    at = packed.rindex(b"x\x5e")
    refused(tmp_path / "a.h5", packed[:at] + bytes(8) + packed[at + 8 :], "cannot be read: HDF5 says in its", capsys)


def test_a_dataset_that_declares_fewer_rows_than_it_holds_is_refused(tmp_path, capsys):
    whole = hdf5({"run": RECORDS})
    shape = struct.pack("<Q", 40)
    assert whole.count(shape * 2) == 1  # the shape, and the largest that it may have
    changed = whole.replace(shape * 2, struct.pack("<Q", 39) * 2)
    refused(tmp_path / "a.h5", changed, "declares 936 bytes of numbers and holds 960; as many as are", capsys)


def test_a_dataset_of_a_kind_that_numpy_has_not_is_no_column(tmp_path, capsys):
    file = io.BytesIO()
    with h5py.File(file, "w") as opened:
        for name, column in COLUMNS.items():
            opened[name] = column
        space = h5py.h5s.create_simple((4,))
        h5py.h5d.create(opened.id, b"bits", h5py.h5t.STD_B8LE, space)
    (tmp_path / "a.h5").write_bytes(file.getvalue())
    assert main(["score", str(tmp_path / "a.h5"), "--theta0", "1"]) == 0
    assert capsys.readouterr().err == ""
