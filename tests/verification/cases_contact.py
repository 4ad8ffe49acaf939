"""Contact with rigid planes, with a rigid cylinder, and of two surfaces that both deform."""

from __future__ import annotations

from functools import cache

import numpy as np
from case import Case, Order, Outcome, Row
from measures import Points, observed_order
from meshes import box_mesh, mapped_box, renamed
from scipy.optimize import brentq

from solver import (
    ContactForce,
    Mesh,
    Ogden,
    Problem,
    RigidCylinder,
    RigidPlane,
    SolverOptions,
    Supports,
    SurfaceContact,
    contact_forces,
    reaction,
    solve,
)

RUBBER = Ogden.neo_hooke(1.0)
RADIUS = 10.0
"""Of the ball, mm."""

PLANES = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2})
DIVISIONS = 8
LIFT = 0.01
"""mm, of the plate before it moves: curved triangles reach a little beyond the sphere."""


def ball(divisions: int) -> Mesh:
    """An eighth of a ball, finer towards the pole on z; surfaces x0, y0, z0, outside."""
    even = np.linspace(0.0, 1.0, divisions + 1)

    def finer_at_zero(x: Points) -> Points:
        return np.interp(x, even, even**2)  # linear within a cell: mid-nodes stay in the middle

    def place(cube: Points) -> Points:
        c = np.column_stack([finer_at_zero(cube[:, :2]), 1 - finer_at_zero(1 - cube[:, 2])])
        largest, length = np.abs(c).max(axis=1), np.linalg.norm(c, axis=1)
        return RADIUS * c * (largest / np.where(length > 0, length, 1.0))[:, None]

    outside = dict.fromkeys(("x1", "y1", "z1"), "outside")
    return renamed(mapped_box(3 * (divisions,), place), outside)


def approach(force: float) -> float:
    """How far a plate comes to the middle of a ball pressed between two by ``force`` (N), mm.

    Hertz's pressure, as a series of zonal harmonics, on a ball that keeps its volume: a radial
    stress s P_n moves the surface by n (2 n + 1) / (2 (n - 1) (2 n^2 + 4 n + 3)) s R / mu.
    """
    n = np.arange(2.0, 4e5, 2.0)
    x = (n + 0.5) * np.cbrt(3 * force * RADIUS / 16) / RADIUS
    spread = 3 * (np.sin(x) - x * np.cos(x)) / x**3
    compliance = n * (2 * n + 1) / (2 * (n - 1) * (2 * n**2 + 4 * n + 3))
    return float(force / (2 * np.pi * RADIUS) * ((2 * n + 1) * compliance * spread).sum())


@cache
def pressed(distance: float) -> tuple[ContactForce, int]:
    """The ball under plates that each came closer by ``distance`` (mm), and its tetrahedra."""

    def motion(load: float) -> tuple[float, float, float]:
        return 0.0, 0.0, -load * (distance + LIFT)

    mesh = ball(DIVISIONS)
    plate = RigidPlane("outside", 0.01 * distance, (0, 0, -1), (0, 0, RADIUS + LIFT), motion)
    problem = Problem(mesh, RUBBER, PLANES, contacts=(plate,))
    solution = solve(problem, options=SolverOptions(tolerance=1e-8))
    assert solution.converged, solution.message
    return contact_forces(solution)[0], len(mesh.tets)


def hertz() -> Outcome:
    """Force over approach, and the greatest pressure over the force."""
    rows: tuple[Row, ...] = ()
    for distance in (0.4, 0.1):
        contact, count = pressed(distance)
        force, label = -4 * contact.force[2], f"plates {distance:g} mm closer"
        first = 16 / 3 * np.sqrt(RADIUS * distance**3)
        second = brentq(lambda f, d=distance: approach(f) - d, first / 2, 2 * first)
        peak = np.cbrt(96 * force / np.pi**3 / RADIUS**2)
        rows += (
            Row(f"{label}: force, Hertz", first, force, 0.1, "N", digits=2),
            Row(f"{label}: force, finite ball", second, force, 0.03, "N", digits=2),
            Row(f"{label}: peak pressure", peak, contact.peak_pressure, 0.05, "MPa", digits=2),
        )
    contact, count = pressed(0.4)
    radius = np.cbrt(-12 * contact.force[2] * RADIUS / 16)
    ours = np.sqrt(4 * contact.area / np.pi)
    rows += (Row("plates 0.4 mm closer: contact radius", radius, ours, 0.05, "mm", digits=2),)
    return Outcome(rows, mesh=f"an eighth of a ball, {count} tetrahedra")


def block() -> Outcome:
    """Force, pressure and reaction under the stretch reached; the order in the penetration."""
    rows, errors, depths = [], [], (1e-2, 1e-3, 1e-4)
    for depth in depths:
        plate = RigidPlane("z1", depth, (0, 0, -1), (0, 0, 1.1), lambda load: (0, 0, -0.6 * load))
        problem = Problem(box_mesh((2, 2, 2)), RUBBER, PLANES, contacts=(plate,))
        solution = solve(problem, options=SolverOptions(tolerance=1e-9))
        (contact,) = contact_forces(solution)
        errors.append(abs(-contact.force[2] / (0.5**-2 - 0.5) - 1))
    stretch = 1 + float(solution.displacement[:, 2].min())
    borne = stretch**-2 - stretch
    rows = [
        Row("force at the stretch reached", borne, -contact.force[2], 1e-8, "N"),
        Row("reaction of the lower plate", borne, reaction(solution, "z0").force[2], 1e-7, "N"),
        Row("pressure", borne * stretch, contact.peak_pressure, 1e-8, "MPa"),
        Row("area in contact", 1 / stretch, contact.area, 1e-8, "mm²"),
        Row("force at half the height", 0.5**-2 - 0.5, -contact.force[2], 2e-3, "N"),
    ]
    order = observed_order([1 / depth for depth in depths], errors)
    orders = (Order("force over the penetration asked for", order, 0.9, "1"),)
    return Outcome(tuple(rows), orders, "unit cube of 48 tetrahedra")


DEPTH, BREADTH, CROWN = 8.0, 0.5, 10.0
"""Of the blocks in line contact, mm: edge, breadth, and radius of the cylinder."""


def in_line_contact(divisions: int, curved: bool) -> Mesh:
    """Half of a block in plane strain below z = 0, or above it with a ``curved`` bottom.

    Finer where they touch.
    """
    even = np.linspace(0.0, 1.0, divisions + 1)

    def place(cube: Points) -> Points:
        x, up = (DEPTH * np.interp(cube[:, axis], even, even**2) for axis in (0, 2))
        if curved:
            return np.column_stack([x, BREADTH * cube[:, 1], up + x**2 / (2 * CROWN)])
        down = DEPTH * (1 - np.interp(1 - cube[:, 2], even, even**2))
        return np.column_stack([x, BREADTH * cube[:, 1], down - DEPTH])

    return mapped_box((divisions, 1, divisions), place)


def planes_of(name: str) -> dict[str, int]:
    """Symmetry of a block, and plane strain."""
    return {f"{name}x0": 0, f"{name}y0": 1, f"{name}y1": 1}


@cache
def under_a_rigid_cylinder(divisions: int) -> ContactForce:
    """The block with a rigid cylinder led 0.1 mm into it."""
    mesh = in_line_contact(divisions, curved=False)
    cylinder = RigidCylinder(
        "z1", 1e-3, (0, 0, CROWN + LIFT), (0, 1, 0), CROWN, lambda load: (0, 0, -0.11 * load)
    )
    supports = Supports(("z0",), symmetry=planes_of(""))
    solution = solve(
        Problem(mesh, RUBBER, supports, contacts=(cylinder,)), options=SolverOptions(tolerance=1e-8)
    )
    assert solution.converged, solution.message
    return contact_forces(solution)[0]


@cache
def between_two_bodies(divisions: int) -> tuple[ContactForce, float]:
    """The block under a curved one, both soft, 0.2 mm nearer; what holds the block, N."""
    lower, upper = in_line_contact(divisions, False), in_line_contact(divisions * 3 // 2, True)
    count = len(lower.nodes)
    surfaces = dict(lower.surfaces) | {f"u{n}": t + count for n, t in upper.surfaces.items()}
    nodes = np.concatenate([lower.nodes, upper.nodes + np.array([0, 0, LIFT])])
    mesh = Mesh(nodes, np.concatenate([lower.tets, upper.tets + count]), surfaces)

    def led(positions: Points, load: float) -> Points:
        return np.broadcast_to([0.0, 0.0, -0.21 * load], positions.shape)

    supports = Supports(("z0",), planes_of("") | planes_of("u"), prescribed={"uz1": led})
    contact = SurfaceContact("uz0", "z1", 1e-3)
    problem = Problem(mesh, RUBBER, supports, contacts=(contact,))
    solution = solve(problem, options=SolverOptions(tolerance=1e-10))
    assert solution.converged, solution.message
    return contact_forces(solution)[0], float(reaction(solution, "z0").force[2])


def line_contact() -> Outcome:
    """Peak pressure and width for the force, of a rigid cylinder and of two soft bodies."""
    rows: tuple[Row, ...] = ()
    soft, held = between_two_bodies(12)
    for label, contact, modulus in (
        ("rigid cylinder", under_a_rigid_cylinder(16), 4.0),
        ("two soft bodies", soft, 2.0),
    ):
        force = 2 * abs(contact.force[2]) / BREADTH
        peak = np.sqrt(force * modulus / (np.pi * CROWN))
        half = np.sqrt(4 * force * CROWN / (np.pi * modulus))
        ours = contact.area / BREADTH
        rows += (
            Row(f"{label}: peak pressure", peak, contact.peak_pressure, 0.03, "MPa", digits=2),
            Row(f"{label}: half width", half, ours, 0.03, "mm", digits=2),
        )
    rows += (Row("two soft bodies: action and reaction", held, soft.force[2], 1e-4, "N", digits=2),)
    return Outcome(rows, (), "blocks of 1536 tetrahedra, or of 864 and 1944")


CASES = (
    Case(
        "C1 Ball between two plates",
        "A ball of 10 mm radius that keeps its volume, pressed by 4 % and by 1 % of it. Hertz's "
        "half-spaces take 9 % and 4 % less force: they count the way to infinity, a ball that to "
        "its middle. With Hertz's pressure on a ball, in closed form, the force is right; highest "
        "pressure and radius of the contact follow Hertz.",
        "Hertz's contact of elastic spheres (1881); radial compliance of an elastic ball that "
        "keeps its volume, 5/19 s R / μ for n = 2 (Kelvin). Status: closed form.",
        hertz,
        slow=True,
    ),
    Case(
        "C2 Block between two plates",
        "A block of neo-Hooke squeezed without friction to half its height stays a block: force "
        "μ (1/λ² − λ) per first area. The plate lets through in proportion to the penetration "
        "asked for.",
        "Rivlin's homogeneous compression. Status: closed form.",
        block,
    ),
    Case(
        "C3 Line contact",
        "In plane strain a soft block under a rigid cylinder of 10 mm radius, and under a soft "
        "body with such a bottom, whose meshes do not match: for the force that is found, the peak "
        "pressure is √(F E* / π R) and the half width √(4 F R / π E*), with 1/E* the sum of "
        "(1 − ν²)/E of the bodies. The half width counts what is nearer than the penetration.",
        "Hertz's line contact (K. L. Johnson, *Contact Mechanics*, 1985, section 4.2). Status: "
        "closed form for small strains.",
        line_contact,
        slow=True,
    ),
)
