"""From the twelve numbers of a soft bellows actuator to an approved, printable STL.

What most programs need stands here; names are imported when they are first used. Lengths are in mm,
forces in N, pressures and stresses in MPa, angles in degrees.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
    from bellows_design.design.bellows_parameters import BellowsParameters
    from bellows_design.design.conditions import Limits, Load
    from bellows_design.design.design import Design
    from bellows_design.design.indent import Indent
    from bellows_design.design.overrides import with_overrides
    from bellows_design.design.shipped import load_design, shipped_designs
    from bellows_design.design.variation import varied
    from bellows_design.errors import BellowsError, DesignError
    from bellows_design.evaluation import evaluate
    from bellows_design.export.formats import write_part
    from bellows_design.export.part import Part
    from bellows_design.force.curve import force_curve
    from bellows_design.materials.library import load_material
    from bellows_design.materials.material import Material
    from bellows_design.neighbours.sensitivities import sensitivities
    from bellows_design.own_body.body import OwnBody
    from bellows_design.own_body.parts import BodyPart
    from bellows_design.pipeline import Outcome, build_part, check, examine, run

__version__ = "0.1.0"

__all__ = [
    "BellowsError",
    "BellowsParameters",
    "BodyPart",
    "Design",
    "DesignError",
    "Evaluation",
    "Indent",
    "Limits",
    "Load",
    "Material",
    "Outcome",
    "OwnBody",
    "Part",
    "__version__",
    "build_part",
    "check",
    "evaluate",
    "examine",
    "force_curve",
    "load_design",
    "load_material",
    "run",
    "sensitivities",
    "shipped_designs",
    "varied",
    "with_overrides",
    "write_part",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "analysis.evaluation": ("Evaluation",),
        "design.bellows_parameters": ("BellowsParameters",),
        "design.conditions": ("Limits", "Load"),
        "design.design": ("Design",),
        "design.indent": ("Indent",),
        "design.overrides": ("with_overrides",),
        "design.shipped": ("load_design", "shipped_designs"),
        "design.variation": ("varied",),
        "errors": ("BellowsError", "DesignError"),
        "evaluation": ("evaluate",),
        "export.formats": ("write_part",),
        "export.part": ("Part",),
        "force.curve": ("force_curve",),
        "materials.library": ("load_material",),
        "materials.material": ("Material",),
        "neighbours.sensitivities": ("sensitivities",),
        "own_body.body": ("OwnBody",),
        "own_body.parts": ("BodyPart",),
        "pipeline": ("Outcome", "build_part", "check", "examine", "run"),
    },
)
