"""The meshes of a computation, one after the other.

The load is walked on a coarse mesh; a finer mesh, refined where the solution is least accurate,
starts from it at full load and needs a handful of iterations.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bellows_design.analysis.computation import Body, Computation, Seconds, SolvedMesh
from bellows_design.analysis.models import (
    FREE_CELL,
    HALF,
    UNIT_CELL,
    AnalysisModel,
    Solving,
    Subject,
    shortened,
)
from bellows_design.beside import Beside, beside
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.analysis.mesh_plan import PlannedMesh
    from solver import Event, Mesh, Problem, Solution, SolverOptions
    from solver.nonlinear.events import Listener
    from solver.nonlinear.newton import Newton

ROUGH = 1e-3
"""Newton tolerance on meshes that are only a step to the next, in units of the body's diagonal."""


def begun(
    subject: Subject,
    model: AnalysisModel[Subject],
    reason: str,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    keep: bool = False,
) -> Computation[Subject]:
    """``subject`` before its first mesh: the body is built.

    Args:
        subject: What is computed, under its whole load.
        model: The body that stands for it.
        reason: Why this model; goes into the result.
        pressures: Further pressures to stop at, MPa.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take.
        keep: Keep what the solve on the finest of the model's meshes leaves.

    Returns:
        A computation without solutions, which ``refined`` adds.

    Raises:
        GeometryError: The CAD kernel cannot build the body.
    """
    from solver.meshing import process as meshing_process

    meshing_process.start()  # loads Gmsh while the solid is built
    progress.stage(f"geometry of the {model.name}")
    start = time.perf_counter()
    body = Body(subject, model)
    _ = body.solid  # now, so that its time is counted
    spent = Seconds(geometry=time.perf_counter() - start)
    asked = tuple(sorted(pressures))
    return Computation(subject, model, reason, body, asked, budget, seconds=spent, keep=keep)


def started(
    design: Design,
    model: AnalysisModel,
    reason: str,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    meshes: int = 1,
    keep: bool = False,
) -> Computation:
    """``design`` on the coarsest mesh of ``model``, with the ends if that is the unit cell.

    The ends are solved beside the cell where the machine has a processor for them. What is found
    does not depend on that, nor on which is ready first.

    Args:
        design: What is computed, at its design pressure.
        model: The body that stands for it.
        reason: Why this model; goes into the result.
        pressures: Further pressures to stop at, MPa.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take.
        meshes: So many meshes, from coarse to fine, where the budget and the solutions allow it.
        keep: Keep what the solve on the finest of the model's meshes leaves.

    Returns:
        The first solutions; ``refined`` adds those on finer meshes.

    Raises:
        GeometryError: The CAD kernel cannot build the body.
        DesignError: The mesh would exceed the budget.
        MeshingError: No usable mesh, or none in time.

    Examples:
        >>> from bellows_design import load_design
        >>> from bellows_design.analysis.models import choose
        >>> from bellows_design.evaluation import started
        >>> design = load_design("prototype_1")
        >>> first = started(design, *choose(design))
        >>> print(first.model.name, len(first.solved), "mesh")
        unit-cell 1 mesh
    """
    from solver.linear.threads import may_run_side_by_side, one_thread
    from solver.meshing import process as meshing_process

    meshing_process.start()  # loads Gmsh while the solid is built
    asked = tuple(sorted(pressures))

    def short_actuator(shown: Progress) -> Ends:
        return _short_actuator(design, asked, budget, shown)

    at_once = model is UNIT_CELL and may_run_side_by_side()
    with beside(one_thread()(short_actuator) if at_once else short_actuator, at_once) as ends:
        blank = begun(design, model, reason, asked, progress, budget, keep)
        first = _refined_beside(ends, blank, progress)
        if model is UNIT_CELL and first.converged:
            return _with_ends(first, meshes, ends, progress)
    return refined_to(meshes, first, progress)


def refined(
    computation: Computation[Subject],
    progress: Progress = SILENCE,
    plan: PlannedMesh | None = None,
) -> Computation[Subject]:
    """The same computation on one finer mesh, started from the finest solution.

    Args:
        computation: What was solved so far.
        progress: Listens to stages and load.
        plan: The mesh to solve on, where it is at hand; else it is planned here.

    Returns:
        A computation with one mesh more; with none more where the time of the budget ended first.

    Raises:
        DesignError: The mesh would exceed the computation's budget.
        MeshingError: No usable mesh, or none in time.

    Examples:
        >>> from bellows_design import load_design
        >>> from bellows_design.analysis.models import choose
        >>> from bellows_design.evaluation import refined, started
        >>> design = load_design("prototype_1")
        >>> coarse = started(design, *choose(design))
        >>> fine = refined(coarse)
        >>> print(len(fine.finest.problem.mesh.tets) > len(coarse.finest.problem.mesh.tets))
        True
    """
    from solver import peak_von_mises

    number = len(computation.solved) + 1
    progress.stage(f"mesh {number}")
    began = time.perf_counter()
    mesh = (plan or next_plan(computation)).made(computation.budget)
    meshed = time.perf_counter()
    progress.stage(f"solve {number}, {len(mesh.tets)} tetrahedra")
    left: list[Newton] = []
    solution = _solved_on(mesh, computation, progress, left.append)
    spent = Seconds(mesh=meshed - began, solve=time.perf_counter() - meshed)
    if solution.stopped_by == "budget" and computation.solved and computation.converged:
        return replace(computation, seconds=computation.seconds + spent, out_of_time=True)
    return replace(
        computation,
        solved=(*computation.solved, SolvedMesh(solution, peak_von_mises(solution))),
        seconds=computation.seconds + spent,
        workspace=left[0] if left else None,
    )


def next_plan(computation: Computation[Subject]) -> PlannedMesh:
    """The mesh after the finest, whatever it takes."""
    from bellows_design.analysis.mesh_plan import coarsest_plan, finer_plan

    solid, model = computation.body.solid, computation.model
    wall = model.wall(computation.design)
    if not computation.solved:
        return coarsest_plan(solid, wall)
    return finer_plan(solid, wall, computation.finest, model.refinement)


def affordable_plan(computation: Computation[Subject]) -> PlannedMesh | None:
    """The mesh after the finest; None without a solution to refine, or beyond the budget."""
    if not computation.converged or lacks_time(computation):
        return None
    plan = next_plan(computation)
    return plan if plan.fits(computation.budget) else None


def lacks_time(computation: Computation[Subject]) -> bool:
    """Whether a solve on the next mesh would take longer than is left of the budget."""
    return _next_seconds(computation) > computation.seconds_left


def _next_seconds(computation: Computation[Subject]) -> float:
    """Time that a solve on the next mesh will take, s, from that on the finest."""
    finest = computation.finest
    each = finest.seconds / max(1, finest.factorizations)
    model = computation.model
    count = finest.factorizations if model.from_rest else FACTORIZATIONS
    return count * each * model.growth**SOLVE_ORDER


FACTORIZATIONS = 8
"""Of a solve that starts at the whole load from a coarser mesh, on a hard case."""

SOLVE_ORDER = 1.5
"""Growth of a factorization's time with the number of elements."""


def _solved_on(
    mesh: Mesh,
    computation: Computation[Subject],
    progress: Progress,
    keep: Callable[[Newton], None],
) -> Solution:
    """Solve on the next mesh; only the last of the model's meshes needs the full tolerance.

    What that solve leaves is given to ``keep``, if the computation asks for it.
    """
    from solver import SolverOptions, transfer

    design, model, level = computation.design, computation.model, len(computation.solved)
    initial = transfer(computation.finest, mesh) if level else None
    only_a_step = level + 1 < model.levels
    tolerance = ROUGH if only_a_step else SolverOptions.tolerance
    options = _options(computation, tolerance)
    stops = () if level and only_a_step else computation.pressures
    kept = keep if computation.keep and not only_a_step else None
    how = Solving(options, _listener(progress), initial, stops, kept)
    return model.solve(design, model.problem(design, mesh), how)


@dataclass(frozen=True)
class Ends:
    """The solution of a short actuator, and the time each of its stages took."""

    solution: Solution
    seconds: Seconds


def _with_ends(
    first: Computation, meshes: int, ends: Beside[Ends], progress: Progress
) -> Computation:
    """With the solution of a short actuator, on the mesh size of the coarsest cell.

    While that is not ready, the cell goes on to finer meshes, which do not count where the ends do
    not reach the load. Where inner walls touch that a short actuator does not keep apart, in the
    cell or in the short actuator, the cell without its neighbours stands for the ends, without the
    stubs of root and tip.
    """
    from bellows_design.analysis.wall_contact import image_gap
    from bellows_design.geometry.face_names import CAVITY

    (inner,) = image_gap(first.finest, CAVITY)
    if inner is not None and inner <= 0:
        ends.abandon()
        return refined_to(meshes, _with_free_ends(first, progress), progress)
    finer = first
    while ends.running and len(finer.solved) < meshes and (plan := affordable_plan(finer)):
        finer = _refined_beside(ends, finer, progress, plan)
    progress.stage("ends: an actuator of one bubble")
    found, waited = ends.result(progress)
    spent = Seconds(solve=waited) if ends.begun else found.seconds
    with_ends = _having(first, found.solution, spent)
    if _stopped_inside(with_ends):
        with_ends = _with_free_ends(replace(with_ends, ends=None, ends_peak=None), progress)
    if with_ends.converged:
        more = finer.seconds - first.seconds
        with_ends = replace(
            with_ends,
            solved=finer.solved,
            seconds=with_ends.seconds + more,
            out_of_time=with_ends.out_of_time or finer.out_of_time,
            workspace=finer.workspace,
        )
    return refined_to(meshes, with_ends, progress)


def refined_to(
    meshes: int, computation: Computation[Subject], progress: Progress = SILENCE
) -> Computation[Subject]:
    """The computation on so many meshes, as far as they can be afforded."""
    while len(computation.solved) < meshes and (plan := affordable_plan(computation)):
        before = len(computation.solved)
        computation = refined(computation, progress, plan)
        if len(computation.solved) == before:  # the time ended
            break
    return computation


def refined_until(
    enough: Callable[[Computation[Subject]], bool],
    computation: Computation[Subject],
    progress: Progress = SILENCE,
) -> Computation[Subject]:
    """The computation on finer and finer meshes until it is ``enough``, or none is affordable."""
    while not enough(computation):
        plan = affordable_plan(computation)
        if plan is None:
            late = computation.converged and lacks_time(computation)
            return replace(computation, out_of_time=computation.out_of_time or late)
        computation = refined(computation, progress, plan)
    return computation


def _refined_beside(
    ends: Beside[Ends],
    computation: Computation,
    progress: Progress,
    plan: PlannedMesh | None = None,
) -> Computation:
    """``refined``, on one processor while the ends take the other."""
    if not ends.running:
        return refined(computation, progress, plan)
    from solver.linear.threads import one_thread

    with one_thread():
        return refined(computation, progress, plan)


def _stopped_inside(computation: Computation) -> bool:
    """Whether the short actuator stopped where its inner walls touch."""
    from bellows_design.analysis.wall_contact import stopped_inside

    ends = computation.ends
    if ends is None or ends.stopped_by != "guard":
        return False
    return stopped_inside(shortened(computation.design).bellows, ends)


def _short_actuator(
    design: Design, pressures: tuple[float, ...], budget: Budget, progress: Progress
) -> Ends:
    """Solve for an actuator of one bubble."""
    from bellows_design.analysis.mesh_plan import first_plan

    began = time.perf_counter()
    short = shortened(design)
    body = Body(short, HALF)
    solid = body.solid
    built = time.perf_counter()
    progress.stage("ends: mesh")
    mesh = first_plan(solid, short).made(budget)
    meshed = time.perf_counter()
    progress.stage("ends: an actuator of one bubble")
    blank = Computation(short, HALF, "", body, pressures, budget)
    solution = _solved_roughly(short, HALF.problem(short, mesh), blank, progress)
    return Ends(solution, Seconds(built - began, meshed - built, time.perf_counter() - meshed))


def _with_free_ends(computation: Computation, progress: Progress) -> Computation:
    """With the solution of a bubble without neighbours, on the coarsest cell's mesh."""
    progress.stage("ends: a bubble without neighbours")
    began, design = time.perf_counter(), computation.design
    problem = FREE_CELL.problem(design, computation.solutions[0].problem.mesh)
    ends = _solved_roughly(design, problem, computation, progress)
    spent = Seconds(solve=time.perf_counter() - began)
    return _having(computation, ends, spent)


def _having(computation: Computation, ends: Solution, spent: Seconds) -> Computation:
    """The computation with a solution of its ends, which took that long."""
    from solver import peak_von_mises

    seconds = computation.seconds + spent
    return replace(computation, ends=ends, ends_peak=peak_von_mises(ends), seconds=seconds)


def _options(computation: Computation[Subject], tolerance: float) -> SolverOptions:
    """For one more solve in the time that is left; at least a second, to end in good order."""
    from solver import SolverOptions

    return SolverOptions(tolerance=tolerance, seconds=max(1.0, computation.seconds_left))


def _solved_roughly(
    design: Design, problem: Problem, computation: Computation, progress: Progress
) -> Solution:
    """Solve for the ends: what they add is small."""
    options = _options(computation, ROUGH)
    how = Solving(options, _listener(progress), stops=computation.pressures)
    return HALF.solve(design, problem, how)


def _listener(progress: Progress) -> Listener:
    """Tells ``progress`` the load that is tried or reached."""

    def report(event: Event) -> None:
        progress.load(event.load, event.rotation, event.spent)

    return report
