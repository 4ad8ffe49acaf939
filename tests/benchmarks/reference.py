"""The converged values that errors are measured against: computed once, kept in reference.json.

    python tests/benchmarks/reference.py [tests/benchmarks/reference.json]

Recipe, for each design the paper computed and for ``finger``:

- *cell*: the unit cell, refined by its own error until a mesh has ``CELL_ELEMENTS``; the finest
  angle of the bubbles and peak stress count as exact.
- *half*: half of the actuator on its two default meshes, and the unit cell's answer on meshes of
  the same kind: the difference is what the unit cell leaves out.
- *finest half*, Prototype 1 only: refined until a mesh has ``HALF_ELEMENTS``.

Takes about an hour on two cores and 8 GiB. Seconds are not recorded here.
"""

from __future__ import annotations

import json
import os
import sys
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from bellows_design import load_design
from bellows_design.analysis.computation import Computation
from bellows_design.analysis.evaluate import evaluate, mesh_size
from bellows_design.analysis.mesh_sequence import refined
from bellows_design.analysis.models import HALF
from bellows_design.analysis.whole_actuator import reading
from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.study.paper import TABLE_4
from bellows_design.versions import versions

CELL_ELEMENTS, HALF_ELEMENTS = 15_000, 80_000
PATIENCE = 9
"""Meshes after which refinement ends at the latest."""

AMPLE = Budget(memory=1000.0, mesh_seconds=3600.0, seconds=86_400.0)


def designs() -> dict[str, Design]:
    """Label -> design."""
    return {case.label: case.build() for case in TABLE_4} | {"finger": load_design("finger")}


def computed(design: Design, model: str) -> Computation:
    """On the meshes that an evaluation uses."""
    return evaluate(design, model, budget=AMPLE).computation


def refined_to(elements: int, computation: Computation) -> Computation:
    """Refine until the finest mesh has so many elements."""
    while len(computation.finest.problem.mesh.tets) < elements and computation.converged:
        if len(computation.solved) >= PATIENCE:
            break
        computation = refined(computation)
    return computation


def levels(computation: Computation) -> list[dict[str, Any]]:
    """Every mesh: its size, angle and stress with its place."""
    return [
        asdict(mesh_size(mesh.solution))
        | asdict(reading(computation, mesh.solution.path[-1]))
        | {"position_mm": list(mesh.peak.position)}
        for mesh in computation.solved
    ]


def finest_half(design: Design) -> list[dict[str, Any]]:
    """Half of the actuator, refined as far as the machine's memory allows."""
    start = computed(design, "half")
    fast = replace(start, model=replace(HALF, growth=4.0), solved=start.solved[:1])
    return levels(refined_to(HALF_ELEMENTS, fast))


def main(target: str, *labels: str) -> None:
    """Compute and write, design by design; those at hand already are kept."""
    path = Path(target)
    known: dict[str, Any] = json.loads(path.read_text()) if path.exists() else {"designs": {}}
    for label, design in designs().items():
        if label in known["designs"] or (labels and label not in labels):
            continue
        cell = refined_to(CELL_ELEMENTS, computed(design, "unit-cell"))
        half = computed(design, "half")
        found = {"cell": levels(cell), "half": levels(half), "digest": design.digest}
        known["designs"][label] = found
        print(label, found["cell"][-1], found["half"][-1], flush=True)
        _write(path, known)
    if "finest half" not in known and not labels:
        known["finest half"] = finest_half(load_design("prototype_1"))
        _write(path, known)


def _write(path: Path, known: dict[str, Any]) -> None:
    known["made_with"] = versions() | {"cores": os.cpu_count()}
    path.write_text(json.dumps(known, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*(sys.argv[1:] or ["tests/benchmarks/reference.json"]))
