"""One block of work: the proven limbs of a stretch of a row, and how far the other routes agree with them.

The finished blocks of a build are kept in a folder beside the output until it is whole, so that a long one can go on.
"""

from __future__ import annotations

import hashlib
import io
import os
import pickle
import re
import zipfile
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.limbs import to_limbs
from reference.command.marked import BusyError, PlaceError, abandoned, required
from reference.dataset.claims import DECIMAL_DIGITS
from reference.routes import enclosure
from reference.routes.agreement import FLOW_ACCURACY, ROUTES, agreement

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from reference.command.marked import Marked
    from reference.layout import Block, Group, Layout

__all__ = [
    "LIMBS",
    "START_BITS",
    "BusyError",
    "Partial",
    "PlaceError",
    "Result",
    "compare",
    "compute",
    "compute_all",
    "decimals",
    "in_turn",
    "partial",
    "place_of",
    "prepare",
    "prove",
    "require_portable",
    "together",
]

IDENTITY = re.compile(r"[0-9a-f]{64}")
FORM = re.compile(IDENTITY.pattern + r"/([0-9a-f]{32}\.(block|tmp))?")
"""The folder of a plan, and a block in it."""
NO_LINK = os.O_NOFOLLOW | os.O_NONBLOCK


class Partial:
    """The finished blocks of one plan, as bytes by their keys, in an open folder."""

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self._finished = {name for name in os.listdir(handle) if name.endswith(".block")}

    def has(self, key: str) -> bool:
        """Whether the block was finished before; whether it is whole is seen when it is read."""
        return _name(key) in self._finished

    def put(self, key: str, data: bytes) -> None:
        """Keep a finished block: it is there as a whole or not at all."""
        name = _name(key)
        unfinished = name.replace(".block", ".tmp")
        with suppress(FileNotFoundError):
            os.unlink(unfinished, dir_fd=self._handle)
        with open(unfinished, "xb", opener=self._opened) as stream:
            stream.write(data)
        os.replace(unfinished, name, src_dir_fd=self._handle, dst_dir_fd=self._handle)
        self._finished.add(name)

    def get(self, key: str) -> bytes | None:
        """The finished block, or None where there is none."""
        try:
            with open(_name(key), "rb", opener=self._opened) as stream:
                return stream.read()
        except FileNotFoundError:
            return None

    def _opened(self, name: str, flags: int) -> int:
        return os.open(name, flags | NO_LINK, 0o600, dir_fd=self._handle)


def _name(key: str) -> str:
    return hashlib.sha256(key.encode()).hexdigest()[:32] + ".block"


def place_of(target: Path) -> Path:
    """The folder of the unfinished blocks of an output."""
    return target.with_name(target.name + ".partial")


@contextmanager
def partial(target: Path, identity: str) -> Iterator[Partial]:
    """Open the folder ``TARGET.partial`` for a plan of this identity, 64 hexadecimal digits.

    Blocks of another plan or version in it are thrown away.  It is removed when the build is finished, when nothing is
    in it, and when the disk is full or unwritable (OSError); whatever else stops the build, such as an interrupt,
    leaves it for the next one.

    Raises:
        BusyError: another build of the same file is running.
        PlaceError: the folder was not made by us, or holds what was not; it is left as it is.
        OSError: the folder cannot be written.
        ValueError: the identity is of another form.
    """
    if not IDENTITY.fullmatch(identity):
        raise ValueError(f"the identity is '{identity}'; 64 hexadecimal digits are accepted.")
    try:
        for orphan in abandoned(target.parent):
            orphan.remove(FORM.fullmatch)
        home = required(place_of(target), FORM.fullmatch)
    except BusyError:
        raise BusyError(f"another build is writing '{target}'; wait for it or choose another output path.") from None
    except (PermissionError, FileNotFoundError) as error:
        raise PlaceError(
            f"'{target}' cannot be written: no file can be made in that folder ({error.strerror})."
        ) from None
    with home:
        try:
            home.clear(lambda path: FORM.fullmatch(path) and not path.startswith(identity))
            with _inside(home, identity) as finished:
                yield finished
        except BaseException as error:
            if isinstance(error, OSError) or not any(path.endswith(".block") for path in home.paths()):
                with suppress(OSError):  # the error that is under way says more
                    home.remove(FORM.fullmatch)
            raise
        home.remove(FORM.fullmatch)


@contextmanager
def _inside(home: Marked, identity: str) -> Iterator[Partial]:
    with suppress(FileExistsError):
        os.mkdir(identity, 0o700, dir_fd=home.handle)
    handle = os.open(identity, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=home.handle)
    try:
        yield Partial(handle)
    finally:
        os.close(handle)


LIMBS = 3
START_BITS = 53 * LIMBS
QUADRATURE_ELEMENTS = 51
"""Arguments of a block that are held against quadrature, spread evenly from the first to the last."""


@dataclass(frozen=True)
class Result:
    """What a block came to, for its n arguments and q quantities.

    Attributes:
        limbs: float64 (n, q, 3), each limb proven.
        decimals: for a row that is asked once, q decimals of 50 significant digits; else empty.
        digits: float64 (routes, q), the least number of agreeing digits; inf where nothing was compared.
        checked: int64 (routes, q), over how many elements.
    """

    limbs: np.ndarray
    decimals: tuple[str, ...]
    digits: np.ndarray
    checked: np.ndarray

    def dumped(self) -> bytes:
        """The result as bytes, its SHA-256 in front."""
        buffer = io.BytesIO()
        decimals = np.array(self.decimals, dtype=np.str_)
        np.savez(buffer, limbs=self.limbs, decimals=decimals, digits=self.digits, checked=self.checked)
        return hashlib.sha256(buffer.getvalue()).digest() + buffer.getvalue()

    @classmethod
    def loaded(cls, data: bytes) -> Result | None:
        """The result that ``dumped`` these bytes; None where they are damaged."""
        if hashlib.sha256(data[32:]).digest() != data[:32]:
            return None
        try:
            with np.load(io.BytesIO(data[32:]), allow_pickle=False) as found:
                decimals = tuple(str(text) for text in found["decimals"])
                return cls(found["limbs"], decimals, found["digits"], found["checked"])
        except (ValueError, KeyError, zipfile.BadZipFile):
            return None


def together(blocks: Iterable[Block]) -> Iterator[tuple[Block, ...]]:
    """The blocks as tasks: those of a group with texts for inputs together, which share a flow, others one by one."""
    for shared, several in groupby(blocks, lambda block: block.layout.path if block.layout.inputs else ""):
        if shared:
            yield tuple(several)
        else:
            yield from ((block,) for block in several)


def in_turn(groups: Iterable[Group]) -> Iterator[Block]:
    """The blocks of groups as they are begun: those of flows, which take longest, between two halves of the others.

    The first ones tell soon how it goes on, and what is begun last ends soon.
    """
    flows: list[Group] = []
    others: list[Group] = []
    for group in groups:
        (flows if group.layout.inputs else others).append(group)
    flows.sort(key=lambda group: len(group.layout.variables), reverse=True)
    half = len(others) // 2
    for group in (*others[:half], *flows, *others[half:]):
        yield from group.blocks()


def prepare(blocks: Sequence[Block], bits: int) -> None:
    """Where the blocks of a task are of one flow, prove it once for all of them, at so many bits of each value."""
    if blocks[0].layout.inputs:
        asked = [(block.row.name, block.arguments) for block in blocks]
        blocks[0].problem.working.prepare(asked, bits + enclosure.GUARD_BITS)


def compute_all(blocks: tuple[Block, ...]) -> list[Result]:
    """``compute`` of each."""
    prepare(blocks, max(START_BITS, FLOW_ACCURACY))
    return [compute(block) for block in blocks]


def compute(block: Block) -> Result:
    """Prove every value of the block and hold the other routes against it.

    Raises:
        DisagreementError: a route differs within the first 45 digits.
        WorkBoundError: a value could not be decided within the bound on the working precision.
    """
    found = [compare(block, route) for route in ROUTES]
    digits, checked = (np.array([route[part] for route in found]) for part in (0, 1))
    return Result(prove(block, START_BITS), decimals(block), digits, checked)


def decimals(block: Block) -> tuple[str, ...]:
    """For a row that is asked once, the proven decimal of each quantity; else empty."""
    if block.row.over != "once":
        return ()
    problem, components = block.problem, range(len(block.row.quantities))
    return tuple(problem.certified(block.row.name, None, i).digits(DECIMAL_DIGITS) for i in components)


def prove(block: Block, bits: int) -> np.ndarray:
    """The correctly rounded limbs of the block, float64 (n, q, 3), by balls that start at ``bits`` bits."""
    found = enclosure.decide(
        block.problem,
        block.row.name,
        block.arguments,
        *to_limbs(LIMBS),
        bits,
    )
    return np.array(found, dtype=np.float64).reshape(len(block.arguments), -1, LIMBS)


def require_portable(layouts: Sequence[Layout], executor: str, jobs: int) -> None:
    """Refuse layouts that cannot be given to other processes, where these are to work on them.

    Raises:
        ValueError: one holds a function that stands in another or has no name.
    """
    for layout in layouts if jobs > 1 or executor != "process" else ():
        try:
            pickle.dumps(layout)
        except (pickle.PicklingError, AttributeError, TypeError) as error:
            accepted = "functions at the top of a module are accepted, or --jobs 1"
            raise ValueError(f"{layout.path} cannot be given to other processes: {error}; {accepted}.") from None


def compare(block: Block, route: str) -> tuple[list[float], list[int]]:
    """Least digits and number of elements for each quantity, over the arguments that the route serves."""
    arguments: Sequence[Any] = block.arguments
    if route == "quadrature":
        arguments = spread(arguments, QUADRATURE_ELEMENTS)
    elif block.taylor_elements is not None:
        arguments = arguments[: block.taylor_elements]
    while arguments:
        found = agreement(block.problem, block.row.name, arguments, route)
        if found is not None:
            return [quantity.digits for quantity in found], [quantity.checked for quantity in found]
        arguments = arguments[: len(arguments) - max(1, len(arguments) // 16)]
    quantities = len(block.row.quantities)
    return [np.inf] * quantities, [0] * quantities


def spread(arguments: Sequence[Any], count: int) -> Sequence[Any]:
    """At most ``count`` of the arguments, evenly spread, the first and the last among them."""
    if len(arguments) <= count:
        return arguments
    return [arguments[i * (len(arguments) - 1) // (count - 1)] for i in range(count)]
