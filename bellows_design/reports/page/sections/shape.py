"""The part to turn around, with the thickness of its walls; and the actuator under pressure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.reports.page.blocks import Block, Section, Sentences, Space
from bellows_design.reports.page.thickness.surface import thickness_map
from bellows_design.reports.page.wording import pressure_text
from bellows_design.web.scene import Field, Surface

if TYPE_CHECKING:
    from bellows_design.deformed.surface import SurfaceFrames
    from bellows_design.reports.page.findings import Findings

NEAR_LIMIT = 0.4
"""Of the limit: from such a stress on the colours end at the limit."""

SAME_ANGLE = 0.05
"""Degrees, by which two angles differ that are one."""

THICKNESS, STRESS = "wall thickness", "von Mises stress"


def part(findings: Findings) -> Section:
    """The printed part with its thickness map."""
    found = findings.outcome
    made = thickness_map(found.design, found.part.mesh)
    colours = Field(THICKNESS, "mm", made.thickness, low=0.0, high=made.reach, reverse=True)
    surface = Surface("part", made.triangles, made.positions, (colours,))
    caption = (
        "The printed part. Colours are the local thickness of the material below the surface, as "
        f"the printer's rules measure it: the largest ball that touches both sides, up to "
        f"{made.reach:g} mm. Thin walls are bright; the scale is the same for all parts of this "
        "printer. Turn it with mouse, finger or arrow keys; the section looks inside."
    )
    block = Space((surface,), caption, f"{found.design.name}, the printed part", THICKNESS)
    return Section("part", "The part", (block,))


def deformed(findings: Findings) -> Section:
    """The whole actuator along its path, with its stresses."""
    found, title = findings.deformed, "Under pressure"
    if isinstance(found, str):
        why = Sentences((f"There is no deformed shape: {found}.",))
        return Section("deformed", title, (why,))
    return Section("deformed", title, (_moving(findings, found),))


def _moving(findings: Findings, found: SurfaceFrames) -> Block:
    design = findings.outcome.design
    limit = design.max_von_mises
    colours = Field(STRESS, "MPa", found.von_mises, 0.0, _top(found, limit), limit)
    labels = tuple(
        f"{pressure_text(float(pressure))}, {angle:.0f}°"
        for pressure, angle in zip(found.pressures_mpa, found.angles_deg, strict=True)
    )
    name = "actuator"
    surface = Surface(name, found.triangles, found.positions, (colours,), labels)
    caption = (
        "The whole actuator, without port and mount, put together from the solution of its "
        "bubbles, from rest to "
        f"{pressure_text(float(found.pressures_mpa[-1]))}: move the slider, or press [ and ]. "
        f"{_accuracy(findings, found)} At sharp edges without a fillet stresses depend on the mesh "
        f"and do not count. The limit is {limit:g} MPa."
    )
    last = len(found.pressures_mpa) - 1
    return Space((surface,), caption, f"{design.name} under pressure", STRESS, 520, last)


def _accuracy(findings: Findings, found: SurfaceFrames) -> str:
    """What is of the coarsest mesh: of a cell all but the angle, of other models that too."""
    evaluation = findings.outcome.evaluation
    if evaluation and abs(found.angles_deg[-1] - evaluation.bending_angle_deg) < SAME_ANGLE:
        return (
            "Shapes and colours are those of the coarsest mesh, turned to the angle of the finest; "
            "its stresses are somewhat off: the finest one's highest stress stands on top of the "
            "page."
        )
    return (
        "Shapes, angles and colours are those of the coarsest mesh and somewhat off: the finest "
        "one's angle and highest stress stand on top of the page."
    )


def _top(found: SurfaceFrames, limit: float) -> float:
    """Upper end of the colours: the limit, where the stress comes near it or passes it."""
    highest = float(found.von_mises.max())
    return limit if highest > NEAR_LIMIT * limit else highest or limit
