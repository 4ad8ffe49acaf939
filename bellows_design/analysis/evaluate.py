"""A design under pressure, on a sequence of meshes.

The load is walked on a coarse mesh; a finer mesh, refined where the solution is least accurate,
starts from it at full load and needs a handful of iterations.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import astuple, replace
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.analysis.budget import DEFAULT, Budget
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.models import FREE_CELL, HALF, UNIT_CELL, Model, choose, shortened
from bellows_design.design.design import Design
from bellows_design.progress import Progress, Silence

if TYPE_CHECKING:
    from solver import Event, Problem, Solution, SolverOptions
    from solver.arrays import Reals

SILENCE = Silence()

ROUGH = 1e-3
"""Newton tolerance on meshes that are only a step to the next, in units of the body's diagonal."""


def evaluate(
    design: Design,
    model: str = "auto",
    accuracy_percent: float | None = None,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Evaluation:
    """Evaluate ``design`` at its design pressure, and at ``pressures`` (MPa) between 0 and that.

    ``model`` is ``auto``, ``unit-cell``, ``half`` or ``full``. With ``accuracy_percent`` the mesh
    is refined until both error estimates keep it, or the next mesh would exceed the ``budget``: the
    estimates then say what was reached. A load that cannot be reached gives an evaluation with
    ``converged`` False.

    Raises:
        ValueError: unknown model, accuracy or pressures out of bounds, a geometry the CAD kernel
            refuses, or a first mesh that exceeds the budget.
        MeshingError: no usable mesh, or none in time.
    """
    _check(design, accuracy_percent, pressures)
    evaluation = started(design, *choose(design, model), pressures, progress, budget)
    while not _enough(evaluation, accuracy_percent) and evaluation.can_refine:
        evaluation = refined(evaluation, progress)
    return evaluation


def started(
    design: Design,
    model: Model,
    reason: str,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
) -> Evaluation:
    """``design`` on the coarsest mesh of ``model``, with the ends if that is the unit cell."""
    from solver.meshing import process as meshing_process

    meshing_process.start()  # loads Gmsh while the solid is built
    progress.stage(f"geometry of the {model.name}")
    start = time.perf_counter()
    solid = model.solid(design)
    spent = {"geometry": time.perf_counter() - start, "mesh": 0.0, "solve": 0.0}
    blank = Evaluation(
        design, model, reason, solid, (), spent, tuple(sorted(pressures)), budget=budget
    )
    evaluation = refined(blank, progress)
    if model is UNIT_CELL and evaluation.converged:
        return _with_ends(evaluation, progress)
    return evaluation


def refined(evaluation: Evaluation, progress: Progress = SILENCE) -> Evaluation:
    """The same evaluation on one finer mesh, started from the finest solution at hand."""
    from solver import SolverOptions, transfer

    design, model, level = evaluation.design, evaluation.model, len(evaluation.solutions)
    progress.stage(f"mesh {level + 1}")
    began = time.perf_counter()
    mesh = evaluation.next_mesh.made(evaluation.budget)
    meshed = time.perf_counter()
    progress.stage(f"solve {level + 1}, {len(mesh.tets)} tetrahedra")
    initial = transfer(evaluation.finest, mesh) if level else None
    only_a_step = level + 1 < model.levels
    options = SolverOptions(tolerance=ROUGH) if only_a_step else None
    stops = () if level and only_a_step else evaluation.pressures
    problem = model.problem(design, mesh)
    solution = _solved(design, problem, progress, options, initial, stops)
    return _spent(
        replace(evaluation, solutions=(*evaluation.solutions, solution)),
        0.0,
        meshed - began,
        meshed,
    )


def _with_ends(evaluation: Evaluation, progress: Progress) -> Evaluation:
    """With the solution of a short actuator, on the mesh size of the coarsest cell.

    Contact is not modelled in it. That is right outside, where its bubble has no neighbours; but
    where inner walls touch, the cell without its neighbours stands for the ends, without the stubs
    of root and tip.
    """
    from bellows_design.analysis.mesh_plan import first_plan
    from bellows_design.analysis.wall_contact import image_gap
    from bellows_design.geometry.actuator import CAVITY
    from solver import SolverOptions

    inner = image_gap(evaluation.finest, CAVITY)
    if inner is not None and inner <= 0:
        return _with_free_ends(evaluation, progress)
    progress.stage("ends: an actuator of one bubble")
    began = time.perf_counter()
    short = shortened(evaluation.design)
    solid = HALF.solid(short)
    built = time.perf_counter()
    mesh = first_plan(solid, short).made(evaluation.budget)
    meshed = time.perf_counter()
    options = SolverOptions(tolerance=ROUGH)
    problem = HALF.problem(short, mesh)
    ends = _solved(short, problem, progress, options, stops=evaluation.pressures)
    return _spent(replace(evaluation, ends=ends), built - began, meshed - built, meshed)


def _with_free_ends(evaluation: Evaluation, progress: Progress) -> Evaluation:
    """With the solution of a bubble without neighbours, on the coarsest cell's mesh."""
    from solver import SolverOptions

    progress.stage("ends: a bubble without neighbours")
    began, design = time.perf_counter(), evaluation.design
    problem = FREE_CELL.problem(design, evaluation.solutions[0].problem.mesh)
    options = SolverOptions(tolerance=ROUGH)
    ends = _solved(design, problem, progress, options, stops=evaluation.pressures)
    return _spent(replace(evaluation, ends=ends), 0.0, 0.0, began)


def _solved(
    design: Design,
    problem: Problem,
    progress: Progress,
    options: SolverOptions | None,
    initial: tuple[Reals, Reals] | None = None,
    stops: Sequence[float] = (),
) -> Solution:
    """Solve at the design's pressure and tell how far it is."""
    from solver import solve

    def report(event: Event) -> None:
        progress.load(event.load, event.rotation)

    pressure = design.load.pressure
    return solve(problem, pressure, options, listener=report, initial=initial, stops=stops)


def _spent(evaluation: Evaluation, geometry: float, mesh: float, since: float) -> Evaluation:
    """Add seconds of geometry and mesh, and the solve's ``since`` a time."""
    seconds = evaluation.seconds
    more = {
        "geometry": seconds["geometry"] + geometry,
        "mesh": seconds["mesh"] + mesh,
        "solve": seconds["solve"] + time.perf_counter() - since,
    }
    return replace(evaluation, seconds=more)


def write_vtu(evaluation: Evaluation, path: Path) -> None:
    """Write the finest solution for ParaView, completely or not at all."""
    from bellows_design.files.atomic import replacing
    from solver import write_vtu as write

    with replacing(path) as temporary:
        write(temporary, evaluation.finest)


def _check(design: Design, accuracy_percent: float | None, pressures: Sequence[float]) -> None:
    if accuracy_percent is not None and not 0.01 <= accuracy_percent <= 100:
        raise ValueError(f"accuracy = {accuracy_percent:g} % must lie between 0.01 and 100 %.")
    highest = design.load.pressure
    for pressure in pressures:
        if not 0 < pressure / highest <= 1 + 1e-12:
            raise ValueError(
                f"pressure = {pressure:g} MPa must lie between 0, excluded, and the design's "
                f"{highest:g} MPa."
            )


def _enough(evaluation: Evaluation, accuracy_percent: float | None) -> bool:
    levels = evaluation.model.levels
    if len(evaluation.solutions) < levels or accuracy_percent is None:
        return len(evaluation.solutions) >= levels
    estimates = astuple(evaluation.error_estimate)
    return all(error is not None and error <= accuracy_percent for error in estimates)
