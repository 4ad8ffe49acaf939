"""What is read from a result."""

from __future__ import annotations

import numpy as np
from hard_bodies import NEO_HOOKE, Points, solved
from hard_case import Finding, HardCase, at_most, below, true
from meshes import box_mesh, renamed, tube_mesh

from solver import Ogden, Problem, Reaction, Supports, Traction, reaction, rotation


def quarter_ring() -> tuple[Finding, ...]:
    """A quarter ring between planes of symmetry: its ends bear p times the deformed bore."""
    mesh = tube_mesh(5.0, 6.0, 1.0, (2, 8, 2), np.pi / 2)
    planes = Supports(symmetry={"start": 1, "end": 0, "z0": 2, "z1": 2})
    errors = []
    for pressure in (0.02, 0.1):
        solution = solved(Problem(mesh, NEO_HOOKE, planes, ("inside",)), pressure)
        bore = 5.0 + solution.displacement[np.linalg.norm(mesh.nodes - [5, 0, 0], axis=1).argmin()]
        for name, axis in (("start", 1), ("end", 0)):
            found = reaction(solution, name)
            errors.append(abs(-found.force[axis] / (pressure * bore[0]) - 1))
            assert found.by_traction == (False, False, False)
    return (at_most("force of the ends off p r by", max(errors), 1e-5),)


def shared_edges() -> tuple[Finding, ...]:
    """A block in simple shear, all six faces held: every edge and corner is shared."""
    shear = 0.4

    def sheared(at: Points, load: float) -> Points:
        return load * shear * np.stack([at[:, 1], 0 * at[:, 1], 0 * at[:, 1]], axis=1)

    mesh = box_mesh((3, 2, 2), (1.5, 1.0, 1.2), 0.2)
    led = Supports(prescribed={name: sheared for name in ("x0", "x1", "y0", "y1", "z0", "z1")})
    solution = solved(Problem(mesh, Ogden.neo_hooke(1.0, 50.0), led))
    gradient = np.array([[1, shear, 0], [0, 1, 0], [0, 0, 1]])
    left = gradient @ gradient.T
    piola = (left - np.trace(left) / 3 * np.eye(3)) @ np.linalg.inv(gradient).T
    areas = {"x1": 1.2, "y1": 1.8, "z1": 1.5}
    found = {name: reaction(solution, name) for name in mesh.surfaces}
    errors = [found[n].force - areas[n] * piola[:, "xyz".index(n[0])] for n in areas]
    sums = sum(each.force for each in found.values())
    return (
        below("force of each face off stress times area by", _largest(errors), 1e-8, "N"),
        below("all together", _largest(sums), 1e-9, "N"),
        true("said to be found by tractions", all(all(f.by_traction) for f in found.values())),
    )


def clamp_beside_symmetry() -> tuple[Finding, ...]:
    """Half of a pulled bar: the clamp's edge lies in the plane of symmetry, which holds y too."""
    ends: list[Reaction] = []
    balance = []
    for cells in (1, 2, 3):
        mesh = box_mesh((6 * cells, cells, 2 * cells), (6.0, 0.5, 1.0))
        supports = Supports(("x0",), {"y0": 1})
        pull = (Traction("x1", (0.3, 0.0, 0.01)),)
        solution = solved(Problem(mesh, NEO_HOOKE, supports, loads=pull))
        clamp, plane = reaction(solution, "x0"), reaction(solution, "y0")
        balance.append(clamp.force + plane.force - [-0.15, 0.0, -0.005])
        ends.append(clamp)
    sideways = [end.force[1] for end in ends]
    return (
        below("clamp and plane off balance by", _largest(balance), 1e-9, "N"),
        at_most("force along y, two cells against three", sideways[1] / sideways[2] - 1, 0.05),
        true("only that component is shared", ends[0].by_traction == (False, True, False)),
    )


def turned_about_another_axis() -> tuple[Finding, ...]:
    """A bar twisted about x, or bent about z, by many turns: its tip does not turn about y."""
    mesh = renamed(box_mesh((20, 2, 2), (10.0, 1.0, 1.0)), {"x1": "tip"})
    x, y, z = (mesh.nodes - [0.0, 0.5, 0.5]).T
    wrong = []
    for degrees in (20, 180, 400, 1000):
        angle, radius = np.radians(degrees) * x / 10, 10 / np.radians(degrees)
        turned = np.cos(angle) * y - np.sin(angle) * z, np.sin(angle) * y + np.cos(angle) * z
        arc = (radius - y) * np.sin(angle), radius - (radius - y) * np.cos(angle)
        for moved in ((x, *turned), (*arc, z)):
            displacement = np.stack(moved, axis=1) - np.stack([x, y, z], axis=1)
            wrong.append(rotation(mesh, displacement))
    return (below("rotation about y", _largest(wrong), 1e-9, "°"),)


def _largest(values: object) -> float:
    return float(np.abs(values).max())


CASES = (
    HardCase(
        "The ends of a quarter ring",
        "edges of other planes of symmetry count as well: a force that is a tenth off",
        "a support bears the components that it holds, no others",
        quarter_ring,
    ),
    HardCase(
        "Edges that two supports hold alike",
        "their nodal forces count twice, once for each",
        "each takes the traction on its own surface, and the result says in which components",
        shared_edges,
    ),
    HardCase(
        "A clamp beside a plane of symmetry",
        "the stress is unbounded at the edge that they share",
        "the parts follow from tractions and add up to the nodal forces exactly",
        clamp_beside_symmetry,
    ),
    HardCase(
        "Torsion, and bending about another axis",
        "whole turns are counted where nothing turns about y: 360° for torsion by 400°",
        "nodes that do not turn about y count with their part about y",
        turned_about_another_axis,
    ),
)
