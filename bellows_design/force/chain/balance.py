"""Residual and tangent of a loaded chain at given motions, section loads and held forces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.force.chain.contact.forces import (
    ContactForces,
    ContactHistory,
    Pressing,
    contact_forces,
)
from bellows_design.force.chain.finger.kinematics import Configuration
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.surroundings import LoadPoint
from bellows_design.force.section_law import SectionResponse
from solver.arrays import Reals


@dataclass(frozen=True)
class Unknowns:
    """What an equilibrium of n pieces is found for.

    Attributes:
        motions: (n, 3) in rad, mm, mm.
        loads: (n, 3) in N mm, N, N.
        held: x, z and moment at the tip's lower edge (3,) in N, N, N mm.
        pressing: forces of objects.
    """

    motions: Reals
    loads: Reals
    held: Reals
    pressing: Pressing


@dataclass(frozen=True)
class Balance:
    """A chain of n pieces near equilibrium.

    Attributes:
        configuration: of its sections.
        response: of its pieces.
        contact: forces of objects.
        touching: derivative of the touching points' positions by the motions (c, 2, 3 n).
        positions: of the points that objects may touch, relative to the objects (m, 2), mm.
        tip: x, z and angle of the tip's lower edge (3,).
        tip_jacobian: its derivative by the motions (3, 3 n).
        force: minus the derivative of the potential by the motions (3 n,).
        stiffness: second derivative of the potential, unsymmetric with friction (3 n, 3 n).
    """

    configuration: Configuration
    response: SectionResponse
    contact: ContactForces
    touching: Reals
    positions: Reals
    tip: Reals
    tip_jacobian: Reals
    force: Reals
    stiffness: Reals

    @classmethod
    def of(
        cls, loaded: LoadedChain, load: LoadPoint, at: Unknowns, history: ContactHistory
    ) -> Balance:
        """The balance at ``at``, under ``load``, after ``history``.

        Raises:
            BellowsError: The law of a piece does not reach so far.
        """
        chain = loaded.chain
        response = chain.response(load.pressure, at.loads)
        configuration = Configuration.of(chain, at.motions)
        frames, size = configuration.frames, at.motions.size
        by_motions = configuration.jacobian.reshape(len(frames), 3, size)
        positions = loaded.contacts.positions(frames) - load.object_shift
        contact = contact_forces(loaded.obstacles, positions, loaded.widths, history, at.pressing)
        points = loaded.loaded_points(contact.points)
        moved = points.jacobian(frames, by_motions)
        dead = loaded.dead_forces(load)
        dead[-1] += at.held[:2]
        moment = load.forces * loaded.surroundings.tip_moment + at.held[2]
        touched, turned = moved[len(dead) :], by_motions[-1, 2]
        known = np.concatenate([dead, contact.current])
        return cls(
            configuration=configuration,
            response=response,
            contact=contact,
            touching=touched,
            positions=positions,
            tip=np.append(loaded.edge.positions(frames)[0], frames[-1, 2]),
            tip_jacobian=np.concatenate([moved[len(dead) - 1], turned[None]]),
            force=_carried(moved, np.concatenate([dead, contact.force])) + moment * turned,
            stiffness=_pressed(touched, contact.stiffness)
            - points.curvature(chain, configuration, by_motions, known),
        )

    def flexed(self, columns: Reals) -> Reals:
        """The pieces' compliance times ``columns`` (3 n, k)."""
        compliance = self.response.compliance
        blocks = columns.reshape(len(compliance), 3, -1)
        return (compliance @ blocks).reshape(columns.shape)

    @property
    def operator(self) -> Reals:
        """I + C P'' with the compliance C of the pieces, shape (3 n, 3 n)."""
        return np.eye(len(self.force)) + self.flexed(self.stiffness)


def _carried(moved: Reals, forces: Reals) -> Reals:
    """Work of ``forces`` (m, 2) by motions, given the points' derivatives (m, 2, 3 n)."""
    return np.einsum("mcj,mc->j", moved, forces)


def _pressed(moved: Reals, stiffness: Reals) -> Reals:
    """Stiffness of points (m, 2, 2) by motions (3 n, 3 n)."""
    size = moved.shape[2]
    return moved.reshape(-1, size).T @ np.matmul(stiffness, moved).reshape(-1, size)
