"""Forces between points of the finger and rigid objects: a stiff penalty, and Coulomb's friction.

The penalty is the energy k δ²/2 of the penetration δ, with a stiffness k in proportion to the
length of finger that a point stands for. Friction is that of a spring along the surface, as stiff,
that slides where its force exceeds the coefficient times the normal force (Simo & Laursen,
Computers & Structures 42, 1992). It is measured from where the point was at the end of the step
before, also if the point did not touch then.

Normal and friction forces are unknowns of their own, that obey N = k δ and T = k u with the
spring's stretch u: whether a point touches or slides follows from them rather than from gaps of an
iterate (a primal-dual active set; Alart & Curnier, Computer Methods in Applied Mechanics and
Engineering 92, 1991). So an iterate that lifts off a little does not lose its contact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bellows_design.force.chain.contact.model import Obstacles
from bellows_design.force.chain.contact.obstacles import Distance
from bellows_design.force.chain.finger.kinematics import turned
from solver.arrays import Reals

SOFTNESS = 0.1
"""N/mm: how much of a gap weighs up how much of a force as it is decided whether a point touches or
slides. Any positive value leads to the same equilibria."""


@dataclass(frozen=True)
class Pressing:
    """Normal forces and friction forces between objects and the m points, each (objects, m), N."""

    normal: Reals
    friction: Reals

    @classmethod
    def none(cls, objects: int, points: int) -> Pressing:
        """No forces."""
        return cls(np.zeros((objects, points)), np.zeros((objects, points)))


@dataclass(frozen=True)
class ContactHistory:
    """What contact knows of the end of the step before.

    Attributes:
        positions: of the m points relative to the objects (m, 2), mm.
        stretch: of friction's springs to each of the objects (objects, m), mm.
        pressing: forces.
    """

    positions: Reals
    stretch: Reals
    pressing: Pressing


@dataclass(frozen=True)
class ContactForces:
    """Those c pairs of points and objects that touch.

    Attributes:
        points: numbers of the points (c,).
        objects: numbers of the objects (c,).
        normal: normal forces that belong to the positions (c,), N.
        friction: friction forces that do (c,), N.
        normal_by_position: derivative of ``normal`` (c, 2), N/mm.
        friction_by_position: derivative of ``friction`` (c, 2), N/mm.
        force: both together on the points (c, 2), N.
        current: the same for the unknown forces (c, 2), N.
        stiffness: minus the derivative of ``force`` by the position (c, 2, 2), N/mm.
        sticks: which ones friction holds (c,).
        energy: of penetrations and springs, N mm.
    """

    points: NDArray[np.int64]
    objects: NDArray[np.int64]
    normal: Reals
    friction: Reals
    normal_by_position: Reals
    friction_by_position: Reals
    force: Reals
    current: Reals
    stiffness: Reals
    sticks: NDArray[np.bool_]
    energy: Reals

    def pressing(self, shape: tuple[int, int], moved: Reals | None = None) -> Pressing:
        """The forces (objects, m), once the touching points have ``moved`` (c, 2) further."""
        forces = Pressing.none(*shape)
        way = np.zeros((len(self.points), 2)) if moved is None else moved
        at = self.objects, self.points
        forces.normal[at] = self.normal + (self.normal_by_position * way).sum(axis=1)
        forces.friction[at] = self.friction + (self.friction_by_position * way).sum(axis=1)
        return forces


def contact_forces(
    obstacles: Obstacles,
    positions: Reals,
    widths: Reals,
    history: ContactHistory,
    pressing: Pressing,
) -> ContactForces:
    """Forces on points at ``positions`` (m, 2) relative to the objects, mm.

    Args:
        obstacles: what they may touch.
        positions: of the points, less the shift of the objects.
        widths: length of finger that every point stands for (m,), mm.
        history: of the step before.
        pressing: the unknown forces.
    """
    parts = [
        _against(obstacles, number, positions, widths, history, pressing)
        for number in range(len(obstacles.objects))
    ]
    if not parts:
        return NO_CONTACT
    names = vars(parts[0])
    return ContactForces(**{name: np.concatenate([vars(p)[name] for p in parts]) for name in names})


_NONE, _NO_NUMBERS, _NO_VECTORS = np.zeros(0), np.zeros(0, np.int64), np.zeros((0, 2))
NO_CONTACT = ContactForces(
    points=_NO_NUMBERS,
    objects=_NO_NUMBERS,
    normal=_NONE,
    friction=_NONE,
    normal_by_position=_NO_VECTORS,
    friction_by_position=_NO_VECTORS,
    force=_NO_VECTORS,
    current=_NO_VECTORS,
    stiffness=np.zeros((0, 2, 2)),
    sticks=np.zeros(0, np.bool_),
    energy=_NONE,
)


@dataclass(frozen=True)
class _Touching:
    """Points that touch an object.

    Their distance, stiffness, known normal force, that with the gap weighed up, known friction
    force, way since the step before, and the spring's stretch then.
    """

    near: Distance
    stiffness: Reals
    known: Reals
    weighed: Reals
    pulled: Reals
    moved: Reals
    stretch: Reals


def _against(
    obstacles: Obstacles,
    number: int,
    positions: Reals,
    widths: Reals,
    history: ContactHistory,
    pressing: Pressing,
) -> ContactForces:
    """Forces of one object."""
    obstacle, known = obstacles.objects[number], pressing.normal[number]
    stiffness = obstacles.model.stiffness * widths
    weighed = known - SOFTNESS * (obstacle.gap(positions) + known / stiffness)
    points = np.flatnonzero(weighed > 0)
    touching = _Touching(
        near=obstacle.distance(positions[points]),
        stiffness=stiffness[points],
        known=known[points],
        weighed=weighed[points],
        pulled=pressing.friction[number, points],
        moved=positions[points] - history.positions[points],
        stretch=history.stretch[number, points],
    )
    return _forces(points, number, touching, _friction(obstacles.friction, touching))


def _forces(
    points: NDArray[np.int64], number: int, touching: _Touching, drag: _Drag
) -> ContactForces:
    """Forces on ``points`` that touch the object of that number."""
    near, known, pulled = touching.near, touching.known[:, None], touching.pulled[:, None]
    outwards, along = near.gradient, turned(near.gradient)
    normal = -touching.stiffness * near.value
    by_position = -touching.stiffness[:, None] * outwards
    return ContactForces(
        points=points,
        objects=np.full(len(points), number),
        normal=normal,
        friction=drag.force,
        normal_by_position=by_position,
        friction_by_position=drag.by_position,
        force=normal[:, None] * outwards - drag.force[:, None] * along,
        current=known * outwards - pulled * along,
        stiffness=_products(along, drag.by_position)
        - _products(outwards, by_position)
        - known[:, None] * near.hessian
        + pulled[:, None] * _turning(near),
        sticks=drag.sticks,
        energy=0.5 * (normal**2 + drag.force**2) / touching.stiffness,
    )


@dataclass(frozen=True)
class _Drag:
    """Friction forces against motion along the surface, and their derivative by the position."""

    force: Reals
    by_position: Reals
    sticks: NDArray[np.bool_]


def _friction(coefficient: float, touching: _Touching) -> _Drag:
    """Friction on points that touch."""
    near, stiffness = touching.near, touching.stiffness
    if not coefficient:
        none = np.zeros(len(stiffness))
        return _Drag(none, np.zeros((len(none), 2)), np.zeros(len(none), np.bool_))
    along = turned(near.gradient)
    stretch = touching.stretch + (touching.moved * along).sum(axis=1)
    trial = touching.pulled + SOFTNESS * (stretch - touching.pulled / stiffness)
    sticks = np.abs(trial) <= coefficient * touching.weighed
    share = coefficient * np.sign(trial)
    held = along + np.einsum("cij,ci->cj", _turning(near), touching.moved)
    slid = -share[:, None] * near.gradient
    return _Drag(
        stiffness * np.where(sticks, stretch, -share * near.value),
        stiffness[:, None] * np.where(sticks[:, None], held, slid),
        sticks,
    )


def _turning(near: Distance) -> Reals:
    """Derivative of the direction along the surface by the position (c, 2, 2)."""
    return turned(near.hessian.swapaxes(1, 2)).swapaxes(1, 2)


def _products(first: Reals, second: Reals) -> Reals:
    """Dyads of vectors (c, 2)."""
    return first[:, :, None] * second[:, None]
