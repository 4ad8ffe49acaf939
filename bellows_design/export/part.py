"""What is exported: a solid, its mesh, and the labels of its files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bellows_design.geometry.tessellation import ClosedMesh

if TYPE_CHECKING:
    import cadquery as cq

    from printers import PrinterProfile


@dataclass(frozen=True)
class Part:
    """A design's solid and mesh together with the labels its files carry.

    ``profile`` is that of the printer on whose bed it stands; None if that is open.

    Examples:
        >>> from bellows_design import build_part, load_design
        >>> part = build_part(load_design("prototype_1"))
        >>> print(part.name, f"{part.solid.Volume() / 1000:.1f} cm³ of plastic")
        prototype_1 10.2 cm³ of plastic
    """

    name: str
    description: str
    digest: str
    solid: cq.Solid
    mesh: ClosedMesh
    profile: PrinterProfile | None = None
