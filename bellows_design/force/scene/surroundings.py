"""A scene as what surrounds the chain: objects, dead loads, gravity, and what holds the tip."""

from __future__ import annotations

from bellows_design.design.design import Design
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.fields import Direction
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.payload import Payload
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.contact.obstacles import Disc, Obstacle, Plane, RoundedBox
from bellows_design.force.chain.finger.weight import GRAVITY, Weights
from bellows_design.force.chain.surroundings import DeadForce, Hold, Surroundings

DENSITY = 1.2
"""g/cm³. Of a TPU whose filament is not known; those of the shipped filaments are 1.07 to 1.22."""

CORNER = 0.2
"""Of the smaller half side of a box: radius of its corners, which have no normal where sharp."""


def weights_of(design: Design) -> Weights:
    """Weights of the finger's parts, with the density of the printer's filament."""
    filament = design.profile().filament
    return Weights.of(design, DENSITY if filament is None else filament.density)


def surroundings_of(scene: Scene, length: float) -> Surroundings:
    """What acts on a finger of ``length`` mm in ``scene`` besides pressure."""
    if isinstance(scene, Payload):
        place = length if scene.place is None else scene.place
        newtons = scene.mass_g * 1e-3 * GRAVITY
        force = (newtons * scene.gravity[0], newtons * scene.gravity[1])
        return Surroundings(
            dead_forces=(DeadForce(place, force),), gravity=_direction(scene.gravity)
        )
    if isinstance(scene, Grip):
        # Hanging: the weight of finger and object pulls from root to tip.
        return Surroundings((_gripped(scene),), friction=scene.friction, gravity=(1.0, 0.0))
    if isinstance(scene, Blocked):
        return _blocked(scene, length)
    return Surroundings(gravity=_direction(scene.gravity))


def _direction(gravity: Direction) -> Direction | None:
    return None if gravity == (0.0, 0.0) else gravity


def _blocked(scene: Blocked, length: float) -> Surroundings:
    gravity = _direction(scene.gravity)
    if scene.support == "held":
        return Surroundings(hold=Hold(length, 0.0, 0.0), gravity=gravity)
    if scene.support == "load_cell":
        return Surroundings(hold=Hold.load_cell(-scene.distance), gravity=gravity)
    wall = Plane((0.0, -scene.distance), (0.0, 1.0))
    return Surroundings((wall,), friction=scene.friction, gravity=gravity)


def _gripped(scene: Grip) -> Obstacle:
    """The object in a finger's plane."""
    centre, half = (scene.place, -scene.distance), scene.size / 2
    if scene.object != "box":
        return Disc(centre, half)
    halves = ((scene.size if scene.height is None else scene.height) / 2, half)
    return RoundedBox(centre, halves, CORNER * min(halves))
