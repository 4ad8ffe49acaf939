"""A mesh of one design moved to its neighbours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from bellows_design.design.design import Design
from bellows_design.design.variation import between, same_topology, varied
from bellows_design.errors import BellowsError, DesignError
from bellows_design.geometry.actuator import CHANNEL_ENDS
from bellows_design.morphing.errors import MorphFailed, NoNeighbour
from bellows_design.morphing.extension import Extension, extension, simplex_stiffness
from bellows_design.morphing.prediction import predicted
from bellows_design.morphing.primitives import Boxes, boxes_of
from bellows_design.morphing.skin import Skin
from solver import Mesh
from solver.arrays import Reals
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios

MISSED = 1e-9
"""mm. Farther from its surfaces than this, a node was not found a place on them."""

STEP = 1e-5
"""mm. Half of the difference in a parameter that velocities are taken from."""

HALVINGS = 7
"""Times that the way to a design is halved to say how far along it no element folds."""


@dataclass(frozen=True)
class Interior:
    """How the nodes inside follow those on the surface: linearly.

    ``at_vertices`` extends harmonically among the tetrahedra's vertices; ``middles`` (j,) are
    mid-nodes inside, each moving by the mean of ``ends`` (j, 2).
    """

    at_vertices: Extension
    middles: np.ndarray
    ends: np.ndarray

    @classmethod
    def of(cls, mesh: Mesh, surface: np.ndarray) -> Interior:
        on_surface = np.zeros(len(mesh.nodes), bool)
        on_surface[surface] = True
        vertex = np.zeros_like(on_surface)
        vertex[mesh.vertices] = True
        stiffness = simplex_stiffness(mesh.nodes, mesh.tets[:, :4])
        numbers = mesh.tets[:, 4:].ravel()
        middles, first = np.unique(numbers, return_index=True)
        ends = mesh.tets[:, TETRAHEDRON_EDGES].reshape(-1, 2)[first]
        inside = ~on_surface[middles]
        return cls(extension(stiffness, on_surface & vertex, vertex), middles[inside], ends[inside])

    def extended(self, change: Reals) -> Reals:
        """The changes of all nodes (n, 3), from those on the surface."""
        filled = self.at_vertices(change)
        filled[self.middles] = filled[self.ends].mean(axis=1)
        return filled

    def transposed(self, gradient: Reals) -> Reals:
        """Derivatives by the surface's nodes (n, 3), of a function with ``gradient`` by all."""
        pulled = gradient.copy()
        for end in self.ends.T:
            np.add.at(pulled, end, gradient[self.middles] / 2)
        pulled[self.middles] = 0.0
        return self.at_vertices.transposed(pulled)


@dataclass(frozen=True)
class Morpher:
    """Moves one mesh of a design to other designs whose body has the same faces.

    Attributes:
        design: The design that the mesh is of.
        model: ``unit-cell``, ``half`` or ``full``.
        mesh: The mesh.
    """

    design: Design
    model: str
    mesh: Mesh
    channel_end: float
    boxes: Boxes
    skin: Skin
    interior: Interior

    @classmethod
    def of(cls, design: Design, model: str, mesh: Mesh) -> Morpher:
        """Find what surface each node lies on, and factorize how the others follow.

        Raises:
            BellowsError: the mesh is none of this body.
        """
        for end in CHANNEL_ENDS:
            boxes = boxes_of(design, model, end)
            try:
                skin = Skin.of(boxes, mesh)
            except BellowsError as error:
                reason = error
                continue
            return cls(design, model, mesh, end, boxes, skin, Interior.of(mesh, skin.nodes))
        raise reason

    def mesh_of(self, other: Design) -> Mesh:
        """The mesh of another design: the same tetrahedra and surfaces, moved nodes.

        Raises:
            NoNeighbour: its body has other faces.
            MorphFailed: an element would fold.
        """
        if other == self.design:
            return self.mesh
        nodes = self._nodes_of(other)
        folded = _folded(nodes, self.mesh)
        if folded:
            raise MorphFailed(folded, self._reached(other))
        return Mesh(nodes, self.mesh.tets, self.mesh.surfaces)

    def boundary_of(self, other: Design) -> Reals:
        """Where the surface's nodes (k, 3) lie on another design, mm; see ``skin.nodes``.

        Raises :class:`NoNeighbour`.
        """
        difference = same_topology(self.design, other)
        if difference:
            raise NoNeighbour(difference)
        boxes = boxes_of(other, self.model, self.channel_end)
        start = predicted(self.boxes, boxes, self.skin.own)
        points, missed = self.skin.moved(self.boxes, boxes, start)
        if missed > MISSED:
            raise NoNeighbour(f"a node misses its surfaces by {missed:.2g} mm")
        return points

    def boundary_velocity(self, parameter: str) -> Reals:
        """Derivative of the surface's nodes by a parameter (n, 3), per mm; zero elsewhere."""
        value = _value(self.design, parameter)
        step = STEP
        ahead, behind = (
            self.boundary_of(varied(self.design, {parameter: value + sign * step}))
            for sign in (1, -1)
        )
        velocity = np.zeros_like(self.mesh.nodes)
        velocity[self.skin.nodes] = (ahead - behind) / (2 * step)
        return velocity

    def velocity(self, parameter: str) -> Reals:
        """Derivative of all nodes by a geometric parameter (n, 3), per mm."""
        return self.interior.extended(self.boundary_velocity(parameter))

    def pulled_back(self, gradient: Reals) -> Reals:
        """Derivatives by the surface's nodes (n, 3) of a function with ``gradient`` (n, 3) by all.

        Nodes inside follow: ``sum(gradient * velocity(p))`` is ``sum(pulled_back(gradient) *
        boundary_velocity(p))``.
        """
        return self.interior.transposed(gradient)

    def _nodes_of(self, other: Design) -> Reals:
        change = np.zeros_like(self.mesh.nodes)
        surface = self.skin.nodes
        change[surface] = self.boundary_of(other) - self.mesh.nodes[surface]
        return self.mesh.nodes + self.interior.extended(change)

    def _reached(self, other: Design) -> float:
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if self._can_go(other, middle) else (low, middle)
        return low

    def _can_go(self, other: Design, share: float) -> bool:
        try:
            nodes = self._nodes_of(between(self.design, other, share))
        except (DesignError, NoNeighbour):
            return False
        return not _folded(nodes, self.mesh)


def _value(design: Design, parameter: str) -> float:
    from bellows_design.design.variation import parameters

    return parameters(design)[parameter]


def _folded(nodes: Reals, mesh: Mesh) -> str:
    """Which element is folded worst, and where; empty without any."""
    ratios = jacobian_ratios(nodes, mesh.tets)
    worst = int(ratios.argmin())
    if ratios[worst] >= SMALLEST_RATIO:
        return ""
    x, y, z = nodes[mesh.tets[worst, :4]].mean(axis=0)
    return (
        f"tetrahedron {worst} near ({x:.2f}, {y:.2f}, {z:.2f}) mm would fold (Jacobian ratio "
        f"{ratios[worst]:.2g})"
    )
