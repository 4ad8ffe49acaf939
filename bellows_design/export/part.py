"""What is exported: a solid, its mesh, and the labels of its files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.geometry.tessellation import ClosedMesh

if TYPE_CHECKING:
    import cadquery as cq


@dataclass(frozen=True)
class Part:
    """A design's solid and mesh together with the labels its files carry."""

    name: str
    description: str
    digest: str
    solid: cq.Solid
    mesh: ClosedMesh
