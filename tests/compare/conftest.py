"""Fixtures of more than one file."""

from __future__ import annotations

import pytest
from uncontained import answered


@pytest.fixture
def without_a_process(monkeypatch):
    """The command ``check`` in this process."""
    monkeypatch.setattr("compare.claims.contained.contained", answered)
