"""Calls of Gmsh: from a CAD file to nodes and tetrahedra as plain arrays.

Runs in the meshing process, and so imports nothing of the project.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

HXT, FRONTAL_DELAUNAY, TETRAHEDRON_10 = 10, 6, 11  # Gmsh's numbers

FIXED = {
    "Mesh.Algorithm": FRONTAL_DELAUNAY,
    "Mesh.Algorithm3D": HXT,
    "General.NumThreads": 1,  # reproducible node numbers
}
"""Settings of every mesh."""


class Refusal(Exception):
    """Gmsh cannot mesh this; the message says why."""


class OtherFaces(Exception):
    """The solid has another number of faces, ``count``."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.count = count


def meshed(
    brep: Path, face_count: int, settings: Mapping[str, float], field: NDArray[np.float64]
) -> dict[str, NDArray[Any]]:
    """Arrays of the mesh of the one solid in ``brep``, which must have so many faces.

    ``settings`` are Gmsh's options by name. ``field`` is (t, 16): for each of t tetrahedra x, y
    and z of the corners (x of all four first) and the sizes wanted at them, mm; t = 0 for none.

    Returns ``nodes`` (n, 3) mm, ``tets`` (e, 10), ``corners`` (k, 3): node numbers of the
    triangles on all faces, and ``counts`` (face_count,): how many of them each face has.
    Raises ``Refusal`` and ``OtherFaces``.
    """
    with _session() as gmsh:
        faces = _imported_faces(gmsh, brep)
        if len(faces) != face_count:
            raise OtherFaces(len(faces))
        _generate(gmsh, settings, field)
        tags, tets = _tetrahedra(gmsh)
        corners = [np.searchsorted(tags, _triangle_corners(gmsh, face)) for face in faces]
        return {
            "nodes": _coordinates(gmsh, tags),
            "tets": tets,
            "corners": np.concatenate(corners),
            "counts": np.array([len(each) for each in corners], np.int64),
        }


@contextmanager
def _session() -> Iterator[Any]:
    import gmsh

    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        yield gmsh
    finally:
        gmsh.finalize()


def _imported_faces(gmsh: Any, brep: Path) -> list[int]:
    try:
        gmsh.model.occ.importShapes(str(brep))
    except Exception as error:  # Gmsh raises bare Exception
        raise Refusal(f"Gmsh could not read the solid: {error}") from error
    gmsh.model.occ.synchronize()
    solids = gmsh.model.getEntities(3)
    if len(solids) != 1:
        raise Refusal(f"the CAD file holds {len(solids)} solids instead of one")
    return [tag for _, tag in gmsh.model.getEntities(2)]


def _generate(gmsh: Any, settings: Mapping[str, float], field: NDArray[np.float64]) -> None:
    for name, value in (FIXED | dict(settings)).items():
        gmsh.option.setNumber(name, value)
    if len(field):
        _use_field(gmsh, field)
    try:
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
    except Exception as error:  # Gmsh raises bare Exception
        raise Refusal(f"Gmsh could not mesh the solid: {error}") from error


def _use_field(gmsh: Any, field: NDArray[np.float64]) -> None:
    """Make Gmsh interpolate the sizes linearly in the field's tetrahedra."""
    view = gmsh.view.add("sizes")
    gmsh.view.addListData(view, "SS", len(field), field.ravel())
    number = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(number, "ViewTag", view)
    gmsh.model.mesh.field.setAsBackgroundMesh(number)
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)


def _tetrahedra(gmsh: Any) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Sorted Gmsh tags of the nodes in use, (n,), and tetrahedra as positions in them, (e, 10)."""
    _, connectivity = gmsh.model.mesh.getElementsByType(TETRAHEDRON_10)
    if len(connectivity) == 0:
        raise Refusal("Gmsh made no tetrahedra of the solid")
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
