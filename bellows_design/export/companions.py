"""Files that go with an approved part: what the leak test found, and settings for slicers."""

from __future__ import annotations

from bellows_design.export.part import Part
from bellows_design.export.three_mf import three_mf
from bellows_design.files.json_files import json_text
from bellows_design.leak_test.record import LeakTest

LEAK_TEST = "leak_test.json"
LEAK_TEST_FORMAT = "bellows-design leak test 1"

_SETTINGS = (".prusaslicer.ini", ".machine.json", ".process.json", ".filament.json")
"""Endings of the files of settings."""


def leak_test_file(test: LeakTest) -> dict[str, bytes]:
    """Setting, slicer, its settings and the result of every rule, or why there are none.

    What was measured is in ``run.json``: with random seams another run measures a little else.
    """
    return {LEAK_TEST: json_text({"format": LEAK_TEST_FORMAT, **test.reproducible()}).encode()}


def settings_files(part: Part) -> dict[str, bytes]:
    """Settings of the part's printer: an INI for PrusaSlicer, three JSON files for OrcaSlicer.

    None for a part without a printer.
    """
    from printers.slicing.orca import orca_settings

    if part.profile is None:
        return {}
    texts = {f"{part.name}.prusaslicer.ini": prusa_text(part)}
    for name, text in orca_settings(part.profile).items():
        texts[f"{part.name}.orcaslicer{name.removeprefix(part.profile.name)}"] = text
    return {name: text.encode() for name, text in texts.items()}


def is_settings(name: str) -> bool:
    """Whether a file of this name holds settings for a slicer."""
    return name.endswith(_SETTINGS)


def three_mf_with_settings(part: Part) -> bytes:
    """The part as 3MF with the settings of its printer for PrusaSlicer."""
    return three_mf(part, settings_comment(part))


def settings_comment(part: Part) -> str:
    """The settings as PrusaSlicer keeps them in a 3MF; empty without a printer."""
    from printers.slicing.prusa import parsed_settings

    pairs = parsed_settings(prusa_text(part)).items()
    return "".join(f"; {key} = {value}\n" for key, value in pairs)


def prusa_text(part: Part) -> str:
    """The settings of the part's printer for PrusaSlicer; empty without a printer."""
    from printers.slicing.prusa import prusa_settings

    return "" if part.profile is None else prusa_settings(part.profile)
