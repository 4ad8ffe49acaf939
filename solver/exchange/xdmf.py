"""XDMF files in one piece: numbers stand as text in the XML.

Written here and not by meshio, whose writer wants HDF5 even where the file has none.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as xml

import numpy as np

from solver.arrays import Reals
from solver.exchange.found import Numbers

CELL_TYPES = {"tetra10": ("Tetrahedron_10", 38), "triangle6": ("Triangle_6", 36)}
"""Names and numbers of XDMF's cell types, by meshio's names; their order of nodes is VTK's."""


def write_xdmf(
    path: Path,
    nodes: Reals,
    cells: Sequence[tuple[str, Numbers]],
    point_data: Mapping[str, Numbers],
    cell_data: Mapping[str, Sequence[Numbers]],
) -> None:
    """Write nodes (n, 3), cells by meshio's name of their type, and fields on nodes and cells."""
    root = xml.Element("Xdmf", Version="3.0")
    grid = xml.SubElement(xml.SubElement(root, "Domain"), "Grid", Name="Grid")
    _add(xml.SubElement(grid, "Geometry", GeometryType="XYZ"), np.asarray(nodes, float))
    _add_topology(grid, cells)
    for name, values in point_data.items():
        _add_field(grid, name, "Node", np.asarray(values))
    for name, parts in cell_data.items():
        _add_field(grid, name, "Cell", np.concatenate([np.asarray(each) for each in parts]))
    xml.indent(root)
    xml.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _add_topology(grid: xml.Element, cells: Sequence[tuple[str, Numbers]]) -> None:
    """Cells of one type as a table, which meshio reads too, of several as a mixed list."""
    number = str(sum(len(each) for _, each in cells))
    ((kind, only), *others) = cells
    name = "Mixed" if others else CELL_TYPES[kind][0]
    topology = xml.SubElement(grid, "Topology", TopologyType=name, NumberOfElements=number)
    mixed = np.concatenate([_numbered(*block).ravel() for block in cells]) if others else only
    _add(topology, np.asarray(mixed, np.int64))


def _numbered(kind: str, cells: Numbers) -> Numbers:
    """Cells (k, m), each behind the number of its type."""
    return np.insert(np.asarray(cells, np.int64), 0, CELL_TYPES[kind][1], axis=1)


def _add_field(grid: xml.Element, name: str, where: str, values: Numbers) -> None:
    kind = "Scalar" if values.ndim == 1 else "Vector"
    _add(xml.SubElement(grid, "Attribute", Name=name, AttributeType=kind, Center=where), values)


def _add(parent: xml.Element, values: Numbers) -> None:
    whole = values.dtype.kind in "iub"
    item = xml.SubElement(
        parent,
        "DataItem",
        DataType="Int" if whole else "Float",
        Precision="4" if whole else "8",
        Dimensions=" ".join(map(str, values.shape)),
        Format="XML",
    )
    item.text = "\n" + "\n".join(_lines(values)) + "\n"


def _lines(values: Numbers) -> Iterable[str]:
    if values.ndim == 1:
        return map(repr, values.tolist())
    return (" ".join(map(repr, row)) for row in values.tolist())
