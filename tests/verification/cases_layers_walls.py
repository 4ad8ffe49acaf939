"""Layered walls: tubes and spheres of two materials under pressure."""

from __future__ import annotations

import numpy as np
from case import Case, Order, Outcome, Row
from layered_walls import Wall, lame_displacements, mean_stress_in_tube
from layers import SOFT, STIFF, TIGHT, region_pressure
from measures import Points, observed_order
from meshes import sphere_mesh, tube_mesh
from structures import along, converged

from solver import Membrane, Mesh, Ogden, Problem, Solution, Supports, solve
from solver.mesh.elements import triangle_rule

INNER, BETWEEN, OUTER = RADII = (1.0, 1.5, 2.0)
"""Of the cavity, the interface and the outside, mm; the outer layer is the stiff one."""

WALL = Wall(RADII, (SOFT, STIFF))
RUBBERS = Ogden.neo_hooke(SOFT), Ogden.neo_hooke(STIFF)
STRETCHES = (1.05, 1.2, 1.5)
"""Of the cavity's radius."""


def radius(at: Points, dimensions: int = 2) -> Points:
    """Distances (k,) of places (k, 3) from the axis, or from the centre."""
    return np.asarray(np.linalg.norm(at[:, :dimensions], axis=1))


def layered(mesh: Mesh, dimensions: int = 2) -> Mesh:
    """The mesh with the region ``stiff`` outside of the interface."""
    radii = radius(mesh.nodes, dimensions)[mesh.tets[:, :4]].mean(axis=1)
    return mesh.with_regions({"stiff": np.flatnonzero(radii > BETWEEN)})


def quarter(layers: int) -> Mesh:
    """A quarter of a slice of a tube, with so many elements across each of its two layers."""
    return layered(tube_mesh(INNER, OUTER, 0.3, (2 * layers, 3 * layers, 1), np.pi / 2))


def tube(mesh: Mesh, soft: Ogden, stiff: Ogden, membranes: tuple[Membrane, ...] = ()) -> Problem:
    """Plane strain under pressure inside."""
    supports = Supports(symmetry={"start": 1, "end": 0, "z0": 2, "z1": 2})
    materials = {"stiff": stiff}
    return Problem(mesh, soft, supports, ("inside",), materials=materials, membranes=membranes)


def stretch_of(mesh: Mesh, displacement: Points, dimensions: int = 2) -> float:
    """Growth of the cavity's radius, by its section's area or by its volume."""
    before, after = (
        enclosed(mesh, at, dimensions) for at in (mesh.nodes, mesh.nodes + displacement)
    )
    return float((after / before) ** (1 / dimensions))


def enclosed(mesh: Mesh, nodes: Points, dimensions: int) -> float:
    """Volume within the surface ``inside``, or the slice's length times its section, mm³."""
    rule, corners = triangle_rule(), nodes[mesh.triangles("inside")]
    points = np.einsum("qa,kai->kqi", rule.quadratic, corners)[..., :dimensions]
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, corners)
    normals = np.cross(*tangents)[..., :dimensions]
    return float(-np.einsum("q,kqi,kqi->", rule.weights, points, normals)) / dimensions


def pressed_tube() -> Outcome:
    """Stretches under the pressures that belong to them, and the jump of the pressure."""
    mesh = quarter(4)
    problem = tube(mesh, *RUBBERS)
    pressures = [sum(WALL.tube_drops(stretch)) for stretch in STRETCHES]
    solution = converged(solve(problem, pressures[-1], TIGHT, stops=pressures[:-1]))
    states = [stop.displacement for stop in (*solution.at_stops, solution)]
    rows = [
        Row(f"stretch at {p:.4g} MPa", s, stretch_of(mesh, state), 1e-5, digits=5)
        for s, p, state in zip(STRETCHES, pressures, states, strict=True)
    ]
    errors = [abs(stretch_under(quarter(n), pressures[1]) - STRETCHES[1]) for n in COUNTS]
    order = Order("the stretch", observed_order(COUNTS, errors), 3.5, "4")
    mesh_text = f"quarter of {len(mesh.tets)} tetrahedra; order on {len(COUNTS)} meshes"
    return Outcome((*rows, *at_interface(solution)), (order,), mesh_text)


COUNTS = (1, 2, 4)


def stretch_under(mesh: Mesh, pressure: float) -> float:
    """Stretch of the cavity under a pressure, MPa."""
    return stretch_of(mesh, along(tube(mesh, *RUBBERS), (pressure,), TIGHT)[0])


def at_interface(solution: Solution) -> list[Row]:
    """Hydrostatic pressures on both sides of the interface at the last stretch."""
    found = region_pressure(solution, lambda at: np.isclose(radius(at), BETWEEN))
    drops, grown = WALL.tube_drops(STRETCHES[-1]), (STRETCHES[-1] ** 2 - 1) * INNER**2
    around = float(np.sqrt(BETWEEN**2 + grown) / BETWEEN)
    return [
        Row(
            f"pressure at the interface, {name or 'soft'} side",
            -mean_stress_in_tube(modulus, around, -drops[1]),
            found[name],
            5e-3,
            "MPa",
            digits=3,
        )
        for modulus, name in ((SOFT, ""), (STIFF, "stiff"))
    ]


LAYERS = ((SOFT, 2.0), (STIFF, 60.0))
"""Shear and bulk moduli, MPa, of compressible layers."""


def lame() -> Outcome:
    """Displacements of the three faces under a small pressure."""
    mesh, pressure = quarter(4), 1e-5
    soft, stiff = (Ogden.neo_hooke(*layer) for layer in LAYERS)
    (displacement,) = along(tube(mesh, soft, stiff), (pressure,), TIGHT)
    exact = lame_displacements(RADII, LAYERS, pressure, 0.0) / pressure
    rows = faces(mesh, displacement / pressure, exact)
    return Outcome(rows, mesh=f"quarter of {len(mesh.tets)} tetrahedra")


def faces(mesh: Mesh, displacement: Points, exact: Points) -> tuple[Row, ...]:
    """Radial displacements of the inside, the middle and the outside, per pressure."""
    ours = [
        float(displacement[np.isclose(radius(mesh.nodes), r) & (mesh.nodes[:, 1] == 0), 0].mean())
        for r in RADII
    ]
    return tuple(
        Row(f"displacement {name} per pressure", float(e), o, 5e-4, "mm/MPa")
        for name, e, o in zip(("inside", "in the middle", "outside"), exact, ours, strict=True)
    )


FILM = Membrane("outside", 300.0, 0.4, 0.02)


def filmed() -> Outcome:
    """The soft tube in a film that hardly bends but does not stretch, at small and large strain."""
    mesh, band = quarter(4), FILM.stiffness / (1 - FILM.poisson_ratio**2)
    wall, pressures = Wall((INNER, OUTER), (SOFT,)), []
    for stretch in STRETCHES:
        around = np.sqrt(OUTER**2 + (stretch**2 - 1) * INNER**2) / OUTER
        pressures.append(wall.tube_drops(stretch)[0] + band * (around**2 - 1) / 2 / OUTER)
    states = along(tube(mesh, RUBBERS[0], RUBBERS[0], (FILM,)), pressures, TIGHT)
    rows = [
        Row(f"stretch at {p:.4g} MPa", s, stretch_of(mesh, state), 1e-5, digits=5)
        for s, p, state in zip(STRETCHES, pressures, states, strict=True)
    ]
    small, soft = 1e-5, Ogden.neo_hooke(*LAYERS[0])
    (displacement,) = along(tube(mesh, soft, soft, (FILM,)), (small,), TIGHT)
    exact = lame_displacements(RADII, (LAYERS[0], LAYERS[0]), small, band) / small
    rows += faces(mesh, displacement / small, exact)
    return Outcome(tuple(rows), mesh=f"quarter of {len(mesh.tets)} tetrahedra")


def sphere() -> Outcome:
    """Stretches of a spherical shell of two layers."""
    mesh = layered(sphere_mesh(INNER, OUTER, 4, 4), 3)
    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
    materials = {"stiff": RUBBERS[1]}
    problem = Problem(mesh, RUBBERS[0], supports, ("inside",), materials=materials)
    pressures = [WALL.sphere_pressure(stretch) for stretch in STRETCHES[:2]]
    states = along(problem, pressures, TIGHT)
    rows = (
        Row(f"stretch at {p:.4g} MPa", s, stretch_of(mesh, state, 3), 2e-4)
        for s, p, state in zip(STRETCHES, pressures, states, strict=False)
    )
    return Outcome(tuple(rows), mesh=f"octant of {len(mesh.tets)} tetrahedra")


CASES = (
    Case(
        "L3 Tube of two rubbers under pressure",
        "An incompressible tube in plane strain, its outer half 20 times as stiff as the inner: "
        "stretch of the cavity up to 1.5, and the hydrostatic pressure on both sides of the "
        "interface, where it jumps.",
        "The pressure is the integral of (σ_θ − σ_r) / r over both layers. Status: integrated "
        "numerically.",
        pressed_tube,
    ),
    Case(
        "L3 Tube of two elastic layers",
        "The same tube of compressible layers under a small pressure.",
        "Lamé's u = A r + B / r in each layer. Status: closed form.",
        lame,
    ),
    Case(
        "L3 Tube in a film",
        "A soft tube in plane strain with a membrane of E t = 6 N/mm on its outside, which presses "
        "on it with E t / (1 − ν²) (λ² − 1) / 2 R; at small strain besides Lamé's tube.",
        "Equilibrium of the film: hoop force over radius. Status: integrated numerically, closed "
        "form at small strain.",
        filmed,
    ),
    Case(
        "L3 Sphere of two rubbers under pressure",
        "A hollow sphere of the same layers.",
        "The pressure is the integral of 2 (σ_θ − σ_r) / r over both layers. Status: integrated "
        "numerically.",
        sphere,
    ),
)
