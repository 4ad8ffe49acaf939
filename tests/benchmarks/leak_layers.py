"""Layers of 0.06 to 0.20 mm in the model of the beads, against vessels that were measured.

    python tests/benchmarks/leak_layers.py

Vessels printed with layers of 0.06 and 0.10 mm held 7.5 bar for minutes, those with 0.15 and
0.20 mm lost it within one (Zillen, CC0). One box is sliced with each; the table says what the leak
test makes of it. It cannot tell them apart: slicers space lines so that a bead with round sides
fills its spacing whatever its height, so F between two beads is the same, 1 over the flow.
Needs PrusaSlicer; writes `leak_layers.json`.
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
HEIGHTS = (0.06, 0.10, 0.15, 0.20)


def row(height: float) -> dict[str, Any]:
    """What the leak test says of a box with layers of the height, mm."""
    plain, port = load_profile("prusa_i3"), port_of()
    layers = round(plain.minimum_floor / height)
    profile = plain.model_copy(update={"layer_height": height, "minimum_solid_layers": layers})
    sliced = slice_mesh(*arrays(hollow_box()), profile)
    centre = sliced.placement.to_gcode(np.array([port.centre]))[0]
    opening = Opening(port.name, tuple(centre), port.direction, port.radius)
    test = leak_test(sliced.gcode.beads, [opening], profile, seams=False)
    return {
        "layer": height,
        "ratio": round(test.ratio, 3),
        "lines": round(test.depth.lines, 2),
    }


def main() -> None:
    """Print rows as they come."""
    kept = []
    print("| layer, mm | r* | depth, lines |\n|---|---|---|")
    for height in HEIGHTS:
        kept.append(row(height))
        print("| " + " | ".join(str(value) for value in kept[-1].values()) + " |", flush=True)
        RESULTS.write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    main()
