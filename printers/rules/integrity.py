"""The mesh must be the boundary of one solid body: closed, oriented, without self-intersection."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from printers.arrays import Floats, Ints
from printers.measure.box_tree import Crossings, crossings
from printers.measure.part import MeasuredPart
from printers.measure.shells import NEGLIGIBLE_VOLUME, Shells
from printers.measure.surface import Surface
from printers.report import RuleResult, Verdict, pass_or_fail, place

SLIVER = 1e-5
"""mm. Numbers of 32 bits, as an STL has them, are 0.8e-5 mm apart at 100 mm."""

TOUCHING = 1e-5  # mm: less penetration than this is rounding of the coordinates


def check_watertight(part: MeasuredPart) -> Iterator[RuleResult]:
    """Every edge must lie between exactly two triangles that run along it in opposite senses."""
    found = _bad_edges(part.surface)
    count = sum(len(edges) for edges in found.values())
    message, where = "the mesh is closed and evenly oriented", "whole mesh"
    middle: tuple[Floats, ...] = ()
    if found:
        text = ", ".join(f"{len(edges)} {name}" for name, edges in found.items())
        message = f"the mesh is not the boundary of a solid: it has {text}"
        middle = (_middle_of_edge(part.surface, int(next(iter(found.values()))[0])),)
        where = place(middle[0])
    verdict = pass_or_fail(not found)
    result = RuleResult("watertight", verdict, count, 0, "bad edges", where, message, 0.0)
    yield result.at(*middle)


def check_self_intersection(part: MeasuredPart) -> Iterator[RuleResult]:
    """No edge may pierce a triangle it does not touch by more than rounding."""
    pierced = _pierced(part.surface)
    count = len(pierced.triangle)
    where, message = "whole mesh", "the surface nowhere passes through itself"
    if count:
        where = place(part.surface.corners[pierced.triangle[0]].mean(axis=0))
        message = f"the surface passes through itself in {count} places, first near {where}"
    verdict = pass_or_fail(not count)
    result = RuleResult("self_intersection", verdict, count, 0, "crossings", where, message, 0.0)
    yield result.at(*part.surface.corners[pierced.triangle[:1]].mean(axis=1))


def check_slivers(part: MeasuredPart) -> Iterator[RuleResult]:
    """A triangle lower than the numbers of an STL can tell is a line to a slicer, or a hole."""
    surface = part.surface
    sides = surface.corners - np.roll(surface.corners, 1, axis=1)
    longest = np.linalg.norm(sides, axis=2).max(axis=1)
    height = 2 * surface.areas / np.maximum(longest, 1e-300)
    thin = np.flatnonzero(height < SLIVER)
    where, message = "whole mesh", "no triangle is too thin for a slicer"
    if len(thin):
        where = place(surface.corners[thin[0]].mean(axis=0))
        message = (
            f"{len(thin)} triangles are lower than {SLIVER:g} mm, first at {where}: slicers drop "
            "them"
        )
    verdict: Verdict = "warn" if len(thin) else "pass"
    result = RuleResult("slivers", verdict, len(thin), 0, "triangles", where, message, 0.0)
    yield result.at(*surface.corners[thin[:1]].mean(axis=1))


def check_one_body(part: MeasuredPart) -> Iterator[RuleResult]:
    """Exactly one shell may enclose material; an inside-out mesh encloses none."""
    shells = part.shells
    count, where = len(shells.bodies), "whole mesh"
    others: list[int] = []
    if count == 1:
        message = f"one solid body of {shells.material:.1f} mm³"
    elif count == 0 and shells.voids:
        message = "the surface is inside out: its normals point into the material"
    elif count == 0:
        message = (
            f"the surface is flat: no piece of it encloses more than {NEGLIGIBLE_VOLUME:g} mm³"
        )
    else:
        main, *others = sorted(shells.bodies, key=lambda shell: -shells.bodies[shell])
        where = "; ".join(place(shells.middle(shell)) for shell in others[:5])
        named = ", ".join(_described(shells, shell, main) for shell in others[:5])
        message = f"the mesh holds {count} bodies; it must be one: beside the largest {named}"
    verdict = pass_or_fail(count == 1)
    result = RuleResult("one_body", verdict, count, 1, "bodies", where, message, 0.0)
    yield result.at(*(shells.middle(shell) for shell in others[:5]))


def _described(shells: Shells, shell: int, main: int) -> str:
    """A body beside the `main` one; within it, it is rather a cavity whose shell is flipped."""
    size = f"{shells.bodies[shell]:.1f} mm³ at {place(shells.middle(shell))}"
    low, high = shells.bounds(main)
    inner_low, inner_high = shells.bounds(shell)
    within = bool((inner_low > low).all() and (inner_high < high).all())
    return f"{size}, whose shell looks the wrong way if it is a cavity" if within else size


def _bad_edges(surface: Surface) -> dict[str, Ints]:
    """Numbers of the edges with a defect, by its name, defects that do not occur left out."""
    uses, balance = surface.edge_uses, surface.edge_balance
    defects = {
        "open edges": uses == 1,
        "edges shared by more than two triangles": uses > 2,
        "edges between triangles of opposite orientation": (uses == 2) & (balance > 0),
    }
    return {name: np.flatnonzero(bad) for name, bad in defects.items() if bad.any()}


def _middle_of_edge(surface: Surface, edge: int) -> Floats:
    half_edge = int(np.flatnonzero(surface.edge_number == edge)[0])
    return np.asarray(surface.vertices[surface.half_edges[half_edge]].mean(axis=0))


def _pierced(surface: Surface) -> Crossings:
    edges = surface.half_edges[np.unique(surface.edge_number, return_index=True)[1]]
    start, end = surface.vertices[edges[:, 0]], surface.vertices[edges[:, 1]]
    found = crossings(surface.tree, start, end)
    corners, ends = surface.triangles[found.triangle], edges[found.segment]
    touched = (corners[:, :, None] == ends[:, None]).any(axis=(1, 2))
    apart = found.chosen(~touched)
    return apart.chosen(_depth(surface, apart, start, end) > TOUCHING)


def _depth(
    surface: Surface,
    found: Crossings,
    start: Floats,
    end: Floats,
) -> Floats:
    """How far the edge reaches through the triangle's plane on the shorter side, and its rim."""
    normal = surface.normals[found.triangle]
    through = np.abs(np.einsum("ij,ij->i", normal, (end - start)[found.segment]))
    across = through * np.minimum(found.fraction, 1 - found.fraction)
    sides = surface.corners[found.triangle] - np.roll(surface.corners[found.triangle], 1, axis=1)
    longest = np.linalg.norm(sides, axis=2).max(axis=1)
    least_height = 2 * surface.areas[found.triangle] / np.maximum(longest, 1e-300)
    return np.minimum(across, found.inside * least_height)
