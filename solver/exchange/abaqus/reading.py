"""An input file of Abaqus or CalculiX read as a mesh: nodes, tetrahedra, sets, surfaces.

Of its own, not by meshio: that knows no ``*SURFACE``, and a deck is its surfaces. Read are flat
files and those of Abaqus/CAE with one part, used once and not moved.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from solver.errors import SolverError
from solver.exchange.abaqus.cells import BELOW, TETRAHEDRON, TRIANGLE, reordered
from solver.exchange.abaqus.lines import Block, Line, blocks
from solver.exchange.abaqus.sets import Sets, integer
from solver.exchange.found import Found, Numbers

MAKERS = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM")
"""Keywords that make or move nodes and elements; skipping them would read another mesh."""


def read_abaqus(path: Path) -> Found:
    """The mesh of a file. Raises ``SolverError`` with the line, or ``OSError``."""
    reader = _Reader()
    for block in blocks(path):
        reader.take(block)
    return reader.found()


class _Reader:
    """What has been read so far; numbers are the file's labels until all is read."""

    def __init__(self) -> None:
        self.nodes: dict[int, tuple[float, float, float]] = {}
        self.tets: dict[int, list[int]] = {}
        self.triangles: dict[int, list[int]] = {}
        self.other: set[int] = set()
        self.sets = Sets()
        self._instances = 0

    def take(self, block: Block) -> None:
        """Read one block; keywords that say nothing of the mesh are passed over."""
        if block.keyword in MAKERS:
            raise SolverError(
                f"{block.place}: *{block.keyword} is not read; write the nodes and elements out."
            )
        reads = {
            "NODE": self._nodes,
            "ELEMENT": self._elements,
            "NSET": self._node_set,
            "ELSET": self.sets.elements,
            "SURFACE": self.sets.surface,
            "INSTANCE": self._instance,
        }
        if block.keyword in reads:
            reads[block.keyword](block)

    def _nodes(self, block: Block) -> None:
        if block.parameters.get("SYSTEM", "R").upper() != "R":
            raise SolverError(f"{block.place}: *NODE in another than rectangular coordinates.")
        labels = []
        for line in block.lines:
            label = integer(line, 0)
            if label in self.nodes and self.nodes[label] != _position(line):
                raise SolverError(
                    f"{line.place}: node {label} is given twice, at two places; several parts in "
                    "one file must be merged first."
                )
            self.nodes[label] = _position(line)
            labels.append(label)
        self.sets.add_nodes(block.parameters.get("NSET", ""), labels)

    def _elements(self, block: Block) -> None:
        kind = block.parameter("TYPE").upper()
        labels = []
        table, size = self._table(kind, block)
        for place, numbers in _records(block, size):
            label = numbers[0]
            if label in self.tets or label in self.triangles or label in self.other:
                raise SolverError(f"{place}: element {label} is given twice.")
            if table is None:
                self.other.add(label)
            else:
                table[label] = numbers[1:]
            labels.append(label)
        self.sets.add_elements(block.parameters.get("ELSET", ""), labels)

    def _node_set(self, block: Block) -> None:
        """A set of nodes; with ``ELSET=`` the nodes of those elements."""
        if "ELSET" not in block.parameters:
            self.sets.nodes(block)
            return
        cells = [
            table[label]
            for label in self.sets.elements_of(block)
            for table in (self.tets, self.triangles)
            if label in table
        ]
        self.sets.add_nodes(block.parameter("NSET"), sorted(set().union(*cells)))

    def _instance(self, block: Block) -> None:
        _check_instance(block)
        self._instances += 1
        if self._instances > 1:
            raise SolverError(f"{block.place}: a second instance; one, of one part, is read.")

    def _table(self, kind: str, block: Block) -> tuple[dict[int, list[int]] | None, int]:
        """Where elements of a kind are kept (None: nowhere), and their number of nodes (0: any)."""
        if found := TETRAHEDRON.fullmatch(kind):
            return self.tets, int(found.group(1))
        if TRIANGLE.fullmatch(kind):
            return self.triangles, 6 if "6" in kind else 3
        if BELOW.match(kind):
            return None, 0
        raise SolverError(
            f"{block.place}: elements of the type {kind} are no tetrahedra; C3D4 and C3D10, with "
            "any letters behind, are read."
        )

    def found(self) -> Found:
        """All of it, numbered from 0 by labels. ``SolverError`` for numbers that name nothing."""
        self.nodes, self.tets = dict(sorted(self.nodes.items())), dict(sorted(self.tets.items()))
        labels = np.fromiter(self.nodes, np.int64, len(self.nodes))
        numbering = Numbering("node", labels)
        tets = self._cells(self.tets, numbering)
        elements = Numbering("element", np.fromiter(self.tets, np.int64, len(self.tets)))
        triangles = self._surfaces_of_triangles(numbering)
        faces = self.sets.faces(elements)
        return Found(
            np.array(list(self.nodes.values()), float).reshape(-1, 3),
            reordered(tets),
            triangles,
            faces,
            self.sets.node_sets(numbering, {**triangles, **faces}),
            self.sets.element_sets(elements),
        )

    def _cells(self, table: dict[int, list[int]], nodes: Numbering) -> Numbers:
        sizes = {len(each) for each in table.values()}
        if len(sizes) > 1:
            raise SolverError("it has four-node and ten-node tetrahedra; one kind only is read.")
        width = sizes.pop() if sizes else 4
        flat = np.array(list(table.values()), np.int64).reshape(-1, width)
        return nodes.places(flat, "an element")

    def _surfaces_of_triangles(self, nodes: Numbering) -> dict[str, Numbers]:
        """Named sets of triangles by their corners (k, 3)."""
        named = {}
        for name, labels in self.sets.members_among(self.triangles).items():
            corners = np.array([self.triangles[label][:3] for label in labels], np.int64)
            named[name] = nodes.places(corners, f"a triangle of {name!r}")
        return named


class Numbering:
    """From the labels of a file to numbers from 0."""

    def __init__(self, what: str, labels: Numbers) -> None:
        self._what, self._order = what, np.argsort(labels, kind="stable")
        self._sorted = labels[self._order]

    def places(self, labels: Numbers, where: str) -> Numbers:
        """Numbers of labels. Raises ``SolverError`` for one that the file does not have."""
        if not labels.size:
            return labels
        place = np.searchsorted(self._sorted, labels).clip(max=max(len(self._sorted) - 1, 0))
        known = self._sorted[place] == labels if len(self._sorted) else np.zeros(labels.shape, bool)
        if not known.all():
            raise SolverError(
                f"{where} names {self._what} {labels[~known][0]}, which is not there."
            )
        return self._order[place]

    def known(self, labels: Numbers) -> Numbers:
        """Numbers of those labels that there are."""
        kept = labels[np.isin(labels, self._sorted)]
        return self.places(kept, "")


def _records(block: Block, size: int) -> list[tuple[str, list[int]]]:
    """Label and nodes of each element of ``size`` nodes, which may stand on several lines."""
    found: list[tuple[str, list[int]]] = []
    place, numbers = "", list[int]()
    for line in block.lines:
        place = place or line.place
        numbers += [integer(line, k) for k, text in enumerate(line.fields) if text]
        if len(numbers) > size + 1 and size:
            raise SolverError(
                f"{line.place}: an element of the type {block.parameter('TYPE')} has {size} nodes, "
                f"got {len(numbers) - 1}."
            )
        if len(numbers) == size + 1 or not size:
            found.append((place, numbers))
            place, numbers = "", []
    if numbers:
        raise SolverError(f"{place}: element {numbers[0]} has {len(numbers) - 1} of {size} nodes.")
    return found


def _position(line: Line) -> tuple[float, float, float]:
    """Coordinates of a node; those left out are zero."""
    texts = [*line.fields[1:4], "", "", ""][:3]
    try:
        x, y, z = (float(text.lower().replace("d", "e")) if text else 0.0 for text in texts)
    except ValueError:
        raise SolverError(f"{line.place}: coordinates must be numbers, got {texts}.") from None
    if not np.isfinite([x, y, z]).all():
        raise SolverError(f"{line.place}: coordinates must be finite, got {texts}.")
    return x, y, z


def _check_instance(block: Block) -> None:
    if any(any(float(text or 0) for text in line.fields) for line in block.lines):
        raise SolverError(
            f"{block.place}: the instance {block.parameters.get('NAME', '')!r} is moved from its "
            "part; write the assembly flat, or the part in its place."
        )
