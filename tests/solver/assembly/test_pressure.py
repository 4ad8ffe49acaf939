"""Follower pressure: forces, tangent, enclosed volume."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array

from solver import Mesh, Ogden, Problem, Supports, cavity_volume
from solver.assembly.assembly import Assembly
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State

ALL = ("x0", "x1", "y0", "y1", "z0", "z1")
BoxMesh = Callable[..., Mesh]


def deformed(assembly: Assembly, size: float = 0.1) -> State:
    """A random, rotated state that keeps the supports."""
    mesh = assembly.problem.mesh
    random = np.random.default_rng(11).uniform(-size, size, mesh.nodes.shape)
    turn = 0.4 * np.cross([0.0, 1.0, 0.0], mesh.nodes)
    free = assembly.numbering.displacement >= 0
    return State(np.where(free, random + turn, 0.0), np.zeros(len(mesh.vertices)))


def half_cavity(box: BoxMesh, ninjaflex: Ogden) -> Assembly:
    """A surface closed but for the symmetry plane y0 and the clamped face x0."""
    supports = Supports(clamped=("x0",), symmetry={"y0": 1})
    mesh = box((2, 2, 1), (1.0, 1.2, 0.8))
    return Assembly(Problem(mesh, ninjaflex, supports, ("x1", "y1", "z0", "z1")))


def load_stiffness(assembly: Assembly, state: State) -> NDArray[np.float64]:
    """The part of the tangent due to a unit pressure, as a dense matrix."""
    size = assembly.numbering.size
    loaded, free = (assembly.evaluate(state, p).tangent for p in (1.0, 0.0))
    pattern = assembly.pattern
    upper = csr_array((loaded - free, pattern.indices, pattern.indptr), shape=(size, size))
    dense = upper.toarray()
    return dense + np.triu(dense, 1).T


def test_tangent_is_the_derivative_of_the_force_on_a_cut_cavity(
    box: BoxMesh, ninjaflex: Ogden
) -> None:
    assembly = half_cavity(box, ninjaflex)
    state = deformed(assembly)

    def force(vector: NDArray[np.float64]) -> NDArray[np.float64]:
        du, _, _ = assembly.numbering.expand(vector)
        moved = State(state.displacement + du, state.hydrostatic_pressure)
        return assembly.evaluate(moved, 1.0, tangent=False).force

    step = 1e-3  # the force is quadratic in the displacement: central differences are exact
    numerical = np.array([force(e) - force(-e) for e in step * np.eye(assembly.numbering.size)])
    numerical /= 2 * step
    assert abs(numerical - numerical.T).max() <= 1e-11 * abs(numerical).max()
    stiffness = load_stiffness(assembly, state)
    assert abs(stiffness - numerical).max() <= 1e-11 * abs(numerical).max()


def test_force_is_minus_the_gradient_of_the_enclosed_volume(box: BoxMesh, ninjaflex: Ogden) -> None:
    assembly = half_cavity(box, ninjaflex)
    state, mesh = deformed(assembly), assembly.problem.mesh
    force = assembly.evaluate(state, 1.0, tangent=False).force
    vector = np.random.default_rng(2).normal(size=len(force))
    du, _, _ = assembly.numbering.expand(vector)
    step = 1e-3

    def volume(share: float) -> float:
        return cavity_volume(mesh, state.displacement + share * step * du, ALL)

    slope = (8 * (volume(1) - volume(-1)) - volume(2) + volume(-2)) / (12 * step)
    # y0 and x0 do not move along their normals, so they add nothing to the change
    assert slope == pytest.approx(-force @ vector, rel=1e-9)


def test_pressure_on_a_closed_surface_has_no_resultant(box: BoxMesh, ninjaflex: Ogden) -> None:
    mesh = box((2, 1, 1))
    problem = Problem(mesh, ninjaflex, Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), ALL)
    assembly = Assembly(problem)
    x = mesh.nodes + np.random.default_rng(4).uniform(-0.1, 0.1, mesh.nodes.shape)
    facets = assembly._facets._replace(
        dofs=np.arange(x.size, dtype=np.int32).reshape(-1, 3)[mesh.triangles(*ALL)].reshape(-1, 18)
    )
    from solver.kernels.pressure import assemble_pressure

    force = np.zeros(x.size)
    assemble_pressure(facets, x - mesh.nodes, 1.0, False, force, np.zeros(0))
    forces = force.reshape(-1, 3)
    assert forces.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-14)
    assert np.cross(x, forces).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-14)


def test_volume_inside_a_sphere_is_that_of_the_sphere(sphere: Callable[..., Mesh]) -> None:
    mesh = sphere(10.0, 12.0, 1, 8)
    volume = cavity_volume(mesh, np.zeros(mesh.nodes.shape), ("inside",))
    assert volume == pytest.approx(np.pi * 10**3 / 6, rel=1e-4)
    stretched = cavity_volume(mesh, mesh.nodes * [0.5, 0.0, -0.25], ("inside",))
    assert stretched == pytest.approx(1.5 * 0.75 * volume, rel=1e-13)


def hollow(cells: BoxMesh) -> Mesh:
    """A box with a closed cavity of 0.5 mm x 0.7 mm x 1.1 mm."""
    block = np.ones((3, 3, 3), int)
    block[1, 1, 1] = 2
    return cells(block, [np.cumsum([0.0, 0.3, inner, 0.4]) for inner in (0.5, 0.7, 1.1)])


def turned(nodes: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    """Displacement of a rotation about the y axis."""
    sine, cosine = np.sin(angle), np.cos(angle)
    rotation = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    return nodes @ rotation.T - nodes


def test_volume_of_a_box_shaped_cavity_is_its_edges_product(cells: BoxMesh) -> None:
    mesh = hollow(cells)
    assert enclosed_volume(mesh, 0 * mesh.nodes, ("cavity",)) == pytest.approx(0.5 * 0.7 * 1.1)
    solid = enclosed_volume(mesh, 0 * mesh.nodes, ALL)  # normals point out of the body: inside out
    assert solid == pytest.approx(-1.2 * 1.4 * 1.8)


def test_a_surface_named_twice_encloses_its_volume_once(cells: BoxMesh) -> None:
    mesh = cells(np.ones((1, 1, 1), int), [np.array([1.0, 2.0])] * 3)
    still, names = np.zeros(mesh.nodes.shape), tuple(mesh.surfaces)
    assert cavity_volume(mesh, still, (*names, *names)) == pytest.approx(-1.0, rel=1e-12)
    assert f"{cavity_volume(mesh, still, ('x0',))}" == "0.0"


@pytest.mark.parametrize("angle", [0.3, np.pi, 7.0])
def test_volume_is_the_same_wherever_the_body_is_moved(cells: BoxMesh, angle: float) -> None:
    mesh = hollow(cells)
    random = np.random.default_rng(8).uniform(-0.05, 0.05, mesh.nodes.shape)
    before = enclosed_volume(mesh, random, ("cavity",))
    moved = random + turned(mesh.nodes + random, angle) + [3.0, -2.0, 11.0]
    assert enclosed_volume(mesh, moved, ("cavity",)) == pytest.approx(before, rel=1e-12)
    assert before != pytest.approx(0.5 * 0.7 * 1.1, rel=1e-3)


def test_volume_of_an_open_cell_ignores_how_its_cuts_are_turned(cell: Mesh) -> None:
    """Cut at y = 0 and, normal to x, through the channel; both may turn about y together."""
    random = np.random.default_rng(8).uniform(-0.05, 0.05, cell.nodes.shape)
    random[cell.surface_nodes("y0"), 1] = 0.0
    for cut in ("x0", "x1"):
        random[cell.surface_nodes(cut), 0] = 0.0
    before = enclosed_volume(cell, random, ("cavity",))
    moved = random + turned(cell.nodes + random, 1.2) + [3.0, 0.0, 11.0]
    assert enclosed_volume(cell, moved, ("cavity",)) == pytest.approx(before, rel=1e-12)


def test_a_cell_bent_to_a_ring_holds_what_pappus_says(cell: Mesh) -> None:
    """Every bit of the cavity's section moves as far as its height makes it."""
    x, _, z = cell.nodes.T
    radius = 1e4
    ring = np.stack([(z + radius) * np.sin(x / radius), (z + radius) * np.cos(x / radius)], axis=1)
    bent = np.stack([ring[:, 0] - x, 0 * x, ring[:, 1] - radius - z], axis=1)
    channel, chamber = 1.4 * 1.0, 0.4 * 4.6  # sections at y = 0; their middles at z = 1.1 and 3.9
    volume = enclosed_volume(cell, 0 * bent, ("cavity",))
    assert volume == pytest.approx(3.4 * (channel + chamber), rel=1e-12)
    grown = enclosed_volume(cell, bent, ("cavity",)) - volume
    assert grown == pytest.approx(3.4 * (1.1 * channel + 3.9 * chamber) / radius, rel=1e-6)
