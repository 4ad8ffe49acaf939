"""Whether all that a law of a piece returns are derivatives of its energy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from bellows_design.force.section_law import SectionLaw, SectionResponse
from solver.arrays import Reals

AT = 0.043
"""MPa, between rows of the tables."""


def difference(
    law: SectionLaw, loads: Reals, pick: Callable[[SectionResponse], Reals], axis: int, step: float
) -> Reals:
    """Central difference by a section load, or by the pressure for axis 3."""
    found = []
    for side in (-step, step):
        shift = np.zeros(4)
        shift[axis] = side
        found.append(pick(law.response(AT + shift[3], loads + shift[:3])))
    return np.asarray((found[1] - found[0]) / (2 * step))


def assert_derivatives_by_load(law: SectionLaw, loads: Reals, axis: int, accuracy: float) -> None:
    """Motion, compliance and coupling with the pressure, by one of the section loads."""
    at = law.response(AT, loads)
    motion = difference(law, loads, lambda r: r.energy, axis, 1e-3)
    compliance = difference(law, loads, lambda r: r.motion, axis, 1e-3)
    coupling = difference(law, loads, lambda r: r.volume, axis, 1e-3)
    assert motion == pytest.approx(at.motion[:, axis], abs=accuracy)
    assert compliance == pytest.approx(at.compliance[:, :, axis], abs=accuracy)
    assert coupling == pytest.approx(at.motion_by_pressure[:, axis], abs=1e3 * accuracy)


def assert_derivatives_by_pressure(law: SectionLaw, loads: Reals, accuracy: float) -> None:
    """Volume, and motion by the pressure."""
    at = law.response(AT, loads)
    volume = difference(law, loads, lambda r: r.energy, 3, 1e-6)
    rate = difference(law, loads, lambda r: r.motion, 3, 1e-6)
    assert volume == pytest.approx(at.volume, rel=accuracy)
    assert rate == pytest.approx(at.motion_by_pressure, rel=100 * accuracy, abs=10 * accuracy)
