"""How the files of a sheet are called."""

from __future__ import annotations

ENDINGS = ("_sheet.md", "_sheet.html")
"""As Markdown and as HTML."""


def sheet_names(name: str) -> tuple[str, ...]:
    """The files of the sheet of a design called ``name``."""
    return tuple(f"{name}{ending}" for ending in ENDINGS)


def is_sheet(name: str) -> bool:
    """Whether a file of this name is a sheet."""
    return name.endswith(ENDINGS)
