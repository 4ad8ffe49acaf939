"""Meshes of the cases: they fill their bodies, and their surfaces close."""

from __future__ import annotations

import numpy as np
import pytest
from meshes import cylinder_mesh, mapped_box, sphere_mesh, tube_mesh

from solver import Mesh, cavity_volume
from solver.mesh.elements import tetrahedron_rule, triangle_rule
from solver.mesh.mid_nodes import jacobian_ratios

BODIES = {
    "cylinder": (cylinder_mesh(5.0, 20.0, 3, 4), np.pi * 500, ("side", "z0", "z1")),
    "quarter of a disc": (
        cylinder_mesh(7.5, 0.5, 5, 1, np.pi / 2, 2),
        np.pi * 7.5**2 / 8,
        ("side", "start", "end", "z0", "z1"),
    ),
    "half of a tube": (
        tube_mesh(4.0, 5.0, 10.0, (1, 8, 2)),
        np.pi * 45,
        ("inside", "outside", "start", "end", "z0", "z1"),
    ),
    "octant of a sphere": (
        sphere_mesh(10.0, 12.0, 1, 5),
        np.pi / 6 * 728,
        ("inside", "outside", "x0", "y0", "z0"),
    ),
    "bar": (
        mapped_box((2, 1, 1), lambda cube: cube * [4.0, 1.0, 2.0], distortion=0.2),
        8.0,
        ("x0", "x1", "y0", "y1", "z0", "z1"),
    ),
}


@pytest.mark.parametrize(("mesh", "volume", "surfaces"), BODIES.values(), ids=BODIES)
def test_a_mesh_fills_its_body_and_its_surfaces_close(
    mesh: Mesh, volume: float, surfaces: tuple[str, ...]
) -> None:
    rule = tetrahedron_rule()
    tangents = np.einsum("qad,eai->eqdi", rule.gradients, mesh.nodes[mesh.tets])
    assert (np.linalg.det(tangents) * rule.weights).sum() == pytest.approx(volume, rel=1e-3)
    assert jacobian_ratios(mesh.nodes, mesh.tets).min() > 0.3
    assert sorted(mesh.surfaces) == sorted(surfaces)
    skin = mesh.nodes[mesh.triangles(*surfaces)]
    along = np.einsum("qad,tai->dtqi", triangle_rule().gradients, skin)
    area = np.einsum("q,tqi->i", triangle_rule().weights, np.cross(along[0], along[1]))
    assert area == pytest.approx(np.zeros(3), abs=1e-9 * volume)
    enclosed = -cavity_volume(mesh, np.zeros_like(mesh.nodes), surfaces)
    assert enclosed == pytest.approx(volume, rel=1e-3)


@pytest.mark.parametrize("name", ["side", "z0", "z1", "start", "end"])
def test_surfaces_of_a_wedge_are_where_their_names_say(name: str) -> None:
    mesh = cylinder_mesh(2.0, 3.0, 3, 2, np.pi / 3, 1)
    x, y, z = mesh.nodes[mesh.surface_nodes(name)].T
    off = {
        "side": np.hypot(x, y) - 2.0,
        "z0": z,
        "z1": z - 3.0,
        "start": y,
        "end": y - np.tan(np.pi / 3) * x,
    }[name]
    assert abs(off).max() < 1e-12 or (name == "side" and abs(off).max() < 1e-2)
