"""Which walls a part has."""

from __future__ import annotations

import numpy as np
import pytest

from printers.measure.wall_survey import group_by_thickness


def test_small_areas_are_no_group_and_close_values_are_one() -> None:
    values = np.array([1.2] * 30 + [1.21] * 30 + [1.4] * 2 + [1.6] * 30)
    groups = [values[flags].mean() for flags in group_by_thickness(values, area=0.1)]
    assert groups == [pytest.approx(1.205), pytest.approx(1.6)]
