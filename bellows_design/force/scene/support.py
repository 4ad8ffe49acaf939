"""As long as a finger presses on what is to stop it: a support, or an object in a grip."""

from __future__ import annotations

import math

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.path import Ending, Path
from bellows_design.force.chain.state import ChainState
from bellows_design.force.scene.exerted import force_of


def presses(scene: Scene, state: ChainState) -> bool:
    """Whether the finger presses on support or object; on a load cell only as its tip does.

    A tip that has turned by more than half a turn does not: other points of the finger would meet
    the plate first, of which a load cell knows nothing.
    """
    if not isinstance(scene, Blocked | Grip):
        return False
    load_cell = isinstance(scene, Blocked) and scene.support == "load_cell"
    return force_of(scene, state) > 0 and not (load_cell and state.tip[2] > math.pi)


def until_lost(scene: Scene, path: Path) -> Path:
    """The path as far as a finger that has come to its support or object stays there."""
    pressing = [presses(scene, each) for each in path.steps]
    first = pressing.index(True) if any(pressing) else len(pressing)
    lost = next((n for n in range(first, len(pressing)) if not pressing[n]), None)
    if lost is None:
        return path
    load, before = path.steps[lost].load, path.steps[:lost]
    snaps = any(each.load == load for each in path.jumps)
    sentence = f"at {load.pressure:.4g} MPa the finger {'snaps off' if snaps else 'leaves'} "
    return Path(
        states=tuple(each for each in path.states if any(each is step for step in before)),
        steps=before,
        ending=Ending("jump" if snaps else "no equilibrium", sentence + _what(scene), load),
        jumps=tuple(each for each in path.jumps if any(each.beyond is step for step in before)),
    )


def _what(scene: Scene) -> str:
    """What it leaves."""
    if isinstance(scene, Grip):
        return f"the {scene.object}"
    if isinstance(scene, Blocked) and scene.support == "load_cell":
        return "the load cell and curls past it; a support = “wall” tells what it then exerts"
    return "the wall"
