"""Files made to cost memory, time or the terminal: each is refused in one sentence, within a few megabytes.

They are made with HDF5's own functions, since those that are kind to users would not make them.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys

import h5py
import numpy as np
import pytest
from h5py import h5a, h5g, h5p, h5s, h5t

from reference.dataset.errors import DatasetError
from reference.dataset.plan import Plan
from reference.names import printable

MUCH = 64 << 20
"""Bytes: more than a refusal may take."""
ALLOWED = 32 << 20
CHILD = """
import json, resource, sys
import reference
reference.load(sys.argv[2])  # whatever loading imports is there before the limit
used = next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmSize:")) << 10
resource.setrlimit(resource.RLIMIT_AS, (used + int(sys.argv[1]),) * 2)
for path in sys.argv[3:]:
    try:
        reference.load(path)
        print(json.dumps("accepted"))
    except ValueError as error:
        print(json.dumps(str(error)))
"""


def give(target, name, kind, data, shape=None):
    """Give an object an attribute of any name and type, in place of what it has."""
    data = np.asarray(data)
    if h5a.exists(target.id, name):
        h5a.delete(target.id, name)
    space = h5s.create(h5s.SCALAR) if data.shape == () and shape is None else h5s.create_simple(shape or data.shape)
    in_memory = kind if isinstance(kind, h5t.TypeStringID) else None
    h5a.create(target.id, name, kind, space).write(data, mtype=in_memory)


def text_type(length):
    kind = h5t.C_S1.copy()
    kind.set_size(length)
    kind.set_cset(h5t.CSET_UTF8)
    return kind


def list_of_users(scale, dataset, count):
    """HDF5's list of a scale's users, made longer: its type and its entries."""
    entries = np.repeat(scale.attrs["REFERENCE_LIST"][:1], count)
    entries[entries.dtype.names[0]] = dataset.ref if dataset else h5py.Reference()
    return h5a.open(scale.id, b"REFERENCE_LIST").get_type(), entries


def attribute_of_no_utf8(file):
    give(file["pendulum/libration/period"], b"n\xff\x1b[2Jte", h5t.IEEE_F64LE, 1.0)
    return "/pendulum/libration/period has the attribute 'n\\xff\\x1b[2Jte', whose name is not in UTF-8"


def attribute_of_no_utf8_at_the_root(file):
    give(file, b"\xc3", h5t.IEEE_F64LE, 1.0)
    return "/ has the attribute '\\xc3', whose name is not in UTF-8"


def group_of_no_utf8(file):
    h5g.create(file["pendulum"].id, b"libr\xe4tion")
    return "/pendulum has a member that is not in the schema: name 'libr\\xe4tion' is unknown"


def group_that_reverses_its_name(file):
    h5g.create(file["pendulum"].id, "\u202egnol".encode())
    return "/pendulum has a member that is not in the schema: name '\\u202egnol' is unknown"


def dataset_of_no_utf8(file):
    group = file["pendulum/libration"].id
    group.move(b"energy", b"energ\xff")
    return "/pendulum/libration has a member that is not in the schema: name 'energ\\xff' is unknown"


def text_of_no_utf8(file):
    give(file["pendulum/libration/period"], b"units", text_type(2), np.array(b"s\xff", dtype="S2"))
    return "/pendulum/libration/period has the attribute 'units', which is no text in UTF-8"


def dimid_of_text(file):
    give(file["pendulum/libration/time"], b"_Netcdf4Dimid", text_type(3), np.array(b"two", dtype="S3"))
    return "/pendulum/libration/time has the attribute '_Netcdf4Dimid', which is not as HDF5 or netCDF-4 writes it"


def huge_dimid(file):
    give(file["pendulum/libration/time"], b"_Netcdf4Dimid", h5t.STD_I8LE, np.zeros(MUCH, "i1"))
    return "/pendulum/libration/time has attributes of"


def huge_class(file):
    give(file["pendulum/libration/time"], b"CLASS", text_type(MUCH), np.array(b"x", dtype=f"S{MUCH}"))
    return "/pendulum/libration/time has attributes of"


def huge_list_of_scales(file):
    give(file["pendulum/libration/period"], b"DIMENSION_LIST", h5t.STD_I8LE, np.zeros(MUCH, "i1"))
    return "/pendulum/libration/period has attributes of"


def list_of_scales_that_is_none(file):
    give(file["pendulum/libration/period"], b"DIMENSION_LIST", h5t.STD_I32LE, np.zeros(1, "<i4"))
    return "'DIMENSION_LIST', which is not as HDF5"


def half_a_million_users(file):
    give(file["limb"], b"REFERENCE_LIST", *list_of_users(file["limb"], file["pendulum/libration/theta"], 500_000))
    return "/limb has attributes of"


def more_users_than_datasets(file):
    give(file["limb"], b"REFERENCE_LIST", *list_of_users(file["limb"], file["pendulum/libration/theta"], 3_999))
    return "/limb is the scale of an axis that is not there"


def users_that_are_numbers(file):
    give(file["limb"], b"REFERENCE_LIST", h5t.STD_I32LE, np.zeros(4, "<i4"))
    return "'REFERENCE_LIST', which is not as HDF5"


def user_that_is_nowhere(file):
    give(file["limb"], b"REFERENCE_LIST", *list_of_users(file["limb"], None, 1))
    return "is truncated or damaged"


def huge_text_elsewhere(file):
    """A text of variable length is a pointer to anywhere in the file."""
    file.attrs["schema_version"] = "3" * MUCH
    return "/ has the attribute 'schema_version' of an unexpected type or size"


def huge_units(file):
    file["pendulum/libration/period"].attrs["units"] = "s" * MUCH
    return "/pendulum/libration/period has the attribute 'units' of an unexpected type or size"


def huge_parameters(file):
    file["pendulum/libration"].attrs["parameters"] = "g " * MUCH
    return "/pendulum/libration has the attribute 'parameters' of an unexpected type or size"


def huge_header(file):
    """Attributes in the object's header itself, which has no limit on them together."""
    del file["provenance"]
    properties = h5p.create(h5p.GROUP_CREATE)
    properties.set_attr_phase_change(65_535, 0)
    h5g.create(file.id, b"provenance", gcpl=properties)
    for i in range(200):
        give(file["provenance"], b"a%d" % i, h5t.STD_I8LE, np.zeros(60_000, "i1"))
    return "/provenance has a header of"


def many_attributes(file):
    for i in range(300):
        give(file["pendulum/libration/period"], b"a%d" % i, h5t.STD_I32LE, np.int32(i))
    return "/pendulum/libration/period has "


def many_members(file):
    for i in range(300):
        h5g.create(file["pendulum"].id, b"g%d" % i)
    return "/pendulum has 301 members where the schema has at most"


def long_names(file):
    for i in range(3):
        h5g.create(file["pendulum"].id, b"%d" % i + b"n" * (1 << 20))
    return "/pendulum has links of"


FILES = (
    attribute_of_no_utf8,
    attribute_of_no_utf8_at_the_root,
    group_of_no_utf8,
    group_that_reverses_its_name,
    dataset_of_no_utf8,
    text_of_no_utf8,
    dimid_of_text,
    huge_dimid,
    huge_class,
    huge_list_of_scales,
    list_of_scales_that_is_none,
    half_a_million_users,
    more_users_than_datasets,
    users_that_are_numbers,
    user_that_is_nowhere,
    huge_text_elsewhere,
    huge_units,
    huge_parameters,
    huge_header,
    many_attributes,
    many_members,
    long_names,
)


@pytest.fixture(scope="module")
def said(built, tmp_path_factory):
    """What loading says of each file, in one process that may take little more memory than a sound file takes."""
    folder = tmp_path_factory.mktemp("hostile")
    expected, paths = {}, []
    for make in FILES:
        path = folder / f"{make.__name__}.h5"
        shutil.copy(built, path)
        with h5py.File(path, "r+", libver=("v110", "v110")) as file:
            expected[make.__name__] = make(file)
        paths.append(str(path))
    command = [sys.executable, "-c", CHILD, str(ALLOWED), str(built), *paths]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    shutil.rmtree(folder)
    sentences = [json.loads(line) for line in done.stdout.splitlines()]
    return {make.__name__: (sentence, expected[make.__name__]) for make, sentence in zip(FILES, sentences, strict=True)}


@pytest.mark.parametrize("name", [make.__name__ for make in FILES])
def test_a_hostile_file_is_refused_in_one_printable_sentence_before_it_costs(said, name):
    sentence, words = said[name]
    assert words in sentence
    assert sentence.isprintable()
    assert sentence.endswith(".")
    assert len(sentence) < 600


def test_what_a_terminal_would_obey_is_escaped():
    commands = "a\x1b[2J\x9b2J\r\n\x00\u202e\u2066\u200b\u2028\ufeff\xadb"
    assert printable(commands) == ("a\\x1b[2J\\x9b2J\\r\\n\\x00\\u202e\\u2066\\u200b\\u2028\\ufeff\\xadb")
    assert printable("θ₀ = π/2, Лагранж, 振り子") == "θ₀ = π/2, Лагранж, 振り子"
    assert str(DatasetError(f"'{commands}' is no dataset.")).isprintable()


def test_the_name_of_a_file_commands_no_terminal(built, tmp_path, capsys):
    from reference.__main__ import main

    name = "x\x1b]0;owned\x07\u202e.h5"
    shutil.copy(built, tmp_path / name)
    assert main(["datasheet", str(tmp_path / name)]) == 0
    found = capsys.readouterr().out
    assert "from `x\\x1b]0;owned\\x07\\u202e.h5` itself" in found
    assert all(line.isprintable() for line in found.splitlines())
    (tmp_path / name).write_text("no dataset\n")
    assert main(["show", str(tmp_path / name)]) == 2
    assert capsys.readouterr().err.rstrip("\n").isprintable()


def test_names_in_anothers_file_need_not_be_utf8(tmp_path):
    from reference.dataset.columns import foreign_columns

    with h5py.File(tmp_path / "x.h5", "w") as file:
        file.create_dataset(b"thet\xff", data=[1.0])
    with foreign_columns(tmp_path / "x.h5") as found:
        assert list(found) == ["thet\\xff"]


def test_a_plan_whose_file_could_not_be_read_is_not_built(tmp_path):
    from reference.dataset.build import build

    with pytest.raises(
        ValueError, match=r"^profile 'cor' is unknown, perhaps core; accepted are core, full, and names of"
    ):
        build(Plan("cor", ()), tmp_path / "x.h5")
    assert list(tmp_path.iterdir()) == []
