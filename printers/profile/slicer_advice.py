"""The record of slicer settings that were reported together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import Field, model_validator

from printers.profile.quantities import Celsius, Flow, Percent, Text, quantity
from printers.validation import Record

Seam = Literal["random", "aligned", "nearest", "rear"]
"""Where loops begin and end: the choices that slicers have."""


def refuse_earlier_flows(table: Mapping[str, Any]) -> None:
    """Raise ValueError, with what replaced them, for keys that `[slicer]` had once."""
    if "perimeter_flow" in table or "infill_flow" in table:
        raise ValueError(
            "perimeter_flow and infill_flow are one key now, flow in [slicer], as slicers have "
            "one multiplier for both"
        )


class SlicerAdvice(Record):
    """Slicer settings that were reported together: one window, not independent limits.

    In a file, temperatures and flows that are left out are those of the filament.

    Attributes:
        nozzle_temperature: °C.
        first_layer_temperature: Of the nozzle, °C.
        bed_temperature: °C.
        print_speed: mm/s.
        maximum_volumetric_flow: mm³/s.
        flow: Percent of the nominal extrusion, of perimeters and infill alike: slicers have one
            multiplier for both.
        infill_density: Percent.
        infill_overlap: Percent of a line by which infill runs into the perimeters.
        fan: Percent.
        perimeters: Loops on each side of a wall.
        retraction: Whether the filament is pulled back before travels.
        supports: Whether supports are printed.
        seam: Where loops begin and end.
        sources: Where the settings were reported.

    Raises:
        PrintersError: One sentence on an unknown key, NaN or a value out of bounds.

    Examples:
        >>> from printers import load_profile
        >>> advice = load_profile("prusa_i3").slicer
        >>> print(f"{advice.nozzle_temperature:g} °C, {advice.print_speed:g} mm/s")
        238 °C, 15 mm/s
    """

    nozzle_temperature: Celsius = Field(description="of the nozzle")
    first_layer_temperature: Celsius = Field(description="of the nozzle, for the first layer")
    bed_temperature: Celsius = Field(description="of the bed")
    print_speed: float = quantity("mm/s", "of the nozzle, within the flow below", gt=0, le=500)
    maximum_volumetric_flow: float = quantity("mm³/s", "plastic melted at most", gt=0, le=100)
    flow: Flow = Field(description="of the nominal extrusion, of perimeters and infill alike")
    infill_density: Percent = Field(description="of the infill")
    infill_overlap: Percent = Field(description="of infill over perimeters")
    fan: Percent = Field(description="of its speed")
    perimeters: int = Field(ge=1, le=20, description="loops on each side of a wall")
    retraction: bool = Field(description="whether the filament is pulled back before travels")
    supports: bool = Field(description="whether supports are printed")
    seam: Seam = Field(description="where loops begin and end")
    sources: tuple[Text, ...] = Field(
        min_length=1, strict=False, description="where the settings were reported"
    )

    @model_validator(mode="before")
    @classmethod
    def _written_for_an_earlier_version(cls, table: Any) -> Any:
        """What files of earlier versions hold is answered with what replaced it."""
        if not isinstance(table, dict):
            return table
        refuse_earlier_flows(table)
        if table.get("seam") == "staggered":
            raise ValueError('seam is "staggered", which no slicer offers; write "random"')
        return table
