"""An own body under load with its mirror images, where planes of symmetry cut it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bellows_design.deformed.actuator import DeformedActuator
from bellows_design.deformed.joined.copies import Assembled, Placed
from bellows_design.deformed.joined.motion import Motion
from bellows_design.deformed.joined.single import mirrored_copies
from bellows_design.own_body.analysis.evaluation import BodyEvaluation
from bellows_design.own_body.conditions import AXES
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

if TYPE_CHECKING:
    from bellows_design.own_body.body import OwnBody


def deformed_body(found: BodyEvaluation) -> DeformedActuator:
    """The whole own body on the finest mesh, at the load that was reached.

    Args:
        found: Its evaluation.

    Returns:
        The body with its images at the planes of symmetry, whose nodes they share; of several
        planes normal to one axis at the first only. Its surfaces have their names, without those
        of symmetry; regions of parts are not kept. Lengths are in mm, stresses in MPa.

    Examples:
        >>> import cadquery as cq
        >>> from bellows_design import OwnBody, evaluate
        >>> from bellows_design.deformed import deformed_body
        >>> hollow = cq.Solid.makeBox(30, 3, 4, cq.Vector(5, 1, 4))
        >>> bar = cq.Solid.makeBox(40, 5, 10).cut(hollow)
        >>> found = evaluate(OwnBody(
        ...     name="bar",
        ...     parts=[{"name": "bar", "solid": bar, "material": "ecoflex_00_30"}],
        ...     surfaces={"root": "<X", "tip": ">X", "cavity": {"inner": True}},
        ...     load={"pressure": 0.002},  # MPa
        ... ))
        >>> body = deformed_body(found)
        >>> print(len(body.displacement) == len(body.mesh.nodes), body.von_mises.max() > 0)
        True True
    """
    from solver import nodal_von_mises
    from solver.results.sharp_edges import trusted_nodes

    solution = found.computation.finest
    mesh, planes = solution.problem.mesh, _planes(found.body)
    named = {name: name for name in mesh.surfaces if name not in found.body.supports.symmetry}
    whole = Assembled.of([mesh], mirrored_copies(planes, named))
    origin = np.zeros(3)
    for name, axis in planes.items():
        origin[axis] = mesh.nodes[mesh.surface_nodes(name), axis].mean()

    def everywhere(nodes: Reals) -> Reals:
        return whole.positions(Placed((nodes - origin,), (Motion(),))) + origin

    undeformed = everywhere(mesh.nodes)
    return DeformedActuator(
        Mesh(undeformed, whole.tets, whole.surfaces),
        everywhere(mesh.nodes + solution.displacement) - undeformed,
        whole.values((nodal_von_mises(solution),)),
        found.pressure_mpa,
        trusted_nodes(solution.problem)[whole.origin],
    )


def _planes(body: OwnBody) -> dict[str, int]:
    """Surface -> axis that it is normal to; one for each axis."""
    first: dict[str, str] = {}
    for name, axis in body.supports.symmetry.items():
        first.setdefault(axis, name)
    return {name: AXES[axis] for axis, name in first.items()}
