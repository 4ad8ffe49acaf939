"""The cavity inside a solid."""

from __future__ import annotations

import cadquery as cq

from bellows_design.geometry.named_solids import NamedSolid


def void(body: NamedSolid) -> cq.Solid:
    """The closed cavity of a whole body as a solid."""
    outer, inner = sorted(body.solid.Shells(), key=lambda shell: -shell.Area())
    assert outer.isValid() and inner.isValid()
    return cq.Solid.makeSolid(inner)
