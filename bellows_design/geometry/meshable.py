"""What can be meshed: a solid with named faces, or several that touch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import cadquery as cq

    from solver import Mesh
    from solver.meshing import MeshOptions


class Meshable(Protocol):
    """Solids with named faces that one mesh is made of."""

    @property
    def solids(self) -> tuple[cq.Solid, ...]:
        """The solids, from whose faces the size of a mesh is estimated."""

    def meshed(self, options: MeshOptions, seconds: float) -> Mesh:
        """The mesh with its named surfaces, made within ``seconds``. Raises ``MeshingError``."""

    def __hash__(self) -> int:
        """Of the solids and the names."""
