"""Turning a part so that a direction of its file points up, and its places back into the file."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

import numpy as np

from printers.arrays import Floats
from printers.errors import PrintersError
from printers.model import Opening, PrintedModel
from printers.report import PrintabilityReport, place

AXES = {
    "X": (1.0, 0.0, 0.0),
    "-X": (-1.0, 0.0, 0.0),
    "Y": (0.0, 1.0, 0.0),
    "-Y": (0.0, -1.0, 0.0),
    "Z": (0.0, 0.0, 1.0),
    "-Z": (0.0, 0.0, -1.0),
}
_PLACE = re.compile(r"\((-?\d+\.\d), (-?\d+\.\d), (-?\d+\.\d)\) mm")


@dataclass(frozen=True)
class Turning:
    """A rotation that brings `up`, a unit vector in the file's coordinates, to +z."""

    up: tuple[float, float, float]

    @property
    def matrix(self) -> Floats:
        """(3, 3): times a place in the file it gives the place on the bed.

        The turn by the least angle; upside down it turns about x.
        """
        x, y, z = self.up
        if z < -1 + 1e-12:
            return np.diag([1.0, -1.0, -1.0])
        skew = np.array([[0.0, 0.0, -x], [0.0, 0.0, -y], [x, y, 0.0]])
        return np.asarray(np.eye(3) + skew + skew @ skew / (1 + z)) + 0.0

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
    """The part as it stands with the direction upwards. A turned part has no cross-section."""
    if turning.is_none:
        return model
    openings = tuple(_turned_opening(opening, turning.matrix) for opening in model.openings)
    return replace(
        model,
        vertices=model.vertices @ turning.matrix.T,
        openings=openings,
        cross_section_limit=None,
    )


def _turned_opening(opening: Opening, matrix: Floats) -> Opening:
    (x, y, z), (dx, dy, dz) = matrix @ opening.centre, matrix @ opening.direction
    return replace(
        opening,
        centre=(float(x), float(y), float(z)),
        direction=(float(dx), float(dy), float(dz)),
    )


def in_file(report: PrintabilityReport, turning: Turning) -> PrintabilityReport:
    """The report on a turned part, its places in the coordinates of the file.

    Heights z above the bed in its sentences stay what they are.
    """
    if turning.is_none:
        return report
    rules = tuple(
        replace(
            rule,
            where=places_in_file(rule.where, turning),
            message=places_in_file(rule.message, turning),
        )
        for rule in report.rules
    )
    return replace(report, rules=rules)


def places_in_file(text: str, turning: Turning) -> str:
    """The text, each place in it, as `place` writes them, turned back."""

    def back(found: re.Match[str]) -> str:
        return place(turning.matrix.T @ np.array([float(each) for each in found.groups()]))

    return _PLACE.sub(back, text)
