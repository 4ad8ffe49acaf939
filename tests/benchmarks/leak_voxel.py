"""The side of the leak test's cells against the pin that it finds, and the seconds it takes.

    python tests/benchmarks/leak_voxel.py

The part is a cut-out: one hollow box with walls of three lines, with pins of several diameters in
its wall and in its roof. Needs PrusaSlicer; prints a table and writes `leak_voxel.json`.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import numpy as np
from manifold3d import Manifold
from small_solids import arrays, bore, hollow_box, port_of

from printers import Opening, load_profile
from printers.leak_test import leak_test
from printers.slicing.making import slice_mesh

RESULTS = Path(__file__).with_suffix(".json")
VOXELS = (0.13, 0.1, 0.05, 0.025)
DIAMETERS = (0.1, 0.15, 0.2, 0.3, 0.5)


def pins() -> Iterator[tuple[str, Manifold]]:
    """The sound box, and with a pin hole through its wall at y = 10.4 or through its roof."""
    yield "sound", hollow_box()
    for size in DIAMETERS:
        yield f"wall, {size:g}", hollow_box() - bore(size / 2, (7.0, 8.9, 5.2), 2.0, axis=1)
        yield f"roof, {size:g}", hollow_box() - bore(size / 2, (7.0, 5.2, 8.9), 2.0, axis=2)


def rows() -> Iterator[dict[str, Any]]:
    """A row for every pin and voxel."""
    profile, port = load_profile("prusa_i3"), port_of()
    for name, solid in pins():
        sliced = slice_mesh(*arrays(solid), profile)
        centre = sliced.placement.to_gcode(np.array([port.centre]))[0]
        opening = Opening(port.name, tuple(centre), port.direction, port.radius)
        for voxel in VOXELS:
            started = time.process_time()
            test = leak_test(sliced.gcode.beads, [opening], profile, voxel=voxel, seams=False)
            seconds = time.process_time() - started
            yield {"pin": name, "voxel": voxel, "ratio": round(test.ratio, 3),
                   "verdict": test.verdict, "width": round(test.width, 3),
                   "lines": round(test.depth.lines, 2), "cpu_s": round(seconds, 2)}  # fmt: skip


def main() -> None:
    """Print rows as they come."""
    kept = []
    print("| pin, mm | voxel, mm | r* | verdict | width, mm | depth, lines | CPU, s |")
    print("|" + "---|" * 7)
    for row in rows():
        kept.append(row)
        print("| " + " | ".join(str(value) for value in row.values()) + " |", flush=True)
        RESULTS.write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    main()
