"""Contents of files that hold a part, as other programs write them, and broken ones."""

from __future__ import annotations

import struct
import zipfile
from io import BytesIO

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
MODEL = "3D/3dmodel.model"


def binary_stl(vertices: Floats, triangles: Ints, header: bytes = b"") -> bytes:
    """Each facet 50 bytes: normal, corners, two bytes of anything."""
    facets = np.zeros(
        len(triangles), np.dtype([("n", "<f4", 3), ("corners", "<f4", (3, 3)), ("a", "<u2")])
    )
    facets["corners"] = vertices[triangles]
    return header[:80].ljust(80) + struct.pack("<I", len(triangles)) + facets.tobytes()


def text_stl(vertices: Floats, triangles: Ints, end: str = "\n", name: str = "part") -> bytes:
    """The same as text."""
    lines = [f"solid {name}"]
    for corners in vertices[triangles].tolist():
        lines += ["  facet normal 0 0 0", "    outer loop"]
        lines += [f"      vertex {x:.9g} {y:.9g} {z:.9e}" for x, y, z in corners]
        lines += ["    endloop", "  endfacet"]
    return (end.join([*lines, f"endsolid {name}"]) + end).encode()


def mesh_xml(vertices: Floats, triangles: Ints) -> str:
    """The mesh of an object."""
    points = "".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in vertices.tolist())
    facets = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles.tolist())
    return f"<mesh><vertices>{points}</vertices><triangles>{facets}</triangles></mesh>"


def object_xml(number: int, content: str, kind: str = "model") -> str:
    """An object of a mesh or of components."""
    return f'<object id="{number}" type="{kind}">{content}</object>'


def model_xml(objects: str, build: str, unit: str | None = "millimeter") -> str:
    """A whole model file."""
    stated = "" if unit is None else f' unit="{unit}"'
    return (
        f'<?xml version="1.0" encoding="UTF-8"?><model{stated} xmlns="{CORE}" '
        f'xmlns:p="{PRODUCTION}"><metadata name="Title">x</metadata>'
        f"<resources>{objects}</resources><build>{build}</build></model>"
    )


def package(xml: str | bytes, packing: int = zipfile.ZIP_DEFLATED, **others: str) -> bytes:
    """A 3MF file with the model file `xml`, and others by their names."""
    content = BytesIO()
    with zipfile.ZipFile(content, "w", packing) as archive:
        archive.writestr(MODEL, xml)
        for name, text in others.items():
            archive.writestr(name, text)
    return content.getvalue()


def three_mf(vertices: Floats, triangles: Ints, unit: str | None = "millimeter") -> bytes:
    """A 3MF file of one object."""
    objects = object_xml(1, mesh_xml(vertices, triangles))
    return package(model_xml(objects, '<item objectid="1"/>', unit))
