"""Equilibria of the chain as what the finger exerts in its scene."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from bellows_design.design.design import Design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.finger.weight import GRAVITY
from bellows_design.force.chain.grip import Pull, pulled
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import Path
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import LoadPoint
from bellows_design.force.finger_law import FingerLaw
from bellows_design.force.result import ForceReading, Point
from bellows_design.force.scene.dead_volume import dead_volume
from bellows_design.force.scene.errors import force_error
from bellows_design.force.scene.exerted import exerted, force_of

PULL = Pull(step=0.5)
"""How an object is pulled: the largest force that is met counts."""


@dataclass(frozen=True)
class Readings:
    """What turns a state of a finger in its scene into a record."""

    design: Design
    scene: Scene
    law: FingerLaw
    loaded: LoadedChain

    def of(self, state: ChainState) -> ForceReading:
        """The record of ``state``; of a grip once the object's weight pulls, if it is held."""
        state, holds, payload = self._gripping(state)
        facts, loads = self.law.facts, state.loads
        x, z, moment = exerted(state)
        force = partial(force_of, self.scene)
        unknown = facts.unknown(state.pressure, loads)
        blocked = isinstance(self.scene, Blocked | Grip)
        stress, stress_error = facts.stress(state.pressure, loads) or (None, None)
        return ForceReading(
            pressure_mpa=state.pressure,
            distance_mm=self.distance(state.load) if isinstance(self.scene, Blocked) else None,
            force_n=force(state),
            components_n=(x, z),
            moment_n_mm=moment,
            tip_position_mm=state.tip[:2],
            tip_angle_deg=math.degrees(state.tip[2]),
            contact=facts.touching(state.pressure, loads),
            stable=state.stable,
            volume_mm3=self.volume(state),
            max_von_mises_mpa=stress,
            max_von_mises_error_percent=stress_error,
            error=force_error(self.loaded, state, force, unknown) if blocked else None,
            shape=self._shape(state),
            touched=self._touched(state),
            holds=holds,
            largest_payload_g=payload,
        )

    def distance(self, load: LoadPoint) -> float:
        """From the lower side at rest down to what blocks the finger, mm; 0 where nothing does."""
        if not isinstance(self.scene, Blocked):
            return 0.0
        wall = self.scene.support == "wall"
        shift = load.object_shift if wall else load.hold_shift
        return self.scene.distance - shift[1]

    def lowest(self, state: ChainState) -> float:
        """Height of what would touch the support first, mm: of the tip's edge on a load cell."""
        if isinstance(self.scene, Blocked) and self.scene.support == "load_cell":
            return state.tip[1]
        return float(self.loaded.contacts.positions(state.frames[1:-1])[:, 1].min())

    def gap(self, state: ChainState) -> float:
        """Least distance of the finger's lower side from the objects, mm."""
        positions = self.loaded.contacts.positions(state.frames[1:-1]) - state.load.object_shift
        objects = self.loaded.surroundings.objects
        return min(float(each.distance(positions).value.min()) for each in objects)

    def volume(self, state: ChainState) -> float:
        """Air inside the whole finger, mm³."""
        return state.volume + dead_volume(self.design.bellows)

    def tip_stiffness(self, state: ChainState) -> float | None:
        """Of a blocked tip along z, N/mm; None in other scenes and on a wall that is not touched.

        On a wall the tip's own, whatever else touches the wall.
        """
        blocked = isinstance(self.scene, Blocked) and force_of(self.scene, state) > 0
        return state.tip_stiffness if blocked and not state.contacts else None

    def _gripping(self, state: ChainState) -> tuple[ChainState, bool | None, float | None]:
        """The state under the object's weight, whether it is held, and the largest mass (g).

        Where the closed finger pushes the object towards its root by more than the weight, the
        object keeps its place.
        """
        if not isinstance(self.scene, Grip):
            return state, None, None
        fingers, mass = self.scene.fingers, self.scene.mass_g
        found = pulled(self.loaded, Path((state,), (state,), None), PULL)
        hanging = None if self.drawn_in(state) > 0 else found.under(_weight(self.scene))
        grams = 1e3 * fingers * found.largest_force / GRAVITY
        return hanging or state, grams >= mass, grams

    def drawn_in(self, state: ChainState) -> float:
        """What a closed finger pushes an object towards its root with, beyond its weight, N."""
        if not isinstance(self.scene, Grip):
            return 0.0
        return PULL.force(state) - _weight(self.scene)

    def _shape(self, state: ChainState) -> tuple[Point, ...]:
        """The lower side, about every mm."""
        positions = self.loaded.contacts.positions(state.frames[1:-1])
        every = max(1, round(1 / self.loaded.widths[0]))
        return tuple((float(x), float(z)) for x, z in [*positions[:-1:every], positions[-1]])

    def _touched(self, state: ChainState) -> tuple[Point, ...]:
        points = tuple(point.position for point in state.contacts)
        return (*points, state.tip[:2]) if any(state.held_force) else points


def _weight(scene: Grip) -> float:
    """Of the object, on every finger, N."""
    return 1e-3 * GRAVITY * scene.mass_g / scene.fingers
