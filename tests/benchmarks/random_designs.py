"""Random admissible designs through the unit cell: how many converge, how long they take.

    python tests/benchmarks/random_designs.py [count [results.json]]

Numbers are drawn around the paper's with a fixed seed; draws that are refused as no solid do not
count. Prints a table of those that did not converge at the first try, then the distribution of
seconds, estimated errors and factorizations.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

from bellows_design.design import Design, load_design
from bellows_design.evaluation import Evaluation, evaluate

SEED = 20261122
RANGES = {
    "bubble_width": (10, 26),
    "bubble_height": (10, 26),
    "bubble_thickness": (0.8, 2.4),
    "tendon_width": (5, 16),
    "tendon_height": (3.5, 8),
    "tendon_thickness": (0.8, 2.4),
    "chamber_length": (1.0, 4.0),
    "bubble_distance": (0.8, 3.0),
    "inner_fillet": (0.2, 1.2),
    "outer_fillet": (0.3, 2.5),
}
PRESSURES = (0.02, 0.15)


def drawn(count: int) -> list[Design]:
    """So many admissible designs of four bubbles or more."""
    generator = np.random.default_rng(SEED)
    found: list[Design] = []
    while len(found) < count:
        design = _draw(generator, f"random_{len(found)}")
        if design is not None:
            found.append(design)
    return found


def _draw(generator: np.random.Generator, name: str) -> Design | None:
    """One draw; None if the numbers describe no solid."""
    base = load_design("prototype_1")
    numbers = {key: round(generator.uniform(*span), 2) for key, span in RANGES.items()}
    pressure = round(generator.uniform(*PRESSURES), 3)
    bellows = base.bellows.model_dump() | numbers | {"length": 60.0, "offset": 5.0}
    content = base.model_dump() | {"name": name, "bellows": bellows}
    content["load"] = {"pressure": pressure}
    try:
        return Design.model_validate(content)
    except ValueError:
        return None


def result(design: Design) -> dict[str, Any]:
    """What came out, or why nothing did."""
    row: dict[str, Any] = {"design": design.bellows.model_dump(), "p": design.load.pressure}
    try:
        evaluation = evaluate(design, "unit-cell")
    except Exception as error:
        return row | {"converged": False, "reason": f"{type(error).__name__}: {error}"}
    return row | _found(evaluation)


def _found(evaluation: Evaluation) -> dict[str, Any]:
    content = evaluation.to_dict()
    stable = all(
        s.negative_pivots in (None, len(s.problem.mesh.vertices)) for s in evaluation.solutions
    )
    return {
        "converged": evaluation.converged,
        "reason": "" if evaluation.converged else evaluation.message,
        "first_try": all(s.refused_steps == 0 for s in evaluation.solutions),
        "right_inertia": stable,
        "angle": content["bending_angle_deg"],
        "stress": content["max_von_mises_mpa"],
        "contact": content["contact"]["detected"],
        "estimate": content["error_estimate"],
        "factorizations": content["solver"]["factorizations"],
        "elements": content["mesh"]["elements"],
        "seconds": content["seconds"]["total"],
    }


def main(count: str = "200", target: str | None = None) -> None:
    """Run, print, and write to ``target``."""
    rows = []
    for design in drawn(int(count)):
        rows.append(result(design))
        row = rows[-1]
        if not row["converged"] or not row["right_inertia"]:
            print(design.name, row["p"], row["reason"], row["design"], flush=True)
        if target is not None:
            Path(target).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    good = [row for row in rows if row["converged"]]
    print(
        f"{len(good)} of {len(rows)} converged; inertia right in all of them: "
        f"{all(row['right_inertia'] for row in good)}"
    )
    for key in ("seconds", "factorizations", "elements"):
        low, middle, high = np.percentile([row[key] for row in good], (10, 50, 90))
        print(f"{key}: {low:.3g} / {middle:.3g} / {high:.3g} (10, 50, 90 %)")


if __name__ == "__main__":
    main(*sys.argv[1:3])
