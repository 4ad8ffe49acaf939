"""Rules of the printer that a design's numbers answer, before there is a solid."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from bellows_design.design.design import Design
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.printability import printed_model

if TYPE_CHECKING:
    from printers import RuleResult
    from solver.arrays import Reals

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
FACES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]
)  # fmt: skip
"""Of a box, outward."""


def declared_lights(design: Design) -> list[dict[str, Any]]:
    """Walls, gaps, layer, room on the printer and cross-section, each as a plain rule result.

    Raises ``PrintersError`` for an unknown printer.
    """
    return [light(result) for result in _results(design)]


def light(result: RuleResult) -> dict[str, Any]:
    """A rule's result as the page shows it."""
    kept = ("rule", "verdict", "message", "measured", "required", "unit", "where")
    return {key: value for key, value in asdict(result).items() if key in kept}


def _results(design: Design) -> Iterator[RuleResult]:
    from printers.measure.part import MeasuredPart
    from printers.profile.judging import judged
    from printers.rules.envelope import check_build_volume, check_cross_section
    from printers.rules.gaps import check_declared_gaps
    from printers.rules.printing import check_layer_height
    from printers.rules.walls import check_declared_walls

    part = MeasuredPart(printed_model(design, _envelope(design)), design.profile())
    rules = (check_declared_walls, check_declared_gaps, check_layer_height)
    for rule in (*rules, check_build_volume, check_cross_section):
        yield from (judged(result, part.profile) for result in rule(part))


def _envelope(design: Design) -> ClosedMesh:
    """Two boxes as large as finger and socket with its mount, mm: extents are all that is read."""
    finger, socket = _box(*_finger(design)), _box(*_socket(design))
    return ClosedMesh(np.concatenate([finger, socket]), np.concatenate([FACES, FACES + 8]))


def _box(lower: tuple[float, float, float], upper: tuple[float, float, float]) -> Reals:
    return np.array(lower) + CORNERS * (np.array(upper) - lower)


Box = tuple[tuple[float, float, float], tuple[float, float, float]]


def _finger(design: Design) -> Box:
    bellows, pad = design.bellows, design.fingertip
    half = max(bellows.bubble_width, 0.0 if pad is None else pad.width) / 2
    top = max(bellows.bubble_height, 0.0 if pad is None else pad.thickness)
    return (0.0, -half, 0.0), (design.finger_length, half, top)


def _socket(design: Design) -> Box:
    port, mount, bellows = design.port, design.mount, design.bellows
    length = max(port.depth, 0.0 if mount is None else mount.length(port))
    half = max(2 * port.radius, 0.0 if mount is None else mount.width(bellows, port)) / 2
    top = max(port.height, 0.0 if mount is None else mount.height(port))
    return (-length, -half, 0.0), (0.0, half, top)
