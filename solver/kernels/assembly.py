"""Loops over elements: residual, tangent and energy of a meshed body."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import prange

from solver.arrays import Integers, Reals
from solver.kernels.element import UNKNOWNS, Solid, element_energy, element_response, stress_forces
from solver.kernels.moving_plane import to_plane_unknowns
from solver.kernels.scatter import mirror_upper, scatter
from solver.numerics.compiled import compiled


class Places(NamedTuple):
    """Order of the elements, and positions of their entries in residual and tangent.

    Chunk c has the elements ``order[chunks[c]:chunks[c + 1]]``; chunks ``colours[k]`` to
    ``colours[k + 1]`` share no node, so they can be added in parallel. ``dofs`` (e, 34) and
    ``entries`` (e, 595) are positions in the residual and in the CSR values, -1 where an unknown is
    prescribed.
    """

    order: Integers
    chunks: Integers
    colours: Integers
    dofs: Integers
    entries: Integers


@compiled()
def gather(
    solid: Solid, element: int, displacement: Reals, pressure: Reals, x: Reals, u: Reals, q: Reals
) -> None:
    """Coordinates and displacements (10, 3) and pressures (4,) of an element into x, u, q."""
    for a in range(10):
        node = solid.tets[element, a]
        for i in range(3):
            x[a, i] = solid.nodes[node, i]
            u[a, i] = displacement[node, i]
    for v in range(4):
        q[v] = pressure[solid.tet_vertices[element, v]]


@compiled()
def assemble_chunk(
    solid: Solid,
    places: Places,
    chunk: int | np.int64,
    displacement: Reals,
    pressure: Reals,
    geometric: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
    jacobians: Reals,
) -> None:
    """Add the elements of one chunk; arguments as for ``assemble``."""
    x = np.empty((10, 3))
    u = np.empty((10, 3))
    q = np.empty(4)
    r = np.empty(UNKNOWNS)
    k = np.empty((UNKNOWNS, UNKNOWNS))
    for position in range(places.chunks[chunk], places.chunks[chunk + 1]):
        element = places.order[position]
        gather(solid, element, displacement, pressure, x, u, q)
        jacobians[element] = element_response(
            solid, solid.material_of[element], x, u, q, geometric[element], tangent, r, k
        )
        scatter(r, k, places.dofs[element], places.entries[element], 1.0, tangent, residual, values)


@compiled(parallel=True)
def assemble(
    solid: Solid,
    places: Places,
    displacement: Reals,
    pressure: Reals,
    geometric: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
    jacobians: Reals,
) -> None:
    """Add the elements' residuals to ``residual`` and tangents to the CSR ``values``.

    ``displacement`` (n, 3), ``pressure`` (v,), ``geometric`` (e, q, 6) as for ``element_response``,
    or (e, 0, 6). ``jacobians`` (e,) takes each element's smallest J.
    Chunks of a colour are added in parallel, colours one after the other, so that the sums do not
    depend on the number of threads.
    """
    for colour in range(places.colours.size - 1):
        first, end = places.colours[colour], places.colours[colour + 1]
        if end - first == 1:  # a parallel region would cost more than it saves
            assemble_chunk(
                solid,
                places,
                np.int64(first),  # the type of c below: another one would be compiled again
                displacement,
                pressure,
                geometric,
                tangent,
                residual,
                values,
                jacobians,
            )
        else:
            for c in prange(first, end):
                assemble_chunk(
                    solid,
                    places,
                    c,
                    displacement,
                    pressure,
                    geometric,
                    tangent,
                    residual,
                    values,
                    jacobians,
                )


@compiled()
def assemble_plane(
    solid: Solid,
    elements: Integers,
    heights: Reals,
    tilt: float,
    dofs: Integers,
    entries: Integers,
    displacement: Reals,
    pressure: Reals,
    geometric: Reals,
    tangent: bool,
    residual: Reals,
    values: Reals,
    jacobians: Reals,
) -> None:
    """Add the ``elements`` (p,) that have nodes on the moving plane; see ``assemble``.

    ``heights`` (n,): h of the nodes on the plane, NaN for all others. ``dofs`` (p, 36) and
    ``entries`` (p, 666) end with the unknowns of the plane.
    """
    x = np.empty((10, 3))
    u = np.empty((10, 3))
    q = np.empty(4)
    r = np.empty(UNKNOWNS + 2)
    of_geometric = np.empty(UNKNOWNS + 2)
    k = np.zeros((UNKNOWNS + 2, UNKNOWNS + 2))
    for row in range(elements.size):
        element = elements[row]
        gather(solid, element, displacement, pressure, x, u, q)
        jacobians[element] = element_response(
            solid, solid.material_of[element], x, u, q, geometric[element], tangent, r, k
        )
        mirror_upper(k)
        forces = r
        if geometric.shape[1] > 0:
            forces = of_geometric
            stress_forces(solid, x, u, geometric[element], forces)
        for a in range(10):
            height = heights[solid.tets[element, a]]
            if not np.isnan(height):
                to_plane_unknowns(r, k, forces, a, height, tilt)
        scatter(r, k, dofs[row], entries[row], 1.0, tangent, residual, values)


@compiled()
def total_energy(solid: Solid, displacement: Reals, pressure: Reals) -> tuple[float, float]:
    """Pi of the whole solid, N mm, and its volume, mm^3."""
    energy = 0.0
    volume = 0.0
    for element in range(solid.tets.shape[0]):
        nodes = solid.tets[element]
        corners = solid.tet_vertices[element]
        part, size = element_energy(
            solid,
            solid.material_of[element],
            solid.nodes[nodes],
            displacement[nodes],
            pressure[corners],
        )
        energy += part
        volume += size
    return energy, volume
