"""Verdicts: each claim passes, fails, or is not established, with what was measured and what points at the cause."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal

__all__ = ["ANSWERS", "STANDINGS", "Judged", "Standing", "Verdict"]

Standing = Literal["holds", "fails", "open"]
STANDINGS: dict[Standing, str] = {"holds": "PASS", "fails": "FAIL", "open": "NOT ESTABLISHED"}
ANSWERS: dict[Standing | None, bool | None] = {"holds": True, "fails": False, "open": None, None: None}


@dataclass(frozen=True)
class Verdict:
    """On one claim.

    Attributes:
        claim: its name, such as "order" or "symplectic".
        words: what is claimed, such as "order 4".
        standing: "PASS", "FAIL" or "NOT ESTABLISHED".
        measured: what was measured, with its interval or its step.
        causes: what explains a failure, or would decide what is not established; empty where nothing is known.
    """

    claim: str
    words: str
    standing: str
    measured: str
    causes: tuple[str, ...] = ()

    @classmethod
    def of(cls, claim: str, words: str, standing: Standing, measured: str, causes: tuple[str, ...] = ()) -> Verdict:
        """A verdict, which has causes where it is no PASS."""
        return cls(claim, words, STANDINGS[standing], measured, () if standing == "holds" else causes)

    def __str__(self) -> str:
        return f"{self.standing}  {self.words}: {'; '.join([self.measured, *self.causes])}"


class Judged(ABC):
    """Something of which claims were tried on a problem."""

    name: str
    problem: str

    @property
    @abstractmethod
    def verdicts(self) -> tuple[Verdict, ...]:
        """One for each claim that is made."""

    @property
    def claims_hold(self) -> bool | None:
        """Whether all that is claimed holds: not where anything fails, None where anything is not established."""
        found = {one.standing for one in self.verdicts}
        return False if "FAIL" in found else None if "NOT ESTABLISHED" in found else True

    def assert_holds(self) -> None:
        """Nothing where every claim holds.

        Raises:
            AssertionError: one fails or is not established; it says the verdict of each that does not hold.
            ValueError: nothing is claimed.
        """
        if not self.verdicts:
            raise ValueError(f"nothing is claimed of {self.name}; an order, symplectic, or another claim is accepted.")
        told = [f"{self.name} on {self.problem}: {one}." for one in self.verdicts if one.standing != "PASS"]
        if told:
            raise AssertionError("\n".join(told))


@dataclass(frozen=True)
class Tried(Judged):
    """What has verdicts and nothing else."""

    name: str
    problem: str
    found: tuple[Verdict, ...]

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        return self.found
