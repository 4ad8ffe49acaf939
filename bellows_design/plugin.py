"""The CadQuery plugin: bellows parts in a chain of workplane calls.

    import cadquery as cq
    from bellows_design.design import load_design
    from bellows_design.plugin import bellows

    part = cq.Workplane().invoke(bellows(load_design("prototype_2")))
    hand = cq.Workplane("YZ").pushPoints([(0, 0), (25, 0)]).invoke(bellows(load_design("finger")))

Importing this module changes nothing in CadQuery. Whoever prefers a method asks for it:

    from bellows_design.plugin import register

    register()
    part = cq.Workplane().bellows(load_design("prototype_2"))
"""

from __future__ import annotations

from collections.abc import Callable

import cadquery as cq

from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.geometry.actuator import printed_part

METHOD = "bellows"


def bellows(design: Design) -> Callable[[cq.Workplane], cq.Workplane]:
    """What ``Workplane.invoke`` takes to put the printed part of ``design`` on every point.

    The part is built once, in its own frame (mm): root face at x = 0, tip towards +x, bottom on
    z = 0, symmetric about y = 0. Each point of the stack, or the workplane's origin if there is
    none, becomes the origin of one copy, turned as the workplane is. The new stack holds these
    solids, not combined with earlier ones: that is what ``union`` and ``cut`` are for.

    Raises ``GeometryError`` if the CAD kernel cannot build the part.
    """
    solid = printed_part(
        design.bellows, design.indent, design.port, design.mount, design.fingertip
    ).solid

    def placed(workplane: cq.Workplane) -> cq.Workplane:
        return workplane.eachpoint(solid, useLocalCoordinates=True, clean=False)

    return placed


def register() -> None:
    """Add the method ``Workplane.bellows(design)`` to CadQuery for this process.

    Raises ``BellowsError``, and changes nothing, if the name is already taken by another.
    """
    if getattr(cq.Workplane, METHOD, _method) is not _method:
        raise BellowsError(f"cadquery.Workplane.{METHOD} is there already and stays as it is")
    setattr(cq.Workplane, METHOD, _method)


def _method(self: cq.Workplane, design: Design) -> cq.Workplane:
    """The printed part of ``design`` on every point; see ``bellows_design.plugin.bellows``."""
    return self.invoke(bellows(design))
