"""Units as tables name them: which are those of the truth, and by what others are to be multiplied."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Unit", "named", "split_name", "unit"]

SECONDS = {
    "s": "1", "sec": "1", "secs": "1", "second": "1", "seconds": "1", "sek": "1", "sekunden": "1", "secondes": "1",
    "ms": "0.001", "msec": "0.001", "millisecond": "0.001", "milliseconds": "0.001",
    "us": "1e-6", "µs": "1e-6", "usec": "1e-6", "microsecond": "1e-6", "microseconds": "1e-6",
    "ns": "1e-9", "nanosecond": "1e-9", "nanoseconds": "1e-9",
    "min": "60", "minute": "60", "minutes": "60", "h": "3600", "hr": "3600", "hour": "3600", "hours": "3600",
    "day": "86400", "days": "86400",
}  # fmt: skip
RADIANS = {
    "rad": "1", "rads": "1", "radian": "1", "radians": "1", "mrad": "0.001", "µrad": "1e-6", "urad": "1e-6",
    "krad": "1000",
    "deg": "pi/180", "degs": "pi/180", "degree": "pi/180", "degrees": "pi/180", "°": "pi/180", "º": "pi/180",
    "grad": "pi/200", "gon": "pi/200", "arcmin": "pi/10800", "arcsec": "pi/648000",
    "rev": "2*pi", "revs": "2*pi", "turn": "2*pi", "turns": "2*pi", "cycles": "2*pi",
}  # fmt: skip
METRES = {"m": "1", "metre": "1", "metres": "1", "meter": "1", "meters": "1", "mm": "0.001", "cm": "0.01", "km": "1000"}
BASES = {"s": SECONDS, "rad": RADIANS, "m": METRES}
WHOLE = {
    "rpm": ("rad s-1", "pi/30"),
    "1": ("1", "1"),
    "hz": ("rad s-1", "2*pi"),
}
"""Units that are no quotient of the others."""
LONGEST = 80
"""Characters of a name that says its unit."""
OVER = "|".join(sorted(SECONDS, key=len, reverse=True))
RECIPROCALS = {"1": "1", "0.001": "1000", "1e-6": "1e6", "1e-9": "1e9"}
"""What a factor below is above."""
INVERSE = re.compile(rf"1?(?:/|per)(?P<over>{OVER})|(?P<inverse>{OVER})-1")
QUOTIENT = re.compile(rf"(?P<of>\D+?)(?:(?:/|per)(?P<over>{OVER})|(?P<inverse>{OVER})-1)")
BRACKETS = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<square>[^][]*)\]|\((?P<round>[^()]*)\)|\{(?P<brace>[^{}]*)\})")
QUANTITY = re.compile(r"(?P<name>(?:[^][(){}/,]|\([^()]*\)|\[[^][]*\])+?)\s*[/,]\s*(?P<unit>.+)")
"""A quantity and its unit as ISO 80000 writes them, theta/rad; or after a comma."""
SUFFIX = re.compile(
    r"(?P<name>.+?)_(?:in_)?(?P<unit>s|sec|ms|us|ns|min|m?rad|deg(?:rees)?|(?:m?rad|deg|m)_(?:per_)?s|mm|cm)"
)


class Unit(NamedTuple):
    """What is measured, in its unit of the truth such as "rad s-1", and the factor that leads to that."""

    of: str
    factor: str


def unit(text: str) -> Unit | None:
    """The unit that a text names, with its brackets or without; None where it is none that is known."""
    if len(text) > LONGEST:
        return None
    bare = text.strip().strip("[](){}<>").strip().casefold().replace("μ", "µ")
    for old, new in (("⁻¹", "-1"), ("−", "-"), ("^(-1)", "-1"), ("^", ""), ("{", ""), ("}", "")):
        bare = bare.replace(old, new)
    bare = re.sub(r"[\s·⋅*.]+", "", bare)
    if bare in WHOLE:
        return Unit(*WHOLE[bare])
    for base, names in BASES.items():
        if bare in names:
            return Unit(base, names[bare])
    return _quotient(bare)


def _quotient(bare: str) -> Unit | None:
    """The unit that is another over a time; None where it is none that is known."""
    if match := INVERSE.fullmatch(bare):
        return Unit("s-1", _over("1", match))
    match = QUOTIENT.fullmatch(bare)
    for base, names in BASES.items():
        if match and match["of"] in names:
            return Unit(f"{base} s-1", _over(names[match["of"]], match))
    return None


def _over(factor: str, match: re.Match[str]) -> str:
    """A factor over that of the time which a quotient names."""
    divisor = SECONDS[match["over"] or match["inverse"]]
    if divisor not in RECIPROCALS:
        return f"{factor}/{divisor}"
    times = RECIPROCALS[divisor]
    return factor if times == "1" else times if factor == "1" else f"{factor}*{times}"


def split_name(name: str) -> Iterator[tuple[str, str]]:
    """A column's name as it may be meant: without and with what it says of its unit, "" where it says none."""
    if len(name) > LONGEST:
        yield name, ""
        return
    match = BRACKETS.fullmatch(name)
    if match and match["name"]:
        yield match["name"], match["square"] or match["round"] or match["brace"] or ""
    yield name, ""
    for pattern in (QUANTITY, SUFFIX):
        match = pattern.fullmatch(name)
        text = match["unit"].replace("_per_", "/").replace("_", "/") if match else ""
        if match and unit(text):
            yield match["name"], text


def named(found: Unit, text: str) -> str:
    """How a unit that a text names is spoken of."""
    return "degrees" if found.factor == "pi/180" else text.strip().strip("[](){}<>").strip()
