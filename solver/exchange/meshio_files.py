"""Gmsh's, VTK's and XDMF's files, read and written by meshio."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from solver.errors import SolverError
from solver.exchange.abaqus.cells import reordered
from solver.exchange.found import Found, Numbers
from solver.exchange.xdmf import write_xdmf
from solver.mesh.mesh import Mesh

TETRAHEDRA = ("tetra", "tetra10")
TRIANGLES = ("triangle", "triangle6")
IGNORED = ("vertex", "line", "line3")
FLAG_VALUES = 2
"""A field of whole numbers with no more values than this, 0 and 1, is a set of the field's name;
one with more is a set for each value but 0."""

MOST_SETS = 64
"""A field of whole numbers with more values than this is no sets, but a numbering."""

GMSH, PHYSICAL = "gmsh", "gmsh:physical"

SURFACE_RANK = 2
"""Dimension of a physical group of triangles; a volume's is one more."""

ADVICE = {
    GMSH: "; of Gmsh's files those of versions 4.1 and 2.2 are read "
    "(Mesh.MshFileVersion), of physical groups alone (Mesh.SaveAll = 0)",
    "vtu": "; of VTK's compressions zlib, lzma and none are read",
}
"""What is said behind the reason why a file of a kind cannot be read."""


def read_meshio(path: Path, kind: str) -> Found:
    """The mesh of a file of meshio's ``kind``. Raises ``SolverError``, ``OSError``."""
    mesh = _content(path, kind)
    nodes = np.asarray(mesh.points, float)
    if nodes.ndim != 2 or nodes.shape[1] != 3:
        raise SolverError(f"its nodes have {nodes.shape[-1]} coordinates; three are needed.")
    blocks = [(block.type, np.asarray(block.data, np.int64)) for block in mesh.cells]
    _check_kinds([kind for kind, cells in blocks if len(cells)])
    wide = [cells for kind, cells in blocks if kind in TETRAHEDRA and len(cells)]
    tets = np.concatenate(wide) if wide else np.zeros((0, 4), np.int64)
    triangles, elements = _cell_sets(mesh, blocks)
    if kind == GMSH:
        _check_groups(mesh, {*triangles, *elements})
    return Found(nodes, reordered(tets), triangles, {}, _node_sets(mesh), elements)


def _content(path: Path, kind: str) -> Any:
    """The file as meshio has it; whatever it raises becomes one sentence."""
    from importlib import import_module

    import meshio  # its parts are imported in its own order

    try:
        return import_module(f"{meshio.__name__}.{kind}").read(str(path))
    except OSError:
        raise
    except Exception as error:  # of any kind where a file is damaged
        reason = " ".join(str(error).split())
        raise SolverError(
            f"it is no {kind} file that can be read ({type(error).__name__}"
            f"{': ' + reason if reason else ''}){ADVICE.get(kind, '')}."
        ) from None


def _check_kinds(kinds: list[str]) -> None:
    """Raise ``SolverError`` for cells that are neither tetrahedra nor below, or of both kinds."""
    strange = sorted(set(kinds) - {*TETRAHEDRA, *TRIANGLES, *IGNORED})
    if strange:
        raise SolverError(
            f"it has cells of the kind {', '.join(strange)}; only tetrahedra are read."
        )
    if set(TETRAHEDRA) <= set(kinds):
        raise SolverError("it has four-node and ten-node tetrahedra; one kind only is read.")


def _check_groups(mesh: Any, sets: set[str]) -> None:
    """Raise ``SolverError`` if a file names groups and no element is in any of them."""
    named = {name for name, (_, rank) in mesh.field_data.items() if rank >= SURFACE_RANK}
    if named and not named & sets:
        raise SolverError(
            f"it names physical groups ({', '.join(sorted(named))}), but no triangle or "
            "tetrahedron is in one; save it again with Gmsh's Mesh.SaveAll = 0."
        )


def _cell_sets(
    mesh: Any, blocks: list[tuple[str, Numbers]]
) -> tuple[dict[str, Numbers], dict[str, Numbers]]:
    """Named triangles (k, 3) and named tetrahedra (k,)."""
    triangles: dict[str, list[Numbers]] = {}
    elements: dict[str, list[Numbers]] = {}
    for name, members in _members(mesh, blocks).items():
        first = 0
        for (kind, cells), chosen in zip(blocks, members, strict=True):
            if kind in TRIANGLES and len(chosen):
                triangles.setdefault(name, []).append(cells[chosen, :3])
            if kind in TETRAHEDRA:
                if len(chosen):
                    elements.setdefault(name, []).append(first + chosen)
                first += len(cells)
    return _joined(triangles), _joined(elements)


def _joined(parts: dict[str, list[Numbers]]) -> dict[str, Numbers]:
    return {name: np.concatenate(each) for name, each in parts.items()}


def _members(mesh: Any, blocks: list[tuple[str, Numbers]]) -> dict[str, list[Numbers]]:
    """Sets of cells by name: which cells of each block belong to them."""
    found = {
        name: [np.asarray([] if each is None else each, np.int64) for each in members]
        for name, members in mesh.cell_sets.items()
        if not name.startswith("gmsh:")
    }
    for key, values in mesh.cell_data.items():
        if key == PHYSICAL:
            found = _physical_groups(mesh, blocks, values) | found
        elif ":" not in key:
            found |= _flagged(key, [np.asarray(each) for each in values])
    return found


def _physical_groups(
    mesh: Any, blocks: list[tuple[str, Numbers]], values: list[Any]
) -> dict[str, list[Numbers]]:
    """Gmsh's physical groups, by their names or else as ``physical_7``."""
    names = {(int(tag), int(rank)): name for name, (tag, rank) in mesh.field_data.items()}
    found: dict[str, list[Numbers]] = {}
    for place, ((kind, _), tags) in enumerate(zip(blocks, values, strict=True)):
        rank = SURFACE_RANK + (kind in TETRAHEDRA)
        for tag in np.unique(tags):
            if tag == 0 or kind not in (*TETRAHEDRA, *TRIANGLES):
                continue
            name = names.get((int(tag), rank), f"physical_{tag}")
            mine = found.setdefault(name, [np.zeros(0, np.int64) for _ in blocks])
            mine[place] = np.flatnonzero(np.asarray(tags) == tag)
    return found


def _flagged(key: str, values: list[Numbers]) -> dict[str, list[Numbers]]:
    """Sets that a field of whole numbers on cells stands for."""
    names = _names(key, values)
    return {
        name: [np.flatnonzero(each == value) for each in values] for name, value in names.items()
    }


def _names(key: str, values: list[Numbers]) -> dict[str, int]:
    """Names of the sets that a field of whole numbers stands for, with the value of each."""
    if any(each.ndim != 1 or each.dtype.kind not in "iub" for each in values) or not values:
        return {}
    found = np.unique(np.concatenate([np.unique(each) for each in values]).astype(np.int64))
    if set(found) <= set(range(FLAG_VALUES)):
        return {key: 1} if 1 in found else {}
    kept = [int(value) for value in found if value > 0]
    return {f"{key}_{value}": value for value in kept} if len(kept) <= MOST_SETS else {}


def _node_sets(mesh: Any) -> dict[str, Numbers]:
    """Named sets of nodes (k,): those of the file, and fields of whole numbers on nodes."""
    found = {name: np.asarray(each, np.int64) for name, each in mesh.point_sets.items()}
    for key, given in mesh.point_data.items():
        values = np.asarray(given)
        for name, value in _names(key, [values]).items() if ":" not in key else ():
            found[name] = np.flatnonzero(values == value)
    return found


def write_with_sets(path: Path, mesh: Mesh) -> None:
    """Write a mesh as a .vtu or .xdmf file, its sets as fields of 0 and 1 on cells."""
    import meshio

    triangles, members = _own_triangles(mesh)
    cells = [("tetra10", reordered(mesh.tets)), ("triangle6", triangles)]
    data = {name: [np.zeros(len(each), np.int8) for _, each in cells] for name in members}
    for name, chosen in members.items():
        data[name][1][chosen] = 1
    for name, elements in mesh.regions.items():
        data.setdefault(name, [np.zeros(len(each), np.int8) for _, each in cells])
        data[name][0][elements] = 1
    if not len(triangles):
        cells, data = cells[:1], {name: each[:1] for name, each in data.items()}
    if path.suffix.lower() == ".xdmf":
        write_xdmf(path, mesh.nodes, cells, {}, data)
    else:
        meshio.vtu.write(path, meshio.Mesh(mesh.nodes, cells, cell_data=data))


def _own_triangles(mesh: Mesh) -> tuple[Numbers, dict[str, Numbers]]:
    """The triangles (k, 6) of all surfaces, each once, and which each surface has."""
    every = mesh.triangles(*mesh.surfaces)
    triangles, place = np.unique(every, axis=0, return_inverse=True)
    sizes = [len(each) for each in mesh.surfaces.values()]
    parts = np.split(place.reshape(-1), np.cumsum(sizes)[:-1]) if sizes else []
    return triangles, dict(zip(mesh.surfaces, parts, strict=True))


def write_gmsh(path: Path, mesh: Mesh) -> None:
    """Write a mesh as a Gmsh file (2.2, text), its sets as physical groups.

    A triangle of two surfaces stands there twice: an element has one physical group.
    """
    import meshio

    cells: list[tuple[str, Numbers]] = [("tetra10", reordered(mesh.tets))]
    tags = [np.asarray(mesh.region_of_tet, np.int32)]
    names = {name: [tag, 3] for tag, name in enumerate(mesh.regions, start=1)}
    for tag, (name, triangles) in enumerate(mesh.surfaces.items(), start=1):
        _check_unused(name, names)
        names[name] = [tag, 2]
        cells.append(("triangle6", triangles))
        tags.append(np.full(len(triangles), tag, np.int32))
    data = {PHYSICAL: tags, "gmsh:geometrical": tags}
    field_data = {name: np.array(pair) for name, pair in names.items()}
    content = meshio.Mesh(mesh.nodes, cells, cell_data=data, field_data=field_data)
    meshio.gmsh.write(path, content, "2.2", binary=False)


def _check_unused(name: str, names: dict[str, Any]) -> None:
    if name in names:
        raise SolverError(
            f"write_mesh: {name!r} names a surface and a region; a .msh file takes one of them."
        )
