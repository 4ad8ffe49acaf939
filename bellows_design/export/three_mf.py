"""3MF: the checked mesh, placed on the bed as it is printed, in the same bytes whenever written.

The mesh keeps the coordinates of the design; where it stands is the transform of its item. The
identifiers that the production extension wants are made from the design's digest, not drawn.
"""

from __future__ import annotations

import uuid
from typing import Any

from bellows_design.export.part import Part
from bellows_design.export.placement import placement

NAMESPACE = "https://bellows-design.example/2026/3mf"
"""Identifies our metadata in a 3MF file; a name, not an address."""

SETTINGS = "/Metadata/Slic3r_PE.config"
"""Where PrusaSlicer keeps, and looks for, the settings that go with a model."""

SETTINGS_RELATION = f"{NAMESPACE}/settings"


def three_mf(part: Part, settings: str = "") -> bytes:
    """The mesh of ``part`` as 3MF, mm; with ``settings`` for PrusaSlicer if there are any."""
    import lib3mf

    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    model.SetUnit(lib3mf.ModelUnit.MilliMeter)
    _label(model, part)
    body = model.AddMeshObject()
    body.SetName(part.name)
    body.SetGeometry(
        [lib3mf.Position((x, y, z)) for x, y, z in part.mesh.vertices.tolist()],
        [lib3mf.Triangle((a, b, c)) for a, b, c in part.mesh.triangles.tolist()],
    )
    item = model.AddBuildItem(body, _transform(part))
    model.SetBuildUUID(_identifier(part, "build"))
    body.SetUUID(_identifier(part, "object"))
    item.SetUUID(_identifier(part, "item"))
    if settings:
        attached = model.AddAttachment(SETTINGS, SETTINGS_RELATION)
        attached.ReadFromBuffer(settings.encode())
    return bytes(model.QueryWriter("3mf").WriteToBuffer())


def _label(model: Any, part: Part) -> None:
    metadata = model.GetMetaDataGroup()
    for name, value in (
        ("Title", part.name),
        ("Description", part.description),
        ("Application", "bellows-design"),
    ):
        metadata.AddMetaData("", name, value, "xs:string", True)
    metadata.AddMetaData(NAMESPACE, "digest", part.digest, "xs:string", True)


def _transform(part: Part) -> Any:
    import lib3mf

    transform = lib3mf.Transform()
    for row, values in enumerate(placement(part).rows):
        for column, value in enumerate(values):
            transform.Fields[row][column] = value
    return transform


def _identifier(part: Part, of: str) -> str:
    """A UUID (RFC 9562, version 5) of one thing in the file of a design."""
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"{NAMESPACE}/{part.digest}/{of}"))
