"""What the finger exerts in scenes: force against pressure, and a picture of each scene."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.reports.force.tables import result_rows
from bellows_design.reports.page.blocks import (
    Block,
    Fact,
    Facts,
    Heading,
    Picture,
    Pictures,
    Section,
    Sentences,
)
from bellows_design.reports.page.curves.force_charts import by_distance_chart, force_chart
from bellows_design.reports.page.scene_picture import scene_drawing
from bellows_design.reports.page.wording import capitalised

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve, SceneResult
    from bellows_design.reports.page.findings import Findings

NONE_ASKED = (
    "No scene was asked for: limits.scenes of the design names those that approval must hold, and "
    "bellows report --scene NAME adds others."
)


def force(findings: Findings) -> Section:
    """Every scene that the design must hold, or that was asked for."""
    blocks = [
        block for each in (*findings.outcome.scenes, *findings.further) for block in _scene(each)
    ]
    return Section("force", "Force", tuple(blocks) or (Sentences((NONE_ASKED,), "muted"),))


def _scene(result: SceneResult) -> Iterator[Block]:
    yield Heading(f"Scene {result.scene}")
    found = result.found
    if found is None:
        yield Sentences((capitalised(result.failure),), "bad")
        return
    if not found.converged:
        yield Sentences((capitalised(found.message),), "bad")
    yield Pictures(tuple(_pictures(found)))
    yield Facts(tuple(Fact(name, value) for name, value in result_rows(found).items()))
    warnings = dict.fromkeys((*found.warnings, *found.last.warnings))
    if warnings:
        yield Sentences(tuple(map(capitalised, warnings)), "warn")


def _pictures(found: ForceCurve) -> Iterator[Picture]:
    yield Picture(
        scene_drawing(found),
        "The finger's lower side, darker the higher the pressure; dots where it presses.",
    )
    if len(found.curve) > 1 and any(each.force_n for each in found.curve):
        yield Picture(
            force_chart(found), "Force against pressure; the band is its estimated error."
        )
    if found.by_distance:
        yield Picture(
            by_distance_chart(found), "At the last pressure, while the support moves away."
        )
