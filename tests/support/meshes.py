"""Small meshes built by hand: boxes, bellows, spheres, cylinders, and any map of a box."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise, permutations

import numpy as np
from numpy.typing import NDArray

from solver import Mesh
from solver.mesh.elements import TETRAHEDRON_EDGES

FACES = ((0, 2, 1, 6, 5, 4), (0, 1, 3, 4, 9, 7), (1, 2, 3, 5, 8, 9), (0, 3, 2, 7, 8, 6))
Points = NDArray[np.float64]
Labels = Callable[[Points], NDArray[np.str_]]


def quadratic_mesh(
    points: Points, tets: NDArray[np.int32], label: Labels, place: Callable[[Points], Points]
) -> Mesh:
    """Ten-node mesh of linear tets (e, 4) of ``points`` in any parameters (p, d).

    ``label`` names boundary faces from the parameters of their corners (k, 3, d), outward in
    order; ``place`` maps parameters, those of mid-nodes included, to coordinates.
    """
    a, b, c, d = (place(points)[tets[:, k]] for k in range(4))
    flipped = np.einsum("ei,ei->e", np.cross(b - a, c - a), d - a) < 0
    tets = np.where(flipped[:, None], tets[:, [0, 2, 1, 3]], tets)
    pairs = np.sort(np.stack([tets[:, edge] for edge in TETRAHEDRON_EDGES], axis=1), axis=2)
    edges, number = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.concatenate([points, points[edges].mean(axis=1)])
    tets10 = np.hstack([tets, len(points) + number.reshape(-1, 6)])
    faces = np.concatenate([tets10[:, face] for face in FACES])
    _, first, count = np.unique(
        np.sort(faces[:, :3], axis=1), axis=0, return_index=True, return_counts=True
    )
    skin = faces[first[count == 1]]
    names = label(nodes[skin[:, :3]])
    surfaces = {str(name): skin[names == name] for name in np.unique(names)}
    return Mesh(place(nodes), tets10.astype(np.int32), surfaces)


def cell_mesh(
    cells: NDArray[np.int_], lines: Sequence[NDArray[np.float64]], distortion: float = 0.0
) -> Mesh:
    """Mesh of the ones among ``cells`` (x, y, z) between grid ``lines``, six tets each.

    Surfaces: x0, x1, y0, y1, z0, z1 on the box; inside of it ``outside`` next to zeros, ``cavity``
    next to twos. ``distortion`` moves inner vertices at random by that share of a cell; edges stay
    straight.
    """
    steps = np.eye(3, dtype=int)[list(permutations(range(3)))]  # six ways along three edges
    corners = np.concatenate([np.zeros((6, 1, 3), int), np.cumsum(steps, axis=1)], axis=1)
    filled = np.argwhere(cells == 1)
    vertices = (filled[:, None, None] + corners).reshape(-1, 3)
    points, numbers = np.unique(vertices, axis=0, return_inverse=True)
    shifts = np.random.default_rng(7).uniform(-distortion, distortion, points.shape)

    def label(faces: Points) -> NDArray[np.str_]:
        normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        beyond = np.floor(faces.mean(axis=1) + 0.1 * normal).astype(int) + 1
        border = np.pad(np.array(["outside", "solid", "cavity"])[cells], 1)
        for axis, name in enumerate("xyz"):
            for side in (0, 1):
                border[(slice(None),) * axis + (-side,)] = f"{name}{side}"
        return border[tuple(beyond.T)]

    def place(nodes: Points) -> Points:
        columns = [
            np.interp(n, np.arange(len(at)), at) for n, at in zip(nodes.T, lines, strict=True)
        ]
        return np.stack(columns, axis=1)

    straight = quadratic_mesh(points.astype(float), numbers.reshape(-1, 4), label, place)
    skin = straight.surface_nodes(*straight.surfaces)
    inner = np.setdiff1d(np.arange(len(points)), skin)
    moved = points.astype(float)
    moved[inner] += shifts[inner]
    nodes = np.concatenate([moved, np.empty((len(straight.nodes) - len(moved), 3))])
    for middle, edge in enumerate(TETRAHEDRON_EDGES, start=4):
        nodes[straight.tets[:, middle]] = nodes[straight.tets[:, edge]].mean(axis=1)
    return Mesh(place(nodes), straight.tets, straight.surfaces)


def box_mesh(
    divisions: tuple[int, int, int] = (2, 2, 2),
    size: tuple[float, float, float] = (1.0, 1.0, 1.0),
    distortion: float = 0.0,
) -> Mesh:
    """A solid box from the origin; see ``cell_mesh``."""
    lines = [np.linspace(0, end, n + 1) for end, n in zip(size, divisions, strict=True)]
    return cell_mesh(np.ones(divisions, int), lines, distortion)


def bellows_mesh(bubbles: int = 4, refinement: int = 1) -> Mesh:
    """Half of a small square-cut bellows, with surfaces root, tip, symmetry, cavity."""
    wall, chamber, gap = np.zeros((3, 2, 6), int)
    for section in (wall, chamber, gap):
        section[:, :3] = 1
        section[0, 1] = 2  # the channel
    wall[:, 3:] = chamber[:, 3:] = 1
    chamber[0, 2:5] = 2
    end = np.where(gap == 2, 1, gap)
    cells = np.stack([end, *(bubbles * [wall, chamber, wall, gap]), end])
    lengths = [1.0, *(bubbles * [0.6, 0.8, 0.6, 0.8]), 1.0]
    widths, heights = [3.4, 0.6], [0.6, 1.0, 0.6, 2.0, 2.0, 0.6]
    lines = []
    for axis, sizes in enumerate((lengths, widths, heights)):
        cells = np.repeat(cells, refinement, axis=axis)
        lines.append(np.cumsum([0.0, *np.repeat(sizes, refinement) / refinement]))
    mesh = cell_mesh(cells, lines)
    names = {"x0": "root", "x1": "tip", "y0": "symmetry", "cavity": "cavity"}
    return Mesh(mesh.nodes, mesh.tets, {new: mesh.surfaces[old] for old, new in names.items()})


def bellows_cell_mesh() -> Mesh:
    """Half of a bubble of ``bellows_mesh``, from its middle, x0, to the middle of the gap, x1."""
    chamber, wall, gap = np.zeros((3, 2, 6), int)
    for section in (chamber, wall, gap):
        section[:, :3] = 1
        section[0, 1] = 2  # the channel
    wall[:, 3:] = chamber[:, 3:] = 1
    chamber[0, 2:5] = 2
    lines = [[0.4, 0.6, 0.4], [3.4, 0.6], [0.6, 1.0, 0.6, 2.0, 2.0, 0.6]]
    return cell_mesh(np.stack([chamber, wall, gap]), [np.cumsum([0.0, *sizes]) for sizes in lines])


def doubled_mesh(mesh: Mesh) -> Mesh:
    """A mesh and its mirror image at its plane x1; the image of x0 becomes x1."""
    seam, end = mesh.surface_nodes("x1"), mesh.nodes[:, 0].max()
    image = np.arange(len(mesh.nodes)) + len(mesh.nodes)
    image[seam] = seam
    nodes = np.concatenate([mesh.nodes, mesh.nodes * [-1, 1, 1] + [2 * end, 0, 0]])
    used = np.unique(np.concatenate([np.arange(len(mesh.nodes)), image]))
    number = np.searchsorted(used, np.arange(len(nodes)))
    tets = [mesh.tets, number[image[mesh.tets]][:, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]]]
    images = {
        name: number[image[triangles]][:, [0, 2, 1, 5, 4, 3]]
        for name, triangles in mesh.surfaces.items()
    }
    surfaces = {
        name: np.concatenate([triangles, images[name]])
        for name, triangles in mesh.surfaces.items()
        if name not in ("x0", "x1")
    }
    surfaces |= {"x0": mesh.surfaces["x0"], "x1": images["x0"]}
    return Mesh(nodes[used], np.concatenate(tets), surfaces)


def sphere_mesh(inner: float, outer: float, layers: int, divisions: int) -> Mesh:
    """Octant of a thick sphere with curved elements; surfaces inside, outside, x0, y0, z0."""
    n = divisions
    grid = [(i, j) for i in range(n + 1) for j in range(n + 1 - i)]
    number = {key: k for k, key in enumerate(grid)}
    flat = np.array([(i / n, j / n, (n - i - j) / n) for i, j in grid])
    up = [((i, j), (i + 1, j), (i, j + 1)) for i, j in grid if i + j < n]
    down = [((i + 1, j), (i + 1, j + 1), (i, j + 1)) for i, j in grid if i + j < n - 1]
    triangles = np.sort([[number[key] for key in keys] for keys in up + down], axis=1)
    radii = np.linspace(inner, outer, layers + 1)
    points = np.concatenate([np.column_stack([flat, np.full(len(flat), r)]) for r in radii])
    tets = []
    for layer in range(layers):
        a, b = triangles + layer * len(flat), triangles + (layer + 1) * len(flat)
        tets += [np.hstack([a[:, split:], b[:, : split + 1]]) for split in range(3)]

    def place(p: Points) -> Points:
        return p[:, :3] / np.linalg.norm(p[:, :3], axis=1, keepdims=True) * p[:, 3:]

    def label(faces: Points) -> NDArray[np.str_]:
        planes = (faces == [0.0, 0.0, 0.0, inner]).all(axis=1)
        names = np.array(["x0", "y0", "z0", "inside"])[planes.argmax(axis=1)]
        return np.where(planes.any(axis=1), names, "outside")

    return quadratic_mesh(points, np.concatenate(tets).astype(np.int32), label, place)


def mapped_box(
    divisions: tuple[int, int, int],
    place: Callable[[Points], Points],
    distortion: float = 0.0,
) -> Mesh:
    """Curved elements: ``place`` maps the unit cube (k, 3), mid-nodes included, to coordinates.

    Surfaces x0 ... z1 are the images of the cube's faces; ``place`` must not mirror.
    """
    cube = box_mesh(divisions, (1.0, 1.0, 1.0), distortion)
    return Mesh(place(cube.nodes), cube.tets, cube.surfaces)


def renamed(mesh: Mesh, names: Mapping[str, str]) -> Mesh:
    """The mesh with some surfaces called otherwise; surfaces that share a new name are joined."""
    surfaces: dict[str, NDArray[np.int32]] = {}
    for old, triangles in mesh.surfaces.items():
        new = names.get(old, old)
        surfaces[new] = np.concatenate([surfaces.get(new, np.empty((0, 6), np.int32)), triangles])
    return Mesh(mesh.nodes, mesh.tets, surfaces)


def tube_mesh(
    inner: float, outer: float, length: float, divisions: tuple[int, int, int], span: float = np.pi
) -> Mesh:
    """Part of a tube along z over the angles 0 to ``span`` (rad); divisions radial, around, along.

    Surfaces inside, outside, start (angle 0, in the plane y = 0), end (angle ``span``), z0, z1.
    """

    def place(cube: Points) -> Points:
        radius, angle = inner + (outer - inner) * cube[:, 0], span * cube[:, 1]
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), length * cube[:, 2]], 1)

    mesh = mapped_box(divisions, place)
    return renamed(mesh, {"x0": "inside", "x1": "outside", "y0": "start", "y1": "end"})


def cylinder_mesh(
    radius: float,
    height: float,
    rings: int,
    layers: int,
    span: float = 2 * np.pi,
    sectors: int = 6,
) -> Mesh:
    """Solid cylinder along z, or a wedge of it over the angles 0 to ``span`` (rad).

    A fan of ``sectors`` equal triangles, each cut into ``rings`` squared, by ``layers``; sectors of
    60 degrees give the best elements. Curvature grows with the radius, so that elements at the
    axis are straight and all become straight under refinement. Surfaces side, z0, z1, and of a
    wedge start (angle 0, in the plane y = 0) and end (angle ``span``).
    """
    closed = bool(np.isclose(span, 2 * np.pi))
    flat, triangles = _fan(rings, span, sectors)
    heights = np.linspace(0, height, layers + 1)
    points = np.concatenate([np.column_stack([flat, np.full(len(flat), z)]) for z in heights])
    tets = prisms(triangles, len(flat), layers)
    opening = span / sectors

    def reach(p: Points) -> Points:
        """How far out in the fan, 0 at the axis and 1 at the rim: (k,)."""
        angle = np.mod(np.arctan2(p[:, 1], p[:, 0]) + 1e-9, 2 * np.pi)
        middle = opening * (np.clip(np.floor(angle / opening), 0, sectors - 1) + 0.5)
        return (p[:, 0] * np.cos(middle) + p[:, 1] * np.sin(middle)) / np.cos(opening / 2)

    def place(p: Points) -> Points:
        out = reach(p)
        length = np.linalg.norm(p[:, :2], axis=1)
        grown = 1 - out + out * out / np.where(length > 0, length, 1.0)
        return np.column_stack([radius * grown[:, None] * p[:, :2], p[:, 2]])

    def label(faces: Points) -> NDArray[np.str_]:
        far = reach(faces.reshape(-1, 3)).reshape(-1, 3)
        names = np.full(len(faces), "outside")
        for name, angle in (("start", 0.0), ("end", span)) if not closed else ():
            along = faces[..., :2] @ [np.cos(angle), np.sin(angle)]
            across = faces[..., :2] @ [-np.sin(angle), np.cos(angle)]
            names[(abs(across) < 1e-9).all(axis=1) & (along.mean(axis=1) > 0)] = name
        names[(far > 1 - 1e-9).all(axis=1)] = "side"
        names[(faces[..., 2] == heights[0]).all(axis=1)] = "z0"
        names[(faces[..., 2] == heights[-1]).all(axis=1)] = "z1"
        return names

    return quadratic_mesh(points, tets, label, place)


def prisms(triangles: NDArray[np.int_], stride: int, layers: int) -> NDArray[np.int32]:
    """Tets (3 k layers, 4) of prisms over ``triangles`` (k, 3); layer n adds n ``stride``.

    Each prism is cut by the order of its corners' numbers, so that neighbours fit.
    """
    ordered = np.sort(triangles, axis=1)
    tets = []
    for layer in range(layers):
        a, b = ordered + layer * stride, ordered + (layer + 1) * stride
        tets += [np.hstack([a[:, split:], b[:, : split + 1]]) for split in range(3)]
    return np.concatenate(tets).astype(np.int32)


def _fan(rings: int, span: float, sectors: int) -> tuple[Points, NDArray[np.int_]]:
    """Points (n, 2) and triangles (k, 3) of a fan of triangles with corners on the unit circle."""
    angles = span / sectors * np.arange(sectors + 1)
    corners = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points, triangles = [], []
    for one, two in pairwise(corners):
        grid = [(i, j) for i in range(rings + 1) for j in range(rings + 1 - i)]
        first = sum(len(part) for part in points)
        number = {key: first + k for k, key in enumerate(grid)}
        points.append(np.array([(i * one + j * two) / rings for i, j in grid]))
        up = [((i, j), (i + 1, j), (i, j + 1)) for i, j in grid if i + j < rings]
        down = [((i + 1, j), (i + 1, j + 1), (i, j + 1)) for i, j in grid if i + j < rings - 1]
        triangles += [[number[key] for key in keys] for keys in up + down]
    _, kept, numbers = np.unique(
        np.round(np.concatenate(points), 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    return np.concatenate(points)[kept], numbers.reshape(-1)[np.array(triangles)]
