"""What meshes like the paper's read: uniform, with the crease rounded and sharp.

    python tests/benchmarks/paper_meshes.py [tests/benchmarks/paper_meshes.json]

The paper meshed with quadratic hybrid tetrahedra of 1 mm or less, about 50 000 of them, and does
not say how channel and chamber meet. Every design it computed is solved on the unit cell, on each
of ``MESHES``, once with the channel's edges rounded like the chamber's (as we build it) and once
with them left sharp (a chamber with fillets, and a plain channel cut through it). Where bubble and
tendon have walls of two thicknesses, two more have the floors of chamber and channel at one height,
the one or the other. Each row has three readings of the highest von Mises stress: averaged at the
nodes, in single elements at their nodes, and in single elements at their quadrature points;
``elements_of_actuator`` is how many tetrahedra the whole actuator would have, ends left out.

Rows are written as they come; those in the file are not computed again. About ten minutes.
"""

from __future__ import annotations

import itertools
import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.mesh_plan import PlannedMesh
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.files.json_files import write_json
from bellows_design.geometry import actuator
from bellows_design.geometry.face_names import BUBBLE_MIDDLE, CAVITY, SYMMETRY
from bellows_design.geometry.named_solids import NamedSolid, box, cut, fused, named, rounded_box
from bellows_design.store import Store, evaluated
from bellows_design.study.paper import TABLE_4
from solver import Solution, solve, transfer
from solver.mesh.elements import tetrahedron_rule
from solver.meshing.solid import MeshOptions
from solver.results.sharp_edges import trusted_nodes
from solver.results.stress import element_stress, von_mises

MESHES = {
    "1 mm": MeshOptions(1.0, 0.0, 0.25),
    "0.5 mm": MeshOptions(0.5, 0.0, 0.125),
    "fine fillets": MeshOptions(1.0, 12.0, 0.1),
}
"""Edges of one length; and at most 1 mm, with twelve on a full circle of every fillet."""

BESIDE = 1.0
"""mm. Farther than this from the channel's side, the floor of the chamber is beside the crease."""


def rounded(design: Design) -> NamedSolid:
    """The cell as it is built: chamber and channel both carry the inner fillet."""
    return actuator.unit_cell(design.bellows, design.indent)


def sharp(design: Design) -> NamedSolid:
    """The cell with a plain channel, which meets the rounded chamber in a sharp crease."""
    return cell(design, plain_channel(design), named(actuator._chamber(design.bellows), CAVITY))


def low_channel(design: Design) -> NamedSolid:
    """The cell with the channel's floor at the chamber's, which the bubble's wall decides."""
    chamber = named(actuator._chamber(design.bellows), CAVITY)
    return cell(design, channel(design, design.bellows.bubble_thickness), chamber)


def low_chamber(design: Design) -> NamedSolid:
    """The cell with the chamber's floor at the channel's, which the tendon's wall decides."""
    bellows = design.bellows
    length, width, height = bellows.chamber_size
    top, floor = bellows.bubble_thickness + height, bellows.tendon_thickness
    lower, upper = (-length / 2, -width / 2, floor), (length / 2, width / 2, top)
    chamber = named(rounded_box(lower, upper, bellows.chamber_fillet), CAVITY)
    return cell(design, channel(design, floor), chamber)


def channel(design: Design, floor: float) -> NamedSolid:
    """The channel, its edges rounded as usual, from a height ``floor``, mm."""
    bellows = design.bellows
    half, end, top = bellows.channel_width / 2, 2 * bellows.pitch, bellows.tendon_height
    upper = (end, half, top - bellows.tendon_thickness)
    return named(rounded_box((-end, -half, floor), upper, bellows.channel_fillet), CAVITY)


def plain_channel(design: Design) -> NamedSolid:
    """The channel with sharp edges."""
    bellows = design.bellows
    half, wall, end = bellows.channel_width / 2, bellows.tendon_thickness, 2 * bellows.pitch
    return named(box((-end, -half, wall), (end, half, bellows.tendon_height - wall)), CAVITY)


def cell(design: Design, *air: NamedSolid) -> NamedSolid:
    """The unit cell with other air in it."""
    bellows = design.bellows
    body = cut(actuator._cell_outside(bellows, design.indent), fused(*air))
    width, height, end = bellows.bubble_width, bellows.bubble_height, 2 * bellows.pitch
    other_half = box((-end, -width, -1), (end, 0, height + 1))
    before = box((-end, -width, -1), (0, width, height + 1))
    return cut(body, named(other_half, SYMMETRY), named(before, BUBBLE_MIDDLE))


CREASES: dict[str, Callable[[Design], NamedSolid]] = {
    "rounded": rounded,
    "sharp": sharp,
    "channel floor at the chamber's": low_channel,
    "chamber floor at the channel's": low_chamber,
}


def creases(design: Design) -> Iterator[str]:
    """Those that differ for a design: floors that are level already stay so."""
    level = design.bellows.bubble_thickness == design.bellows.tendon_thickness
    return (name for name in CREASES if not (level and "floor" in name))


@dataclass(frozen=True)
class Case:
    """One design on one mesh."""

    label: str
    crease: str
    mesh: str

    @property
    def key(self) -> tuple[str, str, str]:
        """What its row is known by."""
        return self.label, self.crease, self.mesh

    def row(self, known: Evaluation) -> dict[str, Any]:
        """Solve, from the ordinary evaluation's state, and read."""
        design = known.design
        solid = CREASES[self.crease](design)
        mesh = PlannedMesh(solid, MESHES[self.mesh]).made()
        problem, pressure = UNIT_CELL.problem(design, mesh), design.load.pressure
        found = solve(problem, pressure, initial=transfer(known.computation.finest, mesh))
        if not found.converged:
            found = solve(problem, pressure)
        bellows, count = design.bellows, design.bellows.bubble_count
        return {
            "design": self.label,
            "crease": self.crease,
            "mesh": self.mesh,
            "converged": found.converged,
            "elements": len(mesh.tets),
            "elements_of_actuator": 4 * count * len(mesh.tets),
            "angle_of_bubbles_deg": 2 * count * found.rotation,
            **readings(found, bellows),
        }


def readings(found: Solution, bellows: BellowsParameters) -> dict[str, Any]:
    """Highest von Mises stresses, MPa, and their places in the undeformed cell, mm.

    ``anywhere``: also at sharp outer edges, which we leave out, where bubbles stand on the tendon.
    ``beside_crease``: on the floor of the chamber and its fillet, beside the channel.
    """
    stress, counted = element_stress(found), trusted_nodes(found.problem)
    all_nodal = von_mises(stress.nodal)
    nodal = np.where(counted, all_nodal, 0.0)
    single = np.where(counted[stress.tets], von_mises(stress.raw), 0.0)
    inner = np.einsum("qv,evc->eqc", tetrahedron_rule().linear, stress.raw[:, :4])
    clear = counted[stress.tets].all(axis=1)
    beside = np.where(on_floor_beside(found, bellows), nodal, 0.0)
    return {
        "averaged_mpa": float(nodal.max()),
        "at_mm": place(found, int(nodal.argmax())),
        "anywhere_mpa": float(all_nodal.max()),
        "anywhere_at_mm": place(found, int(all_nodal.argmax())),
        "beside_crease_mpa": float(beside.max()),
        "beside_crease_at_mm": place(found, int(beside.argmax())),
        "single_elements_mpa": float(single.max()),
        "quadrature_points_mpa": float(von_mises(inner[clear]).max()),
    }


def on_floor_beside(found: Solution, bellows: BellowsParameters) -> NDArray[np.bool_]:
    """Which nodes are on the chamber's floor or its fillet, ``BESIDE`` the channel, (n,)."""
    mesh = found.problem.mesh
    inside = np.zeros(len(mesh.nodes), bool)
    inside[mesh.triangles(CAVITY)] = True
    low = mesh.nodes[:, 2] <= bellows.bubble_thickness + bellows.chamber_fillet + 1e-6
    return inside & low & (mesh.nodes[:, 1] > bellows.channel_width / 2 + BESIDE)


def place(found: Solution, node: int) -> list[float]:
    """Where a node is, mm."""
    return [round(float(x), 3) for x in found.problem.mesh.nodes[node]]


def main(target: str = "tests/benchmarks/paper_meshes.json") -> None:
    """Compute the rows that are missing, and print all."""
    path = Path(target)
    rows = json.loads(path.read_text("utf-8"))["rows"] if path.is_file() else []
    done = {(row["design"], row["crease"], row["mesh"]) for row in rows}
    for result in TABLE_4:
        pairs = itertools.product(creases(result.build()), MESHES)
        cases = [Case(result.label, *pair) for pair in pairs]
        missing = [case for case in cases if case.key not in done]
        known = evaluated(result.build(), store=Store.usual()) if missing else None
        for case in missing:
            assert known is not None
            rows.append({"paper_mpa": result.max_stress_mpa, **case.row(known)})
            print(json.dumps(rows[-1]), flush=True)
            write_json({"rows": rows}, path)


if __name__ == "__main__":
    main(*sys.argv[1:2])
