"""Gaps between facing parts of deformed surfaces, by rays along their outward normals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.mesh.mesh import Mesh

OPPOSING = -0.5
"""Cosine between the normals of two facets, at most, for them to face each other."""

LIFT = 1e-4
"""Distance of a ray's start from its facet, mm, so that it does not hit that facet."""


@dataclass(frozen=True)
class Gaps:
    """Pairs of facing facets, one per ray.

    - ``distances`` (k,): width of the gap between them, mm; where a facet lies inside the body,
      minus its depth.
    - ``starts``, ``ends`` (k, 3): centres of the two facets in the undeformed body, mm.
    - ``surfaces`` (k,): from which of the surfaces each ray starts, in the order asked for.
    """

    distances: Reals
    starts: Reals
    ends: Reals
    surfaces: Integers

    def chosen(self, rows: NDArray[np.bool_]) -> Gaps:
        """Some of the pairs."""
        return Gaps(self.distances[rows], self.starts[rows], self.ends[rows], self.surfaces[rows])


def facing_gaps(
    mesh: Mesh, displacement: Reals, *surfaces: str, seen_from: Sequence[str] | None = None
) -> Gaps:
    """Gaps of ``surfaces`` to each other after ``displacement`` (n, 3), by a ray from each facet.

    ``seen_from``: those of the surfaces from whose facets rays start; by default all.

    Together the surfaces should bound the body: a ray that enters it through an opening hits walls
    from inside, which counts as an overlap.

    Six-node triangles are split into four flat facets. A ray from each runs outwards to the first
    facet that it hits; it counts if the two face each other, or if it leaves the body there, which
    means that it started inside.
    """
    import trimesh

    sources = surfaces if seen_from is None else tuple(seen_from)
    others = tuple(name for name in surfaces if name not in sources)
    starts = _flat_facets(mesh.triangles(*sources))
    facets = np.concatenate([starts, _flat_facets(mesh.triangles(*others))])
    lengths = [len(mesh.surfaces[name]) for name in sources]
    surface = np.tile(np.repeat(np.arange(len(sources), dtype=np.int32), lengths), len(PARTS))
    body = trimesh.Trimesh(mesh.nodes + displacement, facets, process=False)
    centres, normals = body.triangles_center, body.face_normals
    rays, hit, ahead = _first_hits(
        body, centres, normals, only=np.arange(len(starts), dtype=np.int32)
    )
    cosine = np.einsum("ki,ki->k", normals[rays], normals[hit])
    kept = np.abs(cosine) >= -OPPOSING
    rays, hit, ahead, inside = rays[kept], hit[kept], ahead[kept], cosine[kept] > 0
    behind = np.full(len(centres), np.inf)
    back, _, depths = _first_hits(body, centres, -normals, only=np.unique(rays[inside]))
    behind[back] = depths
    signed = np.where(inside, -np.minimum(ahead, behind[rays]), ahead)
    reference = mesh.nodes[facets].mean(axis=1)
    return Gaps(signed, reference[rays], reference[hit], surface[rays])


def facet_normals(mesh: Mesh, displacement: Reals, *surfaces: str) -> tuple[Reals, Reals]:
    """Centres and outward unit normals (k, 3) of the flat facets of deformed surfaces."""
    corners = (mesh.nodes + displacement)[_flat_facets(mesh.triangles(*surfaces))]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return corners.mean(axis=1), normals


def _first_hits(
    body: Any, origins: Reals, directions: Reals, only: Integers | None = None
) -> tuple[Integers, Integers, Reals]:
    """Rays that hit a facet, the first facet of each, and its distance, mm."""
    chosen = np.arange(len(origins)) if only is None else only
    start, along = origins[chosen], directions[chosen]
    points, rays, hit = body.ray.intersects_location(
        start + LIFT * along, along, multiple_hits=False
    )[0:3]
    return chosen[rays], hit, np.linalg.norm(points - start[rays], axis=1)


def _flat_facets(triangles: Integers) -> Integers:
    """Six-node triangles (k, 6) as four flat ones each, (4k, 3)."""
    return np.concatenate([triangles[:, part] for part in PARTS])


PARTS = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
"""Nodes of the flat facets of a six-node triangle."""
