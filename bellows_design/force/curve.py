"""Force against pressure, and against distance, of a finger in a scene."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.scene import Scene
from bellows_design.errors import DesignError
from bellows_design.force.air import FLOW, Air, air_of_stroke
from bellows_design.force.chain.path import Path
from bellows_design.force.chain.state import ChainState
from bellows_design.force.finger_law import FingerLaw
from bellows_design.force.law.half_bubble import CellLaw
from bellows_design.force.law_of_design import solved_with_its_law
from bellows_design.force.result import ForceCurve, Seconds
from bellows_design.force.scene.distances import Distances, moved_away
from bellows_design.force.scene.exerted import force_of
from bellows_design.force.scene.readings import Readings
from bellows_design.force.scene.solved import Solved
from bellows_design.progress import SILENCE, Progress
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    from bellows_design.store.store import Store


def force_curve(
    design: Design,
    scene: Scene,
    pressures: Sequence[float],
    law: FingerLaw | CellLaw | None = None,
    *,
    name: str = "",
    flow: float = FLOW,
    by_distance: bool = True,
    progress: Progress = SILENCE,
    budget: Budget = DEFAULT,
    store: Store | None = None,
) -> ForceCurve:
    """What ``design`` exerts in ``scene`` at ``pressures``.

    Args:
        design: The finger.
        scene: What stands around it.
        pressures: Away from zero and of one sign, MPa; the last is the highest.
        law: Of the finger, or of its unit cell, which is extended where that is needed; None for
            the latter, computed or from ``store``.
        name: Of the scene; without it its kind.
        flow: Of free air through the valve, L/min; positive.
        by_distance: Whether load cell or wall is moved away at the last pressure.
        progress: Listens to stages and load.
        budget: Memory (GiB) and seconds that the law may take.
        store: Where laws are looked for and kept; None for none.

    Returns:
        Readings as far as there are equilibria; the last good one where they end.

    Raises:
        DesignError: Pressures or flow are not as said.
        BellowsError: A scene that cannot be: an object within the finger, a wall or object that
            the finger does not reach at the last pressure.
        MeshingError: No usable mesh of the cell, or none in time.

    Examples:
        >>> from bellows_design import force_curve, load_design
        >>> from bellows_design.design.scenes.blocked import Blocked
        >>> design = load_design("prototype_1")
        >>> found = force_curve(design, Blocked(), (0.05, 0.1), by_distance=False)
        >>> weak, strong = found.curve
        >>> print(found.converged, strong.force_n > weak.force_n > 0)  # N
        True True
    """
    _require_path(pressures, flow)
    if isinstance(law, FingerLaw):
        solved = Solved.of(design, scene, pressures, law)
    else:
        solved = solved_with_its_law(design, scene, pressures, progress, budget, store, law)
    return _curve(solved, name or scene.kind, flow, by_distance)


def _curve(solved: Solved, name: str, flow: float, by_distance: bool) -> ForceCurve:
    started = time.perf_counter()
    readings = Readings(solved.design, solved.scene, solved.law, solved.loaded)
    curve = tuple(readings.of(state) for state in solved.states)
    ending, last = solved.path.ending, solved.path.last
    if ending is None:
        _require_touched(readings, last)
    away = Distances()
    if by_distance and ending is None:
        away = moved_away(readings, last)
    seconds = solved.seconds + time.perf_counter() - started
    return ForceCurve(
        design=solved.design,
        scene=name,
        content=solved.scene,
        converged=ending is None,
        message="" if ending is None else f"{ending.sentence.rstrip('.')}.",
        curve=curve,
        by_distance=away.readings,
        tip_stiffness_n_per_mm=readings.tip_stiffness(last),
        pneumatic_work_mj=solved.path.work_of_pressure,
        tip_work_mj=away.work,
        air=_air(readings, solved.path, flow),
        warnings=(*solved.warnings, *curve[-1].warnings, *away.warnings),
        extrapolated=bool(solved.beyond or solved.beyond_ends),
        law_complete=solved.law.complete,
        jumped=bool(solved.path.jumps),
        seconds=Seconds(solved.law.seconds, seconds),
        from_cache=solved.law.from_cache,
    )


def _require_path(pressures: Sequence[float], flow: float) -> None:
    """Refuse pressures that do not go away from zero, and no flow. Raises ``DesignError``."""
    steps = np.diff([0.0, *(float(each) for each in pressures)])
    away = bool(np.isfinite(steps).all()) and (bool((steps > 0).all()) or bool((steps < 0).all()))
    if not len(pressures) or not away:
        said = ", ".join(f"{each:g}" for each in pressures) or "none"
        raise DesignError(
            f"pressures = {quoted(said)} MPa must go away from 0 MPa, each further than the one "
            "before, all positive or all negative."
        )
    if not 0 < flow < math.inf:
        raise DesignError(f"flow = {flow:g} L/min must be positive and finite.")


def _require_touched(readings: Readings, state: ChainState) -> None:
    """Refuse a wall or an object that the finger does not come to. Raises ``DesignError``."""
    scene = readings.scene
    held = isinstance(scene, Blocked) and scene.support == "held"
    if held or not isinstance(scene, Blocked | Grip) or force_of(scene, state) > 0:
        return
    at = f"at {state.pressure:g} MPa"
    if isinstance(scene, Grip):
        raise DesignError(
            f"the {scene.object} of size = {scene.size:g} mm at place = {scene.place:g} mm is not "
            f"touched {at}: the finger comes within {readings.gap(state):.3g} mm of it."
        )
    what = {"load_cell": "load cell"}.get(scene.support, scene.support)
    point = "tip" if scene.support == "load_cell" else "finger"
    raise DesignError(
        f"the {what} at distance = {scene.distance:g} mm is not reached {at}: the free {point} "
        f"reaches {-readings.lowest(state):.3g} mm below its place at rest."
    )


def _air(readings: Readings, path: Path, flow: float) -> Air:
    rest, last = path.steps[0], path.last
    return air_of_stroke(readings.volume(rest), readings.volume(last), last.pressure, flow)
