"""A printed bending actuator of which too little is stated to validate anything."""

from __future__ import annotations

import json
import math
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from meshes import cell_mesh
from record import Case, Computed, Interval, Report, Results, Row, Table

from bellows_design.materials import load_material
from solver import Contact, Mesh, Problem, Supports, solve

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "printed_pneunet.json").read_text(encoding="utf-8")
)
MATERIALS = ("ninjaflex", "ninjaflex_yeoh")
SHOWN = (40, 100, 200)
TOUCH = 0.05
"""mm: how deep a contact pressure of the shear modulus pushes a wall through the plane between."""


def cell(version: str, finer: int = 1) -> Mesh:
    """Half of half a bubble: x from the chamber's middle to the gap's, y from the middle plane.

    The channel's half disk is a square of the same area. ``finer``: cells in each of the pieces.
    """
    walls = DATA["versions"][version]
    bubble = (DATA["pitch_mm"] - DATA["gap_mm"]) / 2
    channel = DATA["channel_radius_mm"] * math.sqrt(math.pi) / 2
    floor, roof = walls["floor_mm"], DATA["height_mm"] - DATA["roof_mm"]
    lines = [
        [0, bubble - walls["wall_mm"], bubble, DATA["pitch_mm"] / 2],
        [0, channel, DATA["half_chamber_mm"], DATA["half_width_mm"]],
        [0, floor, floor + channel, DATA["gap_bottom_mm"], 9.7, 14.0, roof, DATA["height_mm"]],
    ]
    solid = np.ones((3, 3, 7), int)
    solid[0, :2, 1:6] = 2  # the chamber
    solid[:, 0, 1] = 2  # the channel
    solid[2, :, 3:] = 0  # the gap
    fine = [np.interp(np.arange(0, len(at) - 1 + 1e-9, 1 / finer), range(len(at)), at) for at in lines]
    for axis in range(3):
        solid = np.repeat(solid, finer, axis=axis)
    return cell_mesh(solid, fine)


def bent(version: str, material: str, touching: bool, finer: int = 1) -> Computed:
    """The angle of six bubbles at all pressures, degrees."""
    mesh = cell(version, finer)
    law = load_material(material).hyperelastic()
    contacts = (Contact("outside", TOUCH),) if touching else ()
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    problem = Problem(
        mesh, law, supports, ("cavity",), moving_plane="x1", contacts=contacts
    )
    pressures = [1e-3 * p for p in DATA["pressures_kpa"]]
    last = solve(problem, pressures[-1], stops=pressures[:-1])
    assert last.converged, last.message
    angles = [2 * DATA["bubbles"] * point.rotation for point in (*last.at_stops, last)]
    return Computed({"angle_deg": angles}, len(mesh.tets), mesh.nodes.size + len(mesh.vertices))


def name(version: str, material: str, touching: bool = True) -> str:
    return f"{version}, {material}" + ("" if touching else ", walls do not touch")
