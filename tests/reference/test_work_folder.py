"""What stands around an output and is not ours stays as it is: folders, links, files and locks, at any moment."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pytest
from arrangements import IN_PLACE, PURE, SPOILT, snapshot, their_folder
from plans import TINY, leftovers

import reference
from reference.command.marked import PlaceError, abandoned, made
from reference.command.terminal import run
from reference.dataset import build as building
from reference.dataset.blocks import partial
from reference.dataset.build import build
from reference.dataset.checksums import checksums
from reference.layout import Group

ROOT = Path(reference.__file__).parents[1]
PROGRAM = Path(__file__).with_name("arrangements.py")


def refused(capsys, out):
    """The one sentence of a build that is refused, with exit code 2."""
    assert run(lambda _: build(TINY, out) and 0) == 2
    err = capsys.readouterr().err
    assert err.startswith("error: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    return err


@pytest.fixture
def no_work(monkeypatch):
    monkeypatch.setattr(building, "compute_all", lambda _blocks: pytest.fail("work was done"))


@pytest.mark.usefixtures("no_work")
@pytest.mark.parametrize("place", [name for name in IN_PLACE if name not in PURE])
def test_what_we_did_not_make_in_place_of_the_work_folder_is_refused_and_untouched(tmp_path, capsys, place):
    theirs = their_folder(tmp_path / "theirs")
    IN_PLACE[place](tmp_path / "x.h5.partial", theirs)
    before = snapshot(tmp_path)
    assert "x.h5.partial' is " in (said := refused(capsys, tmp_path / "x.h5"))
    assert "this program did not make; move it elsewhere." in said
    assert ("is a link" in said) == ("link" in place)
    assert snapshot(tmp_path) == before


@pytest.mark.usefixtures("no_work")
@pytest.mark.parametrize("spoilt", SPOILT)
def test_a_work_folder_with_something_in_it_that_is_not_ours_is_refused_and_untouched(tmp_path, capsys, spoilt):
    theirs = their_folder(tmp_path / "theirs")
    out = tmp_path / "x.h5"
    interrupted_tiny(out)
    SPOILT[spoilt](tmp_path / "x.h5.partial", theirs)
    before = snapshot(tmp_path)
    said = refused(capsys, out)
    assert ("holds '" in said) == (" lock" not in spoilt)
    assert "did not make; move it elsewhere." in said
    assert snapshot(tmp_path) == before


def interrupted_tiny(out):
    with contextlib.suppress(KeyboardInterrupt), partial(out, TINY.identity(reference.__version__)) as finished:
        finished.put(next(TINY.blocks()).key, b"")
        raise KeyboardInterrupt


def test_what_comes_into_the_work_folder_while_it_is_used_stays(tmp_path):
    theirs = their_folder(tmp_path / "theirs")
    with partial(tmp_path / "x.h5", "a" * 64) as finished:
        finished.put("key", b"block")
        home = tmp_path / "x.h5.partial"
        (home / "notes.txt").write_text("theirs")
        (home / ("a" * 64) / ("b" * 32 + ".block")).symlink_to(theirs / "notes.txt")
        (home / ("c" * 64)).symlink_to(theirs, target_is_directory=True)
        before = snapshot(theirs)
    assert snapshot(theirs) == before
    assert leftovers(home) == ["a" * 64, "c" * 64, "lock", "notes.txt"]
    assert leftovers(home / ("a" * 64)) == ["b" * 32 + ".block"]
    with pytest.raises(PlaceError, match="holds '"), partial(tmp_path / "x.h5", "a" * 64):
        pass


def test_a_work_folder_that_is_replaced_while_it_is_used_is_left_alone(tmp_path):
    home, moved = tmp_path / "x.h5.partial", tmp_path / "moved"
    with partial(tmp_path / "x.h5", "a" * 64) as finished:
        home.rename(moved)
        their_folder(home)
        before = snapshot(home)
        finished.put("key", b"block")
    assert snapshot(home) == before


def arrangements(tmp_path, *words):
    """What the program found in a folder of its own."""
    place = tmp_path / "place"
    place.mkdir()
    done = subprocess.run(
        [sys.executable, str(PROGRAM), str(place), *words],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    return json.loads(done.stdout)


def test_nothing_changes_in_what_stands_around_an_output(tmp_path):
    found = arrangements(tmp_path, "around", "10", "25")
    assert found["faults"] == []
    assert found["built"] + found["refused"] == found["arrangements"] == 25
    assert min(found["built"], found["refused"]) > 3


def test_a_build_that_is_killed_at_any_call_leaves_the_old_file_or_the_new_and_can_be_finished(tmp_path):
    found = arrangements(tmp_path, "killed", "3", "9")
    assert found["faults"] == []
    assert found["kills"] > 8


def test_a_sentence_on_a_build_that_failed_late_tells_what_was_written(tmp_path, monkeypatch, capsys):
    out = tmp_path / "x.h5"
    out.write_text("old")
    note = building.note_checksum

    def full(target, digest):
        if digest is not None:
            raise OSError(28, "No space left on device")
        note(target, digest)

    monkeypatch.setattr(building, "note_checksum", full)
    assert refused(capsys, out) == (
        f"error: '{out}' was written, but its checksum was not noted: the disk is full; nothing was left behind.\n"
    )
    assert reference.load(out).fingerprint
    assert leftovers(tmp_path) == ["x.h5"]


def test_a_build_that_cannot_take_its_place_leaves_the_old_file_with_its_checksum(tmp_path, monkeypatch, capsys):
    out = tmp_path / "x.h5"
    build(TINY, out)
    before = snapshot(tmp_path)
    replace = Path.replace

    def refusing(self, place):
        if place == out:
            raise OSError(5, "Input/output error")
        return replace(self, place)

    monkeypatch.setattr(Path, "replace", refusing)
    assert refused(capsys, out) == (f"error: '{out}' was not written: Input/output error; nothing was left behind.\n")
    assert snapshot(tmp_path) == before


def test_a_folder_that_takes_the_output_s_place_under_way_is_not_taken_for_the_file(tmp_path, capsys, monkeypatch):
    out = tmp_path / "x.h5"
    compute = building.compute_all
    monkeypatch.setattr(building, "compute_all", lambda blocks: out.mkdir(exist_ok=True) or compute(blocks))
    assert refused(capsys, out) == f"error: '{out}' was not written: Is a directory; nothing was left behind.\n"
    assert out.is_dir()
    assert leftovers(tmp_path) == ["x.h5"]


def test_hidden_folders_are_cleared_where_they_are_ours_and_their_process_has_ended(tmp_path):
    (tmp_path / ".horologium-01234567").mkdir()
    their_folder(tmp_path / ".horologium-89abcdef")
    with made(tmp_path) as used:
        assert list(abandoned(tmp_path)) == []
    assert [folder.path for folder in abandoned(tmp_path)] == [used.path]
    build(TINY, tmp_path / "x.h5")
    assert leftovers(tmp_path) == [".horologium-01234567", ".horologium-89abcdef", "SHA256SUMS", "x.h5"]


def test_an_output_may_not_be_the_list_of_checksums(tmp_path, capsys):
    (tmp_path / "SHA256SUMS").write_text("0" * 64 + "  y.h5\n")
    before = snapshot(tmp_path)
    assert "is the list of checksums" in refused(capsys, tmp_path / "SHA256SUMS")
    assert snapshot(tmp_path) == before


@pytest.mark.usefixtures("no_work")
def test_an_output_that_is_a_link_to_itself_is_refused_and_stays(tmp_path, capsys):
    (tmp_path / "x.h5").symlink_to("x.h5")
    assert "is a link that leads to itself" in refused(capsys, tmp_path / "x.h5")
    assert (tmp_path / "x.h5").is_symlink()
    assert leftovers(tmp_path) == ["x.h5"]


@pytest.mark.usefixtures("no_work")
def test_a_name_to_which_nothing_can_be_added_is_refused(tmp_path, capsys):
    assert "is too long a name for a file; choose a shorter one" in refused(capsys, tmp_path / ("x" * 250))
    assert leftovers(tmp_path) == []


def test_an_output_may_have_as_long_a_name_as_fits(tmp_path):
    out = tmp_path / ("x" * 247)
    build(TINY, out)
    assert leftovers(tmp_path) == ["SHA256SUMS", out.name]


@pytest.mark.usefixtures("no_work")
@pytest.mark.parametrize("epoch", ["today", "", "-1", "1.5", "١٢", "9" * 12])
def test_a_date_that_is_no_number_is_told_before_the_proof(tmp_path, monkeypatch, capsys, epoch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", epoch)
    told = f"SOURCE_DATE_EPOCH is '{epoch}'; a whole number of seconds since 1970, of 11 digits at most, is accepted."
    assert told in refused(capsys, tmp_path / "x.h5")
    assert leftovers(tmp_path) == []


def bad_lists(listing, kind, theirs):
    if kind == "link":
        listing.symlink_to(theirs / "notes.txt")
    elif kind == "folder":
        listing.mkdir()
    elif kind == "pipe":
        os.mkfifo(listing)
    else:
        listing.write_bytes(kind)


@pytest.mark.usefixtures("no_work")
@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (b"# right\n" + b"0" * 64 + b"  a\nno checksum\n", "a line that is no checksum, line 3; restore it"),
        (b"SHA256 (x.h5) = " + b"0" * 64 + b"\n", "a line that is no checksum, line 1"),
        (b"0" * 63 + b"  x.h5\n", "a line that is no checksum, line 1"),
        ("link", "is not a regular file, so that no checksum can be noted"),
        ("folder", "is not a regular file"),
        ("pipe", "is not a regular file"),
    ],
)
def test_a_list_of_checksums_that_cannot_be_kept_is_told_before_the_proof(tmp_path, capsys, kind, words):
    bad_lists(tmp_path / "SHA256SUMS", kind, their_folder(tmp_path / "theirs"))
    before = snapshot(tmp_path)
    assert words in refused(capsys, tmp_path / "x.h5")
    assert snapshot(tmp_path) == before


@pytest.mark.usefixtures("no_work")
def test_a_list_of_checksums_without_end_is_refused_before_it_costs_memory(tmp_path, capsys):
    listing = tmp_path / "SHA256SUMS"
    with listing.open("wb") as stream:
        stream.truncate(1 << 40)
    tracemalloc.start()
    told = refused(capsys, tmp_path / "x.h5")
    with pytest.raises(ValueError, match="longer than 16 MiB, no list of checksums; move it elsewhere"):
        checksums(tmp_path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert told == f"error: '{listing}' is longer than 16 MiB, no list of checksums; move it elsewhere.\n"
    assert peak < 1 << 27
    assert listing.stat().st_size == 1 << 40


def test_a_build_lists_its_blocks_once_and_tells_of_its_progress_before_it_proves(tmp_path, monkeypatch):
    told, listed = [], []
    blocks = Group.blocks
    monkeypatch.setattr(Group, "blocks", lambda self: listed.append(told[:]) or blocks(self))
    compute = building.compute_all
    monkeypatch.setattr(building, "compute_all", lambda blocks: told.append("proven") or compute(blocks))
    build(TINY, tmp_path / "x.h5", progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 3), "proven", (1, 3), "proven", (2, 3), "proven", (3, 3)]
    assert listed == [[], told]  # and once more to write them in order


def test_a_block_holds_no_numbers_of_its_own_before_it_is_proven():
    for group in reference.dataset.catalogue.plan("full").groups:
        block = next(block for block in group.blocks() if block.row.over != "once") if group.layout.over else None
        if block is not None:
            assert any((block.values.base is values) for values in group.inputs.values())
            assert "arguments" not in vars(block)
