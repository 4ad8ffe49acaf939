"""An object in a grip: where it hangs by its own weight, and what the grip would hold."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from bellows_design.design.scenes.grip import Grip
from bellows_design.force.chain import grip
from bellows_design.force.chain.equilibrium import beside
from bellows_design.force.chain.finger.weight import GRAVITY
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import Ending, Path
from bellows_design.force.chain.readings import state_of, unknowns_of
from bellows_design.force.chain.state import ChainState
from bellows_design.force.finger_law import Facts
from bellows_design.force.scene.errors import Force, force_error

PULL = grip.Pull(step=0.5)
"""How an object is pulled: the largest force that is met counts."""

SMALL_WAY = 1e-5
"""mm, of an object: by which the pull's rise is found."""

KEPT = "readings are those of an object that is kept in its place."


@dataclass(frozen=True)
class Gripping:
    """What became of an object in a grip.

    Attributes:
        state: Under the object's weight where it is held, else the closed finger's on an object
            that keeps its place.
        holds: Whether it is held: in ``state`` it is in equilibrium. None where the grip would bear
            its weight, but no equilibrium with it was found.
        payload_g: Largest mass that is held, g.
        payload_error_percent: Its estimated error.
        warnings: Sentences on what makes all that less reliable than it looks.
    """

    state: ChainState
    holds: bool | None
    payload_g: float
    payload_error_percent: float
    warnings: tuple[str, ...] = ()


def gripping(loaded: LoadedChain, scene: Grip, facts: Facts, state: ChainState) -> Gripping:
    """Pull the object of ``scene`` out of the closed finger's ``state``, and hang it there."""
    found = grip.pulled(loaded, Path((state,), (state,), None), PULL)
    weight = weight_on_finger(scene)
    slips = weight > found.largest_force
    hanging = None if slips else found.under(weight)
    return Gripping(
        state=hanging or state,
        holds=False if slips else (True if hanging else None),
        payload_g=1e3 * scene.fingers * found.largest_force / GRAVITY,
        payload_error_percent=_payload_error(found, facts),
        warnings=(*_of_the_state(found, weight, hanging), *_of_the_pull(found)),
    )


def with_hanging_object(loaded: LoadedChain, state: ChainState, force: Force) -> Force:
    """``force``, near ``state``, of an object that moves along the pull until its weight is borne.

    A function of states in which the object keeps its place: what the pull misses there is made up
    for by a way of the object, to first order.
    """
    ahead = PULL.way(state) + SMALL_WAY
    shift = PULL.direction[0] * ahead, PULL.direction[1] * ahead
    load = state.load.shifted(shift)
    moved = state_of(loaded, load, beside(loaded, load, unknowns_of(state), state.history))
    borne = PULL.force(state)
    rise = PULL.force(moved) - borne
    share = (force(moved) - force(state)) / rise if rise else 0.0
    return lambda other: force(other) - share * (PULL.force(other) - borne)


def weight_on_finger(scene: Grip) -> float:
    """Of the object, on every finger, N."""
    return 1e-3 * GRAVITY * scene.mass_g / scene.fingers


def _payload_error(found: grip.Grip, facts: Facts) -> float:
    """Estimated error of the largest force along the pull, percent."""
    strongest = found.strongest
    if strongest is None or not found.largest_force:
        return 0.0
    unknown = facts.unknown(strongest.pressure, strongest.loads)
    return force_error(found.loaded, strongest, found.pull.force, unknown).total


def _of_the_state(found: grip.Grip, weight: float, hanging: ChainState | None) -> Iterator[str]:
    """What is to be said of the state that is reported."""
    if hanging is not None:
        return
    drawn = found.pull.force(found.closing.last) - weight
    if weight > found.largest_force:
        yield f"the object slips out of the grip: {KEPT}"
    elif drawn > 0:
        yield (
            f"the closed fingers draw the object towards their roots, each by {drawn:.3g} N more "
            f"than its weight, and no place was found where it rests: {KEPT}"
        )
    else:
        yield f"no equilibrium was found with the object's weight: {KEPT}"


def _of_the_pull(found: grip.Grip) -> Iterator[str]:
    """What is to be said of the largest payload."""
    strongest = found.strongest
    way = 0.0 if strongest is None else found.pull.way(strongest)
    before = [each for each in found.jumps if _way(found, each) <= way]
    if before:
        yield (
            f"as the object is pulled, at {_way(found, before[0]):.3g} mm, the finger jumps to "
            "another equilibrium: the largest payload is borne after it."
        )
    if found.ending is not None:
        yield (
            f"the pull ended at {_way(found, found.ending):.3g} mm without an equilibrium: the "
            "largest payload is what was met until then."
        )
    elif not found.let_go:
        yield (
            f"the finger has not let go of the object after {found.pull.longest:g} mm: it may bear "
            "more than the largest payload."
        )


def _way(found: grip.Grip, ending: Ending) -> float:
    """Where a branch ended along the pull, mm."""
    return float(
        sum(a * b for a, b in zip(ending.load.object_shift, found.pull.direction, strict=True))
    )
