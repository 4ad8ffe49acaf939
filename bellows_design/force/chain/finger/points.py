"""Material points of a chain: where they are, and how that depends on the motions.

Between two sections the lower side is a cubic that leaves either along its normal (Hermite); a
section at fraction t of the piece's length is turned by fraction t of its rotation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.errors import BellowsError
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.finger.kinematics import Configuration, normals, tangents
from solver.arrays import Reals

Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Points:
    """m points, each of which moves with two frames.

    Attributes:
        places: along the undeformed finger (m,), mm.
        frames: numbers of the two frames (m, 2).
        shares: with which their origins count (m, 2).
        reaches: with which their normals count (m, 2), mm.
        turns: with which their angles count (m, 2).
        heights: above the lower side (m,), mm.
    """

    places: Reals
    frames: Indices
    shares: Reals
    reaches: Reals
    turns: Reals
    heights: Reals

    @classmethod
    def of(cls, chain: Chain, places: Reals, heights: Reals | float = 0.0) -> Points:
        """Points at ``places`` (m,) along the finger and ``heights`` above its lower side, mm.

        Raises:
            BellowsError: A place is not on the finger.
        """
        places = np.asarray(places, dtype=float)
        outside = places[(places < -1e-9) | (places > chain.length + 1e-9)]
        if outside.size:
            raise BellowsError(
                f"place = {outside[0]:g} mm is not on the finger, which is {chain.length:g} mm long"
            )
        last = len(chain.pieces)
        piece = np.clip(np.searchsorted(chain.joints, places, side="right") - 1, 0, last)
        inside = (places >= chain.joints[0]) & (piece < last)
        length = np.where(inside, np.append(chain.lengths, 1.0)[piece], 1.0)
        ahead = places - chain.joints[piece]
        t = np.where(inside, ahead / length, 0.0)
        share = t**2 * (3 - 2 * t)
        leaving = np.where(inside, length * t * (1 - t) ** 2, ahead)
        arriving = -length * t**2 * (1 - t)
        return cls(
            places,
            np.stack([piece, np.minimum(piece + 1, last)], axis=1),
            np.stack([1 - share, share], axis=1),
            np.stack([leaving, arriving], axis=1),
            np.stack([1 - t, t], axis=1),
            np.broadcast_to(np.asarray(heights, dtype=float), places.shape),
        )

    def __getitem__(self, which: Indices) -> Points:
        return Points(*(values[which] for values in vars(self).values()))

    def positions(self, frames: Reals) -> Reals:
        """x and z (m, 2) of the points under ``frames`` (n + 1, 3)."""
        both = frames[self.frames]
        place = np.einsum("mk,mkc->mc", self.shares, both[:, :, :2])
        place += np.einsum("mk,mkc->mc", self.reaches, normals(both[:, :, 2]))
        up = -tangents((self.turns * both[:, :, 2]).sum(axis=1))
        return place + self.heights[:, None] * up

    def jacobian(self, frames: Reals, by_motions: Reals) -> Reals:
        """Derivatives of the positions (m, 2, 3 n), given those of the frames (n + 1, 3, 3 n)."""
        both = frames[self.frames]
        ahead = normals((self.turns * both[:, :, 2]).sum(axis=1))
        by_angle = self.reaches[:, :, None] * tangents(both[:, :, 2])
        by_angle += (self.heights[:, None] * self.turns)[:, :, None] * ahead[:, None]
        motion = by_motions[self.frames]
        moved = np.einsum("mk,mkcj->mcj", self.shares, motion[:, :, :2])
        return moved + np.einsum("mkc,mkj->mcj", by_angle, motion[:, :, 2])

    def curvature(
        self, chain: Chain, configuration: Configuration, by_motions: Reals, forces: Reals
    ) -> Reals:
        """Second derivatives (3 n, 3 n) of Σ ``forces`` · positions by the motions.

        Args:
            chain: whose points they are.
            configuration: of the chain.
            by_motions: derivatives of the frames (n + 1, 3, 3 n).
            forces: (m, 2), N.
        """
        frames = configuration.frames
        both = frames[self.frames]
        carried = np.zeros((len(frames), 2))
        np.add.at(carried, self.frames, self.shares[:, :, None] * forces[:, None])
        of_angles = np.zeros((len(frames), len(frames)))
        bending = -self.reaches * np.einsum("mc,mkc->mk", forces, normals(both[:, :, 2]))
        np.add.at(of_angles, (self.frames, self.frames), bending)
        beside = tangents((self.turns * both[:, :, 2]).sum(axis=1))
        lifting = self.heights * (forces * beside).sum(axis=1)
        products = self.turns[:, :, None] * self.turns[:, None] * lifting[:, None, None]
        np.add.at(of_angles, (self.frames[:, :, None], self.frames[:, None]), products)
        size = 3 * len(chain.pieces)
        whole = configuration.curvature(chain, carried).reshape(size, size)
        angles = by_motions[:, 2]
        return whole + angles.T @ of_angles @ angles
