"""The tangent of a cell over the displacements of all its nodes, whatever holds them.

For small motions that other supports than the cell's would allow. Contacts with planes of symmetry
normal to y belong to it; those with the cell's mirror images along x do not: in a motion that is
antisymmetric about such a plane wall and image move alike, and nothing presses them.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from solver.arrays import Reals
from solver.assembly.assembly import NO_SUPPORTS, solid
from solver.assembly.colouring import chunks
from solver.assembly.pairs.made import contact_pair
from solver.assembly.pairs.pair import PlaneUnknowns
from solver.assembly.pressure import pressure_facets
from solver.errors import SolverError
from solver.kernels.assembly import Places, assemble
from solver.kernels.pressure import assemble_volume
from solver.linear.sparsity import Pattern, upper_pattern
from solver.problem.contacts import Contact
from solver.problem.unknowns import Numbering, number_unknowns
from solver.results.solution import Solution


def nodal_tangent(solution: Solution) -> tuple[csr_array, Numbering]:
    """Both triangles (m, m) at an equilibrium, and the numbers of displacements and pressures.

    Raises ``SolverError`` where a surface touches its mirror image at a fixed plane normal to x.
    """
    mesh = solution.problem.mesh
    numbering = number_unknowns(mesh, NO_SUPPORTS)
    pattern = upper_pattern(numbering.of_tets(mesh), numbering.size)
    values = np.zeros(len(pattern.indices))
    _add_solid(solution, numbering, pattern, values)
    _add_pressure(solution, numbering, pattern, values)
    _add_contacts(solution, numbering, pattern, values)
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=2 * (numbering.size,))
    lower = upper.T.tocsr()
    lower.setdiag(0.0)
    return csr_array(upper + lower), numbering


def _add_solid(solution: Solution, numbering: Numbering, pattern: Pattern, values: Reals) -> None:
    mesh = solution.problem.mesh
    dofs = numbering.of_tets(mesh)
    assemble(
        solid(solution.problem), Places(*chunks(mesh), dofs, pattern.entries(dofs)),
        np.ascontiguousarray(solution.displacement), solution.hydrostatic_pressure,
        np.empty((len(mesh.tets), 0, 6)), True, np.zeros(numbering.size), values,
        np.empty(len(mesh.tets)),
    )  # fmt: skip


def _add_pressure(
    solution: Solution, numbering: Numbering, pattern: Pattern, values: Reals
) -> None:
    """As minus the pressure times the volume in the cavity of cell and images together."""
    mesh = solution.problem.mesh
    triangles = mesh.triangles(*solution.problem.pressurised)
    dofs = np.hstack(
        [numbering.of_triangles(triangles), np.full((len(triangles), 2), -1, np.int32)]
    )
    assemble_volume(
        pressure_facets(mesh, triangles, dofs, pattern.entries(dofs)), _nowhere(solution), 0.0,
        np.ascontiguousarray(solution.displacement), solution.pressure, True,
        np.zeros(numbering.size), values,
    )  # fmt: skip


def _add_contacts(
    solution: Solution, numbering: Numbering, pattern: Pattern, values: Reals
) -> None:
    apart = PlaneUnknowns(_nowhere(solution), 0.0)
    residual = np.zeros(numbering.size)
    for contact in solution.problem.contacts:
        pair = contact_pair(solution.problem, contact, numbering)
        axis = contact.axis if isinstance(contact, Contact) else None
        if axis is None or not pair.touches(solution.state, solution.load):
            continue
        if axis == 0:
            raise SolverError(
                f"shear_compliance: the surface {contact.surface!r} touches its mirror image "
                "along x; how the cell shears then is not known."
            )
        pair.add(solution.state, solution.load, apart, residual, values, pattern)


def _nowhere(solution: Solution) -> Reals:
    """Heights (n,) of nodes none of which is on a moving plane."""
    return np.full(len(solution.displacement), np.nan)
