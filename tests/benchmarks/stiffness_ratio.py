"""How far apart the stiffness of two regions may be: a pressurised beam with a thin stiff film.

    python tests/benchmarks/stiffness_ratio.py [tests/benchmarks/stiffness_ratio.json]

A hollow beam of neo-Hookean rubber (10 × 5.2 × 2.2 mm, shear modulus 1 MPa, half of it modelled),
clamped at one end, has a film at its lower side that is stiffer by a ratio. It is inflated by
0.25 MPa, or its other end is led down by 3 mm. For each ratio: what Newton's method takes, and what
it would take without extrapolated stress (`solver.nonlinear.extrapolation`); whether PARDISO's
pivots say what is true (one negative one for each pressure, the state being stable), what a linear
solve of the last tangent leaves of its right-hand side and how many pivots had to be perturbed,
once as it is and once without scaling of the unknowns. SuperLU repeats the solve. Prints Markdown,
writes JSON.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from scipy.sparse import csr_array

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from meshes import cell_mesh

import solver.nonlinear.extrapolation
from solver import Mesh, Ogden, Problem, Solution, SolverOptions, Supports, reaction, solve
from solver.arrays import Reals
from solver.assembly.assembly import Assembly
from solver.linear.pardiso import Pardiso
from solver.linear.scaling import factors, scaled
from solver.linear.sparsity import Pattern, WholeMatrix

PRESSURE = 0.25
LED = 3.0
"""mm, down."""

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
    """One beam; ``bulk``: bulk over shear modulus of both materials.

    ``plain_iterations``: without extrapolated stress, None if that does not get there.
    """

    load: str
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
    plain_iterations: int | None
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


def problem(mesh: Mesh, ratio: float, bulk: float, load: str) -> Problem:
    """The beam under its load, its film stiffer by a ratio."""
    rubber, stiff = (Ogden((mu,), (2.0,), bulk_modulus=bulk * mu) for mu in (1.0, ratio))
    ends = {"x1": lowered} if load == "led" else {}
    supports = Supports(("x0",), {"y0": 1}, ends)
    cavity = ("cavity",) if load == "pressure" else ()
    return Problem(mesh, rubber, supports, cavity, materials={"film": stiff})


def lowered(at: Reals, load: float) -> Reals:
    """An end that goes down and may slide along x."""
    along, across, up = np.full(len(at), np.nan), np.zeros(len(at)), np.full(len(at), -LED * load)
    return np.stack([along, across, up], axis=1)


@contextmanager
def plain_tangents() -> Iterator[None]:
    """Without extrapolated stress, however stiff a region is."""
    extrapolation = solver.nonlinear.extrapolation
    usual, extrapolation.STIFFENING = extrapolation.STIFFENING, np.inf
    try:
        yield
    finally:
        extrapolation.STIFFENING = usual


def row(load: str, film: float, bulk: float, ratio: float) -> Row:
    """Solve one beam, with both solvers."""
    posed = problem(beam(film), ratio, bulk, load)
    pressure = PRESSURE if posed.pressurised else 0.0
    found = solve(posed, pressure, SolverOptions(linear_solver="pardiso"))
    other = solve(posed, pressure, SolverOptions(linear_solver="superlu"))
    with plain_tangents():
        plain = solve(posed, pressure, SolverOptions(linear_solver="pardiso"))
    assembly = Assembly(posed)
    at_end = assembly.evaluate(found.state, found.pressure)
    pull = internal_force(posed, found)
    tip = int(np.argmax(posed.mesh.nodes @ [1.0, 0.0, 1.0]))
    apart = np.linalg.norm(other.displacement - found.displacement)
    scale = factors(posed, assembly.numbering)
    push = np.where(assembly.numbering.displacement >= 0, 1.0, 0.0)
    system = at_end.pattern, at_end.tangent, assembly.numbering.gather(push)
    return Row(
        load=load,
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
        plain_iterations=plain.newton_iterations if plain.converged else None,
        imbalance=float(np.linalg.norm(at_end.residual) / pull),
        tip=tuple(found.displacement[tip].tolist()),
        scaled=factored(*system, scale),
        unscaled=factored(*system, None),
        superlu_iterations=other.newton_iterations,
        superlu_apart=float(apart / np.linalg.norm(found.displacement)),
    )


def internal_force(posed: Problem, found: Solution) -> float:
    """Norm of what the supports hold, N: what residuals are small against."""
    return float(np.linalg.norm(reaction(found, "x0").force))


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
        "| load | film, mm | K/μ | ratio | iterations | without extrapolation | factorizations | "
        "steps | refused | tip x, z, mm | pivots right, scaled | unscaled | left of a solve, "
        "scaled | unscaled | SuperLU: iterations | apart |",
        "|---" * 16 + "|",
    ]
    return "\n".join([*lines, *(line(each) for each in rows)])


def line(row: Row) -> str:
    """One row of the table."""
    right = [
        "yes" if made.negative_pivots == row.pressures else "**no**"
        for made in (row.scaled, row.unscaled)
    ]
    cells = (
        row.load,
        f"{row.film:g}",
        "∞" if row.bulk == np.inf else f"{row.bulk:g}",
        f"{row.ratio:.0e}",
        f"{row.iterations}" + ("" if row.converged else " (ends short)"),
        "ends short" if row.plain_iterations is None else f"{row.plain_iterations}",
        f"{row.factorizations}",
        f"{row.load_steps}",
        f"{row.refused_steps}",
        f"{row.tip[0]:.3f}, {row.tip[2]:.3f}",
        *right,
        f"{row.scaled.residual:.0e}",
        f"{row.unscaled.residual:.0e}",
        f"{row.superlu_iterations}",
        f"{row.superlu_apart:.0e}",
    )
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """All films and ratios, incompressible and, for one film, nearly so."""
    cases = [("pressure", film, np.inf) for film in FILMS]
    cases += [("pressure", FILMS[1], 1e3), ("led", FILMS[2], np.inf)]
    rows = []
    for case in cases:
        for ratio in RATIOS:
            rows.append(row(*case, ratio))
            print(line(rows[-1]), flush=True)
    print(table(rows))
    if len(sys.argv) > 1:
        kept = [
            asdict(each) | {"bulk": None if each.bulk == np.inf else each.bulk} for each in rows
        ]
        Path(sys.argv[1]).write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    main()
