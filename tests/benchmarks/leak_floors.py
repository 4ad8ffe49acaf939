"""How many layers a floor and a roof need in the model of the beads.

    python tests/benchmarks/leak_floors.py

A box whose floor and roof are 1 to 12 layers thick is sliced with the airtight profile. For each
the table says r*, the depth of the seal, and how much every path may lose at its ends before a leak
opens: what lies between one closed layer and a floor that stays closed when ends are missing.
Needs PrusaSlicer; writes `leak_floors.json`.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import numpy as np
from small_solids import arrays, hollow_box, port_of

from printers import Opening, load_profile
from printers.leak_test import leak_test
from printers.slicing.making import slice_mesh

RESULTS = Path(__file__).with_suffix(".json")
LAYERS = (2, 3, 4, 5, 6, 8, 10, 12)
"""The first one is 0.2 mm high, so that a floor of one layer does not exist."""


def row(layers: int) -> dict[str, Any]:
    """What the leak test says of a box with floor and roof of so many layers of 0.1 mm."""
    profile = load_profile("prusa_i3")
    floor = layers * profile.layer_height
    port = port_of(floor=floor)
    sliced = slice_mesh(*arrays(hollow_box(floor=floor)), profile)
    centre = sliced.placement.to_gcode(np.array([port.centre]))[0]
    opening = Opening(port.name, tuple(centre), port.direction, port.radius)
    test = leak_test(sliced.gcode.beads, [opening], profile)
    return {
        "layers": layers,
        "ratio": round(test.ratio, 3),
        "verdict": test.verdict,
        "lines": round(test.depth.lines, 2),
        "lines_beside_voids": round(test.depth.lines_beside_voids, 2),
        "seams_hold_mm": test.seams and test.seams.holds,
        "printed_depth": next(r.verdict for r in test.rules if r.rule == "printed_depth"),
    }


def main() -> None:
    """Print rows as they come."""
    kept = []
    names = ("layers", "r*", "verdict", "depth, lines", "beside voids", "seams hold, mm", "rule")
    print("| " + " | ".join(names) + " |\n" + "|---" * len(names) + "|")
    for layers in LAYERS:
        kept.append(row(layers))
        print("| " + " | ".join(str(value) for value in kept[-1].values()) + " |", flush=True)
        RESULTS.write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    main()
