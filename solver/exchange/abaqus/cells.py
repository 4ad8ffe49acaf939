"""Elements of Abaqus and CalculiX: their types, the order of their nodes, their faces."""

from __future__ import annotations

import re

import numpy as np

from solver.exchange.found import Numbers

TETRAHEDRON = re.compile(r"C3D(4|10)(H|M|MH|T|I|HS|MT|E|P|HT|MHT)?", re.IGNORECASE)
"""Types of tetrahedra with their nodes, and letters for formulations, which a mesh has not."""

TRIANGLE = re.compile(
    r"(S3|S3R|S3RS|STRI3|M3D3|SFM3D3|R3D3|CPS3|CPE3|CPE3H|S6|STRI65|M3D6|SFM3D6|CPS6|CPE6|CPE6H|CPS6M)",
    re.IGNORECASE,
)
"""Types of triangles, which name surfaces: of shells, membranes, and plane ones as Gmsh writes."""

BELOW = re.compile(r"(T|B|MASS|SPRING|CONN|DASHPOT|DCOUP|ROTARY)", re.IGNORECASE)
"""Beginnings of types that are neither volumes nor surfaces: bars, points."""

ABAQUS_ORDER = (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)
"""Places in Gmsh's order of a ten-node tetrahedron's nodes, in that of Abaqus, CalculiX and VTK:
the last two mid-nodes are those of (1, 3) and (2, 3) there, and the other way round here."""


def reordered(tets: Numbers) -> Numbers:
    """Nodes (e, 4 or 10) from Gmsh's order to Abaqus's, or back, which is the same exchange."""
    swapped: Numbers = tets[:, ABAQUS_ORDER] if tets.shape[1] == 10 else tets
    return swapped


def faces_of(triangles: Numbers, tets: Numbers, size: int) -> Numbers:
    """Element and face, from 0, on which each triangle (k, 6) lies with outward normal, (k, 2).

    -1 where there is none. ``size``: number of nodes. The faces of ``solver.mesh.faces.FACES`` are
    Abaqus's S1 to S4 (1-2-3, 1-4-2, 2-4-3, 3-4-1) in this order.
    """
    from solver.mesh.faces import FACES, face_keys

    keys = np.concatenate([face_keys(tets[:, face], size) for face in FACES])
    order = np.argsort(keys, kind="stable")
    wanted = face_keys(triangles, size)
    place = np.searchsorted(keys[order], wanted).clip(max=len(keys) - 1)
    found = order[place]
    face, element = np.divmod(found, len(tets))
    pairs = np.stack([element, face], axis=1)
    pairs[keys[found] != wanted] = -1
    return pairs
