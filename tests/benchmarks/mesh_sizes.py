"""Expected against actual numbers of elements, and what they take in memory.

    python tests/benchmarks/mesh_sizes.py [meshes of the cell [meshes of the half]]

The first meshes of unit cell and half of the shipped designs and of extreme ones, and so many
refined ones (one and none without).
"""

from __future__ import annotations

import sys

from bellows_design.analysis.computation import Computation
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.mesh_sequence import next_plan
from bellows_design.analysis.models import HALF, UNIT_CELL
from bellows_design.benchmark.study import computations
from bellows_design.budget import Budget
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design, shipped_designs

AMPLE = Budget(memory=100.0, mesh_seconds=3600.0, seconds=86_400.0)
EXTREME = {
    "thin walls": ("bubble_thickness=0.8", "tendon_thickness=0.8"),
    "thin tendon": ("tendon_thickness=0.5",),
    "small fillets": ("inner_fillet=0.2", "outer_fillet=0.2"),
    "no fillets": ("inner_fillet=0", "outer_fillet=0"),
    "wide": ("bubble_width=60", "tendon_width=40"),
}
GENTLE = "load.pressure=0.005"
"""MPa. Any of them carries that; it is meshes that count."""


def main(cells: int = 2, halves: int = 1) -> None:
    """Print a table as it comes."""
    print("| design | model | expected | tetrahedra | ratio | expected memory |\n|" + "---|" * 6)
    designs = {name: load_design(name) for name in shipped_designs()}
    for name, changes in EXTREME.items():
        designs[name] = with_overrides(designs["prototype_1"], changes)
    for name, design in designs.items():
        gentle = with_overrides(design, [GENTLE])
        for model, meshes in ((UNIT_CELL, cells), (HALF, halves)):
            before: Computation | None = None
            for computation in computations(gentle, model, "", meshes, budget=AMPLE):
                _print_row(name, before, computation)
                before = computation


def _print_row(name: str, before: Computation | None, computation: Computation) -> None:
    first = first_plan(computation.solid, computation.design)
    plan = first if before is None else next_plan(before)
    actual = len(computation.finest.problem.mesh.tets)
    print(
        f"| {name} | {computation.model.name} | {plan.elements:.0f} | {actual} "
        f"| {plan.elements / actual:.2f} | {plan.memory:.2f} GiB |",
        flush=True,
    )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
