"""A CAD solid with named faces to a mesh of curved quadratic tetrahedra, through Gmsh."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Reals
from solver.errors import MeshingError, SolverError
from solver.input_types import check_instance, check_number, names, shown
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.mesh import Mesh
from solver.mesh.mid_nodes import SMALLEST_RATIO, jacobian_ratios, relaxed
from solver.meshing.messages import Message
from solver.meshing.process import DEFAULT_SECONDS, MesherCrash, MesherTimeout, ask

FACES_OF_A_TETRAHEDRON = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # outward normals

SIZE_OF_EDGE = 0.83
"""Size to prescribe to Gmsh for a mean edge of 1: its tetrahedra are larger."""


@dataclass(frozen=True)
class SizeField:
    """Wanted edge lengths of the next mesh, as a field on a mesh of the same body.

    Attributes:
        mesh: the present mesh.
        sizes: wanted at its nodes.

            *Shape:* (n,) in mm.

    Examples:
        >>> import numpy as np
        >>> from io import BytesIO
        >>> import cadquery as cq
        >>> from solver.meshing import MeshOptions, SizeField, mesh_solid
        >>> content = BytesIO()
        >>> cq.Solid.makeBox(20, 4, 4).exportBrep(content)
        True
        >>> coarse = mesh_solid(content.getvalue(), ["outside"] * 6, MeshOptions(size=4.0))
        >>> sizes = np.where(coarse.nodes[:, 0] < 5, 0.8, 4.0)  # fine at one end
        >>> options = MeshOptions(size=4.0, field=SizeField(coarse, sizes))
        >>> fine = mesh_solid(content.getvalue(), ["outside"] * 6, options)
        >>> print(len(fine.tets) > 3 * len(coarse.tets))
        True
    """

    mesh: Mesh
    sizes: NDArray[np.float64]


@dataclass(frozen=True)
class MeshOptions:
    """Wanted sizes of elements.

    Attributes:
        size: largest edge, mm.
        elements_per_circle: edges on a full circle of every curved face; 0 ignores curvature.
        smallest_size: lower bound of the wanted edges, mm.
        field: local edge lengths, from ``refined_sizes``; the least of all sizes counts.

    Raises:
        SolverError: sizes that are not positive, finite and in order, or elements per circle
            outside of 0 to 100.

    Examples:
        >>> from solver.meshing import MeshOptions
        >>> print(MeshOptions(size=1.5, elements_per_circle=8.0))
        MeshOptions(size=1.5, elements_per_circle=8.0, smallest_size=0.1, field=None)
    """

    size: float = 2.0
    elements_per_circle: float = 4.0
    smallest_size: float = 0.1
    field: SizeField | None = None

    def __post_init__(self) -> None:
        for name in ("size", "elements_per_circle", "smallest_size"):
            check_number(f"mesh: {name}", getattr(self, name))
        check_instance("mesh: field", self.field, SizeField, optional=True)
        if not 0 < self.smallest_size <= self.size < np.inf:
            raise SolverError(
                f"mesh: size = {self.size:g} mm must be finite and at least smallest_size = "
                f"{self.smallest_size:g} mm, which must be above 0."
            )
        if not 0 <= self.elements_per_circle <= 100:
            raise SolverError(
                f"mesh: elements_per_circle = {self.elements_per_circle:g} must lie between 0 "
                "and 100."
            )

    def scaled(self, factor: float) -> MeshOptions:
        """The same with all sizes multiplied by a factor."""
        if factor == 1.0:
            return self
        field = None if self.field is None else replace(self.field, sizes=factor * self.field.sizes)
        return replace(
            self, size=factor * self.size, smallest_size=factor * self.smallest_size, field=field
        )


def mesh_solid(
    brep: Path | bytes,
    face_names: Sequence[str],
    options: MeshOptions | None = None,
    seconds: float = DEFAULT_SECONDS,
) -> Mesh:
    """Mesh a solid with named faces.

    Gmsh runs in a process of its own.

    Args:
        brep: a BREP file with a single solid, or the content of one.
        face_names: names of its faces in the file's order; faces that share a name make one surface
            of the mesh.
        options: sizes of elements.
        seconds: time limit, s.

    Returns:
        Curved quadratic tetrahedra with the named surfaces.

    Raises:
        MeshingError: no mesh, none within ``seconds``, or one with a folded or almost flat element.
        SolverError: the number of names is not the number of faces, or ``seconds`` is not above 0.
        OSError: ``brep`` cannot be read, or Gmsh cannot be loaded.

    Examples:
        >>> from io import BytesIO
        >>> import cadquery as cq
        >>> from solver.meshing import MeshOptions, mesh_solid
        >>> content, solid = BytesIO(), cq.Solid.makeCylinder(5, 20)
        >>> solid.exportBrep(content)
        True
        >>> names = ["bottom" if face.Center().z < 0.1 else "outside" for face in solid.Faces()]
        >>> mesh = mesh_solid(content.getvalue(), names, MeshOptions(size=4.0))
        >>> print(sorted(mesh.surfaces), mesh.tets.shape[1])
        ['bottom', 'outside'] 10
    """
    check_solid("mesh: brep", brep)
    check_call(options, seconds)
    face_names = names("mesh: face_names", face_names)
    content, wanted = content_of(brep), options or MeshOptions()
    arrays, nodes = unfolded(
        lambda factor: _from_gmsh(content, len(face_names), wanted.scaled(factor), seconds)
    )
    corners = np.split(arrays["corners"], np.cumsum(arrays["counts"])[:-1])
    return Mesh(nodes, arrays["tets"], named_surfaces(arrays["tets"], corners, face_names))


def check_solid(what: str, brep: object) -> None:
    """Raise ``SolverError`` unless ``brep`` may be a solid."""
    if not isinstance(brep, Path | bytes):
        raise SolverError(
            f"{what} must be a Path of a BREP file or the content of one as bytes, got "
            f"{shown(brep)}."
        )


def content_of(brep: Path | bytes) -> bytes:
    """What a BREP file has, or what is given of one."""
    return brep if isinstance(brep, bytes) else brep.read_bytes()


def check_call(options: object, seconds: float) -> None:
    """Raise ``SolverError`` for other options and time limits than these calls take."""
    check_instance("mesh: options", options, MeshOptions, optional=True)
    check_number("mesh: seconds", seconds)
    if not 0 < seconds < np.inf:
        raise SolverError(f"mesh: seconds = {seconds:g} must be finite and above 0.")


SIZES_TRIED = (1.0, 0.93, 0.87)
"""Factors on the sizes wanted, until no element is folded: that is a matter of chance."""


def unfolded(
    mesh: Callable[[float], Mapping[str, NDArray[Any]]],
) -> tuple[Mapping[str, NDArray[Any]], Reals]:
    """The first arrays of a ``mesh`` without folded elements, and the nodes that make them so.

    ``mesh`` takes a factor on the sizes. Raises ``MeshingError`` if there is none.
    """
    folded = ""
    for factor in SIZES_TRIED:
        arrays = mesh(factor)
        nodes = relaxed(arrays["nodes"], arrays["tets"])
        folded = _folded_element(nodes, arrays["tets"])
        if not folded:
            return arrays, nodes
    raise MeshingError(folded)


def _from_gmsh(
    brep: bytes, faces: int, options: MeshOptions, seconds: float
) -> Mapping[str, NDArray[Any]]:
    """The result of ``gmsh_calls.meshed`` in the other process."""
    job = Message(
        {"faces": faces, "settings": gmsh_settings(options)},
        {"brep": np.frombuffer(brep, np.uint8), "field": field_table(options.field)},
    )
    answer = answer_to(job, seconds)
    if "faces" in answer.values:
        raise SolverError(f"mesh: {faces} names for {answer.values['faces']} faces of the solid.")
    return answer.arrays


def answer_to(job: Message, seconds: float) -> Message:
    """The meshing process's answer to ``job``; raises the error that it reports."""
    try:
        answer = ask(job, seconds)
    except MesherTimeout:
        raise MeshingError(
            f"Gmsh did not mesh the solid within {seconds:g} s and was stopped; allow it more "
            "time, or change the design's thinnest walls and smallest fillets"
        ) from None
    except MesherCrash as crash:
        if crash.cause is not None:
            raise MeshingError(crash.cause) from None
        raise MeshingError(f"Gmsh crashed on this solid ({crash}); try other numbers") from None
    if "failed" in answer.values:
        raise OSError(answer.values["failed"])
    if "refused" in answer.values:
        raise MeshingError(answer.values["refused"])
    return answer


def gmsh_settings(options: MeshOptions) -> dict[str, float]:
    """Gmsh's options by name."""
    return {
        "Mesh.MeshSizeMax": options.size,
        "Mesh.MeshSizeMin": options.smallest_size,
        "Mesh.MeshSizeFromCurvature": options.elements_per_circle,
    }


def field_table(field: SizeField | None) -> Reals:
    """Corners and wanted sizes of the field's tetrahedra (t, 16); see ``gmsh_calls.meshed``."""
    if field is None:
        return np.empty((0, 16))
    corners = field.mesh.tets[:, :4]
    points = field.mesh.nodes[corners]
    return np.hstack([*np.moveaxis(points, 2, 0), SIZE_OF_EDGE * field.sizes[corners]])


def named_surfaces(
    tets: NDArray[np.int32], corners: Sequence[NDArray[np.int64]], names: Sequence[str]
) -> dict[str, NDArray[np.int32]]:
    """Six-node triangles by name, taken from the tetrahedra so that normals point outwards."""
    outward = _faces_of(tets)
    keys = _corner_keys(outward[:, :3])
    order = np.argsort(keys, kind="stable")
    picked: dict[str, list[NDArray[np.int32]]] = {name: [] for name in names}
    for name, triangles in zip(names, corners, strict=True):
        wanted = _corner_keys(triangles)
        found = order[np.minimum(np.searchsorted(keys, wanted, sorter=order), len(keys) - 1)]
        if (keys[found] != wanted).any():
            raise MeshingError(f"a triangle of the surface {name!r} is no face of a tetrahedron")
        picked[name].append(outward[found])
    return {name: np.concatenate(chosen) for name, chosen in picked.items()}


def _corner_keys(corners: NDArray[Any]) -> NDArray[np.int64]:
    """One number for the corners (k, 3) of each triangle, whatever their order, (k,)."""
    low, middle, high = np.sort(corners.astype(np.int64), axis=1).T
    keys: NDArray[np.int64] = (low << 42) + (middle << 21) + high
    return keys


def _faces_of(tets: NDArray[np.int32]) -> NDArray[np.int32]:
    """Every tetrahedron's four faces as six-node triangles with outward normals, (4e, 6)."""
    middle = {frozenset(edge): 4 + place for place, edge in enumerate(TETRAHEDRON_EDGES)}
    columns = [
        [*face, *(middle[frozenset((face[k], face[(k + 1) % 3]))] for k in range(3))]
        for face in FACES_OF_A_TETRAHEDRON
    ]
    return np.concatenate([tets[:, column] for column in columns])


def _folded_element(nodes: NDArray[np.float64], tets: NDArray[np.int32]) -> str:
    """A sentence on folded elements, with the position of the worst; empty without any."""
    ratios = jacobian_ratios(nodes, tets)
    worst = int(ratios.argmin())
    if ratios[worst] >= SMALLEST_RATIO:
        return ""
    x, y, z = nodes[tets[worst, :4]].mean(axis=0)
    return (
        f"every mesh has a folded element (Jacobian ratio {ratios[worst]:.2g}), the last one near "
        f"({x:.2f}, {y:.2f}, {z:.2f}) mm; change the walls or fillets there a little"
    )
