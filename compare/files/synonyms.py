"""Other names of the time and the state, as programs give them: of the same letter, or a derivative by its function."""

from __future__ import annotations

from functools import cache

__all__ = ["same_as"]

TIMES = frozenset({
    "time", "times", "zeit", "temps", "tiempo", "tempo", "tid", "tijd", "x_value",
})  # fmt: skip
"""What the column of t is called: by words of several languages, and by LabVIEW."""
LETTERS = {"theta": "θϑ", "omega": "ω", "phi": "φϕ", "tau": "τ"}
RATES = {"omega": "theta", "angular_velocity": "angle", "arc_rate": "arc", "place_rate": "place", "z_rate": "z"}
"""The names of derivatives, and of what they are derivatives."""
DERIVED = (
    "der({0})", "d({0})/dt", "d({0},t)", "diff({0},t)", "diff({0}(t),t)", "diff({0}(t), t)", "d{0}/dt",
    "d{0}_dt", "d{0}dt", "{0}dot", "{0}_dot", "{0} dot", "{0}'", "{0}′", "{0}’", "{0}'(t)", "{0}(t)'", "{0}̇",
    "{0}_prime", "{0}prime", "dot({0})", "dot_{0}", "derivative({0})", "derivative({0}(t), t)",
)  # fmt: skip


@cache
def same_as(name: str, wanted: tuple[str, ...]) -> frozenset[str]:
    """The other names, in small letters, of the one called ``name`` among those of the time and the state."""
    found = set(TIMES) if name == "t" else set()
    letters = {*LETTERS.get(name, "")}
    found |= letters | {f"{each}(t)" for each in (name, *letters)}
    function = RATES.get(name, "")
    if function in wanted:
        spellings = (function, *LETTERS.get(function, ""))
        found |= {form.format(each) for form in DERIVED for each in spellings}
    return frozenset(each.casefold() for each in found)
