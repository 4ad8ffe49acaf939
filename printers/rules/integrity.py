"""Is the mesh the boundary of one solid body: closed, oriented, free of self-intersections?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from printers.measure.box_tree import Crossings, crossings
from printers.measure.shells import Shells
from printers.measure.surface import Surface
from printers.report import RuleResult, place

TOUCHING = 1e-5  # mm: less penetration than this is rounding of the coordinates


def check_watertight(surface: Surface) -> RuleResult:
    """Every edge must lie between exactly two triangles that run along it in opposite senses."""
    uses = np.bincount(surface.edge_number)
    forward = surface.half_edges[:, 0] < surface.half_edges[:, 1]
    balance = np.abs(np.bincount(surface.edge_number, weights=np.where(forward, 1.0, -1.0)))
    defects = (
        ("open edges", uses == 1),
        ("edges shared by more than two triangles", uses > 2),
        ("edges between triangles of opposite orientation", (uses == 2) & (balance > 0)),
    )
    found = [(name, np.flatnonzero(bad)) for name, bad in defects if bad.any()]
    bad_edges = sum(len(edges) for _, edges in found)
    if found:
        text = ", ".join(f"{len(edges)} {name}" for name, edges in found)
        message = f"the mesh is not the boundary of a solid: it has {text}"
        where = place(_middle_of_edge(surface, int(found[0][1][0])))
    else:
        message, where = "the mesh is closed and evenly oriented", "whole mesh"
    return RuleResult(
        "watertight", "fail" if found else "pass", bad_edges, 0, "bad edges", where, message
    )


def check_self_intersection(surface: Surface) -> RuleResult:
    """No edge may pierce a triangle it does not touch by more than rounding."""
    pierced = _pierced(surface)
    count = len(pierced.triangle)
    where, message = "whole mesh", "the surface nowhere passes through itself"
    if count:
        where = place(surface.corners[pierced.triangle[0]].mean(axis=0))
        message = f"the surface passes through itself in {count} places, first near {where}"
    return RuleResult(
        "self_intersection", "fail" if count else "pass", count, 0, "crossings", where, message
    )


def check_one_body(shells: Shells) -> RuleResult:
    """Exactly one shell may enclose material; an inside-out mesh encloses none."""
    count = len(shells.bodies)
    if count == 1:
        message = f"one solid body of {shells.material:.1f} mm³"
    elif count == 0:
        message = "the surface is inside out: its normals point into the material"
    else:
        volumes = ", ".join(f"{volume:.1f}" for volume in sorted(shells.bodies.values())[::-1][:5])
        message = f"the mesh holds {count} separate bodies (mm³: {volumes}); it must be one"
    return RuleResult(
        "one_body", "pass" if count == 1 else "fail", count, 1, "bodies", "whole mesh", message
    )


def _middle_of_edge(surface: Surface, edge: int) -> NDArray[np.float64]:
    half_edge = int(np.flatnonzero(surface.edge_number == edge)[0])
    return np.asarray(surface.vertices[surface.half_edges[half_edge]].mean(axis=0))


def _pierced(surface: Surface) -> Crossings:
    edges = surface.half_edges[np.unique(surface.edge_number, return_index=True)[1]]
    start, end = surface.vertices[edges[:, 0]], surface.vertices[edges[:, 1]]
    found = crossings(surface.tree, start, end)
    corners, ends = surface.triangles[found.triangle], edges[found.segment]
    touched = (corners[:, :, None] == ends[:, None]).any(axis=(1, 2))
    apart = _chosen(found, ~touched)
    return _chosen(apart, _depth(surface, apart, start, end) > TOUCHING)


def _depth(
    surface: Surface,
    found: Crossings,
    start: NDArray[np.float64],
    end: NDArray[np.float64],
) -> NDArray[np.float64]:
    """How far the edge reaches through the triangle's plane on the shorter side, and its rim."""
    normal = surface.normals[found.triangle]
    through = np.abs(np.einsum("ij,ij->i", normal, (end - start)[found.segment]))
    across = through * np.minimum(found.fraction, 1 - found.fraction)
    sides = surface.corners[found.triangle] - np.roll(surface.corners[found.triangle], 1, axis=1)
    longest = np.linalg.norm(sides, axis=2).max(axis=1)
    least_height = 2 * surface.areas[found.triangle] / np.maximum(longest, 1e-300)
    return np.minimum(across, found.inside * least_height)


def _chosen(found: Crossings, which: NDArray[np.bool_]) -> Crossings:
    return Crossings(
        found.segment[which], found.triangle[which], found.fraction[which], found.inside[which]
    )
