"""One model file of a 3MF package: objects, and which of them are built where.

3MF Core Specification 1.3 and Production Extension 1.1 (3MF Consortium).
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from printers.arrays import Floats, Ints
from printers.errors import PrintersError, quoted
from printers.reading.limits import MOST_TRIANGLES
from printers.reading.threemf.xml_events import Attributes, read_elements

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
UNITS = {
    "micron": 0.001,
    "millimeter": 1.0,
    "centimeter": 10.0,
    "inch": 25.4,
    "foot": 304.8,
    "meter": 1000.0,
}
"""mm."""

DEFAULT_UNIT = "millimeter"
MOST_OBJECTS = 10_000
_SHAPES = ("beamlattice", "displacementmesh", "implicitfunction", "volumetricstack", "slicestack")
_NO_PART = ("support", "solidsupport")


@dataclass(frozen=True)
class Placed:
    """A copy of an object: its number, the model file it is in ("" for this one) and its place.

    `transform` *Shape:* (4, 3): a row (x, y, z, 1) times it is the place, in the file's unit.
    """

    number: str
    file: str
    transform: Floats


@dataclass
class Object:
    """Vertices in the file's unit, triangles, and the copies of others it is made of."""

    kind: str
    coordinates: array[float] = field(default_factory=lambda: array("d"))
    corners: array[int] = field(default_factory=lambda: array("q"))
    components: list[Placed] = field(default_factory=list)

    @property
    def is_part(self) -> bool:
        """Whether it is meant to be there once the part is finished."""
        return self.kind not in _NO_PART

    @property
    def size(self) -> int:
        """Triangles; more if its vertices are many more than triangles need."""
        return max(len(self.corners) // 3, len(self.coordinates) // 9)

    def mesh(self) -> tuple[Floats, Ints]:
        """(n, 3) vertices and (m, 3) triangles. Raises PrintersError."""
        vertices = np.array(self.coordinates).reshape(-1, 3)
        triangles = np.array(self.corners).reshape(-1, 3)
        if len(triangles) and not (triangles.min() >= 0 and triangles.max() < len(vertices)):
            raise PrintersError(
                f"a triangle names a vertex beyond the {len(vertices)} of its object"
            )
        return vertices, triangles


@dataclass
class ModelFile:
    """What one model file holds."""

    unit: str | None = None
    objects: dict[str, Object] = field(default_factory=dict)
    items: list[Placed] = field(default_factory=list)
    left_out: int = 0


def read_model(pieces: Iterable[bytes]) -> ModelFile:
    """The model in a file's XML. Raises PrintersError."""
    reading = _Reading()
    read_elements(pieces, reading.begin, reading.end)
    if not reading.is_model:
        raise PrintersError("its XML is no 3MF model")
    return reading.model


class _Reading:
    """What was read so far, and the object that is being read."""

    def __init__(self) -> None:
        self.model = ModelFile()
        self.is_model = False
        self._object = Object("")

    def begin(self, name: str, attributes: Attributes) -> None:
        action = _ACTIONS.get(name)
        tag = name.rpartition(" ")[2]
        if tag in _SHAPES:
            raise PrintersError(f"it holds a {tag}, which is not read: only triangles are")
        if action is not None:
            try:
                action(self, attributes)
            except KeyError as error:
                raise PrintersError(f"an element {tag} lacks {error}") from None
            except (ValueError, OverflowError) as error:
                if isinstance(error, PrintersError):
                    raise
                raise PrintersError(f"an element {tag} holds what is no number") from None

    def end(self, name: str) -> None:
        """Nothing ends that the next beginning does not show."""

    def _begin_model(self, attributes: Attributes) -> None:
        self.is_model = True
        self.model.unit = attributes.get("unit")
        if self.model.unit is not None and self.model.unit not in UNITS:
            raise PrintersError(f"its unit is {quoted(self.model.unit)}, not {', '.join(UNITS)}")

    def _begin_object(self, attributes: Attributes) -> None:
        number = attributes["id"]
        if number in self.model.objects:
            raise PrintersError(f"two of its objects have the number {quoted(number)}")
        if len(self.model.objects) >= MOST_OBJECTS:
            raise PrintersError(f"it holds more than {MOST_OBJECTS} objects")
        self._object = self.model.objects[number] = Object(attributes.get("type", "model"))

    def _add_vertex(self, attributes: Attributes) -> None:
        coordinates = self._object.coordinates
        if len(coordinates) > 9 * MOST_TRIANGLES:
            raise PrintersError(f"an object has more than {3 * MOST_TRIANGLES} vertices")
        for axis in "xyz":
            coordinates.append(float(attributes[axis]))

    def _add_triangle(self, attributes: Attributes) -> None:
        corners = self._object.corners
        if len(corners) > 3 * MOST_TRIANGLES:
            raise PrintersError(f"an object has more than {MOST_TRIANGLES} triangles")
        for corner in ("v1", "v2", "v3"):
            corners.append(int(attributes[corner]))

    def _add_component(self, attributes: Attributes) -> None:
        if len(self._object.components) >= MOST_OBJECTS:
            raise PrintersError(f"an object has more than {MOST_OBJECTS} components")
        self._object.components.append(_placed(attributes))

    def _add_item(self, attributes: Attributes) -> None:
        if attributes.get("printable") == "0":
            self.model.left_out += 1
            return
        if len(self.model.items) >= MOST_OBJECTS:
            raise PrintersError(f"it builds more than {MOST_OBJECTS} items")
        self.model.items.append(_placed(attributes))


_ACTIONS = {
    f"{CORE} model": _Reading._begin_model,
    f"{CORE} object": _Reading._begin_object,
    f"{CORE} vertex": _Reading._add_vertex,
    f"{CORE} triangle": _Reading._add_triangle,
    f"{CORE} component": _Reading._add_component,
    f"{CORE} item": _Reading._add_item,
}


def _placed(attributes: Attributes) -> Placed:
    file = attributes.get(f"{PRODUCTION} path", "").lstrip("/")
    return Placed(attributes["objectid"], file, _transform(attributes.get("transform")))


def _transform(text: str | None) -> Floats:
    if text is None:
        return np.vstack([np.eye(3), np.zeros(3)])
    numbers = [float(word) for word in text.split(None, 12)]
    if len(numbers) != 12 or not all(map(math.isfinite, numbers)):
        raise PrintersError("a transform has not twelve finite numbers")
    return np.array(numbers).reshape(4, 3)
