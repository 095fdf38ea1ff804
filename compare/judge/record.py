"""What was found of an integrator, and the verdict in one line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from compare.judge.defects import Defect
    from compare.judge.energy import Energy
    from compare.judge.heading import Heading
    from compare.judge.order import Order
    from compare.judge.powers import Powers

__all__ = ["Check", "Claims"]

ORDER_MARGIN = 0.2
"""A measured order may be so much lower than the one claimed, or as much as its interval says."""
MISSED = 0.5
"""A claim fails where its order is so far above the interval of slopes: those of the finest steps that rounding leaves
may differ by that from what they tend to."""
MORE = 0.4
"""An interval so far above a claim is more than claimed."""
WIDEST = 0.3
"""An order whose interval has a half-width beyond this is not established."""

Standing = Literal["holds", "fails", "open"]


ANSWERS: dict[Standing | None, bool | None] = {"holds": True, "fails": False, "open": None, None: None}


@dataclass(frozen=True)
class Claims:
    """What is said of an integrator; None where nothing is."""

    order: float | None = None
    symplectic: bool | None = None
    reversible: bool | None = None


@dataclass(frozen=True)
class Check:
    """What was found of an integrator.

    Attributes:
        name: what it is called.
        form: "step", "timed", "separable" or "integrator".
        engine: how it was run: "compiled", "on arrays", "lane by lane", or "whole".
        problem: what it was tried on.
        claims: what is said of it.
        still: the order on that problem.
        swinging: the order on the same seen from a swinging frame, where the time enters; None where it takes no time.
        symplecticity: the defect |det d(step)/dy - 1|; None where the problem has no such structure.
        reversibility: the distance from the start after going forward, turning round and going back.
        energy: what the energy does over a long march.
        heading: whether it goes along f, forwards and backwards.
        powers: its power series in h held against the solution's, where it has one.
        advance: by how many h a constant slope is advanced, 1 if that is right to rounding; None where the step is not
            explicit.
        hint: what would give a failing claim its order, where that is known.
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

    @property
    def _order(self) -> Order:
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
        return None if self.order_interval is None else self._told[0]

    @property
    def order_interval(self) -> tuple[float, float] | None:
        """The interval of the order."""
        if self._by_slope or self.order_by_series is None:
            value, half = self._told
            return None if value is None else (value - half, value + half)
        return float(self.order_by_series), float(self.order_by_series)

    @property
    def _told(self) -> tuple[float | None, float]:
        """The order and the half-width of an interval that holds a whole number, or that of the power series."""
        value, half, exact = self._order.value, self._order.half_width, self.order_by_series
        if value is None or not self._by_slope:
            return (value, half) if exact is None else (float(exact), 0.0)
        return value, max(half, abs(value - (round(value) if exact is None else exact)))

    @property
    def _by_slope(self) -> bool:
        """Whether the slopes tell an order, and the power series, if there is one, the same."""
        order, exact = self._order, self.order_by_series
        if order.value is None or not self._established or order.kind != "slope":
            return False
        return exact is None or abs(order.value - exact) <= WIDEST

    @property
    def symplecticity_defect(self) -> float:
        """|det d(step)/dy - 1|."""
        return self.symplecticity.size

    @property
    def reversibility_defect(self) -> float:
        """The distance from the start, relative to the motion's size."""
        return self.reversibility.size

    @property
    def consistent(self) -> bool:
        """Whether it goes along f, forwards, and whether a constant slope is advanced by h, as far as that was tried."""
        lost = self.form == "integrator" and self.still.kind == "flat"
        return self.heading.consistent and self.heading.calls and not lost and self.advance in {None, 1}

    @property
    def order_holds(self) -> bool | None:
        """Whether the order is at least the one that is claimed; None without a claim, or where it is not established."""
        return ANSWERS[self._order_standing]

    @property
    def claims_hold(self) -> bool | None:
        """Whether everything that is claimed holds: not where anything fails, None where anything is not established."""
        standings = {self._order_standing}
        standings.add(self._standing(self.claims.symplectic, self.symplecticity))
        standings.add(self._standing(self.claims.reversible, self.reversibility))
        return ANSWERS[next((one for one in ("fails", "open") if one in standings), "holds")]

    @property
    def _possible(self) -> bool:
        """Whether any claim can hold: the step goes along f, and back where it is tried."""
        return self.consistent and self.heading.backward != "wrong"

    @property
    def _order_standing(self) -> Standing | None:
        claim, order, exact = self.claims.order, self._order, self.order_by_series
        if claim is None:
            return None
        if not self._possible:
            return "fails"
        if exact is not None:
            return "holds" if exact >= claim else "fails"
        if order.value is None:
            return "holds" if order.kind == "floor" else "open"
        if self._established and order.value + max(ORDER_MARGIN, order.half_width) >= claim:
            return "open" if self._short_of_digits else "holds"
        return "fails" if claim - order.value - order.half_width > MISSED or order.kind == "flat" else "open"

    @property
    def _short_of_digits(self) -> bool:
        """Whether the order hangs on digits that the coefficients do not have."""
        return self.powers is not None and self.powers.rounded

    def _standing(self, claimed: bool | None, defect: Defect) -> Standing | None:
        """Of a claim of structure."""
        if not claimed:
            return None
        if not self._possible or not (defect.none or defect.undecided):
            return "fails"
        return "open" if defect.undecided or self.heading.backward == "refused" else "holds"

    @property
    def _established(self) -> bool:
        """Whether the interval of the order is narrow enough to say one."""
        return self._order.half_width <= WIDEST

    @property
    def verdict(self) -> str:
        """Everything in one line."""
        return "; ".join([self._order_words(), *self._reasons(), *self._defect_words(), self._energy_words()])

    def _reasons(self) -> list[str]:
        """What explains a claim that fails, or would decide one that is not established."""
        parts = [] if self.hint is None else [self.hint]
        if not self.consistent:
            parts.append(f"not consistent: {self._why_inconsistent}")
        if self.heading.consistent and self.heading.backward == "wrong":
            parts.append("wrong for h < 0: a step back does not go back along f as one forward goes along it")
        elif self.heading.backward == "refused":
            parts.append("takes no step with h < 0")
        if self._order_standing == "open":
            parts.append(self._what_would_decide)
        return parts

    @property
    def _why_inconsistent(self) -> str:
        if self.heading.cause is not None:
            return self.heading.cause
        if not self.heading.calls:
            return "it never calls f, and moves the same way whatever f is"
        if self.advance is not None and self.advance != 1:
            return f"a constant slope is advanced by {self.advance:.12g} h"
        return "a short step does not go along f"

    @property
    def _what_would_decide(self) -> str:
        if self._short_of_digits:
            return "coefficients of more digits would decide it"
        if self.form == "integrator":
            return "one of its steps as a function (f, y, h) would decide it"
        return (
            "plain arithmetic, on numbers that are not turned into floats, and without a branch on what changes with h, "
            "would decide it by the power series in h"
        )

    def _order_words(self) -> str:
        order, exact = self._order, self.order_by_series
        claimed = "" if self.claims.order is None else f"claims order {self.claims.order:g}, "
        if order.kind == "floor":
            return f"{claimed}error at rounding with every step"
        if order.kind == "own steps":
            return f"chooses its own steps, error {order.cells[-1].error:.0e}"
        if order.kind == "flat":
            return f"{claimed}does not converge: the error stays at {order.cells[-1].error:.0e}"
        if exact is not None and not self._by_slope:
            slopes = "" if order.value is None else f" (slopes {order.value:.2f} ± {order.half_width:.2f})"
            return f"{claimed}order {exact} by its power series in h{slopes}{self._more_words}"
        if order.value is None:
            return f"{claimed}order not to be seen: too few step sizes between coarse and rounding"
        if not self._established or self._order_standing == "open":
            return f"{claimed}order not established: {order.value:.2f} ± {order.half_width:.2f}"
        value, half = self._told
        words = f"{claimed}measured {value:.2f} ± {half:.2f}{self._more_words}"
        if self.swinging is not None and order is self.swinging and self.still.value is not None:
            words += f" where the time enters, {self.still.value:.2f} where it does not" * (self._times_matter)
        if order.plateau is not None:
            words += f" down to an error of {order.plateau:.0e}, where it stops falling"
            words += ", excused as a tolerance (it may be a fault)" * self.consistent
        return words

    @property
    def _more_words(self) -> str:
        """Where the order is beyond the one that is claimed."""
        order, exact, claim = self._order, self.order_by_series, self.claims.order
        if claim is None:
            return ""
        lowest = exact if exact is not None else (order.value or 0) - order.half_width - MORE
        return ", more than claimed" if lowest > claim else ""

    @property
    def _times_matter(self) -> bool:
        """Whether the order is lower where the time enters: stages are taken at the wrong times."""
        if self.swinging is None or self.swinging.value is None or self.still.value is None:
            return False
        return self.swinging.value < self.still.value - 0.5

    def _defect_words(self) -> list[str]:
        words = []
        for what, claimed, defect in (
            ("symplectic", self.claims.symplectic, self.symplecticity),
            ("reversible", self.claims.reversible, self.reversibility),
        ):
            measured = f"defect {defect.size:.0e} at h = {defect.h:g}"
            if defect.none:
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

    def _energy_words(self) -> str:
        found = self.energy
        at = f"at h = {found.h:g}"
        return {
            "rounding": f"energy kept to rounding (error {found.largest:.0e} {at})",
            "bounded": f"energy bounded (error {found.largest:.0e} {at})",
            "drifting": f"energy drifts by {found.slope:.0e} per second {at}",
            "lost": f"energy not kept {at}",
        }[found.behaviour]
