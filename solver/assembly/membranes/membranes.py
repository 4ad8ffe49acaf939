"""Energy, forces and tangent of a problem's membranes.

With the samples e of the strain and D their stiffness, the energy of a triangle is e . D e / 2. Its
derivatives by the positions x_a of the nodes are, with s = D e,

    f_ai = sum of s_m (G_m x)_ai,
    K_ai,bj = sum of D_mn (G_m x)_ai (G_n x)_bj + d_ij sum of s_m G_mab.

A triangle's nodes belong to one tetrahedron, so that the tangent has no entries of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.membranes.stiffness import sample_stiffness
from solver.assembly.membranes.strain import regge_samples
from solver.mesh.mesh import Mesh
from solver.problem.membranes import Membrane
from solver.problem.problem import Problem

SAMPLES = regge_samples()


@dataclass(frozen=True)
class Membranes:
    """All membranes of a problem.

    ``triangles`` (k, 6); ``reference`` (k, 6, 3): their undeformed nodes from the first one, mm;
    ``stiffness`` (k, m, m): D, N mm.
    """

    triangles: Integers
    reference: Reals
    stiffness: Reals

    @staticmethod
    def of(problem: Problem) -> Membranes:
        """All membranes of a problem."""
        each = [Membranes.on(problem.mesh, membrane) for membrane in problem.membranes]
        count = len(SAMPLES.forms)
        return Membranes(
            np.concatenate([np.empty((0, 6), np.int32), *(one.triangles for one in each)]),
            np.concatenate([np.empty((0, 6, 3)), *(one.reference for one in each)]),
            np.concatenate([np.empty((0, count, count)), *(one.stiffness for one in each)]),
        )

    @staticmethod
    def on(mesh: Mesh, membrane: Membrane) -> Membranes:
        """A single one."""
        triangles = mesh.triangles(membrane.surface)
        stiffness = sample_stiffness(mesh, membrane, SAMPLES)
        return Membranes(triangles, from_first(mesh.nodes[triangles]), stiffness)

    def strains(self, displacement: Reals) -> Reals:
        """Samples e (k, m) of the strain after a displacement (n, 3), mm^2."""
        moved = from_first(displacement[self.triangles])
        middle = self.reference + moved / 2
        samples: Reals = np.einsum("mab,kai,kbi->km", SAMPLES.forms, middle, moved, optimize=True)
        return samples

    def stresses(self, displacement: Reals) -> Reals:
        """What works on the samples (k, m): s = D e, N/mm."""
        return self.worked(self.strains(displacement))

    def stresses_along(self, displacement: Reals, increment: Reals) -> Reals:
        """The same after an increment (n, 3), to first order."""
        along = from_first(increment[self.triangles])
        change = np.einsum("kmai,kai->km", self.slopes(displacement), along)
        return self.worked(self.strains(displacement) + change)

    def energy(self, displacement: Reals) -> float:
        """Energy of all membranes, N mm."""
        strains = self.strains(displacement)
        return 0.5 * float((strains * self.worked(strains)).sum())

    def forces(self, displacement: Reals) -> Reals:
        """Derivative (n, 3) of the energy by the displacement, N."""
        slopes, stresses = self.slopes(displacement), self.stresses(displacement)
        parts = np.einsum("km,kmai->kai", stresses, slopes)
        forces = np.zeros_like(displacement)
        np.add.at(forces, self.triangles, parts)
        return forces

    def tangents(self, displacement: Reals, stresses: Reals) -> Reals:
        """Tangents (k, 18, 18) of the triangles, N/mm, with ``stresses`` in the geometric part."""
        slopes = self.slopes(displacement).reshape(len(self.triangles), -1, 18)
        tangents: Reals = slopes.transpose(0, 2, 1) @ (self.stiffness @ slopes)
        bent = np.einsum("km,mab->kab", stresses, SAMPLES.forms)
        blocks = tangents.reshape(-1, 6, 3, 6, 3)
        for axis in range(3):
            blocks[:, :, axis, :, axis] += bent
        return tangents

    def slopes(self, displacement: Reals) -> Reals:
        """Derivatives (k, m, 6, 3) of the samples by the nodes: G x, mm."""
        positions = self.reference + from_first(displacement[self.triangles])
        return SAMPLES.forms @ positions[:, None]

    def worked(self, strains: Reals) -> Reals:
        """Stiffness times samples of a strain (k, m), N/mm."""
        stresses: Reals = np.einsum("kmn,kn->km", self.stiffness, strains)
        return stresses


def from_first(values: Reals) -> Reals:
    """Vectors of triangles (k, 6, 3) from that of the first node on, which strain does not see."""
    return values - values[:, :1]
