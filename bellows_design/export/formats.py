"""File formats of a part: one writer, and one reader that checks it, for each suffix.

Lengths are millimetres in all of them. STL and 3MF hold the checked triangle mesh itself, STEP
the exact solid. All are made in memory: libraries that write files themselves know not every name
that a file may have, and abort on a full disk. A new format is two functions, of which the second
stands in ``read_back``, and one line in ``WRITERS``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from types import MappingProxyType

from bellows_design.errors import BellowsError, DesignError
from bellows_design.export.part import Part as Part
from bellows_design.export.read_back import require_same
from bellows_design.files.atomic import replacing
from bellows_design.validation.quoting import quoted

NAMESPACE = "https://bellows-design.example/2026/3mf"
"""Identifies our metadata in a 3MF file; a name, not an address."""


Writer = Callable[[Part], bytes]
"""Makes the content of a file."""


def write_part(part: Part, path: Path | str) -> None:
    """Write ``part`` in the format of ``path``'s suffix, completely or not at all.

    What was written is read back and compared. Raises ``DesignError`` for an unknown suffix and
    ``CannotWrite``, an ``OSError``, if the file cannot be written or does not hold the part.
    """
    path = Path(path)
    content = writer_for(path)(part)
    with replacing(path) as temporary:
        temporary.write_bytes(content)
        require_same(part, temporary, content)


def writer_for(path: Path) -> Writer:
    """The writer for ``path``'s suffix. Raises ``DesignError`` if there is none."""
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise DesignError(
            f"{quoted(str(path))} must end in {', '.join(WRITERS)}: the suffix chooses the format."
        )
    return writer


def _stl(part: Part) -> bytes:
    """Binary STL; its 80-byte header names the design."""
    import trimesh
    from trimesh.exchange.stl import export_stl

    mesh = trimesh.Trimesh(part.mesh.vertices, part.mesh.triangles, process=False)
    header = f"bellows-design {part.name} {part.digest[:16]} mm".encode("ascii")[:80].ljust(80)
    return header + export_stl(mesh)[80:]


def _3mf(part: Part) -> bytes:
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
    return bytes(model.QueryWriter("3mf").WriteToBuffer())


def _step(part: Part) -> bytes:
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
    content = BytesIO()
    if writer.WriteStream(content) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise BellowsError(f"the CAD kernel could not write {part.name} as STEP")
    return content.getvalue()


WRITERS: Mapping[str, Writer] = MappingProxyType({".stl": _stl, ".3mf": _3mf, ".step": _step})
"""Suffix -> writer."""
