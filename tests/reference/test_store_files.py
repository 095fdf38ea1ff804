"""Files that are whole or absent, on disks that may be full."""

from __future__ import annotations

import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import pytest

from reference.dataset.checksums import check_checksum, checksums, note_checksum
from reference.dataset.files import replacing, sha256, temporaries
from reference.dataset.writer import Sink


def leftovers(folder):
    return sorted(path.name for path in folder.iterdir())


def test_the_sink_gives_back_what_a_full_disk_would_not_take(tmp_path, monkeypatch):
    sink = Sink(tmp_path / "x")
    sink.write(b"01234567")
    monkeypatch.setattr(os, "pwrite", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    sink.seek(4)
    sink.write(b"abcdefgh")
    sink.seek(2)
    assert sink.read(8) == b"23abcdef"
    assert sink.seek(0, os.SEEK_END) == 12
    with pytest.raises(OSError, match="No space"):
        sink.check()
    sink.close()


def orphan_of(target):
    """A temporary file as a killed run leaves it."""
    with suppress(RuntimeError), replacing(target) as temporary:
        temporary.rename(temporary.with_name("moved"))
        raise RuntimeError
    return target.with_name("moved").rename(temporary)


def test_a_failed_replacement_keeps_the_old_file_and_clears_orphans(tmp_path):
    target = tmp_path / "x.h5"
    target.write_text("old")
    orphan = orphan_of(target)
    assert temporaries(target) == [orphan.name]
    (tmp_path / ".other.tmp").write_text("not ours")
    with suppress(RuntimeError), replacing(target) as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert target.read_text() == "old"
    assert leftovers(tmp_path) == [".other.tmp", "x.h5"]


@pytest.mark.parametrize("name", ["x.h5", "x[ab]*.h5", "*", "a?\n.h5"])
def test_only_temporary_files_of_our_own_form_are_cleared(tmp_path, name):
    """A name with * or [ must not match the files of others, nor a form that other programs use as well."""
    target = tmp_path / name
    orphan = orphan_of(target)
    linked = orphan.with_name(orphan.name.replace(orphan.name[-12:], "abcdefgh.tmp"))
    linked.symlink_to(tmp_path / "theirs")
    orphan.with_name(orphan.name.replace(orphan.name[-12:], "abcdefg_.tmp")).mkdir()
    for other in (f".{name}.abcdefgh.tmp", ".xa.h5.abcdefgh.tmp", f"{orphan.name}~", "theirs"):
        (tmp_path / other).write_text("theirs")
    before = leftovers(tmp_path)
    with replacing(target) as temporary:
        temporary.write_text("new")
    assert leftovers(tmp_path) == sorted({*before, name} - {orphan.name})
    assert (tmp_path / "theirs").read_text() == "theirs"


def test_a_temporary_file_that_another_run_is_writing_is_not_cleared(tmp_path):
    target = tmp_path / "x.h5"
    with replacing(target) as first:
        first.write_text("first")
        with replacing(target) as second:
            second.write_text("second")
            assert first.read_text() == "first"
        assert target.read_text() == "second"
    assert target.read_text() == "first"
    assert leftovers(tmp_path) == ["x.h5"]


def test_checksums_of_other_files_are_kept(tmp_path):
    for name in ("b.h5", "a.h5"):
        (tmp_path / name).write_text(name)
        note_checksum(tmp_path / name, "0" * 64)
    note_checksum(tmp_path / "a.h5", None)
    assert (tmp_path / "SHA256SUMS").read_text() == f"{'0' * 64}  b.h5\n"
    note_checksum(tmp_path / "b.h5", None)
    assert not (tmp_path / "SHA256SUMS").exists()


OTHERS = b"# made by hand\r\n" + b"A" * 64 + b" *\xff.bin\n\n\\" + b"1" * 64 + b"  a\\nb\n"


@pytest.mark.parametrize("last", [b"", b"2" * 64 + b"  z.h5"])
def test_lines_of_others_stay_as_they_are_and_where_they_are(tmp_path, last):
    listing = tmp_path / "SHA256SUMS"
    listing.write_bytes(b"0" * 64 + b"  x.h5\n" + OTHERS + last)
    ended = last + b"\n" if last else b""
    note_checksum(tmp_path / "x.h5", "f" * 64)
    assert listing.read_bytes() == b"f" * 64 + b"  x.h5\n" + OTHERS + ended
    note_checksum(tmp_path / "x.h5", None)
    assert listing.read_bytes() == OTHERS + ended
    note_checksum(tmp_path / "x.h5", "e" * 64)
    assert listing.read_bytes() == OTHERS + ended + b"e" * 64 + b"  x.h5\n"


@pytest.mark.parametrize("name", ["x y.h5", "x\ny.h5", "x\\y\r.h5", "#x.h5", os.fsdecode(b"\xff.h5")])
def test_coreutils_agree_on_names_of_any_letters(tmp_path, name):
    (tmp_path / name).write_text("1")
    note_checksum(tmp_path / name, sha256(tmp_path / name))
    assert checksums(tmp_path) == {name: sha256(tmp_path / name)}
    check_checksum(tmp_path / name)
    done = subprocess.run(["sha256sum", "--strict", "-c", "SHA256SUMS"], cwd=tmp_path, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


def test_notes_of_many_at_once_are_all_kept(tmp_path):
    """Each reads the list and writes it anew: none may write over what another has noted meanwhile."""
    names = [f"{i}.h5" for i in range(40)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda name: note_checksum(tmp_path / name, "0" * 64), names))
    assert set(checksums(tmp_path)) == set(names)
    assert leftovers(tmp_path) == ["SHA256SUMS"]
