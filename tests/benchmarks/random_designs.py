"""Random admissible designs through the unit cell: how many converge, how long they take.

    python tests/benchmarks/random_designs.py [count [results.json]]

Numbers are drawn around the paper's with a fixed seed; draws that are refused as no solid do not
count. Prints those that did not converge, then how many did and the distributions of seconds,
factorizations and estimated errors, as Markdown.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from solver import Solution
from solver.assembly.assembly import Assembly

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


Draw = Callable[[np.random.Generator, str], Design | None]


def drawn(count: int) -> list[Design]:
    """So many admissible designs of four bubbles or more."""
    return admissible(count, SEED, _draw)


def admissible(count: int, seed: int, draw: Draw) -> list[Design]:
    """So many designs by ``draw``, which gives None where numbers describe no solid."""
    generator = np.random.default_rng(seed)
    found: list[Design] = []
    while len(found) < count:
        design = draw(generator, f"random_{len(found)}")
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
    content, solutions = evaluation.to_dict(), evaluation.computation.solutions
    return {
        "converged": evaluation.converged,
        "reason": "" if evaluation.converged else evaluation.message,
        "straight": all(s.refused_steps == 0 for s in solutions),
        "right_inertia": all(
            s.negative_pivots in (None, len(s.problem.mesh.vertices)) for s in solutions
        ),
        "residual": imbalance(evaluation.computation.finest),
        "angle": content["bending_angle_deg"],
        "stress": content["max_von_mises_mpa"],
        "contact": content["contact"]["detected"],
        "estimate": content["error_estimate"],
        "factorizations": content["solver"]["factorizations"],
        "elements": content["mesh"]["elements"],
        "seconds": content["seconds"]["total"],
    }


def imbalance(solution: Solution) -> float:
    """What is left of the forces in a solution, relative to those of the pressure."""
    there = Assembly(solution.problem).evaluate(solution.state, solution.pressure, tangent=False)
    pushed = np.linalg.norm(solution.pressure * there.force)
    return float(np.linalg.norm(there.residual) / pushed)


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
    print(table(rows))


def table(rows: list[dict[str, Any]]) -> str:
    """Shares, then distributions, as Markdown."""
    good = [row for row in rows if row["converged"]]
    lines = [f"| of {len(rows)} designs, seed {SEED} | |", "|---|---|"]
    counts = {
        "converged at the default settings": len(good),
        "without a single refused load step": sum(row["straight"] for row in good),
        "of those that did not converge, ended with a reason": sum(
            bool(row["reason"]) for row in rows if not row["converged"]
        ),
        "reported a state of wrong inertia": sum(not row["right_inertia"] for row in good),
        "touching walls": sum(row["contact"] for row in good),
    }
    lines += [f"| {name} | {number} |" for name, number in counts.items()]
    lines += [f"| largest relative residual | {max(row['residual'] for row in good):.1e} |"]
    lines += ["", "| | 10 % | 50 % | 90 % | 100 % |", "|---|---|---|---|---|"]
    distributions = {
        "seconds": [row["seconds"] for row in good],
        "factorizations": [row["factorizations"] for row in good],
        "tetrahedra": [row["elements"] for row in good],
        "angle, °": [row["angle"] for row in good],
        "stress, MPa": [row["stress"] for row in good],
        "estimated error of the angle, %": _estimates(good, "bending_angle_percent"),
        "estimated error of the stress, %": _estimates(good, "max_von_mises_percent"),
    }
    for name, values in distributions.items():
        shares = " | ".join(f"{value:.3g}" for value in np.percentile(values, (10, 50, 90, 100)))
        lines.append(f"| {name} | {shares} |")
    return "\n".join(lines)


def _estimates(rows: list[dict[str, Any]], key: str) -> list[float]:
    found = [row["estimate"][key] for row in rows]
    return [value for value in found if value is not None]


if __name__ == "__main__":
    main(*sys.argv[1:3])
