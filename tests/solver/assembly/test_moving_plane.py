"""A section that stays plane: its equations, and what it says about a chain of cells."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array

from solver import (
    AxialForce,
    Couple,
    Mesh,
    Ogden,
    PointForce,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    nodal_von_mises,
    reaction,
    solve,
)
from solver.assembly.assembly import Assembly
from solver.assembly.pressure import enclosed_volume
from solver.assembly.state import State

Array = NDArray[np.float64]
Meshes = Callable[..., Mesh]
MIDDLES = Supports(symmetry={"x0": 0, "y0": 1})
TIGHT = SolverOptions(tolerance=1e-10, maximum_iterations=40)
PRESSURE = 0.7
"""MPa. As much as the rubber's modulus, so that the load's share of the tangent shows."""


def of(mesh: Mesh, material: Ogden) -> Problem:
    """A cell between symmetry planes and a moving plane."""
    return Problem(mesh, material, MIDDLES, ("cavity",), moving_plane="x1")


def bent_state(assembly: Assembly) -> State:
    """A stretched state, its plane turned and shifted, everything free moved at random."""
    mesh, (tilt, shift) = assembly.problem.mesh, (0.5, 0.3)
    x, _, z = mesh.nodes.T
    share = x / x.max()
    displacement = np.stack(
        [shift * share + z * np.sin(tilt * share), 0 * x, z * (np.cos(tilt * share) - 1)], axis=1
    )
    random = np.random.default_rng(5)
    smooth = State(displacement, np.zeros(len(mesh.vertices)), np.array([tilt, shift]))
    return moved(assembly, smooth, random.uniform(-0.03, 0.03, assembly.numbering.size))


def moved(assembly: Assembly, state: State, vector: Array) -> State:
    """The state after a change of all unknowns, exactly."""
    change = State(*assembly.numbering.expand(vector))
    added = State(
        state.displacement + change.displacement,
        state.hydrostatic_pressure + change.hydrostatic_pressure,
    )
    assert assembly.plane is not None
    return assembly.plane.finite(state, change, added)


def slope(function: Callable[[float], Array | float], h: float = 1e-4) -> Array | float:
    """Derivative at zero by central differences of fourth order."""
    near, far = function(h) - function(-h), function(2 * h) - function(-2 * h)
    return (8 * near - far) / (12 * h)


def action(assembly: Assembly, values: Array, vector: Array) -> Array:
    """The tangent's upper triangle and its mirror image times a vector."""
    pattern, size = assembly.pattern, assembly.numbering.size
    upper = csr_array((values, pattern.indices, pattern.indptr), shape=(size, size))
    return upper @ vector + upper.T @ vector - upper.diagonal() * vector


def directions(assembly: Assembly) -> dict[str, Array]:
    """Unit changes of tilt, shift and of one height on the plane, and changes at random."""
    numbering, mesh = assembly.numbering, assembly.problem.mesh
    unit = np.eye(numbering.size)
    highest = mesh.surface_nodes("x1")[mesh.nodes[mesh.surface_nodes("x1"), 2].argmax()]
    random = np.random.default_rng(6).normal(size=(3, numbering.size))
    return {
        "tilt": unit[numbering.plane[0]],
        "shift": unit[numbering.plane[1]],
        "height": unit[numbering.displacement[highest, 2]],
        **{f"random {number}": row for number, row in enumerate(random)},
    }


def test_tangent_is_the_derivative_of_the_residual_in_every_direction(
    cell: Mesh, ninjaflex: Ogden
) -> None:
    assembly = Assembly(of(cell, ninjaflex))
    state = bent_state(assembly)
    equilibrium = assembly.evaluate(state, PRESSURE)
    assert equilibrium.admissible and equilibrium.smallest_jacobian < 0.9
    for name, direction in directions(assembly).items():

        def residual(step: float, direction: Array = direction) -> Array:
            there = moved(assembly, state, step * direction)
            return assembly.evaluate(there, PRESSURE, tangent=False).residual

        numerical = slope(residual)
        error = action(assembly, equilibrium.tangent, direction) - numerical
        assert abs(error).max() <= 1e-8 * abs(numerical).max(), name


def test_a_bent_state_is_in_the_plane(cell: Mesh, ninjaflex: Ogden) -> None:
    assembly = Assembly(of(cell, ninjaflex))
    state = bent_state(assembly)
    tilt, shift = state.plane
    x, _, z = (cell.nodes + state.displacement)[cell.surface_nodes("x1")].T
    across = (x - cell.nodes[:, 0].max() - shift) * np.cos(tilt) - z * np.sin(tilt)
    assert abs(across).max() < 1e-14
    heights = assembly.plane.heights(state)[cell.surface_nodes("x1")]  # type: ignore[union-attr]
    far = np.hypot(x - cell.nodes[:, 0].max() - shift, z)
    assert abs(heights) == pytest.approx(far, abs=1e-14)


def test_residual_is_the_gradient_of_energy_less_pressure_times_volume(
    cell: Mesh, ninjaflex: Ogden
) -> None:
    """So the pressure on the opening, which has no mesh, is there: as force and as moment."""
    assembly = Assembly(of(cell, ninjaflex))
    state = bent_state(assembly)
    residual = assembly.evaluate(state, PRESSURE, tangent=False).residual
    for name, direction in directions(assembly).items():

        def potential(step: float, direction: Array = direction) -> float:
            there = moved(assembly, state, step * direction)
            volume = enclosed_volume(cell, there.displacement, ("cavity",))
            return assembly.energy(there) - PRESSURE * volume

        assert slope(potential, 1e-3 if "random" not in name else 1e-4) == pytest.approx(
            residual @ direction, rel=1e-7
        ), name


def test_a_turn_and_a_shift_of_the_plane_are_felt_as_force_and_moment_on_the_opening(
    cell: Mesh, ninjaflex: Ogden
) -> None:
    """At rest: 3.4 mm x 1 mm of opening, its middle 1.1 mm above the tendon's bottom."""
    assembly = Assembly(of(cell, ninjaflex))
    force = assembly.evaluate(State.zero(assembly.problem), 1.0, tangent=False).force
    tilt, shift = force[assembly.numbering.plane]
    assert shift == pytest.approx(-3.4 * 1.0, rel=1e-12)
    assert tilt == pytest.approx(-3.4 * 1.0 * 1.1, rel=1e-12)


def test_a_cell_and_its_mirrored_double_bend_alike(
    cell: Mesh, doubled: Callable[[Mesh], Mesh], ninjaflex: Ogden
) -> None:
    """In the double the plane is a bubble's middle, whose opening is the chamber's section."""
    one, two = (solve(of(mesh, ninjaflex), 0.1, TIGHT) for mesh in (cell, doubled(cell)))
    assert one.converged and two.converged, (one.message, two.message)
    assert one.rotation > 3
    assert two.rotation == pytest.approx(2 * one.rotation, rel=1e-6)
    assert two.path[-1].volume == pytest.approx(2 * one.path[-1].volume, rel=1e-6)
    assert two.path[-1].max_von_mises == pytest.approx(one.path[-1].max_von_mises, rel=1e-3)
    inner = np.setdiff1d(np.arange(len(cell.nodes)), cell.surface_nodes("x1"))
    assert nodal_von_mises(two)[inner] == pytest.approx(nodal_von_mises(one)[inner], abs=1e-6)


@pytest.mark.slow
def test_one_more_bubble_adds_two_cells_to_an_actuator(
    cells: Meshes, cell: Mesh, ninjaflex: Ogden
) -> None:
    """Root clamped, tip closed: with four bubbles between them the ends have all but died out."""
    few, more = (solve(actuator(cells, ninjaflex, count), 0.02) for count in (4, 5))
    one = solve(of(cell, ninjaflex), 0.02)
    assert few.converged and more.converged and one.converged
    assert more.rotation - few.rotation == pytest.approx(2 * one.rotation, rel=0.03)
    volumes = [solution.path[-1].volume for solution in (few, more)]
    assert volumes[1] - volumes[0] == pytest.approx(2 * one.path[-1].volume, rel=0.01)


def actuator(cells: Meshes, material: Ogden, bubbles: int) -> Problem:
    """Half of an actuator of the cell's bubbles, closed at both ends."""
    end, gap, wall, chamber = np.zeros((4, 2, 6), int)
    for section in (end, gap, wall, chamber):
        section[:, :3] = 1
    gap[0, 1] = wall[0, 1] = 2  # the channel
    wall[:, 3:] = chamber[:, 3:] = 1
    chamber[0, 1:5] = 2
    sections = [end, *(bubbles * [gap, wall, chamber, chamber, wall, gap]), end]
    lengths = [1.0, *(bubbles * [0.4, 0.6, 0.4, 0.4, 0.6, 0.4]), 1.0]
    across = ([3.4, 0.6], [0.6, 1.0, 0.6, 2.0, 2.0, 0.6])
    lines = [np.cumsum([0.0, *sizes]) for sizes in (lengths, *across)]
    mesh = cells(np.stack(sections), lines)
    named = Mesh(mesh.nodes, mesh.tets, {**mesh.surfaces, "tip": mesh.surfaces["x1"]})
    supports = Supports(clamped=("x0",), symmetry={"y0": 1})
    return Problem(named, material, supports, ("cavity",))


def tube(cells: Meshes, walls: tuple[float, float]) -> Mesh:
    """Half of a square tube of 3 mm length with a bore of 2 mm x 1 mm, from z = 0 to the top."""
    section = np.ones((2, 3), int)
    section[0, 1] = 2
    lines = [[0.0, 1.0, 3.0], [0.0, 1.0, 1.5], np.cumsum([0.0, walls[0], 1.0, walls[1]])]
    return cells(np.stack([section, section]), [np.array(line) for line in lines])


def moments(walls: tuple[float, float]) -> tuple[Array, Array]:
    """0th to 2nd moments in z of half of the tube's wall and of half of its bore, mm^2 to mm^4."""
    heights = np.cumsum([0.0, walls[0], 1.0, walls[1]])
    powers = np.arange(1, 4)
    bore = 1.0 * (heights[2] ** powers - heights[1] ** powers) / powers
    return 1.5 * heights[3] ** powers / powers - bore, bore


@pytest.mark.parametrize("walls", [(0.5, 0.5), (0.4, 1.1)], ids=["even", "uneven"])
def test_a_closed_tube_stretches_and_bends_as_elasticity_says(
    cells: Meshes, walls: tuple[float, float]
) -> None:
    """Small loads: the wall carries p A_bore, at the bore's middle, and p on its inside.

    By the virial theorem sum and first moment of the strain along x over the section are those of
    p / (3 K) over the bore, whatever the section's shape; quadratic elements keep that exactly.
    """
    bulk, pressure, length = 4.0, 1e-6, 3.0
    material = Ogden((1.0,), (2.0,), bulk_modulus=bulk)
    solution = solve(of(tube(cells, walls), material), pressure, SolverOptions(1.0, tolerance=1e-9))
    wall, bore = moments(walls)
    matrix = np.array([[wall[0], wall[1]], [wall[1], wall[2]]])
    shift, tilt = np.linalg.solve(matrix, pressure * length / (3 * bulk) * bore[:2])
    assert solution.converged
    assert solution.plane[1] == pytest.approx(shift, rel=1e-4)
    assert solution.plane[0] == pytest.approx(tilt, rel=1e-4, abs=1e-4 * shift)
    assert shift > 0 and (abs(tilt) < 1e-12 * shift) == (walls[0] == walls[1])


def test_a_closed_tube_of_incompressible_rubber_keeps_its_length(cells: Meshes) -> None:
    """The closed form of a thick-walled cylinder with ends, for Poisson's ratio 1/2."""
    mesh, pressure = tube(cells, (0.4, 1.1)), 1e-6
    solution = solve(of(mesh, Ogden((1.0,), (2.0,))), pressure, SolverOptions(1.0, tolerance=1e-9))
    sideways = abs(solution.displacement[:, 1:]).max()
    assert solution.converged and sideways > pressure
    assert abs(np.array(solution.plane)).max() < 1e-4 * sideways


@pytest.fixture(scope="module")
def bent(cell: Mesh, ninjaflex: Ogden) -> Solution:
    return solve(of(cell, ninjaflex), 0.1, TIGHT)


def test_where_the_cell_lies_does_not_matter(cell: Mesh, bent: Solution, ninjaflex: Ogden) -> None:
    lifted = Mesh(cell.nodes + np.array([0, 0, 3.0]), cell.tets, cell.surfaces)
    solution = solve(of(lifted, ninjaflex), 0.1, TIGHT)
    tilt, shift = bent.plane
    assert solution.plane[0] == pytest.approx(tilt, abs=1e-8)
    assert solution.plane[1] == pytest.approx(shift - 3 * np.sin(tilt), abs=1e-7)
    assert nodal_von_mises(solution) == pytest.approx(nodal_von_mises(bent), abs=1e-8)


def test_the_pin_takes_no_force(cell: Mesh, bent: Solution, ninjaflex: Ogden) -> None:
    """Pinned at its top instead, by turning the cell upside down, it bends as far the other way."""
    z = cell.nodes[:, 2].max() - cell.nodes[:, 2]
    nodes = np.column_stack([cell.nodes[:, :2], z])
    tets = cell.tets[:, [1, 0, 2, 3, 4, 6, 5, 9, 8, 7]]
    surfaces = {name: rows[:, [0, 2, 1, 5, 4, 3]] for name, rows in cell.surfaces.items()}
    solution = solve(of(Mesh(nodes, tets, surfaces), ninjaflex), 0.1, TIGHT)
    assert solution.rotation == pytest.approx(-bent.rotation, abs=1e-7)
    assert nodal_von_mises(solution) == pytest.approx(nodal_von_mises(bent), abs=1e-7)


def test_a_restart_finds_tilt_and_shift_in_the_displacement(bent: Solution) -> None:
    start = (bent.displacement, bent.hydrostatic_pressure)
    again = solve(bent.problem, 0.1, initial=start)
    assert again.converged and again.newton_iterations == 1
    assert again.plane == pytest.approx(bent.plane, abs=1e-6)
    slid = (bent.displacement + np.array([0.0, 0.0, 0.3]), bent.hydrostatic_pressure)
    back = solve(bent.problem, 0.1, TIGHT, initial=slid)
    assert back.converged and back.refused_steps == 0
    assert back.displacement == pytest.approx(bent.displacement, abs=1e-6)


def test_the_path_reports_the_planes_tilt_in_degrees(bent: Solution) -> None:
    assert bent.rotation == pytest.approx(np.degrees(bent.plane[0]), abs=1e-12)
    rotations = [point.rotation for point in bent.path]
    volumes = [point.volume for point in bent.path]
    assert rotations[0] == 0 and (np.diff(rotations) > 0).all()
    assert volumes[0] == pytest.approx(3.4 * (1.4 * 1.0 + 0.4 * 4.6), rel=1e-9)
    assert (np.diff(volumes) > 0).all()


@pytest.mark.parametrize(
    ("surface", "words"),
    [
        ("gap", "no surface is called 'gap'; known surfaces: cavity"),
        ("cavity", "the moving plane 'cavity' must be a plane normal to x; .* spread over 1.4 mm"),
        ("z0", "the moving plane 'z0' must be a plane normal to x; .* spread over 1.4 mm"),
    ],
)
def test_what_is_no_plane_normal_to_x_cannot_move_as_one(
    cell: Mesh, ninjaflex: Ogden, surface: str, words: str
) -> None:
    with pytest.raises(ValueError, match=words) as refusal:
        Problem(cell, ninjaflex, MIDDLES, ("cavity",), moving_plane=surface)
    assert str(refusal.value).count("\n") == 0


@pytest.mark.parametrize(
    ("symmetry", "motion"),
    [({"y0": 1}, "free to move"), ({"x0": 0}, "free to move")],
)
def test_a_moving_plane_alone_holds_no_body(
    cell: Mesh, ninjaflex: Ogden, symmetry: dict[str, int], motion: str
) -> None:
    with pytest.raises(ValueError, match=motion):
        Problem(cell, ninjaflex, Supports(symmetry=symmetry), ("cavity",), moving_plane="x1")


def rolled(mesh: Mesh, moment: float) -> Solution:
    """A block in plane strain under a couple on its end, neo-Hookean with mu = 1 MPa."""
    supports = Supports(symmetry={"x0": 0, "y0": 1, "y1": 1})
    loads = (Couple(moment),)
    problem = Problem(mesh, Ogden((1.0,), (2.0,)), supports, loads=loads, moving_plane="x1")
    return solve(problem, options=TIGHT)


@pytest.mark.parametrize(
    ("thickness", "degrees", "moment"), [(2.0, 90.0, 0.207909366754), (5.0, 180.0, 5.62233079441)]
)
def test_a_couple_rolls_a_block_into_the_sector_of_rivlin(
    box: Meshes, thickness: float, degrees: float, moment: float
) -> None:
    # 20 mm long blocks turn by so much under the moment per mm of depth (Rivlin's closed form)
    solution = rolled(box((1, 1, 8), (1.0, 1.0, thickness)), moment)
    assert solution.converged, solution.message
    assert solution.rotation == pytest.approx(degrees / 20.0, rel=2e-3)
    root = reaction(solution, "x0")
    assert root.moment[1] == pytest.approx(-moment, rel=1e-8)
    assert root.force[0] == pytest.approx(0.0, abs=1e-8)


def test_opposite_couples_roll_to_mirror_images(box: Meshes) -> None:
    mesh = box((2, 1, 4), (1.0, 1.0, 2.0))
    there, back = rolled(mesh, 0.2), rolled(mesh, -0.2)
    assert back.rotation == pytest.approx(-there.rotation, rel=1e-3)


def test_couples_and_other_loads_are_refused_where_they_cannot_act(
    box: Meshes, ninjaflex: Ogden
) -> None:
    mesh, push = box((1, 1, 1)), PointForce((1.0, 1.0, 1.0), (0.0, 0.0, 1.0))
    with pytest.raises(ValueError, match="a couple or an axial force needs a moving plane"):
        Problem(mesh, ninjaflex, Supports(clamped=("x0",)), loads=(Couple(1.0),))
    with pytest.raises(ValueError, match="pressure only, besides couples"):
        Problem(mesh, ninjaflex, MIDDLES, loads=(push,), moving_plane="x1")
    for bad, words in ((Couple(np.nan), "moment must be a f"), (AxialForce(np.inf), "force must")):
        problem = Problem(mesh, ninjaflex, MIDDLES, loads=(bad,), moving_plane="x1")
        with pytest.raises(ValueError, match=words):
            solve(problem)
