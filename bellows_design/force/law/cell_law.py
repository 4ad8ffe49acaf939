"""A design's law: what an evaluation knows of its unit cell, and the table on its coarsest mesh."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.error_estimate import error_estimate
from bellows_design.analysis.whole_actuator import ends_factor
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.errors import UnreachedError
from bellows_design.force.law.computation.building import Builder, aim_of
from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.computation.ends import end_pieces, ends_of
from bellows_design.force.law.computation.meshes import Correction
from bellows_design.force.law.computation.short_actuator import Sections
from bellows_design.force.law.ends import EndPiece
from bellows_design.force.law.errors import LawError, ends_error
from bellows_design.force.law.half_bubble import CellLaw, Effort
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw
from bellows_design.force.law.kept import find, keep_noted, key_of_law
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.analysis.computation import Computation
    from bellows_design.evaluation import Evaluation
    from bellows_design.store.store import Store

__all__ = ["CellLaw", "cell_law", "extended"]

TOLERANCE = 0.01
"""Of the interpolated rotation, relative to the free rotation at the design's pressure. By mesh
and ends Prototype 1 is less certain (`tests/benchmarks/cell_laws.json`)."""

FIRST_ROWS = (0.0, 0.25, 0.5, 1.0)
"""Pressures of the first rows, relative to the design's."""


def cell_law(
    design: Design,
    tolerance: float = TOLERANCE,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
) -> CellLaw:
    """The law of a design's half bubbles, from no pressure to the design's.

    Its table is computed on the coarsest mesh of an evaluation, and corrected by the finest one's
    rotation.

    Args:
        design: whose unit cell is solved.
        tolerance: of the interpolated rotation, relative to the free rotation at the design's
            pressure.
        progress: listens to stages.
        budget: of the evaluation; seconds also of the table, after which it is not refined.
        store: where evaluation and law are looked for, and kept; None for none.

    Raises:
        BellowsError: a geometry the CAD kernel refuses, a mesh beyond the budget, or a pressure
            that the cell does not reach.
        MeshingError: no usable mesh, or none in time.
    """
    key = key_of_law(design, tolerance, budget)
    kept = find(store, key, design)
    if kept is not None:
        return kept
    computation = _evaluated(design, progress, budget, store).computation
    law = _made(computation, tolerance, progress)
    if computation.in_time and law.error.complete:
        keep_noted(store, key, law, progress)
    return law


def extended(
    law: CellLaw,
    moments: tuple[float, float],
    pressures: tuple[float, float] | None = None,
    progress: Progress = SILENCE,
    seconds: float = DEFAULT.seconds,
) -> CellLaw:
    """The law with a table that goes further, as far as there are equilibria.

    Args:
        law: what there is.
        moments: up to which rows go at least, N mm.
        pressures: of the rows that do, MPa; all by default. A pressure beyond the table gets a row.
        progress: listens to stages.
        seconds: after which nothing more is refined.

    Raises:
        BellowsError: a pressure that the cell does not reach without a moment.
    """
    began, table = time.monotonic(), law.table
    low, high = pressures or (float(table.pressures[0]), float(table.pressures[-1]))
    cell = Continuation.of(law.design, law.mesh)
    aim = aim_of(law.free_rotation / law.tabulated.softening, law.tolerance)
    builder = Builder(cell, aim, note=progress.stage, deadline=began + seconds)
    builder.known = {row.pressure: row for row in table.rows}
    for pressure in sorted({low, high, *table.pressures.tolist()}):
        if low <= pressure <= high:
            builder.extend(_at(cell, pressure), moments)
    builder.refine()
    effort = Effort(
        law.effort.factorizations + cell.factorizations,
        law.effort.seconds + time.monotonic() - began,
    )
    error = replace(
        law.error,
        interpolation=max(law.error.interpolation, builder.worst),
        complete=law.error.complete and builder.complete,
    )
    tabulated = law.tabulated.on(builder.table)
    return replace(law, tabulated=tabulated, error=error, effort=effort, from_cache="")


def _at(cell: Continuation, pressure: float) -> Solved:
    """Without a moment. Raises ``BellowsError``."""
    found, reached = cell.from_zero((pressure,))
    if not found:
        raise UnreachedError(f"there is no law of the bubbles: {reached}")
    return found[0]


def _evaluated(
    design: Design, progress: Progress, budget: Budget, store: Store | None
) -> Evaluation:
    """The ordinary evaluation where that is by the unit cell."""
    from bellows_design.analysis.model_names import ModelName
    from bellows_design.analysis.models import UNIT_CELL, choose
    from bellows_design.store import evaluated

    usual = choose(design)[0] is UNIT_CELL
    model = "auto" if usual else ModelName.UNIT_CELL.value
    found = evaluated(design, model, progress=progress, budget=budget, store=store)
    if not found.converged:
        raise UnreachedError(f"there is no law of the bubbles: {found.message}")
    return found


def _made(computation: Computation, tolerance: float, progress: Progress) -> CellLaw:
    """The law, from an evaluation of the unit cell that converged."""
    began, design = time.monotonic(), computation.design
    mesh = computation.solutions[0].problem.mesh
    cell = Continuation.of(design, mesh)
    free = _free(cell, design.load.pressure)
    builder = _begun(cell, free, tolerance, progress, began + computation.budget.seconds)
    row, corrections = builder.rows[free[-1].point.pressure].row, list[Correction]()
    progress.stage("section's law: between pressures, and on a finer mesh")
    builder.refine(beside=[lambda: corrections.append(Correction.of(computation, row))])
    (correction,) = corrections
    progress.stage("section's law: ends")
    on_mesh = TabulatedLaw(
        design.bellows.pitch / 2, builder.table, volume_at_rest=free[0].point.volume
    )
    on_mesh = replace(on_mesh, shear_compliance=cell.shear_compliance(free[-1]))
    root, tip = _ends(computation, on_mesh, free, correction.softening)
    corrected = replace(on_mesh, softening=correction.softening)
    return CellLaw(
        design=design,
        tabulated=corrected,
        root=root,
        tip=tip,
        free_rotation=correction.softening * free[-1].point.rotation,
        tolerance=tolerance,
        stress_factor=correction.stress_factor * ends_factor(computation),
        error=_error(computation, builder, correction, (root, tip)),
        mesh=mesh,
        effort=Effort(cell.factorizations, time.monotonic() - began),
    )


def _begun(
    cell: Continuation, free: list[Solved], tolerance: float, progress: Progress, deadline: float
) -> Builder:
    """The first rows."""
    aim = aim_of(free[-1].point.rotation, tolerance)
    builder = Builder(cell, aim, note=progress.stage, deadline=deadline)
    builder.start(free)
    return builder


def _ends(
    computation: Computation, law: TabulatedLaw, free: list[Solved], softening: float
) -> tuple[EndPiece, EndPiece]:
    """Both ends, on a mesh of the size of the law's; that is too stiff for them as for a cell."""
    from bellows_design.analysis.models import shortened

    assert computation.ends is not None  # an evaluation by the unit cell has them
    short = computation.ends.problem
    with_stubs = short.moving_plane is None
    bellows = shortened(computation.design).bellows
    sections = Sections.of(short.mesh, bellows) if with_stubs else None
    pressures = [each.point.pressure for each in free]
    pieces = end_pieces(ends_of(short, sections), law, pressures)
    both = sum(_turn(piece, free[-1].point.pressure) for piece in pieces)
    factor = 1 + (softening - 1) * 2 * free[-1].point.rotation / both
    root, tip = (replace(piece, softening=factor) for piece in pieces)
    return root, tip


def _turn(piece: EndPiece, pressure: float) -> float:
    """Without section loads, rad."""
    return float(piece.response(pressure, np.zeros((1, 3))).motion[0, 0])


def _error(
    computation: Computation,
    builder: Builder,
    correction: Correction,
    ends: tuple[EndPiece, EndPiece],
) -> LawError:
    assert computation.ends is not None
    pressure = computation.design.load.pressure
    free = correction.softening * builder.rows[pressure].nearest(0.0).point.rotation
    added = sum(_turn(piece, pressure) for piece in ends) / 2 - free
    with_stubs = computation.ends.problem.moving_plane is None
    return LawError(
        interpolation=builder.worst,
        mesh=correction.error,
        ends=ends_error(added, free, with_stubs),
        stress_percent=error_estimate(computation).max_von_mises_percent,
        complete=builder.complete,
    )


def _free(cell: Continuation, pressure: float) -> list[Solved]:
    """Without a moment, at the pressures of the first rows. Raises ``BellowsError``."""
    at_rest, _ = cell.from_zero((0.0,))
    loaded, reached = cell.from_zero(tuple(share * pressure for share in FIRST_ROWS[1:]))
    if len(loaded) + 1 < len(FIRST_ROWS):
        raise UnreachedError(f"there is no law of the bubbles: {reached}")
    return [*at_rest, *loaded]
