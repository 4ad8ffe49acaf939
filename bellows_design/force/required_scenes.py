"""The scenes that approval must hold, evaluated at the design pressure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.design.scenes.scene import named_scene
from bellows_design.errors import BellowsError
from bellows_design.force.curve import force_curve
from bellows_design.force.law.cell_law import CellLaw, cell_law
from bellows_design.force.result import SceneResult
from bellows_design.progress import SILENCE, Progress
from solver.errors import MeshingError, SolverError

if TYPE_CHECKING:
    from bellows_design.store.store import Store

FAILURES = (BellowsError, SolverError, MeshingError)
"""Why a scene may have no result."""


def required_scenes(
    design: Design,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
    law: CellLaw | None = None,
) -> tuple[SceneResult, ...]:
    """Results of ``design.limits.scenes``, in their order; a scene that cannot be says why.

    All of them by one law of the unit cell: ``law``, or the design's.
    """
    names = design.limits.scenes
    if not names:
        return ()
    try:
        found = law or cell_law(design, progress=progress, budget=budget, store=store)
    except FAILURES as error:
        return tuple(SceneResult(name, failure=str(error)) for name in names)
    return tuple(_result(design, name, found, progress, budget, store) for name in names)


def _result(
    design: Design,
    name: str,
    law: CellLaw,
    progress: Progress,
    budget: Budget,
    store: Store | None,
) -> SceneResult:
    progress.stage(f"scene {name}")
    _, scene = named_scene(name, design.scenes)
    try:
        found = force_curve(
            design,
            scene,
            (design.load.pressure,),
            law,
            name=name,
            by_distance=False,
            progress=progress,
            budget=budget,
            store=store,
        )
    except FAILURES as error:
        return SceneResult(name, failure=str(error))
    return SceneResult(name, found)
