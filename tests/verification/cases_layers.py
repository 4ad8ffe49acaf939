"""Layers: laminates and bending of two materials."""

from __future__ import annotations

import numpy as np
from case import Case, Order, Outcome, Row
from layered_walls import Strip, bimetal_curvature
from layers import SOFT, STIFF, TIGHT, region_pressure, solved
from measures import Points, observed_order
from meshes import box_mesh
from scipy.optimize import brentq
from structures import converged
from two_materials import beyond

from solver import (
    AxialForce,
    Couple,
    Mesh,
    Ogden,
    Problem,
    Supports,
    Traction,
    reaction,
    solve,
)

RUBBERS = Ogden.neo_hooke(SOFT), Ogden.neo_hooke(STIFF)


def laminate() -> Mesh:
    """A unit cube; the region ``stiff`` is its upper half in z."""
    mesh = box_mesh((2, 2, 4))
    return mesh.with_regions({"stiff": beyond(mesh, 2, 0.5)})


def mean_at(mesh: Mesh, values: Points, height: float) -> float:
    """Mean of nodal values (n,) at a height of the undeformed body."""
    return float(values[np.isclose(mesh.nodes[:, 2], height)].mean())


def along() -> Outcome:
    """Both layers stretch by the same; each bears what it would alone."""
    mesh, stretch = laminate(), 2.0

    def motion(positions: Points, load: float) -> Points:
        free = np.full(len(positions), np.nan)
        return np.stack([load * (stretch - 1) * positions[:, 0], free, free], axis=1)

    supports = Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}, prescribed={"x1": motion})
    solution = solved(mesh, *RUBBERS, supports)
    force = (SOFT + STIFF) / 2 * (stretch - stretch**-2)
    width = 1 + solution.displacement[mesh.surface_nodes("y1"), 1].max()
    found = region_pressure(solution, lambda at: np.isclose(at[:, 2], 0.5))
    rows = [
        Row("force", force, float(reaction(solution, "x1").force[0]), 1e-8, "N", digits=5),
        Row("greatest width", stretch**-0.5, float(width), 1e-8, "mm"),
    ]
    for modulus, name in ((SOFT, ""), (STIFF, "stiff")):
        exact = modulus * (1 / stretch - stretch**2) / 3
        label = f"pressure at the interface, {name or 'soft'} side"
        rows.append(Row(label, exact, found[name], 1e-8, "MPa"))
    return Outcome(tuple(rows), mesh=f"{len(mesh.tets)} tetrahedra")


def across() -> Outcome:
    """Both layers bear the same; each is compressed as it would be alone."""
    mesh, stress = laminate(), -2.0
    layers = ((SOFT, 5.0), (STIFF, 30.0))
    sides = {"x0": 0, "x1": 0, "y0": 1, "y1": 1, "z0": 2}
    rubbers = [Ogden.neo_hooke(*layer) for layer in layers]
    loads = (Traction("z1", (0, 0, stress)),)
    solution = solved(mesh, *rubbers, Supports(symmetry=sides), loads=loads)
    heights = [mean_at(mesh, solution.displacement[:, 2], z) for z in (0.0, 0.5, 1.0)]
    ours = 1 + np.diff(heights) / 0.5
    rows = (
        Row(f"stretch of the {name} layer", confined_stretch(*layer, stress), float(own), 1e-8)
        for name, layer, own in zip(("soft", "stiff"), layers, ours, strict=True)
    )
    return Outcome(tuple(rows), mesh=f"{len(mesh.tets)} tetrahedra")


def confined_stretch(modulus: float, bulk: float, stress: float) -> float:
    """Stretch of a block whose sides are held, under a stress (MPa) per its constant section."""

    def excess(s: float) -> float:
        return 2 * modulus / 3 * (s ** (1 / 3) - s ** (-5 / 3)) + bulk * (s - 1) - stress

    return float(brentq(excess, 0.1, 3.0, xtol=1e-14))


def sheared() -> Outcome:
    """Both layers bear the same; each is sheared as it would be alone."""
    mesh, stress = laminate(), 0.5
    loads = (
        Traction("z1", (stress, 0, 0)),
        Traction("x1", (0, 0, stress)),
        Traction("x0", (0, 0, -stress)),
    )
    solution = solved(mesh, *RUBBERS, Supports(clamped=("z0",)), loads=loads)
    slips = [mean_at(mesh, solution.displacement[:, 0], z) for z in (0.0, 0.5, 1.0)]
    found = region_pressure(solution, lambda at: np.isclose(at[:, 2], 0.5))
    rows: list[Row] = []
    for name, modulus, slip in zip(("", "stiff"), (SOFT, STIFF), np.diff(slips), strict=True):
        shear, layer = stress / modulus, name or "soft"
        rows.append(Row(f"shear of the {layer} layer", shear, float(slip) / 0.5, 1e-8))
        pressure = -modulus * shear**2 / 3
        rows.append(Row(f"pressure in the {layer} layer", pressure, found[name], 1e-8, "MPa"))
    return Outcome(tuple(rows), mesh=f"{len(mesh.tets)} tetrahedra")


HEIGHTS, LENGTH = (0.6, 0.4), 0.2
"""Of the lower, soft and the upper, stiff layer of a strip, and of its slice, mm."""


def slice_of_strip(elements: int) -> Mesh:
    """A slice 1 mm wide with so many elements over its height, a multiple of 5."""
    mesh = box_mesh((elements // 5, 1, elements), (LENGTH, 1.0, sum(HEIGHTS)))
    return mesh.with_regions({"stiff": beyond(mesh, 2, HEIGHTS[0])})


def turned(mesh: Mesh, *loads: Couple | AxialForce) -> float:
    """Angle per length, 1/mm, of the slice in plane strain under loads on its moving plane."""
    problem = Problem(
        mesh,
        RUBBERS[0],
        Supports(symmetry={"x0": 0, "y0": 1, "y1": 1}),
        loads=loads,
        moving_plane="x1",
        materials={"stiff": RUBBERS[1]},
    )
    solution = converged(solve(problem, options=TIGHT))
    return float(np.radians(solution.path[-1].rotation)) / LENGTH


def bent() -> Outcome:
    """Both ways by large angles, and a little."""
    rows: list[Row] = []
    fine, strip = slice_of_strip(10), Strip(HEIGHTS, (SOFT, STIFF))
    ways = (("outside", 1, strip, (0.1, 0.25)), ("inside", -1, strip.reversed, (0.5, 1.0)))
    for name, way, layers, curvatures in ways:
        for curvature in curvatures:
            ours = way * turned(fine, Couple(way * layers.moment(curvature)))
            label = f"stiff layer {name}: curvature times height"
            rows.append(Row(label, curvature, ours, 1e-4))
    small = 1e-6 * strip.stiffness
    stiffness = small / turned(fine, Couple(small))
    rows.append(Row("stiffness at small angles", strip.stiffness, stiffness, 1e-3, "N mm²"))
    errors = [
        abs(turned(slice_of_strip(n), Couple(-strip.reversed.moment(1.0))) + 1) for n in COUNTS
    ]
    order = Order("the curvature", observed_order(COUNTS, errors), 3.5, "4")
    mesh = f"slice of {len(fine.tets)} tetrahedra; order on {len(COUNTS)} meshes"
    return Outcome(tuple(rows), (order,), mesh)


COUNTS = (10, 15, 20)


def warmed() -> Outcome:
    """The loads that are equivalent to a misfit: what would undo it, turned round."""
    misfit, height = 1e-6, HEIGHTS[0] + HEIGHTS[1] / 2
    force = 4 * STIFF * HEIGHTS[1] * misfit
    ours = turned(slice_of_strip(5), AxialForce(force), Couple(force * height))
    exact = bimetal_curvature(HEIGHTS, (SOFT, STIFF), misfit)
    return Outcome((Row("curvature over misfit", exact / misfit, ours / misfit, 1e-3, "1/mm"),))


CASES = (
    Case(
        "L1 Laminate pulled along its layers",
        "A cube of two incompressible layers, one 20 times as stiff, is pulled to twice its "
        "length: the strain is the same everywhere, the stresses add up, and the hydrostatic "
        "pressure jumps at the interface.",
        "Homogeneous stretch of each layer. Status: exact.",
        along,
    ),
    Case(
        "L1 Laminate pressed across its layers",
        "The same cube, of compressible layers and its sides held, under a dead stress on top: "
        "each layer is pressed as if it were alone.",
        "Confined compression of each layer. Status: exact.",
        across,
    ),
    Case(
        "L1 Laminate sheared across its layers",
        "Layers glued to the ground under the dead shear stress that both bear, on top and sides: "
        "simple shear of each, by its own amount.",
        "Simple shear of neo-Hookean layers: P = μ γ (e_x e_z + e_z e_x) if the upper face is free "
        "of normal stress. Status: exact.",
        sheared,
    ),
    Case(
        "L2 Strip of two layers in pure bending",
        "A slice of a strip in plane strain, its stiff layer 0.4 and its soft one 0.6 of the "
        "height, under a couple on a section that stays plane, at angles as large as 1 rad per "
        "height, both ways; at small ones, the stiffness of the transformed section.",
        "R. S. Rivlin, Proc. R. Soc. A 195, 463 (1949), with two layers. Status: integrated "
        "numerically.",
        bent,
    ),
    Case(
        "L2 Bimetal strip",
        "One layer of the strip wants to be longer by 1e-6. The solver knows no misfit; it gets "
        "the equivalent load, the force that would undo the misfit, turned round, in the middle of "
        "the layer.",
        "S. Timoshenko, J. Opt. Soc. Am. 11, 233 (1925), equation (4), with the moduli of plane "
        "strain. Status: closed form.",
        warmed,
    ),
)
