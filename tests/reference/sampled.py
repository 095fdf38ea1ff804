"""Random elements of a dataset against ``recomputed``, at three times the precision of three limbs."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from independent import correct_limbs, fraction
from recomputed import RECOMPUTED

from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    import random
    from collections.abc import Iterator

    from reference.dataset.reader import Dataset, Variable

__all__ = ["elements", "misrounded"]

SLOW = (
    *(f"race/{name}" for name in ("x", "y", "speed", "velocity_x", "velocity_y")),
    *(f"motion/{name}" for name in ("z", "z_rate", "phi")),
    *(f"{group}/{name}" for group in ("family", "boundary") for name in ("chord_time", "chord_gap")),
    "boundary/z0",
    "boundary/arrival_time",
    "neighbour_gap",
)
"""Variables that take an integral in mpmath, or many, for each element."""
SLOWER = 12
BITS = 3 * 159
GUARD_BITS = 240
"""What times up to 2^30, angles close to pi and differences of like numbers may cost."""


def elements(dataset: Dataset, each: int, rng: random.Random) -> Iterator[tuple[Variable, tuple[int, ...]]]:
    """At most ``each`` elements of every variable, at random places; fewer where one takes a second or more."""
    for variable in dataset.values():
        if variable.is_input:
            continue
        size, wanted = variable.value.size, -(-each // SLOWER) if variable.name.endswith(SLOW) else each
        for flat in rng.sample(range(size), min(wanted, size)):
            index = []
            for length in reversed(variable.shape):
                flat, place = divmod(flat, length)  # noqa: PLW2901 - digits of the number, the last axis first
                index.append(place)
            yield variable, tuple(reversed(index))


def misrounded(dataset: Dataset, variable: Variable, index: tuple[int, ...]) -> str:
    """What is wrong with one element's limbs; empty where nothing is."""
    group, _, name = variable.name.rpartition("/")
    with mp.workprec(BITS + GUARD_BITS):
        given, argument = _inputs(dataset, variable, group, index)
        found = fraction(mp.mpf(RECOMPUTED[group](given, argument)[name]()))
    value, tail = variable.value[index].item(), variable.tail[index].tolist()
    stored = [value, *tail]
    if correct_limbs(found, 3) == stored:
        return ""
    # An exact value is three limbs and no more; the computation misses it by its own error.
    missed = abs(found - sum(map(Fraction, stored)))
    if missed <= Fraction(2) ** -BITS * max(1, abs(found)):
        return ""
    return f"{variable.name}{list(index)} is stored as {stored}, and {correct_limbs(found, 3)} by another computation"


def _inputs(dataset: Dataset, variable: Variable, group: str, index: tuple[int, ...]) -> tuple[dict[str, Any], Any]:
    """The exact inputs of the element by name, and the argument along its last axis."""
    given = {name: mp.mpf(number) for name, number in dataset.parameters[f"/{group}"].items()}
    layout = next(layout for layout in dataset.layouts if layout.path == f"/{group}")
    for instance in layout.instances:
        given[instance.name] = mp.mpf(dataset[f"{group}/{instance.name}"].value[index[0]].item())
    lead = {axis.name for axis in layout.first}
    along = [dim for dim in variable.dims if dim not in lead]
    argument = mp.mpf(dataset[f"{group}/{along[0]}"].value[index[-1]].item()) if along else None
    return given, argument
