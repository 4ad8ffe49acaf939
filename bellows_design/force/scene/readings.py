"""Equilibria of the chain as what the finger exerts in its scene."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from bellows_design.design.design import Design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.state import ChainState
from bellows_design.force.chain.surroundings import LoadPoint
from bellows_design.force.finger_law import FingerLaw
from bellows_design.force.result import ForceError, ForceReading, Point
from bellows_design.force.scene.dead_volume import dead_volume
from bellows_design.force.scene.errors import Force, force_error
from bellows_design.force.scene.exerted import exerted, force_of
from bellows_design.force.scene.gripping import Gripping, gripping, with_hanging_object


@dataclass(frozen=True)
class Readings:
    """What turns a state of a finger in its scene into a record."""

    design: Design
    scene: Scene
    law: FingerLaw
    loaded: LoadedChain

    def of(self, state: ChainState) -> ForceReading:
        """The record of ``state``; of a grip once the object's weight pulls, if it is held."""
        grip = self._gripping(state)
        state = state if grip is None else grip.state
        facts, loads = self.law.facts, state.loads
        x, z, moment = exerted(state)
        blocked = isinstance(self.scene, Blocked | Grip)
        stress, stress_error = facts.stress(state.pressure, loads) or (None, None)
        return ForceReading(
            pressure_mpa=state.pressure,
            distance_mm=self.distance(state.load) if isinstance(self.scene, Blocked) else None,
            force_n=force_of(self.scene, state),
            components_n=(x, z),
            moment_n_mm=moment,
            tip_position_mm=state.tip[:2],
            tip_angle_deg=math.degrees(state.tip[2]),
            contact=facts.touching(state.pressure, loads),
            stable=state.stable,
            volume_mm3=self.volume(state),
            max_von_mises_mpa=stress,
            max_von_mises_error_percent=stress_error,
            error=self._error(state, grip) if blocked else None,
            shape=self._shape(state),
            touched=self._touched(state),
            holds=None if grip is None else grip.holds,
            largest_payload_g=None if grip is None else grip.payload_g,
            largest_payload_error_percent=None if grip is None else grip.payload_error_percent,
            warnings=() if grip is None else grip.warnings,
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

    def _error(self, state: ChainState, grip: Gripping | None) -> ForceError:
        """Estimated errors of the force; an object that hangs gives way until it does again."""
        force: Force = partial(force_of, self.scene)
        if grip is not None and grip.holds:
            force = with_hanging_object(self.loaded, state, force)
        unknown = self.law.facts.unknown(state.pressure, state.loads)
        return force_error(self.loaded, state, force, unknown)

    def _gripping(self, state: ChainState) -> Gripping | None:
        """Of a grip, what becomes of its object."""
        if not isinstance(self.scene, Grip):
            return None
        return gripping(self.loaded, self.scene, self.law.facts, state)

    def _shape(self, state: ChainState) -> tuple[Point, ...]:
        """The lower side, about every mm."""
        positions = self.loaded.contacts.positions(state.frames[1:-1])
        every = max(1, round(1 / self.loaded.widths[0]))
        return tuple((float(x), float(z)) for x, z in [*positions[:-1:every], positions[-1]])

    def _touched(self, state: ChainState) -> tuple[Point, ...]:
        points = tuple(point.position for point in state.contacts)
        return (*points, state.tip[:2]) if any(state.held_force) else points
