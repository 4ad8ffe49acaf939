"""Membrane locking: interpolations of a film's strain on strips that bend, against a closed form.

    python tests/benchmarks/membrane_strain.py [results.json]

A strip of silicone (0.025 MPa, 20 mm long, 2 mm high, in plane strain) with a film under it is bent
to a radius of 17 mm with the film outside. Errors of the energy, and that of the film over its
exact one, on structured meshes, and to 33 mm on one of Gmsh, 5 mm wide: with the whole quadratic
strain, with Regge elements of order one (which ``Membrane`` has) and of order zero. Prints
Markdown, writes JSON.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from io import BytesIO
from pathlib import Path
from unittest.mock import patch

import cadquery as cq
import numpy as np
from films import BentStrip, edge_averages, whole_strain
from meshes import box_mesh

import solver.assembly.membranes.membranes as membranes
from solver import Membrane, Mesh, SolverOptions, potential, solve
from solver.assembly.membranes.strain import StrainSamples, regge_samples
from solver.meshing import MeshOptions, mesh_solid

HERE = Path(__file__).parent
LENGTH, HEIGHT = 20.0, 2.0
STIFFNESSES = (2050.0, 2.0, 0.02)
"""Young's modulus times thickness, N/mm."""

CELLS = (2, 4, 8)
"""Along the strip: edges of 10, 5 and 2.5 mm."""

STRAINS: dict[str, Callable[[], StrainSamples]] = {
    "whole": whole_strain,
    "Regge, order 1": regge_samples,
    "Regge, order 0": edge_averages,
}


@dataclass(frozen=True)
class Row:
    """``error`` of the energy, relative; ``film_energy`` over the exact one."""

    strain: str
    stiffness_n_per_mm: float
    mesh: str
    tetrahedra: int
    converged: bool
    error: float
    film_energy: float
    iterations: int
    seconds: float


def strip(stiffness: float, width: float, radius: float = 17.0) -> BentStrip:
    """A strip with a film of 0.5 mm."""
    film = Membrane("z0", stiffness / 0.5, 0.3, 0.5, wrinkles=False)
    return BentStrip(0.025, LENGTH, width, HEIGHT, -1 / radius, film)


def measured(name: str, body: BentStrip, label: str, mesh: Mesh) -> Row:
    """A strip with one interpolation."""
    with patch.object(membranes, "SAMPLES", STRAINS[name]()):
        found = solve(body.problem(mesh), options=SolverOptions(tolerance=1e-7, seconds=60))
        energy = potential(found)
    assert body.film is not None
    return Row(
        strain=name,
        stiffness_n_per_mm=body.film.stiffness,
        mesh=label,
        tetrahedra=len(mesh.tets),
        converged=found.converged,
        error=energy.stored / body.energy - 1,
        film_energy=energy.membranes / body.film_energy,
        iterations=found.newton_iterations,
        seconds=found.seconds,
    )


def unstructured(width: float) -> Mesh:
    """By Gmsh, with edges of 2.5 mm."""
    box, file = cq.Solid.makeBox(LENGTH, width, HEIGHT), BytesIO()
    box.exportBrep(file)
    names = []
    for face in box.Faces():
        normal = np.array(face.normalAt().toTuple())
        axis = int(abs(normal).argmax())
        names.append("xyz"[axis] + ("1" if normal[axis] > 0 else "0"))
    return mesh_solid(file.getvalue(), names, MeshOptions(size=2.5))


def rows() -> Iterator[Row]:
    """All interpolations on all meshes."""
    for stiffness in STIFFNESSES:
        for name in STRAINS:
            for cells in CELLS:
                mesh = box_mesh((cells, 1, 1), (LENGTH, 2.5, HEIGHT))
                label = f"{LENGTH / cells:g} mm"
                yield measured(name, strip(stiffness, 2.5), label, mesh)
    mesh = unstructured(5.0)
    for name in STRAINS:
        yield measured(name, strip(STIFFNESSES[0], 5.0, 33.0), "Gmsh, 33 mm", mesh)


def line(row: Row) -> str:
    """A row in Markdown."""
    error = f"{100 * row.error:+.2g} %" if row.converged else "stops short"
    return (
        f"| {row.strain} | {row.stiffness_n_per_mm:g} | {row.mesh} | {error} "
        f"| {row.film_energy:.3g} | {row.iterations} | {row.seconds:.2f} |"
    )


def main(arguments: Sequence[str]) -> None:
    """Measure, print and write."""
    place = Path(arguments[0]) if arguments else HERE / "membrane_strain.json"
    print("| strain | E t, N/mm | cells | energy | of the film | corrections | s |")
    print(7 * "|---" + "|")
    found = []
    for row in rows():
        found.append({key: rounded(value) for key, value in asdict(row).items()})
        print(line(row), flush=True)
    place.write_text(json.dumps({"rows": found}, indent=1) + "\n", encoding="utf-8")


def rounded(value: object) -> object:
    """Four significant digits of real numbers."""
    return float(f"{value:.4g}") if isinstance(value, float) else value


if __name__ == "__main__":
    main(sys.argv[1:])
