"""The example for a printer that the shipped designs do not fit."""

from __future__ import annotations

from pathlib import Path

import pytest

from bellows_design.design import Design
from bellows_design.pipeline import build_part, check
from printers import load_profile

EXAMPLE = Path(__file__).parents[2] / "examples" / "finger_direct.toml"


@pytest.mark.thorough
def test_the_finger_for_thin_lines_passes_the_printer_it_is_made_for() -> None:
    design = Design.from_toml(EXAMPLE.read_text("utf-8"))
    profile = load_profile("direct_drive_sealing")
    assert design.profile() == profile
    lines = design.bellows.bubble_thickness / profile.line_width
    assert abs(lines - 4) < 1e-9
    report = check(design, build_part(design))
    assert report.verdict == "pass", report.failures
    assert "wall_multiple" in {
        r.rule for r in check(design, build_part(design), "prusa_i3").failures
    }
