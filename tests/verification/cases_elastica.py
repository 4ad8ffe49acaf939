"""Elastica: slender strips bent by a half, a whole and two turns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from case import Case, Order, Outcome, Row
from measures import Points, observed_order
from meshes import cell_mesh, renamed
from structures import along, converged, node_at, reference, told

from solver import (
    Mesh,
    Ogden,
    Problem,
    SlenderAxis,
    SolverOptions,
    Supports,
    Traction,
    reaction,
    rotation,
    solve,
)

RUBBER = Ogden((1.0,), (2.0,))
STIFFNESS = 1.0 / 3.0
"""EI per depth of a strip of 1 mm in plane strain, mu h^3 / 3, N mm."""

SLENDERNESS = 120
SLENDER = (30, 60, 120)
"""Lengths over thickness for the order at which the thin strip's limit is approached."""

OPTIONS = SolverOptions(maximum_iterations=60, tolerance=1e-8, loose_tolerance=1e-3)


def lengthwise(length: float) -> Points:
    """Positions along the strip: cells grow from the clamp's edges on to two thicknesses."""
    steps = [0.25]
    while sum(steps) < length:
        steps.append(min(1.5 * steps[-1], 2.0))
    positions = np.concatenate([[0.0], np.cumsum(steps)])
    return positions * length / positions[-1]


def strip(slenderness: float) -> Mesh:
    """A strip of 1 mm along x, one cell of 1 mm deep; surface tip at its end."""
    x = lengthwise(float(slenderness))
    lines = [x, np.array([0.0, 1.0]), np.array([0.0, 0.5, 1.0])]
    return renamed(cell_mesh(np.ones((len(x) - 1, 1, 2), int), lines), {"x1": "tip"})


def cantilever(mesh: Mesh) -> Problem:
    """A strip in plane strain, clamped at x = 0, without load so far."""
    stations = SlenderAxis(tuple(np.arange(0.0, mesh.nodes[:, 0].max() + 1e-9, 4.0)))
    supports = Supports(clamped=("x0",), symmetry={"y0": 1, "y1": 1})
    return Problem(mesh, RUBBER, supports, axis=stations)


def dead(mesh: Mesh, loads: list[float]) -> list[Points]:
    """Displacements under dead shear forces on the tip, given as P L^2 / EI."""
    length = mesh.nodes[:, 0].max()
    states = []
    for load in loads:
        force = load * STIFFNESS / length**2
        problem = replace(cantilever(mesh), loads=(Traction("tip", (0.0, 0.0, -force)),))
        states.append(converged(solve(problem, 0.0, OPTIONS)).displacement)
    return states


def follower(mesh: Mesh, loads: list[float]) -> list[Points]:
    """Displacements under follower pressures on the upper face, given as q L^3 / EI."""
    problem = replace(cantilever(mesh), pressurised=("z1",))
    unit = STIFFNESS / mesh.nodes[:, 0].max() ** 3
    return along(problem, [load * unit for load in loads], OPTIONS)


Bend = Callable[[Mesh, list[float]], list[Points]]


def tip(mesh: Mesh, displacement: Points) -> Points:
    """x / L, depth / L and rotation (degrees) of the tip's middle."""
    length = mesh.nodes[:, 0].max()
    middle = node_at(mesh, length, 0.0, 0.5)
    x, _, z = mesh.nodes[middle] + displacement[middle]
    return np.array([x / length, (0.5 - z) / length, rotation(mesh, displacement)])


def bent(bend: Bend, key: str, symbol: str) -> Outcome:
    """All listed loads on a thin strip, and the order of the tip's angle under the smallest."""
    expected = {float(load): values for load, values in reference("G1")["reference"][key].items()}
    mesh = strip(SLENDERNESS)
    rows: list[Row] = []
    for (load, values), state in zip(expected.items(), bend(mesh, list(expected)), strict=True):
        label, ours = f"{symbol} = {load:g}", tip(mesh, state)
        rows += [
            Row(f"{label}: x / L", values[0], ours[0], 1e-2),
            Row(f"{label}: y / L", values[1], ours[1], 1e-2),
            Row(f"{label}: angle", values[2], ours[2], 1e-2, "°"),
        ]
    load, angle = min(expected), expected[min(expected)][2]
    errors = [abs(tip(m, *bend(m, [load]))[2] / angle - 1) for m in map(strip, SLENDER)]
    name = f"the angle at {symbol} = {load:g} in h / L"
    order = Order(name, observed_order(SLENDER, errors), 0.8, "1")
    note = f"L / h = {SLENDERNESS}, {len(mesh.tets)} tetrahedra; order on L / h = 30, 60, 120"
    return Outcome(tuple(rows), (order,), note)


REACH, WIDTH = 40.0, 5.0
"""Half length and width of the bar across the tip, mm."""


def with_bar(length: float) -> Mesh:
    """A strip from x = 0 to ``length`` about z = 0 with a stiff bar across its tip.

    Surfaces ``front`` and ``back``: half of the bar's far face, and the other half's near face.
    """
    x = lengthwise(length / 2)
    x = np.concatenate([x, length - x[-2::-1], length + WIDTH * np.array([0.5, 1.0])])
    arm = np.linspace(1.5, REACH, 3)
    z = np.concatenate([-arm[::-1], [-0.5, 0.0, 0.5], arm])
    cells = np.zeros((len(x) - 1, 1, len(z) - 1), int)
    cells[:, :, abs(z[1:] + z[:-1]) < 1.0] = 1
    cells[-2:] = 1
    mesh = cell_mesh(cells, [x, np.array([0.0, 2.0]), z])
    front, back = mesh.surfaces["x1"], mesh.surfaces["outside"]
    front = front[mesh.nodes[front, 2].max(axis=1) < -0.4]
    back = back[mesh.nodes[back, 2].min(axis=1) > 0.4]
    back = back[abs(mesh.nodes[back, 0] - length).max(axis=1) < 1e-9]
    return Mesh(
        mesh.nodes,
        mesh.tets,
        {**mesh.surfaces, "tip": mesh.surfaces["x1"], "front": front, "back": back},
    )


def moment() -> Outcome:
    """Follower couples that bend the strip by one and by two turns."""
    mesh, length = with_bar(float(SLENDERNESS)), float(SLENDERNESS)
    problem = replace(cantilever(mesh), pressurised=("front", "back"))
    tip_node = node_at(mesh, length, 0.0, 0.0)
    rows: list[Row] = []
    for turns in (1, 2):
        couple = 2 * np.pi * turns * STIFFNESS / length
        solution = converged(solve(problem, couple / (REACH**2 - 0.25), OPTIONS))
        closure = np.linalg.norm(mesh.nodes[tip_node] + solution.displacement[tip_node]) / length
        depth = mesh.nodes[:, 1].max()
        root = -reaction(solution, "x0").moment[1] / depth
        rows += [
            Row(f"M L / EI = {2 * turns} π: angle", 360.0 * turns, solution.rotation, 1e-2, "°"),
            Row(f"M L / EI = {2 * turns} π: tip from root / L", 0.0, closure, 1e-2, absolute=True),
            Row(f"M L / EI = {2 * turns} π: moment at the clamp", couple, root, 1e-2, "N"),
        ]
    return Outcome(tuple(rows), mesh=f"L / h = {SLENDERNESS}, {len(mesh.tets)} tetrahedra")


CASES = (
    Case(
        "G1 Elastica under a dead load at the tip",
        "A thin strip in plane strain bends like the elastica under a dead shear force at its tip. "
        "(A force that turns with the tip is not posed: the solver's tractions are dead.)",
        told("G1"),
        lambda: bent(dead, "dead_tip_load_PL2_EI", "P L² / EI"),
    ),
    Case(
        "G1 Elastica under a follower pressure",
        "The same strip under a uniform pressure on one face, until its tip has turned by 170°.",
        told("G1"),
        lambda: bent(follower, "uniform_follower_pressure_qL3_EI", "q L³ / EI"),
    ),
    Case(
        "G1 Elastica bent by an end moment",
        "A couple rolls the strip up into one circle and into two: θ = M L / EI. It is made of "
        "pressures on opposite sides of a stiff bar across the tip, which turn with it. The strip "
        "may pass through itself.",
        "Closed form. Status: thin-beam limit.",
        moment,
    ),
)
