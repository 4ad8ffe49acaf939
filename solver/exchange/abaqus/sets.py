"""Named sets of nodes and elements, and surfaces of elements' faces, in a file's own labels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from solver.errors import SolverError
from solver.exchange.abaqus.lines import Block, Line
from solver.exchange.found import Numbers

if TYPE_CHECKING:
    from solver.exchange.abaqus.reading import Numbering

FACE_NAMES = {f"{letter}{k + 1}": k for k in range(4) for letter in "SP"}


MOST_GENERATED = 50_000_000
"""Labels of one line: more than any mesh that fits into memory has."""


LARGEST = 2**62
"""Label that arrays of 64 bit hold with room."""


class Sets:
    """Sets as they are read; names count without regard to case, the first spelling is kept."""

    def __init__(self) -> None:
        self._nodes: dict[str, list[int]] = {}
        self._elements: dict[str, list[int]] = {}
        self._faces: dict[str, list[tuple[Line, str, int]]] = {}
        self._of_nodes: dict[str, list[str]] = {}
        self._spelling: dict[str, str] = {}
        self._internal: set[str] = set()

    def nodes(self, block: Block) -> None:
        """A set of nodes, by labels, names of sets, or from one to another."""
        name = self._named(block.parameter("NSET"))
        self._nodes.setdefault(name, []).extend(_members(block, self._nodes))

    def elements(self, block: Block) -> None:
        """A set of elements, likewise."""
        name = self._named(block.parameter("ELSET"))
        if "INTERNAL" in block.parameters:
            self._internal.add(name)
        self._elements.setdefault(name, []).extend(_members(block, self._elements))

    def elements_of(self, block: Block) -> list[int]:
        """Elements of the set that a block names. Raises ``SolverError``."""
        name = block.parameter("ELSET")
        if name.upper() not in self._elements:
            raise SolverError(f"{block.place}: there is no set of elements {name!r} above.")
        return self._elements[name.upper()]

    def add_nodes(self, name: str, labels: list[int]) -> None:
        """Nodes that are put into a set where they are given."""
        if name:
            self._nodes.setdefault(self._named(name), []).extend(labels)

    def add_elements(self, name: str, labels: list[int]) -> None:
        """Elements that are put into a set where they are given."""
        if name:
            self._elements.setdefault(self._named(name), []).extend(labels)

    def surface(self, block: Block) -> None:
        """Faces of elements or of sets of them, or a set of nodes as a surface."""
        name = self._named(block.parameter("NAME"))
        if block.parameters.get("TYPE", "ELEMENT").upper() == "NODE":
            self._nodes.setdefault(name, []).extend(_members(block, self._nodes))
            return
        for line in block.lines:
            face = line.fields[1].upper() if len(line.fields) > 1 else ""
            if face not in FACE_NAMES:
                raise SolverError(
                    f"{line.place}: a surface needs a face S1 to S4 of a tetrahedron, got {face!r}."
                )
            entry = (line, line.fields[0].upper(), FACE_NAMES[face])
            self._faces.setdefault(name, []).append(entry)

    def faces(self, elements: Numbering) -> dict[str, Numbers]:
        """Surfaces: element and face (k, 2) by name. Raises ``SolverError``."""
        return {
            self._spelling[name]: np.concatenate([self._pairs(*each, elements) for each in entries])
            for name, entries in self._faces.items()
        }

    def _pairs(self, line: Line, source: str, face: int, elements: Numbering) -> Numbers:
        labels = self._elements.get(source) or [integer(line, 0, WANTED)]
        numbers = elements.places(np.array(labels, np.int64), line.place)
        return np.stack([numbers, np.full(len(numbers), face)], axis=1)

    def node_sets(self, nodes: Numbering, surfaces: Mapping[str, object]) -> dict[str, Numbers]:
        """Sets of nodes by name, but those that share it with a surface. Raises ``SolverError``."""
        taken = {name.upper() for name in surfaces}
        return {
            self._spelling[name]: nodes.places(
                np.array(labels, np.int64), f"the set of nodes {self._spelling[name]!r}"
            )
            for name, labels in self._nodes.items()
            if name not in taken
        }

    def element_sets(self, elements: Numbering) -> dict[str, Numbers]:
        """Sets of tetrahedra by name, but internal ones, which surfaces are made of."""
        found = {
            self._spelling[name]: elements.known(np.array(labels, np.int64))
            for name, labels in self._elements.items()
            if name not in self._internal and not name.startswith("_")
        }
        return {name: members for name, members in found.items() if len(members)}

    def members_among(self, table: Mapping[int, object]) -> dict[str, list[int]]:
        """Sets of elements by name, of each the members that a table has."""
        found = {
            self._spelling[name]: [label for label in labels if label in table]
            for name, labels in self._elements.items()
        }
        return {name: members for name, members in found.items() if members}

    def _named(self, name: str) -> str:
        key = name.upper()
        self._spelling.setdefault(key, name)
        return key


def integer(line: Line, place: int, what: str = "a whole number") -> int:
    """A field as a whole number. Raises ``SolverError``."""
    text = line.fields[place] if place < len(line.fields) else ""
    try:
        number = int(text)
    except ValueError:
        raise SolverError(f"{line.place}: needs {what}, got {text!r}.") from None
    if abs(number) > LARGEST:
        raise SolverError(f"{line.place}: {text} is too large; {LARGEST} is the largest label.")
    return number


def _members(block: Block, sets: Mapping[str, list[int]]) -> list[int]:
    """Labels that a block puts into a set. Raises ``SolverError``."""
    if "GENERATE" in block.parameters:
        return [label for line in block.lines for label in _generated(line)]
    labels = []
    for line in block.lines:
        # of a surface of nodes the second field is an area
        fields = line.fields[:1] if block.keyword == "SURFACE" else line.fields
        for place, text in enumerate(fields):
            if text:
                labels += sets.get(text.upper()) or [integer(line, place, WANTED)]
    return labels


WANTED = "a label, or the name of a set above"


def _generated(line: Line) -> range:
    """First, last and step of labels, the step 1 if left out."""
    first, last = integer(line, 0), integer(line, 1)
    step = integer(line, 2) if len(line.fields) > 2 and line.fields[2] else 1
    if step == 0:
        raise SolverError(f"{line.place}: the step must not be 0.")
    labels = range(first, last + (1 if step > 0 else -1), step)
    if (last - first) // step >= MOST_GENERATED:
        raise SolverError(f"{line.place}: a set of more than {MOST_GENERATED} labels.")
    return labels
