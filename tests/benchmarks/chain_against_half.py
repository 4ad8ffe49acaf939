"""What a finger exerts: half of it as a body against the chain of half bubbles.

    python tests/benchmarks/chain_against_half.py [half | apart | chain | coarse | table]
        [--design NAME] [--target chain_against_half.json]

Four designs at their own pressure: Prototype 1, ``finger`` and two random ones whose numbers are
fixed; each free, under a dead force up and down at the tip, blocked by a load cell, and with its
tip held. ``half`` is half of the body, meshed as coarsely as carries the load, as the chain's cell
is; ``apart`` the same without contact of neighbouring bubbles, where rows say which walls run
through each other. ``coarse`` is the chain on a mesh like the half's, ``chain`` corrected by finer
ones. ``table`` prints how far the chain is from the half. All is that of the full width. Rows are
written as they come; those in the file are not computed again. Seconds to minutes for each, where
walls press against each other an hour.

The force at the tip is a traction that grows with height so that its resultant lies on the lower
edge: it has no singularity, and turns a rigid tip as a force on that edge does. The load cell holds
the nodes of the lower edge at their height. (Along a line a body has no stiffness: with finer and
finer meshes the edge would sink in by the logarithm of their size, here by some 0.01 mm per N.)
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import HALF
from bellows_design.analysis.wall_contact import contact_of
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.files.json_files import write_json
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import follow_loads, rest
from bellows_design.force.chain.surroundings import DeadForce, Hold, LoadPoint, Surroundings
from bellows_design.force.law.cell_law import CellLaw, cell_law
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

Row = dict[str, Any]
"""What one model says of one case."""

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
    problem = HALF.problem(design, mesh_of(design))
    if not contact:
        problem = replace(problem, contacts=())
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


def half_row(design: Design, case: Case, contact: bool = True) -> Row:
    """Solve for half of the finger, and read."""
    found = solve(problem_of(design, case, contact), design.load.pressure, OPTIONS)
    problem = found.problem
    walls = contact_of(design.bellows, problem.mesh, found.displacement, problem)
    return {
        "elements": len(problem.mesh.tets),
        "converged": found.converged,
        "message": found.message,
        "stable": found.stable,
        **readings(design, case, found),
        "walls_that_run_through_each_other": list(walls.where) if walls.void else [],
        "narrowest_gap_mm": walls.min_gap_mm,
        "seconds": found.seconds,
    }


def readings(design: Design, case: Case, found: Solution) -> Row:
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


@cache
def law_of(design: Design) -> CellLaw:
    """The law of a design's half bubbles."""
    return cell_law(design)


def chain_row(design: Design, case: Case, corrected: bool = True) -> Row:
    """Follow the chain as force and pressure grow together, as they do on the half; and read.

    Not ``corrected`` it is as stiff as the law's coarse mesh, about that of the half.
    """
    began = time.perf_counter()
    law, length = law_of(design), design.bellows.length
    pieces = [law.tabulated, law.root, law.tip]
    inner, root, tip = pieces if corrected else (replace(each, softening=1.0) for each in pieces)
    chain = Chain.of(design.bellows, inner, root=root, tip=tip)
    loaded, shares = LoadedChain.of(chain, _around(case, length)), np.linspace(0, 1, 6)[1:]
    points = [LoadPoint(share * design.load.pressure, forces=share) for share in shares]
    path = follow_loads(loaded, rest(loaded), points)
    state = path.last
    x, z, angle = state.tip
    row: Row = {
        "elements": len(law.mesh.tets),
        "converged": path.ending is None,
        "message": path.ending.sentence if path.ending else "",
        "stable": state.stable,
        "tip_x_mm": x,
        "tip_z_mm": z,
        "tip_angle_deg": float(np.degrees(angle)),
        "seconds": time.perf_counter() - began,
    }
    names = ("force_x_n", "force_z_n", "moment_n_mm") if case.edge or case.face else ()
    return row | dict(zip(names, state.held_force, strict=False))


def _around(case: Case, length: float) -> Surroundings:
    """What acts on the chain's tip."""
    if case.face:
        return Surroundings(hold=Hold(length, 0.0, 0.0))
    if case.edge:
        return Surroundings(hold=Hold(z=0.0))
    force = DeadForce(length, (0.0, case.force))
    return Surroundings(dead_forces=(force,) if case.force else ())


MODELS: dict[str, Callable[[Design, Case], Row]] = {
    "half": half_row,
    "apart": partial(half_row, contact=False),
    "chain": chain_row,
    "coarse": partial(chain_row, corrected=False),
}


HEADING = (
    "| design | case | half | chain, same mesh | off by | chain, corrected | s: half, chain |",
    "|---|---|---|---|---|---|---|",
)


def table(rows: list[Row]) -> str:
    """How far the chain is from the half, as Markdown: with contact where the half was solved."""
    known = {(row["design"], row["case"], row["model"]): row for row in rows}
    asked = dict.fromkeys((design, case) for design, case, _ in known)
    return "\n".join((*HEADING, *(_line(known, *each) for each in asked)))


def _line(known: dict[tuple[str, str, str], Row], design: str, case: str) -> str:
    model = "half" if (design, case, "half") in known else "apart"
    found = [known.get((design, case, name)) for name in (model, "coarse", "chain")]
    free = [known.get((design, "free", name)) for name in (model, "coarse", "chain")]
    half, coarse, chain = (_said(*each) for each in zip(found, free, strict=True))
    number = [_number(*each) for each in zip(found[:2], free[:2], strict=True)]
    alike = model == "half" and None not in number
    off = f"{100 * (number[1] / number[0] - 1):+.1f} %" if alike else ""
    seconds = ", ".join("" if row is None else f"{row['seconds']:.3g}" for row in found[::2])
    half += " (no contact)" * (model == "apart" and bool(half))
    return f"| {design} | {case} | {half} | {coarse} | {off} | {chain} | {seconds} |"


def _number(row: Row | None, free: Row | None) -> float | None:
    """What is compared: angle, deflection by the force, force along z, or along x."""
    if row is None or free is None or not row["converged"]:
        return None
    if row["case"] == "free":
        return float(row["tip_angle_deg"])
    names = {"load cell": "force_z_n", "held tip": "force_x_n"}
    if row["case"] in names:
        return float(row[names[row["case"]]])
    return float(row["tip_z_mm"] - free["tip_z_mm"])


def _said(row: Row | None, free: Row | None) -> str:
    """What counts in a row."""
    if row is None or free is None:
        return ""
    if not row["converged"]:
        return str(row["message"])
    x, z, angle = row["tip_x_mm"], row["tip_z_mm"], row["tip_angle_deg"]
    if row["case"] == "free":
        return f"{angle:.1f}° at ({x:.1f}, {z:.1f}) mm"
    if row["case"] == "load cell":
        return f"{row['force_z_n']:.3f} N, x = {x:.1f} mm, {angle:.1f}°"
    if row["case"] == "held tip":
        return f"{row['force_x_n']:.2f} N, {row['moment_n_mm']:.1f} N mm"
    return f"{z - free['tip_z_mm']:+.2f} mm"


def main() -> None:
    """Compute the rows that are missing, and print them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("model", choices=(*MODELS, "table"))
    parser.add_argument("--design", default="")
    parser.add_argument("--target", default="tests/benchmarks/chain_against_half.json")
    asked = parser.parse_args()
    path = Path(asked.target)
    rows = json.loads(path.read_text("utf-8"))["rows"] if path.is_file() else []
    if asked.model == "table":
        print(table(rows))
        return
    done = {(row["design"], row["case"]) for row in rows if row["model"] == asked.model}
    chosen = (each for each in designs() if asked.design in ("", each.name))
    for design, case in ((design, case) for design in chosen for case in CASES):
        if (design.name, case.name) not in done:
            key = {"design": design.name, "case": case.name, "model": asked.model}
            pressure = {"pressure_mpa": design.load.pressure}
            rows.append(key | pressure | MODELS[asked.model](design, case))
            write_json({"rows": rows}, path)
            print(json.dumps(rows[-1]), flush=True)


if __name__ == "__main__":
    main()
