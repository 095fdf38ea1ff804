"""A user's integrator as it is tried on problems."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from compare.claims.frames import Field, MisuseError
from compare.methods.own.hosting import MAX_CALLS
from compare.methods.own.integrator import Integrator

if TYPE_CHECKING:
    from compare.claims.frames import Scene

__all__ = ["Candidate"]


@dataclass(frozen=True)
class Candidate(Integrator):
    """A function and how it is called."""

    def hold(self, scene: Scene) -> None:
        """Refuse a form that a problem has no place for.

        Raises:
            MisuseError: positions and momenta are taken apart, and the problem does not split so.
        """
        problem = scene.problem
        if self.form.own and not scene.problem.autonomous and not self.form.timed:
            raise MisuseError(f"{self.name} takes no time, on which {problem!r} depends; (t, y, h) is accepted.")
        if not self.form.separable:
            return
        if not problem.positions:
            lack = f"{problem!r} does not split into kicks and drifts; (f, y, h) is accepted"
        elif not problem.autonomous:
            lack = f"the force of {problem!r} depends on the time, which is not given; (f, t, y, h) is accepted"
        elif not scene.follows_rates:
            lack = f"p is not the rate of q in {problem!r}; (f, y, h) is accepted"
        else:
            return
        raise MisuseError(f"{self.name} takes ({', '.join(self.form.roles)}), but {lack}.")

    def field(self, scene: Scene, grid: int = 1) -> Field:
        """The right-hand side for one call of the function, which goes over so many times of a grid."""
        return Field(scene, MAX_CALLS * grid, self)
