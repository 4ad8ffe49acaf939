"""The law of a design's unit cell, as far as a scene needs it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.cell_facts import CellFacts
from bellows_design.force.chain.state import ChainState
from bellows_design.force.finger_law import FingerLaw
from bellows_design.force.law.cell_law import TOLERANCE, CellLaw, cell_law, extended
from bellows_design.force.law.kept import find, keep_noted, key_of_extension, key_of_law
from bellows_design.force.scene.solved import Solved
from bellows_design.progress import Progress

if TYPE_CHECKING:
    from bellows_design.store.key import Key
    from bellows_design.store.store import Store

MOST_EXTENSIONS = 2
"""Of a law's table, for one scene: each may lead the chain to other moments."""

UNFINISHED = (
    "the time was over before the law's table was as fine as asked for: the error of its "
    "interpolation may be larger than stated (--seconds gives it more)."
)

FURTHER = 1.15
"""Times the moments that were met: so far a table is extended."""


def solved_with_its_law(
    design: Design,
    scene: Scene,
    pressures: Sequence[float],
    progress: Progress,
    budget: Budget,
    store: Store | None,
    law: CellLaw | None = None,
) -> Solved:
    """The path of a finger that follows its unit cell's law, extended as far as it is needed.

    ``law`` is that law where it is at hand.

    Raises:
        BellowsError, MeshingError: As ``cell_law``.
    """
    if law is None:
        law = cell_law(design, progress=progress, budget=budget, store=store)
    key = key_of_law(design, TOLERANCE, budget)
    progress.stage("chain")
    solved = Solved.of(design, scene, pressures, finger_law(law))
    for _ in range(MOST_EXTENSIONS):
        beyond = solved.beyond
        if not beyond:
            break
        law, key = _extended(law, key, beyond, progress, budget, store)
        progress.stage("chain")
        solved = Solved.of(design, scene, pressures, finger_law(law))
    return solved


def _extended(
    law: CellLaw,
    key: Key,
    beyond: Sequence[ChainState],
    progress: Progress,
    budget: Budget,
    store: Store | None,
) -> tuple[CellLaw, Key]:
    """The law of ``key`` as far as the states ``beyond`` it need it, and the key of that.

    It is kept where the law is kept that it extends: not where the time was over.
    """
    moments, pressures = _moments(law, beyond), _pressures(beyond)
    further = key_of_extension(key, moments, pressures)
    kept = find(store, further, law.design) if store is not None else None
    if kept is not None:
        return kept, further
    found = extended(law, moments, pressures, progress, budget.seconds)
    if store is not None and found.error.complete and find(store, key, law.design) is not None:
        keep_noted(store, further, found, progress)
    return found, further


def _moments(law: CellLaw, states: Sequence[ChainState]) -> tuple[float, float]:
    """Least and greatest moment of ``states`` by which the table goes, and some more, N mm."""
    moments = law.moments(np.concatenate([state.loads for state in states]))
    return FURTHER * min(float(moments.min()), 0.0), FURTHER * max(float(moments.max()), 0.0)


def _pressures(states: Sequence[ChainState]) -> tuple[float, float]:
    """Least and greatest pressure of ``states``, MPa."""
    pressures = [state.pressure for state in states]
    return min(pressures), max(pressures)


def finger_law(law: CellLaw) -> FingerLaw:
    """A finger's law from its cell's."""
    return FingerLaw(
        piece=law,
        root=law.root,
        tip=law.tip,
        facts=CellFacts(law),
        warnings=() if law.error.complete else (UNFINISHED,),
        complete=law.error.complete,
        from_cache=law.from_cache,
        seconds=law.effort.seconds,
    )
