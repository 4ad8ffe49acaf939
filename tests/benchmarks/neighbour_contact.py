"""Neighbouring bubbles that touch: the half actuator with their contact and without, and the cell.

    python tests/benchmarks/neighbour_contact.py [tests/benchmarks/neighbour_contact.json]

``crowded``: three bubbles 0.5 mm apart that bulge into each other, free; the unit cell, which has
contact with mirror images, answers for it with an estimate of its error. ``load cell``: Prototype
1 with the lower edge of its tip held at its height, as over a load cell, so that its bubbles are
pressed together. Halves on their coarsest mesh. Force of the full width. Rows are written as
they come; those in the file are not computed again. Minutes for each.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bellows_design.analysis.evaluate import evaluation_of
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.mesh_sequence import started
from bellows_design.analysis.models import HALF, UNIT_CELL
from bellows_design.analysis.wall_contact import contact_of
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.files.json_files import write_json
from bellows_design.geometry.face_names import TIP
from solver import Problem, Solution, SolverOptions, Supports, reaction, solve
from solver.arrays import Reals

CROWDED = (
    "bubble_distance=0.5", "bubble_thickness=1.2", "bubble_width=20", "bubble_height=16",
    "tendon_width=20", "tendon_height=8", "tendon_thickness=2.5", "outer_fillet=1", "length=40",
    "number_of_bubbles=3", "chamber_length=2", "load.pressure=0.1",
)  # fmt: skip
"""In place of Prototype 1's numbers."""

OPTIONS = SolverOptions(tolerance=1e-4, seconds=3600.0)


def crowded() -> Design:
    """Wide bubbles close together on a stiff tendon."""
    return with_overrides(load_design("prototype_1"), list(CROWDED))


def half(design: Design) -> Problem:
    """Half of the actuator on its coarsest mesh."""
    return HALF.problem(design, first_plan(HALF.solid(design), design).made())


def over_a_load_cell(problem: Problem) -> Problem:
    """With the lower edge of the tip held at its height."""

    def height(places: Reals, _: float) -> Reals:
        motion = np.full(places.shape, np.nan)
        motion[np.abs(places[:, 2]) < 1e-6, 2] = 0.0
        return motion

    supports: Supports = replace(problem.supports, prescribed={TIP: height})
    return replace(problem, supports=supports)


def row(name: str, design: Design, problem: Problem) -> dict[str, Any]:
    """Solve, and read."""
    began = time.perf_counter()
    found = solve(problem, design.load.pressure, OPTIONS)
    seconds = time.perf_counter() - began
    contact = contact_of(design.bellows, problem.mesh, found.displacement, problem)
    return {
        "case": name,
        "model": "half, contact" if problem.contacts else "half, no contact",
        "elements": len(problem.mesh.tets),
        "pressure_mpa": found.pressure,
        "converged": found.converged,
        "message": found.message,
        "angle_deg": found.rotation,
        "gap_mm": contact.min_gap_mm,
        "touching": contact.where,
        "holds": not contact.void,
        "force_z_n": force(found),
        "iterations": found.newton_iterations,
        "factorizations": found.factorizations,
        "load_steps": found.load_steps,
        "refused_steps": found.refused_steps,
        "seconds": seconds,
    }


def force(found: Solution) -> float | None:
    """Of the load cell on the tip along z, N, of the full width."""
    if not found.problem.supports.prescribed:
        return None
    return float(2 * reaction(found, TIP).force[2])


def cell_row(name: str, design: Design) -> dict[str, Any]:
    """The unit cell with its ends and the estimate of its error, on its first two meshes."""
    began = time.perf_counter()
    found = evaluation_of(started(design, UNIT_CELL, "", meshes=2))
    return {
        "case": name,
        "model": "unit cell, contact",
        "elements": found.mesh.elements,
        "pressure_mpa": found.pressure_mpa,
        "converged": found.converged,
        "message": found.message,
        "angle_deg": found.bending_angle_deg,
        "angle_error_percent": found.error_estimate.bending_angle_percent,
        "gap_mm": found.contact.min_gap_mm,
        "touching": found.contact.where,
        "holds": not found.contact.void,
        "seconds": time.perf_counter() - began,
    }


def rows(done: set[tuple[str, str]]) -> Any:
    """The rows that are not ``done``, each when it is computed."""
    design = crowded()
    if ("crowded", "unit cell, contact") not in done:
        yield cell_row("crowded", design)
    free, prototype = half(design), load_design("prototype_1")
    cases = (("crowded", design, free), ("load cell", prototype, over_a_load_cell(half(prototype))))
    for name, each, problem in cases:
        for kept in (replace(problem, contacts=()), problem):
            model = "half, contact" if kept.contacts else "half, no contact"
            if (name, model) not in done:
                yield row(name, each, kept)


def main(target: str = "tests/benchmarks/neighbour_contact.json") -> None:
    """Compute the rows that are missing, and print them all as a table."""
    path = Path(target)
    known = json.loads(path.read_text("utf-8"))["rows"] if path.is_file() else []
    for new in rows({(each["case"], each["model"]) for each in known}):
        known.append(new)
        write_json({"rows": known}, path)
        print(json.dumps(new), flush=True)
    print("| case | model | angle, ° | gap, mm | force, N | iterations | seconds |")
    print("|---|---|---|---|---|---|---|")
    for each in known:
        lifted = each.get("force_z_n")
        cells = (
            each["case"], each["model"], f"{each['angle_deg']:.2f}", f"{each['gap_mm']:.4f}",
            "" if lifted is None else f"{lifted:.3f}", each.get("iterations", ""),
            f"{each['seconds']:.0f}",
        )  # fmt: skip
        print("| " + " | ".join(str(cell) for cell in cells) + " |")


if __name__ == "__main__":
    main(*sys.argv[1:])
