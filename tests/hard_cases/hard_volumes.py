"""Volume control."""

from __future__ import annotations

import numpy as np
from hard_bodies import NEO_HOOKE, NINJAFLEX, THREE_PLANES, Points, reached
from hard_case import Finding, HardCase, below, exactly, refused, true, within
from meshes import box_mesh, mapped_box, sphere_mesh, tube_mesh
from thick_walls import closed_tube_at, highest_in_closed_tube

from solver import Mesh, Problem, Solution, SolverOptions, Supports, cavity_volume, inflate

FIRST_STEPS = (0.02, 0.05, 0.1, 0.3)
SMALL_STEPS = SolverOptions(tolerance=1e-8, first_step=0.02, growth=1.001)
"""Which take the branch that is stable at a held volume."""


def tube() -> Problem:
    """Half of a slice of a tube with closed ends free to move: coarse around, 36 elements."""

    def place(cube: Points) -> Points:
        radius, angle = 5 + cube[:, 1], np.pi * cube[:, 2]
        return np.stack([2 * cube[:, 0], radius * np.sin(angle), -radius * np.cos(angle)], 1)

    supports = Supports(symmetry={"x0": 0, "z0": 1, "z1": 1})
    mesh = mapped_box((1, 1, 6), place)
    return Problem(mesh, NINJAFLEX, supports, ("y0",), moving_plane="x1")


def at_rest(problem: Problem) -> float:
    """Volume inside the pressurised surfaces, mm^3."""
    mesh = problem.mesh
    return cavity_volume(mesh, np.zeros_like(mesh.nodes), problem.pressurised)


def walks(factor: float) -> list[Solution]:
    """The tube at so many times its volume, reached in several ways."""
    volume = factor * at_rest(tube())
    options = [SolverOptions(tolerance=1e-8, first_step=step) for step in FIRST_STEPS]
    options.append(SMALL_STEPS)
    return [reached(inflate(tube(), volume, each)) for each in options]


def lost() -> tuple[Finding, ...]:
    """The maximum of the pressure, whatever the steps."""
    limit = highest_in_closed_tube(NINJAFLEX, 5.0, 6.0)
    found = [walk.limit or 0.0 for walk in walks(5.0)]
    return (
        exactly("walks with other steps", len(found), 5),
        below("limit off the closed form's by", max(abs(p / limit - 1) for p in found), 1e-4),
    )


def branches() -> tuple[Finding, ...]:
    """The coarse tube at three times its radius: five walks, two branches."""
    pressure = closed_tube_at(NINJAFLEX, 5.0, 6.0, 10.2)
    found = walks(10.2)
    told = ["another branch" in walk.message and bool(walk.bifurcations) for walk in found]
    on_first = [abs(walk.pressure / pressure - 1) < 1e-3 for walk in found]
    unstable = [walk.stable_at_volume is False for walk in found]
    begins = [walk.bifurcations[0].volume / at_rest(tube()) for walk in found]
    return (
        exactly("walks that say where another branch begins", sum(told), 5),
        within("which is at the volume times, least", min(begins), 7.0, 7.6),
        within("most", max(begins), 7.0, 7.6),
        true(
            "those that stay on the closed form, and only they, are called unstable at a held "
            "volume",
            on_first == unstable,
            (on_first, unstable),
        ),
        true("one with small steps takes another, which is stable", found[-1].stable_at_volume),
    )


def smooth() -> tuple[Finding, ...]:
    """Paths without branches."""
    ball = Problem(sphere_mesh(10.0, 12.0, 1, 4), NEO_HOOKE, THREE_PLANES, ("inside",))
    found = [
        reached(inflate(ball, 8 * at_rest(ball), SolverOptions(first_step=step)))
        for step in FIRST_STEPS
    ]
    return (exactly("branches on four walks", sum(len(walk.bifurcations) for walk in found), 0),)


def from_outside() -> tuple[Finding, ...]:
    """A sphere that buckles."""
    mesh = sphere_mesh(10.0, 12.0, 1, 4)
    problem = Problem(mesh, NEO_HOOKE, THREE_PLANES, ("outside",))
    pressed = reached(inflate(problem, 0.85 * at_rest(problem)))
    thin = 2 * 3.0 * (2 / 11) ** 2 / np.sqrt(3 * 0.75)
    return (
        within("buckles at the thin shell's pressure times", (pressed.limit or 0) / thin, 0.9, 1.1),
        true("called unstable at a held volume too", pressed.stable_at_volume is False),
    )


def no_volume() -> tuple[Finding, ...]:
    """What has no volume to control."""
    box, quarter = box_mesh((1, 1, 1)), tube_mesh(5.0, 6.0, 1.0, (1, 2, 1), np.pi / 2)
    lifted = Mesh(quarter.nodes[:, [1, 2, 0]] + [0.0, 1.0, 0.0], quarter.tets, quarter.surfaces)
    across = Supports(symmetry={"start": 0, "end": 2, "z0": 1, "z1": 1})
    open_tube = Supports(symmetry={"start": 1, "end": 0, "z0": 2})
    ball = Problem(sphere_mesh(10.0, 12.0, 1, 2), NEO_HOOKE, THREE_PLANES, ("inside",))
    problems = {
        "an end of a bar": (Problem(box, NEO_HOOKE, THREE_PLANES, ("x1",)), "rim is free at"),
        "an open tube": (Problem(quarter, NEO_HOOKE, open_tube, ("inside",)), "rim is free at"),
        "across y": (Problem(lifted, NEO_HOOKE, across, ("inside",)), "slides in a plane normal"),
        "incompressible": (
            Problem(box, NEO_HOOKE, THREE_PLANES, ("x1", "y1", "z1")), "cannot change"
        ),
        "no pressure": (Problem(box, NEO_HOOKE, THREE_PLANES), "must be pressurised"),
    }  # fmt: skip
    calls = {
        label: (lambda problem=problem: inflate(problem, 0.9), words)
        for label, (problem, words) in problems.items()
    }
    calls["a negative cavity"] = (lambda: inflate(ball, -600.0), "must be positive")
    return (refused("volumes", calls),)


CASES = (
    HardCase(
        "The pressure that a volume-controlled body cannot be held at",
        "the last stable step is passed off as the limit, up to a seventh too low",
        "the maximum is found between the two steps around it, and has a point on the path",
        lost,
    ),
    HardCase(
        "A branch that leaves a volume-controlled path",
        "a state of another branch, 0.7 % off in pressure, or one that no syringe holds, "
        "without a word",
        "unstable modes at the held volume are counted, sharp turns looked into; the place is "
        "located and told",
        branches,
        inertia=True,
    ),
    HardCase(
        "Paths of given volume without branches",
        "steps that are long, or bend, are taken for branches",
        "a turn counts only if most of it happens in an eighth of a step",
        smooth,
    ),
    HardCase(
        "A hollow sphere squeezed from outside",
        "volumes of outer surfaces are negative; the sphere stays round past its buckling load",
        "either sign is taken; the loss of stability is located and told",
        from_outside,
        inertia=True,
    ),
    HardCase(
        "Surfaces that enclose no volume",
        "an integral that is no volume is controlled instead of one",
        "refused with the place of the rim, or with the reason",
        no_volume,
    ),
)
