"""Meshes as files for other programs."""

from __future__ import annotations

from pathlib import Path

from solver.errors import SolverError
from solver.exchange.abaqus.mesh_text import mesh_text
from solver.exchange.meshio_files import write_gmsh, write_with_sets
from solver.input_types import check_instance, file_path
from solver.mesh.mesh import Mesh

SUFFIXES = (".inp", ".msh", ".vtu", ".xdmf")


def write_mesh(path: Path | str, mesh: Mesh) -> None:
    """Write a mesh with its surfaces and regions; ``read_mesh`` reads all but ``.xdmf`` back.

    Args:
        path: ``.inp`` (Abaqus, CalculiX), ``.msh`` (Gmsh 2.2), ``.vtu`` or ``.xdmf`` (one file
            each). The file is overwritten.
        mesh: what is written; lengths in mm.

    Raises:
        SolverError: another ending, a name of a set that the format does not take, or a triangle
            that is no face of a tetrahedron.
        OSError: the file cannot be written.

    Examples:
        >>> from pathlib import Path
        >>> from solver import write_mesh
        >>> from solver.mesh import block
        >>> write_mesh("bar.inp", block((30, 4, 4), (6, 1, 1)))  # mm
        >>> "C3D10" in Path("bar.inp").read_text()
        True
    """
    place = file_path("write_mesh: path", path)
    check_instance("write_mesh: mesh", mesh, Mesh)
    suffix = place.suffix.lower()
    if suffix == ".inp":
        place.write_text("\n".join(mesh_text(mesh)) + "\n", "utf-8")
    elif suffix == ".msh":
        write_gmsh(place, mesh)
    elif suffix in (".vtu", ".xdmf"):
        write_with_sets(place, mesh)
    else:
        raise SolverError(
            f"write_mesh: path must end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}, got "
            f"{str(place)!r}."
        )
