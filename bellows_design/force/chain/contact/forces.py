"""Forces between points of the finger and rigid objects: a smooth penalty, and Coulomb's friction.

The penalty is the energy w φ(δ) of the penetration δ, with w the length of finger that a point
stands for: φ'' rises from 0 to the stiffness within the onset, and stays. Friction is that of an
elastic spring along the surface, as stiff as the penalty, that slides where its force exceeds the
coefficient times the normal force: return mapping between steps (Simo & Laursen, Computers &
Structures 42, 1992).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.force.chain.contact.model import ContactModel
from bellows_design.force.chain.contact.obstacles import Distance, Obstacle
from bellows_design.force.chain.finger.kinematics import turned
from solver.arrays import Reals


@dataclass(frozen=True)
class Obstacles:
    """What points may touch: rigid objects, Coulomb's coefficient of friction, and how stiffly."""

    objects: tuple[Obstacle, ...]
    friction: float
    model: ContactModel


@dataclass(frozen=True)
class SlipHistory:
    """Where friction's springs were at the end of the step before.

    Attributes:
        positions: of the m points relative to the objects, mm.

            *Shape:* (m, 2).
        stretch: of the springs to each of the objects, mm.

            *Shape:* (objects, m).
    """

    positions: Reals
    stretch: Reals


@dataclass(frozen=True)
class ContactForces:
    """Forces on those c pairs of points and objects that touch.

    Attributes:
        points: numbers of the points (c,).
        objects: numbers of the objects (c,).
        force: on the points (c, 2), N.
        stiffness: minus the derivative of ``force`` by the position (c, 2, 2), N/mm.
        normal_force: not negative (c,), N.
        sticks: which ones friction holds (c,).
        stretch: of friction's springs (c,), mm.
        energy: of penetrations and springs, N mm.
    """

    points: NDArray[np.int64]
    objects: NDArray[np.int64]
    force: Reals
    stiffness: Reals
    normal_force: Reals
    sticks: NDArray[np.bool_]
    stretch: Reals
    energy: float

    def history(self, positions: Reals, object_count: int) -> SlipHistory:
        """What the next step has to know, with the points' ``positions`` relative to objects."""
        stretch = np.zeros((object_count, len(positions)))
        stretch[self.objects, self.points] = self.stretch
        return SlipHistory(positions, stretch)


def contact_forces(
    obstacles: Obstacles, positions: Reals, widths: Reals, history: SlipHistory
) -> ContactForces:
    """Forces on points at ``positions`` (m, 2) relative to the objects, mm.

    Args:
        obstacles: what they may touch.
        positions: of the points, less the shift of the objects.
        widths: length of finger that every point stands for (m,), mm.
        history: of friction.
    """
    parts = [
        _against(obstacles, number, positions, widths, history)
        for number in range(len(obstacles.objects))
    ]
    if not parts:
        return NO_CONTACT
    names = ("points", "objects", "force", "stiffness", "normal_force", "sticks", "stretch")
    joined = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
    return ContactForces(**joined, energy=sum(part.energy for part in parts))


NO_CONTACT = ContactForces(
    points=np.zeros(0, np.int64),
    objects=np.zeros(0, np.int64),
    force=np.zeros((0, 2)),
    stiffness=np.zeros((0, 2, 2)),
    normal_force=np.zeros(0),
    sticks=np.zeros(0, np.bool_),
    stretch=np.zeros(0),
    energy=0.0,
)


def _against(
    obstacles: Obstacles,
    number: int,
    positions: Reals,
    widths: Reals,
    history: SlipHistory,
) -> ContactForces:
    """Forces of one object."""
    distance = obstacles.objects[number].distance(positions)
    points = np.flatnonzero(distance.value < 0)
    near = Distance(*(values[points] for values in vars(distance).values()))
    stiffness = obstacles.model.stiffness * widths[points]
    energy, normal, slope = _penalty(obstacles.model, stiffness, -near.value)
    outwards = near.gradient
    force = normal[:, None] * outwards
    tangent = slope[:, None, None] * _products(outwards, outwards)
    tangent -= normal[:, None, None] * near.hessian
    sticks, stretch = np.zeros(len(points), np.bool_), np.zeros(len(points))
    if obstacles.friction:
        moved = positions[points] - history.positions[points]
        trial = history.stretch[number, points] + (moved * turned(outwards)).sum(axis=1)
        limit = obstacles.friction * normal / stiffness
        sticks = np.abs(trial) <= limit
        stretch = np.where(sticks, trial, np.sign(trial) * limit)
        along, by_position = _friction(
            obstacles.friction, near, moved, stiffness, stretch, slope, sticks
        )
        force += along
        tangent += by_position
        energy += 0.5 * stiffness * stretch**2
    return ContactForces(
        points,
        np.full(len(points), number),
        force,
        tangent,
        normal,
        sticks,
        stretch,
        float(energy.sum()),
    )


def _penalty(model: ContactModel, stiffness: Reals, depth: Reals) -> tuple[Reals, Reals, Reals]:
    """Energy, force and its slope at penetrations ``depth`` >= 0."""
    onset = model.onset
    beyond = depth >= onset
    energy = np.where(beyond, depth**2 / 2 - onset * depth / 2 + onset**2 / 6, depth**3 / 6 / onset)
    force = np.where(beyond, depth - onset / 2, depth**2 / 2 / onset)
    slope = np.where(beyond, 1.0, depth / onset)
    return stiffness * energy, stiffness * force, stiffness * slope


def _friction(
    friction: float,
    near: Distance,
    moved: Reals,
    stiffness: Reals,
    stretch: Reals,
    slope: Reals,
    sticks: NDArray[np.bool_],
) -> tuple[Reals, Reals]:
    """Force along the surface, and minus its derivative by the position."""
    along = turned(near.gradient)
    turning = turned(np.swapaxes(near.hessian, 1, 2)).swapaxes(1, 2)
    sticking = stiffness[:, None] * (along + np.einsum("cij,ci->cj", turning, moved))
    sliding = (-friction * np.sign(stretch) * slope)[:, None] * near.gradient
    by_position = np.where(sticks[:, None], sticking, sliding)
    pull = stiffness * stretch
    return -pull[:, None] * along, _products(along, by_position) + pull[:, None, None] * turning


def _products(first: Reals, second: Reals) -> Reals:
    """Dyads of vectors (c, 2)."""
    return first[:, :, None] * second[:, None]
