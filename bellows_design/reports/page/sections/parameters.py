"""The numbers of the design on a dimensioned sketch, and as a table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Grid,
    Picture,
    Pictures,
    Section,
    Sentences,
)
from bellows_design.reports.page.sketch.sheets import sketch
from bellows_design.reports.page.wording import headings, number

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.reports.page.findings import Findings
    from bellows_design.validation.parameters import Parameters

TITLES = ("name", "value", "unit", "meaning")


def parameters(findings: Findings) -> Section:
    """Sketch and tables."""
    design, mesh = findings.outcome.design, findings.outcome.part.mesh
    pictures = tuple(Picture(each, each.title) for each in sketch(design, mesh))
    about = Sentences(
        ("Sections of the part's own mesh, each true to its scale; lengths in mm.",), "muted"
    )
    return Section("parameters", "Parameters", (Pictures(pictures), about, *_tables(design)))


def _tables(design: Design) -> Iterator[Block]:
    named: tuple[tuple[str, Parameters | None], ...] = (
        ("", design.bellows),
        ("indent.", design.indent),
        ("port.", design.port),
        ("mount.", design.mount),
        ("fingertip.", design.fingertip),
        ("load.", design.load),
        ("limits.", design.limits),
    )
    rows = [row for prefix, table in named if table is not None for row in _rows(prefix, table)]
    yield Grid(headings(*TITLES, right=("value",)), tuple(rows))
    if design.indent is None:
        yield Sentences(("The design has no indent.",), "muted")


def _rows(prefix: str, table: Parameters) -> Iterator[tuple[Cell, ...]]:
    for name, field in type(table).model_fields.items():
        extra = field.json_schema_extra
        unit = str(extra.get("unit", "")) if isinstance(extra, dict) else ""
        value = _text(table, name, getattr(table, name))
        yield Cell(f"{prefix}{name}"), number(value), Cell(unit), Cell(field.description or "")


def _text(table: Parameters, name: str, value: object) -> str:
    """A value as text; where one is left open, what follows."""
    if value is None and name == "number_of_bubbles" and isinstance(table, BellowsParameters):
        return f"{table.bubble_count}, as many as fit"
    if value is None:
        return "not given"
    if isinstance(value, float):
        return f"{value:g}"
    return (", ".join(map(str, value)) or "none") if isinstance(value, tuple) else str(value)
