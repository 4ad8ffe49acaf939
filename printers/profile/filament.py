"""The record of a filament: what a spool says, and what slicers ship for it."""

from __future__ import annotations

from pydantic import Field

from printers.profile.quantities import Celsius, Flow, Text, quantity
from printers.validation import Record

ADVISED = (
    "nozzle_temperature",
    "first_layer_temperature",
    "bed_temperature",
    "maximum_volumetric_flow",
    "flow",
)
"""Settings of a filament that hold where a printer's profile says nothing else."""


class Filament(Record):
    """One filament of one maker.

    Attributes:
        name: As it is loaded by.
        description: Maker and product, one line.
        diameter: mm.
        density: g/cm³.
        shore: Hardness with its scale, such as "85A".
        nozzle_temperature: °C.
        first_layer_temperature: Of the nozzle, °C.
        bed_temperature: °C.
        maximum_volumetric_flow: Plastic melted at most, mm³/s.
        flow: Percent of the nominal extrusion: the slicer's extrusion multiplier.
        sources: Where the numbers come from.

    Raises:
        PrintersError: One sentence on an unknown key, NaN or a value out of bounds.

    Examples:
        >>> from printers import load_filament
        >>> filament = load_filament("ninjaflex_85a")
        >>> print(filament.shore, f"{filament.density} g/cm³")
        85A 1.19 g/cm³
    """

    name: Text = Field(min_length=1, description="as it is loaded by")
    description: Text = Field(description="maker and product, one line")
    diameter: float = quantity("mm", "of the filament", ge=1, le=4)
    density: float = quantity("g/cm³", "of the plastic", ge=0.5, le=3)
    shore: Text = Field(description='hardness with its scale, such as "85A"')
    nozzle_temperature: Celsius = Field(description="of the nozzle")
    first_layer_temperature: Celsius = Field(description="of the nozzle, for the first layer")
    bed_temperature: Celsius = Field(description="of the bed")
    maximum_volumetric_flow: float = quantity("mm³/s", "plastic melted at most", gt=0, le=100)
    flow: Flow = Field(description="of the nominal extrusion: the extrusion multiplier")
    sources: tuple[Text, ...] = Field(
        min_length=1, strict=False, description="where the numbers come from"
    )
