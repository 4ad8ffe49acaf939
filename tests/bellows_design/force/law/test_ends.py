"""A hinge at an end: one potential of moment and pressure."""

from __future__ import annotations

import numpy as np
import pytest

from bellows_design.force.law.ends import EndHinge, EndPoint

HINGE = EndHinge(
    (
        EndPoint(0.0, 0.0, 2e-3, 4.0),
        EndPoint(0.04, 0.02, 1.5e-3, 1.0),
        EndPoint(0.1, 0.03, -1e-3, -9.0),
    )
)
LOADS = np.array([[-30.0, 1.0, 2.0], [12.0, 0.0, 0.0]])


def test_it_passes_through_its_points_and_has_no_length() -> None:
    for point in HINGE.points:
        at = HINGE.response(point.pressure, np.zeros((1, 3)))
        assert at.motion[0, 0] == pytest.approx(point.rotation)
        assert at.compliance[0, 0, 0] == pytest.approx(point.compliance)
        assert at.volume[0] == pytest.approx(point.volume)
    assert HINGE.length == 0


def test_rotation_and_volume_are_derivatives_of_its_energy() -> None:
    pressure, step = 0.07, 1e-6
    at = HINGE.response(pressure, LOADS)
    below, above = (HINGE.response(pressure + side, LOADS) for side in (-step, step))
    assert (above.energy - below.energy) / (2 * step) == pytest.approx(at.volume, rel=1e-7)
    rate = (above.motion - below.motion) / (2 * step)
    assert rate == pytest.approx(at.motion_by_pressure, rel=1e-6)
    turn = np.array([1e-3, 0, 0])
    below, above = (HINGE.response(pressure, LOADS + side * turn) for side in (-1, 1))
    assert (above.energy - below.energy) / 2e-3 == pytest.approx(at.motion[:, 0], rel=1e-7)
    assert above.motion - below.motion == pytest.approx(2e-3 * at.compliance[:, :, 0])
