"""Sections seen from the neutral height: axial forces there neither close nor open the gap."""

from __future__ import annotations

import numpy as np
import pytest
from made_up_law import AT_REST, MadeUp

from bellows_design.force.law.interpolation.neutral_height import (
    loads_about,
    neutral_height,
    response_at_origin,
    row_about,
)
from bellows_design.force.law.interpolation.points import SectionPoint
from bellows_design.force.law.interpolation.rows import Row
from bellows_design.force.law.interpolation.table import Table
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw, response_of
from solver.arrays import Reals

HEIGHT, PRESSURES = 14.0, (0.0, 0.05, 0.1)

SOFT, LOST, DRIFT = 0.009, 0.00855, 150.0
"""Compliance by moments and what contact takes away, rad per N mm; by how much more negative the
moment of first contact becomes with the pressure, N mm per MPa."""


def onset(pressure: float) -> float:
    """Moment about the height below which neighbours touch, N mm."""
    return -5.0 - DRIFT * pressure


def rotation(pressure: float, moment: float) -> float:
    """By the moment about the neutral height."""
    return 4 * pressure + SOFT * moment - LOST * min(moment - onset(pressure), 0.0)


def point(pressure: float, moment: float) -> SectionPoint:
    """A piece that is linear but for contact, without axial force."""
    below = min(moment - onset(pressure), 0.0)
    lost = LOST if below else 0.0
    turn, soft, rate = rotation(pressure, moment), SOFT - lost, 4 - lost * DRIFT
    derivatives = np.array(
        [
            [soft, -HEIGHT * soft, rate],
            [-HEIGHT * soft, HEIGHT**2 * soft + 0.05, 0.2 - HEIGHT * rate],
            [rate, 0.2 - HEIGHT * rate, -lost * DRIFT**2],
        ]
    )
    return SectionPoint(
        pressure=pressure,
        moment=moment,
        rotation=turn,
        extension=0.2 * pressure - HEIGHT * turn,
        volume=AT_REST + 4 * moment - LOST * DRIFT * below,
        energy=AT_REST * pressure
        + 4 * pressure * moment
        + (SOFT * moment**2 - LOST * below**2) / 2,
        derivatives=derivatives,
        stress=1.0,
        position=(0.0, 0.0, 0.0),
        gap=moment - onset(pressure),
        stable=True,
        factorizations=1,
    )


def table() -> Table:
    """With points close to where neighbours begin to touch, as the computed ones have them."""
    near = np.array([-40.0, -20.0, -6.0, -0.3, 0.3, 6.0, 20.0, 40.0])
    return Table(tuple(Row(tuple(point(p, m) for m in near + onset(p))) for p in PRESSURES))


def loads(axial: float) -> Reals:
    """Moments on both sides of the kink under an axial force, N."""
    moments = onset(0.05) + HEIGHT * axial + np.linspace(-15, 15, 61)
    return np.column_stack([moments, np.full(61, axial), np.zeros(61)])


def least_eigenvalue(compliance: Reals) -> float:
    return float(np.linalg.eigvalsh(compliance[:, :2, :2]).min())


def test_the_neutral_height_follows_from_the_compliance_that_contact_takes_away() -> None:
    assert neutral_height(table().rows) == pytest.approx(HEIGHT, rel=1e-9)


def test_without_contact_there_is_no_such_height() -> None:
    rows = MadeUp().table(2, 5).rows
    assert neutral_height(rows) == 0.0


@pytest.mark.parametrize("axial", [-2.0, 0.5, 2.0])
def test_a_piece_under_an_axial_force_touches_where_its_moment_about_the_height_says(
    axial: float,
) -> None:
    law = TabulatedLaw(10.0, table(), volume_at_rest=AT_REST)
    found = law.response(0.05, loads(axial))
    exact = [rotation(0.05, moment - HEIGHT * axial) for moment in loads(axial)[:, 0]]
    assert found.motion[:, 0] == pytest.approx(np.array(exact), abs=1e-3)


@pytest.mark.parametrize("axial", [-2.0, 2.0])
def test_a_piece_that_touches_under_an_axial_force_stays_stable(axial: float) -> None:
    """About z = 0 the kink lies elsewhere under an axial force, and the compliance is negative."""
    law = TabulatedLaw(10.0, table(), volume_at_rest=AT_REST)
    assert least_eigenvalue(law.response(0.05, loads(axial)).compliance) > 0
    at_kink = loads(0.0) + np.array([0.0, axial, 0.0])
    at_origin = response_of(table().curves(0.05), at_kink)
    assert least_eigenvalue(at_origin.compliance) < 0


def test_about_another_height_and_back_is_the_same_response() -> None:
    given = loads(0.0)
    here = response_of(table().curves(0.05), given)
    raised = Table(tuple(row_about(row, 5.0) for row in table().rows))
    there = response_of(raised.curves(0.05), loads_about(given, 5.0))
    back = response_at_origin(there, 5.0)
    assert back.motion[:, 0] == pytest.approx(here.motion[:, 0], abs=1e-12)
    assert back.compliance[:, 0, 0] == pytest.approx(here.compliance[:, 0, 0], abs=1e-12)
    assert back.energy == pytest.approx(here.energy, abs=1e-12)
