"""The expected size of a mesh against the mesh, for bodies that are no bellows."""

from __future__ import annotations

import math
from io import BytesIO

import cadquery as cq
import numpy as np
import pytest

from solver.meshing.estimate import (
    BodySize,
    FaceSize,
    expected_elements,
    expected_elements_of_parts,
    expected_memory,
)
from solver.meshing.parts import Part, mesh_solids
from solver.meshing.solid import MeshOptions, SizeField, mesh_solid

BALL = cq.Solid.makeSphere(5.0, angleDegrees1=-90)
BOX = cq.Solid.makeBox(10, 8, 6)
PLATE = cq.Solid.makeBox(40, 30, 1)
TUBE = cq.Solid.makeCylinder(5.0, 20.0).cut(cq.Solid.makeCylinder(4.0, 20.0)).Solids()[0]


def size_of(solid: cq.Solid, radius: float = math.inf) -> BodySize:
    faces = [
        FaceSize(
            face.Area(),
            tuple(edge.Length() for edge in face.Edges()),
            math.inf if face.geomType() == "PLANE" else radius,
        )
        for face in solid.Faces()
    ]
    return BodySize(solid.Volume(), solid.BoundingBox().DiagonalLength, faces)


def brep(solid: cq.Solid) -> bytes:
    content = BytesIO()
    solid.exportBrep(content)
    return content.getvalue()


@pytest.mark.parametrize(
    ("solid", "radius", "options"),
    [
        pytest.param(PLATE, math.inf, MeshOptions(1.33, 0), id="wall"),
        pytest.param(TUBE, 4.0, MeshOptions(1.33, 0), id="tube"),
        pytest.param(TUBE, 4.0, MeshOptions(1.33, 30), id="tube by its curvature"),
        pytest.param(BOX, math.inf, MeshOptions(0.9, 0), id="box"),
        pytest.param(BALL, 5.0, MeshOptions(0.9, 0), id="ball"),
    ],
)
def test_the_number_of_elements_is_known_within_a_factor(
    solid: cq.Solid, radius: float, options: MeshOptions
) -> None:
    mesh = mesh_solid(brep(solid), ["skin"] * len(solid.Faces()), options)
    assert 1 / 1.6 < expected_elements(size_of(solid, radius), options) / len(mesh.tets) < 1.6


def test_a_field_counts() -> None:
    names = ["skin"] * len(BOX.Faces())
    coarse = mesh_solid(brep(BOX), names, MeshOptions(2.0, 0))
    wanted = np.where(coarse.nodes[:, 0] < 3, 0.5, 1.5)
    options = MeshOptions(2.0, 0, field=SizeField(coarse, wanted))
    fine = mesh_solid(brep(BOX), names, options)
    assert 1 / 1.5 < expected_elements(size_of(BOX), options) / len(fine.tets) < 1.5


@pytest.mark.parametrize("size", [None, 0.5])
def test_elements_of_touching_parts_are_known_within_a_factor(size: float | None) -> None:
    film = cq.Solid.makeBox(10, 8, 0.5, cq.Vector(0, 0, -0.5))
    solids, sizes, options = (BOX, film), (None, size), MeshOptions(1.2, 0)
    parts = [
        Part(str(number), brep(solid), ["skin"] * 6, own)
        for number, (solid, own) in enumerate(zip(solids, sizes, strict=True))
    ]
    expected = expected_elements_of_parts([size_of(solid) for solid in solids], options, sizes)
    assert 1 / 1.6 < expected / len(mesh_solids(parts, options).tets) < 1.6


@pytest.mark.parametrize(
    ("unknowns", "measured"),
    [(18_425, 747), (48_774, 954), (77_940, 1038), (192_623, 1777), (282_014, 2351)],
)
def test_the_law_of_memory_is_the_measured_one(unknowns: int, measured: float) -> None:
    """MiB of the table in docs/accuracy.md: unit cell and half of Prototype 1."""
    assert expected_memory(unknowns / 6.2) / 2**20 == pytest.approx(measured, rel=0.06)
