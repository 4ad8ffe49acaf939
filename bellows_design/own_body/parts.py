"""A part of an own body: a CAD solid and what it is made of."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import cadquery as cq
from pydantic import ConfigDict, Field, field_validator

from bellows_design.geometry.named_solids import named
from bellows_design.materials.library import load_material, material_at
from bellows_design.materials.material import Material
from bellows_design.own_body.record import BodyRecord
from bellows_design.own_body.selection import BETWEEN
from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import quoted


class BodyPart(BodyRecord):
    """One solid of one material.

    Attributes:
        name: Of the part; it names its region of the mesh.
        solid: Its shape, mm; no part of what is written as JSON.
        material: The material, or the name of one of the library, or a TOML file.
        density_kg_m3: Needed where gravity acts, kg/m³.
        size: Longest edge of the mesh in this part, mm, if less than elsewhere.

    Examples:
        >>> import cadquery as cq
        >>> from bellows_design import BodyPart
        >>> bar = BodyPart(name="bar", solid=cq.Solid.makeBox(40, 10, 10), material="ecoflex_00_30")
        >>> print(bar.material.initial_shear_modulus, "MPa")
        0.01435 MPa
    """

    model_config = ConfigDict(arbitrary_types_allowed=True)

    name: str = Field(min_length=1, max_length=64, description="names the part")
    solid: cq.Solid = Field(exclude=True, repr=False)
    material: Material
    density_kg_m3: float | None = Field(
        default=None, gt=0, le=30_000, json_schema_extra={"unit": "kg/m³"}
    )
    size: float | None = Field(default=None, gt=0, le=1000, json_schema_extra={"unit": "mm"})

    @field_validator("name")
    @classmethod
    def _is_one_word(cls, name: str) -> str:
        require(
            name.isprintable() and BETWEEN not in name,
            f"the name of a part is {quoted(name)} but must be printable, without {BETWEEN}",
        )
        return name

    @field_validator("solid", mode="before")
    @classmethod
    def _is_one_solid(cls, value: Any) -> Any:
        """The only solid of a shape or a ``Workplane``."""
        shape: Any = value.val() if isinstance(value, cq.Workplane) else value
        require(
            isinstance(shape, cq.Shape), f"solid is {quoted(value)} but must be a CadQuery solid"
        )
        solids = shape.Solids()
        require(len(solids) == 1, f"a part must be one solid, not {len(solids)}")
        require(solids[0].isValid(), "the CAD kernel says that the solid of a part is not valid")
        return solids[0]

    @field_validator("material", mode="before")
    @classmethod
    def _material_of_library(cls, value: Any) -> Any:
        if not isinstance(value, str):
            return value
        return material_at(Path(value)) if value.endswith(".toml") else load_material(value)

    @property
    def brep(self) -> bytes:
        """The solid as the CAD kernel writes it."""
        return named(self.solid, "").brep

    @property
    def shape_digest(self) -> str:
        """SHA-256 of the solid, as 64 hexadecimal digits."""
        return hashlib.sha256(self.brep).hexdigest()
