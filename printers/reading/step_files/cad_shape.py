"""The shape in a STEP file, by the CAD kernel, which hands lengths on in mm."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from printers.errors import PrintersError

SEWING = 1e-3
"""mm. Faces that lie side by side without sharing an edge are joined across gaps up to this."""


@dataclass(frozen=True)
class CadShape:
    """A shape of the kernel (a `TopoDS_Shape`), the units of its file, and notes on it."""

    shape: Any
    units: str
    notes: tuple[str, ...]


def shape_in(path: Path) -> CadShape:
    """All that the file at `path` holds. Raises PrintersError."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_Controller, STEPControl_Reader

    STEPControl_Controller.Init_s()
    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise PrintersError("the CAD kernel finds no STEP in it")
    _require_whole(reader)
    units = _units(reader)
    reader.TransferRoots()
    if not reader.NbShapes():
        raise PrintersError("it holds no shape")
    return _sewn(reader.OneShape(), units)


def _require_whole(reader: Any) -> None:
    """Entities that name others which the file lacks: the rest would be half a part."""
    fails = reader.WS().Model().GlobalCheck().NbFails()
    if fails:
        raise PrintersError(f"it is damaged: {fails} of its references lead nowhere")


def _units(reader: Any) -> str:
    """Of lengths, as the file names them."""
    from OCP.TColStd import TColStd_SequenceOfAsciiString

    lengths, angles, solid_angles = (TColStd_SequenceOfAsciiString() for _ in range(3))
    reader.FileUnits(lengths, angles, solid_angles)
    names = {lengths.Value(i + 1).ToCString() for i in range(lengths.Length())}
    return " and ".join(sorted(names)) or "not stated: taken as mm"


def _sewn(shape: Any, units: str) -> CadShape:
    """The shape; its faces joined where they enclose no solid yet."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Sewing
    from OCP.TopAbs import TopAbs_ShapeEnum

    solids = _count(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    if not _count(shape, TopAbs_ShapeEnum.TopAbs_FACE):
        raise PrintersError("it holds no surface")
    if solids:
        notes = (f"{solids} solids in one file",) if solids > 1 else ()
        return CadShape(shape, units, notes)
    sewing = BRepBuilderAPI_Sewing(SEWING)
    sewing.Add(shape)
    sewing.Perform()
    return CadShape(sewing.SewedShape(), units, ("it holds faces, but no solid that they bound",))


def _count(shape: Any, kind: Any) -> int:
    from OCP.TopExp import TopExp
    from OCP.TopTools import TopTools_IndexedMapOfShape

    found = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, kind, found)
    return int(found.Extent())
