"""Stiffness of membranes: plane stress, in the metric of the reference surface.

With the Green strain E_ab in the parameters, A_ab = X,a . X,b and its inverse A^ab, the energy is

    t / 2 * integral of E_ab C^abcd E_cd dA,
    C^abcd = Y / (1 - nu^2) (nu A^ab A^cd + (1 - nu) / 2 (A^ac A^bd + A^ad A^bc)),

for the thickness t, Young's modulus Y and Poisson's ratio nu: the membrane part of Koiter's shell
(P. G. Ciarlet, Mathematical Elasticity III, Theory of Shells, 2000, chapter 10). The reference
surface may be curved.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.assembly.membranes.strain import StrainSamples
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh
from solver.problem.membranes import Membrane


def sample_stiffness(mesh: Mesh, membrane: Membrane, samples: StrainSamples) -> Reals:
    """Stiffness D (k, m, m) between the samples of each triangle: energy e . D e / 2, N mm."""
    rule = triangle_rule()
    metric, inverse = metrics(mesh.nodes, mesh.triangles(membrane.surface))
    sizes = rule.weights * np.sqrt(np.linalg.det(metric))
    raised = np.einsum("kqac,mqcd,kqdb->kqmab", inverse, samples.basis, inverse, optimize=True)
    traces = np.einsum("kqab,mqab->kqm", inverse, samples.basis)
    nu = membrane.poisson_ratio
    volumes = np.einsum("kq,kqm,kqn->kmn", sizes, traces, traces, optimize=True)
    shapes = np.einsum("kq,kqmab,nqab->kmn", sizes, raised, samples.basis, optimize=True)
    factor = membrane.stiffness / (1 - nu**2)
    stiffness: Reals = factor * (nu * volumes + (1 - nu) * shapes)
    return stiffness


def metrics(nodes: Reals, triangles: Integers) -> tuple[Reals, Reals]:
    """A_ab (k, q, 2, 2) in mm^2 at the quadrature points of triangles, and their inverses."""
    tangents = np.einsum("qad,kai->kqdi", triangle_rule().gradients, nodes[triangles])
    metric = np.einsum("kqai,kqbi->kqab", tangents, tangents)
    return metric, np.linalg.inv(metric)


def plane_stress(membrane: Membrane, inverse: Reals, strain: Reals) -> Reals:
    """Second Piola-Kirchhoff stress times thickness, S^ab t, of strains E_ab (..., 2, 2), N/mm.

    ``inverse`` (..., 2, 2): A^ab. In the parameters, like the strain.
    """
    nu = membrane.poisson_ratio
    traces = np.einsum("...ab,...ab->...", inverse, strain)[..., None, None]
    stress: Reals = nu * traces * inverse + (1 - nu) * (inverse @ strain @ inverse)
    return membrane.stiffness / (1 - nu**2) * stress
