"""Files of every published schema version are read and proven again: files are cited."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from forgery import marked

import reference
from reference.dataset.catalogue import LAYOUTS
from reference.dataset.cite import cite
from reference.dataset.datasheet import datasheet
from reference.dataset.errors import DatasetError
from reference.dataset.plan import Plan
from reference.dataset.reader import load
from reference.dataset.schema import RELEASED, arrays
from reference.dataset.show import show
from reference.dataset.verify import verify
from reference.dataset.versions import NEWEST, SCHEMAS
from reference.layout import Group
from reference.problems.polar import family as polar

DATA = Path(__file__).parent / "data"
FILES = {"schema-1": "1", "schema-2-early": "2", "schema-2": "2", "schema-3": "3"}
SOME = {
    "schema-2-early": {"polar/family", "tunnel/family"},
    "schema-3": {"pendulum/libration", "cycloid/tautochrone", "polar/boundary"},
}
"""The groups of files that have not those of their version all."""
LISTED = dict(re.findall(r"\| `([\w-]+)\.h5` .*`([0-9a-f]{64})` \|", (DATA / "README.md").read_text(encoding="utf-8")))


@pytest.fixture(scope="module")
def old():
    return {name: load(DATA / f"{name}.h5") for name in FILES}


@pytest.mark.parametrize("name", FILES)
def test_an_old_file_is_loaded_and_has_the_fingerprint_that_it_had(old, name):
    assert old[name].attrs["schema_version"] == old[name].schema.version == FILES[name]
    assert old[name].fingerprint == LISTED[name]


@pytest.mark.parametrize("name", FILES)
def test_an_old_file_is_proven_again(name):
    proofs = verify(DATA / f"{name}.h5")
    assert [str(proof) for proof in proofs if not proof.holds] == []
    assert all(proof.elements for proof in proofs)


@pytest.mark.parametrize("name", FILES)
def test_an_old_file_is_shown_described_and_cited(old, name):
    assert f"fingerprint: {LISTED[name]}" in list(show(old[name], None, "text"))
    assert f"schema {FILES[name]} |" in datasheet(old[name])
    assert LISTED[name] in cite(old[name])
    assert ("history" in old[name].attrs) == (FILES[name] == "3")


def test_the_old_files_have_every_group_of_their_versions(old):
    for name, dataset in old.items():
        known = {layout.path.strip("/") for layout in dataset.schema.layouts}
        assert set(dataset.groups) == SOME.get(name, known)
    assert "polar/family/z_by_height" in old["schema-2"]
    assert "polar/family/z_by_height" not in old["schema-2-early"]


def test_what_later_versions_say_otherwise_is_as_the_old_file_says_it(old):
    assert old["schema-1"]["pendulum/libration/period"].definition == "T = 4 K(k)/omega0, omega0 = sqrt(g/l)"
    assert "statement" not in old["schema-1"].groups["pendulum/libration"]
    boundary = old["schema-2"]["polar/boundary/z0"]
    assert boundary.dims == ("end_z",)
    assert old["schema-2"]["polar/boundary/end_z"].value.tolist() == [1.0, 0.5, 1.0]
    assert "coordinates" not in boundary.attrs


def forged(path, change):
    """Change a file, and put its fingerprint right again."""
    with h5py.File(path, "r+", libver=("v110", "v110")) as file:
        change(file)
        marked(file, signed_zeros=True)
    return path


def test_in_an_old_file_a_wrong_limb_is_found_and_either_sign_of_zero_accepted(tmp_path):
    def change(file):
        omega, tail = file["pendulum/libration/omega"], file["pendulum/long/theta_tail"]
        assert omega[0, 0] == 0
        omega[0, 0] = -omega[0, 0]
        tail[0, 1, 1] = np.nextafter(tail[0, 1, 1], 1.0)

    path = forged(shutil.copy(DATA / "schema-1.h5", tmp_path / "x.h5"), change)
    assert load(path)["pendulum/libration/omega"].value[0, 0] == 0
    assert [proof.name for proof in verify(path) if not proof.holds] == ["pendulum/long/theta"]


@pytest.mark.parametrize(
    ("name", "claimed"), [("schema-1", "2"), ("schema-2", "3"), ("schema-2", "1"), ("schema-3", "4")]
)
def test_a_file_is_of_the_version_that_it_names_and_no_other(tmp_path, name, claimed):
    path = shutil.copy(DATA / f"{name}.h5", tmp_path / "x.h5")
    with h5py.File(path, "r+", libver=("v110", "v110")) as file:
        file.attrs.create("schema_version", claimed.encode(), dtype=h5py.string_dtype("utf-8", 1))
    with pytest.raises(DatasetError):
        load(path)


def test_the_newest_schema_is_that_of_the_catalogue():
    assert list(SCHEMAS) == ["1", "2", "3", "4"]
    assert SCHEMAS["4"] is NEWEST
    assert NEWEST.layouts == LAYOUTS
    assert reference.__version__ in RELEASED


def test_end_points_lie_along_an_index_and_are_auxiliary_coordinates():
    found = {array.name: array for array in arrays(polar.BOUNDARY, NEWEST)}
    scales = [name for name, array in found.items() if array.is_scale]
    assert scales == ["end"]
    assert found["end"].dtype == np.dtype("<i4")
    assert found["end_z"].dims == found["end_phi"].dims == found["z0"].dims == ("end",)
    for name in ("z0", "z0_tail", "chord_gap"):
        assert found[name].attributes["coordinates"] == "end_z end_phi"
    group = Group(polar.BOUNDARY, {}, {"end_z": [1.0, 0.5, 1.0], "end_phi": [0.25, 0.25, 1.5]})
    assert group.inputs["end"].tolist() == [0, 1, 2]
    with pytest.raises(ValueError, match=r"^/polar/boundary/end counts its elements 0, 1, 2, \.\.\.; it cannot be"):
        Group(polar.BOUNDARY, {}, {**group.inputs, "end": [0, 2, 1]})


def test_every_axis_of_every_profile_rises_or_falls():
    from reference.dataset.catalogue import PROFILES, plan

    for profile in PROFILES:
        for group in plan(profile).groups:  # which refuses what is not so
            for axis in group.layout.axes:
                steps = np.diff(group.inputs[axis.name])
                assert (steps > 0).all() or (steps < 0).all()


def test_numbers_out_of_order_are_no_axis():
    with pytest.raises(ValueError, match=r"^/polar/motion/tau is an axis: its numbers must rise or must fall\."):
        Plan("core", (Group(polar.MOTION, {}, {"z0": [0.5], "tau": [0.0, 1.0, 0.5]}),))
    with pytest.raises(ValueError, match=r"^/polar/motion/z0 is an axis"):
        Plan("core", (Group(polar.MOTION, {}, {"z0": [0.5, 0.5], "tau": [0.0]}),))
    assert Plan("core", (Group(polar.MOTION, {}, {"z0": [0.75, 0.5], "tau": [0.0]}),))


def test_a_zero_given_has_no_sign():
    group = Group(polar.MOTION, {}, {"z0": [0.5], "tau": [-0.0, 1.0]})
    assert not np.signbit(group.inputs["tau"]).any()
