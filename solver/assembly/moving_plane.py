"""A section that stays plane while it rotates about y and shifts along x.

Within a uniform chain all cells deform alike, so that the plane of symmetry between two of them
stays plane. Its nodes are at

    x = L + shift + h sin(tilt),   z = h cos(tilt),

L being the plane's initial x and h a node's height in the plane, initially z. The unknowns are the
y and h of each node, and tilt and shift of all of them; the kernels apply the chain rule. Tilts are
positive from z to x, like all rotations here, and must stay below 90 degrees.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.state import State
from solver.mesh.mesh import Mesh
from solver.problem.supports import pin


@dataclass(frozen=True)
class MovingPlane:
    """Nodes (k,) on the plane, their reference positions (k, 3), and the index of the pin."""

    nodes: Integers
    positions: Reals
    pin: int

    @staticmethod
    def of(mesh: Mesh, surface: str) -> MovingPlane:
        """The moving plane called ``surface``."""
        nodes = mesh.surface_nodes(surface)
        return MovingPlane(
            nodes, mesh.nodes[nodes], int(np.searchsorted(nodes, pin(mesh, surface)))
        )

    def heights(self, state: State) -> Reals:
        """h of the nodes on the plane, NaN for all others, (n,), mm."""
        heights = np.full(len(state.displacement), np.nan)
        heights[self.nodes] = self._heights(state)
        return heights

    def linear(self, state: State, increment: State) -> Reals:
        """Displacement (n, 3) of an increment to first order."""
        sine, cosine = np.sin(state.plane[0]), np.cos(state.plane[0])
        rise = increment.displacement[self.nodes, 2]
        turn = self._heights(state) * increment.plane[0]
        result = increment.displacement.copy()
        result[self.nodes, 0] = increment.plane[1] + sine * rise + cosine * turn
        result[self.nodes, 2] = cosine * rise - sine * turn
        return result

    def finite(self, state: State, increment: State, moved: State) -> State:
        """``moved`` with the plane's nodes displaced by the increment from ``state``."""
        heights = self._heights(state) + increment.displacement[self.nodes, 2]
        tilt, shift = plane = state.plane + increment.plane
        displacement = moved.displacement.copy()
        displacement[self.nodes, 0] = shift + heights * np.sin(tilt)
        displacement[self.nodes, 2] = heights * np.cos(tilt) - self.positions[:, 2]
        return State(displacement, moved.hydrostatic_pressure, plane)

    def fitted(self, state: State) -> State:
        """``state`` with tilt and shift fitted, moved along z until the pin has its height."""
        moved = (self.positions + state.displacement[self.nodes])[:, [0, 2]]
        centre = moved.mean(axis=0)
        _, _, axes = np.linalg.svd(moved - centre, full_matrices=False)
        slope = axes[0, 0] / axes[0, 1]
        shift = centre[0] - self.positions[0, 0] - slope * centre[1]
        found = State(
            state.displacement, state.hydrostatic_pressure, np.array([np.arctan(slope), shift])
        )
        rise = (self.positions[self.pin, 2] - self._heights(found)[self.pin]) * np.cos(
            found.plane[0]
        )
        raised = state.displacement + np.array([0.0, 0.0, rise])
        plane = found.plane - np.array([0.0, slope * rise])
        still = State(np.zeros_like(raised), np.zeros(0))
        return self.finite(
            State(raised, np.zeros(0), plane), still, State(raised, state.hydrostatic_pressure)
        )

    def _heights(self, state: State) -> Reals:
        """h (k,) of the plane's nodes."""
        sine, cosine = np.sin(state.plane[0]), np.cos(state.plane[0])
        across = state.displacement[self.nodes, 0] - state.plane[1]
        heights: Reals = sine * across + cosine * (
            self.positions[:, 2] + state.displacement[self.nodes, 2]
        )
        return heights
