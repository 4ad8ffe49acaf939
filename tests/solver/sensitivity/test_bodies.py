"""Derivatives against problems that are solved anew: bodies with every kind of load and support."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache

import numpy as np
import pytest
from _pytest.mark.structures import ParameterSet
from meshes import bellows_cell_mesh, bellows_mesh, box_mesh, renamed, tube_mesh
from numpy.typing import NDArray
from resolved import TIGHT, by_pressure, by_velocity

from solver import (
    AxialForce,
    BodyForce,
    Contact,
    Couple,
    EdgeForce,
    FoundationSpring,
    Membrane,
    Mesh,
    NodeSpring,
    Ogden,
    PointForce,
    Problem,
    RigidPlane,
    SlenderAxis,
    Solution,
    Supports,
    Traction,
    contact_forces,
    gradients,
    solve,
)
from solver.assembly.assembly import Assembly
from solver.material.mooney_rivlin import MooneyRivlin
from solver.nonlinear.finite_motion import turn_of

Array = NDArray[np.float64]
OGDEN = Ogden((0.2, 3.3), (3.05, -0.0054))
NEARLY = Ogden((1.0, 0.4), (2.0, -2.0), bulk_modulus=400.0, volumetric="logarithmic")
SOFT = Ogden.yeoh(0.5, 0.03, bulk_modulus=20.0)
RIVLIN = MooneyRivlin(0.4, 0.05, 0.02, 0.01, 0.0, bulk_modulus=50.0)


def cell(*loads: Couple | AxialForce) -> Solution:
    problem = Problem(
        bellows_cell_mesh(), OGDEN, Supports(symmetry={"x0": 0, "y0": 1}), ("cavity",),
        moving_plane="x1", loads=loads,
    )  # fmt: skip
    return solve(problem, 0.1, TIGHT)


def touching_cell() -> Solution:
    """Its walls touch the moving plane: a couple turns them into it."""
    mesh = bellows_cell_mesh()
    problem = Problem(
        mesh, SOFT, Supports(symmetry={"x0": 0, "y0": 1}), ("cavity",), moving_plane="x1",
        contacts=(Contact("outside", 0.05),), loads=(Couple(-1.5),),
    )  # fmt: skip
    return solve(problem, 0.08, TIGHT)


def actuator() -> Solution:
    problem = Problem(
        bellows_mesh(1), OGDEN, Supports(("root",), {"symmetry": 1}), ("cavity",),
        axis=SlenderAxis((0.0, 1.0, 2.0, 3.8, 4.8)),
    )  # fmt: skip
    return solve(problem, 0.1, TIGHT)


def loaded_bar() -> Solution:
    """Under tractions and body forces that depend on the place, on an elastic foundation."""
    mesh = renamed(box_mesh((4, 1, 2), (4.0, 1.0, 1.2)), {"x1": "tip"})
    loads = (
        Traction("z1", lambda x: np.stack([0.01 * x[:, 2], 0 * x[:, 1], 0.02 * x[:, 0] ** 2], 1)),
        Traction("tip", (0.1, 0.02, 0.05)),
        BodyForce(lambda x: np.stack([0.02 * x[:, 1], 0.01 * x[:, 0], 0 * x[:, 0]], 1)),
        PointForce((4.0, 0.0, 0.0), (0.01, 0.0, -0.02)),
        EdgeForce(("y0", "z1"), (0.0, 0.01, 0.02)),
    )
    springs = (FoundationSpring("z0", (0.02, 0.01, 0.05)), NodeSpring((4.0, 1.0, 0.0), (0, 0.1, 0)))
    return solve(Problem(mesh, RIVLIN, Supports(("x0",)), loads=loads, springs=springs), 0.0, TIGHT)


def led_bar() -> Solution:
    """Stretched and bent by a motion that depends on the place."""

    def motion(x: Array, load: float) -> Array:
        return load * np.stack([0.5 + 0.2 * x[:, 2], 0 * x[:, 0], -0.3 + 0 * x[:, 0]], 1)

    mesh = renamed(box_mesh((4, 1, 1), (3.0, 1.0, 1.0)), {"x1": "tip"})
    return solve(Problem(mesh, NEARLY, Supports(("x0",), prescribed={"tip": motion})), 0.0, TIGHT)


def twisted_bar() -> Solution:
    """Its end is turned far about x and some about y: its side's rotation is one in space."""

    def motion(x: Array, load: float) -> Array:
        a, b, across = 2.4 * load, 0.3 * load, x - [3.0, 0.5, 0.5]
        about_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
        about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
        return across @ (about_y @ about_x).T - across

    mesh = renamed(box_mesh((5, 1, 1), (4.0, 1.0, 1.0)), {"z1": "tip"})
    supports = Supports(("x0",), prescribed={"x1": motion})
    return solve(Problem(mesh, Ogden.neo_hooke(1.0, 30.0), supports), 0.0, TIGHT)


def pressed_block() -> Solution:
    """Under a rigid plane that comes down obliquely, and against a plane of symmetry."""
    mesh = renamed(box_mesh((2, 2, 3), (1.0, 1.1, 1.2)), {"x1": "tip"})
    plane = RigidPlane(
        "z1", 0.05, (0.1, 0.0, -1.0), (0.5, 0.5, 1.3), lambda load: (0, 0, -0.3 * load)
    )
    wall = Contact("tip", 0.02, 0, 1.03)
    problem = Problem(mesh, NEARLY, Supports(("z0",)), contacts=(plane, wall))
    return solve(problem, 0.0, TIGHT)


def free_rim() -> Solution:
    """A plate under pressure on one side, whose rim is free: the tangent is not symmetric."""
    mesh = renamed(box_mesh((4, 2, 1), (4.0, 1.5, 0.8)), {"x1": "tip"})
    return solve(Problem(mesh, SOFT, Supports(("x0",)), ("z0",)), 0.01, TIGHT)


def swollen_tube() -> Solution:
    mesh = tube_mesh(1.0, 1.5, 1.0, (2, 6, 1))
    symmetry = {"start": 1, "end": 1, "z0": 2, "z1": 2}
    supports = Supports(symmetry=symmetry, nodes={(1.5, 0.0, 0.0): 0})
    return solve(Problem(mesh, OGDEN, supports, ("inside",)), 0.3, TIGHT)


def tube_in_a_film() -> Solution:
    """The film's reference is curved; it bears about half of the pressure."""
    mesh = tube_mesh(1.0, 1.5, 1.0, (2, 6, 1))
    symmetry = {"start": 1, "end": 1, "z0": 2, "z1": 2}
    supports = Supports(symmetry=symmetry, nodes={(1.5, 0.0, 0.0): 0})
    film = Membrane("outside", 40.0, 0.3, 0.1)
    return solve(Problem(mesh, OGDEN, supports, ("inside",), membranes=(film,)), 0.6, TIGHT)


BODIES: dict[str, Callable[[], Solution]] = {
    "cell": cell,
    "cell with a couple": lambda: cell(Couple(-1.0)),
    "cell with an axial force": lambda: cell(Couple(0.3), AxialForce(0.5)),
    "cell that touches its image": touching_cell,
    "actuator": actuator,
    "bar under dead loads": loaded_bar,
    "bar that is led": led_bar,
    "bar that is twisted": twisted_bar,
    "block between planes": pressed_block,
    "plate with a free rim": free_rim,
    "tube": swollen_tube,
    "tube in a film": tube_in_a_film,
}


@cache
def solved(name: str) -> Solution:
    solution = BODIES[name]()
    assert solution.converged, solution.message
    return solution


def stretch(mesh: Mesh) -> Array:
    """An affine velocity that keeps planes of symmetry through the origin, and the tube's."""
    return mesh.nodes * [0.3, -0.2, 0.1]


def bump(mesh: Mesh) -> Array:
    """A smooth velocity that vanishes on the planes of the body's bounding box and at corners."""
    low, size = mesh.nodes.min(axis=0), np.ptp(mesh.nodes, axis=0)
    x, y, z = np.pi * ((mesh.nodes - low) / size).T
    return 0.2 * np.stack(
        [np.sin(x) * np.cos(2 * z), np.sin(y) * np.cos(x), np.sin(z) * np.cos(2 * x + y)], axis=1
    )


STEPS = {"block between planes": 1e-5}
"""Of differences: points that come into contact bend the responses over steps of 1e-3."""

FIXED_NODES = ("bar under dead loads", "tube", "tube in a film")
"""Bodies of which single nodes are loaded or held, which must keep their places."""

RELATIVE = {"rotation": 1e-6, "volume": 1e-6, "peak_stress": 1e-5}
"""Error of a derivative, of it or of a hundredth of the response per mm. States
solved to 1e-10 agree by differences of fourth order within 1e-8, those in contact within 5e-8."""

QUICK = ("cell", "bar under dead loads", "block between planes", "plate with a free rim")


def mostly_slow(names: Iterable[str], quick: Iterable[str] = QUICK) -> list[ParameterSet | str]:
    """All but the ``quick`` ones marked as slow."""
    return [name if name in quick else pytest.param(name, marks=pytest.mark.slow) for name in names]


def check_shape(name: str, velocity: Array) -> None:
    solution = solved(name)
    found = gradients(solution)
    expected = by_velocity(solution, found, velocity, STEPS.get(name, 1e-3))
    assert expected.keys() == found.responses.keys()
    for response, derivative in found.along(velocity).items():
        scale = max(abs(expected[response]), 0.01 * abs(found.responses[response].value))
        assert abs(derivative - expected[response]) <= RELATIVE[response] * scale, response


AT_ONCE = (*QUICK, "bar that is led", "tube", "tube in a film")


@pytest.mark.parametrize("name", mostly_slow(BODIES, AT_ONCE))
def test_shape_derivatives_are_those_of_problems_solved_anew(name: str) -> None:
    check_shape(name, bump(solved(name).problem.mesh))


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in BODIES if name not in FIXED_NODES])
def test_derivatives_by_lengths_are_those_of_problems_solved_anew(name: str) -> None:
    check_shape(name, stretch(solved(name).problem.mesh))


PRESSED = (
    "cell", "cell with a couple", "cell that touches its image", "actuator",
    "plate with a free rim", "tube", "tube in a film",
)  # fmt: skip


@pytest.mark.parametrize("name", mostly_slow(PRESSED, ("plate with a free rim",)))
def test_derivatives_by_the_pressure_are_those_of_other_pressures(name: str) -> None:
    solution = solved(name)
    found = gradients(solution)
    expected = by_pressure(solution, found, 1e-3 * solution.pressure)
    for response, gradient in found.responses.items():
        assert gradient.pressure == pytest.approx(expected[response], rel=RELATIVE[response])


@pytest.mark.parametrize("name", mostly_slow(["cell that touches its image", *QUICK[2:3]]))
def test_in_contact_every_plane_of_a_body_is_touched(name: str) -> None:
    """So that the tests above are about contact."""
    assert all(np.linalg.norm(each.force) > 0 for each in contact_forces(solved(name)))


def test_the_tangent_of_the_plate_with_a_free_rim_is_not_symmetric() -> None:
    assert not Assembly(solved("plate with a free rim").problem).symmetric


@pytest.mark.slow
def test_the_twisted_bar_is_turned_in_space() -> None:
    mesh, solution = solved("bar that is twisted").problem.mesh, solved("bar that is twisted")
    nodes = mesh.surface_nodes("tip")
    before, after = mesh.nodes[nodes], mesh.nodes[nodes] + solution.displacement[nodes]
    assert turn_of(before - before.mean(axis=0), after - after.mean(axis=0))[1]
