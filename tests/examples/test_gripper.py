"""The gripper: its parts fit together, and its finger passes the check."""

from __future__ import annotations

import itertools
import runpy
import sys
from functools import cache
from pathlib import Path
from typing import Any

import cadquery as cq
import pytest
import trimesh

from bellows_design.design import Design, load_design, with_overrides
from bellows_design.errors import BellowsError
from bellows_design.pipeline import build_part, check

EXAMPLES = Path(__file__).parents[2] / "examples"
FINGER = load_design(EXAMPLES / "finger_gripping.toml")
SHORT = with_overrides(FINGER, ["number_of_bubbles=1", "length=12"])


@cache
def example() -> dict[str, Any]:
    return runpy.run_path(str(EXAMPLES / "gripper.py"))


@cache
def parts(count: int, holes: int) -> tuple[Any, cq.Solid, list[cq.Shape]]:
    """Gripper, plate and placed fingers of one bubble."""
    design = with_overrides(SHORT, [f"mount.holes={holes}"])
    gripper = example()["Gripper"](design, count, 20.0)
    finger = build_part(design).solid
    return gripper, gripper.plate(), [finger.moved(cq.Location(place)) for place in gripper.places]


@pytest.mark.thorough
def test_the_gripping_finger_passes_the_check() -> None:
    report = check(FINGER, build_part(FINGER))
    assert report.verdict == "pass", report.failures
    assert FINGER.mount is not None and FINGER.fingertip is not None


@pytest.mark.parametrize(("count", "holes"), [(2, 4), (3, 2)])
@pytest.mark.thorough
def test_fingers_stand_on_the_plate_without_running_into_it_or_each_other(
    count: int, holes: int
) -> None:
    _, plate, fingers = parts(count, holes)
    for finger in fingers:
        assert plate.intersect(finger).Volume() < 1e-6
        assert plate.distance(finger) < 1e-6
    for one, other in itertools.pairwise(fingers):
        assert one.distance(other) > 1


@pytest.mark.parametrize(("count", "holes"), [(2, 4), (3, 2)])
def test_screws_pass_flanges_and_plate_and_tubes_reach_the_ports(count: int, holes: int) -> None:
    gripper, plate, fingers = parts(count, holes)
    design: Design = gripper.design
    mount, port = design.mount, design.port
    assert mount is not None
    ways = [
        (0.99 * mount.hole_diameter / 2, y, z, 4.0)
        for _, y, z in mount.hole_places(design.bellows, port)
    ]
    ways.append((0.99 * port.tube_diameter / 2, 0.0, port.axis_height, -0.1))
    for place, finger in zip(gripper.places, fingers, strict=True):
        for radius, y, z, end in ways:
            start = place.toWorldCoords((-20, y, z))
            way = cq.Solid.makeCylinder(radius, 20 + end, start, place.xDir)
            assert way.intersect(plate).Volume() + way.intersect(finger).Volume() < 1e-6


def test_pads_face_the_axis_at_the_distance_asked_for() -> None:
    gripper, _, fingers = parts(3, 2)
    for place, finger in zip(gripper.places, fingers, strict=True):
        axis = cq.Edge.makeLine(cq.Vector(0, 0, 0), cq.Vector(0, 0, 100))
        assert finger.distance(axis) == pytest.approx(20)
        assert place.zDir.dot(place.origin) == pytest.approx(20)


def test_fingers_that_would_meet_are_refused() -> None:
    make = example()["Gripper"]
    with pytest.raises(BellowsError, match=r"distance = 10 mm must be at least 10\.9 mm"):
        make(FINGER, 3, 10.0)
    with pytest.raises(BellowsError, match="fingers = 4 must be 2 or 3"):
        make(FINGER, 4)
    with pytest.raises(BellowsError, match="need a mount of the kind flange"):
        make(load_design("finger"))


def test_it_writes_an_assembly_with_names_and_watertight_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    own = tmp_path / "short.toml"
    own.write_text(SHORT.to_toml(), "utf-8")
    folder = tmp_path / "gripper"
    arguments = ["gripper.py", str(folder), "--fingers", "3", "--design", str(own)]
    monkeypatch.setattr(sys, "argv", arguments)
    runpy.run_path(str(EXAMPLES / "gripper.py"), run_name="__main__")
    assert "gripper.step" in capsys.readouterr().out
    for name in ("finger", "plate"):
        assert trimesh.load_mesh(folder / f"{name}.stl").is_watertight
    step = (folder / "gripper.step").read_text("utf-8")
    names = ("gripper", "plate", "finger_1", "finger_2", "finger_3")
    assert all(f"'{name}'" in step for name in names)
    solids = cq.importers.importStep(str(folder / "gripper.step")).solids().vals()
    assert len(solids) == 4
