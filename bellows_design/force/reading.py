"""An equilibrium of the chain as what the finger exerts in its scene."""

from __future__ import annotations

import math

import numpy as np

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.state import ChainState, ContactPoint
from bellows_design.force.result import Point

Wrench = tuple[float, float, float]
"""x and z of a force (N) and a moment about y (N mm), positive from +x towards -z."""


def exerted(scene: Scene, state: ChainState) -> Wrench:
    """Force that the finger exerts, and the moment that acts on it at the tip's lower edge.

    Zero where nothing blocks the finger. Of a grip that of one finger.
    """
    x, z = state.contact_force
    held_x, held_z, held_moment = state.held_force
    moment = held_moment + sum(_moment(point, state.tip) for point in state.contacts)
    return -(x + held_x), -(z + held_z), moment


def force_of(scene: Scene, state: ChainState) -> float:
    """The one force of a scene, N: of a grip what presses normal to the object, else the whole."""
    if isinstance(scene, Grip):
        return sum(point.normal_force for point in state.contacts)
    x, z, _ = exerted(scene, state)
    return math.hypot(x, z)


def touched(scene: Scene, state: ChainState) -> tuple[Point, ...]:
    """Points of the finger on which objects or a support press, mm."""
    points = tuple(point.position for point in state.contacts)
    holds = isinstance(scene, Blocked) and any(state.held_force)
    return (*points, state.tip[:2]) if holds else points


def shape_of(state: ChainState) -> tuple[Point, ...]:
    """The lower side from root to tip, mm."""
    return tuple((float(x), float(z)) for x, z in state.frames[:, :2])


def largest_payload(scene: Grip, state: ChainState) -> float:
    """Force along the fingers that their contacts hold, N, with friction at its limit everywhere.

    Every point pushes the object along the normal and, by friction, at most the coefficient times
    as much along the surface, against the object's weight.
    """
    pull = 0.0
    for point in state.contacts:
        normal = _normal(scene, point)
        pull += point.normal_force * (normal[0] + scene.friction * abs(normal[1]))
    return scene.fingers * max(0.0, pull)


def _moment(point: ContactPoint, tip: Wrench) -> float:
    """Moment of a contact's force about the tip's lower edge, N mm."""
    arm_x, arm_z = point.position[0] - tip[0], point.position[1] - tip[1]
    return point.force[0] * arm_z - point.force[1] * arm_x
