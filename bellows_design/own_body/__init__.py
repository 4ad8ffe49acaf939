"""Bodies of one's own as designs: CAD solids with named faces, materials, supports and loads.

    body = OwnBody(name="bar", parts=(BodyPart(name="bar", solid=solid, material="ecoflex_00_30"),),
                   surfaces={"root": "<X", "tip": ">X"})

``bellows_design.evaluation.evaluate`` takes one like a design of bellows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from bellows_design.own_body.analysis.evaluation import BodyEvaluation
    from bellows_design.own_body.body import OwnBody
    from bellows_design.own_body.conditions import (
        BodyLoad,
        BodyMesh,
        BodySupports,
        Film,
        Gravity,
        Obstacle,
        Tip,
    )
    from bellows_design.own_body.files import load_body, write_body
    from bellows_design.own_body.parts import BodyPart
    from bellows_design.own_body.selection import Selection

__all__ = [
    "BodyEvaluation",
    "BodyLoad",
    "BodyMesh",
    "BodyPart",
    "BodySupports",
    "Film",
    "Gravity",
    "Obstacle",
    "OwnBody",
    "Selection",
    "Tip",
    "load_body",
    "write_body",
]

__getattr__ = imported_when_asked_for(
    __name__,
    {
        "body": ("OwnBody",),
        "conditions": (
            "BodyLoad",
            "BodyMesh",
            "BodySupports",
            "Film",
            "Gravity",
            "Obstacle",
            "Tip",
        ),
        "analysis.evaluation": ("BodyEvaluation",),
        "files": ("load_body", "write_body"),
        "parts": ("BodyPart",),
        "selection": ("Selection",),
    },
)
