"""A small dataset of the real groups, built once."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from plans import SMALL

import reference
from reference.dataset.build import build


@pytest.fixture(scope="session")
def core():
    """The core dataset as it is shipped, loaded once: that takes some seconds."""
    return reference.load()


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """The path of the built file, a checksum beside it."""
    path = tmp_path_factory.mktemp("built") / "tiny.h5"
    build(SMALL, path)
    return path


@pytest.fixture
def copy(built, tmp_path):
    """A copy without checksums beside it, to damage at will."""
    return Path(shutil.copy(built, tmp_path / "copy.h5"))
