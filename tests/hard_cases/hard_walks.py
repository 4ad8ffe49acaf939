"""Loads."""

from __future__ import annotations

import numpy as np
from hard_bodies import (
    NEO_HOOKE,
    NINJAFLEX,
    THREE_PLANES,
    actuator,
    cantilever,
    distance,
    reached,
    rolled,
    solved,
    stretched,
)
from hard_case import Finding, HardCase, at_most, below, exactly, true, within
from meshes import box_mesh, sphere_mesh

from solver import (
    Event,
    Mesh,
    Problem,
    SlenderAxis,
    SolverOptions,
    Supports,
    reaction,
    rotation,
    solve,
)

BOX = box_mesh((2, 1, 1))


def no_pressure() -> tuple[Finding, ...]:
    """Nothing, and next to nothing."""
    nothing = solve(cantilever(BOX), 0.0)
    per_load = [
        solved(cantilever(BOX), pressure).displacement / pressure
        for pressure in (1e-12, 1e-9, 1e-6)
    ]
    return (
        exactly("nodes that move at 0 MPa", int(np.count_nonzero(nothing.displacement)), 0),
        below("displacement per MPa, 1e-12 and 1e-9, differs by", distance(*per_load[:2]), 1e-6),
        at_most("1e-9 and 1e-6", distance(*per_load[1:]), 1e-4),
    )


def suction() -> tuple[Finding, ...]:
    """Negative pressure bends the other way; to first order just as far."""
    up, down = (solved(actuator(1), pressure) for pressure in (0.001, -0.001))
    vacuum = solve(actuator(1), -0.1)
    beyond = solve(actuator(1), -1.0)
    return (
        within("rotation at 1 kPa over that at -1 kPa", up.rotation / down.rotation, -1.02, -0.98),
        true("-0.1 MPa is reached, bent away from the tendon", vacuum.converged),
        within("rotation there", vacuum.rotation, -16.0, -15.0, "°"),
        true("-1 MPa collapses it: refused with the limit", beyond.limit is not None),
        within("limit", beyond.limit or 0.0, -0.21, -0.20, "MPa"),
    )


def last_point() -> tuple[Finding, ...]:
    """What the path says of a state at which a walk stopped, and the state itself."""
    solution = solve(actuator(1), -1.0)
    turned = rotation(solution.problem.mesh, solution.displacement)
    start = solution.displacement, solution.hydrostatic_pressure
    again = reached(solve(actuator(1), solution.pressure, initial=start))
    return (
        below(
            "rotation on the path off the state's by", abs(solution.rotation - turned), 1e-6, "°"
        ),
        below(
            "state off equilibrium by", distance(solution.displacement, again.displacement), 1e-4
        ),
        exactly("iterations to find it again", again.newton_iterations, 1),
    )


def absurd() -> tuple[Finding, ...]:
    """A terapascal, either way."""
    ends = [solve(actuator(1), pressure) for pressure in (1e6, -1e6)]
    ends += [solve(cantilever(BOX), pressure) for pressure in (1e6, -1e6, 1e300)]
    with_reason = [not end.converged and ": " in end.message for end in ends]
    finite = [np.isfinite(end.displacement).all() and end.stable is not False for end in ends]
    return (
        exactly("refused with a reason", sum(with_reason), len(ends)),
        true("the states returned are finite and stable", all(finite)),
    )


def balloon() -> tuple[Finding, ...]:
    """Five times what a thick ball of neo-Hooke bears."""
    mesh = sphere_mesh(10.0, 12.0, 1, 4)
    problem = Problem(mesh, NEO_HOOKE, THREE_PLANES, ("inside",))
    findings = []
    for first in (1.0, 0.02):
        solution = solve(problem, 5 * BALLOON, SolverOptions(first_step=first))
        limit = solution.limit or 0.0
        findings.append(within(f"limit, first step {first:g}", limit / BALLOON, 0.98, 1.02))
        findings.append(true("last state below it and stable", 0 <= solution.pressure < limit))
    return tuple(findings)


def _bearable() -> float:
    """Highest pressure of a neo-Hookean ball, mu = 1, radii 10 and 12 mm: closed form."""
    a = np.linspace(1.0, 4.0, 300001)
    b = np.cbrt(1 + (a**3 - 1) * (10 / 12) ** 3)
    return float((2 / b + 0.5 / b**4 - 2 / a - 0.5 / a**4).max())


BALLOON = _bearable()


def tension() -> tuple[Finding, ...]:
    """A clamped strip of NinjaFlex at 7.6 times its length: a quarter of it, and all of it."""
    led = {"x1": stretched(7.6, clamped=True)}
    mesh = box_mesh((6, 2, 1), (10.0, 2.0, 0.5))
    supports = Supports(("x0",), {"y0": 1, "z0": 2}, led)
    ends = [
        solve(Problem(mesh, NINJAFLEX, supports), 0.0, SolverOptions(first_step=first))
        for first in (0.1, 1.0)
    ]
    pull = reaction(ends[0], "x1").force[0] / (2.0 * 0.5)
    stretch = np.log(7.6) * np.array([1, -0.5, -0.5])
    stress = NINJAFLEX.principal_stresses(stretch)
    free = float(stress[0] - stress[1]) / 7.6
    whole = Problem(box_mesh((6, 2, 1), (10.0, 4.0, 1.0)), NINJAFLEX, Supports(("x0",), {}, led))
    wrinkled = solve(whole)
    return (
        true("660 % reached, also from a first step of 660 %", all(e.converged for e in ends)),
        below("which differ by", distance(ends[1].displacement, ends[0].displacement), 1e-4),
        within("force over that of a strip free to narrow", pull / free, 1.0, 1.3),
        true("held on its two end faces alone it wrinkles: refused", not wrinkled.converged),
        within("stretch at which", 1 + 6.6 * (wrinkled.limit or 0.0), 2.2, 2.35),
    )


def two_turns() -> tuple[Finding, ...]:
    """A strip bent by 792 degrees, its end led; and half way back."""
    bar = box_mesh((16, 1, 1), (20.0, 1.0, 0.3))
    mesh = Mesh(bar.nodes, bar.tets, {**bar.surfaces, "tip": bar.surfaces["x1"]})
    supports = Supports(("x0",), {"y0": 1}, {"x1": rolled(2.2, 20.0, 0.15)})
    axis = SlenderAxis(tuple(np.linspace(0.0, 20.0, 9)))
    solution = solve(Problem(mesh, NINJAFLEX, supports, axis=axis))
    strays = [abs(point.rotation - 792 * point.load) for point in solution.path]
    return (
        true("reached", solution.converged, solution.message),
        within("rotation of the tip", solution.rotation, 791.9, 792.1, "°"),
        below("rotation along the way off by", max(strays), 1e-6, "°"),
    )


def long_chain() -> tuple[Finding, ...]:
    """24 bubbles, very soft together."""
    solution = solve(actuator(24), 0.4)
    rotations = [point.rotation for point in solution.path]
    return (
        true("0.4 MPa reached", solution.converged, solution.message),
        within("rotation", solution.rotation, 619.0, 620.0, "°"),
        true("which rises all the way", rotations == sorted(rotations), rotations),
    )


def first_step() -> tuple[Finding, ...]:
    """The whole load at once, where an element turns inside out on the way."""
    problem = actuator(2)
    events: list[Event] = []
    careful = solve(problem, 0.4, SolverOptions(first_step=0.02, tolerance=1e-8))
    rash = solve(problem, 0.4, SolverOptions(first_step=1.0, tolerance=1e-8), events.append)
    bar = box_mesh((2, 2, 2))
    motion = Supports(("x0",), prescribed={"x1": stretched(0.35, clamped=True)})
    squeezed = solve(Problem(bar, NINJAFLEX, motion), 0.0, SolverOptions(first_step=1.0))
    refused = [event for event in events if event.kind == "refused"]
    loads = [point.load for point in rash.path]
    return (
        true("bellows: steps are refused", rash.refused_steps == len(refused) >= 1),
        true("and cut; the load is reached", rash.converged and loads == sorted(set(loads))),
        below("its state differs by", distance(rash.displacement, careful.displacement), 1e-7),
        true(
            "block squeezed to 0.35 in one step: refused steps, then "
            + ("reached" if squeezed.converged else "a reason"),
            squeezed.refused_steps >= 1,
            squeezed.message,
        ),
    )


def inside_out() -> tuple[Finding, ...]:
    """A full step that turns an element inside out never becomes a state."""
    mesh = box_mesh((4, 1, 1), (4.0, 1.0, 1.0))
    motion = Supports(("x0",), prescribed={"x1": rolled(0.5, 4.0, 0.5)})
    options = [SolverOptions(first_step=first, tolerance=1e-8) for first in (1.0, 0.05)]
    rash, careful = (solve(Problem(mesh, NEO_HOOKE, motion), 0.0, o) for o in options)
    return (
        true("bent by 180° at once: steps are refused", rash.refused_steps >= 1),
        true("reached all the same", rash.converged and careful.converged),
        below("differs by", distance(rash.displacement, careful.displacement), 1e-7),
    )


CASES = (
    HardCase(
        "Pressure 0 and next to 0",
        "divisions by the load; tolerances that swallow the result",
        "the load is a fraction; convergence is measured against the body",
        no_pressure,
    ),
    HardCase(
        "Suction",
        "signs; a collapse that is passed off as a result",
        "any sign; the limit is found and named",
        suction,
    ),
    HardCase(
        "A walk that stopped: its last point",
        "rotation and stress of a state on the way, displacements of a better one",
        "both are those of the state returned",
        last_point,
    ),
    HardCase(
        "An absurd pressure (±1e6 MPa)",
        "overflow, endless cutting, a diverged state",
        "steps are cut to the smallest one allowed, then the reason is given",
        absurd,
    ),
    HardCase(
        "Five times the limit of a balloon",
        "Newton lands on another branch or nowhere",
        "the limit point is named, whatever the first step",
        balloon,
    ),
    HardCase(
        "660 % strain",
        "corner elements turn inside out; the last fifth never converges",
        "refused steps are cut; a loss of stability is told from a failure",
        tension,
    ),
    HardCase(
        "Bending past 720°",
        "angles jump by 360°; linear increments stretch what they rotate",
        "increments are finite motions; whole turns are counted along the body",
        two_turns,
    ),
    HardCase(
        "Elements that turn inside out in a step",
        "J ≤ 0 passes unnoticed and stays",
        "J is watched at every point; such a step is refused and cut, the last state restored",
        inside_out,
    ),
    HardCase(
        "The whole load in the first step",
        "a state of another branch, or none",
        "refused, cut, and walked from the last good state",
        first_step,
    ),
    HardCase(
        "A chain of 24 bubbles",
        "so soft in bending that a small correction is no sign of equilibrium",
        "states on the way are tight by the elements' size, and judged by their own tangent",
        long_chain,
        slow=True,
    ),
)
