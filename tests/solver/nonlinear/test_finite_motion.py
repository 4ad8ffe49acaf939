"""Finite motions along an axis, and rotations past a whole turn."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from solver import Mesh, SlenderAxis, rotation
from solver.nonlinear.finite_motion import motion_along

BoxMesh = Callable[..., Mesh]
AXIS = SlenderAxis(tuple(np.linspace(0.0, 20.0, 11)))


def bar(box: BoxMesh) -> Mesh:
    return tipped(box((20, 1, 2), (20.0, 1.0, 2.0)))


def tipped(mesh: Mesh) -> Mesh:
    return Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, "tip": mesh.surfaces["x1"]})


def bent(nodes: NDArray[np.float64], degrees: float, middle: float = 1.0) -> NDArray[np.float64]:
    """Displacement of a bar bent to an arc of constant length at z = ``middle``, to -z."""
    curvature = np.radians(degrees) / 20.0
    angle, radius = curvature * nodes[:, 0], 1 / curvature + nodes[:, 2] - middle
    arc = np.stack([radius * np.sin(angle), nodes[:, 1], radius * np.cos(angle)], axis=1)
    return arc - [0, 0, 1 / curvature - middle] - nodes


@pytest.mark.parametrize("degrees", [5.0, 90.0, 179.0, 200.0, 350.0, 470.0, -30.0, -400.0])
def test_tip_rotation_counts_whole_turns_and_is_positive_towards_minus_z(
    box: BoxMesh, degrees: float
) -> None:
    mesh = bar(box)
    displacement = bent(mesh.nodes, degrees)
    assert rotation(mesh, displacement) == pytest.approx(degrees, abs=1e-9)
    if 0 < degrees < 170:
        assert displacement[mesh.surface_nodes("tip"), 2].mean() < 0


@pytest.mark.parametrize("degrees", [20.0, 170.0, 180.0, 200.0, 400.0, 1000.0])
def test_torsion_and_bending_about_other_axes_are_no_rotation_about_y(
    box: BoxMesh, degrees: float
) -> None:
    mesh = tipped(box((20, 2, 2), (10.0, 1.0, 1.0)))
    centred = mesh.nodes - [0.0, 0.5, 0.5]
    x, y, z = centred.T
    angle = np.radians(degrees) * x / 10
    twisted = np.stack([x, np.cos(angle) * y - np.sin(angle) * z,
                        np.sin(angle) * y + np.cos(angle) * z], 1)  # fmt: skip
    radius = 10 / np.radians(degrees)
    bent = np.stack([(radius - y) * np.sin(angle), radius - (radius - y) * np.cos(angle), z], 1)
    for moved in (twisted, bent):
        assert rotation(mesh, moved - centred) == pytest.approx(0.0, abs=1e-9)


def test_bending_goes_on_being_counted_where_the_body_is_twisted_as_well(box: BoxMesh) -> None:
    """Bent by 400 degrees about y, after a twist by 40 about its own axis."""
    mesh = tipped(box((40, 2, 2), (40.0, 1.0, 1.0)))
    centred = mesh.nodes - [0.0, 0.5, 0.5]
    x, y, z = centred.T
    twist, angle = np.radians(40) * x / 40, np.radians(400) * x / 40
    y, z = np.cos(twist) * y - np.sin(twist) * z, np.sin(twist) * y + np.cos(twist) * z
    radius = 40 / np.radians(400)
    moved = np.stack(
        [(radius + z) * np.sin(angle), y, (radius + z) * np.cos(angle) - radius], axis=1
    )
    assert rotation(mesh, moved - centred) == pytest.approx(400.0, abs=0.5)


@pytest.mark.parametrize("degrees", [50.0, 200.0, 400.0, -800.0])
def test_turns_are_counted_from_the_held_end_to_the_surface_wherever_it_lies(
    box: BoxMesh, degrees: float
) -> None:
    """The bar is held at either end; the rest rotates, the held end does not."""
    mesh = bar(box)
    moved = mesh.nodes + bent(mesh.nodes, degrees)
    assert rotation(mesh, moved - mesh.nodes, "x0") == pytest.approx(0.0, abs=1e-9)
    middle = [20.0, 0.5, 1.0]
    turn = Rotation.from_euler("y", -degrees, degrees=True).as_matrix()
    there = (moved - moved[mesh.surface_nodes("tip")].mean(axis=0)) @ turn.T + middle
    assert rotation(mesh, there - mesh.nodes, "tip") == pytest.approx(0.0, abs=1e-9)
    assert rotation(mesh, there - mesh.nodes, "x0") == pytest.approx(-degrees, abs=1e-9)


@pytest.mark.parametrize("degrees", [170.0, 200.0, 400.0])
def test_turns_are_counted_along_bodies_that_do_not_lie_along_x(
    box: BoxMesh, degrees: float
) -> None:
    """A bar along z bent about y, and one along y twisted about it."""
    upright, twisted = (box(np.roll((20, 2, 2), k), np.roll((20.0, 1, 1), k)) for k in (2, 1))
    x, y, z = upright.nodes.T
    angle, radius = np.radians(degrees) * z / 20, 20 / np.radians(degrees)
    arc = np.stack([radius - (radius - x) * np.cos(angle), y, (radius - x) * np.sin(angle)], 1)
    assert rotation(upright, arc - upright.nodes, "z1") == pytest.approx(degrees, abs=1e-9)
    x, y, z = twisted.nodes.T
    angle = np.radians(degrees) * y / 20
    turned = np.stack([np.cos(angle) * x + np.sin(angle) * z, y,
                       np.cos(angle) * z - np.sin(angle) * x], 1)  # fmt: skip
    assert rotation(twisted, turned - twisted.nodes, "y1") == pytest.approx(degrees, abs=1e-9)


def test_turns_are_counted_on_coarse_meshes_too(box: BoxMesh) -> None:
    mesh = tipped(box((2, 1, 1), (20.0, 1.0, 1.0)))
    for degrees in (200.0, 400.0, -600.0):
        assert rotation(mesh, bent(mesh.nodes, degrees)) == pytest.approx(degrees, abs=1e-9)


def test_rotation_without_the_surface_is_not_a_number(box: BoxMesh) -> None:
    mesh = box((1, 1, 1))
    assert np.isnan(rotation(mesh, np.zeros(mesh.nodes.shape)))
    empty = Mesh(mesh.nodes, mesh.tets, {"tip": mesh.surfaces["x0"][:0]})
    assert np.isnan(rotation(empty, np.zeros(mesh.nodes.shape)))


def test_a_small_increment_is_applied_as_it_stands(box: BoxMesh) -> None:
    mesh = bar(box)
    move, start = motion_along(mesh, AXIS), bent(mesh.nodes, 120.0)
    increment = np.random.default_rng(1).normal(size=mesh.nodes.shape)
    increment[mesh.nodes[:, 0] == 0] = 0.0
    errors = [abs(move(start, h * increment) - start - h * increment).max() for h in (1e-3, 1e-4)]
    assert errors[0] < 1e-2 * 1e-3
    assert errors[0] / errors[1] == pytest.approx(100, rel=0.1)  # second order


def test_a_linear_bending_increment_becomes_an_arc(box: BoxMesh) -> None:
    mesh = bar(box)
    slope = (bent(mesh.nodes, 0.001) - bent(mesh.nodes, -0.001)) / 0.002
    moved = motion_along(mesh, AXIS)(np.zeros(mesh.nodes.shape), 90.0 * slope)
    added = motion_along(mesh, None)(np.zeros(mesh.nodes.shape), 90.0 * slope)
    exact = bent(mesh.nodes, 90.0)
    assert rotation(mesh, moved) == pytest.approx(90.0, abs=1.0)
    assert abs(moved - exact).max() < 0.4
    assert abs(added - exact).max() > 7.0


def test_the_held_end_and_the_symmetry_plane_stay(box: BoxMesh) -> None:
    mesh = bar(box)
    slope = (bent(mesh.nodes, 0.001) - bent(mesh.nodes, -0.001)) / 0.002
    root = mesh.nodes[:, 0] == 0
    increment = np.where(root[:, None], 0.0, 60.0 * slope)
    moved = motion_along(mesh, AXIS)(np.zeros(mesh.nodes.shape), increment)
    assert abs(moved[root]).max() < 1e-13
    assert not moved[:, 1].any()
