"""How an own body is meshed, held, loaded and solved."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bellows_design.analysis.models import AnalysisModel, Solving
from bellows_design.design.lengths import SMALLEST_FEATURE
from bellows_design.own_body.analysis.assembly import Assembly
from bellows_design.own_body.analysis.readings import require_point
from bellows_design.own_body.body import OwnBody
from bellows_design.own_body.conditions import AXES

if TYPE_CHECKING:
    from solver import Mesh, Problem, RigidPlane, Solution
    from solver.problem.loads import Load

PENETRATION = 0.005
"""Depth in an obstacle at a contact pressure of the shear modulus, in wall thicknesses."""

PEAK_TOLERANCE = 0.1
"""Wanted difference of stresses near the highest, as a fraction of it. Corners of a body as CAD has
it are sharp, and no mesh resolves them."""

PER_MM3 = 1e-9
"""N/m³, which is kg/m³ times m/s², in N/mm³."""


def wall(body: OwnBody) -> float:
    """The thickness, mm, in which edges of a mesh are measured."""
    from bellows_design.analysis.mesh_plan import COARSEST_EDGE

    if body.mesh.size is not None:
        return body.mesh.size / COARSEST_EDGE
    volume = sum(part.solid.Volume() for part in body.parts)
    return 2 * volume / sum(part.solid.Area() for part in body.parts)


def problem(body: OwnBody, mesh: Mesh) -> Problem:
    """The body on a mesh, with its supports, loads and obstacles.

    Raises ``DesignError`` where ``tip.point`` lies outside of the body.
    """
    from solver import Membrane, Problem, Supports

    require_point(body, mesh)
    first, *_ = body.parts
    return Problem(
        mesh=mesh,
        material=first.material.hyperelastic(),
        materials={part.name: part.material.hyperelastic() for part in body.parts},
        supports=Supports(
            clamped=body.supports.clamped,
            symmetry={name: AXES[axis] for name, axis in body.supports.symmetry.items()},
        ),
        pressurised=body.under_pressure,
        loads=_weight(body),
        membranes=tuple(Membrane(**each.model_dump()) for each in body.films),
        sharp_edge_radius=_sharp_edge_radius(body),
        contacts=tuple(_planes(body)),
    )


def _weight(body: OwnBody) -> tuple[Load, ...]:
    """The weight of every part."""
    from solver import BodyForce

    if body.gravity is None:
        return ()
    along = np.array(body.gravity.direction)
    field = body.gravity.acceleration * along / np.linalg.norm(along)
    loads = []
    for part in body.parts:
        x, y, z = (PER_MM3 * (part.density_kg_m3 or 0.0) * float(each) for each in field)
        loads.append(BodyForce((x, y, z), region=part.name))
    return tuple(loads)


def _planes(body: OwnBody) -> list[RigidPlane]:
    from solver import RigidPlane

    depth = PENETRATION * wall(body)
    return [RigidPlane(each.surface, depth, each.normal, each.point) for each in body.obstacles]


def _sharp_edge_radius(body: OwnBody) -> float:
    given = body.mesh.sharp_edge_radius
    return min(SMALLEST_FEATURE, wall(body) / 4) if given is None else given


def solve(body: OwnBody, problem: Problem, how: Solving) -> Solution:
    """Dead loads first, then the pressure; or the volume, which takes both in turn."""
    return (
        _inflated(body, problem, how) if body.load.by_volume else _pressurised(body, problem, how)
    )


def _pressurised(body: OwnBody, problem: Problem, how: Solving) -> Solution:
    """At the body's pressure, as long as no walls touch."""
    import solver
    from bellows_design.own_body.analysis.touching import touch_guard

    pressure, guard = body.load.pressure or 0.0, touch_guard(body, problem)
    loaded, begins = None, how.initial is None or len(how.stops)
    if problem.loads and pressure and begins:  # else the whole load is reached at once
        loaded = solver.solve(problem, 0.0, how.options, how.listener, guard=guard)
        if not loaded.converged:
            return loaded
    return solver.solve(
        problem,
        pressure,
        how.options,
        how.listener,
        initial=how.initial,
        stops=how.stops,
        guard=guard,
        after=loaded,
        keep=how.keep,
    )


def _inflated(body: OwnBody, problem: Problem, how: Solving) -> Solution:
    """At the largest volume, read at equal steps of the volume on the way."""
    from solver import cavity_volume, inflate

    still = np.zeros(problem.mesh.nodes.shape)
    rest = cavity_volume(problem.mesh, still, problem.pressurised)
    largest = body.load.largest_volume or 1.0
    *stops, end = rest * np.linspace(1.0, largest, body.load.points + 1)[1:]
    return inflate(problem, float(end), how.options, how.listener, stops=tuple(map(float, stops)))


def model_of(body: OwnBody, meshes: int) -> AnalysisModel[OwnBody]:
    """The whole body, or the part of it that its planes of symmetry leave, on so many meshes."""
    return AnalysisModel(
        name="own-body",
        solid=Assembly,
        problem=problem,
        wall=wall,
        solve=solve,
        share=body.supports.share,
        levels=meshes,
        growth=1.6,
        peak_tolerance=PEAK_TOLERANCE,
        from_rest=body.load.by_volume,
    )
