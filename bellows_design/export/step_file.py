"""STEP: the exact solid, in the same bytes whenever it is written.

The CAD kernel puts the time into the header and counts what a process has written in the names of
products. Both are replaced: by a fixed time, as a header must have one, and by the part's name.
"""

from __future__ import annotations

from io import BytesIO
from typing import Any

from bellows_design.errors import BellowsError
from bellows_design.export.part import Part

TIME_STAMP = "1970-01-01T00:00:00"
"""Of every file; when a part was exported stands in ``run.json``."""


def step_file(part: Part) -> bytes:
    """The solid of ``part`` as STEP, mm. Raises ``BellowsError`` if it cannot be written."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import (
        STEPControl_Controller,
        STEPControl_StepModelType,
        STEPControl_Writer,
    )

    STEPControl_Controller.Init_s()
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    writer = STEPControl_Writer()
    writer.Transfer(part.solid.wrapped, STEPControl_StepModelType.STEPControl_AsIs)
    _head(writer.Model(), part)
    _name(writer.Model(), part)
    content = BytesIO()
    if writer.WriteStream(content) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise BellowsError(f"the CAD kernel could not write {part.name} as STEP")
    return content.getvalue()


def _head(model: Any, part: Part) -> None:
    """Write name, digest and origin into the header."""
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader

    header = APIHeaderSection_MakeHeader(model)
    header.SetName(_text(part.name))
    header.SetTimeStamp(_text(TIME_STAMP))
    header.SetDescriptionValue(1, _text(f"digest {part.digest}"))
    header.SetAuthorValue(1, _text(""))
    header.SetOriginatingSystem(_text("bellows-design"))


def _name(model: Any, part: Part) -> None:
    """Call every product by the part's name alone."""
    from OCP.StepBasic import StepBasic_Product

    for number in range(1, model.NbEntities() + 1):
        entity = model.Value(number)
        if isinstance(entity, StepBasic_Product):
            entity.SetId(_text(part.name))
            entity.SetName(_text(part.name))


def _text(text: str) -> Any:
    from OCP.TCollection import TCollection_HAsciiString

    return TCollection_HAsciiString(text)
