"""The designs that come with the package, and designs in files of the user."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bellows_design.design.design import Design, is_toml
from bellows_design.errors import DesignError
from bellows_design.files.toml_files import TomlLibrary
from bellows_design.validation.quoting import quoted_path

LIBRARY = TomlLibrary("design", "bellows_design.design", folder="designs")


def shipped_designs() -> tuple[str, ...]:
    """Names of the designs that come with the package, sorted.

    Examples:
        >>> from bellows_design import shipped_designs
        >>> print("finger" in shipped_designs())
        True
    """
    return LIBRARY.names()


def is_own_body(table: Mapping[str, Any]) -> bool:
    """Whether a table of a file is that of a body of one's own: it has parts and no bellows."""
    return "parts" in table and "bellows" not in table


def load_design(name_or_path: str | Path) -> Design:
    """The shipped design of that name, else the design in the TOML file at that path.

    Args:
        name_or_path: A name that ``shipped_designs`` gives, or a file. Lengths in it are in mm,
            pressures and stresses in MPa. Files of a material or printer that it names are
            looked for from its folder.

    Raises:
        DesignError: There is neither, or the file describes no design; one sentence for each
            problem.

    Examples:
        >>> from bellows_design import load_design
        >>> print(load_design("prototype_1").bellows.bubble_width, "mm")
        20.0 mm
    """
    table, path = LIBRARY.named_or_at(name_or_path), LIBRARY.path_of(name_or_path)
    if is_own_body(table):
        raise DesignError(
            f"{quoted_path(name_or_path)} is a body of one's own, which only evaluate and compare "
            "take; here a design of bellows is needed."
        )
    return Design.of(table if path is None else _with_files_from(path.parent, table))


def _with_files_from(folder: Path, table: dict[str, Any]) -> dict[str, Any]:
    """The table with the files that it names as paths from here."""
    files = {
        key: str(folder / table[key])
        for key in ("material", "printer")
        if isinstance(table.get(key), str) and is_toml(table[key])
    }
    return table | files
