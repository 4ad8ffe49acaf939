"""Regions of other materials."""

from __future__ import annotations

import numpy as np
from film_strip import bent, strip
from hard_case import Finding, HardCase, at_most, exactly, true, within
from hard_elements import CUBE, inf_sup_constant, least
from meshes import box_mesh
from two_materials import layered

from solver import Solution

RATIOS = (1e3, 1e5, 1e8)


def interfaces() -> tuple[Finding, ...]:
    """The inf-sup constant where pressures may jump: halves, a film, and a grain of one cell."""
    halves = [inf_sup_constant(layered((n, n, n), axis=0, distortion=0.2), CUBE) for n in (2, 4)]
    film = inf_sup_constant(strip(), ("x0", "x1"))
    cube = box_mesh((3, 3, 3))
    inside = np.abs(cube.nodes[cube.tets[:, :4]].mean(axis=1) - 0.5).max(axis=1) < 1 / 6
    grain = inf_sup_constant(cube.with_regions({"grain": np.flatnonzero(inside)}), CUBE)
    every = (*halves, film, grain)
    return (
        within("β on a clamped cube of two halves, 2 meshes", least(halves), 0.1, 1.0),
        within("finer over coarser", halves[1][0] / halves[0][0], 1.0, 2.0),
        within("with a grain of six tetrahedra", grain[0], 0.15, 1.0),
        within("on a strip with a film, 800 : 1", film[0], 0.2, 1.0),
        exactly("spurious pressure modes", sum(modes for _, modes in every), 0),
    )


def stiff_film() -> tuple[Finding, ...]:
    """A strip bent by a quarter of its length over a film of a hundredth of its height."""
    plain, found = bent(1.0), [bent(ratio) for ratio in RATIOS]
    pressures = len(plain.problem.mesh.vertices)
    more = max(each.newton_iterations for each in found) / plain.newton_iterations
    pivots = [each.negative_pivots for each in found]
    return (
        true("each arrives, with no step refused", all(_smooth(each) for each in found)),
        at_most("iterations over those of one material, ratios 1e3 … 1e8", more, 2.0),
        true("one negative pivot for each pressure", pivots == 3 * [pressures], pivots),
    )


def _smooth(found: Solution) -> bool:
    return bool(found.converged and not found.refused_steps)


CASES = (
    HardCase(
        "Pressures that jump at an interface",
        "more pressures than displacements can feel: oscillation, or a singular matrix",
        "one pressure for each vertex and region: β stays, however small the region is",
        interfaces,
    ),
    HardCase(
        "A film stiffer by eight powers of ten",
        "pivots of the soft material are taken for zeros; bending stretches the film, and Newton "
        "overshoots",
        "unknowns are scaled by the stiffness around them; the tangent's stress is extrapolated",
        stiff_film,
        inertia=True,
    ),
)
