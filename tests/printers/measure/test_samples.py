"""Points spread over a surface."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from printers.measure.samples import sample
from printers.measure.surface import merged_surface


def test_sampling_by_area_does_not_see_the_triangles(solids: SimpleNamespace) -> None:
    box = merged_surface(*solids.arrays(solids.block((10, 10, 10), (0, 0, 0))))
    odd = merged_surface(
        *solids.arrays(solids.block((10, 10, 10), (0, 0, 0)).refine_to_length(1.0))
    )
    for surface in (box, odd):
        points = sample(surface, 4.0, (100, 10_000))
        assert len(points.points) == 2400
        on_top = points.points[points.points[:, 2] > 10 - 1e-9]
        counts = np.histogram2d(on_top[:, 0], on_top[:, 1], bins=4, range=[[0, 10]] * 2)[0]
        assert counts.sum() == pytest.approx(400, rel=0.02)
        assert np.abs(counts - 25).max() <= 7
