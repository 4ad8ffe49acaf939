"""The mesh of an input file: nodes, elements by region, sets of nodes, surfaces."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import numpy as np

from solver.errors import SolverError
from solver.exchange.abaqus.cells import faces_of, reordered
from solver.exchange.found import Numbers
from solver.mesh.faces import place_of
from solver.mesh.mesh import Mesh

LABEL = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,59}")
"""Names that every program of this format takes, with what is put before and behind them."""

REST_LABEL, ALL_LABEL = "rest", "all_elements"


def mesh_text(mesh: Mesh, element: str = "C3D10") -> Iterator[str]:
    """Lines of a mesh whose elements have the type ``element``.

    Numbers count from 1 in the order of the mesh. Each surface is one of elements' faces and, under
    the same name, a set of its nodes.

    Raises ``SolverError`` for a name that is no label, two that differ in case only, or a triangle
    that is no face of a tetrahedron.
    """
    _check_labels(mesh)
    yield "*NODE"
    for number, (x, y, z) in enumerate(mesh.nodes.tolist(), start=1):
        yield f"{number}, {x!r}, {y!r}, {z!r}"
    tets = reordered(mesh.tets) + 1
    for name, elements in parts(mesh).items():
        yield f"*ELEMENT, TYPE={element}, ELSET={name}"
        for number in elements:
            yield f"{number + 1}, {', '.join(map(str, tets[number].tolist()))}"
    if mesh.regions:
        yield f"*ELSET, ELSET={ALL_LABEL}"
        yield from parts(mesh)
    for name in mesh.surfaces:
        yield from _surface(mesh, name)


def parts(mesh: Mesh) -> dict[str, Numbers]:
    """Names and elements of the regions and of the rest, as far as there are any."""
    rest = np.flatnonzero(mesh.region_of_tet == 0)
    name = REST_LABEL if mesh.regions else ALL_LABEL
    return {**({name: rest} if len(rest) else {}), **mesh.regions}


def rows(numbers: Iterable[int], of: int = 10) -> Iterator[str]:
    """Numbers in lines, ``of`` so many each."""
    texts = [str(number) for number in numbers]
    for start in range(0, len(texts), of):
        yield ", ".join(texts[start : start + of])


def _surface(mesh: Mesh, name: str) -> Iterator[str]:
    triangles = mesh.triangles(name)
    pairs = faces_of(triangles, mesh.tets, len(mesh.nodes))
    if (pairs < 0).any():
        stray = triangles[(pairs < 0).any(axis=1)][0]
        raise SolverError(
            f"mesh: a triangle of the surface {name!r} at {place_of(mesh.nodes, stray)} mm is no "
            "face of a tetrahedron."
        )
    yield f"*NSET, NSET={name}"
    yield from rows((mesh.surface_nodes(name) + 1).tolist())
    numbers = [np.sort(pairs[pairs[:, 1] == face, 0]) + 1 for face in range(4)]
    for face, elements in enumerate(numbers, start=1):
        if len(elements):
            yield f"*ELSET, ELSET=_{name}_S{face}, INTERNAL"
            yield from rows(elements.tolist())
    yield f"*SURFACE, NAME={name}, TYPE=ELEMENT"
    for face, elements in enumerate(numbers, start=1):
        if len(elements):
            yield f"_{name}_S{face}, S{face}"


def _check_labels(mesh: Mesh) -> None:
    """Raise ``SolverError`` for a name that the format does not take."""
    for sets in (mesh.surfaces, mesh.regions):
        seen: dict[str, str] = {REST_LABEL.upper(): REST_LABEL, ALL_LABEL.upper(): ALL_LABEL}
        for name in sets:
            if not LABEL.fullmatch(name):
                raise SolverError(
                    f"mesh: {name!r} cannot be a name in an input file; it takes letters, digits, "
                    "- and _, a letter first, 60 at most."
                )
            if name.upper() in seen:
                raise SolverError(
                    f"mesh: {name!r} and {seen[name.upper()]!r} are one name in an input file."
                )
            seen[name.upper()] = name
