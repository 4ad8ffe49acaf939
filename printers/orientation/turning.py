"""Turning a part so that a direction of its file points up, and its places back into the file."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from printers.arrays import Floats
from printers.errors import PrintersError
from printers.model import Opening, PrintedModel
from printers.report import Point, PrintabilityReport, point_of

AXES = {
    "X": (1.0, 0.0, 0.0),
    "-X": (-1.0, 0.0, 0.0),
    "Y": (0.0, 1.0, 0.0),
    "-Y": (0.0, -1.0, 0.0),
    "Z": (0.0, 0.0, 1.0),
    "-Z": (0.0, 0.0, -1.0),
}


@dataclass(frozen=True)
class Turning:
    """A rotation that brings `up`, a unit vector in the file's coordinates, to +z."""

    up: tuple[float, float, float]

    @property
    def matrix(self) -> Floats:
        """(3, 3): times a place in the file it gives the place on the bed.

        The turn by the least angle, about a level axis; upside down it turns about x.
        """
        x, y, z = self.up
        level = math.hypot(x, y)
        u, v = (x / level, y / level) if level else (0.0, 1.0)
        less = 1 - z  # 1 + z would lose its digits near -z
        matrix = [
            [1 - u * u * less, -u * v * less, -x],
            [-u * v * less, 1 - v * v * less, -y],
            [x, y, z],
        ]
        return np.array(matrix) + 0.0

    @property
    def name(self) -> str:
        """`X` to `-Z`, or the vector."""
        for name, axis in AXES.items():
            if np.allclose(axis, self.up, atol=1e-9, rtol=0):
                return name
        return ",".join(f"{value + 0.0:.4g}" for value in self.up)

    @property
    def is_none(self) -> bool:
        """Whether the part stands as its file has it."""
        return self.name == "Z"


AS_IN_FILE = Turning(AXES["Z"])
"""z of the file upwards."""


def parse_up(text: str) -> Turning:
    """`X`, `-X`, … `-Z`, or `X,Y,Z`, a vector of any length. Raises PrintersError."""
    axis = AXES.get(text.strip().upper().removeprefix("+"))
    if axis is not None:
        return Turning(axis)
    try:
        vector = np.array([float(word) for word in text.split(",")])
    except ValueError:
        vector = np.zeros(0)
    length = float(np.linalg.norm(vector)) if vector.shape == (3,) else 0.0
    if not (np.isfinite(length) and length > 0):
        raise PrintersError(
            f"up is {text[:80]!r}; it must be {', '.join(AXES)}, or a vector such as 0,0.5,1"
        )
    x, y, z = (float(value) for value in vector / length)
    return Turning((x, y, z))


def turned(model: PrintedModel, turning: Turning) -> PrintedModel:
    """The part as it stands with the direction upwards, its lowest point at z = 0.

    A part that stands as in its file stays as it is. A turned part has no cross-section.
    """
    if turning.is_none:
        return model
    vertices = model.vertices @ turning.matrix.T + lift(model, turning)
    openings = tuple(_turned_opening(each, model, turning) for each in model.openings)
    return replace(model, vertices=vertices, openings=openings, cross_section_limit=None)


def lift(model: PrintedModel, turning: Turning) -> Floats:
    """(3,) mm by which the turned part is moved up onto the bed."""
    if turning.is_none:
        return np.zeros(3)
    heights = model.vertices @ np.array(turning.up)
    return np.array([0.0, 0.0, -heights[model.triangles].min()])


def _turned_opening(opening: Opening, model: PrintedModel, turning: Turning) -> Opening:
    x, y, z = turning.matrix @ opening.centre + lift(model, turning)
    dx, dy, dz = turning.matrix @ opening.direction
    return replace(
        opening,
        centre=(float(x), float(y), float(z)),
        direction=(float(dx), float(dy), float(dz)),
    )


def place_in_file(points: Floats, model: PrintedModel, turning: Turning) -> Floats:
    """Places (..., 3) on the turned part in the coordinates of its file, where it is `model`."""
    if turning.is_none:
        return points
    return np.asarray((points - lift(model, turning)) @ turning.matrix)


def in_file(
    report: PrintabilityReport, model: PrintedModel, turning: Turning
) -> PrintabilityReport:
    """The report on the turned part, its places in the coordinates of the file.

    Heights z above the bed in its sentences stay what they are.
    """

    def back(point: Point) -> Point:
        return point_of(place_in_file(np.array(point), model, turning))

    if turning.is_none:
        return report
    return replace(report, rules=tuple(rule.moved(back) for rule in report.rules))
