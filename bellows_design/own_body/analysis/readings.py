"""What an equilibrium of an own body says."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.own_body.body import TIP, OwnBody
from bellows_design.own_body.conditions import AXES

if TYPE_CHECKING:
    from solver import Mesh, PathPoint, Solution
    from solver.arrays import Reals

OUTSIDE = -0.05
"""Least barycentric coordinate of a point that is taken as one of the body's."""


@dataclass(frozen=True)
class PathReading:
    """What a point of the load's path says of the whole body.

    ``bending_angle_deg`` (rotation of the surface ``tip`` about y, past 360 where it curls on) and
    ``cavity_volume_mm3`` are None where the body has no such surface; ``stable`` at constant load,
    None if unknown.
    """

    pressure_mpa: float
    bending_angle_deg: float | None
    max_von_mises_mpa: float
    cavity_volume_mm3: float | None
    stable: bool | None


@dataclass(frozen=True)
class BodyReading:
    """What an equilibrium says of the whole body.

    Attributes:
        pressure_mpa: MPa.
        bending_angle_deg: Rotation of the surface ``tip`` about y, positive towards -z.
        chord_angle_deg: Of the chord from base to tip against the undeformed one, about y,
            positive towards -z, within 180 of either sign.
        tip_displacement_mm: Displacement (x, y, z) of the tip's point.
        contact_force_n: What all obstacles exert along their normals.
        max_von_mises_mpa: Highest von Mises stress.
        cavity_volume_mm3: Inside the pressurised surfaces.

    What the body has nothing for is None: angle and displacement without a tip, force without an
    obstacle, volume without pressure.
    """

    pressure_mpa: float
    bending_angle_deg: float | None
    chord_angle_deg: float | None
    tip_displacement_mm: tuple[float, float, float] | None
    contact_force_n: float | None
    max_von_mises_mpa: float
    cavity_volume_mm3: float | None


def path_reading(body: OwnBody, mesh: Mesh, point: PathPoint) -> PathReading:
    """The whole body at a point of a path on a mesh."""
    symmetric = {0, 2} & set(_crossed(body, mesh, TIP).values())  # then the whole tip does not turn
    angle = None if math.isnan(point.rotation) else 0.0 if symmetric else point.rotation
    return PathReading(
        point.pressure + 0.0,  # never -0
        angle,
        point.max_von_mises,
        body.supports.share * point.volume if body.under_pressure else None,
        point.stable,
    )


def _crossed(body: OwnBody, mesh: Mesh, surface: str) -> dict[str, int]:
    """The planes of symmetry that a surface lies on both sides of, and their axes."""
    if surface not in mesh.surfaces:
        return {}
    nodes = mesh.surface_nodes(surface)
    return {
        plane: AXES[axis]
        for plane, axis in body.supports.symmetry.items()
        if np.isin(nodes, mesh.surface_nodes(plane)).any()
    }


def reading(body: OwnBody, solution: Solution) -> BodyReading:
    """The whole body at an equilibrium."""
    point = path_reading(body, solution.problem.mesh, solution.path[-1])
    moved = _tip_displacement(body, solution)
    return BodyReading(
        pressure_mpa=solution.pressure + 0.0,
        bending_angle_deg=point.bending_angle_deg,
        chord_angle_deg=None if moved is None else _chord_angle(body, solution, moved),
        tip_displacement_mm=moved,
        contact_force_n=_contact_force(body, solution),
        max_von_mises_mpa=point.max_von_mises_mpa,
        cavity_volume_mm3=point.cavity_volume_mm3,
    )


def _tip_displacement(body: OwnBody, solution: Solution) -> tuple[float, float, float] | None:
    """Of the tip's point, or the mean of the surface ``tip``, as the whole body has it."""
    mesh = solution.problem.mesh
    if body.tip.point is not None:
        moved = displacement_at(mesh, solution.displacement, body.tip.point)
    elif TIP in mesh.surfaces:
        moved = surface_mean(mesh, TIP, solution.displacement)
        for axis in _crossed(body, mesh, TIP).values():
            moved[axis] = 0.0  # the tip's other half moves the opposite way
    else:
        return None
    x, y, z = (float(each) for each in moved)
    return x, y, z


def require_point(body: OwnBody, mesh: Mesh) -> None:
    """Raise ``DesignError`` where ``tip.point`` lies outside of the body."""
    from solver.adaptivity.transfer import locate

    place = body.tip.point
    if place is not None and locate(mesh, np.array([place]))[1].min() < OUTSIDE:
        raise DesignError(f"tip.point = {place} mm lies outside of the body.")


def displacement_at(mesh: Mesh, displacement: Reals, place: tuple[float, float, float]) -> Reals:
    """Displacement (3,) at a place in the undeformed body, mm; of one outside, extrapolated."""
    from solver.adaptivity.transfer import locate
    from solver.mesh.elements import TETRAHEDRON_EDGES, quadratic_shapes

    element, barycentric = locate(mesh, np.array([place]))
    shapes = quadratic_shapes(barycentric, TETRAHEDRON_EDGES)
    moved: Reals = (shapes @ displacement[mesh.tets[element[0]]])[0]
    return moved


def surface_mean(mesh: Mesh, surface: str, values: Reals) -> Reals:
    """Mean (3,) over the area of an undeformed surface of values (n, 3) at the nodes."""
    from solver.mesh.elements import triangle_rule

    cells, rule = mesh.triangles(surface), triangle_rule()
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, mesh.nodes[cells])
    areas = rule.weights * np.linalg.norm(np.cross(tangents[0], tangents[1]), axis=-1)
    total = np.einsum("kq,qa,kai->i", areas, rule.quadratic, values[cells])
    mean: Reals = total / areas.sum()
    return mean


def _chord_angle(
    body: OwnBody, solution: Solution, moved: tuple[float, float, float]
) -> float | None:
    """Rotation of the chord about y, degrees; None for a chord along y or without a base."""
    mesh = solution.problem.mesh
    base, tip = _base(body, mesh), body.tip.point
    if base is None:
        return None
    place = _middle(body, mesh, TIP) if tip is None else np.array(tip)
    before = place - base
    after = before + np.array(moved)
    if np.hypot(before[0], before[2]) < 1e-9 * mesh.size:
        return None
    turned = math.atan2(-after[2], after[0]) - math.atan2(-before[2], before[0])
    return math.degrees(math.remainder(turned, 2 * math.pi))


def _base(body: OwnBody, mesh: Mesh) -> Reals | None:
    """Where the chord begins, mm; None if nothing is clamped."""
    if body.tip.base is not None:
        return np.array(body.tip.base)
    clamped = body.supports.clamped
    return _middle(body, mesh, clamped[0]) if clamped else None


def _middle(body: OwnBody, mesh: Mesh, surface: str) -> Reals:
    """Mean place of a surface of the whole body: on planes of symmetry that it crosses, mm."""
    mean = surface_mean(mesh, surface, mesh.nodes)
    for plane, axis in _crossed(body, mesh, surface).items():
        mean[axis] = mesh.nodes[mesh.surface_nodes(plane), axis].mean()
    return mean


def _contact_force(body: OwnBody, solution: Solution) -> float | None:
    """Sum of what the obstacles exert on the whole body along their normals, N."""
    from solver import contact_forces

    if not body.obstacles:
        return None
    forces = contact_forces(solution)
    normals = [np.array(each.normal) for each in body.obstacles]
    along = (
        float(found.force @ normal) / float(np.linalg.norm(normal))
        for found, normal in zip(forces, normals, strict=True)
    )
    return body.supports.share * sum(along)
