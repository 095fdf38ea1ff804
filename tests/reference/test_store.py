"""The file: what every reader relies on, and what loading refuses."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess

import h5py
import numpy as np
import pytest
from h5py import h5d, h5z
from plans import SMALL

import reference
from reference.dataset.catalogue import plan
from reference.dataset.errors import DatasetError
from reference.dataset.fingerprint import pieces
from reference.dataset.reader import core_path, load
from reference.dataset.schema import arrays
from reference.dataset.versions import NEWEST
from reference.layout import Coordinate, Group, Layout
from reference.problems.pendulum import family as groups
from reference.problems.pendulum.problem import Pendulum


def datasets(file):
    found = []
    file.visititems(lambda _name, member: found.append(member) if isinstance(member, h5py.Dataset) else None)
    return found


def test_every_dataset_is_chunked_and_checksummed_with_explicit_times(built):
    with h5py.File(built) as file:
        for dataset in datasets(file):
            properties = dataset.id.get_create_plist()
            assert properties.get_layout() == h5d.CHUNKED
            assert [properties.get_filter(i)[0] for i in range(properties.get_nfilters())] == [h5z.FILTER_FLETCHER32]
            assert properties.get_alloc_time() == h5d.ALLOC_TIME_INCR
            assert properties.get_fill_time() == h5d.FILL_TIME_ALLOC
            assert not properties.get_obj_track_times()
            assert dataset.dtype in (np.dtype("<f8"), np.dtype("<i4"))


def test_every_axis_has_one_dimension_scale_with_its_name(built):
    with h5py.File(built) as file:
        assert file["limb"].is_scale
        group = file["pendulum/libration"]
        for array in arrays(groups.LIBRATION, NEWEST):
            dataset = group[array.name]
            assert bool(dataset.is_scale) == array.is_scale
            if not array.is_scale:
                names = tuple(axis[0].name.rpartition("/")[2] for axis in dataset.dims)
                assert names == array.dims
                assert all(len(axis) == 1 for axis in dataset.dims)
        assert group["theta_tail"].dims[2][0] == file["limb"]


def test_attributes_are_fixed_length_utf8_or_numbers_and_small(built):
    own_of_hdf5 = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST"}
    with h5py.File(built) as file:
        for target in [file, file["pendulum/libration"], file["provenance"], *datasets(file)]:
            for name in set(target.attrs) - own_of_hdf5:
                attribute = target.attrs.get_id(name)
                text = h5py.check_string_dtype(attribute.dtype)
                if text is None:
                    assert attribute.dtype in (np.dtype("<f8"), np.dtype("<i4"))
                else:
                    assert text.encoding == "utf-8"
                    assert text.length is not None
                assert attribute.get_storage_size() < 65_536


def test_superblock_is_the_checksummed_one_of_version_3(built):
    assert built.read_bytes()[8] == 3


def test_values_are_those_of_the_problem_and_the_tail_its_next_limbs(built):
    dataset = load(built)
    expected = Pendulum(2.0).state(np.arange(5) / 4, limbs=3)
    for component, name in enumerate(("theta", "omega")):
        variable = dataset[f"/pendulum/libration/{name}"]
        assert np.array_equal(variable.value[1], expected[:, component, 0])
        assert np.array_equal(variable.tail[1], expected[:, component, 1:])
    assert dataset["pendulum/libration/period"].value[1] == float(Pendulum(2.0).period())
    assert dataset["pendulum/libration/turning_point"].value[0, 1] == float(Pendulum(0.5).period())


def test_a_variable_knows_units_definition_decimals_and_its_checks(built):
    period = load(built)["pendulum/libration/period"]
    assert (period.units, period.dims, period.shape) == ("s", ("amplitude",), (2,))
    assert period.definition.startswith("T = ")
    assert period.attrs["decimal"].split() == [Pendulum(a).period().digits(50) for a in (0.5, 2.0)]
    assert period.attrs["taylor_digits"] >= 45
    assert period.attrs["quadrature_digits"] >= 45
    assert period.attrs["checked_elements"] == 2
    modulus = load(built)["pendulum/libration/modulus"].attrs
    assert "taylor_digits" not in modulus
    assert "formula" in modulus["taylor_reason"]


def test_inputs_are_exact_and_carry_decimals_and_hex_floats(built):
    dataset = load(built)
    amplitude = dataset["pendulum/libration/amplitude"]
    assert amplitude.is_input
    assert amplitude.attrs["hex"].split() == [(0.5).hex(), (2.0).hex()]
    assert amplitude.attrs["decimal"] == "0.5 2.0"
    assert not amplitude.tail.any()
    group = dataset.groups["pendulum/libration"]
    assert (group["g"], group["g_hex"], group["g_decimal"], group["g_units"]) == (9.81, (9.81).hex(), "9.81", "m s-2")


def test_root_says_licence_conventions_and_what_inputs_are(built):
    attributes = load(built).attrs
    assert attributes["license"] == "CC-BY-4.0"
    assert attributes["Conventions"].startswith("CF-1.")
    assert attributes["inputs"] == "exact binary64"
    assert attributes["version"] == reference.__version__
    assert attributes["command"] == "python -m reference build --profile core"
    assert attributes["history"] == f"python -m reference build --profile core (horologium {reference.__version__})"


def test_fingerprint_is_the_documented_hash(built):
    """The definition of fingerprint.py once more, written out."""
    digest = hashlib.sha256(b"horologium-fingerprint-1\n")
    with h5py.File(built) as file:
        found = {dataset.name: dataset for dataset in datasets(file)} | {"/pendulum/libration": None}
        for path in sorted(found):
            dataset = found[path]
            if dataset is None:
                record = {"path": path, "parameters": {"g": (9.81).hex(), "length": (1.0).hex()}}
            else:
                dims = [path.split("/")[-1]] if dataset.is_scale else [d[0].name.split("/")[-1] for d in dataset.dims]
                record = {"path": path, "shape": list(dataset.shape), "dtype": dataset.dtype.str, "dimensions": dims}
                record |= {name: dataset.attrs[name].decode() for name in ("units", "definition")}
            digest.update(json.dumps(record, sort_keys=True, separators=(",", ":")).encode() + b"\n")
            digest.update(b"" if dataset is None else dataset[...].tobytes())
    assert load(built).fingerprint == digest.hexdigest()


def test_pieces_run_through_an_array_in_order():
    array = np.arange(3 * 70_000 * 2).reshape(3, 70_000, 2)
    parts = [array[selection].ravel() for selection in pieces(array.shape)]
    assert len(parts) > 3
    assert np.array_equal(np.concatenate(parts), array.ravel())


def test_checksum_beside_the_file_is_that_of_coreutils(built):
    done = subprocess.run(
        ["sha256sum", "-c", "SHA256SUMS"], cwd=built.parent, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_iterating_gives_every_variable_without_tails(built):
    names = list(load(built))
    assert "pendulum/libration/theta" in names
    assert "pendulum/libration/time" in names
    assert not [name for name in names if name.endswith("_tail")]


def test_an_unknown_variable_is_answered_with_the_nearest(built):
    with pytest.raises(KeyError, match=r"pendulum/libration/period"):
        load(built)["pendulum/libration/perid"]


def test_a_file_that_changes_after_loading_is_refused(copy):
    dataset = load(copy)
    copy.write_bytes(copy.read_bytes() + b"\0")
    with pytest.raises(DatasetError, match=r"changed since it was checked"):
        _ = dataset["pendulum/libration/period"].value


def test_without_xarray_one_sentence_says_how_to_get_it(built, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(ImportError, match=r"pip install horologium\[xarray\]"):
        load(built).to_xarray()


def test_xarray_gets_variables_tails_and_coordinates(built, monkeypatch):
    class FakeXarray:
        """Takes what xarray takes, and hands it back."""

        @staticmethod
        def Dataset(data, coords, attrs):  # noqa: N802
            return data, coords, attrs

        class DataTree:
            from_dict = staticmethod(dict)

    monkeypatch.setitem(__import__("sys").modules, "xarray", FakeXarray)
    dataset = load(built)
    data, coords, attributes = dataset.to_xarray("pendulum/libration")
    assert set(coords) == {"amplitude", "time", "event"}
    assert data["theta"][0] == ("amplitude", "time")
    assert data["theta_tail"][0] == ("amplitude", "time", "limb")
    assert np.array_equal(data["theta_tail"][1], dataset["pendulum/libration/theta"].tail)
    assert attributes["g"] == 9.81
    assert set(dataset.to_xarray()) == {"pendulum/libration"}
    with pytest.raises(KeyError, match=r"perhaps"):
        dataset.to_xarray("pendulum/libratio")


def test_a_layout_with_one_problem_and_inputs_beside_the_axis_describes_its_arrays():
    """What other families need: no instance axis, two numbers an instance, and a label axis."""
    state = Pendulum.rows[:1]
    time = Coordinate("time", "s", "time")
    single = Layout("/a/single", "one", (), {"time": time}, (), state, Pendulum, "here")
    assert [array.dims for array in arrays(single, NEWEST)][:2] == [("time",), ("time",)]
    group = Group(single, {}, {"time": [0.0, 1.0]})
    assert [block.selection(single.variables[0]) for block in group.blocks()] == [(slice(0, 2),)]
    ends = Coordinate("end_x", "m", "x"), Coordinate("end_y", "m", "y")
    pairs = Layout("/a/pairs", "two", ends, {"time": time}, (), state, Pendulum, "here")
    assert {array.name: array.dims for array in arrays(pairs, NEWEST)}["end_y"] == ("end_x",)
    with pytest.raises(ValueError, match=r"differ in length"):
        Group(pairs, {}, {"end_x": [1.0, 2.0], "end_y": [1.0], "time": [0.0]})
    curve = Coordinate("curve", "1", "curve", meanings=("line", "parabola"))
    assert curve.dtype == np.dtype("<i4")


def test_the_core_dataset_is_found_and_sound(core):
    assert core_path().name == "horologium-core.h5"
    assert core.path == core_path()
    assert set(core.groups) == {group.layout.path.strip("/") for group in plan().groups}
    amplitudes = core["pendulum/libration/amplitude"].value
    assert {0.001, 0.301, 1.0, 1.501, np.pi - 1e-9} <= set(amplitudes)
    assert np.array_equal(core["pendulum/libration/time"].value, np.arange(1001) / 100)
    assert core["pendulum/long/time"].value[-1] == 2.0**30


def test_every_stored_trajectory_agrees_by_both_routes_to_45_digits(core):
    single = {layout.path.strip("/") for layout in core.layouts if not layout.instances}
    without, third = set(), set()
    for variable in core.values():
        if variable.is_input:
            continue
        attributes = variable.attrs
        if variable.name.startswith("flow/"):
            condition = variable.name.endswith("/condition")
            assert attributes["taylor_digits"] >= 45
            checked, size = attributes["taylor_checked_elements"], variable.value.size
            assert checked >= size / 12 if condition else checked == size
            if "quadrature_digits" in attributes:
                third.add(variable.name.split("/")[1].replace("_", "-"))
                assert attributes["quadrature_digits"] >= 45
            else:
                assert attributes["quadrature_reason"] == "there is no closed form"
            continue
        assert attributes["quadrature_digits"] >= 45
        instances = 1 if variable.name.rpartition("/")[0] in single else variable.shape[0]
        assert attributes["quadrature_checked_elements"] >= instances
        if "taylor_reason" in attributes:
            without.add(variable.name.rpartition("/")[2])
        else:
            assert attributes["taylor_digits"] >= 45
            assert attributes["taylor_checked_elements"] >= instances
    assert without == {"modulus", "complementary_modulus", "kappa", "z0", "period_series", "neighbour_gap"}
    assert {"kepler", "rigid-body", "duffing", "detest-d5", "pleiades", "henon-heiles"} <= third
    assert not {"lorenz", "van-der-pol", "brusselator", "driven-pendulum"} & third


def test_the_datasheet_beside_the_core_dataset_is_the_one_of_the_file(core):
    from reference.dataset.datasheet import datasheet

    sheet = core_path().parent / "README.md"
    assert sheet.read_text(encoding="utf-8") == datasheet(core)


def test_the_numbers_of_a_checked_dataset_cannot_be_changed(built):
    dataset = load(built)
    for name in ("pendulum/libration/theta", "pendulum/libration/time"):
        for array in (dataset[name].value, dataset[name].tail):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1


def test_a_citation_has_the_year_of_the_file_or_of_its_version(built, tmp_path, monkeypatch):
    from reference.dataset.build import build
    from reference.dataset.cite import cite

    assert "  year      = {2026},\n" in cite(load(built))
    assert cite(load(built), "text").startswith("The Horologium developers (2026). Horologium:")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    build(SMALL, tmp_path / "dated.h5")
    assert load(tmp_path / "dated.h5").attrs["history"].startswith("1970-01-02T00:00:00+00:00 python -m reference")
    assert "  year      = {1970},\n" in cite(load(tmp_path / "dated.h5"))
    assert cite(load(tmp_path / "dated.h5"), "text").startswith("The Horologium developers (1970). Horologium:")


def test_the_datasheet_has_a_page_for_each_group(built):
    from reference.dataset.datasheet import datasheet

    dataset = reference.load(built)
    whole = datasheet(dataset)
    for group, attributes in dataset.groups.items():
        page = datasheet(dataset, f"/{group}")
        assert page in whole
        assert f"**Problem**: {attributes['statement']}." in page
        assert f"**Level of difficulty**: {attributes['difficulty'].partition(':')[0]}" in page
        assert f"Fingerprint sha256:{dataset.fingerprint}. Group `/{group}`, fingerprint sha256:" in page
        assert attributes["fingerprint"] in page
        for variable in dataset.values():
            if variable.name.startswith(group) and not variable.is_input:
                assert f"| `{variable.name.rpartition('/')[2]}` | " in page
    period = dataset["pendulum/libration/period"].attrs["decimal"].split()[0]
    assert f"| `period` | {period} |" in datasheet(dataset, "pendulum/libration")
    with pytest.raises(ValueError, match=r"^group 'pendulum/libation' is unknown, perhaps pendulum/libration"):
        datasheet(dataset, "pendulum/libation")


def test_every_row_of_a_table_has_the_cells_of_its_heading(built):
    """A bar in a definition, such as a = |theta0|, is no border."""
    from reference.dataset.datasheet import datasheet

    sheet = datasheet(load(built))
    assert r"dT/da, a = \|theta0\|" in sheet
    width = 0
    for line in sheet.splitlines():
        cells = len(re.findall(r"(?<!\\)\|", line)) if line.startswith("|") else 0
        assert not (width and cells and cells != width), line
        width = cells


def test_the_datasheet_explains_a_number_of_the_file_itself(built):
    from reference.dataset.datasheet import datasheet

    assert "numbers: 9.81 stands for 9.8100000000000004973799150320701301097869873046875.\n" in datasheet(load(built))
