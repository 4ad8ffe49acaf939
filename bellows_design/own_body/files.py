"""Own bodies as files: a TOML file, and the STEP files of its parts beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.files.atomic import replacing
from bellows_design.files.guarded import read_file
from bellows_design.files.toml_files import read_toml
from bellows_design.materials.library import load_material, material_names
from bellows_design.materials.library import written as written_material
from bellows_design.materials.material import Material
from bellows_design.own_body.body import OwnBody
from bellows_design.own_body.step import solids_in, step_of
from bellows_design.validation.quoting import quoted, quoted_path, quoted_reason

NOUN = "body"

LARGEST_STEP = 256 * 2**20
"""Bytes."""


def load_body(path: str | Path) -> OwnBody:
    """The own body in a TOML file.

    Args:
        path: The file. Lengths in it are in mm, pressures and stresses in MPa; STEP files and
            materials that it names are looked for from its folder.

    Raises:
        DesignError: There is no such file, or it describes no body; one sentence for each problem.
    """
    path = Path(path)
    return body_of(read_toml(path, str(path), NOUN), path.parent)


def body_of(table: Mapping[str, Any], folder: Path) -> OwnBody:
    """The body of a file's table, with the STEP files that it names from ``folder``.

    Raises ``DesignError``.
    """
    parts = table.get("parts")
    if not isinstance(parts, list) or not all(isinstance(part, dict) for part in parts):
        raise DesignError(f"parts is {quoted(parts)} but must be tables: [[parts]] for each part.")
    read: dict[Path, tuple[Any, ...]] = {}
    made = [_part(part, folder, read) for part in parts]
    return OwnBody.of({**table, "parts": made})


def _part(
    part: Mapping[str, Any], folder: Path, read: dict[Path, tuple[Any, ...]]
) -> dict[str, Any]:
    """A part with its solid in place of the name of its file."""
    left = {key: value for key, value in part.items() if key not in ("step", "solid")}
    step, number = part.get("step"), part.get("solid", 0)
    if not isinstance(step, str):
        raise DesignError(f"parts.step is {quoted(step)} but must be the name of a STEP file.")
    path = folder / step
    if path not in read:
        read[path] = _solids(path)
    solids = read[path]
    if type(number) is not int or not 0 <= number < len(solids):
        raise DesignError(
            f"parts.solid is {quoted(number)} but must be a whole number from 0 to "
            f"{len(solids) - 1}: {quoted_path(path)} holds {len(solids)} "
            f"solid{'s' * (len(solids) > 1)}."
        )
    material = left.get("material")
    if isinstance(material, str) and material.endswith(".toml"):
        left["material"] = str(folder / material)
    return {**left, "solid": solids[number]}


def _solids(path: Path) -> tuple[Any, ...]:
    from printers import PrintersError

    content = read_file(path, "STEP", LARGEST_STEP)
    try:
        return solids_in(content)
    except PrintersError as error:
        raise DesignError(f"STEP {quoted_path(path)}: {quoted_reason(error)}.") from None


def write_body(body: OwnBody, path: Path) -> None:
    """Write a body as TOML at ``path``, and each part's STEP file beside it.

    The STEP files, whose names begin with the TOML file's, are written first, each completely or
    not at all.

    Raises:
        DesignError: The name of a part cannot name a file.
        OSError: A file cannot be written.
    """
    import tomli_w

    from bellows_design.validation.file_names import SLUG

    table = body.table
    for part, written in zip(body.parts, table["parts"], strict=True):
        if not SLUG.fullmatch(part.name):
            raise DesignError(
                f"the part {quoted(part.name)} cannot name a file: use letters, digits, _ and -."
            )
        file = path.with_name(f"{path.stem}_{part.name}.step")
        with replacing(file) as temporary:
            temporary.write_bytes(step_of(part.solid))
        written |= {"step": file.name, "material": _material(part.material)}
    with replacing(path) as temporary:
        temporary.write_text(tomli_w.dumps(table), "utf-8")


def _material(material: Material) -> str | dict[str, Any]:
    """A material of the library by its name, another one as its table."""
    name = material.name
    if name in material_names() and material == load_material(name):
        return name
    return written_material(material)
