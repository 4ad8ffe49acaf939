"""Several CAD solids that touch to one mesh, in which they share nodes, through Gmsh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers
from solver.errors import SolverError
from solver.input_types import check_number, members_of, names, shown
from solver.mesh.mesh import Mesh
from solver.meshing.messages import Message
from solver.meshing.process import DEFAULT_SECONDS
from solver.meshing.solid import (
    MeshOptions,
    answer_to,
    check_call,
    check_solid,
    content_of,
    field_table,
    gmsh_settings,
    named_surfaces,
    unfolded,
)

BETWEEN = "|"
"""Stands between the names of two parts in the name of the surface that they share."""

OUTSIDE = -1
"""As in ``gmsh_parts``."""


@dataclass(frozen=True)
class Part:
    """A solid of a mesh of several.

    Attributes:
        name: of the region of the mesh.
        brep: a BREP file with a single solid, or the content of one.
        face_names: names of its faces in the file's order; faces of one name, also of several
            parts, make one surface of the mesh.
        size: largest edge in this part, mm, if less than that of the mesh's options.

    Raises:
        SolverError: a name that is empty or has a "|", or a size that is not above 0 and finite.

    Examples:
        >>> from io import BytesIO
        >>> import cadquery as cq
        >>> from solver.meshing import Part
        >>> content, plate = BytesIO(), cq.Solid.makeBox(20, 10, 1)
        >>> plate.exportBrep(content)
        True
        >>> print(Part("plate", content.getvalue(), ["outside"] * 6, size=0.5).name)
        plate
    """

    name: str
    brep: Path | bytes
    face_names: Sequence[str]
    size: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name:
            raise SolverError(f"part: name must be a text, got {shown(self.name)}.")
        check_solid(f"part {self.name!r}: brep", self.brep)
        given = names(f"part {self.name!r}: face_names", self.face_names)
        for name in (self.name, *given):
            if BETWEEN in name:
                raise SolverError(
                    f"part {self.name!r}: the name {name!r} must not have a {BETWEEN!r}, which "
                    "joins the names of two parts that touch."
                )
        object.__setattr__(self, "face_names", given)
        _check_size(self.name, self.size)


def mesh_solids(
    parts: Sequence[Part],
    options: MeshOptions | None = None,
    seconds: float = DEFAULT_SECONDS,
) -> Mesh:
    """Mesh solids that touch, so that they share the nodes where they do.

    Gmsh runs in a process of its own. Where faces of two parts coincide within 1e-5 mm, wholly or
    partly, the common piece becomes the surface ``"first|second"``, named in the order of the parts
    and oriented out of the first. The surfaces with the names of faces have the pieces on the
    outside.

    Args:
        parts: the solids, which must not overlap, and of which each must be connected to all
            others through faces.
        options: sizes of elements in all parts.
        seconds: time limit, s.

    Returns:
        Curved quadratic tetrahedra with the named surfaces, and a region by each part's name. A
        surface is empty if other parts cover all of its faces.

    Raises:
        MeshingError: parts overlap, or are not connected; no mesh, none within ``seconds``, or one
            with a folded or almost flat element.
        SolverError: names of parts that are not different, a number of names that is not that of
            the faces, a part's size below the smallest of the options, or ``seconds`` not above 0.
        OSError: a file cannot be read, or Gmsh cannot be loaded.

    Examples:
        >>> from io import BytesIO
        >>> import cadquery as cq
        >>> from solver.meshing import MeshOptions, Part, mesh_solids
        >>> def box(name, height, z):
        ...     content = BytesIO()
        ...     cq.Solid.makeBox(20, 10, height, cq.Vector(0, 0, z)).exportBrep(content)
        ...     return Part(name, content.getvalue(), ["outside"] * 6)
        >>> parts = [box("rubber", 4, 0), box("plate", 1, 4)]
        >>> mesh = mesh_solids(parts, MeshOptions(size=4.0))
        >>> print(mesh.region_names, sorted(mesh.surfaces))
        ('', 'rubber', 'plate') ['outside', 'rubber|plate']
    """
    given = _checked(parts)
    check_call(options, seconds)
    options = options or MeshOptions()
    _check_sizes(given, options.smallest_size)
    breps = [content_of(part.brep) for part in given]
    arrays, nodes = unfolded(
        lambda factor: _arrays_from_gmsh(given, _job(given, breps, options, factor), seconds)
    )
    ends = np.cumsum(arrays["sizes"])
    regions = {
        part.name: np.arange(end - count, end, dtype=np.int32)
        for part, count, end in zip(given, arrays["sizes"], ends, strict=True)
    }
    return Mesh(nodes, arrays["tets"], _surfaces(given, arrays), regions)


def _checked(parts: Sequence[Part]) -> tuple[Part, ...]:
    """The parts; raises ``SolverError`` unless there are some, with different names."""
    given = tuple(
        each for each in members_of("mesh: parts", parts, (Part,)) if isinstance(each, Part)
    )
    if not given:
        raise SolverError("mesh: parts must have at least one Part, got none.")
    known = [part.name for part in given]
    for place, name in enumerate(known):
        if name in known[:place]:
            raise SolverError(f"mesh: two parts are called {name!r}; each needs a name of its own.")
    return given


def _check_size(name: str, size: float | None) -> None:
    if size is None:
        return
    check_number(f"part {name!r}: size", size)
    if not 0 < size < np.inf:
        raise SolverError(f"part {name!r}: size = {size:g} mm must be finite and above 0.")


def _check_sizes(parts: Sequence[Part], smallest: float) -> None:
    """Raise ``SolverError`` for a part's size below the smallest one of the options, mm."""
    for part in parts:
        if part.size is not None and part.size < smallest:
            raise SolverError(
                f"part {part.name!r}: size = {part.size:g} mm must be at least the options' "
                f"smallest_size = {smallest:g} mm."
            )


def _job(
    parts: Sequence[Part], breps: Sequence[bytes], options: MeshOptions, factor: float
) -> Message:
    """What to mesh, all sizes multiplied by a factor, for ``worker``."""
    smaller = options.scaled(factor)
    solids = [
        {"name": part.name, "faces": len(part.face_names), "size": factor * (part.size or 0.0)}
        for part in parts
    ]
    contents = {f"brep {k}": np.frombuffer(brep, np.uint8) for k, brep in enumerate(breps)}
    return Message(
        {"parts": solids, "settings": gmsh_settings(smaller)},
        contents | {"field": field_table(smaller.field)},
    )


def _arrays_from_gmsh(
    parts: Sequence[Part], job: Message, seconds: float
) -> Mapping[str, NDArray[Any]]:
    """The result of ``gmsh_parts.meshed_parts`` in the other process."""
    answer = answer_to(job, seconds)
    if "faces" in answer.values:
        part = parts[answer.values["part"]]
        raise SolverError(
            f"part {part.name!r}: {len(part.face_names)} names for {answer.values['faces']} faces "
            "of the solid."
        )
    return answer.arrays


def _surfaces(parts: Sequence[Part], arrays: Mapping[str, NDArray[Any]]) -> dict[str, Integers]:
    """Six-node triangles by the names of faces and of pairs of parts."""
    corners = np.split(arrays["corners"], np.cumsum(arrays["counts"])[:-1])
    tets = np.split(arrays["tets"], np.cumsum(arrays["sizes"])[:-1])
    names_of = _names_of_pieces(parts, arrays)
    found: dict[str, list[Integers]] = {name: [] for part in parts for name in part.face_names}
    for number, own in enumerate(tets):
        chosen = [(p, name) for p, name in names_of if arrays["sides"][p, 0] == number]
        named = named_surfaces(own, [corners[p] for p, _ in chosen], [name for _, name in chosen])
        for name, triangles in named.items():
            found.setdefault(name, []).append(triangles)
    none = np.empty((0, 6), np.int32)
    return {name: np.concatenate([none, *triangles]) for name, triangles in found.items()}


def _names_of_pieces(
    parts: Sequence[Part], arrays: Mapping[str, NDArray[Any]]
) -> list[tuple[int, str]]:
    """Numbers of pieces with their names, each pair once: a common piece is one of two faces."""
    face_names = [name for part in parts for name in part.face_names]
    pairs: dict[tuple[int, str], None] = {}
    for face, piece in arrays["sources"].tolist():
        first, second = arrays["sides"][piece]
        common = BETWEEN.join((parts[first].name, parts[second].name))
        pairs[piece, face_names[face] if second == OUTSIDE else common] = None
    return list(pairs)
