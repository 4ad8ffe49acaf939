"""Calls of Gmsh: from a CAD file to nodes and tetrahedra as plain arrays.

Runs in the meshing process, and so imports nothing of the project.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

UNBOUNDED = 1e22  # Gmsh's size of no bound
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
    """The solid has another number of faces, ``count``; of several solids that number ``part``."""

    def __init__(self, count: int, part: int = 0) -> None:
        super().__init__(count)
        self.count, self.part = count, part


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
    with session() as gmsh:
        faces = imported_faces(gmsh, brep)
        if len(faces) != face_count:
            raise OtherFaces(len(faces))
        generate(gmsh, settings, field)
        tags, tets, _ = tetrahedra(gmsh)
        return mesh_arrays(gmsh, tags, tets, faces)


def mesh_arrays(
    gmsh: Any, tags: NDArray[np.int64], tets: NDArray[np.int32], faces: Sequence[int]
) -> dict[str, NDArray[Any]]:
    """``nodes``, ``tets``, ``corners`` and ``counts`` as of ``meshed``, of some faces."""
    corners = [np.searchsorted(tags, triangle_corners(gmsh, face)) for face in faces]
    return {
        "nodes": coordinates_of(gmsh, tags),
        "tets": tets,
        "corners": np.concatenate(corners),
        "counts": np.array([len(each) for each in corners], np.int64),
    }


@contextmanager
def session() -> Iterator[Any]:
    """Gmsh with an empty model."""
    import gmsh

    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        yield gmsh
    finally:
        gmsh.finalize()


def imported_faces(gmsh: Any, brep: Path) -> list[int]:
    """Tags of the faces of the one solid in ``brep``, in the file's order, added to the model."""
    solids, faces = (len(gmsh.model.getEntities(dimension)) for dimension in (3, 2))
    try:
        gmsh.model.occ.importShapes(str(brep))
    except Exception as error:  # Gmsh raises bare Exception
        raise Refusal(f"Gmsh could not read the solid: {error}") from error
    gmsh.model.occ.synchronize()
    added = len(gmsh.model.getEntities(3)) - solids
    if added != 1:
        raise Refusal(f"the CAD file holds {added} solids instead of one")
    return [tag for _, tag in gmsh.model.getEntities(2)[faces:]]


def generate(
    gmsh: Any,
    settings: Mapping[str, float],
    field: NDArray[np.float64],
    sizes: Mapping[int, float] | None = None,
) -> None:
    """Make the mesh; ``sizes`` are the largest edges in some solids, mm by tag."""
    for name, value in (FIXED | dict(settings)).items():
        gmsh.option.setNumber(name, value)
    _use_fields(gmsh, field, sizes or {})
    try:
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
    except Exception as error:  # Gmsh raises bare Exception
        raise Refusal(f"Gmsh could not mesh the solid: {error}") from error


def _use_fields(gmsh: Any, field: NDArray[np.float64], sizes: Mapping[int, float]) -> None:
    """Make the least of the field's and the solids' sizes the background of the mesh."""
    numbers = [_size_in(gmsh, solid, size) for solid, size in sizes.items()]
    if len(field):
        numbers.append(_interpolation(gmsh, field))
        gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
    if numbers:
        gmsh.model.mesh.field.setAsBackgroundMesh(_least(gmsh, numbers))


def _interpolation(gmsh: Any, field: NDArray[np.float64]) -> int:
    """Number of a field of sizes that are linear in the given tetrahedra."""
    view = gmsh.view.add("sizes")
    gmsh.view.addListData(view, "SS", len(field), field.ravel())
    number = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(number, "ViewTag", view)
    return int(number)


def _size_in(gmsh: Any, solid: int, size: float) -> int:
    """Number of a field with one size in and on a solid; Gmsh grades the sizes around it."""
    number = gmsh.model.mesh.field.add("Constant")
    gmsh.model.mesh.field.setNumber(number, "VIn", size)
    gmsh.model.mesh.field.setNumber(number, "VOut", UNBOUNDED)
    gmsh.model.mesh.field.setNumbers(number, "VolumesList", [solid])
    return int(number)


def _least(gmsh: Any, numbers: Sequence[int]) -> int:
    """Number of the field that is the least of others."""
    if len(numbers) == 1:
        return numbers[0]
    least = gmsh.model.mesh.field.add("Min")
    gmsh.model.mesh.field.setNumbers(least, "FieldsList", numbers)
    return int(least)


def tetrahedra(
    gmsh: Any, solids: Sequence[int] = (-1,)
) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.int64]]:
    """Tetrahedra of some solids, one solid after the other; without tags, of the whole model.

    Returns the sorted Gmsh tags of the nodes in use, (n,), tetrahedra as positions in them,
    (e, 10), and how many of them each solid has.
    """
    parts = [gmsh.model.mesh.getElementsByType(TETRAHEDRON_10, solid)[1] for solid in solids]
    connectivity = np.concatenate(parts)
    if len(connectivity) == 0:
        raise Refusal("Gmsh made no tetrahedra of the solid")
    tags, positions = np.unique(connectivity.astype(np.int64), return_inverse=True)
    counts = np.array([len(part) // 10 for part in parts], np.int64)
    return tags, positions.astype(np.int32).reshape(-1, 10), counts


def coordinates_of(gmsh: Any, tags: NDArray[np.int64]) -> NDArray[np.float64]:
    """Coordinates (n, 3) of the nodes with the sorted ``tags``."""
    known, coordinates, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(known)
    places = order[np.searchsorted(known, tags, sorter=order)]
    points: NDArray[np.float64] = coordinates.reshape(-1, 3)[places]
    return points


def triangle_corners(gmsh: Any, face: int) -> NDArray[np.int64]:
    """Node tags (k, 3) of the corners of the six-node triangles on a face."""
    _, _, tags = gmsh.model.mesh.getElements(2, face)
    table = np.asarray(tags[0] if tags else (), dtype=np.int64).reshape(-1, 6)
    corners: NDArray[np.int64] = table[:, :3]
    return corners
