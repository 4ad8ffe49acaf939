"""What a finger exerts on what is around it."""

from __future__ import annotations

import math

from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.state import ChainState, ContactPoint

Wrench = tuple[float, float, float]
"""x and z of a force (N) and a moment about y (N mm), positive from +x towards -z."""


def exerted(state: ChainState) -> Wrench:
    """Force of the finger on what is around it, and the moment on it about the tip's lower edge.

    Zero where nothing blocks the finger. Of a grip that of one finger.
    """
    x, z = state.contact_force
    held_x, held_z, held_moment = state.held_force
    moment = held_moment + sum(_moment(point, state.tip) for point in state.contacts)
    return 0.0 - (x + held_x), 0.0 - (z + held_z), moment


def force_of(scene: Scene, state: ChainState) -> float:
    """The one force of a scene, N: of a grip what presses normal to the object, else the whole."""
    if isinstance(scene, Grip):
        return sum(point.normal_force for point in state.contacts)
    x, z, _ = exerted(state)
    return math.hypot(x, z)


def _moment(point: ContactPoint, tip: Wrench) -> float:
    """Moment of a contact's force about the tip's lower edge, N mm."""
    arm_x, arm_z = point.position[0] - tip[0], point.position[1] - tip[1]
    return point.force[0] * arm_z - point.force[1] * arm_x
