"""Between unknowns and nodes: directions of the body, forces on the unknowns.

The derivatives of a response are taken at fixed unknowns and added to what the unknowns' own change
gives. At fixed unknowns nodes keep their displacements while the mesh moves; those on a moving
plane (``solver.assembly.moving_plane``) keep what their height h has gained since the beginning, so
that a velocity V of the mesh makes h' = V_z, and with the tilt t

    u' = (sin t V_z, 0, (cos t - 1) V_z).

The height of the plane's pin, which is given, changes in the same way.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Reals
from solver.assembly.assembly import Assembly
from solver.assembly.state import State


@dataclass(frozen=True)
class Direction:
    """A direction of the unknowns: of displacements (n, 3), pressures (v,) and the plane (2,)."""

    displacement: Reals
    hydrostatic_pressure: Reals
    plane: Reals

    @staticmethod
    def of(assembly: Assembly, state: State, vector: Reals) -> Direction:
        """A vector over the unknowns (m,) as a direction at ``state``."""
        change = State(*assembly.numbering.expand(vector))
        plane = assembly.plane
        linear = change.displacement if plane is None else plane.linear(state, change)
        pressure = np.ascontiguousarray(change.hydrostatic_pressure)
        return Direction(np.ascontiguousarray(linear), pressure, change.plane)


def gathered(assembly: Assembly, state: State, forces: Reals) -> Reals:
    """Derivatives by displacements (n, 3) as derivatives by the unknowns (m,)."""
    plane = assembly.plane
    if plane is None:
        return assembly.numbering.gather(forces)
    sine, cosine = np.sin(state.plane[0]), np.cos(state.plane[0])
    along, up = forces[plane.nodes, 0], forces[plane.nodes, 2]
    local = forces.copy()
    local[plane.nodes, 2] = sine * along + cosine * up
    vector = assembly.numbering.gather(local)
    heights = plane.heights(state)[plane.nodes]
    turning = float((heights * (cosine * along - sine * up)).sum())
    vector[assembly.numbering.plane] += np.array([turning, along.sum()])
    return vector


def carried(assembly: Assembly, state: State, by_displacement: Reals) -> Reals:
    """Derivatives (n, 3) by positions through displacements that change at fixed unknowns."""
    result, plane = np.zeros_like(by_displacement), assembly.plane
    if plane is not None:
        sine, cosine = np.sin(state.plane[0]), np.cos(state.plane[0])
        given = by_displacement[plane.nodes]
        result[plane.nodes, 2] = sine * given[:, 0] + (cosine - 1) * given[:, 2]
    return result


def turned(assembly: Assembly, state: State, direction: Direction, forces: Reals) -> Reals:
    """Derivatives (n, 3) by positions of the work of nodal ``forces`` (n, 3) along a direction.

    On the moving plane a direction that tilts moves nodes in proportion to their heights.
    """
    result, plane = np.zeros_like(forces), assembly.plane
    if plane is not None:
        sine, cosine = np.sin(state.plane[0]), np.cos(state.plane[0])
        given = forces[plane.nodes]
        result[plane.nodes, 2] = direction.plane[0] * (cosine * given[:, 0] - sine * given[:, 2])
    return result


def moved(assembly: Assembly, state: State, vector: Reals) -> State:
    """The state after a change of all unknowns (m,)."""
    change = State(*assembly.numbering.expand(vector))
    added = State(
        state.displacement + change.displacement,
        state.hydrostatic_pressure + change.hydrostatic_pressure,
    )
    return added if assembly.plane is None else assembly.plane.finite(state, change, added)
