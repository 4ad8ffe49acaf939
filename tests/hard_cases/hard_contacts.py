"""Rigid planes and springs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from hard_bodies import CLAMPED, NEO_HOOKE, THREE_PLANES, TIGHT
from hard_case import Finding, HardCase, at_most, below, exactly, refused, true, within
from meshes import box_mesh, sphere_mesh

from solver import (
    FoundationSpring,
    NodeSpring,
    Problem,
    RigidPlane,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    contact_forces,
    reaction,
    solve,
)

CUBE = box_mesh((2, 2, 2))
HALF = 0.5**-2 - 0.5
"""N, on a unit cube of neo-Hooke between plates at half its height."""


def lid(depth: float = 1e-3, travel: float = 0.6) -> RigidPlane:
    """A plate that comes down on the cube from 0.1 mm above it."""
    return RigidPlane("z1", depth, (0, 0, -1), (0, 0, 1.1), lambda load: (0, 0, -travel * load))


def squeezed(plane: RigidPlane, options: SolverOptions | None = None) -> Solution:
    """The cube under the plate."""
    return solve(Problem(CUBE, NEO_HOOKE, THREE_PLANES, contacts=(plane,)), options=options)


def force(solution: Solution) -> float:
    """Of the first plane on the body along -z, N."""
    return -float(contact_forces(solution)[0].force[2])


def ever_stiffer() -> tuple[Finding, ...]:
    """Penetrations over six decades."""
    depths = (1e-2, 1e-4, 1e-6, 1e-8)
    solutions = [squeezed(lid(depth)) for depth in depths]
    errors = [abs(force(each) / HALF - 1) for each in solutions]
    return (
        exactly("reached", sum(each.converged for each in solutions), len(depths)),
        at_most("force off over the penetration, to 1e-4 mm", errors[1] / depths[1], 50),
        below("force off at 1e-8 mm", errors[3], 1e-5),
    )


def long_steps() -> tuple[Finding, ...]:
    """The whole way at once, or by hundredths."""
    solutions = [squeezed(lid(), replace(TIGHT, first_step=step)) for step in (1.0, 0.5, 0.01)]
    forces = [force(each) for each in solutions]
    return (
        true("reached", all(each.converged for each in solutions)),
        below("forces differ by", float(np.ptp(forces)), 1e-6, "N"),
    )


def lifted_off() -> tuple[Finding, ...]:
    """A plate that comes and goes."""
    back = replace(lid(), motion=lambda load: (0, 0, -0.5 * np.sin(np.pi * load)))
    solution = squeezed(back)
    (contact,) = contact_forces(solution)
    return (
        true("reached", solution.converged, solution.message),
        true("no force is left", not contact.force.any(), contact.force),
        below("displacement left", float(np.abs(solution.displacement).max()), 1e-5, "mm"),
    )


def rammed() -> tuple[Finding, ...]:
    """A plate that goes on through the body."""
    solution = squeezed(lid(travel=1.3))
    stretch = 1 + float(solution.displacement[:, 2].min())
    return (
        true("the way through is refused", not solution.converged),
        within("last stretch", stretch, 0.3, 0.6),
        below("its force off by", abs(force(solution) / (stretch**-2 - stretch) - 1), 1e-6),
    )


def two_at_an_edge() -> tuple[Finding, ...]:
    """Two plates askew that meet over an edge of a clamped bar."""
    mesh = box_mesh((4, 2, 2), (2.0, 1.0, 1.0))
    ahead = RigidPlane("x1", 1e-3, (-1, 0, 0.3), (2.05, 0, 0), lambda load: (-0.2 * load, 0, 0))
    above = RigidPlane("z1", 1e-3, (0.2, 0, -1), (0, 0, 1.05), lambda load: (0, 0, -0.12 * load))
    solution = solve(Problem(mesh, NEO_HOOKE, CLAMPED, contacts=(ahead, above)), options=TIGHT)
    forces = [contact.force for contact in contact_forces(solution)]
    held = reaction(solution, "x0").force
    return (
        true("reached", solution.converged, solution.message),
        true("both bear", all(np.linalg.norm(each) > 0.1 for each in forces), forces),
        below(
            "what is left of clamp and plates", float(np.abs(held + sum(forces)).max()), 1e-7, "N"
        ),
    )


def curved_face() -> tuple[Finding, ...]:
    """A plate that touches the sphere that curved triangles stand for: they reach beyond it."""
    ball = sphere_mesh(1.0, 2.0, 1, 2)

    def plate(height: float) -> Callable[[], object]:
        plane = RigidPlane("outside", 1e-3, (0, 0, -1), (0, 0, height))
        problem = Problem(ball, NEO_HOOKE, THREE_PLANES, ("inside",), contacts=(plane,))
        return lambda: solve(problem, 0.1)

    calls = {"at the sphere": (plate(2.0), "beyond its plane before any load")}
    return (
        refused("with the distance", calls),
        true("a little above it is solved", bool(getattr(plate(2.02)(), "converged", False))),
    )


def meaningless() -> tuple[Finding, ...]:
    """Planes and springs that cannot be."""
    planes = {
        "normal of length zero": ({"normal": (0, 0, 0)}, "length zero"),
        "normal away from the body": ({"normal": (0, 0, 1)}, "the side to which the normal"),
        "two numbers": ({"point": (0, 0)}, "3 finite numbers"),
        "no depth": ({"penetration": 0.0}, "must be above 0"),
        "a motion that starts with a leap": ({"motion": lambda load: (0, 0, 1.0)}, "at no load"),
        "a motion that is no function": ({"motion": (0, 0, 1)}, "function of the load"),
        "a motion in one number": ({"motion": lambda load: load}, "3 finite numbers"),
        "an unknown surface": ({"surface": "lid"}, "no surface is called"),
    }
    springs = {
        "negative": (lambda: FoundationSpring("x1", (1, 1, -1)), "must not be negative"),
        "not symmetric": (lambda: NodeSpring((0, 0, 0), np.eye(3)[[1, 2, 0]]), "symmetric"),
        "one number": (lambda: FoundationSpring("x1", 1.0), "3 finite numbers or 3 x 3"),
        "on no node": (lambda: _sprung(NodeSpring((0, 0, 0.3), (1, 1, 1))), "no node lies"),
        "no spring": (lambda: _sprung(3.0), "needs FoundationSpring or NodeSpring"),
    }
    rammed = {
        label: (lambda change=change: squeezed(replace(lid(), **change)), words)
        for label, (change, words) in planes.items()
    }
    return refused("planes", rammed), refused("springs", springs)


def _sprung(spring: object) -> Problem:
    return Problem(CUBE, NEO_HOOKE, THREE_PLANES, springs=(spring,))


def softest_springs() -> tuple[Finding, ...]:
    """A cube that only springs hold turns under a force at its side; from soft to hard."""
    tilts, reached = [], 0
    for stiffness in (1e-5, 1e-3):
        springs = (FoundationSpring("x0", 3 * (stiffness,)),)
        load = Traction("x1", (0, 0, 0.02 * stiffness))
        solution = solve(Problem(CUBE, NEO_HOOKE, Supports(), loads=(load,), springs=springs))
        reached += solution.converged
        tilts.append(float(np.ptp(solution.displacement[CUBE.surface_nodes("x0"), 0])))
    load = Traction("x1", (0, 0, 0.02))
    hard = Problem(
        CUBE, NEO_HOOKE, Supports(), loads=(load,), springs=(FoundationSpring("x0", 3 * (1e9,)),)
    )
    bent, clamped = solve(hard), solve(Problem(CUBE, NEO_HOOKE, CLAMPED, loads=(load,)))
    off = np.abs(bent.displacement - clamped.displacement).max()
    return (
        exactly("soft ones reached", reached, 2),
        below("their turns differ by", float(np.ptp(tilts)) / tilts[0], 1e-3),
        below("springs of 1e9 N/mm³ off a clamp", float(off), 1e-7, "mm"),
    )


CASES = (
    HardCase(
        "A plate that yields ever less",
        "a penalty without bound spoils the matrix, or the set in contact never settles",
        "Newton passes through a softer plate where need be; the last correction is below the "
        "penetration",
        ever_stiffer,
    ),
    HardCase(
        "A plate that comes in one step",
        "the first guess lies deep in the plate and elements turn inside out",
        "steps are cut until the body follows; the answer does not depend on them",
        long_steps,
    ),
    HardCase(
        "A plate that lifts off again",
        "forces or displacements stay behind",
        "contact has no memory",
        lifted_off,
    ),
    HardCase(
        "A plate that goes through the body",
        "a body squeezed to nothing is passed off as an answer",
        "the walk ends where stability is lost, at a state that is right",
        rammed,
    ),
    HardCase(
        "Two plates over one edge",
        "a node that two planes hold is released by one of them",
        "each plane adds its own energy; clamp and plates are in balance",
        two_at_an_edge,
    ),
    HardCase(
        "A plate at the top of a curved face",
        "triangles reach beyond the sphere they stand for: contact before any load",
        "refused with the distance; a plate a little farther is fine",
        curved_face,
    ),
    HardCase(
        "Planes and springs that mean nothing",
        "a crash in the solver, or a silent nonsense",
        "refused in a sentence with the value and its unit",
        meaningless,
    ),
    HardCase(
        "A body that only springs hold",
        "soft springs are lost beside the stress that a loose tolerance leaves",
        "with springs the path is followed to the full tolerance; stiff ones become a clamp",
        softest_springs,
    ),
)
