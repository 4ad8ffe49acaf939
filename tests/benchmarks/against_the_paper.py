"""Every design the paper computed, evaluated by us: angle and stress with estimated errors.

    python tests/benchmarks/against_the_paper.py [results.json]

Prints the table of docs/paper.md and, if asked, writes all numbers, seconds among them, as JSON.
"""

from __future__ import annotations

import json
import os
import platform
import sys
from pathlib import Path
from typing import Any

from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.study.paper import TABLE_4, Result
from bellows_design.versions import versions

HEADING = (
    "| design | angle, paper | angle, ours | stress, paper | stress, ours | tetrahedra |\n"
    "|---|---|---|---|---|---|"
)


def row(case: Result, evaluation: Evaluation) -> str:
    """One line of the table."""
    error = evaluation.error_estimate
    angle, stress = evaluation.bending_angle_deg, evaluation.max_von_mises_mpa
    off = 100 * (angle / case.bending_angle_deg - 1)
    return (
        f"| {case.label} | {case.bending_angle_deg:g}° "
        f"| {angle:.0f}° ± {error.bending_angle_percent:.0f} % ({off:+.1f} %) "
        f"| {case.max_stress_mpa:.2f} MPa "
        f"| {stress:.2f} MPa ± {error.max_von_mises_percent:.0f} % "
        f"| {evaluation.mesh.elements} |"
    )


def main(target: str | None = None) -> None:
    """Evaluate, print, and write to ``target``."""
    results: list[dict[str, Any]] = []
    print(HEADING, flush=True)
    for case in TABLE_4:
        evaluation = evaluate(case.build())
        results.append({"label": case.label, **evaluation.to_dict()})
        print(row(case, evaluation), flush=True)
    machine = {"processor": platform.machine(), "cores": os.cpu_count(), "versions": versions()}
    if target is not None:
        content = json.dumps({"machine": machine, "results": results}, indent=1)
        Path(target).write_text(content + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:2])
