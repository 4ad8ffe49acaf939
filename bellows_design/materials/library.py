"""The library of materials: those that come with the package, and those of other packages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import ValidationError

from bellows_design.errors import DesignError
from bellows_design.files.atomic import replacing
from bellows_design.files.toml_files import TomlLibrary, read_toml
from bellows_design.materials.laws import LAWS
from bellows_design.materials.material import Material
from bellows_design.validation.sentences import sentences

ENTRY_POINTS = "bellows_design.materials"
"""Entry-point group: each entry names an importable package that holds ``NAME.toml`` files."""

LIBRARY = TomlLibrary("material", "bellows_design.materials", group=ENTRY_POINTS)


def load_material(name: str) -> Material:
    """The library's material of that name.

    Args:
        name: One of ``material_names``.

    Returns:
        The material; its moduli and strengths are in MPa.

    Raises:
        DesignError: The library has none of that name (the sentence names those that look alike),
            or its file cannot be read or describes no material.
    """
    return checked_material(LIBRARY.named(name))


def material_at(path: Path) -> Material:
    """The material in the TOML file at ``path``, such as ``bellows fit`` writes.

    Raises:
        DesignError: There is no such file, or it describes no material.
    """
    return checked_material(read_toml(path, str(path), LIBRARY.noun))


def material_names() -> tuple[str, ...]:
    """Names of all materials of the library, the shipped ones and those of other packages."""
    return LIBRARY.names()


def checked_material(table: dict[str, Any]) -> Material:
    """The material of a plain table. Raises ``DesignError``."""
    try:
        return Material.model_validate(table)
    except ValidationError as error:
        raise DesignError(*sentences(error, Material)) from None


def written(material: Material) -> dict[str, Any]:
    """The table of a material's file: constants of other laws than Ogden's by their names."""
    table = material.model_dump(mode="json", exclude_none=True)
    names = LAWS[material.model].constants
    table |= dict(zip(names, table.pop("constants"), strict=True))
    return {key: value for key, value in table.items() if value != []}


def write_material(material: Material, path: Path) -> None:
    """Write ``material`` as TOML, in the form of the library's; completely or not at all.

    Raises:
        OSError: The file cannot be written.
    """
    import tomli_w

    with replacing(path) as temporary:
        temporary.write_text(tomli_w.dumps(written(material)), "utf-8")
