"""An optimum as designs to be printed, and as plain values."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from bellows_design.design.design import Design
from bellows_design.study.optimize.point import Point
from bellows_design.study.optimize.run import Optimum

SUMMARY = "optimum.json"


def designs_of(optimum: Optimum) -> dict[str, Point]:
    """Name of a design -> its point: the best first, then the front by rising stress."""
    name = optimum.optimization.base.name[:50]
    best = {} if optimum.best is None else {f"{name}-best": optimum.best}
    front = {f"{name}-{place}": point for place, point in enumerate(optimum.front, start=1)}
    return best | front


def as_design(name: str, point: Point) -> Design:
    """The design of a point under its name, with what was found in its description."""
    values = point.values
    description = (
        f"{values['angle']:.1f} degrees at {values['stress']:.3f} MPa, "
        f"{point.stress_with_error:.3f} MPa with the estimated error; {point.choice.text}"
    )
    return Design.of(point.design.model_dump() | {"name": name, "description": description})


def write_designs(designs: Mapping[str, Point], content: dict[str, Any], folder: Path) -> None:
    """Every design as a TOML file that ``bellows run`` takes, and a summary; each file whole.

    Designs that an earlier run's summary names and that are not on the front any more are removed.
    """
    from bellows_design.files.atomic import replacing
    from bellows_design.files.json_files import write_json

    for name in _earlier(folder) - designs.keys():
        (folder / f"{name}.toml").unlink(missing_ok=True)
    for name, point in designs.items():
        with replacing(folder / f"{name}.toml") as temporary:
            temporary.write_text(as_design(name, point).to_toml(), "utf-8")
    write_json(content, folder / SUMMARY)


def _earlier(folder: Path) -> set[str]:
    """Names of the designs that the summary of an earlier run lists; none without one."""
    try:
        rows = json.loads((folder / SUMMARY).read_text("utf-8"))["front"]
        names = {str(row["design"]) for row in rows}
    except (OSError, ValueError, KeyError, TypeError):
        return set()
    return {name for name in names if Path(name).name == name}


def content_of(optimum: Optimum, designs: Mapping[str, Point]) -> dict[str, Any]:
    """Plain values for JSON; docs/json.md says what they mean."""
    optimization = optimum.optimization
    return {
        "design": optimization.base.name,
        "digest": optimization.base.digest,
        "goal": asdict(optimization.goal),
        "best": next(iter(designs), None) if optimum.best is not None else None,
        "front": [_row(name, point) for name, point in designs.items()],
        "verification": None if optimum.verification is None else optimum.verification.to_dict(),
        "verification_failure": optimum.failure or None,
        "filling_seconds": optimum.filling_seconds,
        "evaluations": {
            "asked": optimum.asked,
            "known": optimum.known,
            "failed": optimum.failed,
            "neighbours": sum(not point.ordinary for point in optimum.points),
        },
        "in_time": optimum.in_time,
        "seconds": optimum.seconds,
        "evaluation_seconds": optimum.evaluation_seconds,
    }


def _row(name: str, point: Point) -> dict[str, Any]:
    return {
        "design": name,
        "digest": point.design.digest,
        "bending_angle_deg": point.values["angle"],
        "max_von_mises_mpa": point.values["stress"],
        "error_estimate": {
            "bending_angle_percent": point.answer.bending_angle_error_percent,
            "max_von_mises_percent": point.answer.max_von_mises_error_percent,
        },
        "cavity_volume_mm3": point.values["volume"],
        "highest_strain": point.values["strain"],
        "min_gap_mm": point.answer.smallest_gap_mm,
        "counts": asdict(point.choice),
        "bellows": point.design.bellows.model_dump(exclude_none=True),
        "indent": None if point.design.indent is None else point.design.indent.model_dump(),
    }
