"""Local thickness on shells whose thickness is known everywhere."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from analytic_shells import SHELLS
from numpy.typing import NDArray

from printers.measure.samples import sample
from printers.measure.surface import Surface, merged_surface
from printers.measure.thickness.local_thickness import LocalThickness, local_thickness


def measured(surface: Surface, reach: float = 2.5) -> LocalThickness:
    return local_thickness(surface, sample(surface, 4.0, (4_000, 20_000)), reach)


@pytest.mark.parametrize("thickness", [0.4, 1.2, 2.0])
@pytest.mark.parametrize("shell", SHELLS)
def test_thickness_of_analytic_shells_is_within_two_percent_or_a_facet(
    shell: str, thickness: float
) -> None:
    found = measured(merged_surface(*SHELLS[shell](thickness, 160)))
    # Where the box's floor and roof meet its walls, the ball at the sharp edge inside is larger.
    height = found.samples.points[:, 2]
    between = (height > height.min() + thickness) & (height < height.max() - thickness)
    thin = np.isfinite(found.thickness) & between
    error = np.abs(found.thickness[thin] - thickness)
    assert thin[between].mean() > 0.95
    assert np.quantile(error, 0.99) <= max(0.02, 0.02 * thickness)


@pytest.mark.parametrize("shell", SHELLS)
def test_finer_facets_bring_the_thickness_nearer_to_the_truth(shell: str) -> None:
    errors = []
    for segments in (24, 48, 96):
        thickness = measured(merged_surface(*SHELLS[shell](1.2, segments))).thickness
        errors.append(np.abs(np.median(thickness[np.isfinite(thickness)]) - 1.2))
    # Of second order, as the depth of a facet; a flat wall is exact from the start.
    assert errors[2] <= max(errors[0] / 8, 1e-5)


def split(surface: Surface) -> Surface:
    """Every triangle as three around its centre."""
    vertices, (a, b, c) = surface.vertices, surface.triangles.T
    centre = np.arange(len(a)) + len(vertices)
    parts = [[a, b, centre], [b, c, centre], [c, a, centre]]
    triangles: NDArray[np.int64] = np.concatenate([np.stack(part, axis=1) for part in parts])
    return Surface(np.concatenate([vertices, surface.corners.mean(axis=1)]), triangles)


def test_another_triangulation_gives_the_same_thickness(solids: SimpleNamespace) -> None:
    body = solids.bellows(1.2, tendon_wall=1.6, chamber=2.0, gap=1.2, bubbles=2)
    surface = merged_surface(*solids.arrays(body))
    points = sample(surface, 2.0, (3_000, 3_000))
    coarse = local_thickness(surface, points, 2.5).thickness
    finer = split(surface)
    owner = np.tile(np.arange(len(surface.triangles)), 3)
    inner = sample(finer, 2.0, (3_000, 3_000))
    assert len(finer.triangles) == len(owner)
    fine = local_thickness(finer, inner, 2.5).thickness
    low = [np.quantile(values[np.isfinite(values)], [0.0, 0.5, 0.9]) for values in (coarse, fine)]
    assert np.allclose(low[0], low[1], atol=0.02)


@pytest.mark.parametrize("size", [(10.0, 10.0, 10.0), (30.0, 8.0, 5.0)])
def test_nothing_is_thin_at_the_edges_of_a_block(
    solids: SimpleNamespace, size: tuple[float, float, float]
) -> None:
    surface = merged_surface(*solids.arrays(solids.block(size, (0, 0, 0))))
    assert not np.isfinite(measured(surface, 4.0).thickness).any()


def test_a_plate_is_as_thick_as_it_is_far_from_its_edges(solids: SimpleNamespace) -> None:
    surface = merged_surface(*solids.arrays(solids.block((20, 20, 0.8), (0, 0, 0))))
    found = measured(surface)
    level = np.abs(found.samples.normals[:, 2]) > 0.5
    assert np.allclose(found.thickness[level], 0.8, atol=1e-5)


def test_the_corner_between_a_sharp_cavity_and_a_round_outside_is_thinner_than_the_walls(
    solids: SimpleNamespace,
) -> None:
    outer = solids.rounded_bar(14.0, 10.0, 14.0, 2.2, (0, 0, 0))
    surface = merged_surface(*solids.arrays(outer - solids.block((11.6, 7.6, 11.6), (1.2,) * 3)))
    thinnest = float(np.min(measured(surface).thickness))
    # From the round of 2.2 mm, centred 1 mm inside the corner, to the sharp edge.
    assert thinnest == pytest.approx(2.2 - np.sqrt(2.0), abs=0.02)


def test_the_area_by_lines_adds_up(solids: SimpleNamespace) -> None:
    found = measured(merged_surface(*solids.arrays(solids.hollow_box())))
    areas = found.area_by_units(0.4, 0.02)
    assert max(areas, key=lambda count: areas[count]) == 3
    finite = np.isfinite(found.thickness).sum() * found.samples.area
    assert sum(areas.values()) == pytest.approx(finite)
