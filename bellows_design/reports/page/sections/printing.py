"""How to print the part and test it for leaks: what stands on its sheet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from bellows_design.print_sheet import blocks as sheet_blocks
from bellows_design.print_sheet.figures import figures_of
from bellows_design.print_sheet.sheet import sheet
from bellows_design.reports.page.blocks import (
    Block,
    Cell,
    Grid,
    Heading,
    Section,
    Sentences,
    Steps,
)
from bellows_design.reports.page.wording import headings

if TYPE_CHECKING:
    from bellows_design.reports.page.findings import Findings

REFUSED = "The design is not approved; what follows is how it would be printed and tested."


def printing(findings: Findings) -> Section:
    """The sheet's blocks, but for its head."""
    found, title = findings.outcome, "Print and test"
    if found.evaluation is None:
        why = Sentences(("There is no sheet: the design was refused before the evaluation.",))
        return Section("printing", title, (why,))
    blocks = sheet(figures_of(found, found.evaluation))
    refused = () if found.verdict.approved else (Sentences((REFUSED,), "warn"),)
    return Section("printing", title, (*refused, *_after_the_head(blocks)))


def _after_the_head(blocks: Iterable[sheet_blocks.Block]) -> Iterator[Block]:
    """From the first heading of level 2 on: name and digest stand on top of the report."""
    begun = False
    for block in blocks:
        begun = begun or (isinstance(block, sheet_blocks.Heading) and block.level == 2)
        if begun:
            yield _translated(block)


def _translated(block: sheet_blocks.Block) -> Block:
    match block:
        case sheet_blocks.Heading(text):
            return Heading(text)
        case sheet_blocks.Paragraph(text):
            return Sentences((text,))
        case sheet_blocks.Table(titles, rows):
            return Grid(headings(*titles), tuple(tuple(map(Cell, row)) for row in rows))
        case sheet_blocks.Steps(steps):
            return Steps(steps)
