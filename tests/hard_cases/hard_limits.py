"""Limits of the load."""

from __future__ import annotations

import numpy as np
from hard_bodies import NEO_HOOKE, THREE_PLANES, Motion, Points, distance
from hard_case import Finding, HardCase, below, exactly, refused, true, within
from meshes import box_mesh, sphere_mesh

from solver import Problem, SolverOptions, Supports, Trace, Traction, solve, trace

BAR = box_mesh((4, 1, 1), (4.0, 1.0, 1.0))


def ascends(path: Trace) -> bool:
    """Whether the load grows from point to point and no limit is reported."""
    loads = [point.load for point in path.points]
    return loads == sorted(set(loads)) and loads[0] == 0 and not path.limits


def thin_sheet() -> tuple[Finding, ...]:
    """50 x 20 x 0.1, clamped ends led apart by 15 %, meshes without symmetry; a quarter of it."""

    def apart(positions: Points, load: float) -> Points:
        motion = np.zeros(positions.shape)
        motion[:, 0] = 0.15 * load * (positions[:, 0] - 25)
        return motion

    findings = []
    for cells in ((10, 4, 1), (16, 6, 2)):
        mesh = box_mesh(cells, (50.0, 20.0, 0.1))
        whole = Problem(mesh, NEO_HOOKE, Supports((), {}, {"x0": apart, "x1": apart}))
        path = trace(whole)
        label = "cells " + " × ".join(map(str, cells))
        findings.append(true(f"{label}: the load grows to the end", ascends(path) and _whole(path)))
        findings.append(true("walked by load: reached", solve(whole).converged))
    mesh = box_mesh((5, 2, 1), (25.0, 10.0, 0.1))
    led = {"x1": lambda positions, load: apart(positions + np.array([25.0, 0.0, 0.0]), load)}
    quarter = Problem(mesh, NEO_HOOKE, Supports((), {"x0": 0, "y0": 1}, led))
    findings.append(true("a quarter: the load grows", ascends(trace(quarter, steps=5))))
    return tuple(findings)


def _whole(path: Trace) -> bool:
    return path.message == "the asked load is reached."


KINKS = {
    "stops": ([0, 0.1, 1], [0, 1, 1]),
    "turns back": ([0, 0.3, 1], [0, 1, -0.5]),
    "starts late": ([0, 0.4, 1], [0, 0, 1]),
    "goes by stairs": ([0, 0.2, 0.4, 0.6, 1], [0, 0.5, 0.5, 1, 1]),
}


def led_by(motion: str) -> Motion:
    """The end of the bar led by 1.2 mm times a broken line."""

    def led(positions: Points, load: float) -> Points:
        displacement = np.full(positions.shape, np.nan)
        displacement[:, 0] = 1.2 * np.interp(load, *KINKS[motion])
        return displacement

    return led


def kinks() -> tuple[Finding, ...]:
    """Broken lines of motion, under pressure on a side; the states are those of a walk by load."""
    right, strays = 0, []
    for motion in KINKS:
        supports = Supports(symmetry=THREE_PLANES.symmetry, prescribed={"x1": led_by(motion)})
        bar = Problem(BAR, NEO_HOOKE, supports, ("y1",))
        path = trace(bar, 0.1)
        right += ascends(path) and _whole(path)
        number = max(n for n, point in enumerate(path.points) if point.load < 1)
        stops = [path.points[number].pressure]
        walked = solve(bar, 0.1, SolverOptions(tolerance=1e-9), stops=stops).at_stops[0]
        strays.append(distance(path.states[number].displacement, walked.displacement))
    return (
        exactly(
            "motions that stop, turn back, start late, go by stairs: traced to the end", right, 4
        ),
        below("last states off those of a walk by", max(strays), 1e-4),
    )


def column() -> tuple[Finding, ...]:
    """A clamped column under a dead load; a step reaches half as far again, or twice as far."""
    euler = np.pi**2 * 3.0 * 1.5 / 12 / (4 * 20.0**2)
    mesh = box_mesh((20, 2, 2), (20.0, 1.5, 1.0))
    findings = []
    for loads in (3.0, 20.0):
        load = Traction("x1", (-loads * euler / 1.5, 0.0, 0.0))
        problem = Problem(mesh, NEO_HOOKE, Supports(("x0",)), loads=(load,))
        limit = trace(problem, until=lambda point: point.stable is False).limits[0]
        before, behind = (loads * point.load for point in limit.between)
        low, high = min(before, behind), max(before, behind)
        findings.append(
            exactly(f"asked for {loads:g} Euler loads, found", limit.kind, "bifurcation")
        )
        findings.append(within("last stable load", low, 1.01, 1.025, "Euler loads"))
        findings.append(below("bracket", high / low - 1, 2.5e-3))
    return tuple(findings)


def out_of_reach() -> tuple[Finding, ...]:
    """A tolerance that no machine meets."""
    ball = Problem(sphere_mesh(10.0, 11.0, 1, 2), NEO_HOOKE, THREE_PLANES, ("inside",))
    ended = solve(ball, 0.06, SolverOptions(tolerance=1e-20))
    there = solve(ball, ended.pressure, SolverOptions(tolerance=1e-12))
    return (
        true("not converged, with a reason", not ended.converged and ": " in ended.message),
        true("which says how good its last state is", "in equilibrium to" in ended.message),
        within("load reached", ended.load, 0.7, 1.0),
        below("its state is off by", distance(ended.displacement, there.displacement), 1e-8),
    )


def no_load() -> tuple[Finding, ...]:
    """Nothing that a path could be followed with."""
    still = Problem(BAR, NEO_HOOKE, Supports(("x0",)))
    held = Problem(BAR, NEO_HOOKE, Supports(("x0",)), loads=(Traction("x0", (0.0, 0.0, -1.0)),))
    backwards = solve(Problem(BAR, NEO_HOOKE, Supports(("x0",)), ("z0",)), -1.0, UNTIMELY)
    return (
        refused(
            "paths without a load, or with one on a clamp",
            {
                "nothing": (lambda: trace(still), "no load moves the body"),
                "clamp": (lambda: trace(held), "no load moves the body"),
            },
        ),
        true("no zero has a sign", backwards.message.startswith("stopped at 0 of -1 MPa")),
    )


UNTIMELY = SolverOptions(seconds=1e-9)


CASES = (
    HardCase(
        "A thin sheet led apart",
        "bending is so soft that the first tangent points out of the plane; the path starts into "
        "compression, with limits at negative loads",
        "a step whose load goes against its slope is cut; a limit needs a load that turns",
        thin_sheet,
    ),
    HardCase(
        "Led motions with kinks",
        "the path turns sharply, or back on itself: taken for a limit, or for its end",
        "a turn that stays sharp however short the step is a kink; the load goes on",
        kinks,
    ),
    HardCase(
        "A column stepped over its critical load",
        "the far end of a step is reported as the bifurcation",
        "equilibria at given loads on both sides, until their loads differ by 0.2 %",
        column,
        inertia=True,
    ),
    HardCase(
        "A tolerance that no state meets",
        "the whole walk is lost: the answer is the unloaded body",
        "the last state is kept, corrected as far as that goes, and the message says how far",
        out_of_reach,
    ),
    HardCase(
        "A path without a load",
        "division by zero; a zero with a sign",
        "refused in one sentence",
        no_load,
    ),
)
