"""Half of the actuator on a mesh like the paper's: 1 mm, about 50 000 tetrahedra.

    python tests/benchmarks/paper_half.py [tests/benchmarks/paper_half.json]

Prototype 1 and the designs of the paper that we do not agree with, on uniform meshes, read as by
``paper_meshes.py``. Rows are written as they come; those in the file are not computed again. Some
minutes for each.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from paper_meshes import MESHES, readings

from bellows_design.analysis.mesh_plan import PlannedMesh
from bellows_design.analysis.models import HALF
from bellows_design.files.json_files import write_json
from bellows_design.study.paper import TABLE_4, Result
from solver import SolverOptions, solve

LABELS = ("Prototype 1", "bubble thickness 1.2", "bubble height 16", "bubble distance 1")
MESH = "1 mm"


def row(result: Result) -> dict[str, Any]:
    """Solve for half of a design, and read."""
    design = result.build()
    mesh = PlannedMesh(HALF.solid(design), MESHES[MESH]).made()
    problem = HALF.problem(design, mesh)
    found = solve(problem, design.load.pressure, SolverOptions(tolerance=1e-4, seconds=3600.0))
    return {
        "design": result.label,
        "mesh": MESH,
        "converged": found.converged,
        "elements": len(mesh.tets),
        "bending_angle_deg": found.rotation,
        "paper_deg": result.bending_angle_deg,
        "paper_mpa": result.max_stress_mpa,
        **readings(found, design.bellows),
        "seconds": found.seconds,
    }


def main(target: str = "tests/benchmarks/paper_half.json") -> None:
    """Compute the rows that are missing, and print them."""
    path = Path(target)
    rows = json.loads(path.read_text("utf-8"))["rows"] if path.is_file() else []
    done = {each["design"] for each in rows}
    results = {result.label: result for result in TABLE_4}
    for label in (each for each in LABELS if each not in done):
        rows.append(row(results[label]))
        write_json({"rows": rows}, path)
        print(json.dumps(rows[-1]), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:2])
