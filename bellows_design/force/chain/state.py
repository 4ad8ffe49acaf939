"""Equilibria of a chain, as records."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.force.chain.contact.forces import ContactHistory
from bellows_design.force.chain.surroundings import LoadPoint
from solver.arrays import Reals


@dataclass(frozen=True)
class ContactPoint:
    """What an object exerts on the finger at one point of its lower side, full width.

    Attributes:
        place: distance of the point from the root along the undeformed finger, mm.
        position: x and z of the point, mm.
        force: x and z components on the finger, N.
        normal_force: its part normal to the object, N, not negative.
        sticks: whether friction holds the point where it is; False without friction.
        object_index: number of the object among those of the surroundings.
    """

    place: float
    position: tuple[float, float]
    force: tuple[float, float]
    normal_force: float
    sticks: bool
    object_index: int


@dataclass(frozen=True)
class ChainState:
    """An equilibrium of a chain of n pieces.

    Attributes:
        pressure: MPa.
        motions: rotation, extension and slip of every piece, from root to tip.

            *Shape:* (n, 3) in rad, mm, mm.
        loads: section loads of every piece, full width.

            *Shape:* (n, 3) in N mm, N, N.
        frames: x, z and angle of every section from the root's face to the tip's; an angle is that
            of the section's normal, positive from +x towards -z, past a full turn.

            *Shape:* (n + 3, 3) in mm, mm, rad: root face, end of the root's stub, every piece's
            end, tip face.
        contacts: points where objects press against the finger.
        held_force: x, z (N) and moment about y at the tip's lower edge (N mm) that hold the tip,
            zeros where it is free.
        stable: whether it is stable under its loads.
        stored_energy: of the pieces: what pressure and section loads have put into them, N mm.
        contact_energy: in the penetration of contacts, N mm.
        iterations: of Newton's method on the way from the state before.
        volume: of the air in all pieces, mm^3.
        margin: least eigenvalue of I + C P'', with the pieces' compliance C and the loads' and
            contacts' potential P, among motions that the hold allows: how far from a loss of
            stability. One without loads, negative where unstable.
        tip_stiffness: force by displacement along z at the tip's lower edge, N/mm: what a load cell
            there finds as it is moved. Infinite where the tip cannot move.
        load: how much of the loads acts.
        history: what contact knows of this state.
    """

    pressure: float
    motions: Reals
    loads: Reals
    frames: Reals
    contacts: tuple[ContactPoint, ...]
    held_force: tuple[float, float, float]
    stable: bool
    stored_energy: float
    contact_energy: float
    iterations: int
    volume: float
    margin: float
    tip_stiffness: float
    load: LoadPoint
    history: ContactHistory

    @property
    def tip(self) -> tuple[float, float, float]:
        """x and z of the tip's lower edge (mm) and angle of its face (rad)."""
        x, z, angle = self.frames[-1]
        return float(x), float(z), float(angle)

    @property
    def contact_force(self) -> tuple[float, float]:
        """Sum of the objects' forces on the finger, x and z in N."""
        forces = [point.force for point in self.contacts]
        return sum(x for x, _ in forces), sum(z for _, z in forces)
