"""From a plan to a file: prove the blocks, in parallel and resumable, then write them one by one."""

from __future__ import annotations

import errno
import math
import os
import platform
import shutil
from collections import deque
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib.metadata import version as installed
from pathlib import Path
from typing import TYPE_CHECKING

from reference.command.executors import opened, results
from reference.dataset.blocks import (
    PlaceError,
    Result,
    compute,
    compute_all,
    in_turn,
    partial,
    place_of,
    require_portable,
    together,
)
from reference.dataset.catalogue import PROFILES, is_family_name
from reference.dataset.checksums import CHECKSUMS, checksums, note_checksum, require_notable
from reference.dataset.claims import attributes
from reference.dataset.errors import DatasetError
from reference.dataset.files import destination, replacing, sha256, temporaries
from reference.dataset.writer import writing
from reference.names import is_grid_file, short, unknown
from reference.routes.agreement import ROUTES
from reference.version import __version__

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from reference.dataset.blocks import Partial
    from reference.dataset.plan import Plan
    from reference.dataset.writer import Writer
    from reference.declaration import Row

__all__ = ["build", "provenance"]

TOOLS = ("heyoka", "mpmath", "gmpy2", "python-flint", "h5py", "numpy")
DISK_FULL = {errno.ENOSPC, errno.EFBIG, errno.EDQUOT}
SPACE = 2.5
"""Bytes needed on the way for each byte of numbers: the blocks, the file, and their overhead."""


def build(
    plan: Plan,
    out: str | os.PathLike[str],
    *,
    jobs: int = 1,
    executor: str = "process",
    progress: Callable[[int, int], None] | None = None,
) -> str:
    """Build the dataset of a plan as the file ``out`` and note its checksum beside it; return its fingerprint.

    The old file stays until the new one takes its place.  ``progress(done, all)`` is called after each block.

    Raises:
        OSError: ``out`` is a folder, its folder is missing or cannot be written, the disk is full, or what stands in
            the place of the unfinished blocks, ``out.partial``, is not ours.
        DatasetError: the list of checksums beside it is damaged or cannot be written.
        ArithmeticError: the routes disagree, or a value could not be decided; names the problem and its values.
        ValueError, ImportError: SOURCE_DATE_EPOCH is no number of seconds; the profile or the executor is unknown, or
            its package is not installed.
        BusyError, WorkerError: another build of the same file is running; a worker process died.
    """
    if plan.profile not in PROFILES and not is_grid_file(plan.profile):
        raise ValueError(f"{unknown('profile', plan.profile, PROFILES)[:-1]}, and names of grid files.")
    for family in plan.families:
        if not is_family_name(family):
            raise ValueError(f"a family of the plan is called '{short(family)}'; MODULE:NAME is accepted.")
    require_portable([group.layout for group in plan.groups], executor, jobs)
    target = destination(out)
    if target.name == CHECKSUMS:
        raise OSError(f"'{out}' is the list of checksums beside the datasets; choose another output path.")
    require_notable(target.parent)
    made_with = provenance()
    before = Standing.of(target)
    try:
        with partial(target, plan.identity(__version__)) as finished:
            _ensure_space(plan, target)
            _prove(plan, finished, jobs, executor, progress or (lambda _done, _all: None))
            return _write(plan, target, finished, made_with)
    except PlaceError:
        raise
    except OSError as error:
        reason = "the disk is full" if error.errno in DISK_FULL else error.strerror or str(error)
        raise OSError(before.outcome(out, reason)) from None
    except DatasetError as error:
        if before.is_replaced:
            raise OSError(before.outcome(out, str(error).rstrip("."))) from None
        raise


@dataclass(frozen=True)
class Standing:
    """The file and the checksum that stand at an output before it is built."""

    target: Path
    status: os.stat_result | None
    noted: str | None

    @classmethod
    def of(cls, target: Path) -> Standing:
        """What stands there now."""
        return cls(target, _status(target), checksums(target.parent).get(target.name))

    @property
    def is_replaced(self) -> bool:
        """Whether another file stands there by now."""
        now = _status(self.target)
        return now is not None and (self.status is None or not os.path.samestat(now, self.status))

    def restore(self) -> None:
        """Note the checksum of the file again, where it still stands there."""
        if self.noted is not None and not self.is_replaced:
            note_checksum(self.target, self.noted)

    def outcome(self, out: str | os.PathLike[str], reason: str) -> str:
        """What became of a build that failed for a reason, by what is on the disk, in one sentence."""
        home = place_of(self.target)
        left = [f"'{name}'" for name in ([home.name] if os.path.lexists(home) else []) + temporaries(self.target)]
        remains = f"{' and '.join(left) or 'nothing'} was left behind"
        if self.is_replaced:
            noted = checksums(self.target.parent).get(self.target.name) is not None
            missing = "what it was made from was not removed" if noted else "its checksum was not noted"
            return f"'{out}' was written, but {missing}: {reason}; {remains}."
        if checksums(self.target.parent).get(self.target.name) != self.noted:
            remains += f", and the line of the old file in {CHECKSUMS} was lost"
        return f"'{out}' was not written: {reason}; {remains}."


def _status(target: Path) -> os.stat_result | None:
    return target.stat() if target.is_file() else None


def _ensure_space(plan: Plan, target: Path) -> None:
    needed, free = int(SPACE * plan.size), shutil.disk_usage(target.parent).free
    if free < needed:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def _prove(plan: Plan, finished: Partial, jobs: int, executor: str, progress: Callable[[int, int], None]) -> None:
    """Prove every task of which a block is not finished yet, as a whole: what it shares does not depend on the rest."""
    tasks = deque(together(in_turn(plan.groups)))
    total = sum(map(len, tasks))
    tasks = deque(task for task in tasks if not all(finished.has(block.key) for block in task))
    done = total - sum(map(len, tasks))
    progress(done, total)
    workers = max(1, min(jobs, len(tasks))) if jobs > 0 else jobs
    begun = (tasks.popleft() for _ in range(len(tasks)))
    with opened(executor, workers) as pool:
        for several, found in results(pool, compute_all, begun, workers):
            for block, result in zip(several, found, strict=True):
                finished.put(block.key, result.dumped())
                done += 1
            progress(done, total)


@dataclass
class Tally:
    """What is known of one variable besides its values, gathered block by block."""

    row: Row
    decimals: list[str] = field(default_factory=list)
    digits: list[float] = field(default_factory=lambda: [math.inf] * len(ROUTES))
    checked: list[int] = field(default_factory=lambda: [0] * len(ROUTES))
    elements: int = 0

    def add(self, result: Result, component: int) -> None:
        """Add the variable's share of a block."""
        self.elements += len(result.limbs)
        self.decimals += result.decimals[component : component + 1]
        for i in range(len(ROUTES)):
            self.digits[i] = min(self.digits[i], float(result.digits[i, component]))
            self.checked[i] += int(result.checked[i, component])

    def attributes(self) -> dict[str, str | float | int]:
        """The attributes that a variable carries of it."""
        return attributes(self.row, self.digits, self.checked, self.decimals)


def _write(plan: Plan, target: Path, finished: Partial, made_with: Mapping[str, str]) -> str:
    """Write the finished blocks in the order of the plan, and let the file take its place."""
    before = Standing.of(target)
    try:
        with replacing(target) as temporary:
            with writing(temporary, plan) as writer:
                _fill(plan, writer, finished)
                fingerprint = writer.finish(__version__, plan, made_with)
            digest = sha256(temporary)
            note_checksum(target, None)
        note_checksum(target, digest)
    except BaseException:
        with suppress(OSError, DatasetError):  # the error that is under way says what became of it
            before.restore()
        raise
    return fingerprint


def _fill(plan: Plan, writer: Writer, finished: Partial) -> None:
    tallies: dict[str, Tally] = {}
    trajectories: dict[tuple[str, int, str], list[int]] = {}
    for block in plan.blocks():
        data = finished.get(block.key)
        result = (None if data is None else Result.loaded(data)) or compute(block)
        writer.put(block, result.limbs)
        for i, quantity in enumerate(block.row.quantities):
            tallies.setdefault(f"{block.layout.path}/{quantity.name}", Tally(block.row)).add(result, i)
        so_far = trajectories.setdefault((block.layout.path, block.element, block.row.name), [0] * len(ROUTES))
        so_far[:] = [a + int(b) for a, b in zip(so_far, result.checked[:, 0], strict=True)]
    _require_checked(trajectories)
    for path, tally in tallies.items():
        writer.describe(path, tally.attributes())


def _require_checked(trajectories: dict[tuple[str, int, str], list[int]]) -> None:
    """A route that serves a row at all must have been compared on every instance of it."""
    served: dict[tuple[str, str], list[int]] = {}
    for (path, _, row), checked in trajectories.items():
        most = served.setdefault((path, row), [0] * len(ROUTES))
        most[:] = [max(a, b) for a, b in zip(most, checked, strict=True)]
    for (path, row), most in served.items():
        if not any(most):
            raise ArithmeticError(f"{row} of {path} was compared with no route; {' or '.join(ROUTES)} has to reach it.")
    for (path, element, row), checked in trajectories.items():
        for route, serves, here in zip(ROUTES, served[path, row], checked, strict=True):
            if serves and not here:
                raise ArithmeticError(f"{row} of {path} at element {element} was not compared with the {route} route.")


def provenance() -> dict[str, str]:
    """What the file was made with: versions and processor, and the date only where SOURCE_DATE_EPOCH gives one.

    Raises:
        ValueError: SOURCE_DATE_EPOCH is no whole number of seconds.
    """
    found = {tool.replace("-", "_"): installed(tool) for tool in TOOLS}
    found |= {"python": platform.python_version(), "platform": platform.platform(), "cpu": _cpu()}
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    if epoch is not None:
        if not (epoch.isascii() and epoch.isdecimal()) or len(epoch) > 11:
            accepted = "a whole number of seconds since 1970, of 11 digits at most, is accepted"
            raise ValueError(f"SOURCE_DATE_EPOCH is '{epoch}'; {accepted}.")
        found["date"] = datetime.fromtimestamp(int(epoch), UTC).isoformat()
    return found


def _cpu() -> str:
    listing = Path("/proc/cpuinfo")
    lines = listing.read_text(encoding="utf-8").splitlines() if listing.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return next(iter(names), "") or platform.processor() or platform.machine()
