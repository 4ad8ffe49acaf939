"""What the finger exerts in a scene: figures and a picture."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.grip import Grip
from bellows_design.studio.choices.changed import changed, design_of_text
from bellows_design.studio.tasks.places import store_at
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve

    Values = dict[str, Any]

STEPS = 4
"""Pressures, evenly up to the design's: so many shapes are drawn."""


def scene(values: Values, _: Values, report: Report) -> None:
    """Solve the scene that the page describes."""
    from bellows_design.design.scenes.scene import check_fits, scene_of
    from bellows_design.force.curve import force_curve
    from bellows_design.studio.display.scene_picture import scene_caption, scene_picture

    design = changed(design_of_text(values["base"]), values["values"])
    around = scene_of({"kind": values["scene"], **values["keys"]}, "the scene")
    check_fits(around, "the scene", design.finger_length)
    pressures = tuple(design.load.pressure * step / STEPS for step in range(1, STEPS + 1))
    store = store_at(values)
    found = force_curve(design, around, pressures, by_distance=False, progress=report, store=store)
    report(
        "scene",
        scene=values["scene"],
        figures=scene_figures(found),
        message=found.message,
        warnings=list(dict.fromkeys(found.warnings)),
        svg=scene_picture(found),
        caption=scene_caption(found),
    )


def scene_figures(found: ForceCurve) -> list[Values]:
    """Label, value, unit and error in percent of each that is known, at the last pressure."""
    return [figure for figure in _figures(found) if figure["value"] is not None]


def _figures(found: ForceCurve) -> Iterator[Values]:
    last = found.last
    yield _figure("Pressure", last.pressure_mpa, "MPa")
    yield from _forces(found)
    yield _figure("Tip angle", last.tip_angle_deg, "°")
    for axis, place in zip("xz", last.tip_position_mm, strict=True):
        yield _figure(f"Tip at {axis}", round(place, 6) + 0.0, "mm")  # no 1e-15
    stress_error = last.max_von_mises_error_percent
    yield _figure("Highest stress", last.max_von_mises_mpa, "MPa", stress_error)
    yield _figure("Stable", _yes(last.stable), "")
    yield _figure("Stiffness at the tip", found.tip_stiffness_n_per_mm, "N/mm")


def _forces(found: ForceCurve) -> Iterator[Values]:
    """Of a finger that presses on something; a free one and one that carries exert none."""
    last, error = found.last, found.last.error
    percent = None if error is None else error.total
    if isinstance(found.content, Blocked):
        yield _figure("Force", last.force_n, "N", percent)
        yield _figure("Moment", last.moment_n_mm, "N mm")
    if isinstance(found.content, Grip):
        yield _figure("Object held", _yes(last.holds) or "not decided", "")
        yield _figure("Normal force of a finger", last.force_n, "N", percent)
        payload_error = last.largest_payload_error_percent
        yield _figure("Largest payload", last.largest_payload_g, "g", payload_error)


def _figure(label: str, value: Any, unit: str, error: float | None = None) -> Values:
    return {"label": label, "value": value, "unit": unit, "error_percent": error}


def _yes(holds: bool | None) -> str | None:
    return None if holds is None else "yes" if holds else "no"
