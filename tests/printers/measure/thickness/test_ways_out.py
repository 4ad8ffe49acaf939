"""Ways too short to have a direction, and those around bores."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from printers import Opening, PrinterProfile
from printers.measure.thickness.ways_out import _ways, ways_out

SCALE = np.array([1.2, 1.2, 0.8])


def test_a_way_without_length_looks_as_the_outside_does_or_sideways() -> None:
    way = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1e-9], [3.0, 0.0, 4.0], [0.0, 0.0, 0.0]])
    outwards = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    found = _ways(np.zeros((4, 3)), way, outwards)
    assert found.thickness.tolist() == [0, 0, 5, 0]
    np.testing.assert_allclose(
        found.direction, [(0, 0, 1), (0, 1, 0), (0.6, 0, 0.8), (1, 0, 0)], atol=1e-12
    )


def test_ways_around_a_bore_lie_behind_its_mouth_and_lead_to_the_outside(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    """A tube of 0.5 mm stands out by 1.5 mm, and by 3 mm into the cavity, sealing nothing."""
    tube = solids.bore(1.5, (-1.5, 5.2, 5.2), 5.7) - solids.bore(1.0, (-2.0, 5.2, 5.2), 8.0)
    box = solids.hollow_box(port=False) - solids.bore(1.0, (-2.0, 5.2, 5.2), 4.0)
    port = Opening("port", (-1.5, 5.2, 5.2), (-1.0, 0.0, 0.0), 1.0)
    part = solids.part(box + tube, prusa, openings=(port,))
    ways = ways_out(part.boundary, part.surface, SCALE)
    thin = ways.points[ways.thickness < 0.6]
    assert len(thin) and ways.thickness.min() == pytest.approx(0.5, abs=0.003)
    assert thin[:, 0].min() >= -1.5 and thin[:, 0].max() <= 0.0
