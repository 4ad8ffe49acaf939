"""An end of a finger: one potential of pressure, moment and axial force, from computed points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_law import AT_REST, MadeUp
from one_potential import assert_derivatives_by_load, assert_derivatives_by_pressure

from bellows_design.design.shipped import load_design
from bellows_design.errors import BellowsError
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.law.computation.ends import (
    LEAST_SHARE,
    admissible,
    end_pieces,
    moments_between,
    walked,
)
from bellows_design.force.law.computation.short_actuator import (
    EndPoint,
    Sections,
    SolvedEnds,
    normal,
    tangent,
)
from bellows_design.force.law.ends import EndPiece
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw
from bellows_design.force.section_law import LinearLaw

LOADS = np.array([[-70.0, 0.5, 0.2], [-31.0, -1.0, 0.0], [-8.7, 2.0, 1.0], [12.0, 0.1, -0.3]])
"""The first is beyond the moments of the law."""

PRESSURES = (0.0, 0.025, 0.05, 0.1)
SOFTER = MadeUp()


class ClosedForm:
    """Ends in closed form instead of an actuator; the tip turns half as much as the root.

    Below ``lost`` (N mm) they have no equilibrium.
    """

    factorizations = 0

    def __init__(self, lost: float = -np.inf) -> None:
        self.lost = lost

    def from_zero(self, pressures: Sequence[float]) -> list[SolvedEnds]:
        return [self._at(pressure, 0.0) for pressure in sorted(pressures, key=abs)]

    def beside(self, near: SolvedEnds, moment: float) -> SolvedEnds | str:
        return "there is none" if moment < self.lost else self._at(near.pressure, moment)

    def _at(self, pressure: float, moment: float) -> SolvedEnds:
        point = SOFTER.point(pressure, moment)
        by = point.derivatives
        motion = np.array([point.rotation, point.extension])
        root = EndPoint(motion, by[:2, :2], by[:2, 2], point.volume)
        tip = replace(root, motion=motion / 2, compliance=by[:2, :2] / 2, rate=by[:2, 2] / 2)
        return SolvedEnds(pressure, moment, (root, tip), None)  # type: ignore[arg-type]


def pieces(lost: float = -np.inf) -> tuple[EndPiece, EndPiece]:
    inner = TabulatedLaw(3.0, SOFTER.table(4, 7), volume_at_rest=AT_REST, shear_compliance=0.05)
    return end_pieces(ClosedForm(lost), inner, PRESSURES)


@pytest.fixture(scope="module")
def root() -> EndPiece:
    return replace(pieces()[0], softening=1.04)


@pytest.mark.parametrize("axis", range(3))
def test_motion_and_compliance_are_derivatives_of_the_energy(root: EndPiece, axis: int) -> None:
    assert_derivatives_by_load(root, LOADS, axis, 1e-8)


def test_the_volume_is_the_derivative_of_the_energy_by_the_pressure(root: EndPiece) -> None:
    assert_derivatives_by_pressure(root, LOADS, 1e-7)


def test_it_passes_through_the_computed_points() -> None:
    root, tip = pieces()
    for pressure in PRESSURES:
        loads = np.stack([root.moments, *np.zeros((2, len(root.moments)))], axis=1)
        exact = [SOFTER.point(pressure, moment) for moment in root.moments.tolist()]
        for law, share in ((root, 1.0), (tip, 0.5)):
            at = law.response(pressure, loads)
            assert at.motion[:, 0] == pytest.approx([share * p.rotation for p in exact])
            assert at.motion[:, 1] == pytest.approx([share * p.extension for p in exact])
            soft = [share * p.compliance for p in exact]
            assert at.compliance[:, 0, 0] == pytest.approx(soft, rel=1e-6)


def test_between_points_it_is_near_the_closed_form() -> None:
    root, _ = pieces()
    moments = np.linspace(-55, 15, 29)
    at = root.response(0.08, np.stack([moments, 0 * moments, 0 * moments], axis=1))
    exact = [SOFTER.derivative((0, 1, 0), 0.08, float(moment)) for moment in moments]
    assert np.abs(at.motion[:, 0] - exact).max() < 0.01 * np.ptp(exact)


def test_where_equilibria_end_it_goes_on_with_constant_compliance_and_says_so() -> None:
    root, _ = pieces(lost=-30.0)
    low, _ = root.reach(0.1)
    near, far = np.array([[low - 1.0, 0, 0]]), np.array([[low - 25.0, 0, 0]])
    assert -30.0 <= low < -10.0
    assert root.within(0.1, np.array([[low + 1.0, 0, 0]]))
    assert not root.within(0.1, near)
    assert root.response(0.1, far).compliance[0, 0, 0] == pytest.approx(
        root.response(0.1, near).compliance[0, 0, 0]
    )


def test_a_state_about_to_collapse_ends_a_row() -> None:
    class Collapsing(ClosedForm):
        def beside(self, near: SolvedEnds, moment: float) -> SolvedEnds:
            found = self._at(near.pressure, moment)
            factor = 100.0 if moment < -20 else 1.0
            ends = [replace(e, compliance=factor * e.compliance) for e in found.ends]
            return replace(found, ends=(ends[0], ends[1]))

    ends = Collapsing()
    row = walked(ends, ends.from_zero((0.0,))[0], moments_between(-60.0, 20.0), (-60.0, 20.0))
    assert row[0].moment >= -20
    assert row[-1].moment == 20


def test_no_loads_gain_energy_from_an_admissible_compliance() -> None:
    noisy = np.array([[0.01, 0.03], [0.03, 0.05]])
    found = admissible(noisy)
    assert found[1, 1] == pytest.approx(LEAST_SHARE * 0.09)
    assert np.linalg.eigvalsh(found).min() > 0
    assert (admissible(found) == found).all()
    with pytest.raises(BellowsError, match="against itself"):
        admissible(np.array([[-0.01, 0.0], [0.0, 0.05]]))


def test_a_pressure_beyond_the_rows_is_refused(root: EndPiece) -> None:
    with pytest.raises(BellowsError, match="goes from 0 to"):
        root.response(0.12, LOADS)


def test_the_outer_halves_of_a_finger_follow_their_own_laws() -> None:
    bellows = load_design("prototype_1").bellows
    none = np.zeros((3, 3))
    inner, root, tip = (LinearLaw(bellows.pitch / 2, none, np.full(3, x)) for x in (1.0, 2.0, 3.0))
    chain = Chain.of(bellows, inner, root=root, tip=tip)
    assert [piece.law for piece in chain.pieces[:2]] == [root, inner]
    assert [piece.law for piece in chain.pieces[-2:]] == [inner, tip]
    assert chain.length == pytest.approx(bellows.length)
    assert [piece.backward for piece in chain.pieces[:2]] == [True, False]


def test_sections_tell_how_root_and_tip_turn_and_stretch() -> None:
    """A slice about the middle and the tip's face, moved as rigid bodies."""
    places, half, turns, extensions = (5.0, 9.5), 3.0, (0.4, 2.5), (0.2, -0.1)
    slices = [
        np.array([[x + dx, 1.0, z] for dx in (-0.2, 0.2) for z in (1.0, 4.0)]) for x in places
    ]
    start = np.array([places[0] - half, 0.0])
    middle = start + (half + extensions[0]) * normal(turns[0])
    stub = places[1] - places[0] - half
    end = middle + (half + extensions[1]) * normal(turns[0]) + stub * normal(turns[1])
    moved = [
        origin + (part[:, :1] - x) * normal(turn) - part[:, 2:] * tangent(turn)
        for part, x, origin, turn in zip(slices, places, (middle, end), turns, strict=True)
    ]
    nodes, displacement = np.concatenate(slices), np.zeros((8, 3))
    displacement[:, [0, 2]] = np.concatenate(moved) - nodes[:, [0, 2]]
    mesh = SimpleNamespace(nodes=nodes)
    sections = Sections(mesh, np.arange(4), np.arange(4, 8), places, half)  # type: ignore[arg-type]
    expected = [[turns[0], extensions[0]], [turns[1] - turns[0], extensions[1]]]
    assert sections.motions(displacement) == pytest.approx(np.array(expected))
