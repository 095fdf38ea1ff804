"""What tells a problem from others of its study: the inputs of each family, and how its tables name what they hold."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from compare.march.aspects import aspect_of, conserves, period_of
from compare.measure.records import Case

if TYPE_CHECKING:
    from reference.problem import Problem

__all__ = ["case_of"]

FORMS = {
    "cycloid": "motion",
    "cycloid arc": "curve",
    "tautochrone": "angle",
    "cycloidal pendulum": "arc",
    "polar": "time",
    "polar curve in z": "z",
    "polar curve in psi": "psi",
}
"""The forms of one family's equations, by the names of the problems."""
INPUTS = {
    "pendulum": ("theta0", "omega0"),
    "linear pendulum": ("theta0", "omega0"),
    "cycloid": ("end_x", "end_y"),
    "cycloid arc": ("radius",),
    "tautochrone": ("angle",),
    "cycloidal pendulum": ("arc",),
    "descent": ("curve", "released"),
    "polar": ("z0",),
    "tunnel": ("z0",),
    "polar curve in z": ("z0",),
    "polar curve in psi": ("z0",),
}
"""The attributes of a problem that tell it from others of its family."""
UNITS = {"theta0": "rad", "omega0": "rad/s", "end_x": "m", "end_y": "m", "radius": "m", "angle": "rad", "arc": "m"}
STEPS = {"time": "s", "height": "m", "psi": "rad"}
"""Units of the step by what a state is a function of."""


def case_of(problem: Problem) -> Case:
    """The problem in a few words."""
    return _case(problem, repr(problem))


@lru_cache(maxsize=256)
def _case(problem: Problem, text: str) -> Case:
    """The same, kept; equal problems may be spelt otherwise."""
    aspect, over = aspect_of(problem), problem.row("state").over
    form = FORMS.get(problem.name, "")
    inputs = {name: _value(getattr(problem, name)) for name in INPUTS.get(problem.name, ())}
    shown = {name: value for name, value in inputs.items() if not (name in {"omega0", "released"} and not value)}
    words = [f"{name} = {value!r} {UNITS.get(name, '')}".rstrip() for name, value in shown.items()]
    words = [word.replace("'", "") for word in words] or [text]
    step = STEPS.get(over, "")
    period = math.isfinite(period_of(problem))
    return Case(
        problem=text,
        inputs=(*((("form", form),) if form else ()), *shown.items()),
        label=", ".join([*([_in_words(form)] if form else []), *words]),
        error=_error(problem),
        unit=aspect.angle,
        samples="times" if over in {"time", "tau"} else "points",
        step=step,
        drift=aspect.invariant if conserves(problem) else None,
        energy=problem.serves("energy"),
        cycle="period" if period else step or "unit",
        axes=_axes(problem),
    )


def _axes(problem: Problem) -> tuple[str, ...]:
    """The names of place and velocity with their units."""
    if problem.name == "pendulum":
        return "angle θ [rad]", "angular velocity ω [rad/s]"
    if not aspect_of(problem).rates:
        return ()
    named = [f"{quantity.long_name} [{quantity.units}]" for quantity in problem.row("state").quantities[:2]]
    return tuple(name.removesuffix(" [1]") for name in named)


def _value(value: Any) -> Any:
    """A number as a double, a curve as its name."""
    return value.name if hasattr(value, "name") else float(value)


def _in_words(form: str) -> str:
    return {
        "motion": "motion",
        "curve": "curve dx/dy",
        "angle": "by the angle",
        "arc": "by the arc",
        "time": "in time",
        "z": "curve dphi/dz",
        "psi": "curve dphi/dpsi",
    }[form]


def _error(problem: Problem) -> str:
    """What the error of the place is, and what it is measured in."""
    aspect = aspect_of(problem)
    names = [problem.state_names[i] for i in aspect.places]
    if len(names) > 1:
        return f"error of {' or '.join(names)} relative to its largest value"
    return f"|{names[0]} - exact|" + ("" if aspect.angle else f"/max |{names[0]}|")
