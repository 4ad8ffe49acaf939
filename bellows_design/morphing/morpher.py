"""A mesh of one design moved to its neighbours, and how its nodes move with each parameter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from bellows_design.design.design import Design
from bellows_design.design.topology import same_topology
from bellows_design.design.variation import between, counted, geometric_parameters, varied
from bellows_design.errors import BellowsError, DesignError
from bellows_design.geometry.channel_ends import CHANNEL_ENDS
from bellows_design.morphing.classification import SHALLOW
from bellows_design.morphing.errors import ForeignMesh, MorphFailed, NoNeighbour
from bellows_design.morphing.interior import Interior
from bellows_design.morphing.prediction import predicted
from bellows_design.morphing.primitives import Boxes, boxes_of
from bellows_design.morphing.skin import Skin
from bellows_design.morphing.validity import Elements
from solver import Mesh
from solver.arrays import Reals

MISSED = 1e-9
"""mm. A node farther from its surfaces than this has no place on them."""

STEP = 1e-4
"""mm. Parameters are moved so far either way for a derivative: the nodes then move by a hundred
million times their rounding, and what curvature adds is smaller still."""

HALVINGS = 7
"""Times that the way to a design is halved to say how far along it no element folds."""


@dataclass(frozen=True)
class Morpher:
    """Moves one mesh of a design to other designs whose body has the same faces.

    Attributes:
        design: The design that the mesh is of.
        model: ``unit-cell``, ``half`` or ``full``.
        mesh: The mesh.
        channel_end: Where the channel ends in the last chamber; see ``geometry.actuator``.
        boxes: What bounds the body.
        skin: The surface's nodes.
        stepped: The same with shallow crossings of channel and chambers left to follow the faces
            beside them, for designs whose floors part from being level.
        elements: The tetrahedra, and whether they fold.
        interior: How the other nodes follow them.
    """

    design: Design
    model: str
    mesh: Mesh
    channel_end: float
    boxes: Boxes
    skin: Skin
    stepped: Skin
    elements: Elements
    interior: Interior

    @classmethod
    def of(cls, design: Design, model: str, mesh: Mesh) -> Morpher:
        """Find what surface each node lies on, and factorize how nodes follow each other.

        Raises:
            ForeignMesh: the mesh is none of this body.
        """
        for end in CHANNEL_ENDS:
            boxes = boxes_of(design, model, end)
            try:
                skin = Skin.of(boxes, mesh)
            except ForeignMesh as error:
                reason = error
                continue
            stepped = Skin.of(boxes, mesh, SHALLOW) if boxes.level_floors else skin
            elements = Elements.of(mesh)
            interior = Interior.of(mesh, elements, skin.nodes)
            return cls(design, model, mesh, end, boxes, skin, stepped, elements, interior)
        raise reason

    def mesh_of(self, other: Design) -> Mesh:
        """The mesh of another design: the same tetrahedra and surfaces, moved nodes.

        Nodes of the surface lie on that of the other body, but for mid-nodes that nearly folded an
        element; those stand back, as in any mesh of ``solver.meshing``.

        Raises:
            NoNeighbour: its body has other faces.
            MorphFailed: an element would fold.
        """
        if other == self.design:
            return self.mesh
        nodes, folded = self.elements.unfolded(self.nodes_of(other))
        if folded:
            raise MorphFailed(folded, self._reached(other))
        return self.mesh.moved(nodes)

    def nodes_of(self, other: Design) -> Reals:
        """Nodes (n, 3) of another design, mm, whether elements fold or not.

        Raises :class:`NoNeighbour`.
        """
        change = np.zeros_like(self.mesh.nodes)
        change[self.skin.nodes] = self.boundary_of(other) - self.mesh.nodes[self.skin.nodes]
        return self.mesh.nodes + self.interior.extended(change)

    def boundary_of(self, other: Design) -> Reals:
        """The surface's nodes ``skin.nodes`` of another design, (k, 3) mm.

        Raises :class:`NoNeighbour`.
        """
        difference = same_topology(self.design, other, self.model)
        if difference:
            raise NoNeighbour(difference)
        boxes = boxes_of(other, self.model, self.channel_end)
        skin = self.skin if boxes.level_floors else self.stepped
        points, missed = skin.moved(boxes, predicted(self.boxes, boxes, skin.own))
        if missed > MISSED:
            raise NoNeighbour(f"a node of the mesh misses the body's surfaces by {missed:.2g} mm")
        return points

    def boundary_velocity(self, parameter: str, at: Design | None = None) -> Reals:
        """Derivative of the surface's nodes by a geometric parameter (n, 3), per mm; else zero.

        Fillets that are full rounds follow the parameter. At a bound of the parameter the
        derivative is one-sided; for parameters that ``variation.kinked`` names it is the mean of
        both sides.

        Args:
            parameter: One of ``variation.geometric_parameters``.
            at: The design whose mesh moves; by default the own one.

        Raises:
            DesignError: there is no such parameter, or it can be moved neither way.
            NoNeighbour: ``at`` has other faces than the own design.
        """
        design = counted(at or self.design)
        ahead, behind = (self._beside(design, parameter, step) for step in (STEP, -STEP))
        if ahead is None and behind is None:
            raise DesignError(f"{parameter} can be moved neither way by {STEP:g} mm.")
        sides = 2 - (ahead is None) - (behind is None)
        if sides == 1:
            here = self.boundary_of(design)
            ahead, behind = (here if side is None else side for side in (ahead, behind))
        velocity = np.zeros_like(self.mesh.nodes)
        velocity[self.skin.nodes] = (ahead - behind) / (sides * STEP)
        return velocity

    def velocity(self, parameter: str, at: Design | None = None) -> Reals:
        """Derivative of all nodes by a geometric parameter (n, 3), per mm, as of the surface's."""
        return self.interior.extended(self.boundary_velocity(parameter, at))

    def pulled_back(self, gradient: Reals) -> Reals:
        """Derivatives by the surface's nodes (n, 3) of a function with ``gradient`` (n, 3) by all.

        The nodes inside follow those of the surface linearly, so that for every parameter p
        ``sum(gradient * velocity(p))`` is ``sum(pulled_back(gradient) * boundary_velocity(p))``.
        """
        return self.interior.transposed(gradient)

    def _beside(self, design: Design, parameter: str, step: float) -> Any:
        """The surface's nodes with a parameter so much larger; None if that is no neighbour."""
        values = geometric_parameters(design)
        if parameter not in values:
            raise DesignError(f"{parameter} is no geometric parameter that can be moved alone.")
        try:
            return self.boundary_of(varied(design, {parameter: values[parameter] + step}))
        except BellowsError:
            return None

    def _reached(self, other: Design) -> float:
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if self._can_go(other, middle) else (low, middle)
        return low

    def _can_go(self, other: Design, share: float) -> bool:
        try:
            nodes = self.nodes_of(between(self.design, other, share))
        except BellowsError:
            return False
        return not self.elements.unfolded(nodes)[1]
