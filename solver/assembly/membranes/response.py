"""What works on the samples of a membrane's strain, in the metric of the reference surface.

With the Green strain E_ab in the parameters, A_ab = X,a . X,b and its inverse A^ab, the energy of a
film that bears compression is that of plane stress,

    t / 2 * integral of E_ab C^abcd E_cd dA,
    C^abcd = Y / (1 - nu^2) (nu A^ab A^cd + (1 - nu) / 2 (A^ac A^bd + A^ad A^bc)),

for the thickness t, Young's modulus Y and Poisson's ratio nu: the membrane part of Koiter's shell
(P. G. Ciarlet, Mathematical Elasticity III, Theory of Shells, 2000, chapter 10). The reference
surface may be curved. One that wrinkles has the relaxed energy of ``tension_field``. Both laws are
isotropic, and evaluated in the components of an orthonormal frame at each quadrature point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.membranes import tension_field
from solver.assembly.membranes.strain import StrainSamples
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.membranes import Membrane


@dataclass(frozen=True)
class Response:
    """Response of one membrane to samples (k, m) of its strain.

    ``maps`` (k, q, m, 3): what each sample adds to the components of the strain at the quadrature
    points, 1/mm^2; ``sizes`` (k, q): area of each, mm^2; ``constant`` (k, m, m): the stiffness of a
    film that does not wrinkle.
    """

    membrane: Membrane
    maps: Reals
    sizes: Reals
    constant: Reals

    @staticmethod
    def on(mesh: Mesh, membrane: Membrane, samples: StrainSamples) -> Response:
        """The film on its surface of a mesh."""
        metric, _ = metrics(mesh.nodes, mesh.triangles(membrane.surface))
        maps = components(frames(metric)[:, :, None], samples.basis.swapaxes(0, 1))
        sizes = triangle_rule().weights * np.sqrt(np.linalg.det(metric))
        full = tension_field.full_stiffness(membrane)
        constant = np.einsum("kq,kqmc,cd,kqnd->kmn", sizes, maps, full, maps, optimize=True)
        return Response(membrane, maps, sizes, constant)

    def energy(self, samples: Reals) -> float:
        """N mm."""
        return float((self.sizes * tension_field.energy(self.membrane, self.strain(samples))).sum())

    def stresses(self, samples: Reals) -> Reals:
        """Derivative (k, m) of the energy by the samples, N/mm."""
        if not self.membrane.wrinkles:
            return _times(self.constant, samples)
        weighted = self.sizes[..., None] * tension_field.stress(self.membrane, self.strain(samples))
        stresses: Reals = np.einsum("kqmc,kqc->km", self.maps, weighted)
        return stresses

    def stiffness(self, samples: Reals) -> Reals:
        """Derivative (k, m, m) of that by the samples, N/mm^3."""
        if not self.membrane.wrinkles:
            return self.constant
        law = tension_field.stiffness(self.membrane, self.strain(samples))
        right = self.maps @ (self.sizes[..., None, None] * law)
        stiffness: Reals = (right @ self.maps.swapaxes(-1, -2)).sum(axis=1)
        return stiffness

    def strain(self, samples: Reals) -> Reals:
        """Components (k, q, 3) of the strain at the quadrature points."""
        strain: Reals = np.einsum("km,kqmc->kqc", samples, self.maps)
        return strain


def _times(matrices: Reals, vectors: Reals) -> Reals:
    """Products (k, m) of matrices (k, m, m) and vectors (k, m)."""
    products: Reals = np.einsum("kmn,kn->km", matrices, vectors)
    return products


def metrics(nodes: Reals, triangles: Integers) -> tuple[Reals, Reals]:
    """A_ab (k, q, 2, 2) in mm^2 at the quadrature points of triangles, and their inverses."""
    tangents = np.einsum("qad,kai->kqdi", triangle_rule().gradients, nodes[triangles])
    metric = np.einsum("kqai,kqbi->kqab", tangents, tangents)
    return metric, np.linalg.inv(metric)


def frames(metric: Reals) -> Reals:
    """Orthonormal frames (..., 2, 2) of metrics (..., 2, 2): J with J^T A J = 1, 1/mm."""
    return np.linalg.inv(np.linalg.cholesky(metric)).swapaxes(-1, -2)


def components(frame: Reals, tensor: Reals) -> Reals:
    """Components (..., 3) of symmetric covariant tensors (..., 2, 2) in frames (..., 2, 2)."""
    turned = frame.swapaxes(-1, -2) @ tensor @ frame
    parts = [turned[..., 0, 0], turned[..., 1, 1], np.sqrt(2) * turned[..., 0, 1]]
    return np.stack(parts, axis=-1)


def as_tensors(values: Reals) -> Reals:
    """Symmetric tensors (..., 2, 2) of components (..., 3)."""
    one, two, mixed = values[..., 0], values[..., 1], values[..., 2] / np.sqrt(2)
    rows = [np.stack([one, mixed], axis=-1), np.stack([mixed, two], axis=-1)]
    return np.stack(rows, axis=-2)
