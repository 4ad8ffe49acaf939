"""Energy, forces and tangent of a problem's membranes.

The energy W of a triangle is a function of the samples e of its strain, e . D e / 2 for a film that
does not wrinkle. Its derivatives by the positions x_a of the nodes are, with s and D the first and
second one by e,

    f_ai = sum of s_m (G_m x)_ai,
    K_ai,bj = sum of D_mn (G_m x)_ai (G_n x)_bj + d_ij sum of s_m G_mab.

A triangle's nodes belong to one tetrahedron, so that the tangent has no entries of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.membranes.response import Response
from solver.assembly.membranes.strain import regge_samples
from solver.mesh.mesh import Mesh
from solver.problem.membranes import Membrane
from solver.problem.problem import Problem

SAMPLES = regge_samples()


@dataclass(frozen=True)
class Membranes:
    """All membranes of a problem.

    ``nodes``: number of the mesh's; ``triangles`` (k, 6), those of the ``responses`` in turn;
    ``reference`` (k, 6, 3): their undeformed nodes from the first one, mm.
    """

    nodes: int
    triangles: Integers
    reference: Reals
    responses: tuple[Response, ...]

    @staticmethod
    def of(problem: Problem) -> Membranes:
        """All membranes of a problem."""
        mesh = problem.mesh
        triangles = mesh.triangles(*(membrane.surface for membrane in problem.membranes))
        responses = tuple(Response.on(mesh, membrane, SAMPLES) for membrane in problem.membranes)
        return Membranes(len(mesh.nodes), triangles, from_first(mesh.nodes[triangles]), responses)

    @staticmethod
    def on(mesh: Mesh, membrane: Membrane) -> Membranes:
        """A single one."""
        triangles = mesh.triangles(membrane.surface)
        response = Response.on(mesh, membrane, SAMPLES)
        return Membranes(len(mesh.nodes), triangles, from_first(mesh.nodes[triangles]), (response,))

    def strains(self, displacement: Reals) -> Reals:
        """Samples e (k, m) of the strain after a displacement (n, 3), mm^2."""
        moved = from_first(displacement[self.triangles])
        middle = self.reference + moved / 2
        samples: Reals = (pulled(moved) * middle[:, None]).sum(axis=(2, 3))
        return samples

    def strains_along(self, displacement: Reals, increment: Reals) -> Reals:
        """The same after an increment (n, 3), to first order."""
        along = from_first(increment[self.triangles])
        change = np.einsum("kmai,kai->km", self.slopes(displacement), along)
        return self.strains(displacement) + change

    def stresses(self, strains: Reals) -> Reals:
        """What works on samples (k, m) of the strain: s, N/mm."""
        parts = [response.stresses(each) for response, each in self._parts(strains)]
        return np.concatenate([strains[:0], *parts])

    def stiffness(self, strains: Reals) -> Reals:
        """Derivative D (k, m, m) of that by the samples, N/mm^3."""
        return np.concatenate([response.stiffness(each) for response, each in self._parts(strains)])

    def energy(self, displacement: Reals) -> float:
        """Energy of all membranes, N mm."""
        parts = self._parts(self.strains(displacement))
        return float(sum(response.energy(each) for response, each in parts))

    def _parts(self, strains: Reals) -> list[tuple[Response, Reals]]:
        """Each response with the samples of its strain."""
        ends = np.cumsum([len(response.sizes) for response in self.responses])
        return list(zip(self.responses, np.split(strains, ends), strict=False))

    def forces(self, displacement: Reals) -> Reals:
        """Derivative (n, 3) of the energy by the displacement, N."""
        stresses = self.stresses(self.strains(displacement))
        return self.summed(stresses, self.slopes(displacement))

    def summed(self, stresses: Reals, slopes: Reals) -> Reals:
        """Nodal forces (n, 3), N, of ``stresses`` (k, m) and the ``slopes`` of the samples."""
        parts = np.einsum("km,kmai->kai", stresses, slopes)
        forces = np.zeros((self.nodes, 3))
        np.add.at(forces, self.triangles, parts)
        return forces

    def tangents(self, strains: Reals, bent: Reals, slopes: Reals) -> Reals:
        """Tangents (k, 18, 18) of the triangles, N/mm.

        ``strains`` (k, m): those of D; ``bent`` (k, m): those of s in the geometric part.
        """
        rows = slopes.reshape(*slopes.shape[:2], 18)
        tangents: Reals = rows.transpose(0, 2, 1) @ (self.stiffness(strains) @ rows)
        bent = np.einsum("km,mab->kab", self.stresses(bent), SAMPLES.forms)
        blocks = tangents.reshape(-1, 6, 3, 6, 3)
        for axis in range(3):
            blocks[:, :, axis, :, axis] += bent
        return tangents

    def slopes(self, displacement: Reals) -> Reals:
        """Derivatives (k, m, 6, 3) of the samples by the nodes: G x, mm."""
        return pulled(self.reference + from_first(displacement[self.triangles]))


def from_first(values: Reals) -> Reals:
    """Vectors of triangles (k, 6, 3) from that of the first node on, which strain does not see."""
    return values - values[:, :1]


def pulled(vectors: Reals) -> Reals:
    """G times vectors of triangles (k, 6, 3): (k, m, 6, 3)."""
    products: Reals = SAMPLES.forms.reshape(-1, 6) @ vectors
    return products.reshape(len(vectors), len(SAMPLES.forms), 6, 3)
