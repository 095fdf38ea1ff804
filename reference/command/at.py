"""One proven value, now: how a family is asked for at the command line, and how it answers."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import as_number, exact, expansion
from reference.consistency import consistent
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from reference.certified import Certified
    from reference.constants import Constant
    from reference.family import Family, Input

__all__ = [
    "DIGITS_LIMIT",
    "METAVARS",
    "as_json",
    "as_text",
    "digits_count",
    "number",
    "pair",
    "quantities",
    "read",
    "text",
]

DIGITS_LIMIT = 30_000
"""Digits that the bound on the working precision leaves room for."""


def number(name: str, text: str, *, as_written: bool) -> Fraction:
    """A number of the command line: the binary64 number that it spells in a program, or exactly as written.

    Raises:
        ValueError: it spells no finite number.
    """
    if as_written:
        return exact(text, name)
    try:
        value = float(text)
    except ValueError:
        _ = exact(text, name)  # says so where it is no number at all
        raise ValueError(f"{name} is '{text}', a fraction; with --exact fractions are taken as written.") from None
    return exact(value, name)


def pair(name: str, text: str, *, as_written: bool) -> tuple[Fraction, Fraction]:
    """Two numbers with a comma between them.

    Raises:
        ValueError: there are not two, or one spells no finite number.
    """
    parts = text.split(",")
    if len(parts) != 2:
        raise ValueError(f"{name} is '{short(text)}'; two numbers with a comma between them are accepted, such as 2,1.")
    first, second = (number(name, part, as_written=as_written) for part in parts)
    return first, second


def text(name: str, text: str, *, as_written: bool) -> str:
    """A name or a formula, as it is."""
    del name, as_written
    return text


READERS: dict[str, Callable[..., Any]] = {"number": number, "pair": pair, "text": text}
METAVARS = {"number": "NUMBER", "pair": "NUMBER,NUMBER", "text": "TEXT"}
"""How the place of an input is shown in the usage."""


def read(wanted: Input, word: str, *, as_written: bool) -> Any:
    """The word of an input as its value.

    Raises:
        ValueError: it spells none.
    """
    return READERS[wanted.kind](wanted.name, word, as_written=as_written)


def digits_count(text: str) -> int:
    """The number of digits asked for.

    Raises:
        ValueError: it is not an integer from 1 to DIGITS_LIMIT.
    """
    count = int(text) if text.isascii() and text.isdigit() and len(text) <= len(str(DIGITS_LIMIT)) else 0
    if not 1 <= count <= DIGITS_LIMIT:
        raise ValueError(f"digits is '{short(text)}'; an integer from 1 to {DIGITS_LIMIT} is accepted.")
    return count


def quantities(family: Family, inputs: Mapping[str, Any]) -> list[Certified]:
    """The family's quantities at the given inputs, each a proven number.

    Raises:
        ValueError: an input is not acceptable, nothing is a function of it, or two of them give a quantity of the same
            name.
    """
    arguments = {asked.over: inputs[asked.name] for asked in family.inputs if asked.over and asked.name in inputs}
    arguments["once"] = None
    along = {asked.name for asked in family.inputs if asked.over}
    problem = family.problem(**{name: value for name, value in inputs.items() if name not in along})
    if problem.serves("state"):
        consistent(problem)
    rows = {row.name: row for row in problem.rows}
    found = [
        problem.certified(name, arguments[rows[name].over], component)
        for name in family.rows
        if problem.serves(name) and rows[name].over in arguments
        for component in range(len(rows[name].quantities))
    ]
    _require_single(family, found)
    answered = {rows[value.row].over for value in found}
    for asked in family.inputs:
        if asked.over in arguments and asked.over not in answered:
            raise ValueError(f"--{asked.name} asks for nothing that {problem!r} has.")
    if not found:
        names = " or ".join(f"--{asked.name}" for asked in family.inputs if asked.over)
        raise ValueError(f"nothing is asked of {problem!r}; {names} is accepted.")
    return found


def _require_single(family: Family, found: list[Certified]) -> None:
    """Refuse arguments that give the same name two values."""
    asked = {wanted.over: wanted.name for wanted in family.inputs}
    first: dict[str, Certified] = {}
    for value in found:
        other = first.setdefault(value.quantity.name, value)
        if other is not value:
            names = " and ".join(f"--{asked[one.problem.row(one.row).over]}" for one in (other, value))
            raise ValueError(f"{names} both give {value.quantity.name}; one of them is accepted.")


def as_json(found: list[Certified], digits: int, *, routes: bool) -> str:
    """One object: name to decimal string; with ``routes`` also "routes", name to digits agreed by each.

    Where the values are by a constant of nature, "constants" holds its value, units and source.
    """
    answer: dict[str, object] = {value.quantity.name: value.digits(digits) for value in found}
    if constants := _constants(found):
        answer["constants"] = {constant.name: constant.as_json() for constant in constants}
    if routes:
        answer["routes"] = {value.quantity.name: _agreed(value) for value in found}
    return json.dumps(answer, indent=2)


def as_text(family: Family, inputs: Mapping[str, Any], found: list[Certified], digits: int, *, routes: bool) -> str:
    """The inputs as they were solved, then one line a quantity with its units."""
    units = {asked.name: asked.units for asked in family.inputs}
    lines = [f"{family.name}: {family.help}", "inputs, exact:"]
    lines += [f"  {name} = {_shown(value)}{_unit(units[name])}" for name, value in inputs.items()]
    if constants := _constants(found):
        lines.append("constants, exact:")
        lines += [f"  {constant}" for constant in constants]
    lines.append(f"values, {digits} significant digits, every one proven:")
    for value in found:
        lines.append(f"  {value.quantity.name} = {value.digits(digits)}{_unit(value.quantity.units)}")
        if routes:
            agreed = ", ".join(f"{route} {count:.1f} digits" for route, count in _agreed(value).items())
            lines.append(f"    agreed by {agreed}" if agreed else "    no other route reaches it")
    return "\n".join(lines)


def _unit(units: str) -> str:
    """As it is told after a number; of a pure number none is."""
    return "" if units in ("", "1") else f" {units}"


def _constants(found: list[Certified]) -> tuple[Constant, ...]:
    """The constants of nature that the problem's parameters come from."""
    return found[0].problem.constants if found else ()


def _agreed(value: Certified) -> dict[str, float]:
    return {route: digits for route, digits in value.routes.items() if route != "enclosure"}


def _shown(value: Any) -> str:
    """A binary64 number as decimal repr, exact value and hex float; another number as it is written."""
    if isinstance(value, tuple):
        return ", ".join(_shown(part) for part in value)
    simple = as_number(value) if isinstance(value, Fraction) else value
    if isinstance(simple, str):
        return simple
    whole = expansion(value)
    same = Fraction(repr(simple)) == value
    return f"{simple!r} ({simple.hex()})" if same else f"{simple!r} (exactly {whole}, {simple.hex()})"
