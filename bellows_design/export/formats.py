"""File formats of a part: one writer for each suffix.

Lengths are millimetres in all of them. STL and 3MF hold the checked triangle mesh itself, STEP
the exact solid. A new format is one more function and one more line in ``WRITERS``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from bellows_design.errors import DesignError
from bellows_design.files.atomic import replacing
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    import cadquery as cq

NAMESPACE = "https://bellows-design.example/2026/3mf"
"""Identifies our metadata in a 3MF file; a name, not an address."""


@dataclass(frozen=True)
class Part:
    """A design's solid and mesh together with the labels its files carry."""

    name: str
    description: str
    digest: str
    solid: cq.Solid
    mesh: ClosedMesh


Writer = Callable[[Part, Path], None]


def write_part(part: Part, path: Path | str) -> None:
    """Write ``part`` in the format of ``path``'s suffix, completely or not at all.

    Raises ``DesignError`` for an unknown suffix and ``OSError`` if the file cannot be written.
    """
    path = Path(path)
    writer = writer_for(path)
    with replacing(path) as temporary:
        writer(part, temporary)


def writer_for(path: Path) -> Writer:
    """The writer for ``path``'s suffix. Raises ``DesignError`` if there is none."""
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise DesignError(
            f"{quoted(str(path))} must end in {', '.join(WRITERS)}: the suffix chooses the format."
        )
    return writer


def _write_stl(part: Part, path: Path) -> None:
    """Binary STL; its 80-byte header names the design."""
    import trimesh
    from trimesh.exchange.stl import export_stl

    mesh = trimesh.Trimesh(part.mesh.vertices, part.mesh.triangles, process=False)
    header = f"bellows-design {part.name} {part.digest[:16]} mm".encode("ascii")[:80].ljust(80)
    path.write_bytes(header + export_stl(mesh)[80:])


def _write_3mf(part: Part, path: Path) -> None:
    import lib3mf

    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    model.SetUnit(lib3mf.ModelUnit.MilliMeter)
    metadata = model.GetMetaDataGroup()
    for name, value in (
        ("Title", part.name),
        ("Description", part.description),
        ("Application", "bellows-design"),
    ):
        metadata.AddMetaData("", name, value, "xs:string", True)
    metadata.AddMetaData(NAMESPACE, "digest", part.digest, "xs:string", True)
    body = model.AddMeshObject()
    body.SetName(part.name)
    body.SetGeometry(
        [lib3mf.Position((x, y, z)) for x, y, z in part.mesh.vertices.tolist()],
        [lib3mf.Triangle((a, b, c)) for a, b, c in part.mesh.triangles.tolist()],
    )
    model.AddBuildItem(body, wrapper.GetIdentityTransform())
    model.QueryWriter("3mf").WriteToFile(str(path))


def _write_step(part: Part, path: Path) -> None:
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import (
        STEPControl_Controller,
        STEPControl_StepModelType,
        STEPControl_Writer,
    )
    from OCP.TCollection import TCollection_HAsciiString

    STEPControl_Controller.Init_s()
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetCVal_s("write.step.product.name", part.name)
    writer = STEPControl_Writer()
    writer.Transfer(part.solid.wrapped, STEPControl_StepModelType.STEPControl_AsIs)
    header = APIHeaderSection_MakeHeader(writer.Model())
    header.SetName(TCollection_HAsciiString(part.name))
    header.SetDescriptionValue(1, TCollection_HAsciiString(f"digest {part.digest}"))
    header.SetAuthorValue(1, TCollection_HAsciiString(""))
    header.SetOriginatingSystem(TCollection_HAsciiString("bellows-design"))
    status = writer.Write(str(path))
    if status != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OSError(f"the CAD kernel could not write {path.name}")


WRITERS: Mapping[str, Writer] = MappingProxyType(
    {".stl": _write_stl, ".3mf": _write_3mf, ".step": _write_step}
)
"""Suffix -> writer."""
