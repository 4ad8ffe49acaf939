"""Speed against error: Prototype 1 model by mesh, and every design of the paper at its default.

    python tests/benchmarks/work_precision.py [results.json [reference.json]]

Prints two Markdown tables. The second one shows what the product's own error estimates are worth:
a ratio below 0.5 says that an error is more than twice its estimate.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from bellows_design import load_design
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.benchmark.reference import STORED
from bellows_design.benchmark.study import study
from bellows_design.study.paper import TABLE_4

WORK = (
    "| model | tetrahedra | unknowns | factorizations | this mesh | so far | memory "
    "| angle | error | stress | error |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|"
)
CALIBRATION = (
    "| design | angle | estimate | error | ratio | stress | estimate | error | ratio | seconds |\n"
    "|---|---|---|---|---|---|---|---|---|---|"
)


def work_row(model: str, mesh: dict[str, Any]) -> str:
    """One mesh of one model."""
    error = mesh["error"]
    cells = (
        model,
        mesh["elements"],
        mesh["unknowns"],
        mesh["factorizations"],
        f"{mesh['seconds']['total']:.2f} s",
        f"{mesh['seconds_so_far']['total']:.2f} s",
        shown(mesh["peak_memory_mib"], ".0f", " MiB"),
        f"{mesh['bending_angle_deg']:.1f}°",
        shown(error["bending_angle_percent"], ".2f", " %"),
        f"{mesh['max_von_mises_mpa']:.2f} MPa",
        shown(error["max_von_mises_percent"], ".1f", " %"),
    )
    return f"| {' | '.join(map(str, cells))} |"


def calibration_row(label: str, mesh: dict[str, Any]) -> str:
    """One design: what was estimated and what was true."""
    cells = [label]
    for key, value in (
        ("bending_angle", f"{mesh['bending_angle_deg']:.1f}°"),
        ("max_von_mises", f"{mesh['max_von_mises_mpa']:.2f} MPa"),
    ):
        cells += [
            value,
            shown(mesh["error_estimate"][f"{key}_percent"], ".1f", " %"),
            shown(mesh["error"][f"{key}_percent"], ".2f", " %"),
            shown(mesh["estimate_over_error"][key], ".1f", ""),
        ]
    return f"| {' | '.join(cells)} | {mesh['seconds_so_far']['total']:.1f} |"


def shown(value: float | None, form: str, unit: str) -> str:
    """A number with its unit; a dash where there is none."""
    return "–" if value is None else f"{value:{form}}{unit}"


def main(target: str | None = None, references: str | None = None) -> None:
    """Measure, print, and write to ``target``."""
    source = STORED if references is None else Path(references)
    found: dict[str, Any] = {"calibration": {}}
    found["prototype_1"] = study(load_design("prototype_1"), references=source).to_dict()
    print(WORK, flush=True)
    for model in found["prototype_1"]["models"]:
        for mesh in model["meshes"]:
            print(work_row(model["model"], mesh), flush=True)
    print(f"\n{CALIBRATION}", flush=True)
    for case in TABLE_4:
        single = study(case.build(), (UNIT_CELL.name,), UNIT_CELL.levels, references=source)
        found["calibration"][case.label] = single.to_dict()
        mesh = found["calibration"][case.label]["models"][0]["meshes"][-1]
        print(calibration_row(case.label, mesh), flush=True)
    if target is not None:
        Path(target).write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
