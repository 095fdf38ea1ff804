"""What loading refuses: whatever is not, byte for byte and object for object, a dataset."""

from __future__ import annotations

import h5py
import numpy as np
import pytest
from plans import TINY

from reference.dataset.build import build
from reference.dataset.checksums import note_checksum
from reference.dataset.errors import DatasetError
from reference.dataset.files import sha256
from reference.dataset.reader import load
from reference.dataset.schema import exact_texts


def refused(path, *words):
    with pytest.raises(DatasetError) as caught:
        load(path)
    message = str(caught.value)
    assert "\n" not in message
    assert message.endswith(".")
    for word in (str(path), *words):
        assert word in message


@pytest.mark.parametrize("kept", [0, 1, 8, 100, 0.5, 0.999])
def test_a_truncated_file_is_refused(copy, kept):
    data = copy.read_bytes()
    copy.write_bytes(data[: int(kept * len(data)) if isinstance(kept, float) else kept])
    refused(copy)


def test_a_file_that_differs_from_its_checksum_is_refused_before_hdf5_sees_it(copy):
    note_checksum(copy, sha256(copy))
    load(copy)
    data = bytearray(copy.read_bytes())
    data[len(data) // 2] ^= 1
    copy.write_bytes(data)
    refused(copy, "SHA256SUMS")


def test_a_damaged_list_of_checksums_is_refused(copy):
    (copy.parent / "SHA256SUMS").write_text("no checksum\n")
    with pytest.raises(DatasetError, match=r"SHA256SUMS"):
        load(copy)


def test_no_flipped_bit_changes_a_number_unnoticed(tmp_path):
    """Without a checksum beside the file: 150 places through the whole of a tiny one."""
    copy = tmp_path / "tiny.h5"
    build(TINY, copy, jobs=1)
    (tmp_path / "SHA256SUMS").unlink(missing_ok=True)
    before = {name: (variable.value, variable.tail) for name, variable in load(copy).items()}
    data = copy.read_bytes()
    noticed = 0
    for position in range(7, len(data), len(data) // 150):
        altered = bytearray(data)
        altered[position] ^= 1 << (position % 8)
        copy.write_bytes(altered)
        try:
            found = load(copy)
        except DatasetError:
            noticed += 1
            continue
        assert set(found) == set(before)
        for name, (value, tail) in before.items():
            assert np.array_equal(found[name].value, value)
            assert np.array_equal(found[name].tail, tail)
    assert noticed > 30


def test_no_flipped_bit_in_the_lists_of_scales_makes_loading_hang(copy):
    """HDF5 keeps these lists without a checksum, and loops on some flips; loading must not follow them."""
    data = copy.read_bytes()
    start = data.index(b"GCOL")
    fingerprint = load(copy).fingerprint
    for position in range(start, start + 640, 8):
        altered = bytearray(data)
        altered[position] ^= 1 << 5
        copy.write_bytes(altered)
        assert load(copy).fingerprint == fingerprint


@pytest.mark.parametrize("content", [b"", b"not a dataset\n", b"\x89HDF\r\n\x1a\n", b"\x89HDF\r\n\x1a\n" + bytes(4096)])
def test_what_is_no_dataset_is_refused(tmp_path, content):
    path = tmp_path / "x.h5"
    path.write_bytes(content)
    refused(path)


def test_a_folder_is_refused(tmp_path):
    refused(tmp_path, "folder")


def test_a_missing_file_is_a_file_not_found_error(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"does not exist"):
        load(tmp_path / "missing.h5")


def say(target, name, text):
    target.attrs.create(name, text.encode(), dtype=h5py.string_dtype("utf-8", len(text.encode())))


def other_schema(file):
    file.attrs["schema_version"] = np.bytes_("0")
    return "/", "attribute"


def no_schema(file):
    del file.attrs["schema_version"]
    return "schema_version", "no attribute"


def soft_link(file):
    group = file["pendulum/libration"]
    group.move("theta", "theta2")
    group["theta"] = h5py.SoftLink("/pendulum/libration/theta2")
    return "/pendulum/libration", "members"


def only_soft_link(file):
    file.move("provenance", "pendulum/libration/theta_tail2")
    file["provenance"] = h5py.SoftLink("/limb")
    del file["pendulum/libration/theta_tail2"]
    return "/provenance", "only hard links"


def external_link(file):
    del file["provenance"]
    file["provenance"] = h5py.ExternalLink("/etc/passwd", "/")
    return "/provenance", "only hard links"


def alias(file):
    group = file["pendulum/libration"]
    del group["omega"]
    group["omega"] = group["theta"]
    return "/pendulum/libration/omega", "same object"


def replaced(file, **kwargs):
    group = file["pendulum/libration"]
    values = group["period"][...]
    attributes = {name: group["period"].attrs.get_id(name) for name in ("units", "definition", "long_name")}
    texts = {name: group["period"].attrs[name] for name in attributes}
    del group["period"]
    made = group.create_dataset("period", **{"data": values, "chunks": (2,), "fletcher32": True, **kwargs})
    for name, text in texts.items():
        made.attrs.create(name, text, dtype=h5py.string_dtype("utf-8", len(text)))
    made.dims[0].attach_scale(group["amplitude"])
    return made


def gzip(file):
    replaced(file, compression="gzip")
    return "/pendulum/libration/period", "filters"


def contiguous(file):
    replaced(file, chunks=None, fletcher32=None)
    return "/pendulum/libration/period", "chunks"


def external_storage(file):
    replaced(
        file, chunks=None, fletcher32=None, external=[("/etc/hostname", 0, 16)], data=None, shape=(2,), dtype="<f8"
    )
    return "/pendulum/libration/period", "chunks"


def single_precision(file):
    replaced(file, dtype="<f4")
    return "/pendulum/libration/period", "float64"


def huge(file):
    replaced(file, data=None, shape=(1 << 40,), dtype="<f8", chunks=(1 << 20,))
    return "/pendulum/libration/period", "impossible shape"


def unlimited(file):
    replaced(file, maxshape=(None,))
    return "/pendulum/libration/period", "impossible shape"


def missing_chunk(file):
    replaced(file, data=None, shape=(2,), dtype="<f8")
    return "/pendulum/libration/period", "chunks"


def not_finite(file):
    file["pendulum/libration/period"][0] = np.nan
    return "/pendulum/libration/period", "finite"


def other_number(file):
    number = file["pendulum/libration/period"][0]
    file["pendulum/libration/period"][0] = np.nextafter(number, 9.0)
    return ("fingerprint",)


def other_parameter(file):
    group = file["pendulum/libration"]
    group.attrs.modify("g", np.float64(9.8))
    say(group, "g_decimal", "9.8")
    say(group, "g_hex", (9.8).hex())
    return ("fingerprint",)


def missing_variable(file):
    del file["pendulum/libration/energy_tail"]
    return "/pendulum/libration/energy_tail", "missing"


def unknown_variable(file):
    del file["pendulum/libration/energy_tail"]
    file["pendulum/libration"].create_dataset("mass", data=[1.0])
    return "/pendulum/libration", "mass"


def unknown_group(file):
    file.create_group("pendulum/pendulums")
    return "/pendulum", "pendulums"


def group_for_a_variable(file):
    del file["pendulum/libration/energy"]
    file.create_group("pendulum/libration/energy")
    return "/pendulum/libration/energy", "not a dataset"


def other_units(file):
    attributes = file["pendulum/libration/period"].attrs
    attributes.create("units", b"h", dtype=h5py.string_dtype("utf-8", 1))
    return "/pendulum/libration/period", "units"


def no_scale(file):
    group = file["pendulum/libration"]
    group["period"].dims[0].detach_scale(group["amplitude"])
    return "/pendulum/libration/period", "dimension scales"


def variable_length_text(file):
    file["pendulum/libration"].attrs["long_name"] = "variable length"
    return "/pendulum/libration", "'long_name' of an unexpected type or size"


def other_chunks(file):
    replaced(file, chunks=(1,))
    return "/pendulum/libration/period", "chunks of the shape (1,), not the schema's"


def falling_after_rising(file):
    time = file["pendulum/libration/time"]
    time[1] = 5.0
    for name, text in exact_texts(time[...].tolist()).items():
        say(time, name, text)
    return "/pendulum/libration/time", "neither rise nor fall"


def negative_zero(file):
    file["pendulum/libration/omega"][0, 0] = -0.0
    return "/pendulum/libration/omega", "-0.0"


TAMPERINGS = (
    other_schema,
    no_schema,
    soft_link,
    only_soft_link,
    external_link,
    alias,
    gzip,
    contiguous,
    external_storage,
    single_precision,
    huge,
    unlimited,
    missing_chunk,
    not_finite,
    other_number,
    other_parameter,
    missing_variable,
    unknown_variable,
    unknown_group,
    group_for_a_variable,
    other_units,
    no_scale,
    variable_length_text,
    other_chunks,
    falling_after_rising,
    negative_zero,
)


@pytest.mark.parametrize("tampering", TAMPERINGS, ids=lambda tampering: tampering.__name__)
def test_what_is_not_of_the_schema_is_refused_by_name(copy, tampering):
    with h5py.File(copy, "r+", libver=("v110", "v110")) as file:
        words = tampering(file)
    refused(copy, *words)


def test_another_schema_version_is_refused_with_both_versions_named(copy):
    with h5py.File(copy, "r+", libver=("v110", "v110")) as file:
        file.attrs.create("schema_version", b"99", dtype=h5py.string_dtype("utf-8", 2))
    refused(copy, "'99'", "'1', '2', '3', '4' are read")


@pytest.mark.parametrize(
    ("path", "name", "text"),
    [
        ("/", "license", "CC0-1.0"),
        ("/", "inputs", "exact decimals"),
        ("/", "Conventions", "CF-1.0"),
        ("/", "creators", "Somebody Else"),
        ("/", "command", "python -m reference build --profile full"),
        ("/", "history", "by hand"),
        ("/", "note", "not of the schema"),
        ("/pendulum", "note", "not of the schema"),
        ("/pendulum/libration", "decimal", "9.81"),
        ("/pendulum/libration/theta_tail", "taylor_digits", "60"),
        ("/pendulum/libration/theta", "flag_meanings", "a b"),
        ("/pendulum/libration", "g_decimal", "9.82"),
        ("/pendulum/libration", "g_hex", "0x1.0p+3"),
        ("/pendulum/libration", "g_units", "ft s-2"),
        ("/pendulum/libration", "parameters", "length g"),
        ("/pendulum/libration", "long_name", "pendulum"),
        ("/pendulum/libration/amplitude", "decimal", "0.5 2.1"),
        ("/pendulum/libration/amplitude", "hex", "0x1.0000000000000p-1 0x1.0000000000001p+1"),
        ("/pendulum/libration/event", "decimal", "0 1"),
        ("/pendulum/libration/period", "definition", "T = 2 pi sqrt(l/g)"),
        ("/pendulum/libration/period", "reference", "hearsay"),
        ("/limb", "definition", "x = value - tail[0]"),
    ],
)
def test_an_attribute_that_says_something_else_than_schema_or_numbers_is_refused(copy, path, name, text):
    with h5py.File(copy, "r+", libver=("v110", "v110")) as file:
        say(file[path], name, text)
    refused(copy, f"{path} has the attribute '{name}'")


@pytest.mark.parametrize(
    ("path", "name", "text", "words"),
    [
        ("/", "version", "99.0", "is of version '99.0'; 0.1.0 is known"),
        ("/", "version", "99.0.0", "is of version '99.0.0'; 0.1.0 is known"),
        ("/", "version", "\x1b[31m0.1.0", "is of version '\\x1b[31m0.1.0'"),
        ("/", "profile", "cor", "has the profile 'cor'"),
        ("/", "profile", "a\u202e.toml", "has the profile 'a\\u202e.toml'"),
        ("/", "profile", "x" * 300 + ".toml", "has the profile 'xxxxx"),
        ("/", "fingerprint", "0" * 63, "'fingerprint' of 64 hexadecimal digits"),
        ("/provenance", "date", "yesterday", "has the date 'yesterday'"),
        ("/provenance", "cpu", "\x9b2J", "'cpu', which is not one line of text"),
        ("/provenance", "cpu", "two\nlines", "'cpu', which is not one line of text"),
        ("/provenance", "c\u200bpu", "x", "'c\\u200bpu'; names of small letters"),
    ],
)
def test_what_a_file_says_freely_has_its_form(copy, path, name, text, words):
    with h5py.File(copy, "r+", libver=("v110", "v110")) as file:
        say(file[path], name, text)
    refused(copy, f": {path} ", words)


@pytest.mark.parametrize(("path", "name"), [("/", "license"), ("/pendulum/libration", "g_units")])
def test_a_missing_attribute_is_refused(copy, path, name):
    with h5py.File(copy, "r+", libver=("v110", "v110")) as file:
        del file[path].attrs[name]
    refused(copy, f"{path} has no attribute '{name}'")


def test_an_empty_path_is_said_to_be_empty():
    with pytest.raises(FileNotFoundError, match=r"^the path is empty; the path of a dataset is accepted\.$"):
        load("")
