"""A CAD solid with named faces to a mesh of curved quadratic tetrahedra, through Gmsh."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.curving import SMALLEST_RATIO, jacobian_ratios, relaxed
from solver.elements import TETRAHEDRON_EDGES
from solver.mesh import Mesh

HXT, FRONTAL_DELAUNAY, TETRAHEDRON_10 = 10, 6, 11  # Gmsh's numbers
FACES_OF_A_TETRAHEDRON = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # each seen from outside


SIZE_OF_EDGE = 0.83
"""Size to ask of Gmsh for a mean edge of 1: its tetrahedra come out that much larger."""


class MeshingError(RuntimeError):
    """Gmsh could not mesh the solid, or not well enough; the message says where."""


@dataclass(frozen=True)
class SizeField:
    """Edge lengths ``sizes`` (n,) in mm wanted at the nodes of a ``mesh`` of the same body."""

    mesh: Mesh
    sizes: NDArray[np.float64]


@dataclass(frozen=True)
class MeshOptions:
    """Sizes of a mesh.

    - ``size``: largest edge, mm.
    - ``elements_per_circle``: edges on a full circle of every curved face; 0 ignores curvature.
    - ``smallest_size``: smallest edge asked for, mm.
    - ``field``: edges wanted here and there, from ``solver.refinement``; the least size counts.
    """

    size: float = 2.0
    elements_per_circle: float = 4.0
    smallest_size: float = 0.1
    field: SizeField | None = None

    def __post_init__(self) -> None:
        if not 0 < self.smallest_size <= self.size < np.inf:
            raise ValueError(
                f"mesh: size = {self.size:g} mm must be finite and at least smallest_size = "
                f"{self.smallest_size:g} mm, which must be above 0."
            )
        if not 0 <= self.elements_per_circle <= 100:
            raise ValueError(
                f"mesh: elements_per_circle = {self.elements_per_circle:g} must lie between 0 "
                "and 100."
            )


def mesh_solid(brep: Path, face_names: Sequence[str], options: MeshOptions | None = None) -> Mesh:
    """Mesh the single solid in the BREP file ``brep``.

    ``face_names`` names its faces in the file's own order; faces that share a name make one
    surface of the mesh.

    Raises:
        MeshingError: no mesh, or one whose worst element is all but flat.
        ValueError: the number of names is not the number of faces.
    """
    with _gmsh_session() as gmsh:
        faces = _imported_faces(gmsh, brep)
        if len(faces) != len(face_names):
            raise ValueError(f"mesh: {len(face_names)} names for {len(faces)} faces of the solid.")
        _generate(gmsh, options or MeshOptions())
        tags, tets = _tetrahedra(gmsh)
        nodes = _coordinates(gmsh, tags)
        corners = [np.searchsorted(tags, _triangle_corners(gmsh, face)) for face in faces]
    nodes = relaxed(nodes, tets)
    _check_quality(nodes, tets)
    return Mesh(nodes, tets, _named_surfaces(tets, corners, face_names))


@contextmanager
def _gmsh_session() -> Iterator[Any]:
    import gmsh

    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        yield gmsh
    finally:
        gmsh.finalize()


def _imported_faces(gmsh: Any, brep: Path) -> list[int]:
    gmsh.model.occ.importShapes(str(brep))
    gmsh.model.occ.synchronize()
    solids = gmsh.model.getEntities(3)
    if len(solids) != 1:
        raise MeshingError(f"the CAD file holds {len(solids)} solids instead of one")
    return [tag for _, tag in gmsh.model.getEntities(2)]


def _generate(gmsh: Any, options: MeshOptions) -> None:
    settings = {
        "Mesh.MeshSizeMax": options.size,
        "Mesh.MeshSizeMin": options.smallest_size,
        "Mesh.MeshSizeFromCurvature": options.elements_per_circle,
        "Mesh.Algorithm": FRONTAL_DELAUNAY,
        "Mesh.Algorithm3D": HXT,
        "General.NumThreads": 1,  # reproducible node numbers
    }
    for name, value in settings.items():
        gmsh.option.setNumber(name, value)
    if options.field is not None:
        _use_field(gmsh, options.field)
    try:
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
    except Exception as error:  # Gmsh raises bare Exception
        raise MeshingError(f"Gmsh could not mesh the solid: {error}") from error


def _use_field(gmsh: Any, field: SizeField) -> None:
    """Make Gmsh interpolate ``field`` linearly in its mesh's tetrahedra."""
    corners = field.mesh.tets[:, :4]
    points = field.mesh.nodes[corners]
    table = np.hstack([*np.moveaxis(points, 2, 0), SIZE_OF_EDGE * field.sizes[corners]])
    view = gmsh.view.add("sizes")
    gmsh.view.addListData(view, "SS", len(table), table.ravel())
    number = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(number, "ViewTag", view)
    gmsh.model.mesh.field.setAsBackgroundMesh(number)
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)


def _tetrahedra(gmsh: Any) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Sorted Gmsh tags of the nodes in use, (n,), and tetrahedra as positions in them, (e, 10)."""
    _, connectivity = gmsh.model.mesh.getElementsByType(TETRAHEDRON_10)
    if len(connectivity) == 0:
        raise MeshingError("Gmsh made no tetrahedra of the solid")
    tags, positions = np.unique(connectivity.astype(np.int64), return_inverse=True)
    return tags, positions.astype(np.int32).reshape(-1, 10)


def _coordinates(gmsh: Any, tags: NDArray[np.int64]) -> NDArray[np.float64]:
    """Coordinates (n, 3) of the nodes with the sorted ``tags``."""
    known, coordinates, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(known)
    places = order[np.searchsorted(known, tags, sorter=order)]
    points: NDArray[np.float64] = coordinates.reshape(-1, 3)[places]
    return points


def _triangle_corners(gmsh: Any, face: int) -> NDArray[np.int64]:
    """Node tags (k, 3) of the corners of the six-node triangles on a face."""
    _, _, tags = gmsh.model.mesh.getElements(2, face)
    table = np.asarray(tags[0] if tags else (), dtype=np.int64).reshape(-1, 6)
    corners: NDArray[np.int64] = table[:, :3]
    return corners


def _named_surfaces(
    tets: NDArray[np.int32], corners: Sequence[NDArray[np.int64]], names: Sequence[str]
) -> dict[str, NDArray[np.int32]]:
    """Six-node triangles by name, taken from the tetrahedra so that normals point outwards."""
    outward = _faces_of(tets)
    rows = {tuple(key): row for row, key in enumerate(np.sort(outward[:, :3], axis=1).tolist())}
    picked: dict[str, list[int]] = {name: [] for name in names}
    for name, triangles in zip(names, corners, strict=True):
        picked[name] += [rows[tuple(key)] for key in np.sort(triangles, axis=1).tolist()]
    return {name: outward[chosen] for name, chosen in picked.items()}


def _faces_of(tets: NDArray[np.int32]) -> NDArray[np.int32]:
    """Every tetrahedron's four faces as six-node triangles seen from outside it, (4e, 6)."""
    middle = {frozenset(edge): 4 + place for place, edge in enumerate(TETRAHEDRON_EDGES)}
    columns = [
        [*face, *(middle[frozenset((face[k], face[(k + 1) % 3]))] for k in range(3))]
        for face in FACES_OF_A_TETRAHEDRON
    ]
    return np.concatenate([tets[:, column] for column in columns])


def _check_quality(nodes: NDArray[np.float64], tets: NDArray[np.int32]) -> None:
    """Refuse folded elements and name the place of the worst."""
    ratios = jacobian_ratios(nodes, tets)
    worst = int(ratios.argmin())
    if ratios[worst] < SMALLEST_RATIO:
        x, y, z = nodes[tets[worst, :4]].mean(axis=0)
        raise MeshingError(
            f"the mesh has a folded element (Jacobian ratio {ratios[worst]:.2g}) near "
            f"({x:.2f}, {y:.2f}, {z:.2f}) mm; try another mesh size"
        )
