"""Parameters of a thing with a name, whose mistakes are sentences."""

from __future__ import annotations

from typing import Any

from pydantic import Field, ValidationError, field_validator

from bellows_design.errors import DesignError
from bellows_design.validation.file_names import require_file_name
from bellows_design.validation.parameters import Parameters, require
from bellows_design.validation.quoting import quoted
from bellows_design.validation.sentences import sentences


class Labelled(Parameters):
    """Parameters with a name that may name files, and a description.

    Raises:
        DesignError: A value leaves its bounds; one sentence for each problem.
    """

    name: str = Field(description="letters, digits, _ and -, at most 64; names files and folders")
    description: str = Field(default="", max_length=2000, description="one line of text")

    def __init__(self, /, **data: Any) -> None:  # "self" may be a key of the file
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise DesignError(*sentences(error, type(self))) from None

    @field_validator("name")
    @classmethod
    def _names_a_file(cls, name: str) -> str:
        require_file_name(name)
        return name

    @field_validator("description")
    @classmethod
    def _is_printable(cls, description: str) -> str:
        require(
            description.isprintable(),
            f"description is {quoted(description)} but must be printable text on one line",
        )
        return description
