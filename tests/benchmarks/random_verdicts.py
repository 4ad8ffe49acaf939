"""Verdicts on random designs and loads, held against finer meshes and against the half model.

    python tests/benchmarks/random_verdicts.py RESULTS.jsonl [count [worker workers]]
    python tests/benchmarks/random_verdicts.py --halves HALVES.jsonl RESULTS.jsonl ...
    python tests/benchmarks/random_verdicts.py --table RESULTS.jsonl ...

Designs, materials and loads are drawn with a fixed seed within the documented bounds: vacuum and
narrow gaps, soft materials, one bubble to twelve. Each is evaluated and decided as ``bellows run``
does, but that its walls need not be whole printed lines: what is held against other computations is
the evaluation. Every one that converged is solved on one more mesh, and the first approved ones of
the unit cell, few bubbles first, with the half model too. A run continues where an earlier one with
the same file ended; several workers share the designs between them. The rows of the run that
``docs/accuracy.md`` reports are in ``random_verdicts.jsonl``, without the designs, which are drawn
again; the tests run a sample.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from random_designs import RANGES, admissible

from bellows_design.analysis.evaluate import evaluate, loaded_state
from bellows_design.analysis.evaluation import Evaluation, LoadedState
from bellows_design.analysis.mesh_sequence import refined
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.approval import REQUIRED_RULES, decide, open_question
from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.materials import load_material, material_names
from printers import PrintabilityReport, RuleResult
from solver.errors import MeshingError

SEED = 20261126
NUMBERS = {name: span for name, span in RANGES.items() if name != "bubble_distance"}
GAPS, NARROW = (0.8, 3.0), (0.4, 0.8)
LOADS = (0.005, 0.045)
"""Pressure over initial shear modulus: 0.02 to 0.15 MPa of NinjaFlex."""

AMPLE = Budget(memory=12.0, mesh_seconds=600.0, seconds=3600.0)
HALVES = 20
STORED = Path(__file__).with_suffix(".jsonl")
PASSED = PrintabilityReport(
    "any", tuple(RuleResult(name, "pass", 0, 0, "", "part", "") for name in REQUIRED_RULES)
)


def drawn(count: int) -> list[Design]:
    """So many admissible designs, each under its load."""
    return admissible(count, SEED, _draw)


def _draw(generator: np.random.Generator, name: str) -> Design | None:
    """One draw; None if the numbers describe no solid."""
    numbers: dict[str, Any] = {
        key: round(generator.uniform(*span), 2) for key, span in NUMBERS.items()
    }
    gap = round(generator.uniform(*(NARROW if generator.random() < 0.25 else GAPS)), 2)
    count = int(generator.choice([1, 2]) if generator.random() < 0.1 else generator.integers(3, 13))
    pitch = numbers["chamber_length"] + 2 * numbers["bubble_thickness"] + gap
    numbers |= {"bubble_distance": gap, "number_of_bubbles": count, "offset": 5.0}
    numbers["length"] = round(max(10.0, 10.0 + count * pitch - gap), 2)
    soft = generator.random() < 0.4
    material = str(generator.choice(material_names())) if soft else "ninjaflex"
    stiffness = load_material(material).hyperelastic().shear_modulus
    pressure = max(0.001, round(generator.uniform(*LOADS) * stiffness, 4))
    if generator.random() < 0.25:
        pressure = -min(pressure, 0.09)
    content = {"name": name, "bellows": numbers, "load": {"pressure": pressure}}
    try:
        return Design.model_validate(content | {"material": material})
    except ValueError:
        return None


def row_of(design: Design) -> dict[str, Any]:
    """Evaluation and verdict of a design, and the same values on one more mesh."""
    began = time.perf_counter()
    row: dict[str, Any] = {"name": design.name}
    try:
        found = evaluate(design, open_question=lambda state: open_question(design, PASSED, state))
    except (BellowsError, MeshingError) as error:
        return row | {"error": str(error), "seconds": time.perf_counter() - began}
    row |= _decided(design, found) | {"seconds": time.perf_counter() - began}
    row |= {"meshes": _meshes(found)}
    return row | {"finer": finer_of(design, found)} if found.converged else row


def _meshes(found: Evaluation) -> list[dict[str, float]]:
    """What each mesh says: the error estimates come from these."""
    readings = (mesh.reading for mesh in found.meshes)
    return [
        {"angle": one.bending_angle_deg, "stress": one.max_von_mises_mpa, "scatter": peak.scatter}
        for one, peak in zip(readings, found.computation.peaks, strict=True)
    ]


def finer_of(design: Design, found: Evaluation) -> dict[str, Any]:
    """The values on one more mesh."""
    began = time.perf_counter()
    try:
        computation = refined(replace(found.computation, budget=AMPLE))
    except MeshingError as error:
        return {"error": str(error)}
    seconds = {"seconds": time.perf_counter() - began}
    return _decided(design, loaded_state(computation)) | seconds


def half_of(design: Design) -> dict[str, Any]:
    """The half model's values for a design."""
    began = time.perf_counter()
    found = evaluate(design, "half", budget=AMPLE)
    return _decided(design, found) | {"seconds": time.perf_counter() - began}


def _decided(design: Design, state: LoadedState) -> dict[str, Any]:
    verdict, error = decide(design, PASSED, state), state.error_estimate
    model = {"model": state.model.name} if isinstance(state, Evaluation) else {}
    return model | {
        "approved": verdict.approved,
        "kinds": [reason.kind for reason in verdict.reasons],
        "message": state.message,
        "angle": state.bending_angle_deg,
        "angle_percent": error.bending_angle_percent,
        "stress": state.max_von_mises_mpa,
        "stress_percent": error.max_von_mises_percent,
        "touching": list(state.contact.where),
    }


def main(target: str, count: str = "200", worker: str = "0", workers: str = "1") -> None:
    """Run this worker's share of the designs that the file does not hold yet."""
    path = Path(target)
    known = {row["name"] for row in read(path)} if path.exists() else set()
    for number, design in enumerate(drawn(int(count))):
        if number % int(workers) == int(worker) and design.name not in known:
            append(path, row_of(design))


def halves(target: str, source: list[str]) -> None:
    """The half model for the approved rows of ``source`` with the fewest bubbles."""
    rows = [row for name in source for row in read(Path(name))]
    designs = {design.name: design for design in drawn(len(rows))}
    found = [
        designs[row["name"]]
        for row in rows
        if row.get("approved") and row["model"] == UNIT_CELL.name and not row["touching"]
    ]
    found.sort(key=lambda design: design.bellows.bubble_count)
    for design in found[:HALVES]:
        append(Path(target), {"name": design.name, "half": half_of(design)})


def read(path: Path) -> list[dict[str, Any]]:
    """The rows of a file."""
    return [json.loads(line) for line in path.read_text("utf-8").splitlines()]


def append(path: Path, row: dict[str, Any]) -> None:
    """One more row at the end of a file."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(row) + "\n")


def ratio(value: float, percent: float, other: float, its_percent: float) -> float:
    """Difference of two values over the sum of their stated errors."""
    return abs(value - other) / (abs(value) * percent + abs(other) * its_percent) * 100


def ratios(row: dict[str, Any], against: dict[str, Any], key: str) -> float | None:
    """The same for one quantity of a row against another computation; None without estimates."""
    if "error" in against:
        return None
    percents = row[f"{key}_percent"], against[f"{key}_percent"]
    if None in percents or None in (row[key], against[key]):
        return None
    return ratio(row[key], percents[0], against[key], percents[1])


def table(rows: list[dict[str, Any]]) -> str:
    """What became of the designs, and how far the estimates reach, as Markdown."""
    designs = [row for row in rows if "half" not in row]
    halves = {row["name"]: row["half"] for row in rows if "half" in row}
    approved = [row for row in designs if row.get("approved")]
    finer = {row["name"]: row["finer"] for row in approved}
    lines = [*_outcomes(designs), "", *_agreement("a finer mesh", approved, finer)]
    return "\n".join([*lines, *_agreement("the half model", approved, halves)])


def _outcomes(designs: list[dict[str, Any]]) -> list[str]:
    """How many designs were approved, refused and why, and the longest time."""
    counts = {
        "approved, but for the printer's rules": sum(row.get("approved", False) for row in designs)
    }
    for kind in ("contact", "convergence", "stress", "accuracy", "strain"):
        counts[f"refused for {kind}"] = sum(kind in row.get("kinds", ()) for row in designs)
    counts["no mesh, or beyond the budget of memory"] = _count(designs, "error")
    counts["ended without a reason"] = sum(
        not (row.get("approved") or row.get("kinds") or row.get("error")) for row in designs
    )
    longest = max(row["seconds"] for row in designs)
    lines = [f"| of {len(designs)} designs, seed {SEED} | |", "|---|---|"]
    lines += [f"| {name} | {number} |" for name, number in counts.items()]
    return [*lines, f"| longest evaluation | {longest:.0f} s |"]


def _count(rows: list[dict[str, Any]], key: str) -> int:
    return sum(key in row for row in rows)


def _agreement(
    what: str, approved: list[dict[str, Any]], others: dict[str, dict[str, Any]]
) -> list[str]:
    """How the approved values differ from others, in sums of both stated errors."""
    lines = [
        f"| against {what} | designs | within 1 | within 2 | largest |",
        "|---|---|---|---|---|",
    ]
    for key in ("angle", "stress"):
        found = np.array([
            value
            for row in approved
            if row["name"] in others
            and (value := ratios(row, others[row["name"]], key)) is not None
        ])  # fmt: skip
        if not found.size:
            continue
        shares = f"{(found <= 1).mean():.0%} | {(found <= 2).mean():.0%} | {found.max():.2f}"
        lines.append(f"| {key} | {found.size} | {shares} |")
    return [*lines, ""]


if __name__ == "__main__":
    if sys.argv[1] == "--table":
        print(table([row for name in sys.argv[2:] for row in read(Path(name))]))
    elif sys.argv[1] == "--halves":
        halves(sys.argv[2], sys.argv[3:])
    else:
        main(*sys.argv[1:5])
