"""Seconds and memory to read G-code, against its size.

    python tests/benchmarks/reading_gcode.py [FILE.gcode ...] [--json times.json]

Without files, it writes some itself, of walls and arcs. Each is read three times; the best counts.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
import tracemalloc
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from printers.gcode.reading import read_gcode

SIZES = (10_000, 100_000, 1_000_000, 1_999_000)


def written(folder: Path) -> Iterator[Path]:
    for moves in SIZES:
        path = folder / f"{moves}_moves.gcode"
        lines = ["; filament_diameter = 1.75", "M83", ";LAYER_CHANGE", ";HEIGHT:0.2", "G1 Z.2"]
        for move in range(moves):
            if move % 50 == 0:
                lines += [";TYPE:Perimeter", f";WIDTH:0.{400_000 + move % 7}"]
            lines.append(f"G1 X{100 + move % 97:.3f} Y{100 + move * 7 % 89:.3f} E.04567")
        path.write_text("\n".join(lines) + "\n")
        yield path


def measured(path: Path) -> dict[str, Any]:
    times = []
    for _ in range(3):
        start = time.perf_counter()
        code = read_gcode(path)
        times.append(time.perf_counter() - start)
    tracemalloc.start()
    read_gcode(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    size = path.stat().st_size
    row = {"file": path.name, "mb": size / 1e6, "beads": len(code.beads), "seconds": min(times)}
    return {**row, "mb_per_second": size / 1e6 / min(times), "memory_mb": peak / 1e6}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows = []
    print(f"{'file':>24} {'MB':>7} {'beads':>9} {'s':>7} {'MB/s':>6} {'memory, MB':>10}")
    with tempfile.TemporaryDirectory() as folder:
        for path in options.files or written(Path(folder)):
            row = measured(path)
            rows.append(row)
            print(
                f"{row['file']:>24} {row['mb']:7.2f} {row['beads']:9d} {row['seconds']:7.3f} "
                f"{row['mb_per_second']:6.0f} {row['memory_mb']:10.1f}",
                flush=True,
            )
            if options.json:
                options.json.write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    main()
