"""From what a file says to a mesh: mid-nodes, surfaces on faces of tetrahedra, regions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from solver.errors import SolverError
from solver.exchange.found import Found, Numbers
from solver.exchange.middles import with_middles, with_middles_in_sets
from solver.mesh.checks import check_elements
from solver.mesh.elements import TETRAHEDRON_EDGES
from solver.mesh.faces import FACES, face_keys, outer_faces, place_of
from solver.mesh.mesh import Mesh


def face_nodes() -> Numbers:
    """Local numbers of a ten-node tetrahedron's nodes on each of its ``FACES``, (4, 6)."""
    middle = {frozenset(ends): 4 + k for k, ends in enumerate(TETRAHEDRON_EDGES)}
    return np.array(
        [
            (a, b, c, *(middle[frozenset(ends)] for ends in ((a, b), (b, c), (c, a))))
            for a, b, c in FACES
        ]
    )


def assembled(found: Found, regions: Sequence[str] | None = None) -> Mesh:
    """The mesh of a file.

    Four-node tetrahedra get mid-nodes, nodes of no tetrahedron go, triangles become faces of
    tetrahedra with their mid-nodes, and a set of nodes the outer faces that lie in it wholly. The
    sets of elements named by ``regions`` become regions; without it all but those of every element,
    and of equal ones the last.

    Raises ``SolverError``: no tetrahedra, a tetrahedron that is folded or turned inside out, a
    triangle that is no face of one, a set of elements that is not there, or ones that overlap.
    """
    if not len(found.tets):
        raise SolverError("it has no tetrahedra.")
    solid = _compact(_quadratic(found))
    check_elements(Mesh(solid.nodes, solid.tets))
    return Mesh(solid.nodes, solid.tets, _surfaces(solid), _regions(found, regions))


def _quadratic(found: Found) -> Found:
    """The same with ten-node tetrahedra."""
    if found.tets.shape[1] == 10:
        return found
    nodes, tets, edges = with_middles(found.nodes, found.tets)
    sets = with_middles_in_sets(dict(found.node_sets), edges, len(found.nodes))
    return Found(nodes, tets, found.triangles, found.faces, sets, found.element_sets)


def _compact(found: Found) -> Found:
    """The same without the nodes that no tetrahedron has; -1 stands for them in triangles."""
    used, tets = np.unique(found.tets, return_inverse=True)
    number = np.full(len(found.nodes), -1)
    number[used] = np.arange(len(used))
    return Found(
        found.nodes[used],
        tets.reshape(found.tets.shape),
        {name: number[nodes] for name, nodes in found.triangles.items()},
        found.faces,
        {name: number[nodes] for name, nodes in found.node_sets.items()},
        found.element_sets,
    )


def _surfaces(found: Found) -> dict[str, Numbers]:
    """Named triangles (k, 6): those of faces and triangles first, then those of sets of nodes."""
    skin = _Skin(found)
    surfaces = {name: skin.of_faces(pairs) for name, pairs in found.faces.items()}
    for name, triangles in found.triangles.items():
        if len(triangles):
            mine = skin.of_triangles(name, triangles)
            surfaces[name] = _once((*surfaces.get(name, ()), *mine))
    for name, nodes in found.node_sets.items():
        mine = skin.within(nodes)
        if name not in surfaces and 0 < len(mine) < skin.size:  # a set of all nodes is no surface
            surfaces[name] = mine
    return surfaces


class _Skin:
    """The faces of a mesh, found by their corners."""

    def __init__(self, found: Found) -> None:
        self._nodes, self._tets = found.nodes, found.tets
        every = found.tets[:, face_nodes()].reshape(-1, 6)
        keys = face_keys(every, len(found.nodes))
        outer = np.isin(keys, outer_faces(found.nodes, found.tets))
        self._outer = every[outer]
        # outer faces first: a triangle without a direction of its own takes theirs
        self._faces = np.concatenate([self._outer, every[~outer]])

    @property
    def size(self) -> int:
        """Number of outer faces."""
        return len(self._outer)

    def of_faces(self, pairs: Numbers) -> Numbers:
        """Triangles (k, 6) of elements' faces (k, 2)."""
        local = face_nodes()[pairs[:, 1]]
        triangles: Numbers = np.take_along_axis(self._tets[pairs[:, 0]], local, axis=1)
        return triangles

    def of_triangles(self, name: str, triangles: Numbers) -> Numbers:
        """The faces (k, 6) on ``triangles`` (k, 3 or more), turned outwards where they are outer.

        Raises ``SolverError`` for a triangle that is no face.
        """
        size = len(self._nodes)
        wanted = face_keys(np.sort(triangles[:, :3], axis=1), size)
        own = face_keys(np.sort(self._faces[:, :3], axis=1), size)
        keys, first = np.unique(own, return_index=True)
        place = np.searchsorted(keys, wanted).clip(max=len(keys) - 1)
        stray = (keys[place] != wanted) | (triangles[:, :3] < 0).any(axis=1)
        if stray.any():
            raise SolverError(
                f"{stray.sum()} of {len(stray)} triangles of {name!r} are no faces of tetrahedra"
                f"{self._where(triangles[stray][0])}."
            )
        return self._turned(self._faces[first[place]], triangles)

    def within(self, nodes: Numbers) -> Numbers:
        """The outer faces (k, 6) all of whose nodes are among ``nodes``."""
        marked = np.zeros(len(self._nodes) + 1, bool)
        marked[nodes] = True
        marked[-1] = False  # stands for nodes of no tetrahedron
        return self._outer[marked[self._outer].all(axis=1)]

    def _turned(self, faces: Numbers, triangles: Numbers) -> Numbers:
        """Faces within the body turned as the triangles are; outer ones stay."""
        size = len(self._nodes)
        outer = np.isin(face_keys(faces, size), face_keys(self._outer, size))
        other = face_keys(faces, size) != face_keys(triangles, size)
        turned = faces[:, [0, 2, 1, 5, 4, 3]]
        return np.where((other & ~outer)[:, None], turned, faces)

    def _where(self, triangle: Numbers) -> str:
        return (
            "" if (triangle < 0).any() else f", the first at {place_of(self._nodes, triangle)} mm"
        )


def _once(triangles: Iterable[Numbers]) -> Numbers:
    """Triangles, each once, in the order given."""
    table = np.array(list(triangles))
    _, first = np.unique(table, axis=0, return_index=True)
    return table[np.sort(first)]


def _regions(found: Found, wanted: Sequence[str] | None) -> dict[str, Numbers]:
    """Sets of elements that are regions. Raises ``SolverError`` for an unknown or shared one."""
    sets = found.element_sets
    for name in wanted or ():
        if name not in sets:
            known = ", ".join(sets) or "none"
            raise SolverError(f"it has no set of elements {name!r}; it has: {known}.")
    chosen = {
        name: np.unique(sets[name])
        for name in (sets if wanted is None else wanted)
        if wanted is not None or 0 < len(np.unique(sets[name])) < len(found.tets)
    }
    chosen = _last_of_equal(chosen)
    _require_disjoint(chosen)
    return chosen


def _last_of_equal(sets: dict[str, Numbers]) -> dict[str, Numbers]:
    """Sets without those that a later one repeats: Gmsh names a volume, then its group."""
    latest = {members.tobytes(): name for name, members in sets.items()}
    return {name: members for name, members in sets.items() if latest[members.tobytes()] == name}


def _require_disjoint(sets: dict[str, Numbers]) -> None:
    names = list(sets)
    for place, one in enumerate(names):
        for other in names[place + 1 :]:
            shared = np.intersect1d(sets[one], sets[other])
            if len(shared):
                raise SolverError(
                    f"the sets of elements {one!r} and {other!r} share {len(shared)} tetrahedra; "
                    "regions must be disjoint: choose with regions=(...)."
                )
