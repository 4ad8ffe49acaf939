"""What the connectivity of a mesh and its supports decide, whatever the positions of the nodes.

Problems on meshes that differ in positions only share it, and with it the sparsity pattern and what
a linear solver found out about that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers
from solver.assembly.colouring import chunks
from solver.kernels.assembly import Places
from solver.linear.sparsity import Pattern, upper_pattern
from solver.problem.problem import Problem
from solver.problem.unknowns import Numbering, number_unknowns


@dataclass(frozen=True)
class Layout:
    """Numbers of the unknowns of a problem, and where its cells go in residual and tangent.

    ``tets`` (e, 10), their ``tet_vertices`` (e, 4) and ``triangles`` (k, 6) of the pressurised
    surfaces; ``places`` of the
    elements away from the moving plane, ``at_plane`` (m,) those at it; ``plane`` and ``facets``:
    unknowns of the latter elements and of the triangles with their entries in ``pattern``.
    """

    tets: Integers
    tet_vertices: Integers
    triangles: Integers
    numbering: Numbering
    pattern: Pattern
    places: Places
    at_plane: Integers
    plane: tuple[Integers, Integers]
    facets: tuple[Integers, Integers]

    @staticmethod
    def of(problem: Problem) -> Layout:
        """The layout of a problem."""
        mesh = problem.mesh
        numbering = _numbering(problem)
        dofs = numbering.of_tets(mesh)
        at_plane = _at_plane(problem)
        plane_dofs = _with_plane(dofs[at_plane], numbering)
        pattern = upper_pattern(_joined(dofs, at_plane, plane_dofs), numbering.size)
        order = chunks(mesh, np.flatnonzero(~at_plane))
        triangles = mesh.triangles(*problem.pressurised)
        facets = numbering.of_triangles(triangles)
        if problem.moving_plane is not None:
            facets = _with_plane(facets, numbering)
        return Layout(
            tets=mesh.tets,
            tet_vertices=mesh.tet_vertices,
            triangles=triangles,
            numbering=numbering,
            pattern=pattern,
            places=Places(*order, dofs, pattern.entries(dofs)),
            at_plane=np.flatnonzero(at_plane).astype(np.int32),
            plane=(plane_dofs, pattern.entries(plane_dofs)),
            facets=(facets, pattern.entries(facets)),
        )

    def fits(self, problem: Problem) -> bool:
        """Whether it is the layout of ``problem`` too."""
        mesh = problem.mesh
        same_cells = (
            np.array_equal(mesh.tets, self.tets)
            and np.array_equal(mesh.tet_vertices, self.tet_vertices)
            and np.array_equal(mesh.triangles(*problem.pressurised), self.triangles)
        )
        return same_cells and _same(_numbering(problem), self.numbering)


def _numbering(problem: Problem) -> Numbering:
    return number_unknowns(problem.mesh, problem.supports, problem.moving_plane)


def _same(one: Numbering, other: Numbering) -> bool:
    return all(
        np.array_equal(a, b)
        for a, b in (
            (one.displacement, other.displacement),
            (one.pressure, other.pressure),
            (one.plane, other.plane),
        )
    )


def _at_plane(problem: Problem) -> NDArray[np.bool_]:
    """Which elements have a node on the moving plane, (e,)."""
    surface, mesh = problem.moving_plane, problem.mesh
    nodes = () if surface is None else mesh.surface_nodes(surface)
    return np.asarray(np.isin(mesh.tets, nodes).any(axis=1))


def _with_plane(dofs: Integers, numbering: Numbering) -> Integers:
    """The unknowns of cells (e, m) with those of the moving plane at the end, (e, m + 2)."""
    return np.hstack([dofs, np.broadcast_to(numbering.plane, (len(dofs), 2))])


def _joined(dofs: Integers, at_plane: NDArray[np.bool_], plane_dofs: Integers) -> Integers:
    """The unknowns of all elements (e, 36): those ``at_plane`` also have the plane's."""
    joined = np.full((len(dofs), plane_dofs.shape[1]), -1, np.int32)
    joined[:, : dofs.shape[1]] = dofs
    joined[at_plane] = plane_dofs
    return joined
