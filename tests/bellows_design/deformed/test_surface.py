"""Surfaces for pages: closed, outward, and along the pressure path."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from closed_surfaces import open_edges, volume_inside, volume_of_cells

from bellows_design.deformed import (
    SurfaceFrames,
    deformed_actuator,
    deformed_surface,
    surface_frames,
)
from bellows_design.deformed.surface import MOST_POINTS
from bellows_design.errors import DesignError
from bellows_design.evaluation import Evaluation

Evaluated = Callable[[str], Evaluation]
EVERY = ["three bubbles", "nine bubbles", "fingertip", "vacuum", "two bubbles", "limit"]


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.thorough
def test_the_surface_is_watertight(name: str, evaluated: Evaluated) -> None:
    shown = deformed_surface(evaluated(name))
    assert open_edges(shown.triangles) == 0


@pytest.mark.parametrize("name", EVERY)
def test_it_encloses_the_body_with_outward_normals(name: str, evaluated: Evaluated) -> None:
    """But for what flat triangles cut off of curved walls, which bend under load."""
    shown, body = deformed_surface(evaluated(name)), deformed_actuator(evaluated(name))
    for frame, share in enumerate((0.0, 1.0)):
        nodes = body.mesh.nodes + share * body.displacement
        inside = volume_inside(shown.triangles, shown.positions[frame])
        assert inside == pytest.approx(volume_of_cells(body.mesh, nodes), rel=0.02)


@pytest.mark.parametrize("name", EVERY)
def test_frames_are_at_rest_and_as_found(name: str, evaluated: Evaluated) -> None:
    found = evaluated(name)
    shown, body = deformed_surface(found), deformed_actuator(found)
    assert list(shown.pressures_mpa) == [0, found.pressure_mpa]
    assert list(shown.angles_deg) == pytest.approx([0, found.bending_angle_deg])
    assert not shown.von_mises[0].any()
    assert set(shown.von_mises[1]) <= set(body.von_mises)
    corners = {tuple(each) for each in body.mesh.nodes.round(6)}
    assert {tuple(each) for each in shown.positions[0].round(6)} <= corners


def test_large_surfaces_have_corners_only(evaluated: Evaluated) -> None:
    few, many = deformed_surface(evaluated("two bubbles")), deformed_surface(evaluated("fingertip"))
    for shown, name in ((few, "two bubbles"), (many, "fingertip")):
        body = deformed_actuator(evaluated(name))
        six = np.concatenate([*body.mesh.surfaces.values()])
        fine = len(np.unique(six)) <= MOST_POINTS
        assert fine is (name == "two bubbles")
        assert shown.positions.shape[1] == len(np.unique(six if fine else six[:, :3]))


@pytest.fixture(scope="module")
def along(evaluated: Evaluated) -> SurfaceFrames:
    """Nine bubbles at pressures that the evaluation kept."""
    return surface_frames(evaluated("nine bubbles"), 3)


def test_frames_are_equally_spaced_in_pressure(along: SurfaceFrames) -> None:
    assert along.pressures_mpa == pytest.approx([0, 0.05, 0.1])


def test_the_last_frame_is_what_was_found(along: SurfaceFrames, evaluated: Evaluated) -> None:
    shown = deformed_surface(evaluated("nine bubbles"))
    assert np.array_equal(along.triangles, shown.triangles)
    assert along.positions[0] == pytest.approx(shown.positions[0], abs=1e-9)
    assert along.positions[-1] == pytest.approx(shown.positions[-1], abs=1e-9)
    assert along.von_mises[-1] == pytest.approx(shown.von_mises[-1])


def test_kept_states_are_those_of_the_curve(along: SurfaceFrames, evaluated: Evaluated) -> None:
    curve = {each.pressure_mpa: each.bending_angle_deg for each in evaluated("nine bubbles").curve}
    assert along.angles_deg[1] == pytest.approx(curve[0.05], abs=1e-6)


def test_kept_states_are_not_solved_again(
    evaluated: Evaluated, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object, **__: object) -> None:
        raise AssertionError("solved again")

    monkeypatch.setattr("solver.paths.load_stepping.solve", refused)
    monkeypatch.setattr("solver.solve", refused, raising=False)
    assert len(surface_frames(evaluated("nine bubbles"), 3).pressures_mpa) == 3
    with pytest.raises(AssertionError, match="solved again"):
        surface_frames(evaluated("nine bubbles"), 4)


@pytest.mark.parametrize("name", ["three bubbles", "vacuum", "two bubbles", "limit"])
@pytest.mark.thorough
def test_a_path_is_walked_again_where_nothing_was_kept(name: str, evaluated: Evaluated) -> None:
    found = evaluated(name)
    frames, shown = surface_frames(found, 4), deformed_surface(found)
    wanted = np.linspace(0, found.pressure_mpa, 4)
    assert frames.pressures_mpa == pytest.approx(wanted)
    turned = np.sign(found.pressure_mpa) * frames.angles_deg
    assert (np.diff(turned) > 0).all()
    assert (np.diff(frames.von_mises.max(axis=1)) > 0).all()
    assert frames.angles_deg[-1] == pytest.approx(found.bending_angle_deg, rel=1e-3)
    assert frames.positions[-1] == pytest.approx(shown.positions[-1], abs=0.05)
    assert open_edges(frames.triangles) == 0


def test_the_coarsest_mesh_is_shown_with_the_angle_found(evaluated: Evaluated) -> None:
    found = evaluated("three bubbles")
    coarse, fine = surface_frames(found, 2, finest=False), deformed_surface(found)
    assert coarse.positions.shape[1] < fine.positions.shape[1]
    assert coarse.angles_deg[-1] == pytest.approx(found.bending_angle_deg)
    assert coarse.von_mises[-1].max() < fine.von_mises[-1].max()


def test_an_evaluation_that_reached_nothing_is_shown_at_rest(evaluated: Evaluated) -> None:
    from dataclasses import replace

    found = replace(evaluated("two bubbles"), pressure_mpa=0.0)
    frames = surface_frames(found)
    assert frames.positions.shape[0] == 1 and list(frames.angles_deg) == [0]


@pytest.mark.parametrize("count", [0, 1, 102])
def test_other_counts_are_refused(count: int, evaluated: Evaluated) -> None:
    with pytest.raises(DesignError, match=f"count = {count} frames must lie between 2 and 101"):
        surface_frames(evaluated("two bubbles"), count)
