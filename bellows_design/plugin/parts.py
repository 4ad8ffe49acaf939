"""What ``Workplane.invoke`` takes, and the method for those who prefer one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import cadquery as cq

from bellows_design.design.design import Design
from bellows_design.errors import BellowsError
from bellows_design.geometry.actuator import printed_part
from bellows_design.plugin.subjects import Subject, design_of

METHOD = "bellows"


def bellows(design: Subject = "prototype_1", **parameters: Any) -> Callable[..., cq.Workplane]:
    """What ``Workplane.invoke`` takes to put the printed part of a design on every point.

    The part is built once, in its own frame (mm): root face at x = 0, tip towards +x, bottom on
    z = 0, symmetric about y = 0. Each point of the stack, or the workplane's origin if there is
    none, becomes the origin of one copy, turned as the workplane is. The new stack holds these
    solids, not combined with earlier ones: that is what ``union`` and ``cut`` are for.

    Args:
        design: A ``Design``, the name of a shipped one, a TOML file, or a dict as such a file has
            it.
        parameters: Values in its place, by name: ``bubble_thickness=1.2`` (mm), ``material=
            "ninjaflex"``, ``indent={"depth": 0.4}``, ``indent=None``.

    Returns:
        A function from a workplane to the one with the solids.

    Raises:
        DesignError: There is no such design, or the values make none.
        GeometryError: The CAD kernel cannot build the part.

    Examples:
        >>> import cadquery as cq
        >>> from bellows_design.plugin import bellows
        >>> places = cq.Workplane("YZ").pushPoints([(0, 0), (25, 0)])  # mm
        >>> hand = places.invoke(bellows("prototype_1"))
        >>> print(hand.solids().size(), "fingers")
        2 fingers
    """
    solid = part_of(design_of(design, parameters))

    def placed(workplane: cq.Workplane) -> cq.Workplane:
        return workplane.eachpoint(solid, useLocalCoordinates=True, clean=False)

    return placed


def part_of(design: Design) -> cq.Solid:
    """The printed part of a design. Raises ``GeometryError``."""
    return printed_part(
        design.bellows, design.indent, design.port, design.mount, design.fingertip
    ).solid


def register() -> None:
    """Add the method ``Workplane.bellows(design, ...)`` to CadQuery for this process.

    Raises ``BellowsError``, and changes nothing, if the name is already taken by another.

    Examples:
        >>> import cadquery as cq
        >>> from bellows_design.plugin import register
        >>> register()
        >>> part = cq.Workplane().bellows("prototype_1")
        >>> print(part.solids().size())
        1
    """
    if getattr(cq.Workplane, METHOD, _method) is not _method:
        raise BellowsError(f"cadquery.Workplane.{METHOD} is there already and stays as it is")
    setattr(cq.Workplane, METHOD, _method)


def _method(self: cq.Workplane, design: Subject = "prototype_1", **parameters: Any) -> cq.Workplane:
    """The printed part of a design on every point; see ``bellows_design.plugin.bellows``."""
    return self.invoke(bellows(design, **parameters))
