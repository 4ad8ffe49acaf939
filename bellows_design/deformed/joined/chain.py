"""The whole actuator from one cell and its ends: bubble after bubble on an arc.

Where the cell's moving plane went, its mirror image begins. Between the middles of the first bubble
and of the last one there are only such copies; what lies beyond comes from the ends.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from bellows_design.deformed.joined.copies import Assembled, Copy, Placed
from bellows_design.deformed.joined.ends import Ends
from bellows_design.deformed.joined.motion import Motion
from bellows_design.deformed.joined.state import ActuatorState, BodyState
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.geometry.face_names import (
    BUBBLE_MIDDLE,
    CAVITY,
    GAP_MIDDLE,
    OUTSIDE,
    ROOT,
    SYMMETRY,
    TIP,
)
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

WALLS = {OUTSIDE: OUTSIDE, CAVITY: CAVITY}
CELL, ROOT_END, TIP_END = range(3)


@dataclass(frozen=True)
class Chain:
    """An actuator of many bubbles: which nodes of cell and ends make it up."""

    ends: Ends
    assembled: Assembled

    @staticmethod
    def of(design: Design, cell: Mesh, ends: Mesh) -> Chain:
        """From the meshes of the cell and of its ends."""
        found = Ends.of(design, ends, cell)
        bodies = (cell, *(end.piece.mesh for end in found))
        copies = _copies(design.bellows.bubble_count, found.root.free)
        return Chain(found, Assembled.of(bodies, copies))

    def at_rest(self, bellows: BellowsParameters, state: ActuatorState) -> Placed:
        """Without load, on the meshes of ``state``, which may be moved ones."""
        body, ends = _both(state)
        middle = 0.0 if self.ends.root.free else bellows.bubble_middles[0]
        nodes = (body.nodes, *(end.rest(ends, middle) for end in self.ends))
        return Placed(nodes, tuple(Motion(x=x) for x in self._rest_places(bellows)))

    def loaded(self, bellows: BellowsParameters, state: ActuatorState) -> Placed:
        """Under load, the root where it was."""
        body, ends = _both(state)
        bends = self.added_bends(bellows, state)
        pairs = list(zip(self.ends, bends, strict=True))
        nodes = (body.moved, *(end.points(ends, body, bend) for end, bend in pairs))
        to_root, to_tip = (end.joint(ends, body) for end in self.ends)
        held = Motion(x=self._rest_places(bellows)[0])
        base = held.after(self.ends.root.far(ends, bends[0]).inverse)
        bubbles = _bubbles(bellows, body, base.after(to_root))
        return Placed(nodes, (base, *bubbles, bubbles[-1].after(to_tip.inverse)))

    def values(self, body: Reals, ends: Reals | None) -> tuple[Reals, ...]:
        """Values at the nodes of the bodies from those of cell and ends."""
        return body, *(end.piece.values @ ends for end in self.ends)

    def added_bends(self, bellows: BellowsParameters, state: ActuatorState) -> tuple[float, float]:
        """By how much the ends are bent on, rad: root and tip.

        So far that the tip turns by the angle of the whole, and that each end has half of what both
        add to the cells. In the short actuator the tip's flexibility reaches past the bubble's
        middle, which in a chain only turns the last bubble.
        """
        body, ends = _both(state)
        count, root = bellows.bubble_count, self.ends.root
        solved = root.joint(ends, body).angle - root.far(ends, 0.0).angle
        wanted = body.tilt + (state.angle - 2 * count * body.tilt) / 2
        both = 2 * ends.tilt if root.free else ends.turn
        missing = state.angle - 2 * (count - 1) * body.tilt - both
        return wanted - solved, missing - (wanted - solved)

    def _rest_places(self, bellows: BellowsParameters) -> tuple[float, ...]:
        """x of the places: of the root's end, of all bubbles, of the tip's end, mm."""
        middles = bellows.bubble_middles
        if self.ends.root.free:
            return middles[0], *middles, middles[-1]
        return 0.0, *middles, middles[-1] - middles[0]


def _both(state: ActuatorState) -> tuple[BodyState, BodyState]:
    if state.ends is None:
        raise ValueError("a chain of cells needs its ends")
    return state.body, state.ends


def _bubbles(bellows: BellowsParameters, cell: BodyState, first: Motion) -> tuple[Motion, ...]:
    """Where each bubble's middle is, from that of the first one on."""
    reach = bellows.pitch / 2 + cell.shift
    step = Motion(cell.tilt, x=reach)
    onward = step.after(Motion(cell.tilt)).after(Motion(x=reach))
    places = [first]
    for _ in range(bellows.bubble_count - 1):
        places.append(places[-1].after(onward))
    return tuple(places)


def _copies(count: int, free: bool) -> list[Copy]:
    """Both ends, and between them the halves of bubbles that face each other; each y mirrored."""
    root_walls, tip_walls = WALLS | {ROOT: ROOT}, WALLS | {TIP: TIP}
    copies = [
        *_both_sides(ROOT_END, -1 if free else 1, 0, 0, root_walls),
        *_both_sides(TIP_END, 1, count + 1, 2, tip_walls),
    ]
    for half in range(2 * (count - 1)):
        sign, bubble = (-1, half // 2 + 1) if half % 2 else (1, half // 2)
        joint = GAP_MIDDLE if half % 2 else BUBBLE_MIDDLE
        former = ((joint, len(copies) - 2),) if half else ()
        copies += _both_sides(CELL, sign, bubble + 1, len(copies), WALLS, former)
    return copies


def _both_sides(
    body: int,
    sign: int,
    place: int,
    number: int,
    named: Mapping[str, str],
    joints: tuple[tuple[str, int], ...] = (),
) -> Iterator[Copy]:
    """A copy at y > 0, which gets that ``number``, and its mirror image.

    ``joints``: surfaces where they meet copies before them, the former of which is at y > 0.
    """
    yield Copy(body, (sign, 1, 1), place, joints, named)
    behind = tuple((surface, other + 1) for surface, other in joints)
    yield Copy(body, (sign, -1, 1), place, (*behind, (SYMMETRY, number)), named)
