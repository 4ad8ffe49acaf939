"""The interpolated law: one potential, exact at its points, of the order that theory promises."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from made_up_law import AT_REST, MadeUp
from one_potential import assert_derivatives_by_load, assert_derivatives_by_pressure

from bellows_design.errors import BellowsError
from bellows_design.force.law.interpolation.table import Table
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw

LOADS = np.array([[-70.0, 0.5, 0.2], [-31.0, -1.0, 0.0], [-8.7, 2.0, 1.0], [12.0, 0.1, -0.3]])
"""The first is beyond the moments of the tables."""

LAWS = {"smooth": MadeUp(), "contact": MadeUp(stiffer=0.7)}


@pytest.fixture(params=LAWS)
def law(request: pytest.FixtureRequest) -> TabulatedLaw:
    return TabulatedLaw(10.0, LAWS[request.param].table(4, 7), 1.04, AT_REST, 0.05)


@pytest.mark.parametrize("axis", range(3))
def test_motion_and_compliance_are_derivatives_of_the_energy(law: TabulatedLaw, axis: int) -> None:
    assert_derivatives_by_load(law, LOADS, axis, 1e-9)


def test_the_volume_is_the_derivative_of_the_energy_by_the_pressure(law: TabulatedLaw) -> None:
    assert_derivatives_by_pressure(law, LOADS, 1e-8)


def test_the_compliance_is_symmetric(law: TabulatedLaw) -> None:
    compliance = law.response(0.043, LOADS).compliance
    assert (compliance == compliance.transpose(0, 2, 1)).all()


def test_the_law_passes_through_its_points(law: TabulatedLaw) -> None:
    law = replace(law, softening=1.0)
    for row in law.table.rows:
        loads = np.stack([row.moments, *np.zeros((2, len(row.moments)))], axis=1)
        at = law.response(row.pressure, loads)
        for name in ("energy", "volume"):
            assert getattr(at, name) == pytest.approx(row.column(lambda p: getattr(p, name)))  # noqa: B023
        assert at.motion[:, 0] == pytest.approx(row.column(lambda p: p.rotation))
        assert at.motion[:, 1] == pytest.approx(row.column(lambda p: p.extension))
        assert at.compliance[:, :2, :2] == pytest.approx(row.derivatives[:, :2, :2], abs=1e-12)
        assert at.motion_by_pressure[:, 0] == pytest.approx(row.derivatives[:, 2, 0])


@pytest.mark.parametrize(
    ("pressures", "moments", "order"), [((9, 9), (9, 17), 2.5), ((3, 5), (17, 17), 3)]
)
def test_the_error_of_a_smooth_law_falls_as_that_of_its_polynomials(
    pressures: tuple[int, int], moments: tuple[int, int], order: float
) -> None:
    made = MadeUp()

    def error(rows: int, points: int) -> float:
        law = TabulatedLaw(10.0, made.table(rows, points))
        moments = np.linspace(-55, 15, 23)
        loads = np.stack([moments, *np.zeros((2, len(moments)))], axis=1)
        at = law.response(0.031, loads).motion[:, 0]
        exact = [made.derivative((0, 1, 0), 0.031, float(m)) for m in moments]
        return float(np.abs(at - exact).max())

    coarse, fine = (error(*each) for each in zip(pressures, moments, strict=True))
    ratio = max((pressures[1] - 1) / (pressures[0] - 1), (moments[1] - 1) / (moments[0] - 1))
    assert fine < coarse / ratio**order


def test_a_correction_softens_all_motion_alike_but_the_slip(law: TabulatedLaw) -> None:
    as_on_the_mesh = replace(law, softening=1.0).response(0.043, LOADS)
    at = law.response(0.043, LOADS)
    assert at.motion[:, :2] == pytest.approx(1.04 * as_on_the_mesh.motion[:, :2])
    assert (at.motion[:, 2] == as_on_the_mesh.motion[:, 2]).all()
    assert at.volume - AT_REST == pytest.approx(1.04 * (as_on_the_mesh.volume - AT_REST))


def test_a_kink_that_moves_with_the_pressure_stays_sharp_between_rows() -> None:
    made = MadeUp(stiffer=0.7)
    onsets = {p: made.onset - made.drift * p for p in (0.0, 0.05, 0.1)}
    moments = {p: np.array([-60, -40, at - 0.05, at + 0.05, 0, 20]) for p, at in onsets.items()}
    law = TabulatedLaw(10.0, Table(tuple(made.row(p, m) for p, m in moments.items())))
    kink = made.onset - made.drift * 0.03
    loads = np.array([[kink - 1.0, 0, 0], [kink + 1.0, 0, 0]])
    exact = [made.derivative((0, 2, 0), 0.03, float(m)) for m in loads[:, 0]]
    found = law.response(0.03, loads).compliance[:, 0, 0]
    assert found == pytest.approx(exact, rel=0.02)
    assert found[1] > 2 * found[0]


def test_beyond_the_moments_the_compliance_stays_constant_and_within_says_so(
    law: TabulatedLaw,
) -> None:
    near, far = law.response(0.05, np.array([[25.0, 0, 0], [80.0, 0, 0]])).compliance[:, 0, 0]
    assert near == pytest.approx(far)
    assert law.within(0.05, np.array([[10.0, 0, 0]]))
    assert not law.within(0.05, np.array([[10.0, 0, 0], [80.0, 0, 0]]))


def test_a_pressure_beyond_the_rows_is_refused(law: TabulatedLaw) -> None:
    with pytest.raises(BellowsError, match="goes from 0 to"):
        law.response(0.12, LOADS)
