"""What turns a method of a package, by its name, into what ``compare.check`` takes."""

from __future__ import annotations

import functools
import importlib
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

LOOSE = 1e12
"""A tolerance that accepts every step."""
TIGHT, NEWTON_TOLERANCE = 1e-13, 1e-11
"""Tolerances of inner iterations; those of desolver and diffrax do not always end with the first."""


def explicit(a: np.ndarray, b: np.ndarray, c: np.ndarray, error: np.ndarray | None = None) -> Callable[..., Any]:
    """A step by the table of an explicit method, with its error estimate where the table has one."""

    def step(f: Any, t: Any, y: Any, h: Any) -> Any:
        slopes: list[Any] = []
        for row, node in zip(a, c, strict=True):
            slopes.append(f(t + node * h, y + h * weighted(row, slopes)))
        end = y + h * weighted(b, slopes)
        return end if error is None else (end, h * weighted(error, slopes))

    return step


def weighted(weights: Sequence[float], slopes: Sequence[Any]) -> Any:
    return sum((float(weight) * one for weight, one in zip(weights, slopes, strict=False) if weight != 0), 0.0)


def implicit(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> Callable[..., Any]:
    """A step by the table of an implicit method: Newton's iteration for its stages, the slopes of f by differences."""

    def step(f: Any, t: Any, y: Any, h: Any) -> Any:
        d, s = len(y), len(b)
        matrix = np.eye(s * d) - h * np.kron(a, slopes_of(lambda y: f(t, y), y))
        k = np.zeros((s, d))
        for _ in range(NEWTON):
            residual = k - [f(t + node * h, y + h * (row @ k)) for row, node in zip(a, c, strict=True)]
            k = k - np.linalg.solve(matrix, residual.ravel()).reshape(s, d)
        return y + h * (b @ k)

    return step


def slopes_of(f: Callable[[Any], Any], y: np.ndarray) -> np.ndarray:
    """df/dy by differences."""
    units = np.diag(1e-6 * (1 + np.abs(y)))
    return np.transpose([(f(y + unit) - f(y - unit)) / (2 * sum(unit)) for unit in units])


NEWTON = 14
"""Iterations of Newton's with one matrix."""


def nodepy(name: str) -> dict[str, Any]:
    method = _nodepy_methods()[name]
    a, b, c = (np.array(table, dtype=float) for table in (method.A, method.b, method.c))
    if np.any(np.triu(a)):
        return {"step": implicit(a, b, c)}
    hat = getattr(method, "bhat", None)
    return {"step": explicit(a, b, c, None if hat is None else b - np.array(hat, dtype=float))}


@cache
def _nodepy_methods() -> Any:
    import nodepy.runge_kutta_method

    return nodepy.runge_kutta_method.loadRKM()


def solver_class(path: str) -> dict[str, Any]:
    """One step of a class that ``scipy.integrate.solve_ivp`` takes, from time zero, so that h is exact."""
    module, _, name = path.rpartition(".")
    made = getattr(importlib.import_module(module), name)

    def stepped(f: Any, t: Any, y: Any, h: Any) -> Any:
        solver = made(lambda s, y: f(t + s, y), 0.0, y, h, first_step=abs(h), rtol=LOOSE, atol=LOOSE)
        solver.step()
        return solver

    def step(f: Any, t: Any, y: Any, h: Any) -> Any:
        solver = stepped(f, t, y, h)
        if not isinstance(made.E, np.ndarray):
            return solver.y
        return solver.y, h * solver.K[: len(made.E)].T @ made.E

    def between(f: Any, t: Any, y: Any, h: Any, theta: Any) -> Any:
        return stepped(f, t, y, h).dense_output()(theta * h)

    return {"step": step, "interpolant": between}


def class_table(path: str) -> dict[str, Any]:
    """The table of an implicit class, whose own inner iterations end with the tolerance of its steps."""
    module, _, name = path.rpartition(".")
    made = getattr(importlib.import_module(module), name)
    return {"step": implicit(np.array(made.A), np.array(made.B), np.array(made.C))}


def solver_as_it_is(path: str) -> dict[str, Any]:
    """A class that ``solve_ivp`` takes, which chooses its own steps."""
    from scipy.integrate import solve_ivp

    module, _, name = path.partition(",")[0].rpartition(".")
    step = partial(solve_ivp, method=getattr(importlib.import_module(module), name))
    return {"step": step}


def odeint(_: str) -> dict[str, Any]:
    from scipy.integrate import odeint

    def integrate(f: Any, y0: Any, t: Any, rtol: float) -> Any:
        return odeint(f, y0, t, tfirst=True, rtol=rtol, atol=rtol)

    return {"step": integrate}


def desolver(name: str) -> dict[str, Any]:
    """A step of one of desolver's integrators, past what chooses its step size."""
    from desolver import DiffRHS, integrators

    made = getattr(integrators, name)

    def stepped(f: Any, t: Any, y: Any, h: Any) -> Any:
        integrator = made(y.shape, dtype=np.float64, rtol=NEWTON_TOLERANCE, atol=NEWTON_TOLERANCE)

        def rates(s: Any, y: Any, **_: Any) -> Any:
            return f(t + s, y)

        rates.jac = lambda s, y, **_: slopes_of(lambda y: f(t + s, y), y)  # type: ignore[attr-defined]
        field = DiffRHS(rates)
        integrator.initial_rhs = field(0.0, y)
        integrator.step(field, 0.0, y, {}, h)
        return integrator

    def step(f: Any, t: Any, y: Any, h: Any) -> Any:
        integrator = stepped(f, t, y, h)
        return y + integrator.dState, h * integrator.get_error_estimate()

    def plain(f: Any, t: Any, y: Any, h: Any) -> Any:
        return y + stepped(f, t, y, h).dState

    pair = len(np.atleast_1d(getattr(made, "tableau_final", np.zeros((1, 1))))) == 2
    return {"step": step if pair else plain}


def pyhamsys(name: str) -> dict[str, Any]:
    """A splitting, whose chi is the kick after the drift, or "kick first" the drift after the kick."""
    from pyhamsys.pyhamsys import SymplecticIntegrator

    name, _, kick_first = name.partition(", ")

    def step(q: Any, p: Any, force: Any, h: Any) -> Any:
        def drift(h: Any, state: Any) -> Any:
            return state[0] + h * state[1], state[1]

        def kick(h: Any, state: Any) -> Any:
            return state[0], state[1] + h * force(state[0])

        first, second = (kick, drift) if kick_first else (drift, kick)
        integrator = SymplecticIntegrator(name, 1.0)
        integrator._sequence = tuple((a * h, direct) for a, direct in integrator._sequence)
        return integrator._integrate_onestep(
            0.0, (q, p), lambda h, _, y: second(h, first(h, y)), lambda h, _, y: first(h, second(h, y))
        )[1]

    return {"step": step}


def diffrax(name: str) -> dict[str, Any]:
    """A step of one of diffrax's solvers, from time zero, so that h is exact."""
    import diffrax
    import jax

    jax.config.update("jax_enable_x64", True)
    kind = getattr(diffrax, name)
    is_implicit = issubclass(kind, diffrax.AbstractImplicitSolver)
    finder = {"root_finder": diffrax.VeryChord(rtol=NEWTON_TOLERANCE, atol=NEWTON_TOLERANCE), "root_find_max_steps": 50}
    solver = kind(**finder if is_implicit else {})

    def stepped(f: Any, t: Any, y: Any, h: Any) -> Any:
        t, h = (jax.numpy.asarray(one, jax.numpy.float64) for one in (t, h))
        term: Any = diffrax.ODETerm(lambda s, y, t: f(t + s, y))
        if solver.term_structure is not diffrax.AbstractTerm:  # an explicit and an implicit part, whose sum is f
            quarter = diffrax.ODETerm(lambda s, y, t: 0.25 * f(t + s, y))
            term = diffrax.MultiTerm(quarter, diffrax.ODETerm(lambda s, y, t: 0.75 * f(t + s, y)))
        state = solver.init(term, 0 * h, h, y, t)
        return solver.step(term, 0 * h, h, y, t, state, made_jump=False)

    @partial(jax.jit, static_argnums=0)
    def step(f: Any, t: Any, y: Any, h: Any) -> Any:
        end, error, *_ = stepped(f, t, y, h)
        return end if error is None else (end, error)

    @partial(jax.jit, static_argnums=0)
    def between(f: Any, t: Any, y: Any, h: Any, theta: Any) -> Any:
        dense = stepped(f, t, y, h)[2]
        return solver.interpolation_cls(t0=0.0, t1=h, **dense).evaluate(theta * h)

    return {"step": step, "interpolant": between}


def diffrax_pair(name: str) -> dict[str, Any]:
    """A solver of diffrax that takes the rates of q and of p apart."""
    import diffrax
    import jax

    jax.config.update("jax_enable_x64", True)
    solver = getattr(diffrax, name)()

    @partial(jax.jit, static_argnums=2)
    def step(q: Any, p: Any, force: Any, h: Any) -> Any:
        terms = diffrax.ODETerm(lambda _, p, __: p), diffrax.ODETerm(lambda _, q, __: force(q))
        return solver.step(terms, 0.0, h, (q, p), None, None, made_jump=False)[0]

    return {"step": step}


def diffrax_with_memory(name: str) -> dict[str, Any]:
    """A solver of diffrax that carries more than the state from step to step."""
    import diffrax
    import jax

    jax.config.update("jax_enable_x64", True)
    solver = getattr(diffrax, name)()

    @partial(jax.jit, static_argnums=0)
    def first(f: Any, t: Any, y: Any, h: Any) -> Any:
        return solver.init(diffrax.ODETerm(lambda t, y, _: f(t, y)), t, t + h, y, None)

    @partial(jax.jit, static_argnums=0)
    def next_(f: Any, t: Any, y: Any, h: Any, state: Any) -> Any:
        term = diffrax.ODETerm(lambda t, y, _: f(t, y))
        found = solver.step(term, t, t + h, y, None, state, made_jump=False)
        return found[0], found[3]

    class Marching:
        def __init__(self, f: Any, t0: Any, y0: Any, h: Any) -> None:
            self.f, self.t, self.y, self.h = f, t0, y0, h
            self.memory = first(f, t0, y0, h)

        def step(self) -> None:
            self.y, self.memory = next_(self.f, self.t, self.y, self.h, self.memory)
            self.t += self.h

    Marching.__name__ = name
    return {"step": Marching}


def diffrax_adaptive(name: str) -> dict[str, Any]:
    import diffrax
    import jax

    jax.config.update("jax_enable_x64", True)
    kind = getattr(diffrax, name.partition(",")[0])

    @partial(jax.jit, static_argnames="fun")
    def solve(fun: Any, t_span: Any, y0: Any, rtol: Any = 1e-3) -> Any:
        term = diffrax.ODETerm(lambda t, y, _: fun(t, y))
        control = diffrax.PIDController(rtol=rtol, atol=rtol)
        return diffrax.diffeqsolve(term, kind(), *t_span, None, y0, stepsize_controller=control)

    return {"step": solve}


def torchdiffeq(name: str) -> dict[str, Any]:
    """A solver over the grid that it is given; its options stand after its name."""
    import torch
    from torchdiffeq import odeint

    name, *words = name.split()
    options = {key: int(value) for key, _, value in (word.partition("=") for word in words)}

    def integrate(f: Any, y0: Any, t: Any) -> Any:
        def field(t: Any, y: Any) -> Any:
            return torch.as_tensor(f(float(t), y.numpy()))

        how = {"rtol": 1e-12, "atol": 1e-12, "options": options} if options else {}
        return odeint(field, torch.tensor(y0), torch.tensor(t), method=name, **how)

    return {"step": integrate}


def torchdiffeq_adaptive(name: str) -> dict[str, Any]:
    import torch
    from torchdiffeq import odeint

    def integrate(f: Any, y0: Any, t: Any, rtol: float) -> Any:
        def field(t: Any, y: Any) -> Any:
            return torch.as_tensor(f(float(t), y.numpy()))

        method = name.partition(",")[0]
        return odeint(field, torch.tensor(y0), torch.tensor(t), method=method, rtol=rtol, atol=rtol)

    return {"step": integrate}


def torchdiffeq_table(name: str) -> dict[str, Any]:
    """The table of an adaptive solver, as an embedded pair of fixed step."""
    from torchdiffeq._impl.odeint import SOLVERS

    table = SOLVERS[name].tableau
    stages = len(table.c_sol)
    a = np.zeros((stages, stages))
    for i, row in enumerate(table.beta):
        a[i + 1, : len(row)] = row.numpy()
    c = np.array([0.0, *table.alpha.tolist()])
    return {"step": explicit(a, table.c_sol.numpy(), c, table.c_error.numpy())}


def gala(name: str) -> dict[str, Any]:
    from gala import integrate as home

    def integrate(f: Any, y0: Any, t: Any) -> Any:
        return getattr(home, name)(f)(y0, t=t).w().T

    return {"step": integrate}


def rebound(name: str) -> dict[str, Any]:
    """A step of one of REBOUND's integrators for one particle that a force moves; its settings stand after its name."""
    import rebound

    name, *words = name.split()
    settings = [word.partition("=")[::2] for word in words]

    def step(q: Any, p: Any, force: Any, h: Any) -> Any:
        simulation = rebound.Simulation()
        simulation.integrator, simulation.gravity, simulation.dt = name, "none", h
        for key, value in settings:
            setattr(simulation.integrator, key, int(value) if value.isdecimal() else value)
        simulation.add(m=MASS, x=float(q[0]), vx=float(p[0]))

        def push(pointer: Any) -> None:
            one = pointer.contents.particles[0]
            one.ax = float(force(np.array([one.x]))[0])

        simulation.additional_forces = push
        simulation.steps(1)
        simulation.synchronize()
        one = simulation.particles[0]
        return [one.x], [one.vx]

    return {"step": step}


MASS = 1.0


TOLERANCES = {"ias15": ("epsilon",), "bs": ("eps_rel", "eps_abs")}
"""What REBOUND calls them."""


def rebound_adaptive(name: str) -> dict[str, Any]:
    import rebound

    kind = name.partition(",")[0]

    def integrate(f: Any, y0: Any, t: Any, rtol: float) -> Any:
        simulation, raised = rebound.Simulation(), []
        simulation.integrator, simulation.gravity = kind, "none"
        for one in TOLERANCES[kind]:
            setattr(simulation.integrator, one, rtol)
        if kind == "ias15":
            simulation.integrator.adaptive_mode = "global"
        simulation.t = t[0]
        simulation.add(m=MASS, x=float(y0[0]), vx=float(y0[1]))

        def push(pointer: Any) -> None:
            one = pointer.contents.particles[0]
            try:
                one.ax = float(f(pointer.contents.t, np.array([one.x, one.vx]))[1])
            except BaseException as error:  # noqa: BLE001 - it would be lost on its way through compiled code
                raised.append(error)
                pointer.contents.stop()

        simulation.additional_forces = push
        states = []
        for time in t:
            simulation.integrate(time)
            if raised:
                raise raised[0]
            states.append([simulation.particles[0].x, simulation.particles[0].vx])
        return np.array(states)

    return {"step": integrate}


def second_order_class(path: str) -> dict[str, Any]:
    """The same of a class for second-order equations, whose state is positions and velocities."""
    return {"step": solver_class(path)["step"]}


def gala_adaptive(name: str) -> dict[str, Any]:
    from gala import integrate as home

    def integrate(f: Any, y0: Any, t: Any, rtol: float) -> Any:
        return getattr(home, name)(f, rtol=rtol, atol=rtol)(y0, t=t).w().T

    return {"step": integrate}


def numba(name: str) -> dict[str, Any]:
    import numba
    import people

    from reference import Pendulum

    if name.startswith("rk4"):
        return {"step": numba.njit(people.rk4)}

    @numba.njit
    def verlet(q: Any, p: Any, h: Any) -> Any:
        p = p - h / 2 * 9.81 * np.sin(q)
        q = q + h * p
        return q, p - h / 2 * 9.81 * np.sin(q)

    return {"step": verlet, "problem": Pendulum(1)}


def jax(name: str) -> dict[str, Any]:
    import jax
    import people

    from reference import Pendulum

    jax.config.update("jax_enable_x64", True)
    if name.startswith("rk4"):
        return {"step": jax.jit(people.rk4, static_argnums=0)}

    @jax.jit
    def verlet(q: Any, p: Any, h: Any) -> Any:
        p = p - h / 2 * 9.81 * jax.numpy.sin(q)
        q = q + h * p
        return q, p - h / 2 * 9.81 * jax.numpy.sin(q)

    return {"step": verlet, "problem": Pendulum(1)}


def jax_odeint(_: str) -> dict[str, Any]:
    import jax
    from jax.experimental.ode import odeint

    jax.config.update("jax_enable_x64", True)

    @partial(jax.jit, static_argnames=("f", "rtol"))
    def integrate(f: Any, y0: Any, t: Any, rtol: Any) -> Any:
        return odeint(lambda y, t: f(t, y), y0, t, rtol=rtol, atol=rtol)

    return {"step": integrate}


def of(builder: str, name: str, claims: Collection[str]) -> dict[str, Any]:
    """Arguments of ``compare.check`` beside the claims: what no claim is made of is left out."""
    found: dict[str, Any] = globals()[builder](name)
    if "estimate" not in claims and builder in PAIRS:
        found["step"] = _state_alone(found["step"])
    return {key: value for key, value in found.items() if key != "interpolant" or "dense" in claims}


PAIRS = ("nodepy", "solver_class", "second_order_class", "desolver", "diffrax", "torchdiffeq_table")
"""Builders whose steps may give an error estimate too."""


def _state_alone(step: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(step)
    def state(*arguments: Any) -> Any:
        found = step(*arguments)
        return found[0] if isinstance(found, tuple) else found

    return state
