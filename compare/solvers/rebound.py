"""REBOUND: IAS15 for particles, here moved by the problem's force, and BS for any equation.

IAS15 is Gauss-Radau quadrature of order 15, BS extrapolation after Gragg, Bulirsch and Stoer.
"""

from __future__ import annotations

import math
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import LARGEST, Answer, Counted, Question, Solver, SolverError

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOLVERS"]

AXES = ("x", "y", "z")


def _solves(question: Question) -> bool:
    """Whether q' = p, of bodies in at most three dimensions: particles have no other kinematics."""
    return question.positions <= len(AXES) * len(question.problem.bodies) and question.newtonian


def _prepare(question: Question, mode: str | None = None) -> Callable[[], Answer]:
    import rebound

    bodies = len(question.problem.bodies)
    axes = AXES[: question.positions // bodies]
    names = (*axes, *(f"v{axis}" for axis in axes))
    starts = [dict(zip(names, body, strict=True)) for body in question.start.reshape(len(names), bodies).T]

    def run() -> Answer:
        counted = Counted(question)
        refused: list[SolverError] = []
        simulation = rebound.Simulation()
        simulation.integrator = "ias15"
        simulation.integrator.epsilon = question.rtol
        if mode is not None:
            simulation.integrator.adaptive_mode = mode
        simulation.gravity = "none"
        for start in starts:
            simulation.add(m=0.0, **start)

        def push(pointer: Any) -> None:
            particles = [pointer.contents.particles[body] for body in range(bodies)]
            try:
                force = counted.force(pointer.contents.t, [getattr(one, axis) for axis in axes for one in particles])
            except SolverError as error:  # an exception would be lost on its way through compiled code
                refused.append(error)
                pointer.contents.stop()
                return
            for (axis, one), value in zip(product(axes, particles), force, strict=True):
                setattr(one, f"a{axis}", value)

        simulation.additional_forces = push
        states = []
        for time in question.times:
            simulation.integrate(time)
            if refused:
                raise refused[0]
            states.append([getattr(simulation.particles[body], name) for name in names for body in range(bodies)])
        return Answer(np.array(states), counted.evaluations, float(simulation.integrator.epsilon))

    return run


def _prepare_bs(question: Question) -> Callable[[], Answer]:
    import rebound

    size = len(question.start)

    def run() -> Answer:
        counted = Counted(question)
        refused: list[SolverError] = []
        simulation = rebound.Simulation()
        simulation.integrator = "bs"
        simulation.integrator.eps_rel = simulation.integrator.eps_abs = question.rtol
        ode = simulation.create_ode(length=size, needs_nbody=False)
        for place, value in enumerate(question.start):
            ode.y[place] = value

        def field(_ode: Any, rates: Any, y: Any, t: float) -> None:
            try:
                found = counted.derivative(t, y[:size])
            except SolverError as error:  # an exception would be lost on its way through compiled code
                refused.append(error)
                simulation.stop()
                found = [math.nan] * size
            for place, rate in enumerate(found):
                rates[place] = rate

        ode.derivatives = field
        states = []
        for time in question.times:
            simulation.integrate(time)
            if refused:
                raise refused[0]
            states.append(ode.y[:size])
        return Answer(np.array(states), counted.evaluations, float(simulation.integrator.eps_rel))

    return run


def _solver(name: str, mode: str | None) -> Solver:
    chosen = f"; sim.integrator.adaptive_mode = '{mode}'" if mode is not None else ""
    return Solver(
        name=name,
        package="rebound",
        call=f"sim.integrator = 'ias15'; sim.integrator.epsilon = rtol{chosen}; for t in times: sim.integrate(t)",
        prepare=partial(_prepare, mode=mode),
        dial="epsilon",
        tolerance="last term of the series of the acceleration over the acceleration, about epsilon in a step"
        if mode == "global"
        else "step over the time scale of the derivatives of the acceleration, (5040 epsilon)^(1/7)",
        counts="evaluations of the force",
        accepts="problems with q' = p, of bodies in at most three dimensions",
        solves=_solves,
    )


SOLVERS = (
    _solver("rebound.IAS15", None),
    _solver("rebound.IAS15_global", "global"),
    Solver(
        name="rebound.BS",
        package="rebound",
        call="sim.integrator = 'bs'; sim.integrator.eps_rel = sim.integrator.eps_abs = rtol; "
        "ode = sim.create_ode(length=n, needs_nbody=False); ode.derivatives = f; for t in times: sim.integrate(t)",
        prepare=_prepare_bs,
        tolerance=LARGEST,
        aliases=("BS",),
    ),
)
"""As it comes, its step is chosen by ratios of derivatives of the acceleration (Pham, Rein and Spiegel, Open J.
Astrophys. 7, 2024), which shrinks it where an acceleration in one dimension passes through zero; "global" is the
criterion of Rein and Spiegel (Mon. Not. R. Astron. Soc. 446, 2015)."""
