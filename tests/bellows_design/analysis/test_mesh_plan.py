"""What is solved: meshes of the bodies that stand for a design, their supports and their load."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from bellows_design.analysis.mesh_plan import finer_plan, first_plan
from bellows_design.analysis.models import (
    FULL,
    HALF,
    UNIT_CELL,
    AnalysisModel,
    slender_axis,
    thinnest_wall,
)
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.shipped import load_design
from bellows_design.geometry.named_solids import NamedSolid
from bellows_design.study.paper import TABLE_4, Result
from solver import Mesh, SolverOptions, solve
from solver.mesh.elements import triangle_rule
from solver.mesh.mid_nodes import jacobian_ratios

BELLOWS = BellowsParameters.model_validate(
    {**load_design("prototype_1").bellows.model_dump(), "length": 18, "number_of_bubbles": 1}
)
DESIGN = Design(name="short", bellows=BELLOWS, indent=Indent(depth=0.4, width=2.4))
ENDS = {"unit-cell": ("bubble_middle", "gap_middle"), "half": ("root", "tip")}
PLANES = {
    "unit-cell": {"bubble_middle": (0, 0.0), "gap_middle": (0, 3.25), "symmetry": (1, 0.0)},
    "half": {"root": (0, 0.0), "tip": (0, 18.0), "symmetry": (1, 0.0)},
}
BOTH = pytest.mark.parametrize("model", [UNIT_CELL, HALF], ids=lambda model: model.name)


@cache
def solid_of(model: AnalysisModel) -> NamedSolid:
    return model.solid(DESIGN)


@cache
def meshes(model: AnalysisModel) -> tuple[Mesh, Mesh]:
    """The first mesh and the next, made from its solution under a tenth of the pressure."""
    coarse = first_plan(solid_of(model), DESIGN).made()
    solution = solve(model.problem(DESIGN, coarse), 0.01, SolverOptions(tolerance=1e-3))
    return coarse, finer_plan(
        solid_of(model), thinnest_wall(DESIGN), solution, model.refinement
    ).made()


def area_vectors(mesh: Mesh, *names: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and weighted outward normals (k, q, 3) of curved triangles."""
    rule = triangle_rule()
    corners = mesh.nodes[mesh.triangles(*names)]
    points = np.einsum("qa,kai->kqi", rule.quadratic, corners)
    tangents = np.einsum("qad,kai->dkqi", rule.gradients, corners)
    return points, np.cross(tangents[0], tangents[1]) * rule.weights[:, None]


def volume(mesh: Mesh, *names: str) -> float:
    points, normals = area_vectors(mesh, *names)
    return float(np.einsum("kqi,kqi->", points, normals) / 3)


@BOTH
@pytest.mark.thorough
def test_the_mesh_has_the_surfaces_of_the_body(model: AnalysisModel) -> None:
    for mesh in meshes(model):
        assert set(mesh.surfaces) == {"cavity", "outside", "symmetry", *ENDS[model.name]}
        _, normals = area_vectors(mesh, *mesh.surfaces)
        assert normals.sum(axis=(0, 1)) == pytest.approx(np.zeros(3), abs=1e-8)  # closed
        for name in ("symmetry", *ENDS[model.name]):
            flat = np.linalg.norm(area_vectors(mesh, name)[1], axis=2).sum()
            exact = 1e-9 if name in ("root", "tip") else 2e-2  # the others have round outlines
            assert flat == pytest.approx(solid_of(model).area(name), rel=exact)


@BOTH
def test_the_mesh_stands_on_the_planes_it_is_held_at(model: AnalysisModel) -> None:
    for mesh in meshes(model):
        for name, (axis, place) in PLANES[model.name].items():
            assert np.abs(mesh.nodes[mesh.surface_nodes(name), axis] - place).max() < 1e-9
        assert mesh.nodes[:, 1].min() > -1e-9


@BOTH
def test_the_next_mesh_is_finer_and_nearer_to_the_solid(model: AnalysisModel) -> None:
    exact = solid_of(model).solid.Volume()
    coarse, fine = meshes(model)
    assert 1.2 * len(coarse.tets) < len(fine.tets) < 2 * model.growth * len(coarse.tets)
    errors = [abs(volume(mesh, *mesh.surfaces) / exact - 1) for mesh in (coarse, fine)]
    assert errors[0] < 0.02 and errors[1] < 1e-3
    assert errors[1] < errors[0] / 5


@BOTH
def test_the_sizes_of_both_meshes_are_known_before(model: AnalysisModel) -> None:
    coarse, fine = meshes(model)
    solution = solve(model.problem(DESIGN, coarse), 0.01, SolverOptions(tolerance=1e-3))
    plans = (
        first_plan(solid_of(model), DESIGN),
        finer_plan(solid_of(model), thinnest_wall(DESIGN), solution, model.refinement),
    )
    for plan, mesh in zip(plans, (coarse, fine), strict=True):
        assert 1 / 1.3 < plan.elements / len(mesh.tets) < 1.3


@BOTH
def test_no_mesh_has_a_folded_element(model: AnalysisModel) -> None:
    for mesh in meshes(model):
        assert jacobian_ratios(mesh.nodes, mesh.tets).min() >= 0.1


def test_the_cavity_encloses_the_air_of_the_bellows() -> None:
    """Its normals point into the air, so cavity and its section at y = 0 bound it inside out."""
    mesh = meshes(HALF)[-1]
    chamber = 2.0 * (17.0 / 2) * 17.0  # half of it
    channel = (BELLOWS.bubble_middles[-1] - 1.5 - 1.0) * (9.0 / 2) * 2.0
    points, normals = area_vectors(mesh, "cavity")
    # The plane y = 0 closes the air and adds nothing to the integral of y n_y.
    air = -np.einsum("kq,kq->", points[..., 1], normals[..., 1])
    assert air == pytest.approx(chamber + channel, rel=0.04)  # less the fillets


@pytest.mark.parametrize(
    ("model", "symmetry"), [(HALF, {"symmetry": 1}), (FULL, {})], ids=["half", "full"]
)
def test_root_is_clamped_and_the_whole_cavity_loaded(
    model: AnalysisModel, symmetry: dict[str, int]
) -> None:
    problem = model.problem(DESIGN, meshes(HALF)[0])
    assert problem.supports.clamped == ("root",)
    assert dict(problem.supports.symmetry) == symmetry
    assert problem.pressurised == ("cavity",)
    assert problem.moving_plane is None
    assert (problem.material.mu, problem.material.alpha) == ((0.19825, 3.2778), (3.05, -0.0054))
    assert problem.material.bulk_modulus == np.inf


def test_the_cell_is_symmetric_about_its_bubbles_middle_and_its_gaps_middle_moves() -> None:
    problem = UNIT_CELL.problem(DESIGN, meshes(UNIT_CELL)[0])
    assert problem.supports.clamped == ()
    assert dict(problem.supports.symmetry) == {"symmetry": 1, "bubble_middle": 0}
    assert problem.moving_plane == "gap_middle"
    assert problem.pressurised == ("cavity",)
    assert problem.axis is not None
    assert problem.axis.stations == (0.0, BELLOWS.pitch / 4, BELLOWS.pitch / 2)


@pytest.mark.parametrize("result", TABLE_4, ids=lambda result: result.label)
def test_stations_ascend_from_root_to_tip_through_every_bubble(result: Result) -> None:
    design = result.build()
    axis = slender_axis(design)
    assert (axis.stations[0], axis.stations[-1]) == (0, design.bellows.length)
    assert len(axis.stations) == 2 * design.bellows.bubble_count + 1
    assert set(design.bellows.bubble_middles) <= set(axis.stations)
    assert all(after > before for before, after in pairwise(axis.stations))


@BOTH
def test_equal_designs_give_equal_meshes(model: AnalysisModel) -> None:
    again = first_plan(model.solid(DESIGN), DESIGN).made()
    assert np.array_equal(again.nodes, meshes(model)[0].nodes)
    assert np.array_equal(again.tets, meshes(model)[0].tets)
