"""What tells a problem from others of its study, how its tables name what they hold, and which scores it lacks."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING

from compare.march.lanes import drift_scales
from compare.march.precision import precision
from compare.measure.records import Case
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from reference.problem import Problem

__all__ = ["case_of"]

ENOUGH_BITS = 64
"""Working precision at which it is seen whether there are orbits."""
FEW = 4
"""So many positions are named in the title of a table."""


def case_of(problem: Problem) -> Case:
    """The problem in a few words."""
    return _case(problem, repr(problem))


@lru_cache(maxsize=256)
def _case(problem: Problem, text: str) -> Case:
    """The same, kept; equal problems may be spelt otherwise."""
    space, form, inputs = problem.space, problem.form, problem.inputs
    words = [f"{name} = {_shown(value)} {units}".rstrip() for name, (value, units) in inputs.items()] or [text]
    step = space.independent
    return Case(
        problem=text,
        inputs=(
            *((("form", form.name),) if form else ()),
            *((name, value) for name, (value, _) in inputs.items()),
        ),
        label=", ".join([*([form.words] if form else []), *words]),
        error=_error(problem),
        unit=_units(problem, space.positions[0]) if space.scale == "units" else "",
        samples="times" if space.along is None else "points",
        step=step,
        invariants=problem.invariants,
        energy=problem.serves("energy"),
        cycle="period" if math.isfinite(problem.cycle()) else step or "unit",
        axes=_axes(problem),
        pair=space.pairs[0] if space.rates else (),
        absolute=_absolute(problem),
        events=problem.event_words,
        freedom=len(space.pairs),
        lacks=tuple(_lacks(problem).items()),
    )


def _shown(value: float | str) -> str:
    return value.replace("'", "") if isinstance(value, str) else repr(value)


def _units(problem: Problem, component: str) -> str:
    """The units of a component, "" for a pure number."""
    quantities = problem.row("state").quantities
    return quantities[problem.state_names.index(component)].units.removeprefix("1")


def _axes(problem: Problem) -> tuple[str, ...]:
    """The names of the first position and its rate with their units."""
    space = problem.space
    if not space.rates or space.axes:
        return space.axes
    quantities = problem.row("state").quantities
    named = [f"{quantities[i].long_name} [{quantities[i].units}]" for i in space.pairs[0]]
    return tuple(name.removesuffix(" [1]") for name in named)


def _error(problem: Problem) -> str:
    """What the position error is, and what it is measured in."""
    names = problem.space.positions
    absolute = problem.space.scale == "units"
    if len(names) > 1:
        return f"error of {_any_of(names)}" + ("" if absolute else " relative to its largest value")
    return f"|{names[0]} - exact|" + ("" if absolute else f"/max |{names[0]}|")


def _any_of(names: tuple[str, ...]) -> str:
    """One of some names, or of very many."""
    return " or ".join(names) if len(names) <= FEW else f"{', '.join(names[:2])}, ... or {names[-1]}"


def _absolute(problem: Problem) -> str:
    """The position error in the units of the state."""
    names = problem.space.positions
    units = {_units(problem, name) for name in names}
    shared = f", in {next(iter(units))}" if len(units) == 1 and units != {""} else ""
    return f"|{names[0]} - exact|{shared}" if len(names) == 1 else f"error of {_any_of(names)}{shared}"


def _lacks(problem: Problem) -> dict[str, str]:
    """The scores that need what the problem has not, each with the reason."""
    space, found = problem.space, {}
    if not problem.invariants:
        found["drift"] = "nothing is conserved"
    elif not any(drift_scales(problem, precision("float64"))):
        names = ", ".join(one.name for one in problem.invariants)
        found["drift"] = f"nothing but zero is there to divide the change of {names} by"
    with ctx.workprec(ENOUGH_BITS):
        orbital = problem.orbits() is not None
    if not orbital:
        found["phase"] = problem.lacks_of_orbits.removesuffix(".")
    if not math.isfinite(problem.cycle()):
        found["period"] = "no period is declared"
    elif not orbital:
        found["period"] = found["phase"]
    if space.along is not None:
        found["growth"] = "along a curve there is no time to grow in"
    missing = [] if problem.has_momenta else ["there are no momenta"]
    missing += ["turning back means nothing"] if space.odd is None else []
    if missing:
        found["defects"] = ", and ".join(missing)
    return found
