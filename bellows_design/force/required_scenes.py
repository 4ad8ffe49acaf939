"""The scenes that approval must hold, evaluated at the design pressure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.design.scenes.scene import named_scene
from bellows_design.errors import BellowsError
from bellows_design.force.curve import force_curve
from bellows_design.force.result import SceneResult
from bellows_design.progress import SILENCE, Progress

if TYPE_CHECKING:
    from bellows_design.store.store import Store


def required_scenes(
    design: Design,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
) -> tuple[SceneResult, ...]:
    """Results of ``design.limits.scenes``, in their order; a scene that cannot be says why."""
    return tuple(_result(design, name, progress, budget, store) for name in design.limits.scenes)


def _result(
    design: Design, name: str, progress: Progress, budget: Budget, store: Store | None
) -> SceneResult:
    from solver.errors import MeshingError, SolverError

    progress.stage(f"scene {name}")
    _, scene = named_scene(name, design.scenes)
    try:
        found = force_curve(
            design,
            scene,
            (design.load.pressure,),
            name=name,
            by_distance=False,
            progress=progress,
            budget=budget,
            store=store,
        )
    except (BellowsError, SolverError, MeshingError) as error:
        return SceneResult(name, failure=str(error))
    return SceneResult(name, found)
