"""NaN, infinity and nonsense."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from unittest.mock import patch

import numpy as np
from hard_bodies import (
    CLAMPED,
    NEO_HOOKE,
    NINJAFLEX,
    Motion,
    Points,
    cantilever,
    distance,
    stretched,
)
from hard_case import Finding, HardCase, below, refused, true
from meshes import box_mesh

from solver import (
    BodyForce,
    Mesh,
    Ogden,
    PointForce,
    Problem,
    SlenderAxis,
    SolverOptions,
    Supports,
    Traction,
    inflate,
    solve,
    trace,
)
from solver.assembly.assembly import Assembly, Equilibrium
from solver.assembly.state import State
from solver.nonlinear.linear_system import LinearSystem

BOX = box_mesh((2, 1, 1))
NAN, INF = float("nan"), float("inf")
BAD = (NAN, INF, -INF)
Calls = dict[str, tuple[Callable[[], object], str]]


def materials() -> Calls:
    """Every number of a material."""
    calls: Calls = {}
    for bad in BAD:
        calls |= {
            f"mu {bad}": (lambda bad=bad: Ogden((bad,), (2.0,)), "mu must be"),
            f"alpha {bad}": (lambda bad=bad: Ogden((1.0,), (bad,)), "alpha must be"),
            f"higher {bad}": (lambda bad=bad: Ogden.yeoh(0.5, bad), "higher must be"),
        }
    for bad in (NAN, -INF, 0.0, -1.0):
        call = lambda bad=bad: Ogden((1.0,), (2.0,), bad)  # noqa: E731
        calls[f"bulk modulus {bad}"] = (call, "bulk_modulus must be")
    return calls


def loads() -> Calls:
    """Pressure, stops, volumes, dead loads."""
    bar = cantilever(BOX)
    calls: Calls = {}
    for bad in BAD:
        vector = (bad, 0.0, 0.0)
        dead = {
            "traction": Traction("x1", vector),
            "traction by place": Traction("x1", lambda at, bad=bad: np.full(at.shape, bad)),
            "body force": BodyForce(vector),
            "point force": PointForce((1.0, 1.0, 1.0), vector),
            "place of a point force": PointForce(vector, (1.0, 0.0, 0.0)),
        }
        for name, load in dead.items():
            problem = Problem(BOX, NINJAFLEX, CLAMPED, loads=(load,))
            calls[f"{name} {bad}"] = (lambda problem=problem: solve(problem), "finite")
        calls |= {
            f"pressure {bad}": (lambda bad=bad: solve(bar, bad), "pressure must be a finite"),
            f"stop {bad}": (lambda bad=bad: solve(bar, 0.1, stops=[bad]), "stops must lie"),
            f"trace {bad}": (lambda bad=bad: trace(bar, bad), "pressure must be a finite"),
            f"volume {bad}": (lambda bad=bad: inflate(bar, bad), "volumes must be"),
        }
    return calls


def geometry() -> Calls:
    """Nodes, prescribed motions."""
    calls: Calls = {}
    for bad in BAD:
        nodes = BOX.nodes.copy()
        nodes[3, 1] = bad
        calls[f"node {bad}"] = (
            lambda nodes=nodes: Mesh(nodes, BOX.tets, BOX.surfaces), "nodes must be finite"
        )  # fmt: skip
    for bad in (INF, -INF):
        led = Supports(("x0",), prescribed={"x1": lambda at, load, bad=bad: at * 0 + load * bad})
        calls[f"motion {bad}"] = (lambda led=led: Problem(BOX, NINJAFLEX, led), "'x1' is")
    free = Supports(("x0",), prescribed={"x1": lambda at, load: at * (NAN if load else 0.0)})
    calls["motion that turns free"] = (lambda: Problem(BOX, NINJAFLEX, free), "same components")
    return calls


def options() -> Calls:
    """Every number among the options."""
    names = [field.name for field in fields(SolverOptions) if field.name != "linear_solver"]
    calls: Calls = {}
    for name in names:
        for bad in (*BAD, -2.0, 1e9):
            call = lambda name=name, bad=bad: SolverOptions(**{name: bad})  # noqa: E731
            calls[f"{name} = {bad}"] = (call, f"{name} must be")
    return calls


def given() -> tuple[Finding, ...]:
    """All inputs with a number that is none."""
    with np.errstate(invalid="ignore"):
        return (
            refused("materials", materials()),
            refused("loads", loads()),
            refused("nodes and motions", geometry()),
            refused("options", options()),
        )


def initial_state() -> tuple[Finding, ...]:
    """NaN or infinity in a start."""
    bar = cantilever(BOX)
    u, q = np.zeros(BOX.nodes.shape), np.zeros(len(BOX.vertices))
    calls: Calls = {}
    for bad in BAD:
        wrong_u, wrong_q = u.copy(), q.copy()
        wrong_u[4, 0] = wrong_q[2] = bad
        for name, start in (("displacement", (wrong_u, q)), ("pressure", (u, wrong_q))):
            call = lambda start=start: solve(bar, 0.05, initial=start)  # noqa: E731
            calls[f"{name} {bad}"] = (call, "finite")
    return (refused("starts", calls),)


def start_is_useless() -> tuple[Finding, ...]:
    """A start that is no state never becomes one."""
    bar = cantilever(BOX)
    usual = solve(bar, 0.05)
    nowhere = np.full(BOX.nodes.shape, 1e6) * BOX.nodes
    solution = solve(bar, 0.05, initial=(nowhere, np.zeros(len(BOX.vertices))))
    return (
        true("reached by the load path instead", solution.refused_steps == 1),
        below("differs by", distance(solution.displacement, usual.displacement), 1e-9),
    )


def motion_amid() -> tuple[Finding, ...]:
    """A motion that is NaN on part of its way."""

    def motion(positions: Points, load: float) -> Points:
        return positions * 0 + (NAN if 0.3 <= load <= 0.6 else 0.1 * load)

    problem = Problem(BOX, NINJAFLEX, Supports(("x0",), prescribed={"x1": motion}))
    return (refused("on the way", {"NaN": (lambda: solve(problem), "motion")}),)


def lengths() -> tuple[Finding, ...]:
    """Lengths beside the mesh: stations, radii, steps."""
    bar = cantilever(BOX)
    calls: Calls = {
        f"radius {bad}": (lambda bad=bad: replace(bar, sharp_edge_radius=bad), "sharp_edge_radius")
        for bad in (NAN, INF, -1.0)
    }
    calls["station inf"] = (lambda: SlenderAxis((0.0, INF)), "stations")
    calls |= {
        f"longest step {bad}": (lambda bad=bad: trace(bar, 0.01, longest_step=bad), "longest_step")
        for bad in (NAN, 0.0, -1.0)
    }
    return (refused("lengths", calls),)


def arising() -> tuple[Finding, ...]:
    """NaN that comes up in the residual, the tangent or the linear solver, at any iteration."""
    bar = cantilever(BOX, NEO_HOOKE)
    usual = solve(bar, 0.02).displacement
    cuts, off, given_up = [], [], []
    for spoil in (_spoilt_residual, _spoilt_tangent, _spoilt_solution):
        for call in (2, 3, 5):
            with spoil(call):
                solution = solve(bar, 0.02)
            cuts.append(solution.refused_steps)
            if solution.converged:
                off.append(distance(solution.displacement, usual))
            else:
                given_up.append(
                    np.isfinite(solution.displacement).all() and ": " in solution.message
                )
    return (
        true("9 of 9 runs refuse a step", min(cuts) >= 1, cuts),
        true("at least 7 arrive, the others say why not", len(off) >= 7 and all(given_up)),
        below("those that arrive are off by", max(off), 1e-5),
    )


def _spoilt_residual(call: int) -> patch:
    return _spoilt(call, lambda e: replace(e, residual=e.residual * NAN))


def _spoilt_tangent(call: int) -> patch:
    return _spoilt(call, lambda e: replace(e, tangent=e.tangent * NAN, residual=e.residual + 0.0))


def _spoilt(call: int, spoil: Callable[[Equilibrium], Equilibrium]) -> patch:
    """The ``call``-th evaluation with a tangent comes out wrong."""
    evaluate, calls = Assembly.evaluate, []

    def spoilt(
        self: Assembly, state: State, pressure: float, tangent: bool = True, load: float = 0.0
    ) -> Equilibrium:
        found = evaluate(self, state, pressure, tangent, load)
        calls.extend([1] * tangent)
        return spoil(found) if tangent and len(calls) == call else found

    return patch.object(Assembly, "evaluate", spoilt)


def _spoilt_solution(call: int) -> patch:
    """The ``call``-th correction comes out as NaN."""
    solve_linear, calls = LinearSystem.increment, []

    def spoilt(self: LinearSystem, right_hand_side: Points) -> State:
        calls.append(1)
        found = solve_linear(self, right_hand_side)
        return found.scaled(NAN) if len(calls) == call else found

    return patch.object(LinearSystem, "increment", spoilt)


def impossible_motion() -> tuple[Finding, ...]:
    """A motion that turns the body inside out, in one step and in many."""
    ends = []
    for first in (1.0, 0.1):
        led: dict[str, Motion] = {"x1": stretched(-1.0, clamped=True)}
        problem = Problem(BOX, NEO_HOOKE, Supports(("x0",), prescribed=led))
        ends.append(solve(problem, 0.0, SolverOptions(first_step=first)))
    stretches = [1 - 2 * end.load for end in ends]
    return (
        true("never reached", not any(end.converged for end in ends)),
        true("last state stable", all(end.stable for end in ends)),
        true("squeezed by less than its length", min(stretches) > 0.2, stretches),
    )


CASES = (
    HardCase(
        "NaN or infinity in what is given",
        "a NaN that spreads and comes back as a result",
        "every number is checked where it enters; a sentence names it",
        given,
    ),
    HardCase(
        "NaN that arises in an iteration",
        "comparisons with NaN are false: a loop may take it for convergence",
        "what is not finite is refused, the step is cut, the last state restored",
        arising,
    ),
    HardCase(
        "A useless start",
        "Newton diverges from it",
        "the load is walked from zero instead",
        start_is_useless,
    ),
    HardCase(
        "A motion through itself",
        "elements turn inside out and stay so",
        "the walk ends before, at a stable state",
        impossible_motion,
        inertia=True,
    ),
    HardCase(
        "A start with NaN",
        "a mistake that costs a whole walk over the load and is never told",
        "refused",
        initial_state,
    ),
    HardCase(
        "A motion that is NaN on part of its way",
        "supports stay where they were while the load goes on: wrong points on the path",
        "refused when it happens",
        motion_amid,
    ),
    HardCase(
        "NaN in lengths beside the mesh",
        "a radius of NaN leaves no node to report a peak stress from: 0 MPa",
        "refused",
        lengths,
    ),
)
