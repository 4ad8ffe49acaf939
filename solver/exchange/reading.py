"""Meshes from files of other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from solver.errors import SolverError
from solver.exchange.abaqus.reading import read_abaqus
from solver.exchange.assembling import assembled
from solver.exchange.found import Found
from solver.exchange.meshio_files import read_meshio
from solver.input_types import file_path, names
from solver.mesh.mesh import Mesh

MESHIO_KINDS = {".msh": "gmsh", ".vtu": "vtu"}
"""meshio's name of each format that it reads for us."""

SUFFIXES = (".inp", *MESHIO_KINDS)


def read_mesh(path: Path | str, regions: Sequence[str] | None = None) -> Mesh:
    """A mesh of tetrahedra from a file of another program, with its named sets.

    Four-node tetrahedra get mid-nodes in the middles of their edges; lengths are taken as mm.
    Triangles become named surfaces where they lie on faces of tetrahedra, and point outwards; so do
    surfaces of elements' faces, and sets of nodes that hold whole outer faces. Sets of elements
    become regions.

    Args:
        path: ``.msh`` (Gmsh 2 or 4; physical groups), ``.inp`` (Abaqus, CalculiX; ``*NSET``,
            ``*ELSET``, ``*SURFACE``), or ``.vtu`` (fields of whole numbers on cells or nodes: of 0
            and 1 a set of the field's name, else a set ``NAME_VALUE`` for each value but 0).
        regions: the sets of elements that are to be regions; without it all but those of every
            element.

    Returns:
        The mesh.

    Raises:
        SolverError: another ending, a file that says no mesh of tetrahedra, with its name and, of a
            ``.inp``, the line; or sets of elements that overlap.
        OSError: the file cannot be read.

    Examples:
        >>> from solver import read_mesh, write_mesh
        >>> from solver.mesh import block
        >>> write_mesh("bar.msh", block((30, 4, 4), (6, 1, 1)))  # mm; as another program might
        >>> bar = read_mesh("bar.msh")
        >>> print(bar.tets.shape, sorted(bar.surfaces))
        (36, 10) ['x0', 'x1', 'y0', 'y1', 'z0', 'z1']
    """
    place = file_path("read_mesh: path", path)
    if place.suffix.lower() not in SUFFIXES:
        raise SolverError(
            f"read_mesh: path must end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}, got "
            f"{str(place)!r}."
        )
    chosen = None if regions is None else names("read_mesh: regions", regions)
    place.stat()  # a missing file is said as such, whatever reads it
    try:
        return assembled(_found(place), chosen)
    except SolverError as error:
        raise SolverError(f"{place.name}: {str(error).removeprefix('mesh: ')}") from None


def _found(path: Path) -> Found:
    suffix = path.suffix.lower()
    return read_abaqus(path) if suffix == ".inp" else read_meshio(path, MESHIO_KINDS[suffix])
