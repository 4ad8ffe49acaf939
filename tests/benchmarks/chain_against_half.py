"""What a finger exerts: half of it as a body against the chain of half bubbles.

    python tests/benchmarks/chain_against_half.py [--contact] [chain_against_half.json]

Four designs at their own pressure: Prototype 1, ``finger`` and two random ones whose numbers are
fixed; each free, under a dead force up and down at the tip, blocked by a load cell, and with
its tip held. The body is meshed as coarsely as carries the load, as the chain's cell is. With
``--contact`` neighbouring bubbles are kept apart; without it rows say which walls run through each
other. All is that of the full width. Rows are written as they come; those in the file are not
computed again. Minutes for each.

The force at the tip is a traction that grows with height so that its resultant lies on the lower
edge: it has no singularity, and turns a rigid tip as a force on that edge does. The load cell holds
the nodes of the lower edge at their height. (Along a line a body has no stiffness: with finer and
finer meshes the edge would sink in by the logarithm of their size, here by some 0.01 mm per N.)
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import HALF
from bellows_design.analysis.wall_contact import contact_of
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.files.json_files import write_json
from bellows_design.geometry.face_names import CAVITY, ROOT, TIP
from solver import (
    Mesh,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    Traction,
    cavity_volume,
    reaction,
    solve,
)
from solver.arrays import Reals

OPTIONS = SolverOptions(tolerance=1e-4, seconds=3600.0)

FORCE = 0.2
"""N, of the full width."""

RANDOM: dict[str, tuple[dict[str, float], float]] = {
    "random_four": (
        {
            "bubble_width": 14.45, "bubble_height": 12.62, "bubble_thickness": 1.9,
            "tendon_width": 11.92, "tendon_height": 6.76, "tendon_thickness": 2.07,
            "chamber_length": 2.76, "bubble_distance": 2.49, "inner_fillet": 0.81,
            "outer_fillet": 0.53, "length": 46.0, "number_of_bubbles": 4,
        },
        0.063,
    ),
    "random_six": (
        {
            "bubble_width": 17.77, "bubble_height": 18.48, "bubble_thickness": 2.09,
            "tendon_width": 8.78, "tendon_height": 4.23, "tendon_thickness": 1.53,
            "chamber_length": 3.39, "bubble_distance": 2.43, "inner_fillet": 0.79,
            "outer_fillet": 2.23, "length": 60.0,
        },
        0.11,
    ),
}  # fmt: skip
"""Name -> numbers in place of Prototype 1's (mm), and pressure (MPa): two of the first ten draws of
``random_designs.py``, the first cut to four bubbles."""


@dataclass(frozen=True)
class Case:
    """What acts on the tip: a ``force`` along z (N), a support of its lower edge or of it all."""

    name: str
    force: float = 0.0
    edge: bool = False
    face: bool = False


CASES = (
    Case("free"),
    Case("pulled up", force=FORCE),
    Case("pulled down", force=-FORCE),
    Case("load cell", edge=True),
    Case("held tip", face=True),
)


def designs() -> tuple[Design, ...]:
    """The four designs."""
    shipped = (load_design("prototype_1"), load_design("finger"))
    return (*shipped, *(_random(name, *numbers) for name, numbers in RANDOM.items()))


def _random(name: str, numbers: dict[str, float], pressure: float) -> Design:
    base = load_design("prototype_1")
    bellows = base.bellows.model_dump() | {"offset": 5.0} | numbers
    content = base.model_dump() | {"name": name, "bellows": bellows}
    return Design.model_validate(content | {"load": {"pressure": pressure}})


@cache
def mesh_of(design: Design) -> Mesh:
    """The coarsest mesh of half of the actuator."""
    return first_plan(HALF.solid(design), design).made()


def problem_of(design: Design, case: Case, contact: bool) -> Problem:
    """Half of the actuator with what acts on its tip."""
    if contact:
        raise SystemExit("--contact: the half model has no contact of neighbouring bubbles yet.")
    problem = HALF.problem(design, mesh_of(design))
    if case.face:
        held = replace(problem.supports, clamped=(ROOT, TIP))
        return replace(problem, supports=held)
    if case.edge:
        return replace(problem, supports=_with_edge(problem.supports))
    if case.force:
        return replace(problem, loads=(_at_lower_edge(problem.mesh, case.force / 2),))
    return problem


def _with_edge(supports: Supports) -> Supports:
    """With the lower edge of the tip held at its height."""

    def height(places: Reals, _: float) -> Reals:
        motion = np.full(places.shape, np.nan)
        motion[_low(places), 2] = 0.0
        return motion

    return replace(supports, prescribed={TIP: height})


def _low(places: Reals) -> Reals:
    """Which places (k, 3) are on the lower edge, z = 0."""
    low: Reals = np.abs(places[:, 2]) < 1e-6
    return low


def _at_lower_edge(mesh: Mesh, force: float) -> Traction:
    """A force along z (N) with its resultant on the lower edge: a + b z over the tip's face."""
    from solver.sensitivity.surface_integrals import areas, at_points

    triangles = mesh.triangles(TIP)
    weights, z = areas(mesh.nodes, triangles).ravel(), at_points(mesh.nodes, triangles)[..., 2]
    moments = [float((weights * z.ravel() ** power).sum()) for power in range(3)]
    matrix = np.array([moments[:2], moments[1:]])
    a, b = np.linalg.solve(matrix, [force, 0.0])

    def stress(places: Reals) -> Reals:
        along: Reals = (a + b * places[:, 2])[:, None] * [0.0, 0.0, 1.0]
        return along

    return Traction(TIP, stress)


def half_row(design: Design, case: Case, contact: bool) -> dict[str, Any]:
    """Solve for half of the finger, and read."""
    found = solve(problem_of(design, case, contact), design.load.pressure, OPTIONS)
    walls = contact_of(design.bellows, found.problem.mesh, found.displacement)
    return {
        "elements": len(found.problem.mesh.tets),
        "converged": found.converged,
        "message": found.message,
        "stable": found.stable,
        **readings(design, case, found),
        "walls_that_run_through_each_other": list(walls.where) if walls.void else [],
        "narrowest_gap_mm": walls.min_gap_mm,
        "seconds": found.seconds,
    }


def readings(design: Design, case: Case, found: Solution) -> dict[str, Any]:
    """Place and angle of the tip, volume, and what holds the tip, of the full width."""
    mesh, moved = found.problem.mesh, found.displacement
    tip = mesh.surface_nodes(TIP)
    edge = tip[_low(mesh.nodes[tip])]
    x, _, z = (mesh.nodes[edge] + moved[edge]).mean(axis=0).tolist()
    volume, at_rest = (cavity_volume(mesh, u, (CAVITY,)) for u in (moved, 0 * moved))
    found_there = {
        "tip_x_mm": x,
        "tip_z_mm": z,
        "tip_angle_deg": found.rotation,
        "volume_mm3": 2 * volume,
        "volume_at_rest_mm3": 2 * at_rest,
    }
    if not (case.edge or case.face):
        return found_there
    support = reaction(found, TIP, about=(design.bellows.length, 0.0, 0.0))
    force, moment = 2 * support.force, 2 * support.moment[1]
    return found_there | {
        "force_x_n": float(force[0]),
        "force_z_n": float(force[2]),
        "moment_n_mm": float(moment) if case.face else 0.0,
    }


def main() -> None:
    """Compute the rows that are missing, and print them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--contact", action="store_true")
    parser.add_argument("target", nargs="?", default="tests/benchmarks/chain_against_half.json")
    asked = parser.parse_args()
    path = Path(asked.target)
    rows = json.loads(path.read_text("utf-8"))["rows"] if path.is_file() else []
    done = {(row["design"], row["case"], row["contact"]) for row in rows}
    for design in designs():
        for case in CASES:
            key = {"design": design.name, "case": case.name, "contact": asked.contact}
            if tuple(key.values()) in done:
                continue
            pressure = {"pressure_mpa": design.load.pressure}
            rows.append(key | pressure | half_row(design, case, asked.contact))
            write_json({"rows": rows}, path)
            print(json.dumps(rows[-1]), flush=True)


if __name__ == "__main__":
    main()
