"""Designs whose meshes are morphed in tests, their coarsest meshes, and measures of these."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import MODELS, shortened
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.geometry.named_solids import NamedSolid
from bellows_design.morphing import Morpher
from solver import Mesh
from solver.arrays import Reals
from solver.mesh.elements import triangle_rule
from solver.mesh.jacobians import least_jacobians

GROOVE = {"side": "outside", "shape": "rectangular", "depth": 0.5, "width": 3.0}
INSIDE = {"side": "inside", "shape": "rectangular", "depth": 0.7, "width": 1.7, "fillet": 0.3}

FINGERTIP = (
    "fingertip.length=6",
    "fingertip.width=12",
    "fingertip.thickness=3",
    "fingertip.ribs=3",
)


def changed(name: str, indent: dict[str, Any] | None = None, **bellows: Any) -> Design:
    """A shipped design with other numbers, and another indent if one is given."""
    table = load_design(name).model_dump()
    table["bellows"] |= bellows
    if indent is not None:
        table["indent"] = indent
    return Design.of(table)


DESIGNS = {
    **{name: load_design(name) for name in shipped_designs()},
    "rounded groove": changed("prototype_1", {**GROOVE, "fillet": 0.3}),
    "arc": changed("prototype_1", {"depth": 0.4, "width": 2.4}),
    "groove inside": changed("prototype_1", INSIDE),
    "channel above the floor": changed("prototype_1", tendon_thickness=1.8),
    "channel below the floor": changed("prototype_1", tendon_thickness=1.2),
    "no fillets": changed("prototype_1", inner_fillet=0.0, outer_fillet=0.0),
    "no full rounds": changed("finger", outer_fillet=1.5, inner_fillet=0.6),
    "fingertip": with_overrides(load_design("finger"), FINGERTIP),
}


def design(name: str, model: str) -> Design:
    """A design of the table; of one bubble for a half actuator."""
    return shortened(DESIGNS[name]) if model == "half" else DESIGNS[name]


def solid(design: Design, model: str) -> NamedSolid:
    """The CAD solid of a model's body."""
    return MODELS[model].solid(design)


@cache
def morpher(name: str, model: str = "unit-cell") -> Morpher:
    """What moves the coarsest mesh of a design."""
    own = design(name, model)
    return Morpher.of(own, model, first_plan(solid(own, model), own).made())


def volume(mesh: Mesh) -> float:
    """Of a mesh, mm³."""
    return float(least_jacobians(mesh.nodes, mesh.tets).mean.sum() / 6)


def area(mesh: Mesh, surface: str) -> float:
    """Of a surface of a mesh, mm²."""
    rule = triangle_rule()
    corners = mesh.nodes[mesh.surfaces[surface]]
    sides = np.einsum("eni,qnj->eqij", corners, rule.gradients)
    return float(
        (np.linalg.norm(np.cross(sides[..., 0], sides[..., 1]), axis=-1) @ rule.weights).sum()
    )


def departures(mesh: Mesh, body: NamedSolid) -> Reals:
    """Relative errors of a mesh's volume and of the areas of its surfaces."""
    errors = [volume(mesh) / body.solid.Volume() - 1]
    errors += [area(mesh, name) / body.area(name) - 1 for name in sorted(mesh.surfaces)]
    return np.array(errors)
