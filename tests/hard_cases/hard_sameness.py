"""The same answer whichever way it is asked for."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from hard_bodies import (
    NINJAFLEX,
    TIGHT,
    Points,
    actuator,
    cantilever,
    distance,
    moved,
    reached,
    solved,
)
from hard_case import Finding, HardCase, below, exactly, true
from meshes import box_mesh

from solver import (
    Checkpoint,
    Event,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    nodal_von_mises,
    solve,
    transfer,
)

BAR = box_mesh((3, 1, 1), (3.0, 1.0, 0.8), distortion=0.2)
CLOSE = SolverOptions(tolerance=1e-8)
STEPS = SolverOptions(first_step=0.1)


def history() -> tuple[Finding, ...]:
    """First steps, growth, stops, detours."""
    problem, pressure = actuator(2), 0.2
    ways = {
        "one step": SolverOptions(first_step=1.0, tolerance=1e-8),
        "steps of 1 %, growing by 1.3": SolverOptions(first_step=0.05, growth=1.3, tolerance=1e-8),
        "never an old factorization": SolverOptions(reuse=0.0, tolerance=1e-8),
        "tight in between": SolverOptions(loose_tolerance=1e-7, tolerance=1e-8),
        "SuperLU": SolverOptions(linear_solver="superlu", tolerance=1e-8),
    }
    usual = solved(problem, pressure, CLOSE)
    ends = [solved(problem, pressure, options) for options in ways.values()]
    ends.append(reached(solve(problem, pressure, CLOSE, stops=(0.013, 0.07, 0.19))))
    beyond = solved(problem, 0.4, CLOSE)
    start = beyond.displacement, beyond.hydrostatic_pressure
    ends.append(reached(solve(problem, pressure, CLOSE, initial=start)))
    strays = [distance(end.displacement, usual.displacement) for end in ends]
    steps = {end.load_steps for end in ends}
    return (
        below(f"{len(ends)} ways, displacement differs by", max(strays), 1e-7),
        true("though load steps differ", len(steps) > 2, steps),
    )


def superlu() -> tuple[Finding, ...]:
    """Another linear solver."""
    problem = cantilever(BAR)
    usual = solved(problem, 0.1, CLOSE)
    portable = solved(problem, 0.1, SolverOptions(tolerance=1e-8, linear_solver="superlu"))
    return (below("SuperLU differs by", distance(portable.displacement, usual.displacement), 1e-8),)


def threads() -> tuple[Finding, ...]:
    """One thread and two, each in a process of its own."""
    with TemporaryDirectory() as folder:
        files = [Path(folder) / f"{count}.npy" for count in (1, 2)]
        for count, file in zip((1, 2), files, strict=True):
            _in_a_process(count, file)
        one, two = (np.load(file) for file in files)
    return (below("displacement differs by", distance(one, two), 1e-10),)


def _in_a_process(count: int, file: Path) -> None:
    limits = dict.fromkeys(("NUMBA_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"), str(count))
    folders = [str(Path(__file__).parent), *sys.path]
    environment = {**os.environ, **limits, "PYTHONPATH": os.pathsep.join(folders)}
    command = [sys.executable, "-c", f"import hard_sameness as s; s.write_down({str(file)!r})"]
    subprocess.run(command, check=True, env=environment, timeout=300)


def write_down(file: str) -> None:
    """Solve a bellows and save its displacement."""
    np.save(file, solved(actuator(2), 0.2, CLOSE).displacement)


def rotated() -> tuple[Finding, ...]:
    """The same bar, turned and shifted, and mirrored at three planes."""
    turn = np.linalg.qr(np.array([[1.0, 2.0, 0.5], [-1.0, 0.3, 2.0], [0.2, 1.0, 1.0]]))[0]
    turn *= np.linalg.det(turn)
    mirrors = [np.diag(signs) for signs in ([-1.0, 1, 1], [1.0, -1, 1], [1.0, 1, -1])]
    usual = solved(cantilever(BAR), 0.1, CLOSE)
    far = max(_differences(usual, turn, np.array([5.0, -3.0, 8.0])))
    images = max(max(_differences(usual, mirror, 0.0)) for mirror in mirrors)
    return (
        below("turned and shifted: displacement, stress, pressure differ by", far, 1e-7),
        below("mirrored at each plane", images, 1e-7),
    )


def _differences(usual: Solution, matrix: Points, shift: Points | float) -> tuple[float, ...]:
    """Of displacement, von Mises stress and hydrostatic pressure, from those of the image."""
    image = solved(cantilever(moved(BAR, matrix, shift)), 0.1, CLOSE)
    return (
        distance(image.displacement @ matrix, usual.displacement),
        distance(nodal_von_mises(image), nodal_von_mises(usual)),
        distance(image.hydrostatic_pressure, usual.hydrostatic_pressure),
    )


def units_of_stress() -> tuple[Finding, ...]:
    """Moduli and pressure in kPa and in GPa, and yet smaller and larger."""
    problem = cantilever(BAR)
    usual = solved(problem, 0.1, CLOSE)
    strays = []
    for factor in (1e-6, 1e-3, 1e3, 1e6):
        material = Ogden(tuple(factor * mu for mu in NINJAFLEX.mu), NINJAFLEX.alpha)
        found = solved(cantilever(BAR, material), 0.1 * factor, CLOSE)
        strays.append(distance(found.displacement, usual.displacement))
    return (below("μ and p times 1e-6 … 1e6: displacement differs by", max(strays), 1e-9),)


def far_units_of_stress() -> tuple[Finding, ...]:
    """Moduli and pressure so small or large that the matrix is badly scaled."""
    usual = solved(cantilever(BAR), 0.1, CLOSE)
    strays = []
    for factor in (1e-12, 1e-9, 1e9, 1e12):
        material = Ogden(tuple(factor * mu for mu in NINJAFLEX.mu), NINJAFLEX.alpha)
        found = solve(cantilever(BAR, material), 0.1 * factor, CLOSE)
        off = distance(found.displacement, usual.displacement)
        strays.append(off if found.converged else np.inf)
    return (below("displacement differs by", max(strays), 1e-9),)


class Interruption(Exception):
    """Stands for a power cut."""


def resumed() -> tuple[Finding, ...]:
    """Broken off after each step, written down, read, and gone on with."""
    problem, pressure = actuator(1), 0.1
    whole = solve(problem, pressure, STEPS)
    ends = [_broken_off(problem, pressure, steps) for steps in range(1, whole.load_steps)]
    same = [_same_bits(end, whole) for end in ends]
    return (
        exactly("runs resumed", len(ends), whole.load_steps - 1),
        exactly("of them equal to the last bit", sum(same), len(same)),
        true("and so is a second run", _same_bits(solve(problem, pressure, STEPS), whole)),
    )


def _broken_off(problem: Problem, pressure: float, steps: int) -> Solution:
    seen: list[Checkpoint] = []

    def listener(event: Event) -> None:
        if event.checkpoint is not None:
            seen.append(event.checkpoint)
            if len(seen) == steps:
                raise Interruption

    with TemporaryDirectory() as folder:
        try:
            solve(problem, pressure, STEPS, listener)
        except Interruption:
            seen[-1].save(Path(folder) / "walk.npz")
        checkpoint = Checkpoint.load_from(Path(folder) / "walk.npz")
    return solve(problem, pressure, STEPS, resume=checkpoint)


def _same_bits(one: Solution, other: Solution) -> bool:
    fields: Sequence[str] = ("displacement", "hydrostatic_pressure")
    arrays = all(np.array_equal(getattr(one, name), getattr(other, name)) for name in fields)
    return arrays and one.path == other.path and one.newton_iterations == other.newton_iterations


def fine_from_coarse() -> tuple[Finding, ...]:
    """The load path on the mesh itself, or a start from a coarser one."""
    fine = cantilever(box_mesh((4, 2, 2), (3.0, 1.0, 0.8)))
    coarse = solved(cantilever(box_mesh((3, 1, 1), (3.0, 1.0, 0.8))), 0.05)
    walked = solved(fine, 0.05)
    carried = reached(solve(fine, 0.05, TIGHT, initial=transfer(coarse, fine.mesh)))
    return (
        exactly("load steps", carried.load_steps, 1),
        below("differs by", distance(carried.displacement, walked.displacement), 1e-7),
    )


CASES = (
    HardCase(
        "History of load steps",
        "the answer depends on how the load was walked",
        "every walk ends in Newton's method at the whole load",
        history,
    ),
    HardCase(
        "A start from another mesh",
        "the coarse mesh shines through",
        "the start only saves the way",
        fine_from_coarse,
    ),
    HardCase(
        "Interrupted and resumed",
        "the walk goes on differently",
        "a checkpoint has all that the next step depends on",
        resumed,
    ),
    HardCase(
        "Number of threads",
        "sums in another order",
        "elements are added colour by colour, pivots in a fixed order",
        threads,
    ),
    HardCase(
        "Another linear solver",
        "results of one machine only",
        "what is not converged to the same state is no result",
        superlu,
    ),
    HardCase(
        "A model turned, shifted, mirrored",
        "a preferred direction in formulas, numbering or quadrature",
        "none",
        rotated,
    ),
    HardCase(
        "Units of stress",
        "absolute tolerances",
        "convergence is measured in displacements against the body's size",
        units_of_stress,
    ),
    HardCase(
        "Far units of stress",
        "pivots that are small only for their units count as zero",
        "unknowns are scaled by their own stiffness before the factorization",
        far_units_of_stress,
    ),
)
