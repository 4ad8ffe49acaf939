"""The base of the records of own bodies."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field, ValidationError, model_validator

from bellows_design.errors import DesignError
from bellows_design.validation.parameters import Parameters
from bellows_design.validation.sentences import sentences


class BodyRecord(Parameters):
    """Frozen table of an own body's file; lists stand for tuples.

    Raises:
        DesignError: A value leaves its bounds; one sentence for each problem.
    """

    def __init__(self, /, **data: Any) -> None:
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise DesignError(*sentences(error, type(self))) from None

    @model_validator(mode="before")
    @classmethod
    def _lists_are_tuples(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        return {key: _as_tuple(value) for key, value in data.items()}


def _as_tuple(value: Any) -> Any:
    """A list of a file as a tuple, and the lists in it."""
    return tuple(_as_tuple(each) for each in value) if isinstance(value, list) else value


def _listed(value: Any) -> Any:
    """One name as a list of names."""
    return (value,) if isinstance(value, str) else value


Number = Annotated[float, Field(ge=-1e6, le=1e6)]
Vector = tuple[Number, Number, Number]
"""Three numbers: x, y, z."""

Names = Annotated[tuple[str, ...], BeforeValidator(_listed)]
"""Names of surfaces; a single one may stand by itself."""
