"""A sheet as Markdown: any text stands as it is, whatever signs it has."""

from __future__ import annotations

import re
from collections.abc import Iterable

from bellows_design.print_sheet.blocks import Block, Heading, Paragraph, Steps, Table

_SIGNS = re.compile(r"([\\`*_{}\[\]<>#|~&$])")


def as_markdown(blocks: Iterable[Block]) -> str:
    """The blocks with an empty line between them."""
    return "\n\n".join(_block(block) for block in blocks) + "\n"


def _block(block: Block) -> str:
    match block:
        case Heading(text, level):
            return f"{'#' * level} {_escaped(text)}"
        case Paragraph(text):
            return _escaped(text)
        case Table(headings, rows):
            return "\n".join(_row(row) for row in (headings, ("---",) * len(headings), *rows))
        case Steps(steps):
            return "\n".join(
                f"{number}. **{_escaped(what)}** {_escaped(why)}"
                for number, (what, why) in enumerate(steps, 1)
            )


def _row(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cell if cell == '---' else _escaped(cell) for cell in cells)} |"


def _escaped(text: str) -> str:
    return _SIGNS.sub(r"\\\1", text)
