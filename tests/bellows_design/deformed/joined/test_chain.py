"""A chain at rest, put together without a solution."""

from __future__ import annotations

import pytest
from closed_surfaces import open_edges, volume_inside, volume_of_cells
from kept import small

from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import FREE_CELL, HALF, UNIT_CELL, shortened
from bellows_design.deformed.joined.chain import Chain
from bellows_design.deformed.joined.cutting import ON_PLANE
from bellows_design.deformed.joined.state import ActuatorState, BodyState
from bellows_design.deformed.whole import WholeSurface
from bellows_design.design.design import Design
from bellows_design.geometry.actuator import full_body
from solver import Mesh


@pytest.mark.parametrize("count", [1, 2, 4])
@pytest.mark.parametrize("free", [False, True])
@pytest.mark.thorough
def test_it_is_the_cad_body_and_watertight(count: int, free: bool) -> None:
    """Stubs of free ends keep the channel open up to the last gap's middle."""
    design = small(f"number_of_bubbles={count}", f"length={8 + 7 * count}")
    chain, state = _at_rest(design, free)
    whole, bellows = chain.assembled, design.bellows
    nodes = whole.positions(chain.at_rest(bellows, state))
    mesh = Mesh(nodes, whole.tets, whole.surfaces)
    wanted = full_body(bellows, None).solid.Volume()
    channel = bellows.channel_width * bellows.channel_height
    wanted -= free * channel * (bellows.bubble_thickness + bellows.bubble_distance / 2)
    assert volume_of_cells(mesh, nodes) == pytest.approx(wanted, rel=0.01)
    assert mesh.boundary_surfaces == {"root", "tip", "outside", "cavity"}
    shown = WholeSurface.of(chain, bellows, state)
    assert open_edges(shown.flat.triangles) == 0
    flat = volume_inside(shown.flat.triangles, shown.at_rest(bellows, state))
    assert flat == pytest.approx(wanted, rel=0.02)


@pytest.mark.thorough
def test_nothing_moves_without_load() -> None:
    """Though the outlines of cell and ends are up to 0.03 mm apart where the bubble is rounded.

    Nodes that are nearer to the cut than ``ON_PLANE`` count as in it.
    """
    design = small()
    for free in (False, True):
        chain, state = _at_rest(design, free)
        placed = chain.at_rest(design.bellows, state), chain.loaded(design.bellows, state)
        rest, loaded = (chain.assembled.positions(each) for each in placed)
        assert loaded == pytest.approx(rest, abs=ON_PLANE)


def _at_rest(design: Design, free: bool) -> tuple[Chain, ActuatorState]:
    cell = first_plan(UNIT_CELL.solid(design), design).made()
    short = shortened(design)
    ends = first_plan(HALF.solid(short), short).made() if not free else cell
    problem = FREE_CELL.problem(design, ends) if free else HALF.problem(short, ends)
    rest = BodyState.at_rest(problem.mesh)
    state = ActuatorState(BodyState.at_rest(cell), rest, 0.0)
    return Chain.of(design, cell, problem.mesh), state
