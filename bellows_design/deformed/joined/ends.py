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
from bellows_design.deformed.joined.stubs import Stub, with_stub
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.geometry.face_names import BUBBLE_MIDDLE, GAP_MIDDLE, ROOT, SYMMETRY, TIP
from solver.arrays import Integers, Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from scipy.sparse import csr_array

SHORTEST_STUB = 0.1
"""mm. Where the actuator ends before the gap's middle, a stub is this long."""

LONGER = 1e-6
"""mm. A short actuator whose tip is longer by more is cut where the actuator ends."""


@dataclass(frozen=True)
class End:
    """One end, in the frame of the body that was solved.

    ``piece``: of that body, with the surface ``section`` at the bubble's middle. ``match``: of that
    to the cell's; ``spread`` (n, k): how values at its nodes are continued to all. ``shares`` (n,):
    0 in the bubble's middle, 1 where the bubble or its gap ends and beyond. ``tendon`` (j,): nodes
    of the section about whose middle it bends on. ``outward``: on which side of the bubble's middle
    it lies, -1 or 1; ``sign``: -1 if it is used mirrored there, else 1. ``stub``: what follows a
    bubble without neighbours; a part of the short actuator has its own.
    """

    piece: Piece
    match: Match
    spread: csr_array
    shares: Reals
    tendon: Integers
    outward: int
    sign: int = 1
    stub: Stub | None = None

    @staticmethod
    def of(
        piece: Piece,
        cell: Mesh,
        bellows: BellowsParameters,
        outward: int,
        sign: int = 1,
        stub: Stub | None = None,
    ) -> End:
        """The end that becomes rigid where the bubble ends, or with a stub in the gap's middle."""
        match, nodes = Match.of(piece.mesh, SECTION, cell, BUBBLE_MIDDLE), piece.mesh.nodes
        reach = (bellows.bubble_length if stub is None else bellows.pitch) / 2
        away = np.abs(nodes[:, 0] - nodes[match.nodes, 0].mean())
        shares = np.clip(away / reach, 0.0, 1.0)
        tendon = match.nodes[nodes[match.nodes, 2] <= bellows.tendon_height]
        return End(piece, match, match.spread(piece.mesh), shares, tendon, outward, sign, stub)

    @property
    def free(self) -> bool:
        """Whether it is a bubble without neighbours, else a part of the short actuator."""
        return self.stub is not None

    def rest(self, ends: BodyState, middle: float) -> Reals:
        """Undeformed nodes (n, 3), mm, where the section lies in the plane x = ``middle``.

        In a mesh that was moved to a neighbouring design the cut is not quite plane.
        """
        nodes = self._undeformed(ends)
        off = self.spread @ (nodes[self.match.nodes, 0] - middle)
        nodes[:, 0] -= (1 - self.shares) * off
        return nodes

    def points(self, ends: BodyState, cell: BodyState, bend: float) -> Reals:
        """Deformed nodes (n, 3), mm, bent on by ``bend`` (rad) from the middle outwards.

        What they miss the cell by at the bubble's middle is taken from them, ever less outwards.
        """
        moved = self._deformed(ends)
        turned, shares = self._added(moved, bend).applied(moved), self.shares[:, None]
        missed = self.spread @ self.match.missed(moved, self.carried(ends, cell))
        missed[self.piece.mesh.surface_nodes(SYMMETRY), 1] = 0.0  # they stay in their plane
        bent: Reals = moved + shares * (turned - moved) - (1 - shares) * missed
        return bent

    def joint(self, ends: BodyState, cell: BodyState) -> Motion:
        """The motion of a cell whose bubble's middle meets that of this end."""
        return self._seen(self.match.motion(self._deformed(ends), self.carried(ends, cell)))

    def carried(self, ends: BodyState, cell: BodyState) -> Reals:
        """Where the cell's displacement takes this section's nodes (k, 3), mm, in the cell."""
        return self.match.carried(self._undeformed(ends), cell.nodes, cell.moved)

    def far(self, ends: BodyState, bend: float) -> Motion:
        """How what lies beyond the gap moves, as a rigid body."""
        added = self._added(self._deformed(ends), bend)
        return self._seen(added.after(_of_plane(ends)) if self.free else added)

    def _undeformed(self, ends: BodyState) -> Reals:
        nodes: Reals = self.piece.positions @ ends.nodes
        if self.stub is not None:
            nodes[:, 0] += self.stub.beyond
        return nodes

    def _deformed(self, ends: BodyState) -> Reals:
        """Nodes (n, 3) as solved, mm; a stub behind its section, fading into its plane's motion."""
        moved: Reals = self.piece.positions @ ends.moved
        if self.stub is None:
            return moved
        plane, rigid = _of_plane(ends), self.stub.rigid[:, None]
        normal = Motion(plane.angle).applied(np.array([[1.0, 0.0, 0.0]]))
        behind = moved + self.stub.beyond[:, None] * normal
        faded: Reals = behind + rigid * (plane.applied(self._undeformed(ends)) - behind)
        return faded

    def _seen(self, motion: Motion) -> Motion:
        return motion.mirrored if self.sign < 0 else motion

    def _added(self, moved: Reals, bend: float) -> Motion:
        return Motion.about(self.outward * bend, moved[self.tendon].mean(axis=0))


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
    return Ends(End.of(root, cell, bellows, -1), End.of(tip, cell, bellows, 1))


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
    bellows = design.bellows
    root = max(bellows.first_gap_middle, SHORTEST_STUB)
    tip = max(bellows.length - bellows.bubble_middles[-1] - bellows.pitch / 2, SHORTEST_STUB)
    plug = min(bellows.tendon_thickness, root)
    stubs = with_stub(ends, root - plug, plug, ROOT), with_stub(ends, 0.0, tip, TIP)
    root_end, tip_end = (
        End.of(_piece(stub), cell, bellows, 1, sign, stub)
        for stub, sign in zip(stubs, (-1, 1), strict=True)
    )
    return Ends(root_end, tip_end)


def _piece(stub: Stub) -> Piece:
    """Body and stub, where stress fades out: none was solved for."""
    from scipy.sparse import diags_array

    mesh = stub.mesh.with_surfaces({SECTION: stub.mesh.surfaces[BUBBLE_MIDDLE]})
    return Piece(mesh, stub.weights, (diags_array(1 - stub.rigid) @ stub.weights).tocsr())
