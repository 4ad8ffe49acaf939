"""A film on a strip as a membrane, and as a thin region of the mesh: accuracy, effort, condition.

    python tests/benchmarks/film_models.py [results.json]

A strip of silicone, 40 mm long and 5 mm high, in plane strain, with a film of 4100 MPa (paper) of
several thicknesses under it. Small bending is compared with the closed form of two layers, in which
every section stays plane: quadratic elements contain it, so that the error is that of the model.
For large bending a dead traction on the underside turns the tip by half a radian, with the film in
tension; the tip's displacement is compared with that of the same model on a mesh four times as fine
along x as the finer of two. Meshes are structured: one layer of cells in the film, two in the
silicone; the rows of Gmsh have edges of 2.5 mm. Films of 0.1 mm with other moduli follow. Prints
Markdown, writes JSON.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from io import BytesIO
from pathlib import Path

import cadquery as cq
import numpy as np
from meshes import cell_mesh
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.linalg import LinearOperator, onenormest

from solver import (
    Membrane,
    Mesh,
    Ogden,
    Problem,
    SlenderAxis,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    solve,
)
from solver.assembly.assembly import Assembly, Equilibrium
from solver.assembly.state import State
from solver.meshing import MeshOptions, Part, mesh_solids
from solver.nonlinear.linear_system import LinearSystem
from solver.problem.supports import given_displacements

HERE = Path(__file__).parent
Array = NDArray[np.float64]

LENGTH, WIDTH, HEIGHT = 40.0, 2.5, 5.0
SILICONE = Ogden.neo_hooke(0.025)
PAPER, POISSON = 4100.0, 0.3
"""Young's modulus of the film, MPa, and Poisson's ratio."""
THICKNESSES = (1.0, 0.5, 0.2, 0.1, 0.05)
MODULI = (0.075, 7.5, 750.0, 7500.0, 75e3, 750e3)
"""Of films of 0.1 mm, MPa: 1 to 1e7 times that of the silicone."""

CELLS, FINE = (8, 16), 64
"""Along x; of the mesh that large bending is compared with."""

SMALL = 1e-7
"""Curvature of small bending, 1/mm."""

SECONDS = 60.0
"""Of a solve, at most."""

TURN = 1.0
"""Rotation of the tip by small-deflection theory under the load of large bending, rad."""

SOFT = 4 * 0.025
"""Modulus of the silicone in plane strain, MPa."""


@dataclass(frozen=True)
class Row:
    """A model of the film; ``stiffness_error`` and ``tip_error`` relative."""

    film: str
    thickness_mm: float
    young_modulus_mpa: float
    mesh: str
    tetrahedra: int
    unknowns: int
    least_quality: float
    condition: float
    pivots_right: bool
    stiffness_error: float
    tip_error: float
    steps: int
    iterations: int
    seconds: float


@dataclass(frozen=True)
class Film:
    """A film: thickness in mm, Young's modulus in MPa."""

    thickness: float
    young_modulus: float = PAPER

    @property
    def stiffness(self) -> float:
        """Force per width and strain in plane strain, N/mm."""
        return self.young_modulus * self.thickness / (1 - POISSON**2)

    @property
    def law(self) -> Ogden:
        """As a nearly linear solid."""
        shear = self.young_modulus / (2 * (1 + POISSON))
        return Ogden.neo_hooke(shear, self.young_modulus / (3 * (1 - 2 * POISSON)))


@dataclass(frozen=True)
class Strip:
    """Mesh of a strip with a film: a region of it, or ``thin``, a membrane."""

    mesh: Mesh
    film: Film
    thin: bool

    def problem(self, supports: Supports, *loads: Traction) -> Problem:
        """Of the strip under supports and loads."""
        film = self.film
        membrane = Membrane("z0", film.young_modulus, POISSON, film.thickness, wrinkles=False)
        return Problem(
            self.mesh, SILICONE, supports, loads=loads,
            materials={} if self.thin else {"film": film.law},
            membranes=(membrane,) if self.thin else (),
            axis=SlenderAxis(tuple(np.linspace(0, LENGTH, 11))) if loads else None,
        )  # fmt: skip

    @property
    def layers(self) -> tuple[float, float]:
        """Neutral axis (mm) and bending stiffness per width (N mm) of two layers in plane strain.

        A ``thin`` film lies at z = 0 and bends freely.
        """
        film, rubber, thickness = self.film.stiffness, SOFT * HEIGHT, self.film.thickness
        middle = 0.0 if self.thin else -thickness / 2
        neutral = (film * middle + rubber * HEIGHT / 2) / (film + rubber)
        stiffness = film * (middle - neutral) ** 2 + rubber * (HEIGHT / 2 - neutral) ** 2
        own = 0.0 if self.thin else film * thickness**2 / 12
        return neutral, stiffness + rubber * HEIGHT**2 / 12 + own


def with_region(film: Film, cells: int) -> Strip:
    """The film as a region below z = 0."""
    mesh = boxes(np.array([-film.thickness, *np.linspace(0, HEIGHT, 3)]), cells)
    low = mesh.nodes[mesh.tets[:, :4], 2].mean(axis=1) < 0
    return Strip(mesh.with_regions({"film": np.flatnonzero(low)}), film, thin=False)


def with_membrane(film: Film, cells: int) -> Strip:
    """The film as a membrane at z = 0."""
    return Strip(boxes(np.linspace(0, HEIGHT, 3), cells), film, thin=True)


def by_gmsh(film: Film, cells: int) -> Strip:
    """The film as a region of an unstructured mesh."""
    options = MeshOptions(size=LENGTH / cells, smallest_size=film.thickness / 2)
    parts = (part("film", -film.thickness, 0.0), part("silicone", 0.0, HEIGHT))
    mesh = mesh_solids(parts, options)
    mesh = mesh.with_regions({"film": mesh.regions["film"]})
    return Strip(mesh.with_surfaces({"tip": mesh.surfaces["x1"]}), film, thin=False)


def part(name: str, low: float, high: float) -> Part:
    """A layer of the strip between two heights."""
    size = (LENGTH, WIDTH, high - low)
    box, file = cq.Solid.makeBox(*size, cq.Vector(0, 0, low)), BytesIO()
    box.exportBrep(file)
    names = []
    for face in box.Faces():
        normal = np.array(face.normalAt().toTuple())
        axis = int(abs(normal).argmax())
        names.append("xyz"[axis] + ("1" if normal[axis] > 0 else "0"))
    return Part(name, file.getvalue(), names)


def boxes(levels: Array, cells: int) -> Mesh:
    """A structured mesh of the strip between ``levels`` of z."""
    lines = [np.linspace(0, LENGTH, cells + 1), np.array([0, WIDTH]), levels]
    mesh = cell_mesh(np.ones((cells, 1, len(levels) - 1), int), lines)
    return mesh.with_surfaces({"tip": mesh.surfaces["x1"]})


def bent_slightly(strip: Strip) -> tuple[float, float, bool, int]:
    """Bending stiffness per width (N mm), condition, whether pivots are right, and unknowns.

    By one solution with the tangent of the undeformed strip, whose ends are turned.
    """
    neutral, _ = strip.layers

    def turned(places: Array, load: float) -> Array:
        along = -load * SMALL * LENGTH * (places[:, 2] - neutral)
        return np.stack([along, *np.full((2, len(places)), np.nan)], axis=1)

    corner = tuple(strip.mesh.nodes[strip.mesh.surface_nodes("x0")].min(axis=0))
    supports = Supports(
        symmetry={"x0": 0, "y0": 1, "y1": 1}, prescribed={"x1": turned}, nodes={corner: 2}
    )
    problem = strip.problem(supports)
    assembly = Assembly(problem)
    given = given_displacements(strip.mesh, supports, 1.0)
    start = State(np.where(np.isnan(given), 0.0, given), np.zeros(len(strip.mesh.vertices)))
    equilibrium = assembly.evaluate(State.zero(problem), 0.0)
    system = LinearSystem(assembly, "auto")
    system.factorize(equilibrium)
    change = system.increment(-assembly.evaluate(start, 0.0, tangent=False).residual)
    bent = State(start.displacement + change.displacement, change.hydrostatic_pressure)
    stiffness = 2 * assembly.energy(bent) / (SMALL**2 * LENGTH * WIDTH)
    condition = condition_of(equilibrium, system)
    return stiffness, condition, system.stable is True, assembly.numbering.size


def condition_of(equilibrium: Equilibrium, system: LinearSystem) -> float:
    """Estimate of the condition number of a tangent in the 1-norm."""
    pattern = equilibrium.pattern
    size = len(pattern.indptr) - 1
    upper = csr_array((equilibrium.tangent, pattern.indices, pattern.indptr), shape=(size, size))
    whole = upper + upper.T
    whole.setdiag(upper.diagonal())
    inverse = LinearOperator(
        (size, size), matvec=lambda v: system.solve(v.ravel()),
        rmatvec=lambda v: system.solve(v.ravel()),
    )  # fmt: skip
    return float(abs(whole).sum(axis=0).max() * onenormest(inverse))


def bent_far(strip: Strip) -> Solution:
    """Under an upward traction on the underside."""
    traction = TURN * 6 * strip.layers[1] / LENGTH**3
    supports = Supports(("x0",), symmetry={"y0": 1, "y1": 1})
    load = Traction("z0", (0.0, 0.0, traction))
    return solve(strip.problem(supports, load), options=SolverOptions(seconds=SECONDS))


def tip(solution: Solution) -> Array:
    """Displacement of the tip's corner at z = 0, mm."""
    nodes = solution.problem.mesh.nodes
    corner = (nodes == [LENGTH, 0.0, 0.0]).all(axis=1)
    return np.asarray(solution.displacement[corner][0])


def least_quality(mesh: Mesh) -> float:
    """Least ratio of inscribed to circumscribed sphere of the straight tetrahedra, times three."""
    a, b, c, d = (mesh.nodes[mesh.tets[:, k]] for k in range(4))
    u, v, w = b - a, c - a, d - a
    six = abs(np.einsum("ei,ei->e", np.cross(u, v), w))
    sides = ((u, v), (v, w), (w, u), (c - b, d - b))
    areas = sum(np.linalg.norm(np.cross(*pair), axis=1) / 2 for pair in sides)
    squares = [(x**2).sum(axis=1)[:, None] for x in (u, v, w)]
    centre = squares[0] * np.cross(v, w) + squares[1] * np.cross(w, u) + squares[2] * np.cross(u, v)
    outer = np.linalg.norm(centre, axis=1) / (2 * six)
    return float((3 * (six / 2 / areas) / outer).min())


def measured(strip: Strip, mesh: str, name: str, fine: Solution) -> Row:
    """A row of the table; ``fine``: large bending on the fine mesh."""
    stiffness, condition, right, unknowns = bent_slightly(strip)
    found, film = bent_far(strip), strip.film
    moved, expected = tip(found), tip(fine)
    reached = found.converged and fine.converged
    error = np.linalg.norm(moved - expected) / np.linalg.norm(expected) if reached else np.nan
    return Row(
        film=name,
        thickness_mm=film.thickness,
        young_modulus_mpa=film.young_modulus,
        mesh=mesh,
        tetrahedra=len(strip.mesh.tets),
        unknowns=unknowns,
        least_quality=least_quality(strip.mesh),
        condition=condition,
        pivots_right=right,
        stiffness_error=stiffness / replace(strip, thin=False).layers[1] - 1,
        tip_error=float(error),
        steps=found.load_steps,
        iterations=found.newton_iterations,
        seconds=found.seconds,
    )


def rows() -> Iterator[Row]:
    """Each thickness as a region and as a membrane; then films of other moduli."""
    for film in map(Film, THICKNESSES):
        yield from pair(film, CELLS)
        if film.thickness < 1:
            fine = bent_far(with_region(film, FINE))
            yield measured(by_gmsh(film, CELLS[-1]), "Gmsh", "region", fine)
    for modulus in MODULI:
        yield from pair(Film(0.1, modulus), CELLS[-1:])


def pair(film: Film, meshes: Sequence[int]) -> Iterator[Row]:
    """Both models on structured meshes with so many cells along x."""
    for name, model in (("region", with_region), ("membrane", with_membrane)):
        fine = bent_far(model(film, FINE))
        for cells in meshes:
            yield measured(model(film, cells), f"{LENGTH / cells:g} mm", name, fine)


def main(arguments: Sequence[str]) -> None:
    """Measure, print and write."""
    place = Path(arguments[0]) if arguments else HERE / "film_models.json"
    found = []
    print(HEADER)
    for row in rows():
        found.append(row)
        print(line(row), flush=True)
    table = [{key: rounded(value) for key, value in asdict(row).items()} for row in found]
    place.write_text(json.dumps({"rows": table}, indent=1) + "\n", encoding="utf-8")


HEADER = (
    "| film | mm | E, MPa | cells | unknowns | quality | condition | stiffness | tip | steps "
    "| corrections | s |\n" + 12 * "|---" + "|"
)


def line(row: Row) -> str:
    """A row in Markdown."""
    pivots = "" if row.pivots_right else " (wrong pivots)"
    return (
        f"| {row.film} | {row.thickness_mm:g} | {row.young_modulus_mpa:g} | {row.mesh} "
        f"| {row.unknowns} | {row.least_quality:.2g} "
        f"| {row.condition:.1e}{pivots} | {100 * row.stiffness_error:+.2g} % "
        f"| {100 * row.tip_error:.2g} % | {row.steps} | {row.iterations} | {row.seconds:.2f} |"
    )


def rounded(value: object) -> object:
    """Four significant digits of real numbers."""
    return float(f"{value:.4g}") if isinstance(value, float) else value


if __name__ == "__main__":
    main(sys.argv[1:])
