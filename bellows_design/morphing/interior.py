"""How the nodes inside of a mesh follow those on its surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bellows_design.morphing.extension import Extension, extension, simplex_stiffness
from bellows_design.morphing.primitives import Indices
from bellows_design.morphing.validity import Elements
from solver import Mesh
from solver.arrays import Reals


@dataclass(frozen=True)
class Interior:
    """How the nodes inside follow those on the surface: linearly.

    ``at_vertices`` extends harmonically among the tetrahedra's vertices; ``middles`` (j,) are
    mid-nodes inside, each moving by the mean of ``ends`` (j, 2).
    """

    at_vertices: Extension
    middles: Indices
    ends: Indices

    @classmethod
    def of(cls, mesh: Mesh, elements: Elements, surface: Indices) -> Interior:
        on_surface = np.zeros(len(mesh.nodes), bool)
        on_surface[surface] = True
        vertex = np.zeros_like(on_surface)
        vertex[mesh.vertices] = True
        stiffness = simplex_stiffness(mesh.nodes, mesh.tets[:, :4])
        inside = ~on_surface[elements.middles]
        follow = extension(stiffness, on_surface & vertex, vertex)
        return cls(follow, elements.middles[inside], elements.ends[inside])

    def extended(self, change: Reals) -> Reals:
        """The changes of all nodes (n, 3), from those on the surface."""
        filled = self.at_vertices(change)
        one, two = self.ends.T
        filled[self.middles] = (filled[one] + filled[two]) / 2
        return filled

    def transposed(self, gradient: Reals) -> Reals:
        """Derivatives by the surface's nodes (n, 3), of a function with ``gradient`` by all."""
        pulled = gradient.copy()
        for end in self.ends.T:
            np.add.at(pulled, end, gradient[self.middles] / 2)
        pulled[self.middles] = 0.0
        return self.at_vertices.transposed(pulled)
