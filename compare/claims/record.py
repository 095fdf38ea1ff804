"""What was found of an integrator, and the verdict in one line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from compare.claims.findings import Findings
from compare.claims.heading import units_of_a_step
from compare.claims.verdicts import Judged, Verdict

if TYPE_CHECKING:
    from compare.claims.defects import Defect
    from compare.claims.energy import Energy
    from compare.claims.verdicts import Standing

__all__ = ["Check"]

ROUNDING = 1e-14
"""A plateau from here down is rounding."""
MORE = 0.4
"""An interval so far above a claim is more than claimed."""


@dataclass(frozen=True)
class Check(Findings, Judged):
    """The findings, in words."""

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """One for each claim that is made."""
        found = (self._verdict(name, standing) for name, standing in self.standings.items())
        return (*found, *self.more)

    def _verdict(self, name: str, standing: Standing) -> Verdict:
        causes = tuple(why for of, why in self._reasons() if of in {None, name})
        if name == "order":
            return Verdict.of(name, f"order {self.claims.order:g}", standing, self._measured_order_words, causes)
        if name == "backward":
            words = f"order {self.claims.order:g} for negative steps"
            return Verdict.of(name, words, standing, self._back_words, causes)
        if name == "conserves":
            told = "; ".join(self._energy_words())
            return Verdict.of(name, "conservation of its invariants", standing, told, causes)
        defect = {"symplectic": self.symplecticity, "reversible": self.reversibility}[name]
        return Verdict.of(name, name, standing, _measured(defect), causes)

    @property
    def verdict(self) -> str:
        """Everything in one line."""
        reasons = [why for _, why in self._reasons()]
        return "; ".join([self._order_words(), *reasons, *self._defect_words(), *self._energy_words()])

    def _reasons(self) -> list[tuple[str | None, str]]:
        """What explains that a claim fails, or would decide it: of which claim, None of all, and the words."""
        parts: list[tuple[str | None, str]] = [] if self.hint is None else [("order", self.hint)]
        if self._times_matter and self.hint is None:
            parts.append(("order", "the time enters f otherwise than it should: a stage is taken at a wrong time"))
        if not self.consistent:
            parts.append((None, f"not consistent: {self._why_inconsistent}"))
        if self.heading.consistent and self.heading.backward == "wrong":
            parts.append((None, "wrong for h < 0: a step back does not go back along f as one forward goes along it"))
        elif self.heading.backward == "refused":
            parts.append((None, "takes no step with h < 0"))
        if self.order_standing == "open":
            parts.append(("order", self._what_would_decide))
        return parts

    @property
    def _why_inconsistent(self) -> str:
        if self.heading.cause is not None:
            return self.heading.cause
        if not self.heading.uses:
            return "it makes no use of f, and moves the same way whatever f is"
        if self.advance is not None and self.advance != 1:
            return f"a constant slope is advanced by {self.advance:.12g} h{units_of_a_step(self.advance)}"
        return "a short step does not go along f"

    @property
    def _what_would_decide(self) -> str:
        if self.short_of_digits:
            return "coefficients of more digits would decide it"
        if self.whole:
            return "one of its steps as a function (f, y, h) would decide it"
        return (
            "plain arithmetic, on numbers that are not turned into floats, and without a branch on what changes with "
            "h, would decide it by the power series in h"
        )

    def _order_words(self) -> str:
        if self.order.kind == "own steps":
            return f"chooses its own steps, error {self.order.cells[-1].error:.0e}"
        claimed = "" if self.claims.order is None else f"claims order {self.claims.order:g}, "
        return claimed + self._measured_order_words

    @property
    def _measured_order_words(self) -> str:
        return self._other_order_words() or self._slope_words()

    def _other_order_words(self) -> str | None:
        """Of an order that no slope tells."""
        order, exact = self.order, self.order_by_series
        interval = "" if order.value is None else f"{order.value:.2f} ± {order.half_width:.2f}"
        if order.kind == "floor":
            return "error at rounding with every step"
        if order.kind == "flat" and not exact:
            return f"does not converge: the error stays at {order.cells[-1].error:.0e}"
        if exact is not None and not self.by_slope:
            slopes = f" (slopes {interval})" * bool(interval)
            return f"order {exact} by its power series in h{slopes}{self._more_words}"
        if order.value is None:
            return "order not to be seen: too few step sizes between coarse and rounding"
        if not self.established or self.order_standing == "open":
            return f"order not established: {interval}"
        return None

    def _slope_words(self) -> str:
        order = self.order
        value, half = self.told
        words = f"measured {value:.2f} ± {half:.2f}{self._more_words}"
        if self.swinging is not None and order is self.swinging and self.still.value is not None:
            words += f" where the time enters, {self.still.value:.2f} where it does not" * (self._times_matter)
        if order.plateau is not None:
            words += f" down to an error of {order.plateau:.0e}, where it stops falling"
            words += ", excused as a tolerance (it may be a fault)" * (self.consistent and order.plateau > ROUNDING)
        return words

    @property
    def _back_words(self) -> str:
        """What is known of the order with h < 0."""
        back = self.back
        return "not measured: it takes no step back, or the motion has no past" if back is None else back.words

    @property
    def _more_words(self) -> str:
        """Where the order is beyond the one that is claimed."""
        order, exact, claim = self.order, self.order_by_series, self.claims.order
        if claim is None:
            return ""
        lowest = exact if exact is not None else (order.value or 0) - order.half_width - MORE
        return ", more than claimed" if lowest > claim else ""

    @property
    def _times_matter(self) -> bool:
        """Whether the order is lower where the time enters, and the intervals are apart: stages are at wrong times."""
        if self.swinging is None or self.swinging.value is None or self.still.value is None:
            return False
        lower = self.still.value - self.swinging.value
        return lower > max(0.5, self.still.half_width + self.swinging.half_width)

    def _defect_words(self) -> list[str]:
        words = []
        for what, claimed, defect in (
            ("symplectic", self.claims.symplectic, self.symplecticity),
            ("reversible", self.claims.reversible, self.reversibility),
        ):
            measured = _measured(defect)
            if defect.lacks:
                words.append(f"{f'claims to be {what}, ' if claimed else f'{what} '}not applicable: {defect.lacks}")
            elif defect.none:
                to = " to the tolerance of its inner iteration" if defect.tolerance else ""
                words.append(f"{what}{to} ({measured})")
            elif defect.undecided:
                words.append(
                    f"{f'claims to be {what}, ' if claimed else f'{what} or not is '}undecided: {measured}, "
                    "the size of a tolerance or of a fault"
                )
            else:
                words.append(f"{f'claims to be {what}, ' if claimed else ''}not {what} ({measured})")
        return words

    def _energy_words(self) -> list[str]:
        return [_kept(one) for one in (self.energy, *self.others)]


def _kept(found: Energy) -> str:
    name, at = found.invariant, f"at h = {found.h:g}"
    return {
        "rounding": f"{name} kept to rounding (error {found.largest:.0e} {at})",
        "bounded": f"{name} bounded (error {found.largest:.0e} {at})",
        "drifting": f"{name} drifts by {found.slope:.0e} per {found.per} {at}",
        "lost": f"{name} not kept {at}",
        "short": f"error of the {name} {found.largest:.0e} {at}, bounded or not: the motion ends too soon",
        "none": f"{name} not applicable: {found.lacks}",
    }[found.behaviour]


def _measured(defect: Defect) -> str:
    return f"not applicable: {defect.lacks}" if defect.lacks else f"defect {defect.size:.0e} at h = {defect.h:g}"
