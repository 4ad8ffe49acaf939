"""Follower pressure on six-node triangles, its tangent, and the volume a surface encloses.

With x(r, s) the deformed triangle, n da = x_r cross x_s dr ds is quartic at most once multiplied
by shape functions, so the six-point rule integrates everything here exactly.

The derivative of N_a n da is not symmetric on one triangle. Summed over a surface whose rim is
either held or slides in a symmetry plane, the skew parts cancel (they are rim integrals: the
force is minus the gradient of P times the enclosed volume), so only the symmetric part is
assembled. Where a rim is free, the whole derivative is (``solver.assembly.free_rim``).

Where the rim slides in a moving plane, the pressure also acts on the plane through the opening.
There the enclosed volume is differentiated directly, written as minus the integral of y n_y: what
closes the cavity, the plane y = 0 and planes that rotate about y, contributes nothing, so that the
resultant and the moment on the opening need no mesh of the opening.
"""

from __future__ import annotations

import numpy as np

from solver.arrays import Integers, Reals
from solver.kernels.pressure import PressureFacets
from solver.mesh.elements import triangle_rule
from solver.mesh.mesh import Mesh


def pressure_facets(
    mesh: Mesh, triangles: Integers, dofs: Integers, entries: Integers
) -> PressureFacets:
    """Triangles (k, 6) of a mesh, with the positions of their unknowns."""
    rule = triangle_rule()
    return PressureFacets(
        mesh.nodes, triangles, rule.quadratic, rule.gradients, rule.weights, dofs, entries
    )


def enclosed_volume(mesh: Mesh, displacement: Reals, surfaces: tuple[str, ...]) -> float:
    """Volume inside closed surfaces of the deformed mesh, mm^3.

    Minus the integral of y n_y, with the normals out of the solid and so into the cavity. Openings
    of the surface must lie in the plane y = 0 or in planes along y, such as the cuts through a
    cell: they contribute nothing.
    """
    rule = triangle_rule()
    x = (mesh.nodes + displacement)[mesh.triangles(*surfaces)]
    across = np.einsum("qa,ta->tq", rule.quadratic, x[:, :, 1])
    tangents = np.einsum("qad,tai->dtqi", rule.gradients, x[:, :, [0, 2]])
    normal = tangents[0, ..., 1] * tangents[1, ..., 0] - tangents[0, ..., 0] * tangents[1, ..., 1]
    return 0.0 - float(np.einsum("q,tq,tq->", rule.weights, across, normal))
