"""What was found of an integrator, and what that says of its claims: each holds, fails, or is not established."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from compare.claims.verdicts import ANSWERS

if TYPE_CHECKING:
    from compare.claims.defects import Defect
    from compare.claims.energy import Energy
    from compare.claims.heading import Heading
    from compare.claims.order import Order
    from compare.claims.powers import Powers
    from compare.claims.verdicts import Standing, Verdict

__all__ = ["ORDER_MARGIN", "WIDEST", "Claims", "Findings", "reaches"]

ORDER_MARGIN = 0.2
"""A measured order may be so much lower than the one claimed, or as much as its interval says."""
MISSED = 0.5
"""A claim fails where its order is so far above the interval of slopes: those of the finest steps that rounding leaves
may differ by that from what they tend to."""
WIDEST = 0.3
"""An order whose interval has a half-width beyond this is not established."""

BUILT_IN = 0.05
"""A constant slope that is advanced so wrongly, where the motion is not, tells that a part of it is built in."""


def reaches(found: Order, claim: float, missed: float = ORDER_MARGIN) -> Standing:
    """How the claim of an order stands by slopes alone.

    Args:
        found: what was measured.
        claim: the order that is claimed.
        missed: how far the order has to be above the interval of slopes for the claim to fail.
    """
    if found.value is None:
        return "holds" if found.kind == "floor" else "open"
    if found.half_width <= WIDEST and found.value + max(ORDER_MARGIN, found.half_width) >= claim:
        return "holds"
    return "fails" if claim - found.value - found.half_width > missed or found.kind == "flat" else "open"


@dataclass(frozen=True)
class Claims:
    """What is said of an integrator; None where nothing is."""

    order: float | None = None
    symplectic: bool | None = None
    reversible: bool | None = None
    conserves: bool | None = None
    backward: bool | None = None
    dense: float | None = None
    estimate: float | None = None
    tolerance: float | None = None
    stiff: float | None = None


@dataclass(frozen=True)
class Findings:
    """What was found of an integrator.

    Attributes:
        name: what it is called.
        form: one of ``compare.methods.own.forms.FORMS`` by name, or "class", "generator" or "solver".
        engine: how it was run: "compiled", "on arrays", "lane by lane", or "whole".
        problem: what it was tried on.
        claims: what is said of it.
        still: the order on that problem.
        swinging: the order on the same seen from a swinging frame, where the time enters; None where it takes no time.
        symplecticity: the defect |det d(step)/dy - 1|, of more degrees of freedom |S' W S - W|/|W|.
        reversibility: the distance from the start after going forward, turning round and going back.
        energy: what the energy does over a long march.  Each says why where the problem has no such structure.
        heading: whether it goes along f, forwards and backwards.
        powers: its power series in h held against the solution's, where it has one.
        advance: by how many h a constant slope is advanced, 1 if that is right to rounding; None where the step is not
            explicit.
        hint: what would give a failing claim its order, where that is known.
        others: what the invariants beside the energy do over that march.
        back: the order with h < 0, into the past of that problem; None where it was not asked for or cannot be.
        more: verdicts on what it gives beside states: dense output, an error estimate, and the like.
    """

    name: str
    form: str
    engine: str
    problem: str
    claims: Claims
    still: Order
    swinging: Order | None
    symplecticity: Defect
    reversibility: Defect
    energy: Energy
    heading: Heading
    powers: Powers | None = None
    advance: float | None = None
    hint: str | None = None
    others: tuple[Energy, ...] = ()
    back: Order | None = None
    more: tuple[Verdict, ...] = ()

    @property
    def whole(self) -> bool:
        """Whether it goes over a grid of times by itself."""
        return self.engine == "whole"

    @property
    def order(self) -> Order:
        """The one of the orders whose interval reaches lower."""
        if self.swinging is None or self.swinging.interval is None:
            return self.still
        if self.still.interval is None or self.swinging.interval[0] < self.still.interval[0]:
            return self.swinging
        return self.still

    @property
    def order_by_series(self) -> int | None:
        """The order by the power series of the step; None where it has none, or where that does not tell."""
        return None if self.powers is None else self.powers.order

    @property
    def measured_order(self) -> float | None:
        """The order, the lower one where the time makes a difference; None where none shows."""
        return self.told[0]

    @property
    def order_interval(self) -> tuple[float, float] | None:
        """The interval of the order, which holds the whole number nearest to it."""
        value, half = self.told
        return None if value is None else (value - half, value + half)

    @property
    def told(self) -> tuple[float | None, float]:
        """The order and the half-width of its interval: by slope where one is established, else by the power series."""
        value, half, exact = self.order.value, self.order.half_width, self.order_by_series
        if value is not None and self.by_slope:
            return value, max(half, abs(value - (round(value) if exact is None else exact)))
        return (value, half) if exact is None else (float(exact), 0.0)

    @property
    def by_slope(self) -> bool:
        """Whether the slopes tell an order, and the power series, if there is one, the same."""
        order, exact = self.order, self.order_by_series
        if order.value is None or not self.established or order.kind != "slope":
            return False
        return exact is None or abs(order.value - exact) <= WIDEST

    @property
    def symplecticity_defect(self) -> float:
        """|det d(step)/dy - 1|, or |S' W S - W|/|W|; not a number where the problem has no momenta."""
        return self.symplecticity.size

    @property
    def reversibility_defect(self) -> float:
        """The distance from the start, relative to the motion's size; not a number where there is no way back."""
        return self.reversibility.size

    @property
    def consistent(self) -> bool:
        """Whether it goes along f, forwards, and advances a constant slope by h, as far as that was tried."""
        lost = self.whole and self.still.kind == "flat"
        return self.heading.consistent and self.heading.uses and not lost and self._advances

    @property
    def _advances(self) -> bool:
        """Whether a constant slope is advanced by h, or that tells nothing of a step that has its motion built in.

        As one that keeps the energy of a pendulum: on the motion itself it goes along f, to rounding by its series, or
        at least far nearer than a constant slope says.
        """
        if self.advance is None or self.advance == 1 or self.order_by_series:
            return True
        return self.heading.consistent and abs(self.advance - 1) > BUILT_IN

    @property
    def order_holds(self) -> bool | None:
        """Whether the order is at least the one that is claimed; None where it is not established, or not claimed."""
        return ANSWERS[self.order_standing]

    @property
    def standings(self) -> dict[str, Standing]:
        """How each claim on its states that is made stands, by its name."""
        found = {
            "order": self.order_standing,
            "backward": self._back_standing,
            "symplectic": self._standing(self.claims.symplectic, self.symplecticity),
            "reversible": self._standing(self.claims.reversible, self.reversibility),
            "conserves": self._conservation,
        }
        return {name: standing for name, standing in found.items() if standing is not None}

    @property
    def possible(self) -> bool:
        """Whether any claim can hold: the step goes along f, and back where it is tried."""
        return self.consistent and self.heading.backward != "wrong"

    @property
    def order_standing(self) -> Standing | None:
        """Of the claim of an order, if there is one."""
        claim, order, exact = self.claims.order, self.order, self.order_by_series
        if claim is None:
            return None
        if not self.possible:
            return "fails"
        if exact is not None:
            return "holds" if exact >= claim else "fails"
        if order.value is None:
            return "holds" if order.kind == "floor" else "open"
        if self.established and order.value + max(ORDER_MARGIN, order.half_width) >= claim:
            return "open" if self.short_of_digits else "holds"
        return "fails" if claim - order.value - order.half_width > MISSED or order.kind == "flat" else "open"

    @property
    def short_of_digits(self) -> bool:
        """Whether the order hangs on digits that the coefficients do not have."""
        return self.powers is not None and self.powers.rounded

    def _standing(self, claimed: bool | None, defect: Defect) -> Standing | None:
        """Of a claim of structure."""
        if not claimed:
            return None
        if not self.possible or not (defect.none or defect.undecided or defect.lacks):
            return "fails"
        return "open" if defect.lacks or defect.undecided or self.heading.backward == "refused" else "holds"

    @property
    def _back_standing(self) -> Standing | None:
        """Of the claim that the order is that with h < 0 as well."""
        claim, back = self.claims.order, self.back
        if not self.claims.backward or claim is None:
            return None
        if not self.possible:
            return "fails"
        return "open" if back is None else reaches(back, claim, MISSED)

    @property
    def _conservation(self) -> Standing | None:
        """Of the claim that every invariant is kept; one without a scale says nothing where another does."""
        if not self.claims.conserves:
            return None
        told = [one for one in (self.energy, *self.others) if one.behaviour != "none"]
        if not self.consistent or any(one.behaviour in {"drifting", "lost"} for one in told):
            return "fails"
        return "holds" if told and all(one.bounded for one in told) else "open"

    @property
    def established(self) -> bool:
        """Whether the interval of the order is narrow enough to say one, or as high as is claimed from end to end."""
        claim, order, interval = self.claims.order, self.order, self.order.interval
        if order.kind == "slope" and claim is not None and interval is not None and interval[0] >= claim - ORDER_MARGIN:
            return True
        return order.half_width <= WIDEST
