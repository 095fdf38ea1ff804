"""Builds that were stopped: finished blocks are kept, checked, used again, and thrown away when of another plan."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from plans import TINY, leftovers

import reference
from reference.dataset import build as building
from reference.dataset.blocks import BusyError, Result, compute, partial
from reference.dataset.build import build
from reference.dataset.plan import Plan
from reference.layout import Group
from reference.problems.pendulum import family as groups


def test_an_interrupted_build_goes_on_where_it_stopped(tmp_path, monkeypatch):
    whole = build(TINY, tmp_path / "whole.h5")
    out = tmp_path / "parts.h5"

    def stop(done, _total):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        build(TINY, out, progress=stop)
    assert not out.exists()
    assert len(list((tmp_path / "parts.h5.partial").glob("*/*.block"))) == 2
    again = []
    monkeypatch.setattr(building, "compute_all", lambda blocks: again.extend(blocks) or list(map(compute, blocks)))
    assert build(TINY, out) == whole
    assert len(again) == 1
    assert out.read_bytes() == (tmp_path / "whole.h5").read_bytes()
    assert leftovers(tmp_path) == ["SHA256SUMS", "parts.h5", "whole.h5"]


def interrupted(out, identity, blocks):
    """A build that is stopped after these blocks."""
    with suppress(KeyboardInterrupt), partial(out, identity) as finished:
        for block in blocks:
            finished.put(block.key, compute(block).dumped())
        raise KeyboardInterrupt


def test_a_damaged_block_is_proven_again(tmp_path):
    out = tmp_path / "x.h5"
    identity = TINY.identity(reference.__version__)
    folder = tmp_path / "x.h5.partial" / identity
    whole = build(TINY, tmp_path / "whole.h5")
    interrupted(out, identity, TINY.blocks())
    block = next(folder.glob("*.block"))
    block.write_bytes(block.read_bytes()[:-1])
    assert build(TINY, out) == whole


def test_blocks_of_another_plan_are_not_used(tmp_path):
    other = Plan("core", (Group(groups.LONG, groups.UNIT, TINY.groups[0].inputs),))
    assert other.identity("1") != TINY.identity("1") != TINY.identity("2")
    interrupted(tmp_path / "x.h5", other.identity("1"), other.blocks())
    with partial(tmp_path / "x.h5", TINY.identity("1")) as finished:
        assert not finished.has(next(TINY.blocks()).key)
        assert len(list((tmp_path / "x.h5.partial").iterdir())) == 2
    assert leftovers(tmp_path) == []


def test_two_builds_of_one_file_do_not_mix(tmp_path):
    with partial(tmp_path / "x.h5", "a" * 64):
        with pytest.raises(BusyError, match="another build is writing"), partial(tmp_path / "x.h5", "b" * 64):
            pass
        assert (tmp_path / "x.h5.partial" / ("a" * 64)).exists()


def test_a_result_survives_being_stored_and_its_damage_is_seen():
    result = compute(next(TINY.blocks()))
    data = result.dumped()
    again = Result.loaded(data)
    assert again is not None
    assert np.array_equal(again.limbs, result.limbs)
    assert Result.loaded(data[:-1]) is None
    assert Result.loaded(b"") is None
