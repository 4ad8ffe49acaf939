"""How close a deformed surface comes to itself across the air: rays along its outward normals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh import Mesh

OPPOSING = -0.5
"""Cosine between the normals of two facets, at most, for them to face each other."""

LIFT = 1e-4
"""mm. A ray starts this far above its facet, so as not to hit it."""


@dataclass(frozen=True)
class Gaps:
    """Pairs of facets of a surface that look at each other across the air, one per ray.

    - ``distances`` (k,): width of the air between them, mm; negative where a facet lies inside
      the body, by how far.
    - ``starts``, ``ends`` (k, 3): centres of the two facets in the undeformed body, mm.
    """

    distances: Reals
    starts: Reals
    ends: Reals


def facing_gaps(mesh: Mesh, displacement: Reals, surface: str) -> Gaps:
    """Gaps of ``surface`` to itself after ``displacement`` (n, 3), seen from every facet.

    Six-node triangles are split into four flat facets. A ray from each runs outwards to the first
    facet it meets; it counts if the two face each other, or if it leaves the body there, which
    means that it began inside.
    """
    import trimesh

    facets = _flat_facets(mesh.triangles(surface))
    body = trimesh.Trimesh(mesh.nodes + displacement, facets, process=False)
    centres, normals = body.triangles_center, body.face_normals
    hits, rays, met = body.ray.intersects_location(
        centres + LIFT * normals, normals, multiple_hits=False
    )[0:3]
    distances = np.linalg.norm(hits - centres[rays], axis=1)
    cosine = np.einsum("ki,ki->k", normals[rays], normals[met])
    kept = np.abs(cosine) >= -OPPOSING
    signed = np.where(cosine > 0, -distances, distances)[kept]
    reference = mesh.nodes[facets].mean(axis=1)
    return Gaps(signed, reference[rays[kept]], reference[met[kept]])


def _flat_facets(triangles: Integers) -> Integers:
    """Six-node triangles (k, 6) as four flat ones each, (4k, 3)."""
    parts = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
    return np.concatenate([triangles[:, part] for part in parts])
