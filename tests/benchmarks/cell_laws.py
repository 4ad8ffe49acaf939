"""What the law of a bubble takes, and how far off it is between its points.

    python tests/benchmarks/cell_laws.py --designs prototype_1 finger --tolerances 0.01 0.005

For each design and tolerance: rows, points, factorizations and processor time of the law beside
those of the ordinary evaluation in the same process, and the error of the rotation at random
pressures and moments that are computed on the same mesh. Processor times, as others may be at work
on the machine; kernels are compiled before. Writes `cell_laws.json`, row by row.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import numpy as np

from bellows_design.budget import Budget
from bellows_design.design.shipped import load_design
from bellows_design.evaluation import evaluate
from bellows_design.force.law.cell_law import CellLaw, cell_law
from bellows_design.force.law.computation.building import error_at
from bellows_design.force.law.computation.continuation import Continuation, Solved

RESULT = Path(__file__).with_suffix(".json")
SEED = 17
LIMIT = 3600.0
"""s: no limit of time shall decide what is found."""


def main() -> None:
    """Measure, print and write."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--designs", nargs="+", default=["prototype_1", "finger"])
    parser.add_argument("--tolerances", nargs="+", type=float, default=[0.02, 0.01, 0.005])
    parser.add_argument("--points", type=int, default=20)
    arguments = parser.parse_args()
    rows = []
    for name in arguments.designs:
        for tolerance in arguments.tolerances:
            rows.append(measured(name, tolerance, arguments.points))
            print(json.dumps(rows[-1]), flush=True)
            RESULT.write_text(json.dumps(rows, indent=1) + "\n")


def measured(name: str, tolerance: float, points: int) -> dict[str, object]:
    """One law."""
    design, budget = load_design(name), Budget(mesh_seconds=LIMIT, seconds=LIMIT)
    began = time.process_time()
    evaluation = evaluate(design, budget=budget)
    evaluated = time.process_time() - began
    law = cell_law(design, tolerance, budget=budget)
    both = time.process_time() - began - evaluated
    errors = random_errors(law, points)
    sizes = [len(row.points) for row in law.table.rows]
    percent = 100 / abs(law.free_rotation / law.tabulated.softening)
    return {
        "design": name,
        "tolerance_percent": 100 * tolerance,
        "rows": len(sizes),
        "points": sum(sizes),
        "factorizations": law.effort.factorizations,
        "evaluation_factorizations": evaluation.solver.factorizations,
        "evaluation_cpu_s": evaluated,
        "law_cpu_s": both - evaluated,
        "stated_interpolation_percent": percent * law.error.interpolation,
        "random_points": len(errors),
        "random_median_percent": percent * float(np.median(errors)),
        "random_largest_percent": percent * max(errors),
        "mesh_percent": percent * law.error.mesh,
        "ends_percent": percent * law.error.ends,
        "softening": law.tabulated.softening,
        "shear_compliance_mm_per_n": law.tabulated.shear_compliance,
    }


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
