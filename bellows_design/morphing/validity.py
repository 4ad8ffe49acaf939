"""Elements of a morphed mesh: none may fold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver import Mesh
from solver.arrays import Integers, Reals
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios, relaxed

STRAIGHT = 1e-12
"""mm. Mid-nodes nearer to the middles of their edges make no element curved."""


@dataclass(frozen=True)
class Elements:
    """Tetrahedra ``tets`` (e, 10); their mid-nodes ``middles`` (j,) between ``ends`` (j, 2)."""

    tets: Integers
    middles: Integers
    ends: Integers

    @classmethod
    def of(cls, mesh: Mesh) -> Elements:
        middles, first = np.unique(mesh.tets[:, 4:], return_index=True)
        ends = mesh.tets[:, TETRAHEDRON_EDGES].reshape(-1, 2)[first]
        return cls(mesh.tets, middles, ends)

    def unfolded(self, nodes: Reals) -> tuple[Reals, str]:
        """The nodes (n, 3) with mid-nodes of nearly folded elements moved back; what folds yet.

        As in a mesh that is new, mid-nodes leave their surface only where elements need it. The
        second is empty if no element is folded.
        """
        volumes = self._volumes(nodes)
        if volumes.min() <= 0:
            return nodes, self._sentence(nodes, int(volumes.argmin()), -1.0)
        curved = self._curved(nodes)
        ratios = jacobian_ratios(nodes, self.tets[curved])
        if ratios.min(initial=1.0) >= SMALLEST_RATIO:
            return nodes, ""
        nodes = relaxed(nodes, self.tets[curved])
        ratios = jacobian_ratios(nodes, self.tets[curved])
        worst = int(ratios.argmin())
        if ratios[worst] >= SMALLEST_RATIO:
            return nodes, ""
        return nodes, self._sentence(nodes, int(curved[worst]), float(ratios[worst]))

    def _volumes(self, nodes: Reals) -> Reals:
        """Six times the volumes of the tetrahedra with straight edges, (e,), mm³."""
        a, b, c, d = (nodes[corner] for corner in self.tets[:, :4].T)
        u, v, w = (b - a).T, (c - a).T, (d - a).T
        volumes: Reals = u[0] * (v[1] * w[2] - v[2] * w[1])
        volumes += u[1] * (v[2] * w[0] - v[0] * w[2])
        volumes += u[2] * (v[0] * w[1] - v[1] * w[0])
        return volumes

    def _curved(self, nodes: Reals) -> Integers:
        """The tetrahedra that have a mid-node beside the middle of its edge, (c,)."""
        one, two = self.ends.T
        offset = np.abs(nodes[self.middles] - (nodes[one] + nodes[two]) / 2)
        bent = np.zeros(len(nodes), bool)
        bent[self.middles] = (offset > STRAIGHT).any(axis=1)
        curved: Integers = np.flatnonzero(bent[self.tets[:, 4:]].any(axis=1)).astype(np.int32)
        return curved

    def _sentence(self, nodes: Reals, element: int, ratio: float) -> str:
        x, y, z = nodes[self.tets[element, :4]].mean(axis=0)
        place = f"({x:.2f}, {y:.2f}, {z:.2f}) mm"
        if ratio == -1.0:
            return f"tetrahedron {element} near {place} is turned inside out"
        return f"tetrahedron {element} near {place} folds (Jacobian ratio {ratio:.2g})"
