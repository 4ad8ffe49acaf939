"""Equilibria of a real cell, and the law that is made of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.budget import Budget
from bellows_design.design.shipped import load_design
from bellows_design.force.law.cell_law import cell_law, extended
from bellows_design.force.law.computation.building import error_at
from bellows_design.force.law.computation.continuation import Continuation, Solved
from bellows_design.force.law.ends import EndPiece
from bellows_design.force.law.errors import LawError
from bellows_design.force.law.half_bubble import CellLaw, Effort
from bellows_design.force.law.interpolation.rows import Row, doubt
from bellows_design.force.law.interpolation.table import Table
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw
from bellows_design.store import evaluated
from bellows_design.store.store import Store
from solver import Couple, solve

DESIGN = load_design("prototype_1")
PRESSURE = DESIGN.load.pressure
UNHURRIED = Budget(mesh_seconds=3600.0, seconds=3600.0)
"""What a limit of time had a part in is not kept."""


@pytest.fixture(scope="module")
def cell() -> Continuation:
    """Prototype 1 on the coarsest mesh."""
    return Continuation.of(DESIGN, first_plan(UNIT_CELL.solid(DESIGN), DESIGN).made())


@pytest.fixture(scope="module")
def points(cell: Continuation) -> list[Solved]:
    """Without a moment, and under one that presses back."""
    (free,), _ = cell.from_zero((PRESSURE,))
    pressed = cell.beside(free, PRESSURE, -10.0)
    assert isinstance(pressed, Solved)
    return [pressed, free]


def test_a_moment_presses_the_half_bubble_back(points: list[Solved]) -> None:
    pressed, free = (np.degrees(each.point.rotation) for each in points)
    assert free == pytest.approx(15.3, abs=0.1)
    assert pressed == pytest.approx(12.0, abs=0.1)


def test_energies_rotations_and_compliances_of_points_belong_together(
    points: list[Solved],
) -> None:
    """The interpolation that knows the energies and the one that does not are nearly the same."""
    pressed, free = (each.point for each in points)
    turned = free.rotation - pressed.rotation
    assert doubt(pressed, free) < 1e-3 * turned
    slope = (free.volume - pressed.volume) / (free.moment - pressed.moment)
    rates = [each.point.derivatives[2, 0] for each in points]
    assert min(rates) < slope < max(rates)


def test_on_the_way_from_a_neighbour_and_from_zero_the_equilibrium_is_the_same(
    cell: Continuation, points: list[Solved]
) -> None:
    directly = solve(replace(cell.problem, loads=(Couple(-5.0),)), PRESSURE)
    near = points[0].solution
    assert directly.rotation == pytest.approx(near.rotation, abs=1e-3)


@pytest.mark.slow
def test_the_pieces_and_ends_of_an_unloaded_finger_turn_as_its_evaluation(own_cache: Path) -> None:
    store = Store(own_cache)
    evaluation = evaluated(DESIGN, budget=UNHURRIED, store=store)
    law = cell_law(DESIGN, 0.02, budget=UNHURRIED, store=store)
    none = np.zeros((1, 3))
    piece = law.response(PRESSURE, none).motion[0, 0]
    ends = sum(end.response(PRESSURE, none).motion[0, 0] for end in (law.root, law.tip))
    whole = np.degrees((2 * DESIGN.bellows.bubble_count - 2) * piece + ends)
    assert whole == pytest.approx(evaluation.bending_angle_deg, rel=2e-3)
    assert law.error.interpolation <= 0.02 * law.free_rotation
    again = cell_law(DESIGN, 0.02, budget=UNHURRIED, store=store)
    assert again.from_cache
    points = [point for row in law.table.rows for point in row.points]
    assert max(error_at(again.table, point) for point in points) < 1e-12


@pytest.mark.slow
def test_a_law_is_extended_by_the_moments_that_a_chain_asks_for(
    cell: Continuation, points: list[Solved]
) -> None:
    pressed, free = (each.point for each in points)
    (half,), _ = cell.from_zero((PRESSURE / 2,))
    table = Table((Row((half.point,)), Row((pressed, free))))
    none, pressures = np.zeros((2, 1, 2)), np.array([0.0, PRESSURE])
    end = EndPiece(
        length=DESIGN.bellows.pitch / 2,
        pressures=pressures,
        moments=np.zeros(1),
        motion=none,
        compliance=np.zeros((2, 1, 2, 2)),
        rate=none,
        volumes=np.zeros(2),
        reaches=np.zeros((2, 2)),
    )
    law = CellLaw(
        design=DESIGN,
        tabulated=TabulatedLaw(DESIGN.bellows.pitch / 2, table),
        root=end,
        tip=end,
        free_rotation=free.rotation,
        tolerance=0.02,
        stress_factor=1.0,
        error=LawError(0.0, 0.0, 0.0, None),
        mesh=cell.problem.mesh,
        effort=Effort(0, 0.0),
    )
    asked = np.array([[30.0, 0.0, 0.0]])
    assert not law.within(PRESSURE, asked)
    more = extended(law, (-10.0, 30.0), (PRESSURE, PRESSURE))
    assert more.within(PRESSURE, asked)
    assert not more.within(PRESSURE / 2, asked)
    assert error_at(more.table, pressed) < 1e-5
    assert more.effort.factorizations > 0
