"""What was found of an integrator, and the verdict in one line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from compare.judge.defects import Defect
    from compare.judge.energy import Energy
    from compare.judge.order import Order

__all__ = ["Check", "Claims"]

ORDER_MARGIN = 0.2
"""A measured order may be so much lower than the one claimed, or as much as its interval says."""
WIDEST = 0.3
"""An order whose interval has a half-width beyond this is not established."""


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
        advance: by how many h a constant slope is advanced, 1 if that is right to rounding; None where the step is not
            explicit.
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
    advance: float | None = None

    @property
    def _order(self) -> Order:
        """The one of the orders whose interval reaches lower."""
        if self.swinging is None or self.swinging.interval is None:
            return self.still
        if self.still.interval is None or self.swinging.interval[0] < self.still.interval[0]:
            return self.swinging
        return self.still

    @property
    def measured_order(self) -> float | None:
        """The order, the lower one where the time makes a difference; None where none shows."""
        return self._order.value

    @property
    def order_interval(self) -> tuple[float, float] | None:
        """The interval of the order."""
        return self._order.interval

    @property
    def symplecticity_defect(self) -> float:
        """|det d(step)/dy - 1|."""
        return self.symplecticity.size

    @property
    def reversibility_defect(self) -> float:
        """The distance from the start, relative to the motion's size."""
        return self.reversibility.size

    @property
    def order_holds(self) -> bool | None:
        """Whether the order is at least the one that is claimed; None without a claim."""
        if self.claims.order is None:
            return None
        if not self.consistent or not self._established:
            return False
        if self._order.value is None:
            return self._order.kind == "floor"
        return self._order.value + max(ORDER_MARGIN, self._order.half_width) >= self.claims.order

    @property
    def consistent(self) -> bool:
        """Whether a constant slope is advanced by h, as far as that was tried."""
        return self.advance is None or self.advance == 1

    @property
    def _established(self) -> bool:
        """Whether the interval of the order is narrow enough to say one."""
        return self._order.half_width <= WIDEST

    @property
    def claims_hold(self) -> bool:
        """Whether everything that is claimed holds."""
        held = [self.order_holds is not False]
        held += [self.symplecticity.none or not self.claims.symplectic]
        held += [self.reversibility.none or not self.claims.reversible]
        return all(held)

    @property
    def verdict(self) -> str:
        """Everything in one line."""
        parts = [self._order_words(), *self._defect_words(), self._energy_words()]
        if not self.consistent:
            parts.insert(1, f"not consistent: a constant slope is advanced by {self.advance:.12g} h")
        return "; ".join(parts)

    def _order_words(self) -> str:
        order = self._order
        claimed = "" if self.claims.order is None else f"claims order {self.claims.order:g}, "
        if order.kind == "floor":
            return f"{claimed}error at rounding with every step"
        if order.kind == "own steps":
            return f"chooses its own steps, error {order.cells[-1].error:.0e}"
        if order.kind == "flat":
            return f"{claimed}does not converge: the error stays at {order.cells[-1].error:.0e}"
        if order.value is None:
            return f"{claimed}order not to be seen: too few step sizes between coarse and rounding"
        if not self._established:
            return f"{claimed}order not established: {order.value:.2f} ± {order.half_width:.2f}"
        words = f"{claimed}measured {order.value:.2f} ± {order.half_width:.2f}"
        if self.claims.order is not None and order.value - order.half_width > self.claims.order:
            words += ", more than claimed"
        if self.swinging is not None and order is self.swinging and self.still.value is not None:
            words += f" where the time enters, {self.still.value:.2f} where it does not" * (self._times_matter)
        if order.plateau is not None:
            words += f" down to an error of {order.plateau:.0e}, where it stops falling"
            words += ", excused as a tolerance (it may be a fault)" * self.consistent
        return words

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
