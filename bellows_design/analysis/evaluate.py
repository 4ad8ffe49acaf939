"""From a design under pressure to its evaluation: the solutions first, then what they say."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import astuple
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.error_estimate import error_estimate, least_estimate
from bellows_design.analysis.evaluation import (
    Evaluation,
    LoadedState,
    MeshReading,
    MeshSize,
    SolverEffort,
)
from bellows_design.analysis.mesh_sequence import affordable_plan, refined, refined_until, started
from bellows_design.analysis.models import UNIT_CELL, choose
from bellows_design.analysis.whole_actuator import (
    curve_readings,
    ends_factor,
    final_readings,
    folded_elements,
    highest_stress,
    path_readings,
    reading,
)
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.analysis.wall_contact import WallContact
    from solver import Solution


def evaluate(
    design: Design,
    model: str = "auto",
    accuracy_percent: float | None = None,
    pressures: Sequence[float] = (),
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    open_question: Callable[[LoadedState], str] = lambda _: "",
    keep: bool = False,
) -> Evaluation:
    """Evaluate ``design`` at its design pressure, and at ``pressures`` between 0 and that.

    Args:
        design: What is evaluated.
        model: ``auto`` (the smallest that answers), ``unit-cell``, ``half`` or ``full``.
        accuracy_percent: Refine the mesh until both error estimates are this small, percent.
        pressures: Further pressures of the curve, MPa.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that a mesh may take. Refinement ends before a mesh that
            would exceed it; the error estimates then say what was reached.
        open_question: Asked with the state on the finest mesh what its error estimates leave open,
            as text; empty if nothing. The mesh is refined further for it, within the budget, and
            as long as refinement promises an answer.
        keep: Keep the factors of the finest mesh's tangent with the result, for its sensitivities;
            about a hundred megabytes for five thousand tetrahedra.

    Returns:
        The evaluation; with ``converged`` False, of the last good state, where the load could not
        be reached.

    Raises:
        BellowsError: Unknown model, accuracy or pressures out of bounds, a geometry the CAD kernel
            refuses, or a first mesh that exceeds the budget.
        MeshingError: No usable mesh, or none in time.
    """
    _check(design, accuracy_percent, pressures)
    body, reason = choose(design, model)
    levels = body.levels - 1
    computation = started(design, body, reason, pressures, progress, budget, levels, keep)

    def enough(computation: Computation) -> bool:
        return _enough(computation, accuracy_percent)

    computation = refined_until(enough, computation, progress)
    return answered(evaluation_of(computation), open_question, progress)


def finer(found: Evaluation, question: str, progress: Progress) -> Evaluation | None:
    """The same on one more mesh, because of ``question``; None if the budget has none for it.

    Raises ``MeshingError``.
    """
    plan = affordable_plan(found.computation)
    if plan is None:
        return None
    progress.stage(f"a finer mesh, because {question}")
    return evaluation_of(refined(found.computation, progress, plan))


def answered(
    found: Evaluation,
    open_question: Callable[[LoadedState], str],
    progress: Progress = SILENCE,
    finer: Callable[[Evaluation, str, Progress], Evaluation | None] = finer,
) -> Evaluation:
    """The evaluation once its error estimates answer the question, or refinement does not help.

    ``finer`` gives the same on one more mesh, or None.
    """
    estimates: list[float | None] = []
    while question := open_question(found):
        estimates.append(found.error_estimate.max_von_mises_percent)
        next_one = finer(found, question, progress) if _promising(estimates) else None
        if next_one is None:
            break
        found = next_one
    return found


MOST_FINER_MESHES = 4
"""For one question. Each takes about twice as long as the one before."""

STALLED = 0.9
"""Ratio of two successive error estimates from which on a further mesh promises nothing."""


def _promising(estimates: Sequence[float | None]) -> bool:
    """Whether a further mesh may answer, by the error estimates (%) on the meshes so far."""
    known = [estimate for estimate in estimates if estimate is not None]
    if len(estimates) > MOST_FINER_MESHES or len(known) < len(estimates):
        return False
    return len(known) < 3 or known[-1] < STALLED * max(known[-3:-1])


def evaluation_of(computation: Computation) -> Evaluation:
    """The record of a computation.

    Examples:
        >>> from bellows_design import load_design
        >>> from bellows_design.analysis.models import choose
        >>> from bellows_design.evaluation import evaluation_of, started
        >>> design = load_design("prototype_1")
        >>> first = started(design, *choose(design))
        >>> print(f"{evaluation_of(first).bending_angle_deg:.2g} degrees on the coarsest mesh")
        2.2e+02 degrees on the coarsest mesh
    """
    return Evaluation(
        **vars(loaded_state(computation)),
        design=computation.design,
        model=computation.model,
        reason=computation.reason,
        meshes=_mesh_readings(computation),
        solver=effort(computation.all_solutions),
        seconds=computation.seconds,
        path=path_readings(computation),
        curve=curve_readings(computation),
        computation=computation,
    )


def loaded_state(computation: Computation) -> LoadedState:
    """The whole actuator at the pressure that was reached, on the finest mesh."""
    finest = computation.finest
    whole, (stress, place) = reading(computation, finest.path[-1]), highest_stress(computation)
    return LoadedState(
        converged=computation.converged,
        message=computation.message,
        stable=computation.stable,
        pressure_mpa=computation.pressure_mpa,
        limit_pressure_mpa=computation.limit_pressure_mpa,
        touch_pressure_mpa=computation.touch_pressure_mpa,
        bending_angle_deg=whole.bending_angle_deg,
        max_von_mises_mpa=stress,
        max_von_mises_position_mm=place,
        cavity_volume_mm3=whole.cavity_volume_mm3,
        error_estimate=error_estimate(computation),
        strain=_reached_strain(computation),
        contact=_contact(computation),
        folded=folded_elements(computation),
    )


def _reached_strain(computation: Computation) -> ReachedStrain:
    """The extreme strains; with those of the ends where these are stressed more."""
    from bellows_design.analysis.material_range import reached_strain

    material = computation.design.material
    strain = reached_strain(material, computation.finest)
    if ends_factor(computation) == 1.0 or computation.ends is None:
        return strain
    return strain.joined(reached_strain(material, computation.ends))


def mesh_size(solution: Solution) -> MeshSize:
    """Size of the mesh of a solution, and of the system that was solved on it."""
    from solver.problem.unknowns import number_unknowns

    problem = solution.problem
    unknowns = number_unknowns(problem.mesh, problem.supports, problem.moving_plane).size
    return MeshSize(len(problem.mesh.tets), len(problem.mesh.nodes), unknowns)


class Computed(Protocol):
    """An evaluation of anything: it has its solutions."""

    @property
    def computation(self) -> Computation[Any]:
        """The solutions."""


def write_vtu(evaluation: Computed, path: Path | str) -> None:
    """Write the finest solution for ParaView, completely or not at all.

    Displacement is in mm, von Mises stress and hydrostatic pressure in MPa.

    Args:
        evaluation: What ``evaluate`` found, of a design or a body of one's own.
        path: Of the file, ending in ``.vtu``; one that is there is replaced.

    Raises:
        SolverError: A path with another ending.
        OSError: The file cannot be written.

    Examples:
        >>> from pathlib import Path
        >>> from bellows_design import evaluate, load_design
        >>> from bellows_design.evaluation import write_vtu
        >>> write_vtu(evaluate(load_design("prototype_1")), "cell.vtu")  # for ParaView
        >>> print(Path("cell.vtu").stat().st_size > 1000)
        True
    """
    from bellows_design.files.atomic import replacing
    from solver import write_vtu as write

    with replacing(Path(path)) as temporary:
        write(temporary, evaluation.computation.finest)


def _check(design: Design, accuracy_percent: float | None, pressures: Sequence[float]) -> None:
    check_accuracy(accuracy_percent)
    check_pressures(pressures, design.load.pressure)


def check_accuracy(accuracy_percent: float | None) -> None:
    """Raise ``DesignError`` for an accuracy, percent, that no evaluation is asked for."""
    if accuracy_percent is not None and not 0.01 <= accuracy_percent <= 100:
        raise DesignError(f"accuracy = {accuracy_percent:g} % must lie between 0.01 and 100 %.")


def check_pressures(pressures: Sequence[float], highest: float) -> None:
    """Raise ``DesignError`` unless all lie between 0 and the ``highest``, MPa."""
    for pressure in pressures:
        if not 0 < pressure / highest <= 1 + 1e-12:
            raise DesignError(
                f"pressure = {pressure:g} MPa must lie between 0, excluded, and the design's "
                f"{highest:g} MPa."
            )


def _enough(computation: Computation, accuracy_percent: float | None) -> bool:
    """True if there are the model's meshes, and both estimates keep the accuracy asked for."""
    if len(computation.solved) < computation.model.levels:
        return False
    if accuracy_percent is None:
        return True
    estimates, least = error_estimate(computation), least_estimate(computation)
    return accurate(astuple(estimates), astuple(least), accuracy_percent)


def accurate(
    estimates: Sequence[float | None], least: Sequence[float], accuracy_percent: float
) -> bool:
    """Whether all estimates, percent, keep the accuracy asked for.

    Where no mesh can, because of the ends for instance, they need only come near the least ones.
    """
    return all(
        error is not None
        and (error <= accuracy_percent or (accuracy_percent < bound and error <= NEAR * bound))
        for error, bound in zip(estimates, least, strict=True)
    )


NEAR = 1.25
"""Ratio of an estimate to its least value from which on a finer mesh is not worth its time."""


def _contact(computation: Computation) -> WallContact:
    from bellows_design.analysis.wall_contact import contact_in_cell, contact_of

    bellows, solution = computation.design.bellows, computation.finest
    if computation.model is UNIT_CELL:
        return contact_in_cell(bellows, solution)
    problem = solution.problem
    return contact_of(bellows, problem.mesh, solution.displacement, problem)


def _mesh_readings(computation: Computation) -> tuple[MeshReading, ...]:
    sizes = (mesh_size(solution) for solution in computation.solutions)
    pairs = zip(sizes, final_readings(computation), strict=True)
    return tuple(MeshReading(size, whole) for size, whole in pairs)


def effort(solutions: Sequence[Solution]) -> SolverEffort:
    """What solves took together."""
    return SolverEffort(
        load_steps=sum(solution.load_steps for solution in solutions),
        newton_iterations=sum(solution.newton_iterations for solution in solutions),
        factorizations=sum(solution.factorizations for solution in solutions),
        linear_solver=solutions[-1].linear_solver,
    )
