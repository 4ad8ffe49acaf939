"""The conditions of a design: the load it must carry and the limits it must keep."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field, SerializerFunctionWrapHandler, field_validator, model_serializer
from pydantic_core import PydanticKnownError

from bellows_design.design.lengths import length_field
from bellows_design.validation.parameters import Parameters, require
from bellows_design.validation.quoting import quoted

ATMOSPHERE = 0.101325
"""MPa. The standard atmosphere: no vacuum pulls more."""

LEAST_PRESSURE = 0.001
"""MPa, of either sign."""

LeakTestSetting = Literal["off", "if-available", "required"]
"""Whether what a slicer makes of the part is tested for leaks before the part is approved."""


class Load(Parameters):
    """What the actuator must carry: a pressure in MPa.

    The bounds are the full vacuum and the 6 bar of workshop air, and 10 mbar of either: wide for a
    soft actuator, yet narrow enough that 0.1 MPa given in bar, kPa or Pa falls outside.

    Examples:
        >>> from bellows_design import Load
        >>> try:
        ...     Load(pressure=100)  # kPa by mistake
        ... except ValueError as error:
        ...     print("less than or equal to 0.6" in str(error))
        True
    """

    pressure: float = Field(
        default=0.1,
        ge=-ATMOSPHERE,
        le=0.6,
        description="design pressure inside the chambers over that outside, negative for a vacuum",
        json_schema_extra={"unit": "MPa", "least": LEAST_PRESSURE},
    )

    @field_validator("pressure")
    @classmethod
    def _is_a_load(cls, pressure: float) -> float:
        if 0 <= pressure < LEAST_PRESSURE:
            raise PydanticKnownError("greater_than_equal", {"ge": LEAST_PRESSURE})
        if -LEAST_PRESSURE < pressure < 0:
            raise PydanticKnownError("less_than_equal", {"le": -LEAST_PRESSURE})
        return pressure


class Limits(Parameters):
    """What an approved design must keep, besides the printer's rules: stress in MPa, room in mm.

    ``leak_test`` says whether the part must pass the leak test on a slicer's G-code as well,
    ``scenes`` names those under whose loads the actuator must hold, too.

    Examples:
        >>> from bellows_design import Limits
        >>> print(Limits(max_von_mises=3.5, cross_section_width=24).cross_section_height, "mm")
        20.0 mm
    """

    max_von_mises: float | None = Field(
        default=None,
        ge=0.01,
        le=200,
        description="highest von Mises stress; without it the material's yield strength",
        json_schema_extra={"unit": "MPa"},
    )
    cross_section_width: float = length_field(4, 250, "room along y", 20.0)
    cross_section_height: float = length_field(4, 250, "room along z", 20.0)
    leak_test: LeakTestSetting = Field(
        default="if-available", description="whether a slicer's G-code must pass the leak test"
    )
    scenes: tuple[str, ...] = Field(
        default=(),
        max_length=20,
        description="names of scenes that approval must hold",
        examples=[["blocked"]],
    )

    @field_validator("scenes", mode="before")
    @classmethod
    def _is_a_list_of_names(cls, value: Any) -> tuple[str, ...]:
        names = isinstance(value, list | tuple) and all(isinstance(each, str) for each in value)
        require(names, f"limits.scenes is {quoted(value)} but must be a list of names of scenes")
        return tuple(dict.fromkeys(value))

    @model_serializer(mode="wrap")
    def _without_empty_scenes(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Limits without scenes are written as they were before there were any."""
        table: dict[str, Any] = handler(self)
        return {key: value for key, value in table.items() if key != "scenes" or value}
