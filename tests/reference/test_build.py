"""Building: the same bytes every time, resumed or not, and nothing half-written."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from plans import TINY, leftovers

import reference
from reference.dataset import build as building
from reference.dataset import catalogue
from reference.dataset.blocks import Partial, compute_all, spread
from reference.dataset.build import build
from reference.dataset.checksums import note_checksum
from reference.dataset.plan import Plan
from reference.dataset.reader import load
from reference.layout import BLOCK_LENGTH, Group
from reference.problems.families import FAMILIES
from reference.problems.pendulum import family as groups
from reference.routes import proven_flow
from reference.routes.agreement import Agreement

ROOT = Path(reference.__file__).parents[1]


def test_one_job_and_two_jobs_give_the_same_bytes(tmp_path):
    one, two = tmp_path / "one.h5", tmp_path / "two.h5"
    assert build(TINY, one, jobs=1) == build(TINY, two, jobs=2)
    assert one.read_bytes() == two.read_bytes()
    assert leftovers(tmp_path) == ["SHA256SUMS", "one.h5", "two.h5"]


def of_flow(name):
    return next(group for family in FAMILIES for group in family.core() if group.layout.path == f"/flow/{name}")


def test_groups_of_flows_are_the_same_bytes_whoever_proves_them_and_after_a_task_was_broken_off(tmp_path, monkeypatch):
    plan = Plan("core", (of_flow("detest_a1"), of_flow("detest_a2")))
    one, two, three = (tmp_path / f"{name}.h5" for name in ("one", "two", "three"))
    assert build(plan, one, jobs=1) == build(plan, two, jobs=2)
    put, kept = Partial.put, []

    def broken_off(self, key, data):
        if len(kept) == 4:
            raise KeyboardInterrupt
        kept.append(key)
        put(self, key, data)

    monkeypatch.setattr(Partial, "put", broken_off)
    with pytest.raises(KeyboardInterrupt):
        build(plan, three)
    monkeypatch.undo()
    build(plan, three)
    assert one.read_bytes() == two.read_bytes() == three.read_bytes()


@pytest.mark.parametrize("name", ["detest_a1", "detest_b1"])
def test_a_group_of_a_flow_is_proven_by_one_flow(name, monkeypatch):
    begun, begin = [], proven_flow.ProvenFlow.__init__

    def counting(self, equation, bits, steps):
        begun.append(bits)
        begin(self, equation, bits, steps)

    for known in (proven_flow._flows, proven_flow._losses):
        known.cache_clear()
    monkeypatch.setattr(proven_flow.ProvenFlow, "__init__", counting)
    compute_all(tuple(of_flow(name).blocks()))
    assert begun[0] == proven_flow.LEAST_BITS
    assert len(begun) == 2


def test_the_day_changes_the_provenance_and_not_the_fingerprint(tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "0")
    first = build(TINY, tmp_path / "a.h5")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    assert build(TINY, tmp_path / "b.h5") == first
    dates = [load(tmp_path / name).provenance["date"] for name in ("a.h5", "b.h5")]
    assert dates == ["1970-01-01T00:00:00+00:00", "1970-01-02T00:00:00+00:00"]
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    assert "date" not in building.provenance()
    assert building.provenance()["heyoka"]


def test_a_date_that_is_no_number_is_refused(monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "today")
    with pytest.raises(ValueError, match="SOURCE_DATE_EPOCH is 'today'"):
        building.provenance()


def test_a_long_row_is_cut_into_blocks_that_cover_it():
    times = np.arange(2 * BLOCK_LENGTH + 5) / 4
    group = Group(groups.LONG, groups.EARTH, {"amplitude": [1.0], "time": times})
    blocks = list(group.blocks())
    assert [(block.start, len(block.arguments)) for block in blocks] == [
        (0, BLOCK_LENGTH),
        (BLOCK_LENGTH, BLOCK_LENGTH),
        (2 * BLOCK_LENGTH, 5),
    ]
    assert [float(t) for block in blocks for t in block.arguments] == times.tolist()


def test_a_build_of_several_blocks_a_row_stores_each_in_its_place(tmp_path, monkeypatch):
    monkeypatch.setattr("reference.dataset.plan.BLOCK_LENGTH", 2)
    whole = tmp_path / "x.h5"
    build(TINY, whole)
    monkeypatch.undo()
    build(TINY, tmp_path / "y.h5")
    first, second = load(whole), load(tmp_path / "y.h5")
    for name in first:
        assert np.array_equal(first[name].value, second[name].value)
        assert np.array_equal(first[name].tail, second[name].tail)
    assert first.fingerprint == second.fingerprint


def test_routes_are_counted_over_what_they_serve(tmp_path):
    build(TINY, tmp_path / "x.h5")
    attributes = load(tmp_path / "x.h5")["pendulum/long/theta"].attrs
    assert attributes["quadrature_checked_elements"] == 9
    assert attributes["taylor_checked_elements"] == 6
    assert attributes["checked_elements"] == 6


def test_a_trajectory_that_a_route_left_out_stops_the_build(tmp_path, monkeypatch):
    from reference.dataset import blocks

    def partly(problem, _row, arguments, route):
        if route == "taylor" and problem.theta0 == 2:
            return None
        return (Agreement(50.0, len(arguments)),) * 2

    monkeypatch.setattr(blocks, "agreement", partly)
    with pytest.raises(ArithmeticError, match="element 1 was not compared with the taylor route"):
        build(TINY, tmp_path / "x.h5")
    assert not (tmp_path / "x.h5").exists()


def test_a_disagreement_of_the_routes_stops_the_build_and_names_it(tmp_path, monkeypatch):
    from reference.problems.pendulum.motions import QuadratureLibration

    original = QuadratureLibration.state
    monkeypatch.setattr(QuadratureLibration, "state", lambda self, t: tuple(2 * value for value in original(self, t)))
    with pytest.raises(ArithmeticError, match=r"theta of Pendulum\(theta0=0.5.*quadrature"):
        build(TINY, tmp_path / "x.h5")
    assert leftovers(tmp_path) == []


def test_spread_takes_the_first_and_the_last():
    assert spread(range(1001), 51)[:2] == [0, 20]
    assert spread(range(1001), 51)[-1] == 1000
    assert list(spread(range(3), 51)) == [0, 1, 2]


@pytest.mark.parametrize(
    ("out", "word"),
    [
        (".", "folder"),
        ("missing/x.h5", "does not exist"),
        ("", "empty"),
        ("/proc/x.h5", "cannot be written"),
        ("/dev/full", "not a regular file"),
    ],
)
def test_an_output_that_cannot_be_is_refused_before_any_work(tmp_path, monkeypatch, out, word):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(building, "compute", lambda _block: pytest.fail("work was done"))
    with pytest.raises(OSError, match=word):
        build(TINY, out)
    assert leftovers(tmp_path) == []


def test_too_little_space_is_seen_before_any_work(tmp_path, monkeypatch):
    monkeypatch.setattr(building, "compute", lambda _block: pytest.fail("work was done"))
    monkeypatch.setattr(building.shutil, "disk_usage", lambda _folder: FreeSpace())
    with pytest.raises(OSError, match="the disk is full; nothing was left behind"):
        build(TINY, tmp_path / "x.h5")
    assert leftovers(tmp_path) == []


class FreeSpace:
    """A disk with ten bytes left."""

    free = 10


@pytest.mark.parametrize("limit", [1000, 8000, 20_000])
def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path, limit):
    """A limit on the size of files stands for the disk; HDF5 must not crash or complain."""
    build(TINY, tmp_path / "x.h5")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert len(before["x.h5"]) > 20_000
    program = textwrap.dedent(f"""
        import resource, signal
        from reference.dataset import build as building
        from reference.problems.pendulum import family as groups
        from reference.dataset.plan import Plan
        from reference.layout import Group
        times = [0.0, 1.0, 2.0**20]
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
        plan = Plan("core", (Group(groups.LONG, groups.EARTH, {{"amplitude": [0.5, 2.0, 3.0], "time": times}}),))
        try:
            building.build(plan, "x.h5")
        except OSError as error:
            print(error)
    """)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.stdout == "'x.h5' was not written: the disk is full; nothing was left behind.\n"
    assert (done.stderr, done.returncode) == ("", 0)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_between_old_and_new_file_no_checksum_is_wrong(tmp_path, monkeypatch):
    """Killed after the file is in place and before its checksum is noted, the new file still loads."""
    out = tmp_path / "x.h5"
    build(Plan("core", (Group(groups.LONG, groups.UNIT, TINY.groups[0].inputs),)), out)
    noted = []

    def kill(target, digest):
        noted.append(digest)
        if digest is not None:
            raise KeyboardInterrupt
        note_checksum(target, digest)

    monkeypatch.setattr(building, "note_checksum", kill)
    with pytest.raises(KeyboardInterrupt):
        build(TINY, out)
    assert len(noted) == 2
    assert load(out).parameters["/pendulum/long"]["g"] == 9.81


def test_profiles_hold_the_same_groups_and_full_is_fifty_times_core():
    core, full = catalogue.plan("core"), catalogue.plan("full")
    held = [group.layout.path for group in core.groups]
    assert held == [group.layout.path for group in full.groups]
    assert full.size >= 50 * core.size
    assert core.size < 10_000_000
    with pytest.raises(ValueError, match="perhaps core"):
        catalogue.plan("cor")


def test_dimensionless_inputs_fit_into_half_precision():
    group = next(group for group in catalogue.plan().groups if group.layout is groups.DIMENSIONLESS)
    for values in group.inputs.values():
        assert np.array_equal(values.astype(np.float16).astype(float), values)
