"""Reactions: component by component, and where two supports share a node."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from solver import (
    FoundationSpring,
    Mesh,
    Ogden,
    Problem,
    RigidPlane,
    Supports,
    Traction,
    reaction,
    solve,
)
from solver.arrays import Reals
from solver.nonlinear.options import SolverOptions

BoxMesh = Callable[..., Mesh]
TIGHT = SolverOptions(tolerance=1e-9, maximum_iterations=30)
SHEAR, SIZE = 0.4, (1.5, 1.0, 1.2)


def sheared(positions: Reals, load: float) -> Reals:
    nothing = 0 * positions[:, 1]
    return load * np.stack([SHEAR * positions[:, 1], nothing, nothing], axis=1)


def test_faces_of_a_sheared_block_share_all_edges_and_each_bears_its_own_stress(
    box: BoxMesh,
) -> None:
    """Simple shear of a neo-Hookean block, J = 1: P = mu dev(F F^T) F^-T on every face."""
    mesh = box((3, 2, 2), SIZE, distortion=0.2)
    led = {name: sheared for name in ("x0", "x1", "y1", "z0", "z1")}
    supports = Supports(symmetry={"y0": (0, 1)}, prescribed=led)
    solution = solve(Problem(mesh, Ogden.neo_hooke(1.0, 50.0), supports), 0.0, TIGHT)
    gradient = np.eye(3)
    gradient[0, 1] = SHEAR
    left = gradient @ gradient.T
    piola = (left - np.trace(left) / 3 * np.eye(3)) @ np.linalg.inv(gradient).T
    total = np.zeros(3)
    for axis, name in enumerate("xyz"):
        for side, outward in (("0", -1), ("1", 1)):
            found = reaction(solution, name + side)
            area = np.prod(SIZE) / SIZE[axis]
            assert found.force == pytest.approx(outward * area * piola[:, axis], abs=1e-8)
            assert found.by_traction == (
                (True, True, False) if name + side == "y0" else (True,) * 3
            )
            total += found.force
    assert total == pytest.approx(0.0, abs=1e-9)


def test_a_clamp_beside_a_plane_of_symmetry_leaves_the_plane_its_own_force(
    box: BoxMesh,
) -> None:
    """Half of a pulled bar. Both hold y at the edge that they share; together they balance."""
    mesh = box((12, 2, 4), (6.0, 0.5, 1.0))
    supports = Supports(clamped=("x0",), symmetry={"y0": 1})
    pull = (Traction("x1", (0.3, 0.0, 0.01)),)
    solution = solve(Problem(mesh, Ogden.neo_hooke(1.0), supports, loads=pull), 0.0, TIGHT)
    clamp, plane = reaction(solution, "x0"), reaction(solution, "y0")
    assert clamp.by_traction == plane.by_traction == (False, True, False)
    assert clamp.force + plane.force == pytest.approx([-0.15, 0.0, -0.005], abs=1e-9)
    assert plane.force[[0, 2]] == pytest.approx(0.0, abs=0.0)
    assert clamp.force[1] == pytest.approx(0.0420, rel=0.05)  # on meshes of half and quarter size


def test_the_moment_of_a_plane_of_symmetry_is_that_of_its_own_forces(box: BoxMesh) -> None:
    """A bar pulled between three planes: forces on each act in its middle."""
    mesh = box((3, 2, 2), SIZE)
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    solution = solve(Problem(mesh, Ogden.neo_hooke(1.0), supports, ("x1",)), -0.5, TIGHT)
    found = reaction(solution, "x0")
    corner = solution.displacement[np.linalg.norm(mesh.nodes - SIZE, axis=1).argmin()]
    middle = (np.array(SIZE) + corner)[1:] / 2
    force = -0.5 * 4 * middle[0] * middle[1]  # the follower pressure's, on the deformed face
    assert found.force == pytest.approx([force, 0, 0], rel=1e-7, abs=1e-9)
    assert found.moment == pytest.approx(
        [0, force * middle[1], -force * middle[0]], rel=1e-7, abs=1e-9
    )
    assert found.by_traction == (False, False, False)


def test_a_surface_without_support_has_the_reactions_at_its_nodes(box: BoxMesh) -> None:
    mesh = box((2, 2, 2))
    part = Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, "same": mesh.surfaces["x0"]})
    problem = Problem(part, Ogden.neo_hooke(1.0), Supports(clamped=("x0",)), ("x1",))
    solution = solve(problem, -0.1, TIGHT)
    assert np.array_equal(reaction(solution, "same").force, reaction(solution, "x0").force)
    assert reaction(solution, "x1").force == pytest.approx(0.0, abs=0.0)


def test_pressure_and_traction_on_a_held_surface_are_no_part_of_its_reaction(
    box: BoxMesh,
) -> None:
    """Two clamped faces that share an edge, one of them loaded: nothing moves and nothing deforms.

    What is held bears what acts on it.
    """
    mesh = box((2, 2, 2))
    supports = Supports(clamped=("x0", "y0"))
    loads = (Traction("y0", (0.2, 0.1, 0.0)),)
    problem = Problem(mesh, Ogden.neo_hooke(1.0), supports, ("x0",), loads)
    solution = solve(problem, 0.3, TIGHT)
    assert not solution.displacement.any()
    assert reaction(solution, "x0").force == pytest.approx([-0.3, 0, 0], abs=1e-9)
    assert reaction(solution, "y0").force == pytest.approx([-0.2, -0.1, 0], abs=1e-9)


def test_springs_and_planes_on_a_held_surface_are_no_part_of_its_neighbour_s_reaction(
    box: BoxMesh,
) -> None:
    """Two faces that share an edge lead the body without deforming it: only one is resisted."""
    mesh, way = box((2, 2, 2)), np.array([0.1, -0.05, -0.08])

    def led(positions: Reals, load: float) -> Reals:
        return np.broadcast_to(load * way, positions.shape)

    supports = Supports(prescribed={"x0": led, "y0": led})
    springs = (FoundationSpring("y0", (2.0, 3.0, 4.0)),)
    sprung = Problem(mesh, Ogden.neo_hooke(1.0, 50.0), supports, springs=springs)
    plane = RigidPlane("y0", 0.1, (0, 1, 0), (0, 0, 0))
    pressed = Problem(mesh, Ogden.neo_hooke(1.0, 50.0), supports, contacts=(plane,))
    for problem, force in ((sprung, way * [2, 3, 4]), (pressed, np.array([0, -0.45, 0]))):
        solution = solve(problem, 0.0, TIGHT)
        assert reaction(solution, "x0").force == pytest.approx(0.0, abs=1e-9)
        assert reaction(solution, "y0").force == pytest.approx(force, abs=1e-9)
