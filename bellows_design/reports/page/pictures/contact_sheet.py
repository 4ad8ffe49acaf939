"""One picture of a report: the part, cut open, under pressure, its curves, its verdict."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from bellows_design.reports.page.blocks import Head
from bellows_design.reports.page.pictures.drawn import INK, MUTED, RED, draw
from bellows_design.reports.page.pictures.libraries import require_pictures, without_glyph_warnings
from bellows_design.reports.page.pictures.rendering import Look
from bellows_design.reports.page.pictures.surfaces import draw_surface, surface_of
from bellows_design.reports.page.sections.head import head
from bellows_design.reports.page.sections.shape import STRESS, THICKNESS, deformed, part

if TYPE_CHECKING:
    from bellows_design.reports.page.findings import Findings

SIZE = (13.0, 8.6)
"""Inches."""

DOTS = 110

GREEN, AMBER = "#17683a", "#7a4b00"
COLOURS = {"good": GREEN, "warn": AMBER, "bad": RED}


def contact_sheet(found: Findings) -> bytes:
    """The picture as PNG.

    Raises ``DesignError`` without PyVista or matplotlib, or where nothing can be drawn.
    """
    require_pictures()
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, dpi=DOTS, layout="constrained")
    grid = figure.subplot_mosaic(
        [["head", "head", "head"], ["rest", "cut", "bent"], ["angle", "stress", "words"]],
        height_ratios=[0.3, 2.2, 2.0],
    )
    top = head(found)
    _title(grid["head"], top)
    _shapes(grid, found)
    _curves(grid, found)
    _words(grid["words"], top)
    content = BytesIO()
    with without_glyph_warnings():
        figure.savefig(content, format="png", metadata={"Software": None})
    return content.getvalue()


def _title(axes: Any, top: Head) -> None:
    axes.axis("off")
    axes.text(0, 0.95, top.name, fontsize=22, weight="bold", va="top", parse_math=False)
    axes.text(0, 0.25, top.description[:150], fontsize=10, color=MUTED, va="top", parse_math=False)
    axes.text(
        1, 0.95, top.verdict, fontsize=20, weight="bold", color=COLOURS.get(top.tone, INK),
        va="top", ha="right",
    )  # fmt: skip


def _shapes(grid: dict[str, Any], found: Findings) -> None:
    """At rest with thickness, cut open, and under pressure."""
    at_rest = surface_of(part(found).blocks[0])
    assert at_rest is not None
    draw_surface(grid["rest"], at_rest, Look(THICKNESS), "the part")
    draw_surface(grid["cut"], at_rest, Look(THICKNESS, cut=True), "cut open")
    moving = surface_of(deformed(found).blocks[0])
    if moving is None:
        _note(grid["bent"], "no deformed shape")
        return
    draw_surface(grid["bent"], moving, Look(STRESS), moving.frame_labels[-1])


def _curves(grid: dict[str, Any], found: Findings) -> None:
    from bellows_design.reports.page.curves.pressure_charts import angle_chart, stress_chart

    evaluation = found.outcome.evaluation
    if evaluation is None or len(evaluation.path) < 2:
        for name in ("angle", "stress"):
            _note(grid[name], "no load path")
        return
    draw(grid["angle"], angle_chart(evaluation))
    draw(grid["stress"], stress_chart(evaluation))


def _words(axes: Any, top: Head) -> None:
    """The figures that matter, each with its error, and what speaks against it."""
    from textwrap import fill

    axes.axis("off")
    lines = [each.line for each in top.figures]
    lines += [f"{each.name}: {each.value}" for each in top.reasons]
    lines += [f"not judged: {each.name}, as {each.value}" for each in top.not_judged]
    text = "\n".join(fill(line, 52, subsequent_indent="   ") for line in lines)
    rows = text.splitlines()
    shown = "\n".join([*rows[:22], "…"] if len(rows) > 23 else rows)
    axes.text(0, 1, shown, fontsize=9, va="top", linespacing=1.35, parse_math=False)


def _note(axes: Any, text: str) -> None:
    axes.axis("off")
    axes.text(0.5, 0.5, text, ha="center", color=MUTED)
