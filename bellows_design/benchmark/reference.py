"""Converged angle and stress of designs, to measure errors against.

They were computed once, on meshes far finer than an evaluation needs, by
``tests/benchmarks/reference.py``, and are found by a design's digest.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design

STORED: Traversable = files("bellows_design.benchmark") / "reference.json"
"""The values that come with the package."""

FINER = 1.5
"""A stored reference has at least so many times the elements of a mesh of its own model that it is
to judge: against a mesh as fine as itself every error would look small."""


@dataclass(frozen=True)
class Reference:
    """Angle (degrees) and stress (MPa) of the whole actuator that count as exact.

    They come from a mesh of ``model`` with so many ``elements``, of which meshes of the same model
    with up to ``largest`` elements can be judged. ``recipe`` says in a few words how they came
    about; ``finest_half`` are those of the half actuator, where it was computed as well.
    """

    bending_angle_deg: float
    max_von_mises_mpa: float
    model: str
    elements: int
    largest: int
    recipe: str
    finest_half: Reference | None = None

    def judges(self, model: str, elements: int) -> bool:
        """True if it is converged so much better than that mesh that the difference is an error."""
        return model != self.model or elements <= self.largest


def reference_of(design: Design, source: Traversable = STORED) -> Reference | None:
    """The stored reference of ``design``; None if there is none, or no file of them."""
    if not source.is_file():
        return None
    stored = json.loads(source.read_text("utf-8"))
    for found in stored["designs"].values():
        if found["digest"] == design.digest:
            return _reference("unit-cell", found["cell"], _finest_half(design, stored))
    return None


def _finest_half(design: Design, stored: Mapping[str, Any]) -> Reference | None:
    """Kept for Prototype 1 alone: computing it takes longest."""
    levels = stored.get("finest half")
    if not levels or design.digest != load_design("prototype_1").digest:
        return None
    return _reference("half", levels)


def _reference(
    model: str, levels: Sequence[Mapping[str, Any]], finest_half: Reference | None = None
) -> Reference:
    """The finest of ``levels``, meshes of one model from coarse to fine."""
    finest = levels[-1]
    elements = int(finest["elements"])
    return Reference(
        float(finest["bending_angle_deg"]),
        float(finest["max_von_mises_mpa"]),
        model,
        elements,
        int(elements / FINER),
        f"the stored values of the {model}, finest of {len(levels)} meshes, {elements} tetrahedra",
        finest_half,
    )
