"""How close a deformed surface comes to itself across the air: rays along its outward normals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from solver.arrays import Integers, Reals
from solver.mesh.mesh import Mesh

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


def facing_gaps(
    mesh: Mesh, displacement: Reals, *surfaces: str, seen_from: Sequence[str] | None = None
) -> Gaps:
    """Gaps of ``surfaces`` to each other after ``displacement`` (n, 3), seen from every facet.

    ``seen_from``: those of the surfaces whose facets look out; without it all of them.

    Together the surfaces should close the body: a ray that slips in through a hole meets walls
    from within and passes for an overlap.

    Six-node triangles are split into four flat facets. A ray from each runs outwards to the first
    facet it meets; it counts if the two face each other, or if it leaves the body there, which
    means that it began inside.
    """
    import trimesh

    looking = surfaces if seen_from is None else tuple(seen_from)
    others = tuple(name for name in surfaces if name not in looking)
    outlook = _flat_facets(mesh.triangles(*looking))
    facets = np.concatenate([outlook, _flat_facets(mesh.triangles(*others))])
    body = trimesh.Trimesh(mesh.nodes + displacement, facets, process=False)
    centres, normals = body.triangles_center, body.face_normals
    rays, met, ahead = _first_met(
        body, centres, normals, only=np.arange(len(outlook), dtype=np.int32)
    )
    cosine = np.einsum("ki,ki->k", normals[rays], normals[met])
    kept = np.abs(cosine) >= -OPPOSING
    rays, met, ahead, inside = rays[kept], met[kept], ahead[kept], cosine[kept] > 0
    behind = np.full(len(centres), np.inf)
    back, _, depths = _first_met(body, centres, -normals, only=np.unique(rays[inside]))
    behind[back] = depths
    signed = np.where(inside, -np.minimum(ahead, behind[rays]), ahead)
    reference = mesh.nodes[facets].mean(axis=1)
    return Gaps(signed, reference[rays], reference[met])


def facet_normals(mesh: Mesh, displacement: Reals, *surfaces: str) -> tuple[Reals, Reals]:
    """Centres and outward unit normals (k, 3) of the flat facets of deformed surfaces."""
    corners = (mesh.nodes + displacement)[_flat_facets(mesh.triangles(*surfaces))]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return corners.mean(axis=1), normals


def _first_met(
    body: Any, origins: Reals, directions: Reals, only: Integers | None = None
) -> tuple[Integers, Integers, Reals]:
    """Rays that meet a facet, the facets, and how far away each is, mm."""
    chosen = np.arange(len(origins)) if only is None else only
    start, along = origins[chosen], directions[chosen]
    hits, rays, met = body.ray.intersects_location(
        start + LIFT * along, along, multiple_hits=False
    )[0:3]
    return chosen[rays], met, np.linalg.norm(hits - start[rays], axis=1)


def _flat_facets(triangles: Integers) -> Integers:
    """Six-node triangles (k, 6) as four flat ones each, (4k, 3)."""
    parts = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
    return np.concatenate([triangles[:, part] for part in parts])
