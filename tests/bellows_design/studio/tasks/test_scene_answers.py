"""What the page says of a scene: figures that belong to it, and what its picture shows."""

from __future__ import annotations

from typing import Any

import pytest

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.payload import Payload
from bellows_design.design.scenes.scene import Scene
from bellows_design.design.shipped import load_design
from bellows_design.force.air import Air
from bellows_design.force.result import ForceCurve, ForceError, ForceReading, Seconds
from bellows_design.studio.display.scene_picture import scene_caption
from bellows_design.studio.tasks.scenes import scene_figures

GRIP = Grip(size=30, mass_g=20, distance=16, place=35)


def curve(content: Scene, **last: Any) -> ForceCurve:
    """At 0.05 and 0.1 MPa; the second reading has other values where they are given."""

    def reading(pressure: float, **others: Any) -> ForceReading:
        values: dict[str, Any] = {
            "pressure_mpa": pressure, "distance_mm": None, "force_n": 1.5,
            "components_n": (0.0, -1.5), "moment_n_mm": 2.0, "tip_position_mm": (40.0, -7.0),
            "tip_angle_deg": 90.0, "contact": False, "stable": True, "volume_mm3": 1000.0,
            "max_von_mises_mpa": 3.0, "max_von_mises_error_percent": 5.0,
            "error": ForceError(mesh=4.0), "shape": ((0.0, 0.0), (40.0, -7.0)),
        }  # fmt: skip
        return ForceReading(**(values | others))

    air = Air(1000.0, 1500.0, 0.001, 10.0)
    readings = (reading(0.05), reading(0.1, **last))
    return ForceCurve(
        load_design("finger"), content.kind, content, True, "", readings, (), None, 1.0, None, air,
        (), Seconds(1.0, 0.1),
    )  # fmt: skip


def figures(content: Scene, **last: Any) -> dict[str, Any]:
    return {each["label"]: each["value"] for each in scene_figures(curve(content, **last))}


@pytest.mark.parametrize("content", [Free(), Payload(mass_g=20)])
def test_who_presses_on_nothing_has_no_force_but_a_place_of_the_tip(content: Scene) -> None:
    found = figures(content, force_n=0.0, error=None)
    assert not [label for label in found if "orce" in label or "Moment" in label]
    assert found["Tip at x"] == 40.0 and found["Tip at z"] == -7.0


def test_force_of_a_blocked_finger_has_the_sum_of_its_errors() -> None:
    force = next(each for each in scene_figures(curve(Blocked())) if each["label"] == "Force")
    assert (force["value"], force["unit"], force["error_percent"]) == (1.5, "N", 4.0)


@pytest.mark.parametrize(("holds", "told"), [(True, "yes"), (False, "no"), (None, "not decided")])
def test_grip_always_says_whether_the_object_is_held(holds: bool | None, told: str) -> None:
    assert figures(GRIP, holds=holds)["Object held"] == told


def test_tip_on_the_plate_is_at_zero_without_its_rounding() -> None:
    assert str(figures(Blocked(), tip_position_mm=(35.6, -6.2e-15))["Tip at z"]) == "0.0"


def test_what_is_not_known_is_left_out() -> None:
    assert "Highest stress" not in figures(Blocked(), max_von_mises_mpa=None)


def test_caption_names_pressures_and_what_is_drawn_of_a_grip() -> None:
    assert "at 0.05 and 0.1 MPa" in scene_caption(curve(Blocked()))
    assert "axis" not in scene_caption(curve(Blocked()))
    gripped = scene_caption(curve(GRIP, touched=((30.0, -3.0),)))
    assert "One of 2 fingers" in gripped and "where it presses" in gripped
