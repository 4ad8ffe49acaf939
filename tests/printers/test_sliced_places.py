"""Places of the G-code in the coordinates of the part's file."""

from __future__ import annotations

import numpy as np
import pytest
from small_solids import arrays, hollow_box, port_of

from printers import PrintedModel, PrinterProfile
from printers.orientation.turning import parse_up, turned
from printers.sliced_check import _on_bed, _to_file
from printers.slicing.placing import placed


@pytest.mark.parametrize("up", ["Z", "-X", "-Z", "1,2,3"])
@pytest.mark.parametrize("rotation", [0.0, 90.0, 17.0])
def test_a_place_on_the_bed_leads_back_to_that_of_the_file(
    up: str, rotation: float, prusa: PrinterProfile
) -> None:
    vertices, triangles = arrays(hollow_box().translate((3.0, -20.0, 40.0)))
    part = PrintedModel(vertices, triangles, openings=(port_of(),))
    turning = parse_up(up)
    standing = turned(part, turning)
    placement = placed(standing.vertices, rotation, prusa)
    on_bed = placement.to_gcode(standing.vertices)
    assert on_bed[:, 2].min() == pytest.approx(0.0, abs=1e-9)
    back = _to_file(placement, part, turning)
    in_file = np.column_stack([on_bed, np.ones(len(on_bed))]) @ back.T
    np.testing.assert_allclose(in_file[:, :3], vertices, atol=1e-9)
    (opening,) = standing.openings
    centre = back @ np.array([*_on_bed(opening, placement).centre, 1.0])
    np.testing.assert_allclose(centre[:3], port_of().centre, atol=1e-9)
