"""REBOUND's IAS15: Gauss-Radau quadrature of order 15 for particles, here one particle moved by the problem's force."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import Answer, Counted, Question, Solver, SolverError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOLVERS"]

AXES = ("x", "y", "z")


def _solves(question: Question) -> bool:
    """Whether q' = p, in at most three dimensions: a particle has no other kinematics."""
    momenta = np.arange(1.0, 1.0 + question.positions)
    return 0 < question.positions <= len(AXES) and np.array_equal(Counted(question).velocity(momenta), momenta)


def _prepare(question: Question) -> Callable[[], Answer]:
    import rebound

    axes = AXES[: question.positions]
    place, speed = dict(zip(axes, question.start, strict=False)), question.start[len(axes) :]

    def run() -> Answer:
        counted = Counted(question)
        refused: list[SolverError] = []
        simulation = rebound.Simulation()
        simulation.integrator = "ias15"
        simulation.integrator.epsilon = question.rtol
        simulation.gravity = "none"
        simulation.add(m=0.0, **place, **{f"v{axis}": v for axis, v in zip(axes, speed, strict=True)})

        def push(pointer: Any) -> None:
            particle = pointer.contents.particles[0]
            try:
                force = counted.force(tuple(getattr(particle, axis) for axis in axes))
            except SolverError as error:  # an exception would be lost on its way through compiled code
                refused.append(error)
                pointer.contents.stop()
                return
            for axis, value in zip(axes, force, strict=True):
                setattr(particle, f"a{axis}", value)

        simulation.additional_forces = push
        states = []
        for time in question.times:
            simulation.integrate(time)
            if refused:
                raise refused[0]
            particle = simulation.particles[0]
            states.append([getattr(particle, name) for name in (*axes, *(f"v{axis}" for axis in axes))])
        return Answer(np.array(states), counted.evaluations, float(simulation.integrator.epsilon))

    return run


SOLVERS = (
    Solver(
        name="rebound.IAS15",
        package="rebound",
        call="sim.integrator = 'ias15'; sim.integrator.epsilon = rtol; for t in times: sim.integrate(t)",
        prepare=_prepare,
        dial="epsilon",
        counts="evaluations of the force",
        accepts="problems with q' = p in at most three dimensions",
        solves=_solves,
    ),
)
