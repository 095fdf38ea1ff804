"""The command ``check`` without a process of its own, which test_check_contained.py is about."""

from __future__ import annotations

from types import SimpleNamespace

from compare.claims import inside
from compare.claims.contained import Answer, ContainedError

__all__ = ["answered"]


def answered(options, form):
    """What ``contained`` gives, measured in this process."""
    found = inside._answer(SimpleNamespace(say=lambda _: None), {"options": dict(options), "form": form})
    if "refused" in found:
        raise ContainedError(found["refused"])
    return Answer(**found)
