"""A solution as a file for ParaView."""

from __future__ import annotations

from pathlib import Path

from solver.errors import SolverError
from solver.input_types import file_path
from solver.results.solution import Solution, check_solution
from solver.results.stress import nodal_pressure, nodal_von_mises


def write_vtu(path: Path | str, solution: Solution) -> None:
    """Write a file for ParaView.

    It holds the undeformed mesh with displacement (mm), von Mises stress and hydrostatic pressure
    (MPa) at the nodes, and in the cells the numbers of their regions: 0 for the rest, then in the
    order of ``Mesh.regions``. A node between regions has the values of the one in which its von
    Mises stress is largest.

    Args:
        path: of the file, ending in ``.vtu``; it is overwritten.
        solution: an equilibrium.

    Raises:
        SolverError: a path with another ending.
        OSError: the file cannot be written.

    Examples:
        >>> from solver import Ogden, Problem, Supports, Traction, solve, write_vtu
        >>> from solver.mesh import block
        >>> bend = Traction("x1", (0, 0, -0.001))
        >>> rubber = Ogden.neo_hooke(0.5)  # MPa
        >>> bar = Problem(block((30, 4, 4), (6, 1, 1)), rubber, Supports(("x0",)), loads=(bend,))
        >>> write_vtu("bar.vtu", solve(bar))
    """
    import meshio

    check_solution(solution)
    place = file_path("write_vtu: path", path)
    if place.suffix != ".vtu":
        raise SolverError(f"write_vtu: path must end in .vtu, got {str(place)!r}.")
    mesh = solution.problem.mesh
    # VTK's last two mid-edge nodes are those of (1, 3) and (2, 3), in Gmsh they are swapped
    cells = mesh.tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]
    fields = {
        "displacement_mm": solution.displacement,
        "von_mises_mpa": nodal_von_mises(solution),
        "hydrostatic_pressure_mpa": nodal_pressure(solution.problem, solution.state),
    }
    regions = {"region": [mesh.region_of_tet]} if mesh.regions else {}
    meshio.Mesh(mesh.nodes, [("tetra10", cells)], fields, regions).write(place)
