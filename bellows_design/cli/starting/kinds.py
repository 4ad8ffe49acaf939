"""What a file to start from holds, and what is listed. Imports nothing heavy: help names them."""

from __future__ import annotations

from enum import StrEnum


class Kind(StrEnum):
    """What a file to start from holds."""

    DESIGN = "design"
    SCENE = "scene"
    PRINTER = "printer"
    FILAMENT = "filament"
    MATERIAL = "material"
    BODY = "body"


class Listed(StrEnum):
    """What may be listed."""

    DESIGNS = "designs"
    MATERIALS = "materials"
    PRINTERS = "printers"
    FILAMENTS = "filaments"
    SCENES = "scenes"
    KEYS = "keys"
    ALL = "all"
