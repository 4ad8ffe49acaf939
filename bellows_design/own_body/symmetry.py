"""What planes of symmetry ask of a body: plane faces, and weight along them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.own_body.conditions import AXES, Axis, Gravity
from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    import cadquery as cq

    from bellows_design.own_body.parts import BodyPart

ALIGNED = 1e-6
"""Part of a unit vector by which it may be off its axis."""

FLUSH = 1e-4
"""mm, within which faces lie in one plane."""


def require_planes(
    symmetry: Mapping[str, Axis],
    parts: Sequence[BodyPart],
    names: Sequence[Sequence[str]],
) -> None:
    """Raise ``ValueError`` unless each surface of symmetry is one plane normal to its axis.

    Args:
        symmetry: Surface -> axis.
        parts: Of the body.
        names: The name of each face of each part.
    """
    for name, axis in symmetry.items():
        faces = list(_faces(name, parts, names))
        places = [face.Center().toTuple()[AXES[axis]] for face in faces]
        flat = all(_is_normal_to(face, axis) for face in faces)
        require(
            flat and np.ptp(places) <= FLUSH,
            f"supports.symmetry: the faces of {quoted(name)} must lie in one plane normal to "
            f"{axis}, behind which the other half of the body is",
        )


def _faces(
    name: str, parts: Sequence[BodyPart], names: Sequence[Sequence[str]]
) -> Iterator[cq.Face]:
    for part, called in zip(parts, names, strict=True):
        for face, own in zip(part.solid.Faces(), called, strict=True):
            if own == name:
                yield face


def _is_normal_to(face: cq.Face, axis: Axis) -> bool:
    normal = face.normalAt().toTuple()
    return face.geomType() == "PLANE" and abs(normal[AXES[axis]]) > 1 - ALIGNED


def against_symmetry(gravity: Gravity | None, symmetry: Mapping[str, Axis]) -> Iterator[str]:
    """Sentences on a weight whose mirror image in a plane acts another way."""
    if gravity is None:
        return
    direction = np.array(gravity.direction) / np.linalg.norm(gravity.direction)
    for name, axis in symmetry.items():
        if abs(direction[AXES[axis]]) > ALIGNED:
            yield (
                f"gravity acts across the plane of symmetry {quoted(name)}: the result is that of "
                "a body that slides along it, not of half of a whole one, which hangs otherwise."
            )
