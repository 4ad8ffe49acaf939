"""The sheet that goes with a printed part: how to print it, how to test it, what to expect."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bellows_design.pipeline import Outcome


def sheet_files(found: Outcome) -> dict[str, bytes]:
    """The sheet of an evaluated design as Markdown and as HTML, by the names of the files."""
    from bellows_design.print_sheet.figures import figures_of
    from bellows_design.print_sheet.html import as_html
    from bellows_design.print_sheet.markdown import as_markdown
    from bellows_design.print_sheet.names import sheet_names
    from bellows_design.print_sheet.sheet import sheet

    if found.evaluation is None:
        return {}
    blocks, name = sheet(figures_of(found, found.evaluation)), found.design.name
    texts = as_markdown(blocks), as_html(f"{name}: print and leak test", blocks)
    return {name: text.encode() for name, text in zip(sheet_names(name), texts, strict=True)}
