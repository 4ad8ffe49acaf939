"""The blocked force of Prototype 1 by laws on finer and finer meshes of its cell.

    python tests/benchmarks/cell_refinement.py [--meshes 2] [--target cell_refinement.json]

The law of the first mesh of an evaluation, of the second one, and so on; each as it is, and
corrected by the finest of the evaluation. The ends stay on their own mesh. Minutes for each.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bellows_design.analysis.computation import Computation
from bellows_design.design.shipped import load_design
from bellows_design.evaluation import evaluate
from bellows_design.files.json_files import write_json
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.path import follow
from bellows_design.force.chain.surroundings import Hold, Surroundings
from bellows_design.force.law.cell_law import TOLERANCE, _made
from bellows_design.force.law.half_bubble import CellLaw
from bellows_design.progress import SILENCE


def blocked_force(law: CellLaw, corrected: bool) -> float:
    """On a load cell at its rest height at the design's pressure, N."""
    pieces = [law.tabulated, law.root, law.tip]
    inner, root, tip = pieces if corrected else (replace(each, softening=1.0) for each in pieces)
    chain = Chain.of(law.design.bellows, inner, root=root, tip=tip)
    pressures = np.linspace(0, law.design.load.pressure, 6)[1:]
    path = follow(chain, Surroundings(hold=Hold(z=0.0)), pressures)
    assert path.ending is None, path.ending
    return path.last.held_force[1]


def row(computation: Computation, first: int) -> dict[str, Any]:
    """By the law on the mesh of number ``first``."""
    began = time.perf_counter()
    law = _made(replace(computation, solved=computation.solved[first:]), TOLERANCE, SILENCE)
    return {
        "elements": len(law.mesh.tets),
        "force_n": blocked_force(law, corrected=False),
        "corrected_force_n": blocked_force(law, corrected=True),
        "complete": law.error.complete,
        "factorizations": law.effort.factorizations,
        "seconds": time.perf_counter() - began,
    }


def main() -> None:
    """Compute, print and write the rows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--meshes", type=int, default=2)
    parser.add_argument("--target", default="tests/benchmarks/cell_refinement.json")
    asked = parser.parse_args()
    computation = evaluate(load_design("prototype_1")).computation
    long = replace(computation, budget=replace(computation.budget, seconds=3600.0))
    rows = []
    for number in range(asked.meshes):
        rows.append(row(long, number))
        print(rows[-1], flush=True)
        write_json({"design": "prototype_1", "rows": rows}, Path(asked.target))


if __name__ == "__main__":
    main()
