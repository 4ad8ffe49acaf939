"""Meshes of blocks, whole or hollow, without CAD and mesher: to try laws, loads and contacts on."""

from __future__ import annotations

from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.mesh import Mesh

Three = tuple[float, float, float]
Cells = tuple[int, int, int]

CAVITY = "cavity"
FACES = ((0, 2, 1, 6, 5, 4), (0, 1, 3, 4, 9, 7), (1, 2, 3, 5, 8, 9), (0, 3, 2, 7, 8, 6))
"""Nodes of a tetrahedron's faces, outward."""


def block(size: Three, cells: Cells, hollow: tuple[Cells, Cells] | None = None) -> Mesh:
    """Mesh of a block with a corner at the origin, six tetrahedra in each of its cells.

    Args:
        size: Lengths along x, y and z, mm; positive.
        cells: Numbers of cells along x, y and z.
        hollow: The first cell along each axis that is left out, and the first behind it that is
            not; None for a solid block. The hollow lies inside, or opens in outer faces.

    Returns:
        Straight ten-node tetrahedra with the surfaces ``x0``, ``x1``, ``y0``, ``y1``, ``z0`` and
        ``z1``, the faces of least and greatest x, y and z, and ``cavity``, all around the hollow.

    Raises:
        SolverError: A size or number that is not positive, a hollow that is not within the block,
            or a block of which nothing is left.

    Examples:
        >>> from solver.mesh import block
        >>> mesh = block((30, 10, 10), (6, 4, 4), hollow=((1, 1, 1), (5, 3, 3)))
        >>> len(mesh.tets)  # six in each of 96 - 16 cells
        480
        >>> sorted(mesh.surfaces)
        ['cavity', 'x0', 'x1', 'y0', 'y1', 'z0', 'z1']
    """
    solid = _solid(size, cells, hollow)
    corners, tets = _tetrahedra(solid)
    corners, tets = _with_mid_nodes(corners, tets)
    skin = _skin(tets)
    names = _names(corners[skin[:, :3]].mean(axis=1), cells)
    nodes = corners * np.array(size) / np.array(cells)
    return Mesh(nodes, tets, {str(name): skin[names == name] for name in np.unique(names)})


def _solid(size: Three, cells: Cells, hollow: tuple[Cells, Cells] | None) -> NDArray[np.bool_]:
    """Which cells are filled. Raises ``SolverError`` if the numbers describe no block."""
    if len(size) != 3 or not all(np.isfinite(size)) or min(size) <= 0:
        raise SolverError(f"a block of {size} mm: three positive lengths are wanted")
    if len(cells) != 3 or min(cells) < 1:
        raise SolverError(f"a block of {cells} cells: three positive numbers are wanted")
    solid = np.ones(cells, bool)
    if hollow is not None:
        first, end = hollow
        if any(not 0 <= a < b <= n for a, b, n in zip(first, end, cells, strict=True)):
            raise SolverError(f"a hollow from {first} to {end} is not within {cells} cells")
        solid[tuple(slice(a, b) for a, b in zip(first, end, strict=True))] = False
    if not solid.any():
        raise SolverError("the hollow leaves nothing of the block")
    return solid


def _tetrahedra(solid: NDArray[np.bool_]) -> tuple[Reals, Integers]:
    """Corners, in cells, and six tetrahedra around a diagonal of each filled cell."""
    orders = [order for order in permutations(range(3))]
    steps = np.cumsum(np.eye(3, dtype=int)[orders], axis=1)
    ways = np.concatenate([np.zeros((6, 1, 3), int), steps], axis=1)
    odd = [k for k, order in enumerate(orders) if np.linalg.det(np.eye(3)[list(order)]) < 0]
    ways[odd] = ways[odd][:, [0, 2, 1, 3]]
    vertices = (np.argwhere(solid)[:, None, None] + ways).reshape(-1, 3)
    points, numbers = np.unique(vertices, axis=0, return_inverse=True)
    return points.astype(np.float64), numbers.reshape(-1, 4).astype(np.int32)


def _with_mid_nodes(points: Reals, tets: Integers) -> tuple[Reals, Integers]:
    """The same with a node in the middle of every edge."""
    pairs = np.sort(np.stack([tets[:, edge] for edge in TETRAHEDRON_EDGES], axis=1), axis=2)
    edges, number = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.concatenate([points, points[edges].mean(axis=1)])
    return nodes, np.hstack([tets, len(points) + number.reshape(-1, 6)]).astype(np.int32)


def _skin(tets: Integers) -> Integers:
    """Faces of one tetrahedron only."""
    faces = np.concatenate([tets[:, face] for face in FACES])
    corners = np.sort(faces[:, :3], axis=1)
    _, first, count = np.unique(corners, axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def _names(centres: Reals, cells: Cells) -> NDArray[np.str_]:
    """Surface of each face of the skin, from its centre in cells."""
    names = np.full(len(centres), CAVITY)
    for axis, (letter, number) in enumerate(zip("xyz", cells, strict=True)):
        names[np.abs(centres[:, axis]) < 1e-9] = f"{letter}0"
        names[np.abs(centres[:, axis] - number) < 1e-9] = f"{letter}1"
    return names
