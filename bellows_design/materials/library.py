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

    Examples:
        >>> from bellows_design import load_material
        >>> rubber = load_material("dragon_skin_30")
        >>> print(f"{rubber.initial_shear_modulus:.3f} MPa, tested to {rubber.valid_strain[1]:.0%}")
        0.178 MPa, tested to 300%
    """
    return checked_material(LIBRARY.named(name))


def material_at(path: Path) -> Material:
    """The material in the TOML file at ``path``, such as ``bellows fit`` writes.

    Raises:
        DesignError: There is no such file, or it describes no material.
    """
    return checked_material(read_toml(path, str(path), LIBRARY.noun))


def material_names() -> tuple[str, ...]:
    """Names of all materials of the library, the shipped ones and those of other packages.

    Examples:
        >>> from bellows_design.materials import material_names
        >>> print([name for name in material_names() if name.startswith("ecoflex")])
        ['ecoflex_00_30', 'ecoflex_00_50']
    """
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

    Args:
        material: Its moduli and strengths are in MPa.
        path: Of the file, whose folder is there; a file of that name is replaced.

    Raises:
        OSError: The file cannot be written.

    Examples:
        >>> from pathlib import Path
        >>> from bellows_design.design import load_design, with_overrides
        >>> from bellows_design.materials import Material, write_material
        >>> mine = Material(name="mine", model="neo-hooke", c10=0.2, yield_strength=3.0)  # MPa
        >>> write_material(mine, Path("mine.toml"))
        >>> design = with_overrides(load_design("finger"), ["material=mine.toml"])
        >>> print(design.material == mine)
        True
    """
    import tomli_w

    with replacing(path) as temporary:
        temporary.write_text(tomli_w.dumps(written(material)), "utf-8")
