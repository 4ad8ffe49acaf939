"""Both ends of an actuator, up to the middles of the outermost bubbles.

They come from the short actuator, cut in the middle of its bubble, or are bubbles without
neighbours where such a one stands for them. They are as solved but for a bend that is added from
the bubble's middle to the gap: the angle of the whole is found from finer meshes than theirs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.models import shortened
from bellows_design.deformed.joined.cutting import SECTION, Piece, cut
from bellows_design.deformed.joined.motion import Motion
from bellows_design.deformed.joined.sections import Match
from bellows_design.deformed.joined.state import BodyState
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.geometry.face_names import BUBBLE_MIDDLE, GAP_MIDDLE, TIP
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array

LONGER = 1e-6
"""mm. A short actuator whose tip is longer by more is cut where the actuator ends."""


@dataclass(frozen=True)
class End:
    """One end, in the frame of the body that was solved.

    ``piece``: of that body, with the surface ``section`` at the bubble's middle. ``match``: of that
    to the cell's; ``spread`` (n, k): how values at its nodes are continued to all. ``shares`` (n,):
    0 in the bubble's middle, 1 where the bubble or its gap ends and beyond. ``outward``: on which
    side of the middle it lies, -1 or 1; ``sign``: -1 if it is used mirrored at the bubble's middle,
    else 1. ``free``: it is a bubble without neighbours, else a part of the short actuator.
    """

    piece: Piece
    match: Match
    spread: csr_array
    shares: Reals
    outward: int
    sign: int
    free: bool

    @staticmethod
    def of(piece: Piece, cell: Mesh, reach: float, outward: int, sign: int, free: bool) -> End:
        """The end that becomes rigid at ``reach`` (mm) from the bubble's middle."""
        match = Match.of(piece.mesh, SECTION, cell, BUBBLE_MIDDLE)
        x = piece.mesh.nodes[:, 0]
        shares = np.clip(np.abs(x - x[match.nodes].mean()) / reach, 0.0, 1.0)
        return End(piece, match, match.spread(piece.mesh), shares, outward, sign, free)

    def rest(self, ends: BodyState, middle: float) -> Reals:
        """Undeformed nodes (n, 3), mm, where the section lies in the plane x = ``middle``.

        In a mesh that was moved to a neighbouring design the cut is not quite plane.
        """
        nodes: Reals = self.piece.positions @ ends.nodes
        off = self.spread @ (nodes[self.match.nodes, 0] - middle)
        nodes[:, 0] -= (1 - self.shares) * off
        return nodes

    def points(self, ends: BodyState, cell: BodyState, bend: float) -> Reals:
        """Deformed nodes (n, 3), mm, bent on by ``bend`` (rad) from the middle outwards.

        What they miss the cell by at the bubble's middle is taken from them, ever less outwards.
        """
        moved = self.piece.positions @ ends.moved
        turned, shares = self._added(moved, bend).applied(moved), self.shares[:, None]
        missed = self.spread @ self.match.missed(moved, cell.moved)
        bent: Reals = moved + shares * (turned - moved) - (1 - shares) * missed
        return bent

    def joint(self, ends: BodyState, cell: BodyState) -> Motion:
        """The motion of a cell whose bubble's middle meets that of this end."""
        return self._seen(self.match.motion(self.piece.positions @ ends.moved, cell.moved))

    def far(self, ends: BodyState, bend: float) -> Motion:
        """How what lies beyond the gap moves, as a rigid body."""
        added = self._added(self.piece.positions @ ends.moved, bend)
        return self._seen(added.after(_of_plane(ends)) if self.free else added)

    def _seen(self, motion: Motion) -> Motion:
        return motion.mirrored if self.sign < 0 else motion

    def _added(self, moved: Reals, bend: float) -> Motion:
        return Motion.about(self.outward * bend, moved[self.match.nodes].mean(axis=0))


def _of_plane(state: BodyState) -> Motion:
    """The motion of a cell's moving plane."""
    x = float(state.nodes[:, 0].max())
    turned = Motion(state.tilt).applied(np.array([[x, 0.0, 0.0]]))[0]
    return Motion(state.tilt, x + state.shift - float(turned[0]), -float(turned[2]))


@dataclass(frozen=True)
class Ends:
    """Those at root and tip."""

    root: End
    tip: End

    def __iter__(self) -> Iterator[End]:
        return iter((self.root, self.tip))

    @staticmethod
    def of(design: Design, ends: Mesh, cell: Mesh) -> Ends:
        """From the mesh of the short actuator, or of a bubble without neighbours."""
        return (
            _free(design, ends, cell) if GAP_MIDDLE in ends.surfaces else _cut(design, ends, cell)
        )


def _cut(design: Design, ends: Mesh, cell: Mesh) -> Ends:
    bellows = design.bellows
    root, tip = (_actual(design, piece) for piece in cut(ends, bellows.bubble_middles[0]))
    reach = bellows.bubble_length / 2
    return Ends(End.of(root, cell, reach, -1, 1, False), End.of(tip, cell, reach, 1, 1, False))


def _actual(design: Design, piece: Piece) -> Piece:
    """The piece, cut where the actuator ends if the short one's tip is longer than its.

    That is where the short actuator would have been shorter than any actuator may be.
    """
    bellows = design.bellows
    end = bellows.length - _middles_apart(bellows)
    surplus = shortened(design).bellows.length - end
    if surplus <= LONGER or design.fingertip is not None or piece.mesh.nodes[:, 0].max() < end:
        return piece
    return cut(piece.mesh, end, TIP)[0].of(piece)


def _middles_apart(bellows: BellowsParameters) -> float:
    """From the first bubble's middle to the last one's, mm."""
    return bellows.bubble_middles[-1] - bellows.bubble_middles[0]


def _free(design: Design, ends: Mesh, cell: Mesh) -> Ends:
    reach, named = design.bellows.pitch / 2, {SECTION: ends.surfaces[BUBBLE_MIDDLE]}
    piece = Piece.whole(ends.with_surfaces(named))
    return Ends(*(End.of(piece, cell, reach, 1, sign, True) for sign in (-1, 1)))
