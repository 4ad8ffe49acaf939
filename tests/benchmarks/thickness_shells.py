"""Local thickness of analytic shells: seconds and error against the number of triangles.

    python tests/benchmarks/thickness_shells.py [-o FILE] [--most TRIANGLES]

Prints a row for every shell and mesh as soon as it is measured, and writes all of them as JSON.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from analytic_shells import SHELLS, Mesh

from printers.measure.samples import sample
from printers.measure.surface import merged_surface
from printers.measure.thickness.local_thickness import local_thickness

THICKNESS = 1.2
REACH = 2.5
SAMPLES = 20_000
WANTED = (1_000, 10_000, 100_000, 1_000_000)


def shell(name: str, triangles: int) -> Mesh:
    """The shell with about so many triangles; round ones have them all over, others in rounds."""
    most = round((triangles / 2) ** 0.5) if name == "sphere" else triangles // 16
    return SHELLS[name](THICKNESS, max(8, 4 * (most // 4)))


def measured(name: str, wanted: int) -> dict[str, Any]:
    """Seconds of a run whose functions are compiled, and the error over all places with a wall."""
    vertices, triangles = shell(name, wanted)
    began = time.perf_counter()
    surface = merged_surface(vertices, triangles)
    points = sample(surface, 4.0, (SAMPLES, SAMPLES))
    surface.tree  # noqa: B018
    prepared = time.perf_counter()
    thickness = local_thickness(surface, points, REACH).thickness
    ended = time.perf_counter()
    error = np.abs(thickness[np.isfinite(thickness)] - THICKNESS)
    return {
        "shell": name,
        "triangles": len(surface.triangles),
        "tree_seconds": prepared - began,
        "thickness_seconds": ended - prepared,
        "median_error_mm": float(np.median(error)),
        "error_99_percent_mm": float(np.quantile(error, 0.99)),
        "largest_error_mm": float(error.max()),
    }


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path("thickness_shells.json"))
    parser.add_argument("--most", type=int, default=WANTED[-1])
    options = parser.parse_args()
    measured("sphere", WANTED[0])  # compiles
    print(
        f"{'shell':14}{'triangles':>10}{'tree s':>9}{'thickness s':>13}{'median':>10}{'99 %':>10}"
    )
    rows = []
    for name in SHELLS:
        for wanted in (number for number in WANTED if number <= options.most):
            rows.append(measured(name, wanted))
            row = rows[-1]
            print(
                f"{name:14}{row['triangles']:10}{row['tree_seconds']:9.3f}"
                f"{row['thickness_seconds']:13.3f}{row['median_error_mm']:10.5f}"
                f"{row['error_99_percent_mm']:10.5f}",
                flush=True,
            )
            options.output.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
