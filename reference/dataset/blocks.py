"""One block of work: the proven limbs of a stretch of a row, and how far the other routes agree with them."""

from __future__ import annotations

import hashlib
import io
import zipfile
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.limbs import to_limbs
from reference.dataset.claims import DECIMAL_DIGITS
from reference.routes import enclosure
from reference.routes.agreement import ROUTES, agreement

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.family import Block

__all__ = ["LIMBS", "START_BITS", "Result", "compare", "compute", "decimals", "prove"]

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
