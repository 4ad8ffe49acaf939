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
    from bellows_design.print_sheet.sheet import sheet

    if found.evaluation is None:
        return {}
    blocks, name = sheet(figures_of(found, found.evaluation)), found.design.name
    return {
        f"{name}_sheet.md": as_markdown(blocks).encode(),
        f"{name}_sheet.html": as_html(f"{name}: print and leak test", blocks).encode(),
    }
