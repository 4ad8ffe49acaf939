"""Estimates of a mesh's number of elements and its equations' memory, before meshing.

Gmsh meshes a body's edges first, then its faces, then its inside, each with the sizes of the one
before. A face of area A whose bounding edges are divided into n pieces, of mean length h, gets
about A over the area of an equilateral triangle of that side, but no fewer than the n − 2
triangles of a polygon. The inside of walls adds tetrahedra in proportion to these triangles, that
of thick parts in proportion to the cubes of the wanted size that fit into them. The factors are
fitted to meshes, see the constants; ``tests/benchmarks/mesh_sizes.py`` compares again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.meshing.solid import SIZE_OF_EDGE, MeshOptions, SizeField

DIAGONALS = 10
"""Gmsh makes no edge longer than the bounding box's diagonal over this."""

PER_TRIANGLE, PER_CUBE, PER_CUBE_OF_FIELD = 1.7, 1.9, 5.0
"""Tetrahedra for each expected triangle, for each cube of the largest edge in the body, and for
each cube of the size that a field wants.

Least squares of the relative errors over meshes of bellows, cells and halves with walls of 0.4 to
3 mm and fillets from none to full rounds. Without a field, 78 bodies of 768 to 277 098 tetrahedra:
estimate over actual number from 0.75 to 1.29, four fifths of them from 0.85 to 1.16. With one, 44
cells of 2254 to 24 303: 0.85 to 1.08."""

UNKNOWNS_PER_ELEMENT = 6.2
"""Observed from 5.2 to 6.8, increasing with the fraction of nodes on the surface."""

MIB, KIB = 2**20, 2**10
LIBRARIES = 680 * MIB
"""Memory of the imported and compiled code, bytes."""

BYTES_PER_UNKNOWN, AT_UNKNOWNS, GROWTH = 5.85 * KIB, 200_000, 0.1
"""Memory of assembly and factors for each unknown, at so many of them, and the power with which it
grows. Measured with PARDISO from 18 425 to 282 014 unknowns, cells and halves of Prototype 1: 747
to 2351 MiB in all, estimated within 5 %."""


@dataclass(frozen=True)
class FaceSize:
    """A face's area, mm², the lengths of its edges, mm, and its least radius of curvature, mm."""

    area: float
    edges: tuple[float, ...]
    radius: float = math.inf


@dataclass(frozen=True)
class BodySize:
    """A solid's volume, mm³, the diagonal of its bounding box, mm, and its faces."""

    volume: float
    diagonal: float
    faces: Sequence[FaceSize]


def expected_elements(body: BodySize, options: MeshOptions) -> float:
    """Number of tetrahedra that ``mesh_solid`` will make of ``body``, within a factor of 1.5."""
    return expected_elements_of_parts((body,), options)


def expected_elements_of_parts(
    bodies: Sequence[BodySize], options: MeshOptions, sizes: Sequence[float | None] = ()
) -> float:
    """Number of tetrahedra that ``mesh_solids`` will make of touching ``bodies``.

    ``sizes`` are the parts' own largest edges, mm, or None for those of the options. Of the bodies'
    diagonals the largest counts, which should be that of all together.
    """
    largest = min(options.size, max(body.diagonal for body in bodies) / DIAGONALS)
    edges = [min(largest, size or np.inf) for size in sizes or [None] * len(bodies)]
    pairs = list(zip(bodies, edges, strict=True))
    triangles = sum(
        _expected_triangles(face, edge, options) for body, edge in pairs for face in body.faces
    )
    if options.field is None:
        inside = PER_CUBE * sum(body.volume / edge**3 for body, edge in pairs)
    else:
        inside = PER_CUBE_OF_FIELD * _cubes(options.field, options.size)
    return PER_TRIANGLE * triangles + inside


def expected_memory(elements: float) -> float:
    """Memory, bytes, of a program that solves on so many tetrahedra."""
    unknowns = UNKNOWNS_PER_ELEMENT * elements
    return LIBRARIES + BYTES_PER_UNKNOWN * unknowns * (unknowns / AT_UNKNOWNS) ** GROWTH


def _expected_triangles(face: FaceSize, edge: float, options: MeshOptions) -> float:
    if options.elements_per_circle > 0:
        edge = min(edge, 2 * math.pi * face.radius / options.elements_per_circle)
    edge = max(edge, options.smallest_size)
    pieces = sum(max(1, math.ceil(length / edge - 1e-6)) for length in face.edges)
    mean = min(edge, sum(face.edges) / max(pieces, 1) or edge)  # no edges: a whole sphere
    return max(face.area / (math.sqrt(3) / 4 * mean**2), pieces - 2)


def _cubes(field: SizeField, largest: float) -> float:
    """Volume of the field's mesh in cubes of the wanted size."""
    corners = field.mesh.tets[:, :4]
    points = field.mesh.nodes[corners]
    volumes = np.abs(np.linalg.det(points[:, 1:] - points[:, :1])) / 6
    sizes = np.minimum(SIZE_OF_EDGE * field.sizes[corners], largest)
    return float((volumes / np.exp(np.log(sizes).mean(axis=1)) ** 3).sum())
