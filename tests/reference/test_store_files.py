"""Files that are whole or absent, on disks that may be full."""

from __future__ import annotations

import os
from contextlib import suppress

import pytest

from reference.store.files import note_checksum, replacing
from reference.store.sink import Sink


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


def test_a_failed_replacement_keeps_the_old_file_and_clears_orphans(tmp_path):
    target = tmp_path / "x.h5"
    target.write_text("old")
    (tmp_path / ".x.h5.orphan.tmp").write_text("left by a killed run")
    (tmp_path / ".other.tmp").write_text("not ours")
    with suppress(RuntimeError), replacing(target) as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert target.read_text() == "old"
    assert leftovers(tmp_path) == [".other.tmp", "x.h5"]


def test_checksums_of_other_files_are_kept(tmp_path):
    for name in ("b.h5", "a.h5"):
        (tmp_path / name).write_text(name)
        note_checksum(tmp_path / name, "0" * 64)
    note_checksum(tmp_path / "a.h5", None)
    assert (tmp_path / "SHA256SUMS").read_text() == f"{'0' * 64}  b.h5\n"
    note_checksum(tmp_path / "b.h5", None)
    assert not (tmp_path / "SHA256SUMS").exists()
