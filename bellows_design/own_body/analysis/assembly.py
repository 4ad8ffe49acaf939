"""The parts of an own body as one thing to mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cadquery as cq

from bellows_design.errors import DesignError
from bellows_design.own_body.body import OwnBody
from bellows_design.own_body.selection import BETWEEN

if TYPE_CHECKING:
    from solver import Mesh
    from solver.meshing import MeshOptions


@dataclass(frozen=True)
class Assembly:
    """The parts of ``body``; in their mesh each is a region, and they share nodes."""

    body: OwnBody

    @property
    def solids(self) -> tuple[cq.Solid, ...]:
        """The solids of all parts."""
        return tuple(part.solid for part in self.body.parts)

    def meshed(self, options: MeshOptions, seconds: float) -> Mesh:
        """The mesh with its named surfaces, made within ``seconds``. Raises ``MeshingError``."""
        from solver.meshing import Part, mesh_solids

        parts = [
            Part(part.name, part.brep, names, _size(part.size, options))
            for part, names in zip(self.body.parts, self.body.face_names, strict=True)
        ]
        mesh = mesh_solids(parts, options, seconds)
        _require_outer_faces(self.body, mesh)
        return mesh


def _require_outer_faces(body: OwnBody, mesh: Mesh) -> None:
    """Raise ``DesignError`` for a name whose faces lie between parts altogether."""
    for name in body.surfaces:
        if not len(mesh.surfaces.get(name, ())):
            between = [each for each in mesh.surfaces if BETWEEN in each]
            raise DesignError(
                f"surfaces.{name} lies between parts: what two parts share is called "
                f"{' or '.join(between)}."
            )


def _size(wanted: float | None, options: MeshOptions) -> float | None:
    """A part's longest edge, mm, on the first mesh; refined ones follow from the solution."""
    if wanted is None or options.field is not None:
        return None
    return max(wanted, options.smallest_size)
