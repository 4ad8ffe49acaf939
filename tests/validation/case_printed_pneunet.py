"""A printed bending actuator of which too little is stated to validate anything."""

from __future__ import annotations

import json
import math
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from meshes import cell_mesh
from record import Case, Computed, Report, Results, Table

from bellows_design.materials import load_material
from solver import Contact, Mesh, Problem, Supports, solve

DATA: dict[str, Any] = json.loads(
    (Path(__file__).parent / "data" / "printed_pneunet.json").read_text(encoding="utf-8")
)
MATERIALS = ("ninjaflex", "ninjaflex_yeoh")
SHOWN = (20, 100, 200)
"""kPa."""
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
    pieces = [
        [0, bubble - walls["wall_mm"], bubble, DATA["pitch_mm"] / 2],
        [0, channel, DATA["half_chamber_mm"], DATA["half_width_mm"]],
        [0, floor, floor + channel, DATA["gap_bottom_mm"], 9.7, 14.0, roof, DATA["height_mm"]],
    ]
    solid = np.ones((3, 3, 7), int)
    solid[0, :2, 1:6] = 2  # the chamber
    solid[:, 0, 1] = 2  # the channel
    solid[2, :, 3:] = 0  # the gap
    lines = []
    for axis, at in enumerate(pieces):
        count = len(at) - 1
        lines.append(np.interp(np.linspace(0, count, finer * count + 1), range(count + 1), at))
        solid = np.repeat(solid, finer, axis=axis)
    return cell_mesh(solid, lines)


def bent(version: str, material: str, touching: bool, finer: int = 1) -> Computed:
    """The angle of six bubbles at all pressures, degrees."""
    mesh = cell(version, finer)
    problem = Problem(
        mesh,
        load_material(material).hyperelastic(),
        Supports(symmetry={"x0": 0, "y0": 1}),
        ("cavity",),
        moving_plane="x1",
        contacts=(Contact("outside", TOUCH),) if touching else (),
    )
    pressures = [1e-3 * pressure for pressure in DATA["pressures_kpa"]]
    last = solve(problem, pressures[-1], stops=pressures[:-1])
    assert last.converged, last.message
    angles = [2 * DATA["bubbles"] * point.rotation for point in (*last.at_stops, last)]
    return Computed({"angle_deg": angles}, len(mesh.tets), mesh.nodes.size + len(mesh.vertices))


def name(version: str, material: str, touching: bool = True) -> str:
    """Of a computation."""
    return f"{version}, {material}" + ("" if touching else ", walls pass each other")


FINER = "V1, ninjaflex_yeoh, cells halved"
READINGS = {
    name(version, material, touching): (version, material, touching)
    for version in DATA["versions"]
    for material in MATERIALS
    for touching in (True, False)
}


def report(results: Results) -> Report:
    """The section."""
    low, high = _range(results, -1)
    measured, theirs = DATA["measured_deg"], DATA["their_fem_deg"]
    coarse, fine = (
        results[key].readings["angle_deg"][-1] for key in (name("V1", "ninjaflex_yeoh"), FINER)
    )
    return Report(
        part=(
            "A finger of six bubbles printed of NinjaFlex, 17.2 mm wide and 19.6 mm high. "
            f"Source: {DATA['source']}."
        ),
        measured=(
            "An angle at 20, 40, … 200 kPa, of one print. Its authors' own finite elements give "
            f"{theirs[0] / measured[0]:.2f} times the measured angle at 20 kPa, "
            f"{theirs[4] / measured[4]:.2f} times at 100 and {theirs[-1] / measured[-1]:.2f} times "
            "at 200 kPa."
        ),
        posed=(
            "Six unit cells, of each of the three bodies in the repository (walls of 1.6 mm and "
            "twice 1.2, floors of 2 mm twice and 1.6), with a square channel of the same area; the "
            "paper's NinjaFlex and the one fitted to tests of printed dumbbells; bubbles that "
            "touch, and ones that pass through each other. Tangent at the tip, ends not modelled. "
            f"Halving the cells changes the angle at 200 kPa by {100 * (fine / coarse - 1):+.1f} %."
        ),
        rows=(),
        unknown=(
            "Which of the three bodies was measured; how the angle is defined (of a chord it is "
            "about half that of a tangent) and from which state; how the finger is clamped; the "
            "filament's batch, line width and infill; whether bubbles touched in their model."
        ),
        verdict=(
            "No validation: what is not stated leaves our angle at 200 kPa anywhere from "
            f"{low / 2:.0f}° (a chord's) to {high:.0f}°, and {measured[-1]}° were measured. "
            f"A tangent at the tip would have to turn by {low:.0f}° at least; so either the angle "
            "is a chord's, or the print is stiffer than every body and material here."
        ),
        tables=(_table(results),),
    )


def _range(results: Results, at: int) -> tuple[float, float]:
    """Least and largest angle of all readings of the experiment."""
    angles = [results[key].readings["angle_deg"][at] for key in READINGS]
    return min(angles), max(angles)


def _table(results: Results) -> Table:
    columns = [DATA["pressures_kpa"].index(pressure) for pressure in SHOWN]
    lines = [
        (key, *(f"{results[key].readings['angle_deg'][at]:.1f}" for at in columns))
        for key in READINGS
    ]
    lines.append(
        ("its authors' finite elements", *(f"{DATA['their_fem_deg'][k]:.1f}" for k in columns))
    )
    lines.append(("measured", *(f"{DATA['measured_deg'][at]:.0f}" for at in columns)))
    heading = ("degrees, tangent at the tip", *(f"{pressure} kPa" for pressure in SHOWN))
    return Table("What each reading of the experiment gives:", heading, tuple(lines))


CASE = Case(
    "E. A printed finger: nothing to claim",
    {
        **{key: partial(bent, *reading) for key, reading in READINGS.items()},
        FINER: partial(bent, "V1", "ninjaflex_yeoh", True, 2),
    },
    report,
    sample=name("V1", "ninjaflex_yeoh", False),
)
