"""Calls of Gmsh for several solids that touch: one mesh in which they share faces and nodes.

Runs in the meshing process, and so imports nothing of the project but ``gmsh_calls``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.meshing.gmsh_calls import (
    OtherFaces,
    Refusal,
    generate,
    imported_faces,
    mesh_arrays,
    session,
    tetrahedra,
)

TOUCHING = 1e-5
"""Gap or overlap, mm, below which faces coincide: CAD files are hardly more exact."""

DIAGONALS = 10
"""Gmsh makes no edge longer than the bounding box's diagonal over this."""

USUAL_QUALITY = 0.3
"""Gmsh's own least quality of elements, of which 1 is the best."""

OUTSIDE = -1
"""In place of the number of a part: none."""


@dataclass(frozen=True)
class Solid:
    """A part: its file, number of faces, name and largest edge in mm (0: none of its own)."""

    brep: Path
    faces: int
    name: str
    size: float = 0.0


def meshed_parts(
    solids: Sequence[Solid], settings: Mapping[str, float], field: NDArray[np.float64]
) -> dict[str, NDArray[Any]]:
    """Arrays of one mesh of several solids; ``settings`` and ``field`` as of ``meshed``.

    Where faces of two solids coincide they become one face; faces are divided for that into
    pieces.

    Returns ``nodes`` (n, 3) mm, ``tets`` (e, 10), one solid after the other, ``sizes``: how many
    each solid has, ``corners`` (k, 3): node numbers of the triangles on all pieces, ``counts``
    (p,): how many of them each piece has, ``sides`` (p, 2): numbers of the solids on both sides of
    each piece, the lower one first and ``OUTSIDE`` for none, and ``sources`` (s, 2): numbers of a
    face, counted through all solids, and of a piece of it.
    Raises ``Refusal`` and ``OtherFaces``.
    """
    with session() as gmsh:
        gmsh.option.setNumber("Geometry.ToleranceBoolean", TOUCHING)
        faces = [
            face for number, solid in enumerate(solids) for face in _faces(gmsh, number, solid)
        ]
        bodies, sources = _fragments(gmsh, faces, solids)
        pieces = sorted({piece for _, piece in sources})
        sides = _sides(gmsh, bodies, pieces)
        _check_connected(sides, [solid.name for solid in solids])
        quality = _reachable(gmsh, bodies, solids, settings["Mesh.MeshSizeMax"])
        tuned = {**settings, "Mesh.OptimizeThreshold": min(quality, USUAL_QUALITY)}
        generate(gmsh, tuned, field, _sizes(bodies, solids))
        tags, tets, counts = tetrahedra(gmsh, bodies)
        places = [(face, pieces.index(piece)) for face, piece in sources]
        extent = {"sizes": counts, "sides": sides, "sources": np.array(places, np.int64)}
        return mesh_arrays(gmsh, tags, tets, pieces) | extent


def _faces(gmsh: Any, number: int, solid: Solid) -> list[int]:
    """Tags of the faces of a solid, which is added to the model."""
    try:
        faces = imported_faces(gmsh, solid.brep)
    except Refusal as refusal:
        raise Refusal(f"part {solid.name!r}: {refusal}") from refusal
    if len(faces) != solid.faces:
        raise OtherFaces(len(faces), number)
    return faces


def _fragments(
    gmsh: Any, faces: Sequence[int], solids: Sequence[Solid]
) -> tuple[list[int], list[tuple[int, int]]]:
    """Tags of the bodies that share faces, and each face's number with the tag of each piece."""
    given = gmsh.model.getEntities(3) + [(2, face) for face in faces]
    areas = [gmsh.model.occ.getMass(2, face) for face in faces]
    # where it removes the given shapes, Gmsh's map from faces to their pieces is wrong
    try:
        _, found = gmsh.model.occ.fragment(given, [], removeObject=False, removeTool=False)
    except Exception as error:  # Gmsh raises bare Exception
        raise Refusal(f"Gmsh could not join the parts: {error}") from error
    tags = [[tag for _, tag in pieces] for pieces in found]
    bodies, pieces = tags[: len(solids)], tags[len(solids) :]
    _check_apart(gmsh, bodies, [solid.name for solid in solids])
    gmsh.model.occ.remove([each for each in given[: len(solids)] if [each[1]] not in bodies], True)
    gmsh.model.occ.synchronize()
    _check_origin(gmsh, areas, pieces)
    return (
        [body for (body,) in bodies],
        [(number, tag) for number, own in enumerate(pieces) for tag in own],
    )


def _check_origin(gmsh: Any, areas: Sequence[float], pieces: Sequence[Sequence[int]]) -> None:
    """Raise ``Refusal`` unless the pieces of each face have its area, and there are no others."""
    found = [sum(gmsh.model.occ.getMass(2, tag) for tag in tags) for tags in pieces]
    known = {(2, tag) for tags in pieces for tag in tags}
    if known != set(gmsh.model.getEntities(2)) or not np.allclose(found, areas, rtol=1e-4):
        raise Refusal("Gmsh lost faces where it joined the parts; move the parts a little")


def _check_apart(gmsh: Any, bodies: Sequence[Sequence[int]], names: Sequence[str]) -> None:
    """Raise ``Refusal`` if a body belongs to two parts, or a part to more than one body."""
    owner: dict[int, str] = {}
    for name, tags in zip(names, bodies, strict=True):
        for tag in tags:
            if tag in owner:
                volume = gmsh.model.occ.getMass(3, tag)
                raise Refusal(
                    f"the parts {owner[tag]!r} and {name!r} overlap in {volume:.3g} mm^3; cut one "
                    "out of the other"
                )
            owner[tag] = name
    for name, tags in zip(names, bodies, strict=True):
        if len(tags) != 1:
            raise Refusal(f"the faces of the other parts divide the part {name!r} into {len(tags)}")


def _sides(gmsh: Any, bodies: Sequence[int], pieces: Sequence[int]) -> NDArray[np.int64]:
    """Numbers of the parts on both sides of each piece, the lower one first, (p, 2)."""
    number = {body: place for place, body in enumerate(bodies)}
    sides = np.full((len(pieces), 2), OUTSIDE, np.int64)
    for row, piece in zip(sides, pieces, strict=True):
        around = sorted(number[int(body)] for body in gmsh.model.getAdjacencies(2, piece)[0])
        row[: len(around)] = around
    return sides


def _check_connected(sides: NDArray[np.int64], names: Sequence[str]) -> None:
    """Raise ``Refusal`` unless one gets from the first part to all others through faces."""
    reached, pairs = {0}, [set(pair) for pair in sides.tolist() if OUTSIDE not in pair]
    while more := {part for pair in pairs if pair & reached for part in pair} - reached:
        reached |= more
    for number, name in enumerate(names):
        if number not in reached:
            others = " or ".join(repr(names[other]) for other in sorted(reached))
            raise Refusal(
                f"no face of the part {name!r} touches {others}, directly or through other parts"
            )


def _reachable(gmsh: Any, bodies: Sequence[int], solids: Sequence[Solid], size: float) -> float:
    """Quality that elements in the thinnest part may have: thickness over edges, at most.

    Gmsh improves elements as long as some are worse than it is told, and takes a hundred times as
    long where the thickness of a film keeps them so.
    """
    x0, y0, z0, x1, y1, z1 = gmsh.model.getBoundingBox(-1, -1)
    edge = min(size, float(np.linalg.norm([x1 - x0, y1 - y0, z1 - z0])) / DIAGONALS)
    ratios = []
    for body, solid in zip(bodies, solids, strict=True):
        faces = gmsh.model.getBoundary([(3, body)], combined=False, oriented=False)
        area = sum(gmsh.model.occ.getMass(*face) for face in faces)
        thickness = 2 * gmsh.model.occ.getMass(3, body) / area
        ratios.append(thickness / min(edge, solid.size or edge))
    return min(ratios)


def _sizes(bodies: Sequence[int], solids: Sequence[Solid]) -> dict[int, float]:
    """Largest edge, mm, in each body that has one of its own."""
    pairs = zip(bodies, solids, strict=True)
    return {body: solid.size for body, solid in pairs if solid.size > 0}
