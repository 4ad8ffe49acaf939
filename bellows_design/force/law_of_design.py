"""The law of a design's unit cell, as far as a scene needs it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.cell_facts import CellFacts
from bellows_design.force.finger_law import FingerLaw
from bellows_design.force.law.cell_law import CellLaw, cell_law
from bellows_design.force.scene.solved import Solved
from bellows_design.progress import Progress

if TYPE_CHECKING:
    from bellows_design.store.store import Store


def solved_with_its_law(
    design: Design,
    scene: Scene,
    pressures: Sequence[float],
    progress: Progress,
    budget: Budget,
    store: Store | None,
) -> Solved:
    """The path of a finger that follows its unit cell's law.

    Raises:
        BellowsError, MeshingError: As ``cell_law``.
    """
    law = cell_law(design, progress=progress, budget=budget, store=store)
    progress.stage("chain")
    return Solved.of(design, scene, pressures, finger_law(law))


def finger_law(law: CellLaw) -> FingerLaw:
    """A finger's law from its cell's."""
    return FingerLaw(
        piece=law,
        outer=law.without_contact,
        root_hinge=law.end,
        tip_hinge=law.end,
        facts=CellFacts(law),
        from_cache=law.from_cache,
        seconds=law.effort.seconds,
    )
