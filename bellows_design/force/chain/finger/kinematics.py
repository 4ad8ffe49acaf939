"""Where sections of a chain are, and how that depends on its pieces' motions.

With the angle a of a section, its normal is (cos a, -sin a) and its plane points along
(-sin a, -cos a), the normal's derivative by a. A forward piece moves along both directions of its
start and turns then; a backward one, its mirror image, turns first, and slips the other way.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.force.chain.finger.chain import Chain
from solver.arrays import Reals


def normals(angles: Reals) -> Reals:
    """Normals of sections at ``angles`` (k,): shape (k, 2)."""
    vectors = np.empty((*angles.shape, 2))
    vectors[..., 0], vectors[..., 1] = np.cos(angles), -np.sin(angles)
    return vectors


def tangents(angles: Reals) -> Reals:
    """Derivatives of the normals by the angles: along the sections' planes, shape (k, 2)."""
    vectors = np.empty((*angles.shape, 2))
    vectors[..., 0], vectors[..., 1] = -np.sin(angles), -np.cos(angles)
    return vectors


def turned(vectors: Reals) -> Reals:
    """Vectors (..., 2) turned by a quarter as a normal is turned into its tangent."""
    result = np.empty_like(vectors)
    result[..., 0], result[..., 1] = vectors[..., 1], -vectors[..., 0]
    return result


@dataclass(frozen=True)
class Configuration:
    """Sections of a chain of n pieces under given motions.

    Attributes:
        frames: x, z (mm) and angle (rad) of the sections between which the pieces lie.

            *Shape:* (n + 1, 3).
        centres: points about which a piece's rotation turns all that follows.

            *Shape:* (n, 2).
        directions: of the pieces' extension and of their slip.

            *Shape:* (n, 2, 2).
    """

    frames: Reals
    centres: Reals
    directions: Reals

    @classmethod
    def of(cls, chain: Chain, motions: Reals) -> Configuration:
        """The configuration under ``motions`` (n, 3)."""
        x, z, start = chain.root_frame
        angles = start + np.concatenate([[0.0], np.cumsum(motions[:, 0])])
        along = angles[:-1] + chain.backward * motions[:, 0]
        sense = 1 - 2 * chain.backward
        directions = np.stack([normals(along), sense[:, None] * tangents(along)], axis=1)
        amounts = np.stack([chain.lengths + motions[:, 1], motions[:, 2]], axis=1)
        steps = np.einsum("nk,nkc->nc", amounts, directions)
        root = np.array([x, z]) + chain.root_length * normals(np.array(start))
        places = root + np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
        frames = np.concatenate([places, angles[:, None]], axis=1)
        return cls(frames, places[1:] - chain.backward[:, None] * steps, directions)

    @property
    def jacobian(self) -> Reals:
        """Derivatives of the frames by the motions, shape (n + 1, 3, n, 3)."""
        n = len(self.centres)
        places = self.frames[:, :2]
        behind = (np.arange(n + 1)[:, None] > np.arange(n)).astype(float)
        jacobian = np.zeros((n + 1, 3, n, 3))
        arms = turned(places[:, None] - self.centres)
        jacobian[:, :2, :, 0] = np.moveaxis(behind[:, :, None] * arms, 2, 1)
        jacobian[:, 2, :, 0] = behind
        for which in (0, 1):
            moves = behind[:, None, :] * self.directions[:, which].T
            jacobian[:, :2, :, 1 + which] = moves
        return jacobian

    def curvature(self, chain: Chain, forces: Reals) -> Reals:
        """Second derivatives of Σ ``forces`` · frames by the motions, for x and z forces.

        Args:
            chain: whose configuration it is.
            forces: (n + 1, 2) on the frames.

        Returns:
            Shape (n, 3, n, 3), symmetric.
        """
        n = len(self.centres)
        beyond = np.cumsum(forces[:0:-1], axis=0)[::-1]
        moments = np.cumsum((forces * self.frames[:, :2]).sum(axis=1)[:0:-1])[::-1]
        turning = (beyond * self.centres).sum(axis=1) - moments
        last = np.maximum(np.arange(n)[:, None], np.arange(n))
        before = np.arange(n)[:, None] < np.arange(n) + chain.backward
        whole = np.zeros((n, 3, n, 3))
        whole[:, 0, :, 0] = turning[last]
        for which in (0, 1):
            moving = before * (beyond * turned(self.directions[:, which])).sum(axis=1)
            whole[:, 0, :, 1 + which] = moving
            whole[:, 1 + which, :, 0] = moving.T
        return whole
