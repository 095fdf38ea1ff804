"""The options of the commands that score methods on a family, without what takes time to import.

Each family has its own inputs, named as the reference's command line names them; the rest is the same for all.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.measure.wanted import DEFAULT_SCORES, SCORES
from compare.show.render import FORMATS
from reference.command import values
from reference.command.terminal import one_of

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

__all__ = ["ROOMS", "Room"]

POWERS = "128, 256, ... "


@dataclass(frozen=True)
class Option:
    """An option of a family: how it is shown, what it is for, how its words are read, and whether it may repeat."""

    metavar: str
    text: str
    read: Callable[[str, str], Any] | None = None
    several: bool = False


def _number(metavar: str, text: str) -> Option:
    return Option(metavar, text)


def _numbers(metavar: str, text: str) -> Option:
    return Option(metavar, f"{text}; may repeat", several=True)


def _words(metavar: str, text: str) -> Option:
    return Option(metavar, f"{text}; may repeat", values.text, several=True)


GRAVITY = _number("G", "gravity in m/s^2 (default 9.81)")
END_OF_MARCH = _number("T", "end of the march in s (default 10)")
FAMILIES: dict[str, dict[str, Option]] = {
    "pendulum": {
        "theta0": _numbers("A,B", "amplitudes in rad, between 0 and pi (default 1), or with --omega0 angles"),
        "omega0": _number("W", "angular velocity of the start in rad/s; without it, released from rest"),
        "g": GRAVITY,
        "length": _number("L", "length in m (default 1)"),
        "t-end": END_OF_MARCH,
    },
    "brachistochrone": {
        "end": Option("X,Y", "end point in m, y downward (default pi,2); may repeat", several=True),
        "g": GRAVITY,
        "form": _words("A,B", "motion (along the arc), curve (dx/dy, singular at the bottom); default both"),
        "t-end": _number("T", "end of the motion's march in s (default 10)"),
        "depth": _number("Y", "end of the curve's march in m (default 0.99995 of the way to the bottom)"),
    },
    "tautochrone": {
        "angle": _numbers("A,B", "angles of the start in rad, from the bottom (default 1)"),
        "radius": _number("R", "radius of the rolling circle in m (default 1)"),
        "g": GRAVITY,
        "form": _words("A,B", "angle, arc; default both"),
        "t-end": END_OF_MARCH,
    },
    "descent": {
        "curve": _words("CURVE", "a name of the race, or a formula (default quartic and cycloid)"),
        "start": Option("X", "where x or p of a formula begins, such as pi", values.text),
        "end": Option("X", "where x or p of a formula ends, such as 0", values.text),
        "g": GRAVITY,
        "t-end": _number("T", "end of the march in s (default: almost the end of the curve)"),
    },
    "polar": {
        "z0": _numbers("A,B", "heights of the lowest point over the radius of the release (default 0.5)"),
        "form": _words("A,B", "time, z (dphi/dz, singular at the lowest point), psi (smooth); default all"),
        "tau-end": _number("TAU", "end of the motion's march in units of sqrt(r0^3/(2 G M)) (default 10)"),
        "z-end": _number("Z", "end of the curve's march in z (default 1e-4 of the way above the lowest point)"),
        "psi-end": _number("PSI", "end of the curve's march in psi in rad (default 6.25)"),
    },
}
LAST = {"pendulum": 2**20}
"""The largest number of steps of a study that names none."""


@dataclass(frozen=True)
class Room:
    """The options of one command."""

    family: str

    def add_options(self, parser: argparse.ArgumentParser) -> None:
        """Add them to a parser."""
        for name, option in FAMILIES[self.family].items():
            action = "append" if option.several else "store"
            parser.add_argument(f"--{name}", action=action, metavar=option.metavar, help=option.text)
        several: dict[str, Any] = {"action": "append", "metavar": "A,B"}
        last = LAST.get(self.family, 2**17)
        parser.add_argument(
            "--methods", **several, help="methods by name (default twelve; see 'list'), or all; may repeat"
        )
        parser.add_argument("--n", **several, help=f"numbers of steps (default {POWERS}{last}); may repeat")
        scores = f"{', '.join(SCORES)} (default {', '.join(DEFAULT_SCORES)})"
        parser.add_argument("--scores", **several, help=f"what is shown: {scores}; may repeat")
        flags = {
            "exact": "take numbers as written: decimals, or fractions such as 1/3",
            "compensated": "beside each method the same with compensated summation",
            "plots": f"also draw PNG and SVG figures (into DIR, or ./horologium-{self.family})",
            "quiet": "nothing on stderr but errors; the tables are printed as ever",
        }
        precision = "float32, float64 (default), longdouble, float128 or mp:BITS"
        parser.add_argument("--precision", metavar="P", help=precision)
        shown = f"{', '.join(FORMATS)} (default text)"
        parser.add_argument("--format", type=one_of("format", FORMATS), default="text", metavar="FORM", help=shown)
        into = "also write the tables, in the chosen format, into this folder"
        parser.add_argument("--out", metavar="DIR", help=into)
        for name, text in flags.items():
            parser.add_argument(f"--{name}", action="store_true", help=text)

    def options(self, known: argparse.Namespace) -> dict[str, Any]:
        """The arguments of the study, only those that were given."""
        number = values.as_written if known.exact else values.number
        given: dict[str, Any] = {}
        for name, option in FAMILIES[self.family].items():
            words = getattr(known, name.replace("-", "_"))
            if words is not None:
                given[name.replace("-", "_")] = _read(name, words, option, number)
        for name, read in (("methods", values.text), ("n", values.whole), ("scores", values.text)):
            if getattr(known, name) is not None:
                given[name] = values.several(name, getattr(known, name), read)
        if known.precision is not None:
            given["precision"] = known.precision
        if known.compensated:
            given["compensated"] = "beside"
        return given


def _read(name: str, words: Any, option: Option, number: Callable[[str, str], Any]) -> Any:
    """The words of an option as values."""
    read = option.read or number
    if not option.several:
        return read(words, name)
    if option.metavar == "X,Y":
        return tuple(values.pair(word, name, number) for word in words)
    return values.several(name, words, read)


ROOMS = {family: Room(family) for family in FAMILIES}
"""The rooms of all families."""
