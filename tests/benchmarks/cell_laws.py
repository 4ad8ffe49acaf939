"""What the law of a bubble takes, and how far off it is between its points.

    python tests/benchmarks/cell_laws.py --designs prototype_1 finger --tolerances 0.01 0.005
        [--target cell_laws.json]

Designs are those of `chain_against_half.py`: two shipped ones, and two random ones, to which
nothing was adjusted.

For each design and tolerance: rows, points, factorizations and processor time of the law beside
those of the ordinary evaluation in the same process, wall-clock time and the machine's load, and
the error of the rotation at random
pressures and moments that are computed on the same mesh. Wall-clock time means little where others
are at work on the machine; kernels are compiled before. Writes `cell_laws.json`, row by row;
rows of other designs and tolerances stay. Those with `largest_check_percent` were measured before
the stated error counted doubts within rows; it is the largest error at the checks alone.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numba
import numpy as np
from chain_against_half import designs

from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.evaluation import evaluate
from bellows_design.force.law.cell_law import CellLaw, cell_law
from bellows_design.force.law.computation.building import error_at
from bellows_design.force.law.computation.continuation import Continuation, Solved

Result = TypeVar("Result")

RESULT = Path(__file__).with_suffix(".json")
SEED = 17
LIMIT = 3600.0
"""s: no limit of time shall decide what is found."""


def main() -> None:
    """Measure, print and write."""
    known = {design.name: design for design in designs()}
    parser = argparse.ArgumentParser()
    parser.add_argument("--designs", nargs="+", default=list(known))
    parser.add_argument("--tolerances", nargs="+", type=float, default=[0.01])
    parser.add_argument("--points", type=int, default=20)
    parser.add_argument("--target", type=Path, default=RESULT)
    arguments = parser.parse_args()
    target = arguments.target
    rows = json.loads(target.read_text()) if target.exists() else []
    for name in arguments.designs:
        for tolerance in arguments.tolerances:
            rows = [row for row in rows if not _is(row, name, tolerance)]
            rows.append(measured(known[name], tolerance, arguments.points))
            print(json.dumps(rows[-1]), flush=True)
            target.write_text(json.dumps(rows, indent=1) + "\n")


def _is(row: dict[str, object], name: str, tolerance: float) -> bool:
    return (row["design"], row["tolerance_percent"]) == (name, 100 * tolerance)


def measured(design: Design, tolerance: float, points: int) -> dict[str, object]:
    """One law."""
    budget = Budget(mesh_seconds=LIMIT, seconds=LIMIT)
    evaluate(design, budget=budget)  # kernels are compiled or loaded
    evaluation, *evaluated = timed(lambda: evaluate(design, budget=budget))
    law, *both = timed(lambda: cell_law(design, tolerance, budget=budget))
    errors = random_errors(law, points)
    sizes = [len(row.points) for row in law.table.rows]
    percent = 100 / abs(law.free_rotation / law.tabulated.softening)
    return {
        "design": design.name,
        "tolerance_percent": 100 * tolerance,
        "rows": len(sizes),
        "points": sum(sizes),
        "factorizations": law.effort.factorizations,
        "evaluation_factorizations": evaluation.solver.factorizations,
        "evaluation_cpu_s": evaluated[0],
        "evaluation_and_law_cpu_s": both[0],
        "cpu_ratio": both[0] / evaluated[0],
        "evaluation_wall_s": evaluated[1],
        "evaluation_and_law_wall_s": both[1],
        "wall_ratio": both[1] / evaluated[1],
        "numba_threads": numba.get_num_threads(),
        "load_average": os.getloadavg()[0],
        "stated_interpolation_percent": percent * law.error.interpolation,
        "random_points": len(errors),
        "random_median_percent": percent * float(np.median(errors)),
        "random_largest_percent": percent * max(errors),
        "mesh_percent": percent * law.error.mesh,
        "ends_percent": percent * law.error.ends,
        "softening": law.tabulated.softening,
        "shear_compliance_mm_per_n": law.tabulated.shear_compliance,
    }


def timed(compute: Callable[[], Result]) -> tuple[Result, float, float]:
    """A result, and the processor's and the wall clock's time that it took, s."""
    cpu, wall = time.process_time(), time.perf_counter()
    found = compute()
    return found, time.process_time() - cpu, time.perf_counter() - wall


def random_errors(law: CellLaw, count: int) -> list[float]:
    """Errors of the rotation (rad) at random points of the table's range."""
    random, table = np.random.default_rng(SEED), law.table
    cell = Continuation.of(law.design, law.mesh)
    errors: list[float] = []
    for pressure in np.sort(random.uniform(*table.pressures[[0, -1]], count // PER_PRESSURE)):
        (free,), _ = cell.from_zero((float(pressure),))
        low, high = table.reach(float(pressure))
        moments = random.uniform(low, high, PER_PRESSURE)
        below, above = np.sort(moments[moments < 0])[::-1], np.sort(moments[moments >= 0])
        for side in (below, above):
            at: Solved | str = free
            for moment in side:
                at = cell.beside(at, float(pressure), float(moment))
                if isinstance(at, str):
                    break
                errors.append(error_at(table, at.point))
    return errors


PER_PRESSURE = 4


if __name__ == "__main__":
    main()
