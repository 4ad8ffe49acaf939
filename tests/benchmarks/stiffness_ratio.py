"""How far apart the stiffness of two regions may be: a pressurised beam with a thin stiff film.

    python tests/benchmarks/stiffness_ratio.py [tests/benchmarks/stiffness_ratio.json]

A hollow beam of neo-Hookean rubber (10 × 5.2 × 2.2 mm, shear modulus 1 MPa, half of it modelled),
clamped at one end, has a film at its lower side that is stiffer by a ratio, and is inflated by
0.25 MPa. For each ratio: what Newton's method takes, whether PARDISO's pivots say what is true (one
negative one for each pressure, the state being stable), what a linear solve of the last tangent
leaves of its right-hand side, and how many pivots had to be perturbed; once as it is and once
without scaling of the unknowns. SuperLU repeats the solve. Prints Markdown, writes JSON.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from scipy.sparse import csr_array

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from meshes import cell_mesh

from solver import Mesh, Ogden, Problem, SolverOptions, Supports, solve
from solver.arrays import Reals
from solver.assembly.assembly import Assembly
from solver.linear.pardiso import Pardiso
from solver.linear.scaling import factors, scaled
from solver.linear.sparsity import Pattern, WholeMatrix

PRESSURE = 0.25
RATIOS = (1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e10, 1e12)
FILMS = (0.2, 0.05, 0.01)
"""Thickness, mm; cells of the beam are up to 2 mm long."""

PERTURBED, REFINEMENTS = 14, 7
"""PARDISO's numbers for what it counts."""


@dataclass(frozen=True)
class Factored:
    """What PARDISO makes of the last tangent: is the inertia right, what does a solve leave."""

    negative_pivots: int | None
    perturbed: int
    refinements: int
    residual: float


@dataclass(frozen=True)
class Row:
    """One beam; ``bulk``: bulk over shear modulus of both materials."""

    film: float
    bulk: float
    ratio: float
    elements: int
    pressures: int
    converged: bool
    stable: bool | None
    iterations: int
    factorizations: int
    load_steps: int
    refused_steps: int
    imbalance: float
    tip: tuple[float, float, float]
    scaled: Factored
    unscaled: Factored
    superlu_iterations: int
    superlu_apart: float


def beam(film: float, finer: int = 1) -> Mesh:
    """Half a beam with a cavity, and its lowest layer of elements as the region ``film``."""
    cells = np.ones((10, 2, 4), int)
    cells[1:-1, 0, 2] = 2
    lines = []
    for axis, lengths in enumerate((np.ones(10), [2.0, 0.6], [film, 0.6, 1.0, 0.6])):
        cells = np.repeat(cells, finer, axis=axis)
        lines.append(np.cumsum([0.0, *np.repeat(lengths, finer) / finer]))
    mesh = cell_mesh(cells, lines)
    low = mesh.nodes[mesh.tets[:, :4]].mean(axis=1)[:, 2] < film
    return mesh.with_regions({"film": np.flatnonzero(low)})


def problem(mesh: Mesh, ratio: float, bulk: float) -> Problem:
    """The beam under pressure, its film stiffer by a ratio."""
    rubber, stiff = (Ogden((mu,), (2.0,), bulk_modulus=bulk * mu) for mu in (1.0, ratio))
    supports = Supports(("x0",), {"y0": 1})
    return Problem(mesh, rubber, supports, ("cavity",), materials={"film": stiff})


def row(film: float, bulk: float, ratio: float, finer: int = 1) -> Row:
    """Solve one beam, with both solvers."""
    posed = problem(beam(film, finer), ratio, bulk)
    found = solve(posed, PRESSURE, SolverOptions(linear_solver="pardiso"))
    other = solve(posed, PRESSURE, SolverOptions(linear_solver="superlu"))
    assembly = Assembly(posed)
    at_end = assembly.evaluate(found.state, found.pressure)
    tip = int(np.argmax(posed.mesh.nodes @ [1.0, 0.0, 1.0]))
    apart = np.linalg.norm(other.displacement - found.displacement)
    load = np.linalg.norm(found.pressure * at_end.force)
    scale = factors(posed, assembly.numbering)
    system = at_end.pattern, at_end.tangent, at_end.force
    return Row(
        film=film,
        bulk=bulk,
        ratio=ratio,
        elements=len(posed.mesh.tets),
        pressures=len(posed.mesh.vertices),
        converged=found.converged,
        stable=found.stable,
        iterations=found.newton_iterations,
        factorizations=found.factorizations,
        load_steps=found.load_steps,
        refused_steps=found.refused_steps,
        imbalance=float(np.linalg.norm(at_end.residual) / load),
        tip=tuple(found.displacement[tip].tolist()),
        scaled=factored(*system, scale),
        unscaled=factored(*system, None),
        superlu_iterations=other.newton_iterations,
        superlu_apart=float(apart / np.linalg.norm(found.displacement)),
    )


def factored(pattern: Pattern, values: Reals, force: Reals, scale: Reals | None) -> Factored:
    """A factorization of a tangent and a solve with it."""
    pardiso = Pardiso()
    solver = scaled(pardiso, scale)
    solver.analyze(pattern)
    solver.factorize(values)
    perturbed = pardiso._store.parameter(PERTURBED)
    left = matrix(pattern, values) @ solver.solve(force) - force
    return Factored(
        solver.negative_pivots,
        perturbed,
        pardiso._store.parameter(REFINEMENTS),
        float(np.linalg.norm(left) / np.linalg.norm(force)),
    )


def matrix(pattern: Pattern, values: Reals) -> csr_array:
    """The whole symmetric matrix."""
    whole = WholeMatrix.of(pattern)
    size = len(pattern.indptr) - 1
    return csr_array((whole.by_rows(values, None), whole.indices, whole.indptr), (size, size))


def table(rows: list[Row]) -> str:
    """As Markdown."""
    lines = [
        "| film, mm | K/μ | ratio | iterations | factorizations | steps | refused | tip x, z, mm | "
        "pivots right, scaled | unscaled | left of a solve, scaled | unscaled | SuperLU apart |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for each in rows:
        right = [
            "yes" if made.negative_pivots == each.pressures else "**no**"
            for made in (each.scaled, each.unscaled)
        ]
        steps = f"{each.load_steps} | {each.refused_steps}" + ("" if each.converged else " (ends)")
        lines.append(
            f"| {each.film:g} | {each.bulk:g} | {each.ratio:.0e} | {each.iterations} | "
            f"{each.factorizations} | {steps} | {each.tip[0]:.3f}, {each.tip[2]:.3f} | {right[0]} "
            f"| {right[1]} | {each.scaled.residual:.0e} | {each.unscaled.residual:.0e} | "
            f"{each.superlu_apart:.0e} |"
        )
    return "\n".join(lines)


def main() -> None:
    """All films and ratios, incompressible; the film of 0.05 mm nearly so and on a finer mesh."""
    rows = []
    cases = [(film, np.inf, ratio, 1) for film in FILMS for ratio in RATIOS]
    cases += [(0.05, 1e3, ratio, 1) for ratio in RATIOS]
    for film, bulk, ratio, finer in cases:
        rows.append(row(film, bulk, ratio, finer))
        print(table(rows[-1:]).splitlines()[-1], flush=True)
    print(table(rows))
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(json.dumps([asdict(each) for each in rows], indent=1) + "\n")


if __name__ == "__main__":
    main()
