"""Angle and stress soon after the sliders rest: by continuation from what was evaluated before.

Where nothing evaluated before has the same faces, the unit cell is solved on its coarsest mesh.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING, Any

from bellows_design.analysis.models import UNIT_CELL
from bellows_design.deformed import deformed_surface
from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.studio.choices.changed import changed, design_of_text
from bellows_design.studio.previews.coarse import coarse
from bellows_design.studio.previews.continuation import Anchors
from bellows_design.studio.tasks.answers import PREVIEW, REFINED, answer_of
from bellows_design.studio.tasks.looks import deformed
from bellows_design.studio.tasks.places import kept_evaluation, solving, store_at
from bellows_design.studio.workers.reporting import Report
from solver.errors import SolverError

if TYPE_CHECKING:
    from collections.abc import Callable

    from bellows_design.analysis.evaluation import Evaluation, LoadedState
    from bellows_design.deformed import SurfaceFrames
    from solver import Mesh

    Values = dict[str, Any]
    Task = Callable[[Values, Values, Report], None]


def tasks() -> dict[str, Task]:
    """By their names."""
    anchors = Anchors()
    return {
        "preview": lambda values, _, report: _told(_preview, anchors, values, report),
        "anchor": lambda values, arrays, report: _anchor(anchors, values, arrays, report),
        "warm": lambda _, __, ___: _warm(),
    }


def _warm() -> None:
    """Load CAD and Gmsh, which a solve by itself needs, before one is asked for."""
    from solver.meshing import process

    process.start()
    import_module("bellows_design.geometry.actuator")


def _told(work: Callable[..., None], anchors: Anchors, values: Values, report: Report) -> None:
    with solving(report):
        work(anchors, values, report)


def _preview(anchors: Anchors, values: Values, report: Report) -> None:
    """The first answer for a design, and the finger's shape under pressure."""
    design = changed(design_of_text(values["base"]), values["values"])
    began = time.perf_counter()
    kept = kept_evaluation(store_at(values), design)
    if kept is not None:
        _answer(design, kept, REFINED, "kept from before", began, report)
        _look(lambda: deformed_surface(kept), REFINED, report)
        _take(anchors, kept, report)
        return
    found = anchors.continued(design, report)
    if found is not None:
        state, near = found.state, found.near
        _answer(design, state, PREVIEW, found.how, began, report)
        _look(lambda: near.surface(state), PREVIEW, report)
        return
    first = coarse(anchors, design, report)
    _answer(design, first.state, PREVIEW, first.how, began, report)
    _send_cell(design, first.mesh, report)
    _look(lambda: deformed_surface(first.state), PREVIEW, report)


def _answer(
    design: Design, found: LoadedState, state: str, how: str, began: float, report: Report
) -> None:
    report("answer", **answer_of(design, found, state, how, time.perf_counter() - began))


def _anchor(anchors: Anchors, values: Values, arrays: Values, report: Report) -> None:
    """Start from now on from the ordinary evaluation of a design, which another process found."""
    from bellows_design.store.records import evaluation_from

    design = changed(design_of_text(values["base"]), values["values"])
    with solving(report):
        _take(anchors, evaluation_from(values["record"], arrays, design), report)


def _take(anchors: Anchors, found: Evaluation, report: Report) -> None:
    if found.model is UNIT_CELL:
        _send_cell(found.design, found.computation.solutions[0].problem.mesh, report)
    anchors.add(found, report)


def _look(surface: Callable[[], SurfaceFrames], state: str, report: Report) -> None:
    """The deformed finger; the figures stand also without it."""
    try:
        report.shown("deformed", deformed(surface()), state=state)
    except (BellowsError, SolverError) as error:
        report("failed", what="deformed", message=str(error))


def _send_cell(design: Design, mesh: Mesh, report: Report) -> None:
    """The cell's mesh, for shapes at once."""
    arrays = {"nodes": mesh.nodes, "tets": mesh.tets, **dict(_surfaces(mesh))}
    report("cell", arrays, base=design.to_toml(), values={}, surfaces=list(mesh.surfaces))


def _surfaces(mesh: Mesh) -> Iterator[tuple[str, Any]]:
    for name, triangles in mesh.surfaces.items():
        yield f"surface {name}", triangles
