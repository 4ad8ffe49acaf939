"""The designs that come with the package, and designs in files of the user."""

from __future__ import annotations

from pathlib import Path

from bellows_design.design.design import Design
from bellows_design.files.toml_files import TomlLibrary

LIBRARY = TomlLibrary("design", "bellows_design.design", folder="designs")


def shipped_designs() -> tuple[str, ...]:
    """Names of the designs that come with the package, sorted."""
    return LIBRARY.names()


def load_design(name_or_path: str | Path) -> Design:
    """The shipped design of that name, else the design in the TOML file at that path.

    Args:
        name_or_path: A name that ``shipped_designs`` gives, or a file. Lengths in it are in mm,
            pressures and stresses in MPa.

    Raises:
        DesignError: There is neither, or the file describes no design; one sentence for each
            problem.
    """
    return Design.of(LIBRARY.named_or_at(name_or_path))
